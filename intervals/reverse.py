"""Reverse operations on N intervals at a time: supersets of what an argument can have been.

`REVERSE` has for each operation one function for each argument; it takes what is left of the value,
Z, the arguments U (and V), and details such as an exponent, and returns a superset of
{u in U: g(u, v) in Z for some v in V}, or of the v. DomainError, OverflowError: there is no bound.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from math import inf
from typing import Any

import numpy as np

from intervals.array import IntervalArray
from intervals.functions import TABLE
from intervals.generic import where
from intervals.interval import Interval
from intervals.rounding import MAX

_PI, _ONE = IntervalArray([Interval.pi()]), IntervalArray([1])
_TINY = Fraction(1, 2**400)
_SLACK = 2.0**-44  # in proportion: numpy's powers are nearer than that, as a rule
_LEAST = 2.0**-900  # below it powers would lose bits
_FAR = 1e8  # beyond it the branches of sine and tangent are not told apart


def quotient(z: IntervalArray, v: IntervalArray, u: IntervalArray) -> IntervalArray:
    """Return a superset of the hull of {x in U: x y in Z for some y in V}.

    Where 0 is not in V: Z / V. Where it is in both V and Z: everything. Else see `_beside`.
    """
    through = np.asarray(v.contains_zero())
    if not through.any():
        return z / v
    rows = (z / IntervalArray._of_rows(np.where(through, _ONE._rows, v._rows)))._rows
    rows = np.where(through, inf, rows)
    beside = through & ~np.asarray(z.contains_zero())
    if beside.any():
        low, high = _beside(*(x if x.size == 1 else x[beside] for x in (z, v, u)))
        rows[:, beside] = -low, high
    return IntervalArray._of_rows(rows)


def _beside(z: IntervalArray, v: IntervalArray, u: IntervalArray) -> Any:
    """Return the ends of the same where 0 is in V, but not in Z.

    Let Z > 0 (or take -Z and -V): x <= inf Z / inf V for y < 0, and x >= inf Z / sup V for y > 0.
    If U lies right of the first part only the second counts, and vice versa; right of it and left
    of the second, U is disjoint from what is returned.
    """
    negative = z.sup < 0
    z, v = where(negative, -z, z), where(negative, -v, v)
    least = IntervalArray.from_floats(z.inf)
    below, above = v.inf < 0, v.sup > 0
    low, high = np.isfinite(v.inf), np.isfinite(v.sup)
    left = (least / IntervalArray.from_floats(np.where(below & low, v.inf, -1.0))).sup
    right = (least / IntervalArray.from_floats(np.where(above & high, v.sup, 1.0))).inf
    left = np.where(below, np.where(low, left, 0.0), -inf)
    right = np.where(above, np.where(high, right, 0.0), inf)
    only_right = u.inf > left
    only_left = (u.sup < right) & ~only_right
    return np.where(only_right, right, -inf), np.where(only_left, left, inf)


def either_sign(root: IntervalArray, u: IntervalArray) -> IntervalArray:
    """Return a superset of the hull of {x in U: |x| in R}, R >= 0."""
    low, high = root._rows
    left, right = ~u.disjoint(-root), ~u.disjoint(root)
    rows = np.where(left, high, low), np.where(right | ~left, high, low)
    return IntervalArray._of_rows(np.stack(rows))


def _logarithm(z: IntervalArray) -> IntervalArray:
    """Return a superset of {x: exp x in Z}: Z may reach down to 0 and below."""
    low, high = z.maximum(_TINY).log()._rows
    return IntervalArray._of_rows(np.stack((np.where(z.inf > 0, low, inf), high)))


def branches(root: IntervalArray, u: IntervalArray, sign: int, shift: IntervalArray) -> Any:
    """Return a superset of the hull of {x in U: x in k pi + sign^k R - S for an integer k}.

    R lies in [-pi/2, pi/2], up to rounding, so the parts for k follow each other. The part in whose
    reach inf U is, is found in floating point, which is not one wrong for |x| < 10^8: one before
    and two after it are tried. The least number >= inf U is in the first part that is not left of
    inf U; likewise for sup U.
    """
    near = (np.abs(u.inf) < _FAR) & (np.abs(u.sup) < _FAR)
    places = np.rint(np.where(near, u.inf, 0.0) / np.pi + 0.5 * (shift.mid > 1))
    low = _first(root, u, sign, shift, places)
    places = np.rint(np.where(near, u.sup, 0.0) / np.pi + 0.5 * (shift.mid > 1))
    high = -_first(-root, -u, sign, -shift, -places)
    part = IntervalArray.from_floats(
        np.where(low <= high, low, MAX), np.where(low <= high, high, MAX)
    )
    return where(near, part, u)


def _first(
    root: IntervalArray, u: IntervalArray, sign: int, shift: IntervalArray, places: Any
) -> Any:
    """Return the lower end of the first part that is not left of inf U."""
    least = np.full(u.shape, MAX)
    for k in (places + 2, places + 1, places, places - 1):
        turned = where((sign < 0) & (k % 2 == 1), -root, root)
        part = IntervalArray.from_floats(k) * _PI + turned - shift
        least = np.where(part.sup >= u.inf, part.inf, least)
    return least


def root(z: IntervalArray, u: IntervalArray, n: int) -> IntervalArray:
    """Return a superset of the hull of {x in U: x^n in Z}, n >= 1."""
    if n % 2:
        return _odd_root(z, n)
    size = z.maximum(0)
    while n % 2 == 0:
        size, n = size.sqrt(), n // 2
    return either_sign(_odd_root(size, n), u)


def _odd_root(z: IntervalArray, n: int) -> IntervalArray:
    """Return a superset of the n-th roots of Z, n odd, where `pow` would be slow: Z may contain 0.

    Of the rows (-inf Z, sup Z) each takes a candidate c, near its n-th root in floating point, if
    an enclosure of c^n shows that c^n is not below the row: then c is not below the root.
    """
    if n == 1:
        return z
    rows = z._rows
    near = np.abs(rows) < 2.0**1000
    size = np.where(near, np.maximum(np.abs(rows), _LEAST), 1.0) ** (1 / n)
    below = np.where(rows > -_LEAST, 0.0, -size * (1 - _SLACK))
    candidate = np.where(rows > 0, size * (1 + _SLACK), below)
    proved = near & ((IntervalArray.from_floats(candidate) ** n).inf >= rows)
    proved |= (candidate == 0) & (rows <= 0)  # exact, where an enclosure of 0^n may reach below 0
    return IntervalArray._of_rows(np.where(proved, candidate, inf))


def _power(z: IntervalArray, u: IntervalArray, n: int) -> IntervalArray:
    """Return a superset of the hull of {x in U: x^n in Z}, n != 0."""
    return root(z, u, n) if n > 0 else root(1 / z, u, -n)


def _leg(z: IntervalArray, u: IntervalArray, v: IntervalArray) -> IntervalArray:
    """Return a superset of the hull of {x in U: x^2 + y^2 = w^2 for some w in Z, y in V}."""
    return either_sign((z.maximum(0).sqr() - v.sqr()).maximum(0).sqrt(), u)


_HALF, _NONE = _PI / 2, 0 * _PI
REVERSE: dict[str, tuple[Callable[..., IntervalArray], ...]] = {  # one for each argument
    name: (function.undo,) for name, function in TABLE.items() if function.undo
} | {
    "__neg__": (lambda z, u: -z,),
    "__add__": (lambda z, u, v: z - v, lambda z, u, v: z - u),
    "__sub__": (lambda z, u, v: z + v, lambda z, u, v: u - z),
    "__mul__": (lambda z, u, v: quotient(z, v, u), quotient),
    "__truediv__": (lambda z, u, v: z * v, lambda z, u, v: quotient(u, z, v)),
    "__abs__": (lambda z, u: either_sign(z.maximum(0), u),),
    "__pow__": (_power,),
    "pow": (
        lambda z, u, v: z.pow(1 / v),
        lambda z, u, v: quotient(_logarithm(z), u.log(), v),
    ),
    "hypot": (_leg, lambda z, u, v: _leg(z, v, u)),
    "rootn": (lambda z, u, n: z**n,),
    "exp": (lambda z, u: _logarithm(z),),
    "sin": (lambda z, u: branches(z.asin(), u, -1, _NONE),),
    "cos": (lambda z, u: branches(z.asin(), u, -1, _HALF),),
    "tan": (lambda z, u: branches(z.atan(), u, 1, _NONE),),
    "cosh": (lambda z, u: either_sign(z.maximum(1).acosh(), u),),
}
