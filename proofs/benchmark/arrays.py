"""IntervalArray beside python-flint, mpmath.iv and codac: time an element, at several lengths."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import isqrt

import numpy as np

from intervals import IntervalArray
from proofs.benchmark.comparison import Tell, compare, heading
from proofs.benchmark.libraries import Library, Measurable
from proofs.benchmark.measuring import Effort, Row
from proofs.benchmark.operations import ARRAY, OPERATIONS, Operation
from proofs.benchmark.peers import CODAC, FLINT, IV, at_precision, codac

LENGTHS = (1, 100, 10_000, 1_000_000)
_BESIDE = (FLINT, IV, CODAC)
_BITS = 53
_TARGET_LENGTH = 10_000
_FEW = 100  # elements for mpmath.iv, whose time an element depends little on their number
_LARGEST_MATRIX = 10_000
_POINTS = ("sin", "cos", "exp")  # measured on points, too


def library() -> Library:
    """Return IntervalArray as a library."""

    def collect(ends: Sequence[tuple[int, int]], count: int) -> IntervalArray:
        lower, upper = np.ldexp(np.array(ends, dtype=np.float64).T, 4 - _BITS)
        return IntervalArray.from_floats(np.resize(lower, count), np.resize(upper, count))

    def matrix(items: IntervalArray, side: int) -> IntervalArray:
        return items.reshape(side, side)

    return Library(collect, _BITS, {}, matrix)


def measure(effort: Effort, python: str, tell: Tell) -> list[Row]:
    """Measure each operation at each length; codac in a process of the interpreter `python`."""
    rows = []
    with at_precision(_BITS) as peers, codac(python) as other:
        libraries: dict[str, Measurable] = {ARRAY: library(), **peers}
        if other:
            libraries[CODAC] = other
            rows.append(Row(CODAC, f"version {other.version}, in a process of its own"))
        rows += [Row(name, f"{name} is absent") for name in _BESIDE if name not in libraries]
        rows.append(heading("IntervalArray, binary64, an element", _BESIDE))
        for operation, wide, count in cases(effort):
            tell(_name(operation, wide, count))
            rows.append(measure_one(effort, libraries, operation, wide, count))
    return rows


def cases(effort: Effort) -> Iterator[tuple[Operation, bool, int]]:
    """Yield the operations, wide or on points, and lengths, one length after the other."""
    for count in LENGTHS:
        for wide in (True, False):
            for operation in OPERATIONS:
                fits = count <= _LARGEST_MATRIX or not operation.matrices
                affordable = count <= effort.costly_length or operation.cheap
                if fits and affordable and (wide or operation.name in _POINTS):
                    yield operation, wide, count


def measure_one(
    effort: Effort,
    libraries: dict[str, Measurable],
    operation: Operation,
    wide: bool,
    count: int,
) -> Row:
    """Measure an operation of IntervalArray and of the others."""
    counts = dict.fromkeys(libraries, count) | {IV: min(count, _FEW)}
    rounds = effort.large_rounds if count > _TARGET_LENGTH else effort.rounds
    found = compare(
        libraries, operation, wide=wide, counts=counts, rounds=rounds, enough=effort.enough
    )
    least = operation.target if count == _TARGET_LENGTH else None
    asked = f">= {least}" if least else ""
    if asked and operation.aim:
        asked += f", aim {operation.aim}"
    return found.row(_name(operation, wide, count), ARRAY, _BESIDE, asked, least or 0)


def _name(operation: Operation, wide: bool, count: int) -> str:
    size = f"{isqrt(count)} x {isqrt(count)}" if operation.matrices else f"{count:,}"
    return f"{operation.name}, {size}{'' if wide else ' points'}"
