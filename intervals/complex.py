"""ComplexInterval: a rectangle in the complex plane, two Intervals as real and imaginary part.

Every operation returns a box that contains op(z, w) for all z and w of its operands, at the larger
precision p of theirs. Inside, more bits are computed with, and the ends are rounded outward at
last: "the hull" below is the least box around all values, but for the last of its p bits.
"""

from __future__ import annotations

import re
from fractions import Fraction
from functools import reduce
from typing import TypeAlias

from intervals.analytic import GUARD, Analytic
from intervals.errors import DomainError
from intervals.exact import Exact, refuse_equality
from intervals.interval import Interval

Number: TypeAlias = "ComplexInterval | Interval | Fraction | int"


class ComplexInterval(Analytic):
    """The numbers x + i y with x in `real` and y in `imag`, which have one precision.

    ComplexInterval(Interval(1, 2), "0.2") is [1, 2] + 0.2 i; exact numbers and texts enter as in
    Interval, and what `str` prints is read as well. A complex number of Python consists of floats
    and raises TypeError; ComplexInterval.from_complex(z) takes the binary numbers themselves.
    """

    __slots__ = ("imag", "real")

    def __init__(
        self, real: Interval | Exact, imag: Interval | Exact = 0, *, precision: int | None = None
    ) -> None:
        if isinstance(real, str) and (both := re.fullmatch(r"(.*\]) \+ (\[.*)j", real)):
            real, imag = both[1], both[2]
        given = [x.precision for x in (real, imag) if isinstance(x, Interval)]
        bits = max(given, default=53) if precision is None else precision
        self.real, self.imag = (
            x.with_precision(bits) if isinstance(x, Interval) else Interval(x, precision=bits)
            for x in (real, imag)
        )

    @classmethod
    def from_complex(cls, value: complex, *, precision: int = 53) -> ComplexInterval:
        """Enclose the binary numbers in `value`, exactly from 53 bits on."""
        z = complex(value)
        return cls(*(Interval.from_float(x, precision=precision) for x in (z.real, z.imag)))

    # -- the set -------------------------------------------------------------------------------

    @property
    def mid(self) -> tuple[Fraction, Fraction]:
        """The exact centre."""
        return self.real.mid, self.imag.mid

    @property
    def wid(self) -> Fraction:
        """The exact larger side."""
        return max(self.real.wid, self.imag.wid)

    def hull(self, other: Number) -> ComplexInterval:
        """Return the smallest box that holds both."""
        w = self._required(other)
        return ComplexInterval(self.real.hull(w.real), self.imag.hull(w.imag))

    def intersection(self, other: Number) -> ComplexInterval | None:
        """Return the common part, None where there is none."""
        w = self._required(other)
        x, y = self.real.intersection(w.real), self.imag.intersection(w.imag)
        return None if x is None or y is None else ComplexInterval(x, y)

    def contains(self, other: Number) -> bool:
        """Return whether the other box, or exact real number, lies in this one."""
        x, y = self._pair(other)
        return self.real.contains(x) and self.imag.contains(y)

    def subset(self, other: Number) -> bool:
        """Return whether this box lies in the other."""
        x, y = self._pair(other)
        return self.real.subset(x) and self.imag.subset(y)

    def interior(self, other: Number) -> bool:
        """Return whether this box lies in the interior of the other."""
        x, y = self._pair(other)
        return self.real.interior(x) and self.imag.interior(y)

    def disjoint(self, other: Number) -> bool:
        """Return whether no number lies in both."""
        x, y = self._pair(other)
        return self.real.disjoint(x) or self.imag.disjoint(y)

    def _pair(self, other: Number) -> tuple[Interval | Fraction | int, Interval | int]:
        """Return the parts of the other, of a number without rounding: relations are exact."""
        if isinstance(other, ComplexInterval):
            return other.real, other.imag
        self._required(other)
        return other, 0

    def __eq__(self, other: object) -> bool:
        """Return equality as sets; with a number it raises TypeError, as for an Interval."""
        if not isinstance(other, ComplexInterval):
            refuse_equality(other)
            return NotImplemented
        return self.real == other.real and self.imag == other.imag

    def __hash__(self) -> int:
        return hash((self.real, self.imag))

    def __bool__(self) -> bool:
        raise TypeError("the truth of a box is not defined: compare it with something")

    # -- arithmetic ----------------------------------------------------------------------------

    def _other(self, value: object) -> ComplexInterval | None:
        if isinstance(value, ComplexInterval):
            return value
        if isinstance(value, complex):
            raise TypeError(f"{value!r} consists of floats: use ComplexInterval.from_complex")
        real = self.real._other(value)
        return None if real is None else ComplexInterval(real)

    def _required(self, value: object) -> ComplexInterval:
        other = self._other(value)
        if other is None:
            raise TypeError(f"not a box, an interval or an exact number: {value!r}")
        return other

    def _box(self, real: Interval, imag: Interval, precision: int) -> ComplexInterval:
        return ComplexInterval(real, imag, precision=precision)

    def __neg__(self) -> ComplexInterval:
        return ComplexInterval(-self.real, -self.imag)

    def conjugate(self) -> ComplexInterval:
        """Return the box of the numbers x - i y."""
        return ComplexInterval(self.real, -self.imag)

    def __add__(self, value: Number) -> ComplexInterval:
        """Return the hull of the sums."""
        w = self._other(value)
        if w is None:
            return NotImplemented
        return ComplexInterval(self.real + w.real, self.imag + w.imag)

    __radd__ = __add__

    def __sub__(self, value: Number) -> ComplexInterval:
        """Return the hull of the differences."""
        w = self._other(value)
        return NotImplemented if w is None else self + -w

    def __rsub__(self, value: Number) -> ComplexInterval:
        return -self + value

    def __mul__(self, value: Number) -> ComplexInterval:
        """Return the hull of the products, of which xu and yv are independent; so are xv and yu."""
        w = self._other(value)
        if w is None:
            return NotImplemented
        p = max(self.precision, w.precision)
        (x, y), (u, v) = self._parts(2 * p), w._parts(2 * p)
        return ComplexInterval(x * u - y * v, x * v + y * u, precision=p)

    __rmul__ = __mul__

    def __truediv__(self, value: Number) -> ComplexInterval:
        """Return what lies both in z (1/w) and in z conj(w) / |w|^2; DomainError if w may be 0."""
        w = self._other(value)
        if w is None:
            return NotImplemented
        p = max(self.precision, w.precision)
        z, w = self.with_precision(p + GUARD), w.with_precision(p + GUARD)
        quotient, product = z * w.recip(), z * w.conjugate()
        square = w.real.sqr() + w.imag.sqr()
        common = quotient.intersection(
            ComplexInterval(product.real / square, product.imag / square)
        )
        return (quotient if common is None else common).with_precision(p)

    def __rtruediv__(self, value: Number) -> ComplexInterval:
        w = self._other(value)
        return NotImplemented if w is None else w / self

    def recip(self) -> ComplexInterval:
        """Return the hull of 1/z = (x - i y) / |z|^2; DomainError where 0 is in the box."""
        if self.real.contains_zero() and self.imag.contains_zero():
            raise DomainError("division by a box that contains 0")
        (x, y), p = self._parts(2 * self.precision + GUARD), self.precision
        return ComplexInterval(_over_square(x, y), -_over_square(y, x), precision=p)

    def sqr(self) -> ComplexInterval:
        """Return the hull of the squares."""
        x, y = self._parts(2 * self.precision)
        return ComplexInterval(x.sqr() - y.sqr(), 2 * (x * y), precision=self.precision)

    def __pow__(self, n: int) -> ComplexInterval:
        """Return z^n by squares and products, for n < 0 of 1/z."""
        if not isinstance(n, int):
            return NotImplemented
        if n < 0:
            return self.recip() ** -n
        if n < 2:
            return self if n else ComplexInterval(1, precision=self.precision)
        half = (self ** (n // 2)).sqr()
        return half * self if n % 2 else half

    def __abs__(self) -> Interval:
        """Return the range of |z|."""
        return self.real.hypot(self.imag)

    # -- text ----------------------------------------------------------------------------------

    def __repr__(self) -> str:
        return f"ComplexInterval({self.real!r}, {self.imag!r})"

    def __str__(self) -> str:
        return f"{self.real} + {self.imag}j"

    def __format__(self, spec: str) -> str:
        """Return decimals that enclose, both parts as Interval formats them."""
        return f"{self.real:{spec}} + {self.imag:{spec}}j"


def _over_square(x: Interval, y: Interval) -> Interval:
    """Return the range of x / (x^2 + y^2) on a box without 0.

    It is odd in x, for x > 0 decreasing with |y|, and for fixed y rises in x from -|y| to |y| and
    falls beyond. So its extremes are at ends of x and |y|, or at x = +-t for the least |y| = t.
    """
    least = abs(y).inf
    places = [(a, b) for a in (x.inf, x.sup) for b in (least, abs(y).sup)]
    places += [(a, least) for a in (least, -least) if x.contains(a)]
    points = ((Interval(a, precision=x.precision), b) for a, b in places)
    return reduce(Interval.hull, (a / (a.sqr() + b * b) for a, b in points))
