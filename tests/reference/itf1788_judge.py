"""Judge what Interval and IntervalArray return for a statement of ITF1788.

Contained. The vectors hold E, the tightest binary64 enclosure of the true range R. An enclosure
X of R contains E as soon as its ends are rounded outward to binary64, with -oo and oo beyond the
range: the rounded ends are binary64 numbers below and above R, and E has the nearest such. An
Interval has an unbounded exponent, so without the rounding it may lie within E where E underflows
or overflows: exp(-1000) lies in [0, 2^-1074]. Tight means that the rounded X is E.

Raised. The operands leave the natural domain: both number types must raise DomainError.

Overflow. OverflowError may be raised where E is unbounded or ends next to the largest number, by
IntervalArray alone or by both. Nothing else may be raised, and everything else has failed: so has a
vector whose E is not tight, where X lies within E; none is known.
"""

from fractions import Fraction
from math import inf, nextafter
from typing import Any, NamedTuple

from intervals import Interval
from intervals.relations import Overlap
from tests.reference.itf1788_operations import EXACT_SUMS, Operation
from tests.reference.itl import Box, Name, Statement, binary64

CONTAINED, RAISED, OVERFLOW, FAILED = "contained", "raised", "overflow", "failed"
_NEAR_OVERFLOW = Fraction(2) ** 1024 * (1 - Fraction(2) ** -48)


class Case(NamedTuple):
    """An applicable statement: operands and results in binary64."""

    statement: Statement
    operation: Operation
    operands: tuple[Any, ...]
    expected: tuple[Any, ...]

    @property
    def inside(self):
        """Whether the operands lie in the natural domain."""
        return self.operation.defined(*self.operands)


class Verdict(NamedTuple):
    """Of one number type; `kind` is CONTAINED, RAISED, OVERFLOW or FAILED."""

    kind: str
    tight: bool = False
    message: str = ""


def as_numbers(result):
    """Return a result as plain data: Fractions in a tuple, a bool, a name, None."""
    if isinstance(result, Interval):
        return (result.inf, result.sup)
    if isinstance(result, tuple):
        return tuple(map(Fraction, result))
    return result.name.replace("_", "").lower() if isinstance(result, Overlap) else result


def judged(case, result):
    """Return the Verdict on a result: plain data, or the exception that was raised."""
    if not case.inside:
        return _judged_outside(case, result)
    if isinstance(result, OverflowError) and _overflows(case.expected):
        return Verdict(OVERFLOW)
    if result is None or isinstance(result, Exception):
        return Verdict(FAILED, message=repr(result))
    contained, tight = _CHECKS[case.operation.category](case, result)
    return Verdict(CONTAINED if contained else FAILED, tight, message=_shown(result))


def _judged_outside(case, result):
    """Outside the domain an error is due, or None where the vector has no set, or every number."""
    if case.operation.outside is None:
        (expected,) = case.expected
        none = expected.empty or expected[:2] == (-inf, inf)
        if result is None and none:
            return Verdict(CONTAINED, tight=True)
    elif isinstance(result, case.operation.outside):
        return Verdict(RAISED)
    return Verdict(FAILED, message=f"outside the domain, {result!r}")


def _shown(result):
    if isinstance(result, tuple):
        return " ".join(float(r(x)).hex() for r, x in zip((down, up), result, strict=False))
    return str(result)


def _overflows(expected):
    """Whether a result is unbounded, or an outward step may carry it beyond the largest number."""
    ends = [end for x in expected for end in (x[:2] if isinstance(x, Box) else (x,))]
    return any(abs(end) >= _NEAR_OVERFLOW for end in ends)


def down(value):
    """Return the largest binary64 number <= value, -oo if there is none."""
    nearest = binary64(value)
    return nearest if nearest <= value else _before(nearest)


def _before(x):
    """Return the binary64 number before x, -oo before the least."""
    previous = nextafter(float(x), -inf)
    return Fraction(previous) if previous > -inf else previous


def up(value):
    """Return the smallest binary64 number >= value, oo if there is none."""
    return -down(-value)


def _check_range(case, result):
    (expected,) = case.expected
    low, high = down(result[0]), up(result[1])
    contained = low <= expected.lower and expected.upper <= high
    return contained, (low, high) == expected[:2]


def _check_truth(case, result):
    (expected,) = case.expected
    if isinstance(expected, Name):
        expected = expected.value.lower()
    return result == expected, result == expected


def _check_number(case, result):
    """Check numbers by exact arithmetic on the operands; they are tight if the vector has them.

    inf, sup, mag and mig must equal the vector. wid must bound the width and rad the distance from
    mid, which must lie inside. A sum must contain the exact sum, to which the vector is nearest.
    """
    name, expected = case.statement.operation, case.expected
    if name in EXACT_SUMS:
        exact = Fraction(EXACT_SUMS[name](*case.operands))
        nearest = binary64(exact) == expected[0]
        return nearest and result[0] <= exact <= result[1], result[0] == exact == result[1]
    low, high, _ = case.operands[0]
    if name == "mid":
        return low <= result[0] <= high, (binary64(result[0]),) == expected
    if name in ("rad", "midRad"):
        middle, radius = result
        contained = low <= middle <= high and radius >= max(middle - low, high - middle)
        return contained, (binary64(middle), up(radius))[-len(expected) :] == expected
    tight = tuple(map(up, result)) == expected
    return result[0] >= high - low if name == "wid" else tight, tight


_CHECKS = {
    "forward": _check_range,
    "set": _check_range,
    "constructor": _check_range,
    "boolean": _check_truth,
    "numeric": _check_number,
}
