"""exp, exp2, exp10 and expm1 of binary64 numbers, as pairs with a proved error.

Theorem. For |s| <= 0.00543 and |t| <= 2^-7 u, u = 2^-53, `_series` returns v, |v| < 2^-15.9, with
|exp(s + t) - 1 - s - v| <= 2^-13.8 u, and 2^-14.4 u where |t| <= 2^-8 u.

Proof. exp(s + t) = 1 + s + z/2 + z s q + t (1 + s) + rest, z = s^2, q = 1/3! + s/4! + ... + s^4/7!.
Errors in units of u: 2^-17 from fl(s^2) in z/2; 2^-22 from fl(fl(z s) q); 2^-17 from each of two
sums below 2^-15.9; 2^-22 from the tail, s^8 / 8!; 2^-15.4 from t s (2^-14.4 where |t| <= 2^-7 u).

Powers. With n = 64 e + j, 0 <= j < 64, and 2^(j/64) = T + T', 2^(n/64) exp(s + t) is 2^e (T + T s +
(T v + T')) up to T' (s + v), where T is a multiple of 2^-52, |T'| <= 2^-53. Errors in units of u,
beside a value above 0.99: 2^-7 from fl(T s) < 2^-6; 2 * 2^-13.8; 2^-7.5 from T' s; 2^-14.9 from
each of three sums below 2^-14.8: below 0.0136, and T + fl(T s) is exact in two parts. Measured on a
million points: exp, exp2, exp10 0.009 u, expm1 0.008 u.

Reduction. x = n c + r with c = log(2) / 64 and n = round(x / c), |n| < 2^17. c = C1 + C2 + d, C1 a
multiple of 2^-42, |C2| < 2^-43, |d| < 2^-96. n C1 has 53 bits and is exact. a = x - n C1 is exact:
if n != 0, then |x| > 2^-8, so both are multiples of 2^-60, and |a| < 2^-7. b = fl(n C2), below
2^-26, errs by 2^-80 (with a low part of x by 2^-79), and s + t = a - b up to 2^-77 (Dekker if
|a| >= |b|; else s is below 2^-25). |s| <= c / 2 + 2^-40, |t| <= 2^-8 u. So r is known to 2^-23 u.
exp2: x - n/64 is exact; exp10: x - n log10(2) / 64 is reduced likewise, log10(2) / 64 in two parts,
the first a multiple of 2^-43. The products with log 2 and log 10, of pairs, have |t| <= 2^-7 u and
err by less than 2^-20 u |s|.
"""

from functools import lru_cache
from itertools import accumulate
from math import factorial, isqrt
from typing import Any

from intervals.elementary.binary64.pair import Pair, fast_two_sum, two_sum
from intervals.elementary.binary64.primitives import (
    BITS,
    Table,
    horner,
    nearest_integers,
    power_of_two,
    split,
    tables,
)

_number = float.fromhex
_STEPS = 64
_STEPS_E, _STEPS_10 = _number("0x1.71547652b82fep+6"), _number("0x1.a934f0979a371p+7")
LN_2 = Pair(_number("0x1.62e42fefa39efp-1"), _number("0x1.abc9e3b39803fp-56"))
LN_10 = Pair(_number("0x1.26bb1bbb55516p+1"), _number("-0x1.f48ad494ea3e9p-53"))
STEP_E = _number("0x1.62e42fefa0000p-7"), _number("0x1.cf79abc9e3b3ap-46")
STEP_10 = _number("0x1.3441350a00000p-8"), _number("-0x1.0c0219dc1da99p-45")
_TAYLOR = tuple(1.0 / factorial(k) for k in range(7, 2, -1))


def exp(x: Pair) -> Pair:
    """Return exp x for -660 <= x <= 709; k = 2^-6 + 710 k_x.

    The error of r is beside a value of at least 0.99, and an error of x, at most 710 k_x u, is a
    relative one of exp x.
    """
    y = _exponential(*_halves(x.hi, x.lo, _STEPS_E, STEP_E))
    return Pair(y.hi, y.lo, y.k + 710.0 * x.k)


