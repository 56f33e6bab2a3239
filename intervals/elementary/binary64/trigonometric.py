"""sin and cos of arrays of intervals in binary64, from +, -, * alone, with a proved error.

Theorem. For binary64 |x| <= 1024, `point_sincos` returns S + S' and C + C' with

    |S + S' - sin x| <= u |S|,    |C + C' - cos x| <= u |C|,    u = 2^-53,

if the processor rounds to nearest (`require_nearest` checks that), and the bounds of `sincos` at
points are within 3 ulps of the true values. fl is one rounded operation.

1. Reduction. n = round(fl(2/pi x)). |n| <= 652, and fl(2/pi x) errs by less than 2^-42, so
   r = x - n pi/2 has |r| < pi/4 + 2^-41. pi/2 = P1 + P2 + P3 + d: P1 is a multiple of 2^-42, P2 one
   of 2^-84, |P2| < 2^-43, |P3| < 2^-85, |d| < 2^-141. n P1 (53 bits) and n P2 (51 bits) are exact.
   a = x - n P1 is exact: if n != 0, then |x| > 1/2, both are multiples of 2^-53, and |a| < 1.
   With b = -n P2, |b| < 2^-33, s = fl(a + b) and e = fl(b - fl(s - a)) satisfy s + e = a + b:
   if |a| >= 2^-33, because |a| >= |b| (Dekker); else a + b, a multiple of 2^-84 below 2^-32,
   is a binary64 number, and s = a + b, s - a = b, e = 0. If n = 0, then s = x and e = 0.
   t = fl(e - fl(n P3)): |e| <= u/2 and |e| <= u |s|, |n P3| < 2^-75. Among the binary64 numbers
   next to n pi/2, 1 <= n <= 652, none is within 2^-61 (the nearest is next to 29 pi/2; a test
   lists them all). So |s| > 2^-62 if n != 0, r and s have one sign, and
       |t| <= 2^-12 |s|,    |t| <= u/2 + 2^-75,
       |r - (s + t)| <= 652 |d| + u 2^-75 + u |t| <= 2^-10 u |s|.

Measured on a million points: 0.77 u for both.

2. cos r, with z = fl(s^2) <= 0.617. C + C' = 1 - h exactly (Dekker), C being fl(1 - h) and
   h = fl(z/2 - fl(fl(fl(z^2) q) - fl(s t))), q being Taylor's 1/4! - z/6! + ... + z^6/16! in
   Horner's form. Absolute errors in units of u: 0.25 from z in z/2 (half the spacing of z < 1 is
   u/2); 0.10 from fl(z^2 q) <= 0.016, namely four relative errors of u (z twice, z^2, the product)
   and 0.38 times 0.08 from q, since the coefficient 1/4! and the last sum have half-spacing u/32
   and the others far less; 0.02 from subtracting s t; 0.02 from the tail, at most z^9/18!; 0.05
   from s t in place of t sin s, |t| |s|^3 / 6; 0.25 from h < 1/2; 0.01 from step 1 and t^2. The sum
   is 0.70, and cos r > 0.707, so the error is below u |C|. Where z < 1/2, that is C > 0.75, the
   errors of z/2 and h are half as large, and the sum is below 0.46.

3. sin r. S + S' = s + g exactly (Dekker), S = fl(s + g), g = fl(fl(fl(s z) p) + fl(t C)),
   p = -1/3! + z/5! - ... + z^7/17!. Errors in units of u |s|: 0.31 from three relative errors (z,
   s z, the product) of a number <= 0.103 |s|; 0.17 = 0.617 * 0.27 from p, since -1/3! and the last
   sum have half-spacing u/8; 0.11 from the sum with t C; 0.01 from the tail, at most z^9/19!; 0.01
   from step 1, t C and t^2. The sum is 0.61, and |s| <= 1.111 |sin r|: below 0.7 u |S|.
   Underflow takes n = 0 and |s| < 2^-100. Then t = 0 and the correction, below 2^-200 |s| + eta
   with eta = 2^-1074, vanishes beside u |s| if |s| >= 2^-540; else z = 0, S = s, |s|^3 / 6 < u |s|.

4. Quadrant. n mod 4 says which of +-sin r, +-cos r are sin x and cos x; this is exact.

5. Outward step. y + fl(y' + d), d = fl(fl((2 + 2^-8) u |y|) + eta). d loses at most eta / 2 or
   3 u^2 |y|, and the inner sum at most 4 u^2 |y|. If |y| < 2^-1021 the outer sum is exact; else
   rounding it to nearest loses at most u (1 + 4u) |y|. Both leave more than y + y' + u |y|.
   In ulps of y (an ulp is u for 1/2 <= |y| < 1, and u |y| at least), the distance to the true value
   is at most its error, d, and 1/2 for the last rounding. cos r > 0.75: 0.46 + 2.01 + 0.5.
   cos r <= 0.75: 0.70 + 2.01 * 0.75 + 0.5. sin r > 1/2: 0.61 * 0.79 + 2.01 * 0.71 + 0.5.
   sin r <= 1/2, that is z < 0.28, where the list of step 3 is 0.14 + 0.08 + 0.05 + 0.02 times
   1.05: 0.31 + 2.01 + 0.5. All are below 3.
"""

