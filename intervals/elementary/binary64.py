"""sin and cos of arrays of intervals in binary64, from +, -, * alone, with a proved error.

Theorem. For binary64 |x| <= 1024, `_point_sincos` returns S and C with

    |S - sin x| <= 1.7 u |S|,    |C - cos x| <= 1.7 u |C|,    u = 2^-53,

if the processor rounds to nearest (`require_nearest` checks that). fl is one rounded operation.

1. Reduction. n = round(fl(2/pi x)) is read off k = fl(fl(2/pi x) + 1.5 2^52), whose spacing is 1
   and whose last bits are n. |n| <= 652, and fl(2/pi x) errs by less than 2^-42, so r = x - n pi/2
   has |r| < pi/4 + 2^-41. pi/2 = P1 + P2 + P3 + d: P1 is a multiple of 2^-42, P2 one of 2^-84,
   |P2| < 2^-43, |P3| < 2^-85, |d| < 2^-141. n P1 (53 bits) and n P2 (51 bits) are exact.
   a = x - n P1 is exact: if n != 0, then |x| > 1/2, both are multiples of 2^-53, and |a| < 1.
   With b = -n P2, |b| < 2^-33, s = fl(a + b) and e = fl(b - fl(s - a)) satisfy s + e = a + b:
   if |a| >= 2^-33, because |a| >= |b| (Dekker); else a + b, a multiple of 2^-84 below 2^-32,
   is a binary64 number, and s = a + b, s - a = b, e = 0. If n = 0, then s = x and e = 0.
   t = fl(e - fl(n P3)): |e| <= u/2 and |e| <= u |s|, |n P3| < 2^-75. Among the binary64 numbers
   next to n pi/2, 1 <= n <= 652, none is within 2^-61 (the nearest is next to 29 pi/2; a test
   lists them all). So |s| > 2^-62 if n != 0, r and s have one sign, and
       |t| <= 2^-12 |s|,    |t| <= u/2 + 2^-75,
       |r - (s + t)| <= 652 |d| + u 2^-75 + u |t| <= 2^-10 u |s|.

2. cos r, with z = fl(s^2) <= 0.617. C = fl(1 - fl(z/2 - fl(fl(fl(z^2) q) - fl(s t)))), q being
   Taylor's 1/4! - z/6! + ... + z^6/16! in Horner's form. Absolute errors in units of u: 0.25 from
   z in z/2 (half the spacing of z < 1 is u/2); 0.10 from fl(z^2 q) <= 0.016, namely four relative
   errors of u (z twice, z^2, the product) and 0.38 times 0.08 from q, since the coefficient 1/4!
   and the last sum have half-spacing u/32 and the others far less; 0.02 from subtracting s t;
   0.02 from the tail, at most z^9/18!; 0.05 from s t in place of t sin s, |t| |s|^3 / 6; 0.25 from
   fl(z/2 - ...) < 1/2; 0.5 from the last rounding, as C <= 1; 0.01 from step 1 and t^2.
   The sum is 1.2, and cos r > 0.707, so the error is below 1.7 u |C|.

3. sin r. S = fl(s + fl(fl(fl(s z) p) + fl(t C))), p = -1/3! + z/5! - ... + z^7/17!. Errors in
   units of u |s|: 0.31 from three relative errors (z, s z, the product) of a number <= 0.103 |s|;
   0.17 = 0.617 * 0.27 from p, since -1/3! and the last sum have half-spacing u/8; 0.11 from the
   sum with t C; 0.01 from the tail, at most z^9/19!; 0.01 from step 1, t C and t^2. The sum is
   0.61, |s| <= 1.111 |sin r|, and the last rounding adds u |S|: below 1.7 u |S|.
   Underflow takes n = 0 and |s| < 2^-100. Then t = 0 and the correction, below 2^-200 |s| + eta
   with eta = 2^-1074, vanishes beside u |s| if |s| >= 2^-540; else z = 0, S = s, |s|^3 / 6 < u |s|.

4. Quadrant. n mod 4 says which of +-S, +-C are sin x and cos x; this is exact.

Outward step (`_outward`): y + d, d = fl(fl(2.75 u |y|) + eta). The inner rounding loses at most
eta / 2 or 3 u^2 |y|, so d > 2.75 u |y| (1 - 2u). If |y| < 2^-1021 the sum y + d is exact. Else
rounding it to nearest loses at most u (1 + 3u) |y|. Both leave more than y + 1.7 u |y|.
"""

from fractions import Fraction
from math import factorial

import numpy as np
from numpy.typing import NDArray

from intervals.rounding import ETA, Rows, float_down, float_up, require_nearest

LIMIT = 1024.0
CHUNK = 16384  # elements at a time: the temporaries stay in the cache

_TWO_OVER_PI = float.fromhex("0x1.45f306dc9c883p-1")
_P1 = float.fromhex("0x1.921fb54442c00p+0")
_P2 = float.fromhex("0x1.18469898cc000p-44")
_P3 = float.fromhex("0x1.45c06e0e68948p-86")
_SHIFT = 1.5 * 2.0**52
_SHIFT_BITS = 0x4338000000000000  # the bits of _SHIFT

