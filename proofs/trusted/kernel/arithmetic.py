"""The checker's own numbers: intervals of integers in fixed point, and their dual numbers.

Enclosure(lo, hi, bits) is the set of reals x with lo <= x 2^bits <= hi. Every result contains
all results for the numbers inside the operands: sums are exact, products, quotients and
functions are rounded down and up. Nothing here is shared with the package `intervals`.
"""

from __future__ import annotations

import math
from fractions import Fraction
from functools import lru_cache, reduce
from math import isqrt
from operator import mul

from proofs.trusted.kernel.meter import METER

_NARROW, _MANY = 1 << 10, 512  # units, where there are many bits
_Ends = tuple[int, int]
_MIXED = "enclosures of different precision do not mix"


class Unproved(ArithmeticError):
    """A hypothesis of a rule could not be established."""


class Enclosure:
    """A closed interval of reals with integer endpoints in units of 2^-bits."""

    __slots__ = ("bits", "hi", "lo")

    def __init__(self, lo: int, hi: int, bits: int) -> None:
        self.lo, self.hi, self.bits = lo, hi, bits

    @classmethod
    def of(cls, low: Fraction, high: Fraction, bits: int) -> Enclosure:
        """Return the tightest enclosure of [low, high]."""
        lo = (low.numerator << bits) // low.denominator
        return cls(lo, -((-high.numerator << bits) // high.denominator), bits)

    @property
    def range(self) -> tuple[Fraction, Fraction]:
        """The endpoints, exact."""
        unit = 1 << self.bits
        return Fraction(self.lo, unit), Fraction(self.hi, unit)

    def _like(self, other: Enclosure | Fraction | int) -> Enclosure:
        if isinstance(other, Enclosure):
            if other.bits != self.bits:
                raise ValueError(_MIXED)
            return other
        if isinstance(other, int):
            return Enclosure(other << self.bits, other << self.bits, self.bits)
        return rational(other, self.bits)

    def __neg__(self) -> Enclosure:
        return Enclosure(-self.hi, -self.lo, self.bits)

    def __add__(self, value: Enclosure | Fraction | int) -> Enclosure:
        if isinstance(value, Dual):
            return NotImplemented
        other = self._like(value)
        return Enclosure(self.lo + other.lo, self.hi + other.hi, self.bits)

    __radd__ = __add__

    def __sub__(self, value: Enclosure | Fraction | int) -> Enclosure:
        if isinstance(value, Dual):
            return NotImplemented
        other = self._like(value)
        return Enclosure(self.lo - other.hi, self.hi - other.lo, self.bits)

    def __rsub__(self, value: Fraction | int) -> Enclosure:
        return -self + value

    def __mul__(self, value: Enclosure | Fraction | int) -> Enclosure:
        bits = self.bits
        if isinstance(value, Enclosure):
            if value.bits != bits:
                raise ValueError(_MIXED)
            METER.get().spend(1 + (bits >> 7))
            a, b, c, d = self.lo, self.hi, value.lo, value.hi
            products = (a * c, b * d) if a >= 0 <= c else (a * c, a * d, b * c, b * d)
            return Enclosure(min(products) >> bits, -(-max(products) >> bits), bits)
        if isinstance(value, int):
            ends = (self.lo * value, self.hi * value)
            return Enclosure(min(ends), max(ends), bits)
        return self * rational(value, bits) if isinstance(value, Fraction) else NotImplemented

    __rmul__ = __mul__

    def __truediv__(self, value: Enclosure | Fraction | int) -> Enclosure:
        if isinstance(value, Dual):
            return NotImplemented
        other = self._like(value)
        if other.lo <= 0 <= other.hi:
            raise Unproved("division by an enclosure of 0")
        METER.get().spend(3 + (self.bits >> 6) + ((self.bits >> 8) ** 2 >> 1))
        a, b, c, d = self.lo << self.bits, self.hi << self.bits, other.lo, other.hi
        low = min(a // c, a // d, b // c, b // d)
        return Enclosure(low, max(-(-a // c), -(-a // d), -(-b // c), -(-b // d)), self.bits)

    def __rtruediv__(self, value: Fraction | int) -> Enclosure:
        return self._like(value) / self

    def __pow__(self, n: int) -> Enclosure:
        if n < 1:
            raise ValueError("only positive powers are needed")
        result = self
        for _ in range(n - 1):
            result = result * self
        return result

    def hull(self, other: Enclosure) -> Enclosure:
        """Return the smallest enclosure of both."""
        return Enclosure(min(self.lo, other.lo), max(self.hi, other.hi), self.bits)

    def meet(self, other: Enclosure) -> Enclosure:
        """Return the part that both enclosures of one number have in common."""
        low, high = max(self.lo, other.lo), min(self.hi, other.hi)
        if low > high:
            raise Unproved("two enclosures of one number are disjoint")
        return Enclosure(low, high, self.bits)

    def sincos(self) -> tuple[Enclosure, Enclosure]:
        """Return (sin X, cos X): the hull of the values at the ends and the extrema between.

        The multiples m pi/2 in X satisfy floor(lo) < m <= floor(hi) in quarter turns; where an
        end is too close to one to tell, the extremum is put in, which is outward.
        """
        sin, cos, first, _ = _sincos(self.lo, self.bits)
        width, one = self.hi - self.lo, 1 << self.bits
        if width == 0 or (width < _NARROW and self.bits >= _MANY):  # |sin'|, |cos'| <= 1
            ends = [[max(x - width, -one), min(y + width, one)] for x, y in (sin, cos)]
        else:
            sin_hi, cos_hi, _, last = _sincos(self.hi, self.bits)
            ends = [[min(x[0], y[0]), max(x[1], y[1])] for x, y in ((sin, sin_hi), (cos, cos_hi))]
            for turn in range(first + 1, min(last, first + 4) + 1):
                ends[1 - (turn & 1)][1 - (turn >> 1 & 1)] = -one if turn & 2 else one
        (a, b), (c, d) = ends
        return Enclosure(a, b, self.bits), Enclosure(c, d, self.bits)


def rational(value: Fraction, bits: int) -> Enclosure:
    """Return the tightest enclosure of one rational."""
    return Enclosure.of(value, value, bits)


@lru_cache(maxsize=256)
def pi(bits: int) -> Enclosure:
    """Enclose pi = 48 atan(1/18) + 32 atan(1/57) - 20 atan(1/239) (Gauss)."""
    work = bits + 16
    total = lost = 0
    for weight, n in ((48, 18), (32, 57), (-20, 239)):
        value, error = _atan_inverse(n, work)
        total += weight * value
        lost += abs(weight) * error
    return Enclosure((total - lost) >> 16, -((-total - lost) >> 16), bits)


def _atan_inverse(n: int, bits: int) -> tuple[int, int]:
    """Return atan(1/n) in fixed point and a bound on its error, n >= 2.

    sum (-1)^k / ((2k+1) n^(2k+1)): each term is one floor of an exact quotient; the terms
    alternate and decrease, so the tail is below the first term left out, one unit.
    """
    total, k = 0, 0
    while term := (1 << bits) // ((2 * k + 1) * n ** (2 * k + 1)):
        total += -term if k & 1 else term
        k += 1
    return total, k + 1


def _sincos(x: int, bits: int) -> tuple[_Ends, _Ends, int, int]:
    """Return the ends of sin, cos of x / 2^bits and bounds first <= floor(x / (pi/2)) <= last.

    The work counts whether or not the values are known: flights meet at the same times.
    """
    halvings = isqrt(bits) >> 1 if bits >= _MANY else 0
    work = bits + 12 + 2 * halvings + max(0, abs(x).bit_length() - bits)
    METER.get().spend(8 + (3 * (work >> 6) ** 2 >> (2 + 2 * (halvings > 0))))  # work / 4 steps
    return _sincos_at(x, bits, halvings, work)


@lru_cache(maxsize=4096)
def _sincos_at(x: int, bits: int, halvings: int, work: int) -> tuple[_Ends, _Ends, int, int]:
    """Return what `_sincos` does.

    Proof. With g = 12 + (bit length of x above the point) guard bits, x is exact, k the nearest
    multiple of pi/2, r = x - k pi/2 is within [r_lo, r_hi], |r| < 0.8. exp(ir) is summed as
    t_n = t_(n-1) r / n at the lower end r_lo: a term with error e gives the next one error at
    most 0.8 e / n + 1 < 3, all terms of sin or cos together 3 N, and the tail is below
    2 units when a term is below one. r_hi - r_lo adds its own width (|sin'|, |cos'| <= 1).
    With many bits r is halved h times before, rounded by a unit, and (sin, cos) taken to
    (2 sin cos, 1 - 2 sin^2) as often: errors of at most e units become at most 4 e + 2.
    """
    guard, one = work - bits, 1 << bits
    half_pi_lo, half_pi_hi = pi(work).lo, pi(work).hi  # pi in units of 2^-work
    x <<= guard
    k = (4 * x + half_pi_lo) // (2 * half_pi_lo)  # floor(x / (pi/2) + 1/2), about
    doubled = sorted((2 * x - k * half_pi_lo, 2 * x - k * half_pi_hi))
    r, r_hi = doubled[0] >> 1, -(-doubled[1] >> 1)
    sums, term, n, part = [0, 1 << work], 1 << work, 0, r >> halvings
    while term not in (0, -1):
        n += 1
        term = (term * part >> work) // n
        if n & 2:
            sums[1 - (n & 1)] -= term
        else:
            sums[1 - (n & 1)] += term
    error = 3 * n + 2 + (halvings > 0)
    for _ in range(halvings):
        sums = [2 * sums[0] * sums[1] >> work, (1 << work) - (2 * sums[0] ** 2 >> work)]
        error = 4 * error + 2
    error += r_hi - r
    (a, b), (c, d) = (
        (max((v - error) >> guard, -one), min(-((-v - error) >> guard), one)) for v in sums
    )
    turned = (((a, b), (c, d)), ((c, d), (-b, -a)), ((-b, -a), (-d, -c)), ((-d, -c), (a, b)))
    return *turned[k & 3], k - (r <= 0), k - (r_hi < 0)


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
    if not (1 << x.bits) >> 90 < x.lo <= x.hi < 1 << (x.bits + 90):
        raise Unproved("the logarithm of an enclosure that leaves (2^-90, 2^90)")
    about = Fraction(math.log((x.lo + x.hi) / (2 << x.bits)))
    y = rational(about, x.bits)
    ratio = x * exp(-y)
    z = (ratio - 1) / (ratio + 1)
    if 5 * max(-z.lo, z.hi) > 1 << x.bits:
        raise Unproved("a wide enclosure has no logarithm")
    return y + _log1(z)


def _log1(z: Enclosure) -> Enclosure:
    """Enclose log m = 2 atanh z, z = (m - 1) / (m + 1), for |z| <= 1/5."""
    square, power, total, k = z * z, z, z, 1
    while max(abs(power.lo), abs(power.hi)) > 1:
        power, k = power * square, k + 2
        total = total + power / k
    # the tail: |z|^(k+2) / (k+2) / (1 - z^2), below the last power, at most one unit
    return 2 * Enclosure(total.lo - 1, total.hi + 1, z.bits)


def exp(x: Enclosure) -> Enclosure:
    """Enclose exp X for |X| < 64: Taylor at X / 2^k with |X / 2^k| < 1/16, squared k times."""
    if max(abs(x.lo), abs(x.hi)) >> x.bits >= 64:
        raise Unproved("exponent out of range")
    k = 10
    small = Enclosure(x.lo >> k, -(-x.hi >> k), x.bits)
    term = total = Enclosure(1 << x.bits, 1 << x.bits, x.bits)
    n = 0
    while max(abs(term.lo), abs(term.hi)) > 1:
        n += 1
        term = term * small / n
        total = total + term
    total = Enclosure(total.lo - 1, total.hi + 1, x.bits)  # tail < last term / 15
    for _ in range(k):
        total = total * total
    return total


class Dual:
    """value + derivative * (small): first derivatives through the shared equations."""

    __slots__ = ("derivative", "value")

    def __init__(self, value: Enclosure, derivative: Enclosure) -> None:
        self.value, self.derivative = value, derivative

    def _like(self, other: Dual | Enclosure | Fraction | int) -> Dual:
        if isinstance(other, Dual):
            return other
        zero = 0 * self.value
        return Dual(zero + other, zero)

    def __neg__(self) -> Dual:
        return Dual(-self.value, -self.derivative)

    def __add__(self, value: Dual | Enclosure | Fraction | int) -> Dual:
        other = self._like(value)
        return Dual(self.value + other.value, self.derivative + other.derivative)

    __radd__ = __add__

    def __sub__(self, value: Dual | Enclosure | Fraction | int) -> Dual:
        return self + -self._like(value)

    def __rsub__(self, value: Enclosure | Fraction | int) -> Dual:
        return -self + value

    def __mul__(self, value: Dual | Enclosure | Fraction | int) -> Dual:
        other = self._like(value)
        slope = self.derivative * other.value + self.value * other.derivative
        return Dual(self.value * other.value, slope)

    __rmul__ = __mul__

    def __truediv__(self, value: Dual | Enclosure | Fraction | int) -> Dual:
        other = self._like(value)
        quotient = self.value / other.value
        return Dual(quotient, (self.derivative - quotient * other.derivative) / other.value)

    def __rtruediv__(self, value: Enclosure | Fraction | int) -> Dual:
        return self._like(value) / self

    def __pow__(self, n: int) -> Dual:
        return reduce(mul, [self] * n)

    def sincos(self) -> tuple[Dual, Dual]:
        """Return (sin, cos) with their derivatives."""
        sin, cos = self.value.sincos()
        return Dual(sin, cos * self.derivative), Dual(cos, -sin * self.derivative)
