"""Jets: truncated Taylor series in one variable, over any number type.

Theorem (Moore). If c_0, ..., c_n enclose the Taylor coefficients g^(k)(x) / k! of a function g
for every x in a set, then the rules below enclose those of the result; the k-th derivative is
k! c_k. Coefficients may be Intervals, IntervalArrays, Fractions, floats: anything with + - * /
(and sincos, exp, log, sqrt as methods where these are used).
"""

from __future__ import annotations

from math import factorial
from typing import Any


class Jet:
    """Taylor coefficients (c_0, ..., c_n); operations truncate to the shorter order."""

    __slots__ = ("coefficients",)
    __array_ufunc__ = None

    def __init__(self, *coefficients: Any) -> None:
        self.coefficients = coefficients

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
            return Jet(*(c / other for c in self.coefficients))
        a, b = pair
        quotient = [a[0] / b[0]]
        for k in range(1, len(a)):
            quotient.append((a[k] - _convolution(b, quotient, k, 1)) / b[0])
        return Jet(*quotient)

    def __rtruediv__(self, other: Any) -> Jet:
        b = self.coefficients
        quotient = [other / b[0]]
        for k in range(1, len(b)):
            quotient.append(-_convolution(b, quotient, k, 1) / b[0])
        return Jet(*quotient)

    def sincos(self) -> tuple[Jet, Jet]:
        """Return (sin, cos): s' = c u', c' = -s u', coefficient by coefficient."""
        u = self.coefficients
        slopes = [k * u[k] for k in range(len(u))]
        sin, cos = u[0].sincos()
        s, c = [sin], [cos]
        for k in range(1, len(u)):
            s.append(_convolution(slopes, c, k, 1) / k)
            c.append(-_convolution(slopes, s, k, 1) / k)
        return Jet(*s), Jet(*c)

    def sin(self) -> Jet:
        """Return the jet of sin u."""
        return self.sincos()[0]

    def cos(self) -> Jet:
        """Return the jet of cos u."""
        return self.sincos()[1]

    def exp(self) -> Jet:
        """Return the jet of exp u: y' = y u'."""
        u = self.coefficients
        slopes = [k * u[k] for k in range(len(u))]
        y = [u[0].exp()]
        for k in range(1, len(u)):
            y.append(_convolution(slopes, y, k, 1) / k)
        return Jet(*y)

    def log(self) -> Jet:
        """Return the jet of log u: y' u = u'."""
        u = self.coefficients
        y = [u[0].log()]
        for k in range(1, len(u)):
            rest = k * u[k]
            for j in range(1, k):
                rest = rest - j * y[j] * u[k - j]
            y.append(rest / u[0] / k)
        return Jet(*y)

    def sqrt(self) -> Jet:
        """Return the jet of sqrt u: y y = u."""
        u = self.coefficients
        y = [u[0].sqrt()]
        for k in range(1, len(u)):
            rest = u[k]
            for j in range(1, k):
                rest = rest - y[j] * y[k - j]
            y.append(rest / (2 * y[0]))
        return Jet(*y)

    def __repr__(self) -> str:
        return f"Jet({', '.join(map(repr, self.coefficients))})"


def _convolution(a: Any, b: Any, k: int, first: int) -> Any:
    """Return sum of a_j b_(k-j) for j = first, ..., k."""
    total = a[first] * b[k - first]
    for j in range(first + 1, k + 1):
        total = total + a[j] * b[k - j]
    return total