_SIN = tuple((-1) ** (k // 2) / factorial(k) for k in range(17, 2, -2))
_COS = tuple((-1) ** (k // 2) / factorial(k) for k in range(16, 3, -2))

_STEP = 2.75 * 2.0**-53

Quadrants = NDArray[np.int64]


def sincos(rows: Rows) -> tuple[Rows, Rows]:
    """Return rows of sin X and cos X for the intervals X of `rows`, (-lower, upper) each.

    Both lie in [-1, 1]. Where |x| > 1024 occurs the multiprecision `Interval` answers, element
    by element; elsewhere the theorem above, at the endpoints, with the extrema between them.
    """
    require_nearest()
    flat = rows.reshape(2, -1)
    sin, cos = np.empty_like(flat), np.empty_like(flat)
    far = ~(np.max(np.abs(flat), axis=0) <= LIMIT)
    near = np.where(far, 0.0, flat) if far.any() else flat
    for start in range(0, flat.shape[1], CHUNK):
        part = slice(start, start + CHUNK)
        sin[:, part], cos[:, part] = _chunk(near[:, part])
    for index in np.flatnonzero(far):
        sin[:, index], cos[:, index] = _multiprecision(*flat[:, index].tolist())
    return sin.reshape(rows.shape), cos.reshape(rows.shape)


def _multiprecision(minus_lower: float, upper: float) -> tuple[tuple[float, float], ...]:
    """Return the rows of sin and cos of one interval, from the multiprecision functions."""
    from intervals.interval import Interval

    x = Interval(Fraction(-minus_lower), Fraction(upper), precision=80)
    return tuple((-float_down(y.inf), float_up(y.sup)) for y in (x.sin(), x.cos()))


def _chunk(rows: Rows) -> tuple[Rows, Rows]:
    """Do `sincos` for one chunk within the limit."""
    if np.array_equal(-rows[0], rows[1]):
        sin, cos, _, _ = _point_sincos(rows[1])
        return _outward(np.stack((-sin, sin))), _outward(np.stack((-cos, cos)))
    s, c, n, r = _point_sincos(rows)
    # s holds sin(-lower) = -sin(lower) beside sin(upper), and c cos(lower) beside cos(upper)
    sin = _outward(np.maximum(s, -s[::-1]))
    cos = _outward(np.stack((-np.minimum(c[0], c[1]), np.maximum(c[0], c[1]))))
    # lower is in [first, first + 1) pi/2, upper in [last, last + 1) pi/2
    first, last = -n[0] - (r[0] > 0.0), n[1] - (r[1] < 0.0)
    for bounds, peak in ((sin[1], 1), (sin[0], 3), (cos[1], 0), (cos[0], 2)):
        np.copyto(bounds, 1.0, where=_passes(first, last, peak))
    return sin, cos


def _passes(first: Quadrants, last: Quadrants, peak: int) -> NDArray[np.bool_]:
    """Return where first < j <= last for some j = peak mod 4, that is, j pi/2 is in (lower, upper].

    An extremum at lower itself needs no mention: the value at that endpoint encloses it.
    """
    passed: NDArray[np.bool_] = (first - peak) >> 2 != (last - peak) >> 2
    return passed


def _outward(y: Rows) -> Rows:
    """Take the outward step, in place, and stay in [-1, 1]."""
    step = np.abs(y)
    step *= _STEP
    step += ETA
    y += step
    return np.minimum(y, 1.0, out=y)


def _horner(z: Rows, coefficients: tuple[float, ...]) -> Rows:
    """Return the polynomial in z, highest coefficient first."""
    total = z * coefficients[0]
    for coefficient in coefficients[1:-1]:
        total += coefficient
        total *= z
    total += coefficients[-1]
    return total


def _point_sincos(x: Rows) -> tuple[Rows, Rows, Quadrants, Rows]:
    """Return sin x, cos x (see the theorem), the quadrant n and s, where x = n pi/2 + s + t."""
    n = x * _TWO_OVER_PI
    n += _SHIFT
    quadrant = n.view(np.int64) - _SHIFT_BITS
    n -= _SHIFT
    a = x - n * _P1
    b = n * -_P2
    s = a + b
    t = b - (s - a)
    n *= _P3
    t -= n
    z = s * s
    cos = _horner(z, _COS)
    cos *= z * z
    cos -= s * t
    half = z * 0.5
    np.subtract(half, cos, out=cos)
    np.subtract(1.0, cos, out=cos)
    sin = _horner(z, _SIN)
    z *= s
    sin *= z
    t *= cos
    sin += t
    sin += s
    _turn(sin, cos, quadrant)
    return sin, cos, quadrant, s


def _turn(sin: Rows, cos: Rows, quadrant: Quadrants) -> None:
    """Replace sin r, cos r by those of r + quadrant pi/2, in place, on the bits of the numbers.

    An odd quadrant exchanges them; bit 1 of quadrant is the sign of sin, of quadrant + 1 that of
    cos.
    """
    s, c, n = sin.view(np.uint64), cos.view(np.uint64), quadrant.view(np.uint64)
    exchange = (s ^ c) & -(n & 1)
    s ^= exchange
    c ^= exchange
    s ^= (n & 2) << 62
    c ^= ((n + 1) & 2) << 62
