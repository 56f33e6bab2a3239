"""sin and cos of arrays of intervals in binary64, from +, -, * alone, with a proved error.

Theorem. For binary64 |x| <= 1024, x = 0 or |x| >= 2^-400, `point_sincos` returns S + S' and C + C'
with

    |S + S' - sin x| <= k u |S|,    |C + C' - cos x| <= k u |C|,    u = 2^-53, k = 1/32.

fl is one rounded operation, to nearest. Measured on a million points: 0.005 u for both.

1. Reduction. n = round(fl(64/pi x)), |n| < 2^14.4. x = n pi/64 + r, |r| <= 0.02455.
   pi/64 = P1 + P2 + P3 + d: P1 is a multiple of 2^-42, P2 one of 2^-81, |P2| < 2^-43,
   |P3| < 2^-83, |d| < 2^-136. n P1 (53 bits) and n P2 (53 bits) are exact.
   a = x - n P1 is exact: if n != 0, then |x| > 2^-6, both are multiples of 2^-58, and |a| < 2^-5.
   With b = -n P2, |b| < 2^-28, s = fl(a + b) and e = fl(b - fl(s - a)) satisfy s + e = a + b:
   if |a| >= 2^-28, because |a| >= |b| (Dekker); else s - a, a multiple of 2^-81 of at most 2^-28
   in size, is exact, and e is. If n = 0, then s = x and e = 0.
   t = fl(e - fl(n P3)): |t| <= 2^-59. Next to multiples of pi/2, that is, where 32 divides n != 0,
   |n P3| <= 2^-9 |s| and |s| >= 2^-62 (a test lists the numbers there), so that r and s
   have one sign, and |r - (s + t)| <= 2^-8 u |s|; elsewhere it is below 2^-110.

2. On |r| <= 0.02455, with z = fl(s^2) <= 0.000603: sin r = s + g, g = s z p + t, and cos r = 1 + h,
   h = z^2 q - z/2, p = -1/3! + z/5! - z^2/7!, q = 1/4! - z/6! + z^2/8!.
   g, at most 0.0001 |s| + |t|, errs by 4 roundings of itself, by z/2 |t|, and the tail, at most
   2^-66; h, up to 0.000302, by 2.5 of itself, by |s t| <= 2^-64 and the tail, at most 2^-75.

3. With A = sin(n pi/64), B = cos(n pi/64), for cos x with A = cos(n pi/64), B = -sin(n pi/64), the
   result is f = A + B s + A h + B g. A = A1 + A2, A1 a multiple of 2^-26, |A2| <= 2^-27, known to
   2^-80; B likewise. s = s1 + s2, both of 26 bits. B1 s1 is exact, its sum with A1 is in two parts
   (Dekker: if A1 != 0, then |A1| >= 0.049). The rest is w = B g + B2 s + B1 s2 + A2 + A h.
   If 32 does not divide n, then |A| <= 2.01 |f| and |f| >= 0.0245. In units of u:
   6.5 * 0.000302 |A| from A h and its sums with the others; 0.0004 |A| from s t; 2^-16.6 from four
   roundings of B g and sums with it; 2^-13 from the tail of B g; 2^-26 each from three others:
   together below 0.0048 |f| + 0.00014, that is, below 0.02 |f|.
   If 32 divides n, and A = 0, B = +-1: relative to |s|, the reduction's 2^-8, and 5 roundings of
   |t| + 0.0001 |s| + |s2|, |t| <= (2^-9 + 2^-53) |s|: below 0.015. If A = +-1, B = 0, then
   |f| > 0.999, and the errors are the first ones.

4. Extrema. x >= m pi/2 if and only if n > 32 m, or n = 32 m and s >= 0: see `quarters`.

tan over arrays of intervals, in binary64.
"""

from collections.abc import Sequence
from fractions import Fraction
from functools import lru_cache, partial
from math import factorial, inf, isqrt
from typing import Any

import numpy as np

from intervals.elementary.binary64 import fallback
from intervals.elementary.binary64.blocks import Mask, in_blocks, moderate
from intervals.elementary.binary64.fallback import Ends
from intervals.elementary.binary64.pair import Bounds, Pair, bounds, fast_two_sum
from intervals.elementary.binary64.primitives import (
    BITS,
    Table,
    horner,
    nearest_integers,
    split,
    tables,
)
from intervals.errors import DomainError
from intervals.rounding import Rows, all_of, constant, float_down, float_up
from intervals.rows import is_thin

