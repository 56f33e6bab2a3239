"""The elementary functions: their names, their domains, and where they are monotone.

f(X) is the set of f(x) for x in X. X must lie in the natural domain of f, the set where f(x) is a
real number; else DomainError, since f(X) would then describe only a part of X.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any, NamedTuple, Self, TypeVar

_N = TypeVar("_N")


class Domain(NamedTuple):
    """An interval of reals; None stands for no end, `closed` is about the ends there are."""

    low: int | None
    high: int | None
    closed: bool

    def __str__(self) -> str:
        left, right = "[]" if self.closed else "()"
        low = f"{left}{self.low}" if self.low is not None else "(-oo"
        return f"{low}, {self.high}{right}" if self.high is not None else f"{low}, oo)"


DOMAINS = {
    "sqrt": Domain(0, None, closed=True),
    "log": Domain(0, None, closed=False),
    "log2": Domain(0, None, closed=False),
    "log10": Domain(0, None, closed=False),
    "log1p": Domain(-1, None, closed=False),
    "asin": Domain(-1, 1, closed=True),
    "acos": Domain(-1, 1, closed=True),
    "acosh": Domain(1, None, closed=True),
    "atanh": Domain(-1, 1, closed=False),
}
DECREASING = frozenset({"acos"})  # of the functions that are monotone on their domain


class Elementary:
    """The elementary functions as methods, for Interval and IntervalArray."""

    __slots__ = ()

    def _monotone(self, name: str) -> Self:
        """Return f(X) for a function that is monotone on its domain, which X is checked to be in.

        Beside the named functions this is cosh, for X within x >= 0.
        """
        raise NotImplementedError

    def __abs__(self) -> Self:
        raise NotImplementedError

    def __neg__(self) -> Self:
        raise NotImplementedError

    def __sub__(self, other: Any) -> Self:
        raise NotImplementedError

    def sqrt(self) -> Self:
        """Return the square root; the domain is x >= 0."""
        return self._monotone("sqrt")

    def cbrt(self) -> Self:
        """Return the real cube root."""
        return self._monotone("cbrt")

    def rootn(self, n: int) -> Self:
        """Return the real n-th root, n >= 1; the domain is x >= 0 for even n."""
        if n < 1:
            raise ValueError("a root has a degree of at least 1")
        if n % 2 == 0:
            return self.sqrt().rootn(n // 2)
        if n in (1, 3):
            return self if n == 1 else self.cbrt()
        return self.maximum(0).pow(Fraction(1, n)) - (-self).maximum(0).pow(Fraction(1, n))

    def exp(self) -> Self:
        """Return e^x; OverflowError where it is beyond the range of the number type."""
        return self._monotone("exp")

    def exp2(self) -> Self:
        """Return 2^x."""
        return self._monotone("exp2")

    def exp10(self) -> Self:
        """Return 10^x."""
        return self._monotone("exp10")

    def expm1(self) -> Self:
        """Return e^x - 1, accurate near 0."""
        return self._monotone("expm1")

    def log(self) -> Self:
        """Return the natural logarithm; the domain is x > 0."""
        return self._monotone("log")

    def log2(self) -> Self:
        """Return the logarithm to base 2; the domain is x > 0."""
        return self._monotone("log2")

    def log10(self) -> Self:
        """Return the logarithm to base 10; the domain is x > 0."""
        return self._monotone("log10")

    def log1p(self) -> Self:
        """Return log(1 + x), accurate near 0; the domain is x > -1."""
        return self._monotone("log1p")

    def asin(self) -> Self:
        """Return the arc sine in [-pi/2, pi/2]; the domain is [-1, 1]."""
        return self._monotone("asin")

    def acos(self) -> Self:
        """Return the arc cosine in [0, pi]; the domain is [-1, 1]."""
        return self._monotone("acos")

    def atan(self) -> Self:
        """Return the arc tangent in (-pi/2, pi/2)."""
        return self._monotone("atan")

    def sinh(self) -> Self:
        """Return the hyperbolic sine."""
        return self._monotone("sinh")

    def cosh(self) -> Self:
        """Return the hyperbolic cosine, which is even and increases with |x|."""
        return self.__abs__()._monotone("cosh")

    def tanh(self) -> Self:
        """Return the hyperbolic tangent."""
        return self._monotone("tanh")

    def asinh(self) -> Self:
        """Return the inverse hyperbolic sine."""
        return self._monotone("asinh")

    def acosh(self) -> Self:
        """Return the inverse hyperbolic cosine >= 0; the domain is x >= 1."""
        return self._monotone("acosh")

    def atanh(self) -> Self:
        """Return the inverse hyperbolic tangent; the domain is (-1, 1)."""
        return self._monotone("atanh")

    def sin(self) -> Self:
        """Return the sine."""
        raise NotImplementedError

    def cos(self) -> Self:
        """Return the cosine."""
        raise NotImplementedError

    def tan(self) -> Self:
        """Return the tangent; DomainError where a pole is, or may be, inside."""
        raise NotImplementedError

    def floor(self) -> Self:
        """Return the hull of the largest integers <= x."""
        return self._monotone("floor")

    def ceil(self) -> Self:
        """Return the hull of the smallest integers >= x."""
        return self._monotone("ceil")

    def trunc(self) -> Self:
        """Return the hull of x without its fraction."""
        return self._monotone("trunc")

    def round_ties_to_even(self) -> Self:
        """Return the hull of the nearest integers, the even one of two."""
        return self._monotone("round_ties_to_even")

    def round_ties_to_away(self) -> Self:
        """Return the hull of the nearest integers, of two the one farther from 0."""
        return self._monotone("round_ties_to_away")

    def sign(self) -> Self:
        """Return the hull of the signs -1, 0, 1."""
        return self._monotone("sign")

    def atan2(self, x: Any) -> Self:
        """Return the angle in (-pi, pi] of the points (x, y), y in this interval.

        The origin is outside the domain. Where a box lies on both sides of the cut y = 0, x < 0,
        or touches it from below, the angles jump, and the result is [-pi, pi].
        """
        raise NotImplementedError

    def hypot(self, other: Any) -> Self:
        """Return sqrt(x^2 + y^2)."""
        raise NotImplementedError

    def pow(self, exponent: Any) -> Self:
        """Return x^y for real y; the domain is x > 0, and x = 0 with y > 0."""
        raise NotImplementedError

    def minimum(self, other: Any) -> Self:
        """Return the range of min(x, y)."""
        raise NotImplementedError

    def maximum(self, other: Any) -> Self:
        """Return the range of max(x, y)."""
        raise NotImplementedError


def _function(name: str) -> Callable[[_N], _N]:
    """Return the function that calls the method `name`: of an Interval, IntervalArray or Jet."""

    def function(x: Any) -> Any:
        method = getattr(x, name, None)
        if method is None:
            raise TypeError(f"{name} takes an Interval, an IntervalArray or a Jet, not {x!r}")
        return method()

    function.__name__ = function.__qualname__ = name
    function.__doc__ = f"Enclose {name} over x: see Elementary.{name}."
    return function


sqrt = _function("sqrt")
cbrt = _function("cbrt")
exp = _function("exp")
exp2 = _function("exp2")
exp10 = _function("exp10")
expm1 = _function("expm1")
log = _function("log")
log2 = _function("log2")
log10 = _function("log10")
log1p = _function("log1p")
sin = _function("sin")
cos = _function("cos")
tan = _function("tan")
asin = _function("asin")
acos = _function("acos")
atan = _function("atan")
sinh = _function("sinh")
cosh = _function("cosh")
tanh = _function("tanh")
asinh = _function("asinh")
acosh = _function("acosh")
atanh = _function("atanh")
floor = _function("floor")
ceil = _function("ceil")
trunc = _function("trunc")
round_ties_to_even = _function("round_ties_to_even")
round_ties_to_away = _function("round_ties_to_away")
sign = _function("sign")


def _function_of_two(name: str) -> Callable[[Any, Any], Any]:
    """Return the function of two variables that calls the method `name` of the first."""

    def function(x: Any, y: Any) -> Any:
        if not hasattr(x, name) and hasattr(y, name):
            x = 0 * y + x  # an exact number beside an interval
        if not hasattr(x, name):
            raise TypeError(f"{name} takes an Interval or an IntervalArray, not {x!r} and {y!r}")
        return getattr(x, name)(y)

    function.__name__ = function.__qualname__ = name
    function.__doc__ = f"Enclose {name} over x and y: see Elementary.{name}."
    return function


atan2 = _function_of_two("atan2")
hypot = _function_of_two("hypot")
pow = _function_of_two("pow")
minimum = _function_of_two("minimum")
maximum = _function_of_two("maximum")


def rootn(x: _N, n: int) -> _N:
    """Enclose the real n-th root over x: see Elementary.rootn."""
    if not isinstance(x, Elementary):
        raise TypeError(f"rootn takes an Interval, an IntervalArray or a Jet, not {x!r}")
    return x.rootn(n)
