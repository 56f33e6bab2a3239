"""The ranges of elementary functions over intervals: bounds (lower, upper) of `precision` bits.

What is returned are the tightest bounds, except where it is said. X and Y are given by their ends,
libmp's numbers; DomainError where they leave the natural domain.
"""

from __future__ import annotations

from mpmath.libmp import fone, from_int, fzero, mpf_cmp, mpf_lt, mpf_neg, mpf_sub

from intervals.elementary import tightest
from intervals.elementary.tightest import STEPS, UP, Bounds, Raw
from intervals.errors import DomainError
from intervals.functions import DOMAINS, TABLE
from intervals.raw import extremes, hull

_POINTS = {**tightest.FUNCTIONS, **STEPS}
_THREE: Raw = from_int(3)
_DOMAINS = {  # the ends, and what mpf_cmp must reach there
    name: (*(end if end is None else from_int(end) for end in domain[:2]), 1 - domain.closed)
    for name, domain in DOMAINS.items()
}


def monotone(name: str, x: Bounds, precision: int) -> Bounds:
    """Return the range of a function of the table that is monotone, or of cosh for X >= 0."""
    if name in DOMAINS and not _inside(name, x):
        raise DomainError(f"{name} of an interval that leaves {DOMAINS[name]}")
    left, right = x[::-1] if TABLE[name].falls else x
    low, high = _POINTS[name](left, precision)
    if left != right:
        _, high = _POINTS[name](right, precision)
    return low, high


def _inside(name: str, x: Bounds) -> bool:
    low, high, least = _DOMAINS[name]
    above = low is None or mpf_cmp(x[0], low) >= least
    return above and (high is None or mpf_cmp(high, x[1]) >= least)


def root(x: Bounds, n: int, precision: int) -> Bounds:
    """Return the range of the real n-th root."""
    if n < 1:
        raise ValueError("a root has a degree of at least 1")
    if n % 2 == 0 and x[0][0]:
        raise DomainError("an even root of an interval that leaves x >= 0")
    return tightest.root(x[0], n, precision)[0], tightest.root(x[1], n, precision)[1]


def sincos(x: Bounds, precision: int) -> tuple[Bounds, Bounds]:
    """Return the ranges of sin and cos: values at the ends, +-1 where a quarter turn is passed."""
    sin, cos, first = tightest.sincos(x[0], precision)
    if x[0] == x[1]:
        return sin, cos
    more_sin, more_cos, last = tightest.sincos(x[1], precision)
    sin, cos = hull(sin, more_sin), hull(cos, more_cos)
    return _with_extrema(sin, first, last, 1), _with_extrema(cos, first, last, 0)


def _with_extrema(ends: Bounds, first: int, last: int, top: int) -> Bounds:
    """Add the maximum 1 at m pi/2, m = top mod 4, and the minimum -1 at m = top + 2 mod 4.

    first and last are the floors of the ends over pi/2, so the multiples m pi/2 inside have
    first < m <= last, or are the lower end itself, which is then 0. Between them both functions
    are monotone.
    """
    low, high = ends
    if (last - top) // 4 > (first - top) // 4:
        high = fone
    if (last - top - 2) // 4 > (first - top - 2) // 4:
        low = mpf_neg(fone)
    return low, high


def tan(x: Bounds, precision: int) -> Bounds:
    """Return the range of tan; DomainError where a pole is inside.

    It increases between the poles, the odd multiples of pi/2. If X = [a, b] is shorter than pi
    and a pole is inside, then tan b = tan(b - pi) < tan a, as b - pi and a are in one branch.
    """
    function = tightest.FUNCTIONS["tan"]
    low = high = function(x[0], precision)
    if x[0] != x[1]:
        high = function(x[1], precision)
        short = mpf_lt(mpf_sub(x[1], x[0], 10, UP), _THREE)
        if not (short and mpf_lt(low[1], high[0])):  # it may rise, and yet not be seen to
            first, last = (tightest.sincos(end, 10)[2] for end in x)
            if (first + 1) // 2 != (last + 1) // 2:
                raise DomainError("tan of an interval that contains a pole")
    return low[0], high[1]


def angle(y: Bounds, x: Bounds, precision: int) -> Bounds:
    """Return the range of the angle of the points (x, y), for a box off the cut, y not below 0.

    On such a box, without the origin, the angle takes its extremes at two corners, those at which
    a ray from the origin touches the box; so it does where Y has both signs and X > 0.
    """
    left, low = x[0][0], y[0][0]
    first = (y[0], x[0]) if low else (y[1] if x[1][0] else y[0], x[1])
    last = (y[0] if left else y[1], x[0])
    return tightest.atan2(*first, precision)[0], tightest.atan2(*last, precision)[1]


def length(x: Bounds, y: Bounds, precision: int) -> Bounds:
    """Return the range of sqrt(x^2 + y^2), for X >= 0 and Y >= 0."""
    low, _ = tightest.hypot(x[0], y[0], precision)
    return low, tightest.hypot(x[1], y[1], precision)[1]


def power(x: Bounds, y: Bounds, precision: int) -> Bounds:
    """Return the range of x^y for real y; the domain is x > 0, and x = 0 with y > 0.

    x^y has its extremes at corners of the box, since y log x is linear in each factor; where
    y has one sign, one corner each.
    """
    if x[0][0] or (x[0] == fzero and (y[0][0] or y[0] == fzero)):
        raise DomainError("pow leaves x > 0, or x = 0 with y > 0")
    if y[0][0] and not y[1][0]:
        corners = [tightest.power(a, b, precision) for a in x for b in y]
        return extremes([c[0] for c in corners])[0], extremes([c[1] for c in corners])[1]
    least, most = x[::-1] if y[0][0] else x
    first = (least, y[1] if mpf_lt(least, fone) else y[0])
    last = (most, y[0] if mpf_lt(most, fone) else y[1])
    low, high = tightest.power(*first, precision)
    return low, high if first == last else tightest.power(*last, precision)[1]


def integer_power(x: Bounds, n: int, precision: int) -> Bounds:
    """Return the range of x^n, n >= 1, X >= 0 for even n; or, decreasing, for n < 0 and X > 0."""

    def at(end: Raw) -> Bounds:
        if n > 0:
            return tightest.integer_power(end, n, precision)
        return tightest.power(end, from_int(n), precision)

    left, right = x if n > 0 else x[::-1]
    low, high = at(left)
    return low, high if left == right else at(right)[1]