LIMIT = 1024.0

_STEPS = 128  # of pi/64 in a turn
_PER_STEP = float.fromhex("0x1.45f306dc9c883p+4")
_P1 = float.fromhex("0x1.921fb54440000p-5")
_P2 = float.fromhex("0x1.68c234c4c8000p-44")
_P3 = float.fromhex("-0x1.9d747f23e32edp-84")
_NEAR, _ONE = constant(LIMIT), constant(1.0)
_PEAKS = (3, 1, 2, 0)  # in quarters, of -sin, sin, -cos, cos

_SIN = tuple((-1) ** (k // 2) / factorial(k) for k in range(7, 2, -2))
_COS = tuple((-1) ** (k // 2) / factorial(k) for k in range(8, 3, -2))

_ERROR = 2.0**-5  # in units of u: the theorem


def sincos(rows: Rows, rounded: Bounds = bounds) -> tuple[Rows, Rows]:
    """Return rows of sin X and cos X for the intervals X of `rows`, (-lower, upper) each.

    Both lie in [-1, 1]. Where the theorem does not hold the multiprecision `Interval` answers,
    element by element; elsewhere the theorem, at the endpoints, with the extrema between them.
    """
    both = in_blocks(partial(_sincos, rounded), _exactly, rows, few=partial(_few, rounded))
    return both[0], both[1]


def _exactly(x: Ends) -> tuple[Ends, Ends]:
    """Return bounds of sin and cos over [x[0], x[1]], from the multiprecision functions."""
    from intervals.interval import Interval

    if not x[1] - x[0] < inf:
        return (-1.0, 1.0), (-1.0, 1.0)
    y = Interval(*map(Fraction, x), precision=80)
    sin, cos = y.sin(), y.cos()
    return (float_down(sin.inf), float_up(sin.sup)), (float_down(cos.inf), float_up(cos.sup))


def _sincos(rounded: Bounds, rows: Rows) -> tuple[Rows, Mask]:
    """Do `sincos` for one block: rows of sin X and of cos X, and where they are proved."""
    both, thin = np.empty((2, *rows.shape)), is_thin(rows)
    proved = moderate(rows[1] if thin else rows, large=_NEAR)
    if thin:
        sin, cos, _, _ = point_sincos(rows[1])
        for side, bound in zip((*rounded(sin), *rounded(cos)), both.reshape(4, -1), strict=True):
            np.minimum(side, _ONE, out=bound)
        return both, proved
    sin, cos, n, s = point_sincos(rows)
    # sin holds sin(-lower) = -sin(lower) beside sin(upper), cos cos(lower) beside cos(upper)
    below, above = rounded(sin)
    np.maximum(above, below[::-1], out=both[0])
    for row, side in zip(both[1], rounded(cos), strict=True):
        np.maximum(side[0], side[1], out=row)
    np.minimum(both, _ONE, out=both)
    # lower is in [first, first + 1) pi/2, upper in [last, last + 1) pi/2
    first, last = quarters(n, s)
    if not all_of(first == last):
        for bound, peak in zip((*both[0], *both[1]), _PEAKS, strict=True):
            np.copyto(bound, _ONE, where=_passes(first, last, peak))
    return both, proved


def _few(rounded: Bounds, a: float, b: float) -> Sequence[float] | None:
    """Do the same for the interval [-a, b], None where it is not proved."""
    if not all(x == 0.0 or 2.0**-400 <= abs(x) <= LIMIT for x in (a, b)):
        return None
    sin, cos, n, s = point_sincos(b)
    (sin_below, sin_above), (cos_below, cos_above) = rounded(sin), rounded(cos)
    if a == -b:
        return [min(x, 1.0) for x in (sin_below, sin_above, cos_below, cos_above)]
    sin, cos, n_a, s_a = point_sincos(a)
    (below, above), cosine = rounded(sin), rounded(cos)
    first, last = quarters((n_a, n), (s_a, s))
    of_sin = max(above, sin_below), max(sin_above, below)
    of_cos = max(cos_below, cosine[0]), max(cos_above, cosine[1])
    return [
        1.0 if _passes(first, last, peak) else min(x, 1.0)
        for x, peak in zip((*of_sin, *of_cos), _PEAKS, strict=True)
    ]


def quarters(n: Any, s: Any) -> tuple[Any, Any]:
    """Return floor(lower / (pi/2)) and floor(upper / (pi/2)) from `point_sincos` of rows.

    But where lower is 0 the first is -1 or 0.
    """
    return (-n[0] - (s[0] > 0.0)) >> 5, (n[1] - (s[1] < 0.0)) >> 5


def _passes(first: Any, last: Any, peak: int) -> Any:
    """Return where first < j <= last for some j = peak mod 4, that is, j pi/2 is in (lower, upper].

    An extremum at lower itself needs no mention: the value at that endpoint encloses it.
    """
    return (first - peak) >> 2 != (last - peak) >> 2


def point_sincos(x: Any) -> tuple[Pair, Pair, Any, Any]:
    """Return sin x, cos x (see the theorem), n and s, where x = n pi/64 + s + t."""
    n, index = nearest_integers(x * _PER_STEP)
    s, t = _difference(x - n * _P1, n * _P2)
    n *= _P3
    t -= n
    z = s * s
    g, h = horner(z, _SIN), horner(z, _COS)
    h *= z
    h -= 0.5
    h *= z
    z *= s
    g *= z
    g += t
    index_in_turn = index & (_STEPS - 1)
    (a, a_low), (b, b_low) = (
        (high[index_in_turn], low[index_in_turn]) for high, low in _sines_and_cosines()
    )
    head, tail = split(s)
    a_all, b_all = a + a_low, b + b_low
    sine, low = fast_two_sum(a, b * head)
    rest = _times_sine(b, b_low, b_all * g, tail, s)
    rest += a_low
    rest += a_all * h
    low += rest
    cosine, low_cosine = _difference(b, a * head)
    rest = _times_sine(a, a_low, a_all * g, tail, s)
    rest -= b_low
    rest -= b_all * h
    low_cosine -= rest
    return Pair(sine, low, _ERROR), Pair(cosine, low_cosine, _ERROR), index, s


def _times_sine(b: Any, b_low: Any, rest: Any, tail: Any, s: Any) -> Any:
    """Return B sin r less what is exact: B g + B2 s + B1 s2, given the first of these."""
    rest += b_low * s
    rest += b * tail
    return rest


def _difference(a: Any, b: Any) -> tuple[Any, Any]:
    """Do `fast_two_sum` for a - b."""
    s = a - b
    return s, (a - s) - b


@lru_cache(maxsize=1)
def _sines_and_cosines() -> tuple[tuple[Table, Table], tuple[Table, Table]]:
    """Return both parts of sin(n pi/64) and of cos(n pi/64), n < 128.

    As integers, of BITS places, from pi/2 halved five times, they err by 2^11 units.
    """
    one, c = 1 << BITS, 0
    for _ in range(5):
        c = isqrt((one + c) << (BITS - 1))
    s = isqrt((one << BITS) - c * c)
    quarter, x, y = [0], one, 0
    for _ in range(31):
        x, y = (x * c - y * s) >> BITS, (x * s + y * c) >> BITS
        quarter.append(y)
    half = [*quarter, one, *quarter[:0:-1]]
    sines = [*half, *(-value for value in half)]
    return tables(sines, 26), tables(sines[32:] + sines[:32], 26)


_NEAR = constant(LIMIT)


def tan(rows: Rows, rounded: Bounds = bounds) -> Rows:
    """Return rows of tan X; DomainError if an X contains a pole."""
    return in_blocks(partial(_tan, rounded), fallback.tan, rows)


def _tan(rounded: Bounds, rows: Rows) -> tuple[Rows, Mask]:
    """Do `tan` where |x| <= 1024. tan(-x) = -tan x: the rows of tan X are tan of the rows of X.

    No binary64 number is a pole, and `quarters` says exactly between which multiples of pi/2 it is.
    """
    proved = np.all(moderate(rows, large=_NEAR), axis=0)
    sin, cos, n, rest = point_sincos(rows)
    first, last = quarters(n, rest)
    if (proved & ((first + 1) >> 1 != (last + 1) >> 1)).any():  # j pi/2 is inside for an odd j
        raise DomainError("tan of an interval that contains a pole")
    return rounded(sin.normal() / cos.normal())[1], proved
