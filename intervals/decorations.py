"""Decorations of IEEE 1788, and images of functions with them; see `decorated`.

Each image takes sets that are not empty, by their ends, which may be infinite, and returns the ends
of f(X), not rounded yet where they are exact, and the decoration of f on X.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from enum import IntEnum
from fractions import Fraction
from math import inf
from operator import methodcaller
from typing import Any, TypeAlias

from intervals.errors import DomainError
from intervals.functions import REALS, STEPS, TABLE, Domain
from intervals.interval import Interval


class Decoration(IntEnum):
    """What is known, from less to more; the numbers are the standard's."""

    ILL = 0
    TRV = 4
    DEF = 8
    DAC = 12
    COM = 16


ILL, TRV, DEF, DAC, COM = Decoration
Set: TypeAlias = Any  # a Decorated, whose module imports this one
End: TypeAlias = Fraction | float  # a float is an infinity
Image: TypeAlias = tuple[End, End, Decoration]
_LARGE = Fraction(2**1024)
EMPTY: Image = (inf, -inf, TRV)


def infinite(*ends: End) -> bool:
    """Return whether one of the ends is infinite."""
    return any(end in (inf, -inf) for end in ends)


def total(x: End, y: End) -> End:
    """Return the sum of two lower, or of two upper ends."""
    return x if infinite(x) else y if infinite(y) else x + y


def _product(x: End, y: End) -> End:
    """Return the product of two ends; 0 times an infinity is 0, as 0 times numbers is."""
    if infinite(x, y):
        return ((x > 0) - (x < 0)) * ((y > 0) - (y < 0)) * inf if x and y else Fraction(0)
    return x * y


def products(x: Set, low: End, high: End) -> tuple[End, End]:
    """Return the ends of the products of X and [low, high]."""
    corners = [_product(a, b) for a in (x.inf, x.sup) for b in (low, high)]
    return min(corners), max(corners)


def fma(x: Set, y: Set, z: Set) -> Image:
    """Return the image of x y + z."""
    low, high = products(x, y.inf, y.sup)
    return total(low, z.inf), total(high, z.sup), COM


def quotient(x: Set, y: Set) -> Image:
    """Return x / y as the hull of x (1/y) for y > 0 and of -x (1/-y) for y < 0."""
    ends: list[End] = []
    for z, v in ((x, y), (-x, -y)):
        if v.sup > 0:
            least = Fraction(0) if infinite(v.sup) else 1 / Fraction(v.sup)
            ends += products(z, least, inf if v.inf <= 0 else 1 / Fraction(v.inf))
    known = TRV if y.inf <= 0 <= y.sup else COM
    return (min(ends), max(ends), known) if ends else EMPTY


def size(x: Set) -> Image:
    """Return the image of |x|."""
    return max(Fraction(0), x.inf, -x.sup), max(-x.inf, x.sup), COM


def _point(end: End, x: Set) -> Interval:
    return Interval(Fraction(end), precision=x.precision)


def named(name: str, x: Set) -> Image:
    """Return the image under a function that is monotone on its domain."""
    quarter = Interval.pi(precision=x.precision) / 2
    limits = (-quarter, quarter) if name == "atan" else TABLE[name].limits
    image = monotone(methodcaller(name), x, TABLE[name].domain, limits)
    return _stairs(methodcaller(name), x, *image[:2]) if name in STEPS else image


def monotone(
    function: Callable[[Interval], Interval],
    x: Set,
    domain: Domain = REALS,
    limits: tuple[Any, Any] = (-inf, inf),
) -> Image:
    """Return the image under a continuous monotone function, with its limits at open ends."""
    first, last = (q if q is None else Fraction(q) for q in (domain.low, domain.high))
    low = x.inf if first is None else max(x.inf, first)
    high = x.sup if last is None else min(x.sup, last)
    holes = [not domain.closed and q in (first, last) for q in (low, high)]
    if low > high or (low == high and any(holes)):
        return EMPTY
    ends: list[End] = []
    for q, hole, limit in zip((low, high), holes, limits, strict=True):
        if hole or infinite(q):
            ends += (limit.inf, limit.sup) if isinstance(limit, Interval) else (limit, limit)
        else:
            ends += _value(function, _point(q, x))
    known = COM if (low, high) == (x.inf, x.sup) and not any(holes) else TRV
    return min(ends), max(ends), known


def _value(function: Callable[[Interval], Interval], q: Interval) -> tuple[End, End]:
    """Return the ends of f(q), f increasing; of a value that Interval has not, oo for one of them.

    Interval raises OverflowError beyond 2^2^30, where |q| > 1.
    """
    try:
        value = function(q)
    except OverflowError:
        return (_LARGE, inf) if q.inf > 0 else (-inf, -_LARGE)
    return value.inf, value.sup


def _stairs(step: Callable[[Interval], Interval], x: Set, low: End, high: End) -> Image:
    """Return the image [low, high] under a step function, which jumps at multiples of 1/2 only.

    So it is constant from an end of X, where it does not jump, on for a fourth of the end's last
    place, and for 1/4. One that jumps at an end, but not inside X, is continuous on X alone.
    """
    if low < high:
        return low, high, DEF
    ends = [(Fraction(q), side) for q, side in ((x.inf, -1), (x.sup, 1)) if not infinite(q)]
    near = [q + Fraction(side, 4 * q.denominator) for q, side in ends]
    values = [step(Interval(q, precision=q.numerator.bit_length() + 2)).inf for q in near]
    return low, high, COM if all(value == low for value in values) else DAC


def circular(name: str, x: Set) -> Image:
    """Return the image under sin, cos or tan."""
    if not infinite(x.inf, x.sup):
        with suppress(DomainError):  # a pole
            y = getattr(_hull(x), name)()
            return y.inf, y.sup, COM
    return (-inf, inf, TRV) if name == "tan" else (Fraction(-1), Fraction(1), DAC)


def _hull(x: Set) -> Interval:
    return _point(x.inf, x).hull(_point(x.sup, x))


def power(x: Set, y: Set) -> Image:
    """Return x^y for x > 0, and 0^y = 0 for y > 0: where Interval has no bounds, exp(y log x)."""
    known = COM if x.inf > 0 or x.inf == 0 < y.inf else TRV
    if known is COM and not infinite(x.sup, y.inf, y.sup):
        with suppress(OverflowError):
            z = _hull(x).pow(_hull(y))
            return z.inf, z.sup, known
    powers, zero = (y * x.log()).exp(), Fraction(0)
    if x.inf <= 0 <= x.sup and y.sup > 0:
        return zero, max(powers.sup, zero), known
    return powers.inf, powers.sup, known


def angle(y: Set, x: Set) -> Image:
    """Return atan2, in halves of the circle where the box is not bounded or holds the origin."""
    if not any((y.inf, y.sup, x.inf, x.sup)):
        return EMPTY
    through = y.inf <= 0 <= y.sup
    cut = DAC if y.inf == 0 else DEF  # it is touched from above; or crossed, or touched from below
    known = TRV if through and x.inf <= 0 <= x.sup else cut if through and x.inf < 0 else COM
    if known is not TRV and not infinite(y.inf, y.sup, x.inf, x.sup):
        z = _hull(y).atan2(_hull(x))
    else:
        pi = Interval.pi(precision=max(x.precision, y.precision))
        z = pi.hull(-pi) / (2 if x.inf >= 0 else 1)
        z = z.maximum(0) if y.inf >= 0 else z.minimum(0) if y.sup < 0 else z
    return z.inf, z.sup, known
