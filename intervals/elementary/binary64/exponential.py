"""exp, exp2, exp10 and expm1 of binary64 numbers, as pairs with a proved error.

Theorem. For |s| <= 0.3467 and |t| <= 0.6 u, u = 2^-53, `_core` returns w with
|exp(s + t) - 1 - s - w| <= 0.25 u if s >= 0, and 0.21 u if s < 0.

Proof. exp(s + t) = 1 + s + (z/2 + z s q + t (1 + s)) + rest, z = s^2, q = 1/3! + s/4! + ... +
s^10/13!. Errors in units of u, for s >= 0 and, in brackets, for s < 0:
0.061 from fl(s^2) in z/2 (0.061);
0.035 from fl(fl(z s) q), 4.5 relative errors of at most 0.0077 (0.030, of at most 0.0064);
0.005 from adding fl(t fl(1 + s)), since the sum is below 2^-6 (0.005);
0.063 from adding z/2, since the sum is below 2^-3 (0.032: below 2^-4);
0.040 from the tail, at most 1.03 |s|^14 / 14! (0.040);
0.040 from the other products with t, at most 0.066 |t| (0.037).
The sums are 0.244 and 0.205.
Measured on a million points: exp 0.16, exp2 0.15, exp10 0.20, expm1 0.73 u.

Reduction. x = n log 2 + r with n = round(x / log 2), |n| <= 1023. log 2 = L1 + L2 + d, L1 a
multiple of 2^-42, |L2| < 2^-43, |d| < 2^-98. n L1 has 53 bits and is exact. a = x - n L1 is exact:
if n != 0, then |x| > 1/3, so both are multiples of 2^-54, and |a| < 1/2. b = fl(n L2), below 2^-32,
errs by 2^-86 (with a low part of x by 2^-85), and s + t = a - b up to 2^-84 (Dekker if |a| >= |b|;
else both are below 2^-32). |s| <= log(2)/2 + 2^-40, |t| <= u/4. So r is known to 2^-30 u.
exp2: x - n is exact; exp10: x - n log10 2 is reduced likewise, log10 2 in two parts, the first a
multiple of 2^-43. The products with log 2 and log 10, of pairs, have |lo| <= 0.6 u and err by less
than 2^-20 u.
"""

from math import factorial

import numpy as np
from numpy.typing import NDArray

from intervals.elementary.binary64.pair import Pair, fast_two_sum, two_sum
from intervals.elementary.binary64.polynomial import horner, nearest_integers, polynomial
from intervals.rounding import Rows, constant


def _number(text: str) -> Rows:
    return constant(float.fromhex(text))


_LOG2_E, _LOG2_10 = _number("0x1.71547652b82fep+0"), _number("0x1.a934f0979a371p+1")
LOG_2 = _number("0x1.62e42fefa3800p-1"), _number("0x1.ef35793c76730p-45")
LOG10_2 = _number("0x1.34413509f7800p-2"), _number("0x1.fef311f12b358p-46")
LN_2 = Pair(_number("0x1.62e42fefa39efp-1"), _number("0x1.abc9e3b39803fp-56"))
LN_10 = Pair(_number("0x1.26bb1bbb55516p+1"), _number("-0x1.f48ad494ea3e9p-53"))
_ZERO, _HALF, _ONE = map(constant, (0.0, 0.5, 1.0))
_BIAS, _TO_EXPONENT = np.array(1023), np.array(52)

Integers = NDArray[np.int64]

_TAYLOR = polynomial(1.0 / factorial(k) for k in range(13, 2, -1))


def exp(x: Pair) -> Pair:
    """Return exp x for -660 <= x <= 709.

    k: 1 + s is exact in two parts, and adding w rounds below 2^-3, for s < 0 below 2^-4:
    0.25 + 0.063 beside exp r >= 1, or 0.21 + 0.032 beside exp r >= 0.707. In both cases below 0.36.
    An error of x, at most 710 k_x u, is a relative one of exp x.
    """
    y = _exponential(*_halves(x.hi, x.lo, _LOG2_E, LOG_2))
    return Pair(y.hi, y.lo, y.k + 710.0 * x.k)


def exp2(x: Pair) -> Pair:
    """Return 2^x for |x| <= 950 and x.lo = 0: as exp, since x - n is exact."""
    rest, n = nearest_integers(x.hi.copy())
    r = Pair(x.hi - rest) * LN_2
    return _exponential(r.hi, r.lo, n)


def exp10(x: Pair) -> Pair:
    """Return 10^x for -285 <= x <= 308 and x.lo = 0: as exp."""
    high, low, n = _halves(x.hi, _ZERO, _LOG2_10, LOG10_2)
    r = Pair(high, low) * LN_10
    return _exponential(r.hi, r.lo, n)


def expm1(x: Pair) -> Pair:
    """Return exp x - 1 for -660 <= x <= 709, x.lo = 0, and 2^-400 <= |x| or x = 0.

    2^n - 1 is exact if |n| <= 53, and its sum with 2^n s is exact in two parts. k: if n = 0, then
    t = 0, and w has relative to s, in units of u, 0.174 from z/2, 0.1 from z s q, 0.2 from their
    sum, 0.115 from the tail; for s < 0 with 0.155 in place of 0.2, and |s| <= 1.184 |exp s - 1|:
    below 0.65. If n = 1, the errors 2 * 0.21 and 0.063 = 2^-4 from adding w are beside
    exp x - 1 >= 0.414: below 1.2. All other n leave less: n = 2 at most (4 * 0.25 + 0.125) / 1.82,
    2 < n <= 53 at most 0.32 / (0.707 - 1/8), n < 0 at most 0.2 / 0.29. Beyond |n| = 53 rounding
    2^n - 1 adds at most 0.5: with the others 0.75 beside 0.707, or 0.82 beside 1.
    """
    s, t, n = _halves(x.hi, _ZERO, _LOG2_E, LOG_2)
    power = power_of_two(n)
    high, low = two_sum(power - _ONE, power * s)
    high, low = fast_two_sum(high, low + power * _core(s, t))
    return Pair(high, low, 1.2)


def _exponential(s: Rows, t: Rows, n: Integers) -> Pair:
    """Return 2^n exp(s + t)."""
    high, low = fast_two_sum(_ONE, s)
    low += _core(s, t)
    return Pair(*fast_two_sum(high, low), 0.36).scaled(power_of_two(n))


def _halves(
    x: Rows, low: Rows, inverse: Rows, parts: tuple[Rows, Rows]
) -> tuple[Rows, Rows, Integers]:
    """Return s, t, n with x + low = n c + s + t, c the sum of `parts`, 1 / c about `inverse`."""
    n, integers = nearest_integers(x * inverse)
    a = x - n * parts[0]
    n *= parts[1]
    n = low - n
    return *fast_two_sum(a, n), integers


def _core(s: Rows, t: Rows) -> Rows:
    """Return exp(s + t) - 1 - s, see the theorem."""
    z = s * s
    w = horner(s, _TAYLOR)
    w *= z * s
    w += t * (_ONE + s)
    z *= _HALF
    w += z
    return w


def power_of_two(n: Integers) -> Rows:
    """Return 2^n for -1022 <= n <= 1023, from its bits."""
    bits: Integers = (n + _BIAS) << _TO_EXPONENT
    return bits.view(np.float64)
