"""The checker's own numbers: intervals of integers in fixed point, and their dual numbers.

Enclosure(lo, hi, bits) is the set of reals x with lo <= x 2^bits <= hi. Every result contains
all results for the numbers inside the operands: sums are exact, products, quotients and
functions are rounded down and up. Nothing here is shared with the package `intervals`.
"""

from __future__ import annotations

from fractions import Fraction
from functools import lru_cache, reduce
from math import isqrt
from operator import mul

from proofs.trusted.kernel.meter import METER

_NARROW, MANY = 1 << 10, 512  # units, where there are many bits
_Ends = tuple[int, int]
_MIXED = "enclosures of different precision do not mix"


class Unproved(ArithmeticError):
    """A hypothesis of a rule could not be established."""


class Futile(Unproved):
    """The same, and more digits would not help."""


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

    @property
    def has_zero(self) -> bool:
        """Whether 0 is in it."""
        return self.lo <= 0 <= self.hi

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
            if bits < MANY:
                if c >= 0:
                    low, high = a * (c if a >= 0 else d), b * (d if b >= 0 else c)
                elif d <= 0:
                    low, high = b * (c if b >= 0 else d), a * (d if a >= 0 else c)
                else:
                    low, high = min(a * d, b * c), max(a * c, b * d)
                return Enclosure(low >> bits, -(-high >> bits), bits)
            first, by_b, by_d = a * c, (b - a) * c, a * (d - c)  # often only one has many digits
            changes = 0, by_b, by_d, by_b + by_d + (b - a) * (d - c)
            return Enclosure(
                (first + min(changes)) >> bits, -(-(first + max(changes)) >> bits), bits
            )
        if isinstance(value, int):
            ends = (self.lo * value, self.hi * value)
            return Enclosure(min(ends), max(ends), bits)
        return self * rational(value, bits) if isinstance(value, Fraction) else NotImplemented

    __rmul__ = __mul__

    def __truediv__(self, value: Enclosure | Fraction | int) -> Enclosure:
        if isinstance(value, Dual):
            return NotImplemented
        if isinstance(value, int) and value > 0:
            METER.get().spend(1 + (self.bits >> 9))
            return Enclosure(self.lo // value, -(-self.hi // value), self.bits)
        top, other = self, self._like(value)
        if other.lo <= 0 <= other.hi:
            raise Unproved("division by an enclosure of 0")
        METER.get().spend(2 + (self.bits >> 7) + ((self.bits >> 8) ** 2 >> 3))
        if other.hi < 0:
            top, other = -top, -other
        low = (top.lo << self.bits) // (other.hi if top.lo >= 0 else other.lo)
        high = (-top.hi << self.bits) // (other.lo if top.hi >= 0 else other.hi)
        return Enclosure(low, -high, self.bits)

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
        """Return (sin X, cos X); the work counts whether or not the values are known."""
        bits, work = self.bits, 12 + max(self.bits, max(-self.lo, self.hi).bit_length())
        if bits < MANY:
            METER.get().spend(2 * (8 + (3 * (work >> 6) ** 2 >> 2)))  # work / 4 steps
        else:
            METER.get().spend(8 + (work >> 5) + ((work >> 6) ** 2 >> 2))
        (a, b), (c, d) = _sincos_between(self.lo, self.hi, bits)
        return Enclosure(a, b, bits), Enclosure(c, d, bits)


def sincos_near_zero(x: Enclosure) -> tuple[Enclosure, Enclosure]:
    """Return (sin X, cos X), with few products for |X| < 2^-(bits / 4).

    Then |X|^4 < 8 units, so sin x is within one of x - x^3 / 6, and cos x of 1 - x^2 / 2.
    """
    if max(abs(x.lo), abs(x.hi)) >> (x.bits - (x.bits >> 2)):
        return x.sincos()
    square, one = x * x, 1 << x.bits
    sin, cos = x - x * square / 6, 1 - square / 2
    return (
        Enclosure(sin.lo - 1, sin.hi + 1, x.bits),
        Enclosure(cos.lo - 1, min(cos.hi + 1, one), x.bits),
    )


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


@lru_cache(maxsize=4096)
def _sincos_between(lo: int, hi: int, bits: int) -> tuple[_Ends, _Ends]:
    """Return the ends of sin and cos: the hull of the values at lo and hi and the extrema between.

    The multiples m pi/2 in X satisfy floor(lo) < m <= floor(hi) in quarter turns; where an
    end is too close to one to tell, the extremum is put in, which is outward.
    """
    sin, cos, first, _ = _sincos(lo, bits)
    width, one = hi - lo, 1 << bits
    if width == 0 or (width < _NARROW and bits >= MANY):  # |sin'|, |cos'| <= 1
        ends = [(max(x - width, -one), min(y + width, one)) for x, y in (sin, cos)]
        return ends[0], ends[1]
    sin_hi, cos_hi, _, last = _sincos(hi, bits)
    hulls = [[min(x[0], y[0]), max(x[1], y[1])] for x, y in ((sin, sin_hi), (cos, cos_hi))]
    for turn in range(first + 1, min(last, first + 4) + 1):
        hulls[1 - (turn & 1)][1 - (turn >> 1 & 1)] = -one if turn & 2 else one
    (a, b), (c, d) = hulls
    return (a, b), (c, d)


def _sincos(x: int, bits: int) -> tuple[_Ends, _Ends, int, int]:
    """Return the ends of sin, cos of x / 2^bits and bounds first <= floor(x / (pi/2)) <= last."""
    work = 12 + max(bits, abs(x).bit_length())
    if bits < MANY:
        return _sincos_at(x, bits, work)
    halvings = isqrt(bits) >> 2
    return _sincos_by_halves(x, bits, work + 2 * halvings, halvings)


@lru_cache(maxsize=4096)
def _sincos_at(x: int, bits: int, work: int) -> tuple[_Ends, _Ends, int, int]:
    """Return what `_sincos` does.

    Proof. With g = 12 + (bit length of x above the point) guard bits, x is exact, k the nearest
    multiple of pi/2, r = x - k pi/2 is within [r_lo, r_hi], |r| < 0.8. For a = |r_lo| sin a is
    summed by t_(n+2) = t_n a^2 / ((n + 1) (n + 2)): a term that is e units too small makes the next
    one at most (0.64 e + 0.8 + 1) / 6 + 1 < 2 too small, the terms together off by less than n, and
    the tail is below 2 units when a term is 0. So sin is off by at most e = n + 2; cos is
    sqrt(1 - sin^2), with tan(a) < 1.1: off by at most 1.1 e + 1 < 2 e. r_hi - r_lo adds its own
    width (|sin'|, |cos'| <= 1).
    """
    guard = work - bits
    half_pi_lo, half_pi_hi = pi(work).lo, pi(work).hi  # pi in units of 2^-work
    x <<= guard
    k = (4 * x + half_pi_lo) // (2 * half_pi_lo)  # floor(x / (pi/2) + 1/2), about
    doubled = sorted((2 * x - k * half_pi_lo, 2 * x - k * half_pi_hi))
    r, r_hi = doubled[0] >> 1, -(-doubled[1] >> 1)
    square, sin, term, n = r * r >> work, abs(r), abs(r), 1
    while term:
        term = (term * square >> work) // ((n + 1) * (n + 2))
        sin -= term
        term = (term * square >> work) // ((n + 3) * (n + 4))
        sin += term
        n += 4
    cos = isqrt((1 << 2 * work) - sin * sin)
    error = 2 * (n + 2) + (r_hi - r)
    values = [sin if r >= 0 else -sin, cos]
    return *_turned(values, error, bits, guard, k), k - (r <= 0), k - (r_hi < 0)


def _turned(values: list[int], error: int, bits: int, guard: int, k: int) -> tuple[_Ends, _Ends]:
    """Return the ends of sin, cos at k quarter turns more, from `guard` bits more, and an error."""
    one = 1 << bits
    (a, b), (c, d) = (
        (max((v - error) >> guard, -one), min(-((-v - error) >> guard), one)) for v in values
    )
    turned = (((a, b), (c, d)), ((c, d), (-b, -a)), ((-b, -a), (-d, -c)), ((-d, -c), (a, b)))
    return turned[k & 3]


@lru_cache(maxsize=4096)
def _sincos_by_halves(x: int, bits: int, work: int, halvings: int) -> tuple[_Ends, _Ends, int, int]:
    """Return what `_sincos` does, for many bits.

    Proof. With g = 12 + 2 h + (bit length of x above the point) guard bits, h the halvings, x is
    exact and r = x - k pi/2 within [r_lo, r_hi], 0.39 < r < 1.98. The series of cos(r_lo / 2^h) is
    off by 34 units of 2^-work: 32 by itself, one each for the square and for the argument. For
    u = 1 - cos, which doubling takes to 2 u (2 - u), errors of at most e units become at most
    4 e + 2; for sin = sqrt(u (2 - u)), with |cot| < 2.43, at most 3 e + 2. r_hi - r_lo adds its own
    width (|sin'|, |cos'| <= 1).
    """
    guard, one = work - bits, 1 << work
    pi_lo, pi_hi = pi(work).lo, pi(work).hi
    x <<= guard
    k = 2 * (x - (one << 1) // 5) // pi_lo  # floor((x - 2/5) / (pi/2)), about
    doubled = sorted((2 * x - k * pi_lo, 2 * x - k * pi_hi))
    r, r_hi = doubled[0] >> 1, -(-doubled[1] >> 1)
    rise, error = one - exponential(-((r >> halvings) ** 2 >> work), 2, work), 34
    for _ in range(halvings):
        rise, error = rise * (2 * one - rise) >> (work - 1), 4 * error + 2
    error = 3 * error + 2 + r_hi - r
    values = [isqrt(rise * (2 * one - rise)), one - rise]
    quarters = k + (doubled[0] >= pi_hi), k + (doubled[1] >= pi_lo)
    return *_turned(values, error, bits, guard, k), *quarters


def exponential(z: int, step: int, work: int) -> int:
    """Return about the sum of z^n / (step n)!, |z| <= 1/4, in units of 2^-work, of which off by 32.

    step: 1 or 2. In blocks of m terms (Smith 1989), with f_n = (step n)! / (step n - step)! and
    z^n short for z^(n mod m): R_n = (z^n + R_(n+1)) / f_n, R_(n+1) times z^m where n + 1 is a
    multiple of m; the sum is R_0, f_0 = 1. The powers are off by less than 2 units, as
    e_n <= e_(n-1) / 4 + 1. If R_(n+1) is off by e, R_n is by at most (2 + (e + 5)) / f_n + 1: that
    is 9 for n > 1, 17 for n = 1, 24 for n = 0. What is left out is below one unit: the last term
    is, as it has `small` zeros, and each next one is below a quarter of the one before.
    """
    small, zeros, factors = 0, work - abs(z).bit_length(), [1]
    while z and small <= work:
        n = len(factors)
        factors.append(n if step == 1 else (2 * n - 1) * 2 * n)
        small += zeros + factors[n].bit_length() - 1
    m, powers = 1 + isqrt(len(factors)), [1 << work]
    for _ in range(m):
        powers.append(powers[-1] * z >> work)
    total = 0
    for n in range(len(factors) - 1, -1, -1):
        if (n + 1) % m == 0:
            total = total * powers[m] >> work
        total = (powers[n % m] + total) // factors[n]
    return total


class Dual:
    """value + derivative * (small): first derivatives through the shared equations."""

    __slots__ = ("derivative", "value")

    def __init__(self, value: Enclosure, derivative: Enclosure) -> None:
        self.value, self.derivative = value, derivative

    def __neg__(self) -> Dual:
        return Dual(-self.value, -self.derivative)

    def __add__(self, value: Dual | Enclosure | Fraction | int) -> Dual:
        if isinstance(value, Dual):
            return Dual(self.value + value.value, self.derivative + value.derivative)
        return Dual(self.value + value, self.derivative)

    __radd__ = __add__

    def __sub__(self, value: Dual | Enclosure | Fraction | int) -> Dual:
        return self + -value

    def __rsub__(self, value: Enclosure | Fraction | int) -> Dual:
        return -self + value

    def __mul__(self, value: Dual | Enclosure | Fraction | int) -> Dual:
        if isinstance(value, Dual):
            slope = self.derivative * value.value + self.value * value.derivative
            return Dual(self.value * value.value, slope)
        return Dual(self.value * value, self.derivative * value)

    __rmul__ = __mul__

    def __truediv__(self, value: Dual | Enclosure | Fraction | int) -> Dual:
        if isinstance(value, Dual):
            quotient = self.value / value.value
            return Dual(quotient, (self.derivative - quotient * value.derivative) / value.value)
        return Dual(self.value / value, self.derivative / value)

    def __rtruediv__(self, value: Enclosure | Fraction | int) -> Dual:
        zero = 0 * self.value
        return Dual(zero + value, zero) / self

    def __pow__(self, n: int) -> Dual:
        return reduce(mul, [self] * n)

    def sincos(self) -> tuple[Dual, Dual]:
        """Return (sin, cos) with their derivatives."""
        sin, cos = self.value.sincos()
        return Dual(sin, cos * self.derivative), Dual(cos, -sin * self.derivative)
