"""Complex numbers whose parts are the checker's enclosures, and Chebyshev's polynomials there."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import NamedTuple

from proofs.trusted.kernel.arithmetic import Enclosure, Unproved, pi, rational
from proofs.trusted.kernel.elementary import exp
from proofs.trusted.numbers import Range

BITS = 64  # where sizes count, not digits


class Complex:
    """The numbers x + iy, x in `re` and y in `im`."""

    __slots__ = ("im", "re")

    def __init__(self, re: Enclosure, im: Enclosure) -> None:
        self.re, self.im = re, im

    @classmethod
    def of(cls, value: Fraction) -> Complex:
        """Enclose a rational."""
        return cls(rational(value, BITS), Enclosure(0, 0, BITS))

    def _like(self, other: Complex | Fraction | int) -> Complex:
        return other if isinstance(other, Complex) else Complex.of(Fraction(other))

    def __neg__(self) -> Complex:
        return Complex(-self.re, -self.im)

    def __add__(self, value: Complex | Fraction | int) -> Complex:
        other = self._like(value)
        return Complex(self.re + other.re, self.im + other.im)

    __radd__ = __add__

    def __sub__(self, value: Complex | Fraction | int) -> Complex:
        return self + -self._like(value)

    def __rsub__(self, value: Fraction | int) -> Complex:
        return -self + value

    def __mul__(self, value: Complex | Fraction | int) -> Complex:
        if not isinstance(value, Complex):
            return Complex(self.re * value, self.im * value)
        other = value
        if other.is_real:
            return Complex(self.re * other.re, self.im * other.re)
        return Complex(
            self.re * other.re - self.im * other.im, self.re * other.im + self.im * other.re
        )

    __rmul__ = __mul__

    def __truediv__(self, value: Complex | Fraction | int) -> Complex:
        other = self._like(value)
        if other.is_real:
            return Complex(self.re / other.re, self.im / other.re)
        square = _square(other.re) + _square(other.im)
        over = self * Complex(other.re, -other.im)
        return Complex(over.re / square, over.im / square)

    def __rtruediv__(self, value: Fraction | int) -> Complex:
        return self._like(value) / self

    def __pow__(self, n: int) -> Complex:
        if n < 1:
            raise ValueError("only positive powers are needed")
        return self if n == 1 else self ** (n - 1) * self

    def sincos(self) -> tuple[Complex, Complex]:
        """Return (sin, cos): sin(x + iy) = sin x cosh y + i cos x sinh y, and so on."""
        (sin, cos), up = self.re.sincos(), exp(self.im)
        down = 1 / up
        cosh, sinh = (up + down) / 2, (up - down) / 2
        return Complex(sin * cosh, cos * sinh), Complex(cos * cosh, -(sin * sinh))

    def widened(self, radius: Fraction) -> Complex:
        """Enclose what is so near to one of these numbers."""
        square = Enclosure.of(-radius, radius, self.re.bits)
        return Complex(self.re + square, self.im + square)

    @property
    def is_real(self) -> bool:
        """Whether the imaginary part is 0."""
        return self.im.lo == self.im.hi == 0

    @property
    def size(self) -> Fraction:
        """An upper bound of |z|."""
        x, y = (max(-part.lo, part.hi) for part in (self.re, self.im))
        return Fraction(x + y, 1 << self.re.bits)

    @property
    def spread(self) -> Fraction:
        """An upper bound of the distance of two of these numbers."""
        x, y = (part.hi - part.lo for part in (self.re, self.im))
        return Fraction(x + y, 1 << self.re.bits)

    @property
    def ranges(self) -> tuple[Range, Range]:
        """The real parts and the imaginary ones."""
        return self.re.range, self.im.range


def _square(x: Enclosure) -> Enclosure:
    """Enclose the squares of real numbers."""
    ends = x.lo * x.lo, x.hi * x.hi
    least = 0 if x.has_zero else min(ends)
    return Enclosure(least >> x.bits, -(-max(ends) >> x.bits), x.bits)


class Germ(NamedTuple):
    """A polynomial on an arc as a function of the angle: at the middle angle, and on the arc."""

    value: Complex
    rate: Complex
    values: Complex
    rates: Complex


@dataclass(frozen=True)
class Ellipse:
    """The closed ellipse E with foci a, b, the ends of `hull`, and rho > 1: Bernstein's.

    Its boundary is z = (a + b)/2 + (b - a)/2 u, u = (w + 1/w)/2 with |w| = rho; in u Chebyshev's
    polynomial is T_k = (w^k + w^-k)/2, |T_k| <= rho^k.
    """

    hull: Range
    rho: Fraction

    def __post_init__(self) -> None:
        if not (self.hull[0] < self.hull[1] and 1 < self.rho <= 100):
            raise Unproved("an ellipse has two foci, and rho above 1 and at most 100")

    @property
    def coordinates(self) -> Range:
        """The middle of the foci, and half their distance: z as a polynomial in u."""
        low, high = self.hull
        return (low + high) / 2, (high - low) / 2

    def contains(self, z: Complex) -> bool:
        """Whether it is proved that E contains all of these numbers."""
        middle, half = self.coordinates
        u = (z - middle) * (1 / half)
        axes = ((self.rho + 1 / self.rho) / 2, (self.rho - 1 / self.rho) / 2)
        x, y = (max(abs(a), abs(b)) / c for (a, b), c in zip(u.ranges, axes, strict=True))
        return x * x + y * y <= 1

    def arcs(self, count: int) -> list[Arc]:
        """Cut the upper half of the boundary into so many arcs."""
        return [Arc(self, j, count) for j in range(count)]


@dataclass(frozen=True)
class Arc:
    """The boundary of E for the angles of w from pi j / count to pi (j + 1) / count."""

    ellipse: Ellipse
    j: int
    count: int

    @cached_property
    def _powers(self) -> list[tuple[Complex, Complex, Fraction]]:
        """T_k at the middle angle, its derivative by the angle, and a bound of |T_k|."""
        return []

    def _known(self, terms: int) -> list[tuple[Complex, Complex, Fraction]]:
        found, rho = self._powers, self.ellipse.rho
        while len(found) < terms:
            k = len(found)
            angle = pi(BITS) * (k * (2 * self.j + 1)) / (2 * self.count)
            sin, cos = angle.sincos()
            big = rho**k
            axes = (big + 1 / big) / 2, (big - 1 / big) / 2
            long, short = (rational(axis, BITS) for axis in axes)
            rate = Complex(-(sin * long), cos * short) * k
            found.append((Complex(cos * long, sin * short), rate, long.range[1]))
        return found

    def germ(self, coefficients: Sequence[Fraction]) -> Germ:
        """Return p = sum of c_k T_k: its m-th derivative is at most that of k^m |c_k| max |T_k|."""
        value = rate = Complex.of(Fraction(0))
        first = second = Fraction(0)
        step = Fraction(11, 7) / self.count  # more than half the angle
        for k, (c, known) in enumerate(
            zip(coefficients, self._known(len(coefficients)), strict=False)
        ):
            value, rate = value + known[0] * c, rate + known[1] * c
            first += k * abs(c) * known[2]
            second += k * k * abs(c) * known[2]
        return Germ(value, rate, value.widened(first * step), rate.widened(second * step))
