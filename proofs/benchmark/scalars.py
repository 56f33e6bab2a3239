"""Interval beside mpmath.iv and python-flint: time an operation, at several precisions."""

from __future__ import annotations

from fractions import Fraction

from intervals import Interval
from proofs.benchmark.comparison import Tell, compare, heading
from proofs.benchmark.libraries import Library, Measurable, one_by_one
from proofs.benchmark.measuring import Effort, Row
from proofs.benchmark.operations import OPERATIONS, SCALAR
from proofs.benchmark.peers import FLINT, IV, at_precision

PRECISIONS = (53, 113, 333, 3333)
_BESIDE = (IV, FLINT)
_TARGET_PRECISION = 333
_COUNT = 20  # different intervals


def library(bits: int) -> Library:
    """Return Interval as a library."""
    scale = 1 << (bits - 4)

    def interval(lower: int, upper: int) -> Interval:
        return Interval(Fraction(lower, scale), Fraction(upper, scale), precision=bits)

    return Library(one_by_one(interval), bits, {})


def measure(effort: Effort, tell: Tell) -> list[Row]:
    """Measure each operation at each precision, on wide intervals and on points."""
    rows = []
    for bits in PRECISIONS:
        rows.append(heading(f"Interval, {bits} bits, an operation", _BESIDE))
        with at_precision(bits) as peers:
            libraries: dict[str, Measurable] = {SCALAR: library(bits), **peers}
            for operation in (one for one in OPERATIONS if not one.whole):
                for wide in (True, False):
                    name = f"{operation.name}, {bits} bits{'' if wide else ' points'}"
                    tell(name)
                    counts = dict.fromkeys(libraries, _COUNT)
                    found = compare(
                        libraries,
                        operation,
                        wide=wide,
                        counts=counts,
                        rounds=effort.rounds,
                        enough=effort.enough,
                    )
                    has_target = bits == _TARGET_PRECISION and IV in operation.texts
                    asked = ">= 1" if has_target else ""
                    rows.append(found.row(name, SCALAR, _BESIDE, asked, 1))
    return rows
