"""log, log2, log10, log1p, asinh, acosh, atanh of a dyadic number, tightest: see `tightest`.

log x, log(1 + x) and the inverse hyperbolic functions are transcendental or 0 (Lindemann): 0 at
x = 1, 0, 0, 1, 0. log2 x and log10 x are rational for x = 2^n and 10^n only: if x^b = 2^a or 10^a
in lowest terms, the base would be the b-th power of a rational. 10^n is dyadic for n >= 0.
"""

from math import isqrt

from mpmath.libmp import fone, from_int, fzero, mpf_add, mpf_pos, mpf_sub

from intervals.elementary.constants import Constant, log2_fixed, log10_fixed
from intervals.elementary.explog import log_fixed
from intervals.elementary.ziv import (
    DOWN,
    UP,
    Bounds,
    Enclosure,
    Raw,
    magnitude,
    near_argument,
    near_or_tight,
    odd,
    settled,
    tighten,
)


def closeness(x: Raw) -> int:
    """Return k >= 0 with |x - 1| >= 2^-k / 4, for 0 < x != 1: the bits that are lost in log x."""
    _, man, exp, size = x
    if exp == -size:  # 1/2 <= x < 1
        return size - ((1 << size) - man).bit_length()
    if exp == 1 - size:  # 1 < x < 2
        return size - 1 - (man - (1 << (size - 1))).bit_length()
    return 0


def log(x: Raw, precision: int) -> Bounds:
    """Return the bounds of log x, for x > 0. 0 < d - log(1 + d) < d^2 for 0 < |d| <= 1/2."""
    if x == fone:
        return fzero, fzero
    extra = closeness(x)
    if extra >= precision:  # else |x - 1| >= 2^-extra / 4 is too large for it
        near = near_argument(mpf_sub(x, fone), 2, False, precision)
        if near:
            return near
    guard = 10
    while True:
        bits = precision + extra + guard
        y, error = log_fixed(x[1], x[2], bits)
        bounds = settled(y - error, y + error, bits, precision)
        if bounds:
            return bounds
        guard *= 2


def log1p(x: Raw, precision: int) -> Bounds:
    """Return the bounds of log(1 + x), for x > -1. Near 0 they follow as in `log`.

    1 + x is exact; where it would be long, x >= 2^bits, 0 < log(1 + x) - log x < 1/x is below a
    unit.
    """
    if not x[1]:
        return x, x
    near = near_argument(x, 2, False, precision)
    if near:
        return near
    if magnitude(x) <= precision:
        return log(mpf_add(x, fone), precision)

    def enclose(bits: int) -> Enclosure:
        large = magnitude(x) > bits
        _, man, exp, _ = x if large else mpf_add(x, fone)
        y, error = log_fixed(man, exp, bits)
        return y - error, y + error + large, bits

    return tighten(enclose, precision)


def log2(x: Raw, precision: int) -> Bounds:
    """Return the bounds of log x / log 2, for x > 0."""
    if x[1] == 1:
        power = from_int(x[2])
        return mpf_pos(power, precision, DOWN), mpf_pos(power, precision, UP)
    return _log_to(log2_fixed, x, precision)


def log10(x: Raw, precision: int) -> Bounds:
    """Return the bounds of log x / log 10, for x > 0. x = 10^n has the mantissa 5^n, exponent n."""
    n = x[2]
    if 0 <= n <= x[3] and x[1] == 5**n:
        power = from_int(n)
        return mpf_pos(power, precision, DOWN), mpf_pos(power, precision, UP)
    return _log_to(log10_fixed, x, precision)


def _log_to(log_base: Constant, x: Raw, precision: int) -> Bounds:
    """Return the bounds of log x / log b, which is no number of `precision` bits.

    The quotient of [low, high] by [base, base + 1] is least and largest at these ends.
    """

    def enclose(bits: int) -> Enclosure:
        y, error = log_fixed(x[1], x[2], bits)
        low, high, base = y - error, y + error, log_base(bits)
        smallest = (low << bits) // (base + (low >= 0))
        return smallest, -((-high << bits) // (base + (high < 0))), bits

    return tighten(enclose, precision, closeness(x) + 2)


def square_and_one(x: Raw, sign: int) -> tuple[int, int]:
    """Return (N, e): x^2 + sign = N 2^e, exactly."""
    if x[2] >= 0:
        return (x[1] << x[2]) ** 2 + sign, 0
    return x[1] ** 2 + (sign << -2 * x[2]), 2 * x[2]


def root_fixed(man: int, exp: int, bits: int) -> int:
    """Return floor(sqrt(man 2^exp) 2^bits), for man >= 0."""
    shift = exp + 2 * bits
    return isqrt(man << shift if shift >= 0 else man >> -shift)


def value_fixed(x: Raw, bits: int) -> int:
    """Return floor(|x| 2^bits)."""
    shift = x[2] + bits
    return x[1] << shift if shift >= 0 else x[1] >> -shift


def _log_of_sum(x: Raw, sign: int, bits: int) -> tuple[int, int]:
    """Return `log_fixed` of x + sqrt(x^2 + sign), of its floors; of 2 x where x >= 2^bits."""
    if magnitude(x) > bits:
        return log_fixed(x[1], x[2] + 1, bits)
    v = bits + 2
    return log_fixed(value_fixed(x, v) + root_fixed(*square_and_one(x, sign), v), -v, bits)


@odd
def asinh(x: Raw, precision: int) -> Bounds:
    """Return the bounds of asinh x = log(x + sqrt(x^2 + 1)). 0 < x - asinh x < x^3 for x > 0.

    At v = bits + 2 the argument U >= 2^v of the logarithm is at most 3 units too small: x and the
    root are floors; log U less than a unit at `bits`. For x >= 2^bits,
    0 < asinh x - log 2x < 1 / (4 x^2).
    """

    def enclose(bits: int) -> Enclosure:
        y, error = _log_of_sum(x, 1, bits)
        return y - error, y + error + 1, bits

    return near_or_tight(x, 3, False, enclose, precision)


def acosh(x: Raw, precision: int) -> Bounds:
    """Return the bounds of acosh x = log(x + sqrt(x^2 - 1)), for x >= 1.

    As for asinh, with 2 units. For x >= 2^bits, 0 < log 2x - acosh x < 1 / x^2. Near 1 the value
    is about sqrt(2 (x - 1)).
    """
    if x == fone:
        return fzero, fzero

    def enclose(bits: int) -> Enclosure:
        y, error = _log_of_sum(x, -1, bits)
        return y - error - 1, y + error + 1, bits

    return tighten(enclose, precision, closeness(x) // 2)


@odd
def atanh(x: Raw, precision: int) -> Bounds:
    """Return the bounds of atanh x = log((1 + x) / (1 - x)) / 2. 0 < atanh x - x < x^3 on (0, 1/2].

    The quotient U >= 2^bits is one floor, and log U at most a unit too small.
    """

    def enclose(bits: int) -> Enclosure:
        one = 1 << -x[2]
        quotient = ((one + x[1]) << bits) // (one - x[1])
        y, error = log_fixed(quotient, -bits, bits)
        return y - error, y + error + 1, bits + 1

    return near_or_tight(x, 3, True, enclose, precision)
