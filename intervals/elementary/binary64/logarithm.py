"""log, log2, log10, log1p of binary64 numbers, as pairs with a proved error.

Theorem. For a binary64 number f, -0.293 <= f <= 0.4143, `_series` returns w with
|log(1 + f) - (f - w)| <= 0.7 u |log(1 + f)|, u = 2^-53.

Proof. With s = f / (2 + f), |s| <= 0.1717, z = s^2 <= 0.0295,
log(1 + f) = f - w,  w = h - s (h + R),  h = f^2 / 2,  R = z (2/3 + 2/5 z + ... + 2/21 z^9),
up to 2 |s| z^11 / 23, which is below 0.01 u |f|. Errors in units of u, for f = 0.4143 and, in
brackets, f = -0.293, where |log(1 + f)| >= 0.3465; their bounds are at least quadratic in f, so
that nearer to 0 they fall faster than |log(1 + f)| does.
0.072 from h, 0.0858 (1 - s) (0.051);
0.037 from s, two relative errors of s (h + R) <= 0.0183 (0.022);
0.027 from R, at most 7.5 relative errors of s R <= 0.0035 (0.027);
0.019 each from h + R and from the product with s (0.011 each);
0.068 from the last difference, which is w (0.054).
The sums are 0.242 and 0.176, below 0.7 * 0.3465. Measured on a million points: log, log2, log10
0.49 u, log1p 0.52 u.

Exponent. x = m 2^k, 0.7071 <= m <= 1.4143 with f = m - 1 exactly. k c = k C1 + k C2 up to 2^-85,
where c, the logarithm of 2, is C1 + C2, C1 a multiple of 2^-43, so that k C1 is exact. If k != 0,
then |k c| >= 2 |log m| up to 10^-4, in any base, so the result is no smaller than |log m| up to
10^-4, and the relative error of log m bounds that of the result.
"""

import numpy as np

from intervals.elementary.binary64.exponential import LN_2, LN_10, LOG10_2, LOG_2, Integers
from intervals.elementary.binary64.pair import EPSILON, Pair, fast_two_sum, two_sum
from intervals.elementary.binary64.polynomial import horner, polynomial
from intervals.rounding import Rows, constant

_LEAST_MANTISSA = np.array(0x3FE6A09E667F3BCD)  # the bits of sqrt(1/2), rounded up
_SERIES = polynomial(2.0 / (2 * j + 1) for j in range(10, 0, -1))
_HALF, _ONE, _TWO = map(constant, (0.5, 1.0, 2.0))
_TO_EXPONENT = np.array(52)
_PER_LN_2, _PER_LN_10 = Pair(_ONE) / LN_2, Pair(_ONE) / LN_10


def log(x: Pair) -> Pair:
    """Return log x for normal x > 0, x.lo = 0."""
    k, m = mantissa(x.hi)
    return _with_exponent(k, _log_of_mantissa(m), LOG_2)


def log2(x: Pair) -> Pair:
    """Return log2 x for normal x > 0, x.lo = 0: k + log(m) / log 2."""
    k, m = mantissa(x.hi)
    return _with_exponent(k, _log_of_mantissa(m) * _PER_LN_2, (_ONE, constant(0.0)))


def log10(x: Pair) -> Pair:
    """Return log10 x for normal x > 0, x.lo = 0: k log10 2 + log(m) / log 10."""
    k, m = mantissa(x.hi)
    return _with_exponent(k, _log_of_mantissa(m) * _PER_LN_10, LOG10_2)


def log1p(x: Pair) -> Pair:
    """Return log(1 + x) for -1 < x <= 2^410, with 2^-400 <= |x| or x = 0; x.lo = 0 where x < 0.

    1 + x.hi = v + e exactly, v = m 2^k. If k = 0 the theorem holds for f = x.hi, and q = x.lo / v
    is the rest of log(1 + x), up to 2^10 u^2 |x|. If k != 0 it holds for f = m - 1, and the rest is
    (e + x.lo) / v, below 2^9 u, up to 2^20 u^2. In both cases subtracting q from w adds a rounding
    of 0.068 u where |log m| >= 0.3465, less nearer to 0: 0.31 / 0.3465 < 0.95 in all. The relative
    error of x > 0 enters unenlarged, since x / (1 + x) <= log(1 + x).
    """
    v, e = two_sum(_ONE, x.hi)
    k, m = mantissa(v)
    near = k == 0
    f = np.where(near, x.hi, m - _ONE)
    w = _series(f) - np.where(near, x.lo, e + x.lo) / v
    return _with_exponent(k, Pair(*fast_two_sum(f, -w), 0.95 + x.k), LOG_2)


def mantissa(x: Rows) -> tuple[Integers, Rows]:
    """Return k and m with x = m 2^k exactly, sqrt(1/2) <= m < sqrt 2 up to an ulp, x normal."""
    bits = x.view(np.int64)
    k = (bits - _LEAST_MANTISSA) >> _TO_EXPONENT
    return k, (bits - (k << _TO_EXPONENT)).view(np.float64)


def _log_of_mantissa(m: Rows) -> Pair:
    f = m - _ONE
    return Pair(*fast_two_sum(f, -_series(f)), 0.7)


def _series(f: Rows) -> Rows:
    """Return f - log(1 + f), see the theorem."""
    s = f / (_TWO + f)
    z = s * s
    rest = horner(z, _SERIES)
    rest *= z
    half = f * f
    half *= _HALF
    rest += half
    rest *= s
    half -= rest
    return half


def _with_exponent(k: Integers, log: Pair, parts: tuple[Rows, Rows]) -> Pair:
    """Return log + k c, where c is the sum of `parts`, see the theorem."""
    exponent = k.astype(np.float64)
    high, low = fast_two_sum(exponent * parts[0], log.hi)
    low += log.lo
    low += exponent * parts[1]
    return Pair(*fast_two_sum(high, low), 1.001 * log.k + EPSILON)
