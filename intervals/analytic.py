"""Analytic functions of boxes in the complex plane, by Intervals x and y with z = x + i y.

Principal values have their cut on the negative reals, which belong to the upper side, as in C:
arg(-1) = pi. A box on both sides of the cut, or one that touches it from below, has values far
apart, and raises DomainError; one that touches it from above does not. "The hull" is the least box
around the values, but for the last bit.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any, Self

from intervals.errors import DomainError
from intervals.interval import Interval

GUARD = 20  # bits beyond the precision


class Analytic:
    """The functions as methods, for ComplexInterval."""

    __slots__ = ()
    real: Interval
    imag: Interval

    @property
    def precision(self) -> int:
        """The precision in bits of both parts."""
        return self.real.precision

    def with_precision(self, precision: int) -> Self:
        """Return an enclosure of this box at another precision."""
        return self._box(self.real, self.imag, precision)

    def _parts(self, bits: int) -> tuple[Interval, Interval]:
        return self.real.with_precision(bits), self.imag.with_precision(bits)

    def _box(self, real: Interval, imag: Interval, precision: int) -> Self:
        """Return a box at a precision."""
        raise NotImplementedError

    def __neg__(self) -> Self:
        raise NotImplementedError

    def __truediv__(self, other: Any) -> Self:
        raise NotImplementedError

    def arg(self) -> Interval:
        """Return the range of the angles in (-pi, pi]; DomainError at 0 and across the cut."""
        self._require_one_side("arg")
        return self.imag.atan2(self.real)

    def _require_one_side(self, name: str) -> None:
        if self.real.inf < 0 and self.imag.inf < 0 <= self.imag.sup:
            raise DomainError(f"{name} of a box on both sides of the cut, the negative reals")

    def _of_parts(self, *functions: Callable[[Interval, Interval], Interval]) -> Self:
        """Return the box of two functions of x and y."""
        x, y = self._parts(self.precision + GUARD)
        real, imag = (f(x, y) for f in functions)
        return self._box(real, imag, self.precision)

    def log(self) -> Self:
        """Return log|z| + i arg z, the hull where |z| is not near 1; DomainError as for `arg`."""
        self._require_one_side("log")
        return self._of_parts(lambda x, y: x.hypot(y).log(), lambda x, y: y.atan2(x))

    def sqrt(self) -> Self:
        """Return the hull of the roots with real part >= 0; DomainError across the cut.

        Theorem. With r = |z|, Re sqrt(z) = sqrt((r + x) / 2) increases with x and with |y|. Im
        sqrt(z), which is sqrt((r - x) / 2) with the sign of y, increases with y, decreases with x
        where y > 0, increases with x where y < 0.
        """
        self._require_one_side("sqrt")
        x, y = self._parts(2 * self.precision + GUARD)
        size = abs(y)
        real = _root(x.inf, size.inf, x)[0].hull(_root(x.sup, size.sup, x)[0])
        low = _root(x.inf if y.inf < 0 else x.sup, y.inf, x)[1]
        imag = low.hull(_root(x.inf if y.sup >= 0 else x.sup, y.sup, x)[1])
        return self._box(real, imag, self.precision)

    def exp(self) -> Self:
        """Return the hull of e^x cos y + i e^x sin y."""
        return self._of_parts(lambda x, y: x.exp() * y.cos(), lambda x, y: x.exp() * y.sin())

    def sin(self) -> Self:
        """Return the hull of sin x cosh y + i cos x sinh y."""
        return self._of_parts(lambda x, y: x.sin() * y.cosh(), lambda x, y: x.cos() * y.sinh())

    def cos(self) -> Self:
        """Return the hull of cos x cosh y - i sin x sinh y."""
        return self._of_parts(lambda x, y: x.cos() * y.cosh(), lambda x, y: -x.sin() * y.sinh())

    def sincos(self) -> tuple[Self, Self]:
        """Return (sin z, cos z)."""
        return self.sin(), self.cos()

    def tan(self) -> Self:
        """Return sin z / cos z; DomainError where a pole is, or may be, inside."""
        sin, cos = self.with_precision(self.precision + GUARD).sincos()
        return (sin / cos).with_precision(self.precision)

    def _turned(self) -> Self:
        """Return i z."""
        return self._box(-self.imag, self.real, self.precision)

    def sinh(self) -> Self:
        """Return the hull of sinh z = -i sin(i z)."""
        return -self._turned().sin()._turned()

    def cosh(self) -> Self:
        """Return the hull of cosh z = cos(i z)."""
        return self._turned().cos()

    def tanh(self) -> Self:
        """Return tanh z = -i tan(i z); DomainError where a pole is, or may be, inside."""
        return -self._turned().tan()._turned()


def _root(x: Fraction, y: Fraction, like: Interval) -> tuple[Interval, Interval]:
    """Return real and imaginary part of the root of one number, without cancellation."""
    a, b = (Interval(q, precision=like.precision) for q in (x, y))
    large = ((a.hypot(b) + abs(a)) / 2).sqrt()
    if large.sup == 0:
        return large, large
    small = b / (2 * large)
    return (large, small) if x >= 0 else (abs(small), -large if y < 0 else large)