from fractions import Fraction
from math import factorial, inf

import numpy as np
from numpy.typing import NDArray

from intervals.elementary.binary64.blocks import in_chunks
from intervals.elementary.binary64.pair import Pair, fast_two_sum
from intervals.elementary.binary64.polynomial import horner, nearest_integers, polynomial
from intervals.rounding import (
    ETA,
    Rows,
    all_of,
    constant,
    float_down,
    float_up,
    require_nearest,
)
from intervals.rows import is_thin

LIMIT = 1024.0

_TWO_OVER_PI = constant(float.fromhex("0x1.45f306dc9c883p-1"))
_P1 = constant(float.fromhex("0x1.921fb54442c00p+0"))
_P2 = constant(float.fromhex("0x1.18469898cc000p-44"))
_P3 = constant(float.fromhex("0x1.45c06e0e68948p-86"))
_ZERO, _HALF, _ONE, _ETA, _NEAR = map(constant, (0.0, 0.5, 1.0, ETA, LIMIT))
_PEAKS, _TWO = [np.array(n) for n in range(4)], np.array(2)
_BIT_0, _BIT_1, _TO_SIGN = (np.array(n, np.uint64) for n in (1, 2, 62))

_SIN = polynomial((-1) ** (k // 2) / factorial(k) for k in range(17, 2, -2))
_COS = polynomial((-1) ** (k // 2) / factorial(k) for k in range(16, 3, -2))

_ERROR = 1.0  # in units of u: the theorem
_STEP = constant((_ERROR + 1.0 + 2.0**-8) * 2.0**-53)

Quadrants = NDArray[np.int64]


def sincos(rows: Rows) -> tuple[Rows, Rows]:
    """Return rows of sin X and cos X for the intervals X of `rows`, (-lower, upper) each.

    Both lie in [-1, 1]. Where |x| > 1024 occurs the multiprecision `Interval` answers, element
    by element; elsewhere the theorem above, at the endpoints, with the extrema between them.
    """
    require_nearest()
    flat = rows.reshape(2, -1)
    near = np.abs(flat) <= _NEAR
    far = () if all_of(near) else np.flatnonzero(~near.all(axis=0))
    if len(far):
        within = flat.copy()
        within[:, far] = 0.0
    else:
        within = flat
    sin, cos = in_chunks(_chunk, within)
    for index in far:
        sin[:, index], cos[:, index] = _multiprecision(*flat[:, index].tolist())
    return sin.reshape(rows.shape), cos.reshape(rows.shape)


def _multiprecision(minus_lower: float, upper: float) -> tuple[tuple[float, float], ...]:
    """Return the rows of sin and cos of one interval, from the multiprecision functions."""
    from intervals.interval import Interval

    if not upper + minus_lower < inf:
        return (1.0, 1.0), (1.0, 1.0)
    x = Interval(Fraction(-minus_lower), Fraction(upper), precision=80)
    return tuple((-float_down(y.inf), float_up(y.sup)) for y in (x.sin(), x.cos()))


def _chunk(rows: Rows) -> Rows:
    """Do `sincos` for one chunk within the limit: rows of sin X and of cos X."""
    both = np.empty((2, *rows.shape))
    sin, cos = both
    if is_thin(rows):
        s, c, _, _ = point_sincos(rows[1])
        sin[0], sin[1] = _bounds(s)
        cos[0], cos[1] = _bounds(c)
        return both
    s, c, n, r = point_sincos(rows)
    # s holds sin(-lower) = -sin(lower) beside sin(upper), and c cos(lower) beside cos(upper)
    lower, upper = _bounds(s)
    np.maximum(upper, lower[::-1], out=sin)
    for row, bounds in zip(cos, _bounds(c), strict=True):
        np.maximum(bounds[0], bounds[1], out=row)
    # lower is in [first, first + 1) pi/2, upper in [last, last + 1) pi/2
    first, last = quarters(n, r)
    if not all_of(first == last):
        for bounds, peak in zip((cos[1], sin[1], cos[0], sin[0]), _PEAKS, strict=True):
            np.copyto(bounds, _ONE, where=_passes(first, last, peak))
    return both


def quarters(quadrant: Quadrants, rest: Rows) -> tuple[Quadrants, Quadrants]:
    """Return floor(lower / (pi/2)) and floor(upper / (pi/2)) from `point_sincos` of rows.

    But where lower is 0 the first is -1 or 0.
    """
    return -quadrant[0] - (rest[0] > _ZERO), quadrant[1] - (rest[1] < _ZERO)


def _passes(first: Quadrants, last: Quadrants, peak: Quadrants) -> NDArray[np.bool_]:
    """Return where first < j <= last for some j = peak mod 4, that is, j pi/2 is in (lower, upper].

    An extremum at lower itself needs no mention: the value at that endpoint encloses it.
    """
    passed: NDArray[np.bool_] = (first - peak) >> _TWO != (last - peak) >> _TWO
    return passed


def _bounds(y: Pair) -> tuple[Rows, Rows]:
    """Return upper bounds of -y and of y, at most 1: the outward step above."""
    step = np.abs(y.hi)
    step *= _STEP
    step += _ETA
    lower = step - y.lo
    lower -= y.hi
    step += y.lo
    step += y.hi
    return np.minimum(lower, _ONE, out=lower), np.minimum(step, _ONE, out=step)


def point_sincos(x: Rows) -> tuple[Pair, Pair, Quadrants, Rows]:
    """Return sin x, cos x (see the theorem), the quadrant n and s, where x = n pi/2 + s + t."""
    n, quadrant = nearest_integers(x * _TWO_OVER_PI)
    s, t = fast_two_sum(x - n * _P1, -(n * _P2))
    n *= _P3
    t -= n
    z = s * s
    cos = horner(z, _COS)
    cos *= z * z
    cos -= s * t
    half = z * _HALF
    np.subtract(cos, half, out=cos)
    sin = horner(z, _SIN)
    z *= s
    sin *= z
    cosine, cos = fast_two_sum(_ONE, cos)
    t *= cosine
    sin += t
    sine, sin = fast_two_sum(s, sin)
    _turn((sine, sin), (cosine, cos), quadrant)
    # an odd quadrant exchanges the errors, too
    return Pair(sine, sin, _ERROR), Pair(cosine, cos, _ERROR), quadrant, s


def _turn(sin: tuple[Rows, Rows], cos: tuple[Rows, Rows], quadrant: Quadrants) -> None:
    """Replace both parts of sin r, cos r by those of r + quadrant pi/2, in place, on the bits.

    An odd quadrant exchanges them; bit 1 of quadrant is the sign of sin, of quadrant + 1 that of
    cos.
    """
    n = quadrant.view(np.uint64)
    odd = -(n & _BIT_0)
    sign_of_sin, sign_of_cos = (n & _BIT_1) << _TO_SIGN, ((n + _BIT_0) & _BIT_1) << _TO_SIGN
    for part_of_sin, part_of_cos in zip(sin, cos, strict=True):
        s, c = part_of_sin.view(np.uint64), part_of_cos.view(np.uint64)
        exchange = s ^ c
        exchange &= odd
        s ^= exchange
        s ^= sign_of_sin
        c ^= exchange
        c ^= sign_of_cos