def exp2(x: Pair) -> Pair:
    """Return 2^x for |x| <= 950 and x.lo = 0: as exp, since x - n/64 is exact."""
    rest, n = nearest_integers(x.hi * _STEPS)
    r = Pair(x.hi - rest * (1 / _STEPS)) * LN_2
    return _exponential(r.hi, r.lo, n)


def exp10(x: Pair) -> Pair:
    """Return 10^x for -285 <= x <= 308 and x.lo = 0: as exp."""
    high, low, n = _halves(x.hi, 0.0, _STEPS_10, STEP_10)
    r = Pair(high, low) * LN_10
    return _exponential(r.hi, r.lo, n)


def expm1(x: Pair) -> Pair:
    """Return exp x - 1 for -660 <= x <= 709, x.lo = 0, and 2^-400 <= |x| or x = 0; k = 1/16.

    Here T is a multiple of 2^-25, |T'| <= 2^-26, known to 2^-79, and s = a + b, of 26 bits each, so
    that T a, at most 0.0109, is exact. exp x - 1 = (2^e T - 1) + 2^e T a + 2^e w, where
    w = (T + T') v + T b + T' s + T' is below 2^-14.8.
    If n = 0, then T = 1, T' = t = 0: the error is at most 5 roundings of parts below 0.003 |s| and
    the tail, at most 2^-67 |s|. Else 2^e T - 1 is exact in two parts, the first of which is larger
    than 2^e T a. In units of 2^e u, 2^-13.4 from v, 2^-22 from r, and 7 roundings of numbers below
    2^-14.8, at most 2^-12.9: together 2^-12.1, beside |exp x - 1| >= 0.0053 * 2^e: 0.043.
    """
    s, t, n = _halves(x.hi, 0.0, _STEPS_E, STEP_E)
    j, power, w = n & (_STEPS - 1), power_of_two(n >> 6), _series(s, t)
    heads, rests = _powers(25)
    h, h_low = heads[j], rests[j]
    head, tail = split(s)
    w *= h + h_low
    w += h * tail
    w += h_low * s
    w += h_low
    w *= power
    h *= power
    high, low = two_sum(h, -1.0)
    w += low
    high, low = fast_two_sum(high, h * head)
    low += w
    return Pair(*fast_two_sum(high, low), 2.0**-4)


def _exponential(s: Any, t: Any, n: Any) -> Pair:
    """Return 2^(n/64) exp(s + t)."""
    heads, rests = _powers(52)
    j = n & (_STEPS - 1)
    h = heads[j]
    high, low = fast_two_sum(h, h * s)
    w = _series(s, t)
    w *= h
    w += rests[j]
    low += w
    return Pair(high, low, 2.0**-6).scaled(power_of_two(n >> 6))


def _halves(x: Any, low: Any, inverse: float, parts: tuple[float, float]) -> tuple[Any, Any, Any]:
    """Return s, t, n with x + low = n c + s + t, c the sum of `parts`, 1 / c about `inverse`."""
    n, integers = nearest_integers(x * inverse)
    a = x - n * parts[0]
    return *fast_two_sum(a, low - n * parts[1]), integers


def _series(s: Any, t: Any) -> Any:
    """Return exp(s + t) - 1 - s, see the theorem."""
    z = s * s
    v = horner(s, _TAYLOR)
    v *= z * s
    v += t
    z *= 0.5
    v += z
    return v


@lru_cache(maxsize=2)
def _powers(places: int) -> tuple[Table, Table]:
    """Return 2^(j/64), j < 64, in two parts; as integers, of BITS places, they err by 2^8 units."""
    root = 2 << BITS
    for _ in range(6):
        root = isqrt(root << BITS)
    powers = accumulate(range(1, _STEPS), lambda x, _: x * root >> BITS, initial=1 << BITS)
    return tables(powers, places)
