"""Jets: truncated Taylor series in one variable, over any number type.

Theorem (Moore). If c_0, ..., c_n enclose the Taylor coefficients g^(k)(x) / k! of a function g
for every x in a set, then the rules below enclose those of the result; the k-th derivative is
k! c_k. Coefficients may be Intervals, IntervalArrays, Fractions, floats: anything with + - * /
(and the elementary functions as methods where these are used).
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from math import factorial
from typing import Any


class Jet:
    """Taylor coefficients (c_0, ..., c_n); operations truncate to the shorter order."""

    __slots__ = ("coefficients",)
    __array_ufunc__ = None

    def __init__(self, *coefficients: Any) -> None:
        self.coefficients = coefficients

    @classmethod
    def variable(cls, x: Any, order: int = 1) -> Jet:
        """Return the jet of the variable itself at x: (x, 1, 0, ..., 0)."""
        return cls(x, *(0 * x + int(k == 1) for k in range(1, order + 1)))

    @property
    def value(self) -> Any:
        """The function's value, c_0."""
        return self.coefficients[0]

    @property
    def order(self) -> int:
        """The order n of the last coefficient."""
        return len(self.coefficients) - 1

    def derivative(self, k: int = 1) -> Any:
        """Return the k-th derivative, k! c_k."""
        return self.coefficients[k] if k < 2 else self.coefficients[k] * factorial(k)

    def _pairs(self, other: Any) -> tuple[tuple[Any, ...], tuple[Any, ...]] | None:
        if not isinstance(other, Jet):
            return None
        n = min(len(self.coefficients), len(other.coefficients))
        return self.coefficients[:n], other.coefficients[:n]

    def __neg__(self) -> Jet:
        return Jet(*(-c for c in self.coefficients))

    def __add__(self, other: Any) -> Jet:
        pair = self._pairs(other)
        if pair is None:
            return Jet(self.coefficients[0] + other, *self.coefficients[1:])
        return Jet(*(a + b for a, b in zip(*pair, strict=True)))

    __radd__ = __add__

    def __sub__(self, other: Any) -> Jet:
        pair = self._pairs(other)
        if pair is None:
            return Jet(self.coefficients[0] - other, *self.coefficients[1:])
        return Jet(*(a - b for a, b in zip(*pair, strict=True)))

    def __rsub__(self, other: Any) -> Jet:
        return Jet(other - self.coefficients[0], *(-c for c in self.coefficients[1:]))

    def __mul__(self, other: Any) -> Jet:
        pair = self._pairs(other)
        if pair is None:
            return Jet(*(c * other for c in self.coefficients))
        a, b = pair
        return Jet(*(_convolution(a, b, k, 0) for k in range(len(a))))

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Jet:
        pair = self._pairs(other)
        if pair is None:
            return Jet(*(_over(c, other) for c in self.coefficients))
        a, b = pair
        quotient = [_over(a[0], b[0])]
        for k in range(1, len(a)):
            quotient.append(_over(a[k] - _convolution(b, quotient, k, 1), b[0]))
        return Jet(*quotient)

    def __rtruediv__(self, other: Any) -> Jet:
        b = self.coefficients
        quotient = [_over(other, b[0])]
        for k in range(1, len(b)):
            quotient.append(_over(-_convolution(b, quotient, k, 1), b[0]))
        return Jet(*quotient)

    def __pow__(self, n: int) -> Jet:
        """Return the n-th power, n >= 0 by repeated squaring."""
        if not isinstance(n, int):
            return NotImplemented
        if n < 0:
            return 1 / self**-n
        if n == 0:
            return Jet(self.value**0, *(0 * c for c in self.coefficients[1:]))
        half = self ** (n // 2) if n > 1 else None
        if half is None:
            return self
        return half.sqr() * self if n % 2 else half.sqr()

    def sqr(self) -> Jet:
        """Return the square; its value has no dependency where the number type has `sqr`."""
        u, square = self.coefficients, (self * self).coefficients
        return Jet(u[0].sqr() if hasattr(u[0], "sqr") else square[0], *square[1:])

    def recip(self) -> Jet:
        """Return 1 / u."""
        return 1 / self

    # -- elementary functions: each is the solution of a differential equation --------------------

    def _slopes(self) -> list[Any]:
        """Return k u_k, the coefficients of t u'."""
        return [k * u for k, u in enumerate(self.coefficients)]

    def _primitive(self, value: Any, slope: Callable[[Jet], Jet]) -> Jet:
        """Return y with y_0 = value and y' = g u', g = slope(u): k y_k = sum of j u_j g_(k-j)."""
        if not self.order:
            return Jet(value)
        slopes, g = self._slopes(), slope(Jet(*self.coefficients[:-1])).coefficients
        rest = (_over(_convolution(slopes, g, k, 1), k) for k in range(1, len(slopes)))
        return Jet(value, *rest)

    def _circle(self, first: Any, second: Any, sign: int) -> tuple[Jet, Jet]:
        """Return (s, c) with s' = c u', c' = sign s u'."""
        slopes = self._slopes()
        s, c = [first], [second]
        for k in range(1, len(slopes)):
            s.append(_over(_convolution(slopes, c, k, 1), k))
            c.append(_over(sign * _convolution(slopes, s, k, 1), k))
        return Jet(*s), Jet(*c)

    def sincos(self) -> tuple[Jet, Jet]:
        """Return (sin, cos): s' = c u', c' = -s u'."""
        sin, cos = self.value.sincos()
        return self._circle(sin, cos, -1)

    def sin(self) -> Jet:
        """Return the jet of sin u."""
        return self.sincos()[0]

    def cos(self) -> Jet:
        """Return the jet of cos u."""
        return self.sincos()[1]

    def tan(self) -> Jet:
        """Return the jet of tan u: y' = u' / cos(u)^2."""
        return self._primitive(self.value.tan(), lambda u: 1 / u.cos().sqr())

    def sinh(self) -> Jet:
        """Return the jet of sinh u: s' = c u'."""
        return self._circle(self.value.sinh(), self.value.cosh(), 1)[0]

    def cosh(self) -> Jet:
        """Return the jet of cosh u: c' = s u'."""
        return self._circle(self.value.sinh(), self.value.cosh(), 1)[1]

    def tanh(self) -> Jet:
        """Return the jet of tanh u: y' = u' / cosh(u)^2."""
        return self._primitive(self.value.tanh(), lambda u: 1 / u.cosh().sqr())

    def exp(self) -> Jet:
        """Return the jet of exp u: y' = y u'."""
        slopes, y = self._slopes(), [self.value.exp()]
        for k in range(1, len(slopes)):
            y.append(_over(_convolution(slopes, y, k, 1), k))
        return Jet(*y)

    def expm1(self) -> Jet:
        """Return the jet of exp(u) - 1."""
        return Jet(self.value.expm1(), *self.exp().coefficients[1:])

    def log(self) -> Jet:
        """Return the jet of log u: y' = u' / u."""
        return self._primitive(self.value.log(), Jet.recip)

    def log1p(self) -> Jet:
        """Return the jet of log(1 + u)."""
        return self._primitive(self.value.log1p(), lambda u: 1 / (1 + u))

    def atan(self) -> Jet:
        """Return the jet of atan u: y' = u' / (1 + u^2)."""
        return self._primitive(self.value.atan(), lambda u: 1 / (1 + u.sqr()))

    def asin(self) -> Jet:
        """Return the jet of asin u, |u| < 1: y' = u' / sqrt(1 - u^2)."""
        return self._primitive(self.value.asin(), lambda u: 1 / (1 - u.sqr()).sqrt())

    def acos(self) -> Jet:
        """Return the jet of acos u, |u| < 1: y' = -u' / sqrt(1 - u^2)."""
        return self._primitive(self.value.acos(), lambda u: -1 / (1 - u.sqr()).sqrt())

    def asinh(self) -> Jet:
        """Return the jet of asinh u: y' = u' / sqrt(1 + u^2)."""
        return self._primitive(self.value.asinh(), lambda u: 1 / (1 + u.sqr()).sqrt())

    def acosh(self) -> Jet:
        """Return the jet of acosh u, u > 1: y' = u' / sqrt(u^2 - 1)."""
        return self._primitive(self.value.acosh(), lambda u: 1 / (u.sqr() - 1).sqrt())

    def atanh(self) -> Jet:
        """Return the jet of atanh u: y' = u' / (1 - u^2)."""
        return self._primitive(self.value.atanh(), lambda u: 1 / (1 - u.sqr()))

    def sqrt(self) -> Jet:
        """Return the jet of sqrt u, u > 0: y y = u."""
        u, y = self.coefficients, [self.value.sqrt()]
        for k in range(1, len(u)):
            rest = u[k] - _convolution(y, y, k, 1, k - 1) if k > 1 else u[k]
            y.append(rest / (2 * y[0]))
        return Jet(*y)

    def __repr__(self) -> str:
        return f"Jet({', '.join(map(repr, self.coefficients))})"


def _over(a: Any, b: Any) -> Any:
    """Return a / b, which for two ints would be a rounded float."""
    return Fraction(a, b) if isinstance(a, int) and isinstance(b, int) else a / b


def _convolution(a: Any, b: Any, k: int, first: int, last: int | None = None) -> Any:
    """Return sum of a_j b_(k-j) for j = first, ..., last (k if not given)."""
    total = a[first] * b[k - first]
    for j in range(first + 1, (k if last is None else last) + 1):
        total = total + a[j] * b[k - j]
    return total
