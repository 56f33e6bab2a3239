"""The power series of the kernels, for small arguments in fixed point, and their tables.

A kernel moves its argument next to 0 by the addition theorem, with the function at j / 2^8 and at
j / 2^16 from a table, so that few terms remain. The tables are filled when they are asked for; to
share them the kernels work at multiples of 16 bits. Every series takes r exactly as it is given,
0 <= r < 2^(bits - 7), and its errors are floors: a term is divided by small integers, and
multiplied by a power of r once in several terms, which is where the time goes.
"""

from functools import lru_cache
from math import isqrt

from mpmath.libmp import MPZ

from intervals.elementary.constants import arc_of_ratio

COARSE, FINE = 8, 16  # the tables hold the functions at j / 2^COARSE and j / 2^FINE


MASK = (1 << (FINE - COARSE)) - 1


@lru_cache(maxsize=1024)
def halvings_for(bits: int) -> int:
    """Return how often to halve an argument of exp, sin, cos before the series, as it pays."""
    return max(0, isqrt(bits) // 2 - 10)


def working_bits(bits: int) -> int:
    """Return the multiple of 16 at which a kernel works: at least 12 bits more than are asked."""
    return (bits + 27) & -16


def arc(z: int, bits: int, sign: int) -> tuple[int, int]:
    """Return (A, E): atan for sign = -1, atanh for sign = +1, of z / 2^bits.

    The series sum_k sign^k z^(2k+1) / (2k+1) is A = s - or + z^2 t, where s has the terms
    z^(4j+1) / (4j+1) and t the terms z^(4j+1) / (4j+3). z^2 and z^4 err by less than 1.1 units, so
    a power with an error of e is followed by one with an error of at most e / 2^28 + 1.1 / 2^7 + 1
    < 1.1 units, its quotient by 3 or more by one of at most 1.4. After j powers s and t err by at
    most 1.4 j, the product by 1 + 2^-7 + 1.4 j / 2^14, the tails by less than one unit.
    """
    square = z * z >> bits
    fourth = square * square >> bits
    s, t, power, k = z, z // 3, z * fourth >> bits, 5
    while power:
        s += power // k
        t += power // (k + 2)
        power = power * fourth >> bits
        k += 4
    t = t * square >> bits
    return (s + t if sign > 0 else s - t), k  # 1.5 j + 3.1 < k = 4 j + 5


def exp_series(r: int, bits: int) -> tuple[int, int]:
    """Return (Y, E): 0 <= exp(r / 2^bits) 2^bits - Y <= E.

    Y = s + r t, s the terms r^k / k! of even k, t the terms r^(k-1) / k! of odd k. r^2 errs by one
    unit. From a term with an error of e units division by k >= 2 makes one with e / 2 + 1, and
    the product with r^2 one of at most e / 2^14 + 2^-14 + 1: all below 2 units. There are (k - 2)/2
    terms in each sum; the product r t errs by at most 1 + 2^-7 (k - 2), and the tails by less than
    one unit. In all at most k - 2 + 1 + (k - 2) / 128 + 1 < 2 k.
    """
    one = 1 << bits
    square = r * r >> bits
    s, t, term, k = one, one, square, 2
    while term:
        term //= k
        s += term
        term //= k + 1
        t += term
        term = term * square >> bits
        k += 2
    return s + (r * t >> bits), 2 * k


def versine_series(r: int, bits: int) -> tuple[int, int]:
    """Return (U, E): |(1 - cos(r / 2^bits)) 2^bits - U| <= E.

    With r^2 = q the terms are q^j / (2 j)!: U = a - q b, a the sum of those of odd j, q b of those
    of even j. q and q^2 err by less than 1.1 units, the first term by 1.5. From a term with an
    error of e units division by 12 or more, and the product with q^2 < 2^-28, make ones of at most
    e / 12 + 1.1 < 1.5. So n terms of a, and of b, err by at most 1.5 n; q b by 1.1 + n / 2^13; the
    tails, behind a term that vanishes, by 1.6 each: below 2 n + 5, and k = 4 n + 3.
    """
    square = r * r >> bits
    fourth = square * square >> bits
    a = b = 0
    term, k = square >> 1, 3
    while term:
        a += term
        term //= k * (k + 1)
        b += term
        term = (term * fourth >> bits) // ((k + 2) * (k + 3))
        k += 4
    return a - (square * b >> bits), k + 4


@lru_cache(maxsize=4096)
def exp_at(j: int, scale: int, bits: int) -> int:
    """Return T with T <= exp(j / 2^scale) 2^bits <= T + 2, for 0 < j < 2^scale.

    A term with an error of e units is followed by one with an error of at most e / k + 1 <= 2 for
    k >= 2. With k terms and the tail it is below 2 k + 4 units at w bits, and k < w, since the
    terms are below 2 / 2^k: below 2^guard units, one at `bits`; the last shift costs another one.
    """
    guard = bits.bit_length() + 4
    term = total = 1 << (bits + guard)
    k = 1
    while term:
        term = term * j // (k << scale)
        total += term
        k += 1
    value: int = MPZ(total >> guard)
    return value


@lru_cache(maxsize=4096)
def sincos_at(j: int, scale: int, bits: int) -> tuple[int, int]:
    """Return (S, C): sin and cos of j / 2^scale within 2 units, for 0 < j < 2^scale.

    The terms and their errors are those of `exp_at`, with signs.
    """
    guard = bits.bit_length() + 4
    term, k = 1 << (bits + guard), 1
    sums = [term, 0]  # cos, sin
    while term:
        term = term * j // (k << scale)
        sums[k & 1] += -term if k & 2 else term
        k += 1
    return MPZ(sums[1] >> guard), MPZ(sums[0] >> guard)


@lru_cache(maxsize=4096)
def log_at(c: int, scale: int, bits: int) -> int:
    """Return L with |log(c / 2^scale) 2^bits - L| <= 2, for 1/2 < c / 2^scale < 2.

    The logarithm is 2 atanh z, z = (c - 2^scale) / (c + 2^scale), |z| < 1/3; the error of atanh is
    at most 2 k + 2 units, doubled below 2^guard, as k <= bits + guard.
    """
    guard = bits.bit_length() + 5
    one = 1 << scale
    value, _ = arc_of_ratio(abs(c - one), c + one, bits + guard, 1)
    floor: int = MPZ(2 * value >> guard)
    return floor if c > one else -floor


@lru_cache(maxsize=4096)
def atan_at(j: int, scale: int, bits: int) -> int:
    """Return A with A <= atan(j / 2^scale) 2^bits <= A + 2, for 0 < j <= 2^scale.

    Euler's series of atan z: its first term is z / (1 + z^2), and each is the one before times
    2k / (2k + 1) z^2 / (1 + z^2), at most 1/2. So each errs by at most 2 units, as does the tail
    behind a term that vanishes; there are k <= w + 1 of them at w bits: less than 2^guard units.
    """
    guard = bits.bit_length() + 4
    square = j * j
    radius = square + (1 << 2 * scale)
    term = (j << (scale + bits + guard)) // radius
    total, k = 0, 1
    while term:
        total += term
        term = term * (2 * k * square) // ((2 * k + 1) * radius)
        k += 1
    value: int = MPZ(total >> guard)
    return value
