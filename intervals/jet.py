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
from typing import Any, NoReturn

from intervals.errors import HINT, DomainError
from intervals.functions import TABLE, Elementary
from intervals.generic import where

_NEAR = Fraction(1, 2**1000)


class Jet(Elementary):
    """Taylor coefficients (c_0, ..., c_n); operations truncate to the shorter order.

    A function is at least as often differentiable as the order says on all numbers that c_0 holds;
    else DomainError.
    """

    __slots__ = ("coefficients",)

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **options: Any) -> Any:
        from intervals.numpy_protocol import jet_ufunc

        return jet_ufunc(self, ufunc, method, inputs, options)

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

    def _undefined(self, _other: object = None) -> NoReturn:
        raise TypeError(f"a jet has no truth, order, place or parts: {HINT}")

    __eq__ = __ne__ = __lt__ = __le__ = __gt__ = __ge__ = _undefined
    __bool__ = __hash__ = __iter__ = _undefined

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

    def __pow__(self, exponent: Any) -> Jet:
        """Return u^n, for an int n also where u <= 0: y' = n u^(n-1) u'; else see `pow`."""
        if not isinstance(exponent, int):
            return self.pow(exponent)
        if exponent < 0:
            return 1 / self**-exponent
        if exponent == 0:
            return 0 * self + 1
        if exponent < 3:
            return self if exponent == 1 else self.sqr()
        power = self.value**exponent
        return self._primitive(power, lambda u: exponent * u ** (exponent - 1))

    def __rpow__(self, base: Any) -> Jet:
        return self.constant(base).pow(self)

    def sqr(self) -> Jet:
        """Return the square; its value has no dependency where the number type has `sqr`."""
        u, square = self.coefficients, (self * self).coefficients
        return Jet(u[0].sqr() if hasattr(u[0], "sqr") else square[0], *square[1:])

    def recip(self) -> Jet:
        """Return 1 / u."""
        return 1 / self

    # -- elementary functions: each is the solution of a differential equation --------------------

    def constant(self, value: Any) -> Jet:
        """Return the jet of a constant; a jet as it is."""
        return value if isinstance(value, Jet) else 0 * self + value

    def _with_value(self, value: Any) -> Jet:
        """Return this jet with another enclosure of its value."""
        return Jet(value, *self.coefficients[1:])

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

    def _monotone(self, name: str) -> Jet:
        """Return the jet of the function of this name, from its slope, or of a step."""
        value, slope = getattr(self.value, name)(), TABLE[name].slope
        return self._primitive(value, slope) if slope else self._step(name, value)

    def _step(self, name: str, value: Any) -> Jet:
        """Return the jet of a function that is constant between its jumps.

        Theorem. Where the step over a neighbourhood of X is one number, all derivatives vanish on
        X. Elsewhere X may hold a jump, and DomainError is raised.
        """
        if self.order:
            near = getattr(self.value.widen(_NEAR), name)()
            if not _everywhere(near.inf == near.sup):
                raise DomainError(f"{name} may jump where its derivatives are asked")
        return (0 * self)._with_value(value)

    def __abs__(self) -> Jet:
        """Return the jet of |u| = sign(u) u; DomainError where u may be 0, unless of order 0."""
        return (self.sign() * self)._with_value(abs(self.value))

    def maximum(self, other: Any) -> Jet:
        """Return the jet of max(u, v); DomainError where u - v may be 0, unless of order 0."""
        v = self.constant(other)
        largest = self.value.maximum(v.value)
        left = (self - v).sign().value.inf > 0
        pairs = list(zip(*(self._pairs(v) or ()), strict=True))[1:]
        return Jet(largest, *(where(left, a, b) for a, b in pairs))

    def minimum(self, other: Any) -> Jet:
        """Return the jet of min(u, v); DomainError where u - v may be 0, unless of order 0."""
        return -(-self).maximum(-self.constant(other))

    def sincos(self) -> tuple[Jet, Jet]:
        """Return (sin, cos): s' = c u', c' = -s u'."""
        slopes, (first, second) = self._slopes(), self.value.sincos()
        s, c = [first], [second]
        for k in range(1, len(slopes)):
            s.append(_over(_convolution(slopes, c, k, 1), k))
            c.append(_over(-_convolution(slopes, s, k, 1), k))
        return Jet(*s), Jet(*c)

    def sin(self) -> Jet:
        """Return the jet of sin u."""
        return self.sincos()[0]

    def cos(self) -> Jet:
        """Return the jet of cos u."""
        return self.sincos()[1]

    def cosh(self) -> Jet:
        """Return the jet of cosh u: y' = sinh(u) u'."""
        return self._monotone("cosh")

    def exp(self) -> Jet:
        """Return the jet of exp u: y' = y u'."""
        slopes, y = self._slopes(), [self.value.exp()]
        for k in range(1, len(slopes)):
            y.append(_over(_convolution(slopes, y, k, 1), k))
        return Jet(*y)

    def sqrt(self) -> Jet:
        """Return the jet of sqrt u, u > 0: y y = u."""
        u, y = self.coefficients, [self.value.sqrt()]
        for k in range(1, len(u)):
            rest = u[k] - _convolution(y, y, k, 1, k - 1) if k > 1 else u[k]
            y.append(rest / (2 * y[0]))
        return Jet(*y)

    def pow(self, exponent: Any) -> Jet:
        """Return the jet of u^v = exp(v log u), u > 0; for a constant v: u y' = v y u'."""
        if isinstance(exponent, Jet):
            value = self.value.pow(exponent.value)
            return (exponent * self.log()).exp()._with_value(value)
        value = self.value.pow(exponent)
        u, y = self.coefficients, [value]
        for k in range(1, len(u)):
            terms = ((exponent * j - (k - j)) * u[j] * y[k - j] for j in range(1, k + 1))
            y.append(sum(terms, 0 * value) / (k * u[0]))
        return Jet(*y)

    def rootn(self, n: int) -> Jet:
        """Return the jet of the real n-th root y of u != 0, u > 0 for even n: n u y' = y u'."""
        value = self.value.rootn(n)
        if not self.order:
            return Jet(value)
        root = self if n % 2 == 0 else abs(self)
        return (root.pow(Fraction(1, n)) * (1 if n % 2 == 0 else self.sign()))._with_value(value)

    def hypot(self, other: Any) -> Jet:
        """Return the jet of sqrt(u^2 + v^2), where it is not 0."""
        v = self.constant(other)
        return (self.sqr() + v.sqr()).sqrt()._with_value(self.value.hypot(v.value))

    def atan2(self, x: Any) -> Jet:
        """Return the jet of the angle of the points (x, y): (x y' - y x') / (x^2 + y^2).

        DomainError where the box meets the cut y = 0, x <= 0, unless of order 0.
        """
        v = self.constant(x)
        value = self.value.atan2(v.value)
        if not (self.order and v.order):
            return Jet(value)
        if not _everywhere((v.value.inf > 0) | (self.value.mig > 0)):
            raise DomainError("atan2 may jump where its derivatives are asked")
        turn = v * Jet(*self._slopes()[1:]) - self * Jet(*v._slopes()[1:])
        turn = turn / (self.sqr() + v.sqr())
        return Jet(value, *(_over(g, k) for k, g in enumerate(turn.coefficients, 1)))

    def __repr__(self) -> str:
        return f"Jet({', '.join(map(repr, self.coefficients))})"


def _everywhere(mask: Any) -> bool:
    """Whether a truth, of one number or of an array, holds everywhere."""
    return mask if isinstance(mask, bool) else bool(mask.all())


def _over(a: Any, b: Any) -> Any:
    """Return a / b, which for two ints would be a rounded float."""
    return Fraction(a, b) if isinstance(a, int) and isinstance(b, int) else a / b


def _convolution(a: Any, b: Any, k: int, first: int, last: int | None = None) -> Any:
    """Return sum of a_j b_(k-j) for j = first, ..., last (k if not given)."""
    total = a[first] * b[k - first]
    for j in range(first + 1, (k if last is None else last) + 1):
        total = total + a[j] * b[k - j]
    return total
