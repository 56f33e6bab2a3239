"""Logarithms and exponentials of the checker's own numbers."""

from __future__ import annotations

from fractions import Fraction
from functools import lru_cache
from math import isqrt

from proofs.trusted.kernel.arithmetic import MANY, Enclosure, Unproved, exponential, rational
from proofs.trusted.kernel.meter import METER

_Ends = tuple[int, int]
_NEAR = 60  # bits of a candidate


def log(value: Fraction, bits: int) -> Enclosure:
    """Enclose the logarithm of a positive rational: value = m 2^n, m in [2/3, 4/3]."""
    n = value.numerator.bit_length() - value.denominator.bit_length()
    METER.get().spend(abs(n) >> 4)
    scaled = value / Fraction(2) ** n
    while 3 * scaled > 4:
        scaled, n = scaled / 2, n + 1
    while 3 * scaled < 2:
        scaled, n = scaled * 2, n - 1
    return _log1(rational((scaled - 1) / (scaled + 1), bits)) + _log2(bits) * n


@lru_cache(maxsize=256)
def _log2(bits: int) -> Enclosure:
    """Enclose log 2 = log(4/3) - log(2/3)."""
    return _log1(rational(Fraction(1, 7), bits)) - _log1(rational(Fraction(-1, 5), bits))


def log_of(x: Enclosure) -> Enclosure:
    """Enclose log X = y + log(X exp(-y)), X in (2^-90, 2^90), y about the logarithm of a middle."""
    bits, middle = x.bits, (x.lo + x.hi) >> 1
    if not (1 << bits) >> 90 < x.lo <= x.hi < 1 << (bits + 90):
        raise Unproved("the logarithm of an enclosure that leaves (2^-90, 2^90)")
    if bits < MANY:
        y = rational(Fraction(_near_log(middle, bits), 1 << _NEAR), bits)
    else:
        up = bits >> 1
        y = log_of(Enclosure(middle >> up, middle >> up, bits - up))
        y = Enclosure(y.lo << up, y.lo << up, bits)
    ratio = x * exp(-y)
    z = (ratio - 1) / (ratio + 1)
    if 5 * max(-z.lo, z.hi) > 1 << bits:
        raise Unproved("a wide enclosure has no logarithm")
    return y + _log1(z)


def _near_log(x: int, bits: int) -> int:
    """Return about log(x / 2^bits), in units of 2^-60: nothing rests on how near it is."""
    n, one = x.bit_length(), 1 << _NEAR
    m = x << _NEAR >> n  # x = m 2^n, m in [1/2, 1)
    z = (m - one << _NEAR) // (m + one)
    square, power, total = z * z >> _NEAR, z, 0
    for k in range(1, _NEAR, 2):
        total, power = total + power // k, power * square >> _NEAR
    return 2 * total + (n - bits) * _log2(_NEAR).lo


def _log1(z: Enclosure) -> Enclosure:
    """Enclose log m = 2 atanh z, z = (m - 1) / (m + 1), for |z| <= 1/5."""
    square, power, total, k = z * z, z, z, 1
    while max(abs(power.lo), abs(power.hi)) > 1:
        power, k = power * square, k + 2
        total = total + power / k
    # the tail: |z|^(k+2) / (k+2) / (1 - z^2), below the last power, at most one unit
    return 2 * Enclosure(total.lo - 1, total.hi + 1, z.bits)


def exp(x: Enclosure) -> Enclosure:
    """Enclose exp X for |X| < 64; exp(x + w) <= exp(x) (1 + w + w^2) for 0 <= w <= 1."""
    if max(abs(x.lo), abs(x.hi)) >> x.bits >= 64:
        raise Unproved("exp of what may be 64 or more, or -64 or less")
    low, high = _exp(x.lo, x.bits)
    width = x.hi - x.lo
    if width >> (x.bits >> 1) == 0:  # w^2 is at most a unit
        high -= -high * (width + 1) >> x.bits if width else 0
    else:
        high = _exp(x.hi, x.bits)[1]
    return Enclosure(low, high, x.bits)


def _exp(x: int, bits: int) -> _Ends:
    """Return bounds of exp(x / 2^bits), |x| < 2^(bits + 6), by x / 2^k, squared k times.

    The series is off by 34 units: 32 by itself, and as the argument is rounded. With k + 14 guard
    bits, and those of the result above the point (3/2 log2(e^x) is enough): errors about double.
    """
    k = max(0, abs(x).bit_length() - bits) + 2 + isqrt(bits) // 3
    guard = k + 14 + max(0, 3 * (x >> bits) // 2)
    work = bits + guard
    METER.get().spend(8 + (work >> 5) + ((work >> 6) ** 2 >> 2))
    value, error = exponential(x << guard >> k, 1, work), 34
    for _ in range(k):
        value, error = value * value >> work, ((2 * value + error) * error >> work) + 2
    return (value - error) >> guard, -((-value - error) >> guard)
