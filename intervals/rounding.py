"""Directed rounding to binary64: exact conversions, and the outward step for arrays of bounds.

An enclosure [a, b] is stored as the pair of rows (-a, b), so that both rows round upward and one
formula serves both. u = 2^-53 is half the spacing of binary64 at 1, eta = 2^-1074 its least
positive number. Nothing here changes the rounding mode of the processor.
"""

from collections.abc import Callable
from fractions import Fraction
from math import copysign, inf, nextafter

import numpy as np
from numpy.typing import NDArray

Rows = NDArray[np.float64]


def constant(value: float) -> Rows:
    """Return a number as an array without axes: numpy meets it sooner than a float."""
    array = np.array(value)
    array.setflags(write=False)
    return array


def all_of(mask: NDArray[np.bool_]) -> bool:
    """Return whether a mask holds everywhere: no byte of it is 0. Sooner than its own `all`."""
    return 0 not in mask.tobytes()


def joined(first: Rows, second: Rows) -> Rows:
    """Return two arrays of one shape as one: np.stack, sooner where they are small."""
    return np.array((first, second))


ULP = 2.0**-52
ETA = 2.0**-1074
MAX = 2.0**1023 * (2.0 - ULP)

BEYOND = "a bound is beyond the range of binary64"
_ONE = 1.0
_LEAST_NORMAL = 2.0**-1022
_ULP, _ETA, _MAX = map(constant, (ULP, ETA, MAX))


class BeyondRange(OverflowError, ValueError):
    """A number that is asked for, and is infinite."""


def float_down(value: Fraction | int) -> float:
    """Return the largest finite binary64 number <= value.

    The quotient of two ints is within one step of the result; exact comparisons settle it,
    whatever the rounding mode. A value that rounds to no finite number raises OverflowError.
    """
    value = Fraction(value)
    result = float(value)
    while result > value:
        result = nextafter(result, -inf)
    return _finite(result)


def float_up(value: Fraction | int) -> float:
    """Return the smallest finite binary64 number >= value; OverflowError as in `float_down`."""
    value = Fraction(value)
    result = float(value)
    while result < value:
        result = nextafter(result, inf)
    return _finite(result)


def _finite(result: float) -> float:
    if not -MAX <= result <= MAX:
        raise OverflowError("the bound is beyond the range of binary64")
    return result


def towards(value: Fraction, rounded: Callable[[Fraction], float]) -> float:
    """Return the binary64 number, or infinity, next to `value`."""
    try:
        return rounded(value)
    except OverflowError:
        away = (value > 0) == (rounded is float_up)
        return copysign(inf if away else MAX, 1 if value > 0 else -1)


def outward(rows: Rows, otherwise: Callable[[], Rows] | None = None) -> Rows:
    """Replace each x in `rows` by an upper bound of the exact e that it was rounded from.

    Hypothesis: e <= x+, where x+ is the binary64 number after x; so it is if x is the result of
    one operation of exact value e, with an error below one ulp, rounded in any mode. Conclusion:
    e <= y = fl(x + fl(fl(|x| 2^-52) + eta)). Works in place and returns `rows`.

    Proof. Let g be the gap of the binade of x: 2^(k-52) if 2^k <= |x| < 2^(k+1) is normal, eta
    below. Then x + g is a binary64 number and x+ <= x + g. Rounding is monotone in every mode
    and leaves binary64 numbers alone, so it suffices that fl(fl(|x| 2^-52) + eta) >= g, then
    y >= fl(x + g) = x + g. Normal x: |x| 2^-52 >= 2^(k-52) = g, which is a binary64 number, so
    fl(|x| 2^-52) >= g, and adding eta does not lower it. Other x: g = eta. Overflow: see
    `extended`. Flushing to zero breaks eta, and is refused here.

    Where x is NaN, as 0 times infinity is, it may be done again with other x: `otherwise()`.
    """
    require_subnormals()
    step = np.abs(rows)
    step *= _ULP
    step += _ETA
    rows += step
    if otherwise and not all_of(rows < _MAX) and np.isnan(step).any():
        return outward(otherwise())
    return extended(rows, step)


def outward_sum(rows: Rows) -> Rows:
    """Do the same for x that came from + or - of two binary64 numbers: y = fl(x + fl(|x| 2^-52)).

    Proof. As for `outward` where x is normal. Elsewhere |x| < 2^-1022, the exact sum is a multiple
    of eta below 2^-1022 + eta, hence x is exact; so is 0, and y >= x. Exact zeros stay exact.
    """
    require_subnormals()
    step = np.abs(rows)
    step *= _ULP
    rows += step
    return extended(rows, step)


def extended(rows: Rows, step: Rows) -> Rows:
    """Replace in `rows`, x + step, what no number bounds by infinity, in place.

    e > MAX has made x, and so x + step, inf or (in the modes that round toward zero or down) MAX.
    e < -MAX, of which x may be -inf, is bounded by -MAX; there step is inf, and x + step is NaN.
    Where x was NaN nothing is known.
    """
    if not all_of(rows < _MAX):
        below = np.isnan(rows) & (step == inf)
        np.copyto(rows, np.where(below, -MAX, inf), where=~(rows < _MAX))
    return rows


def bounded(rows: Rows) -> Rows:
    """Return `rows` if all are < MAX, else raise OverflowError; NaN is refused too."""
    if not all_of(rows < _MAX):
        raise OverflowError(BEYOND)
    return rows


def require_subnormals() -> None:
    """Raise FloatingPointError where this thread flushes subnormal numbers to zero."""
    if not _LEAST_NORMAL * 0.5 > 0.0:
        raise FloatingPointError("subnormal numbers are flushed to zero in this thread")


def require_nearest() -> None:
    """Raise FloatingPointError unless this thread rounds to nearest, ties to even."""
    require_subnormals()
    if not (_ONE + 0.5 * ULP == 1.0 and _ONE + 0.75 * ULP > 1.0):
        raise FloatingPointError("this thread does not round to nearest")
