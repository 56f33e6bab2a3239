"""Where the kernels are not proved: bounds from the multiprecision functions, one by one."""

from typing import TYPE_CHECKING

from intervals.errors import DomainError
from intervals.rounding import ETA, float_down, float_up

if TYPE_CHECKING:
    from intervals.elementary.tightest import Bounds, Raw

_PRECISION = 64
_EXPONENTIALS = frozenset({"exp", "exp2", "exp10", "expm1"})
_VANISHING = -2000.0  # 2^-2000 is below the least binary64 number

Ends = tuple[float, float]


def monotone(name: str, lower: float, upper: float) -> Ends:
    """Return bounds of f(lower) from below and of f(upper) from above, f = `name` increasing.

    The exponentials have the same tightest bounds at all arguments below -2000, since their values
    (for expm1 those of expm1 x + 1) are between 0 and 2^-2000.
    """
    from intervals.elementary.tightest import FUNCTIONS

    if name in _EXPONENTIALS:
        lower, upper = max(lower, _VANISHING), max(upper, _VANISHING)
    function = FUNCTIONS[name]
    return (
        _down(function(_raw(lower), _PRECISION)),
        _up(function(_raw(upper), _PRECISION)),
    )


def tan(x: Ends) -> Ends:
    """Return bounds of tan over [x[0], x[1]]; DomainError if it contains a pole."""
    from intervals.elementary.tightest import sincos

    (first, last) = (sincos(_raw(end), _PRECISION)[2] for end in x)
    if (first + 1) // 2 != (last + 1) // 2:  # first < j <= last for an odd j: j pi/2 is inside
        raise DomainError("tan of an interval that contains a pole")
    return monotone("tan", *x)


def at_corners(name: str, x: Ends, y: Ends) -> Ends:
    """Return bounds of f over a box for a function f of x and y that is extremal at its corners."""
    from intervals.elementary import tightest

    function = {"atan2": tightest.atan2, "hypot": tightest.hypot, "power": tightest.power}[name]
    corners = {(a, b) for a in x for b in y}
    values = [function(_raw(a), _raw(b), _PRECISION) for a, b in corners]
    return min(map(_down, values)), max(map(_up, values))


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
    if man and exp + size > 1025:
        raise OverflowError("a bound is beyond the range of binary64")
    if man and exp + size < -1080:
        away = up != bool(negative)
        return (-ETA if negative else ETA) if away else 0.0
    return float_up(exact(value)) if up else float_down(exact(value))
