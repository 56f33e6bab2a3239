"""Where the kernels are not proved: bounds from the multiprecision functions, one by one."""

from contextlib import suppress
from math import copysign, inf, isfinite
from typing import TYPE_CHECKING

from intervals.errors import DomainError
from intervals.functions import TABLE
from intervals.rounding import ETA, MAX, float_down, float_up, towards

if TYPE_CHECKING:
    from intervals.elementary.tightest import Bounds, Raw

_PRECISION = 64
_EXPONENTIALS = frozenset({"exp", "exp2", "exp10", "expm1"})
PI_UP = 3.1415926535897936  # the next binary64 number above pi
_VANISHING = -2000.0  # 2^-2000 is below the least binary64 number

Ends = tuple[float, float]


def monotone(name: str, lower: float, upper: float) -> Ends:
    """Return bounds of f(lower) from below and of f(upper) from above, f = `name` increasing.

    The exponentials have the same tightest bounds at all arguments below -2000, since their values
    (for expm1 those of expm1 x + 1) are between 0 and 2^-2000. Where the functions raise
    OverflowError the values are far beyond binary64.
    """
    from intervals.elementary.tightest import FUNCTIONS

    if name in _EXPONENTIALS:
        lower, upper = max(lower, _VANISHING), max(upper, _VANISHING)
    function, (least, most) = FUNCTIONS[name], TABLE[name].limits
    try:
        low = _down(function(_raw(lower), _PRECISION)) if lower > -inf else least
    except OverflowError:
        low = MAX if lower > 0.0 else -inf
    try:
        high = _up(function(_raw(upper), _PRECISION)) if upper < inf else most
    except OverflowError:
        high = inf if upper > 0.0 else -MAX
    return low, high


def tan(x: Ends) -> Ends:
    """Return bounds of tan over [x[0], x[1]]; DomainError if it contains a pole."""
    from intervals.elementary.tightest import sincos

    if not x[1] - x[0] < inf:
        raise DomainError("tan of an interval that contains a pole")
    (first, last) = (sincos(_raw(end), _PRECISION)[2] for end in x)
    if (first + 1) // 2 != (last + 1) // 2:  # first < j <= last for an odd j: j pi/2 is inside
        raise DomainError("tan of an interval that contains a pole")
    return monotone("tan", *x)


def at_corners(name: str, x: Ends, y: Ends) -> Ends:
    """Return bounds of f over a box for a function f of x and y that is extremal at its corners."""
    from intervals.elementary import tightest

    if not all(map(isfinite, (*x, *y))):
        return _of_unbounded(name, x, y)
    function = {"atan2": tightest.atan2, "hypot": tightest.hypot, "power": tightest.power}[name]
    lows, highs = [], []
    for a, b in {(a, b) for a in x for b in y}:
        low, high = MAX, inf  # of powers beyond 2^2^30
        with suppress(OverflowError):
            value = function(_raw(a), _raw(b), _PRECISION)
            low, high = _down(value), _up(value)
        lows.append(low)
        highs.append(high)
    return min(lows), max(highs)


def _of_unbounded(name: str, x: Ends, y: Ends) -> Ends:
    """Return bounds over a box that is not bounded; those of angles and powers are not sharp."""
    if name == "atan2":
        return -PI_UP, PI_UP
    return max(x[0], y[0]) if name == "hypot" else 0.0, inf


def _raw(value: float) -> "Raw":
    from intervals.raw import from_bits

    return from_bits(value)


def _down(bounds: "Bounds") -> float:
    """Return the largest binary64 number <= the lower bound."""
    return _directed(bounds[0], up=False)


def _up(bounds: "Bounds") -> float:
    """Return the smallest binary64 number >= the upper bound."""
    return _directed(bounds[1], up=True)


def _directed(value: "Raw", up: bool) -> float:
    """Round to binary64; the sizes that it has not are settled without long fractions."""
    from intervals.raw import exact

    negative, man, exp, size = value
    if man and not -1080 <= exp + size <= 1025:
        tiny, huge = (ETA, 0.0), (inf, MAX)
        away, toward = huge if exp > 0 else tiny
        return copysign(away if up != bool(negative) else toward, -1.0 if negative else 1.0)
    return towards(exact(value), float_up if up else float_down)
