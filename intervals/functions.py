"""The elementary functions: one table of their names, domains, limits, slopes and inverses.

f(X) is the set of f(x) for x in X. X must lie in the natural domain of f, the set where f(x) is a
real number; else DomainError, since f(X) would then describe only a part of X.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from importlib import import_module
from math import inf
from typing import Any, NamedTuple, Protocol, Self, TypeVar, cast, overload

_S = TypeVar("_S")


class Number(Protocol):
    """A number, or set of numbers, of a type that has the functions as methods."""

    def exp(self) -> Any:
        """Return e^x."""


_N = TypeVar("_N", bound=Number)

__all__ = [
    "acos",
    "acosh",
    "asin",
    "asinh",
    "atan",
    "atan2",
    "atanh",
    "cbrt",
    "ceil",
    "cos",
    "cosh",
    "exp",
    "exp2",
    "exp10",
    "expm1",
    "floor",
    "hypot",
    "log",
    "log1p",
    "log2",
    "log10",
    "maximum",
    "minimum",
    "pow",
    "rootn",
    "round_ties_to_away",
    "round_ties_to_even",
    "sign",
    "sin",
    "sinh",
    "sqrt",
    "tan",
    "tanh",
    "trunc",
]


class Domain(NamedTuple):
    """An interval of reals; None stands for no end, `closed` is about the ends there are."""

    low: int | None
    high: int | None
    closed: bool

    def __str__(self) -> str:
        left, right = "[]" if self.closed else "()"
        low = f"{left}{self.low}" if self.low is not None else "(-oo"
        return f"{low}, {self.high}{right}" if self.high is not None else f"{low}, oo)"


REALS = Domain(None, None, closed=True)
_POSITIVE = Domain(0, None, closed=False)


@dataclass(frozen=True, eq=False)
class Function:
    """A function of one variable; called with a number of any kind, an exact one too, it is f.

    limits: at the ends of the domain that are open or infinite. falls: decreasing, of those that
    are monotone on their domain. slope: g with f(u)' = g(u) u' for jets, None for steps. undo:
    given arrays Z and U, a superset of {x in U: f(x) in Z}; None where `reverse` has it.
    """

    name: str
    text: str
    domain: Domain = REALS
    slope: Callable[[Any], Any] | None = None
    undo: Callable[[Any, Any], Any] | None = None
    limits: tuple[float, float] = (-inf, inf)
    falls: bool = False

    def __post_init__(self) -> None:
        object.__setattr__(self, "__doc__", self.text)
        TABLE[self.name] = self

    @overload
    def __call__(self, x: int | Fraction) -> Any: ...
    @overload
    def __call__(self, x: _N) -> _N: ...
    def __call__(self, x: Any) -> Any:
        return getattr(_with_methods(self.name, x), self.name)()


TABLE: dict[str, Function] = {}


def _with_methods(name: str, x: Any) -> Any:
    """Return x, an exact number as an Interval; TypeError for what has no such function."""
    if hasattr(x, name):
        return x
    if isinstance(x, int | Fraction):
        return import_module("intervals.interval").Interval(x)
    raise TypeError(f"{name} takes an Interval, IntervalArray, Jet or exact number, not {x!r}")


sqrt = Function(
    "sqrt",
    "Return the square root; the domain is x >= 0.",
    Domain(0, None, closed=True),
    lambda u: 1 / (2 * u.sqrt()),
    lambda z, u: z.sqr(),
)
cbrt = Function(
    "cbrt",
    "Return the real cube root.",
    slope=lambda u: 1 / (3 * u.cbrt().sqr()),
    undo=lambda z, u: z**3,
)
exp = Function("exp", "Return e^x.", slope=lambda u: u.exp(), limits=(0, inf))
exp2 = Function(
    "exp2",
    "Return 2^x.",
    slope=lambda u: u.exp2() * u.constant(2).log(),
    undo=lambda z, u: z.log2(),
    limits=(0, inf),
)
exp10 = Function(
    "exp10",
    "Return 10^x.",
    slope=lambda u: u.exp10() * u.constant(10).log(),
    undo=lambda z, u: z.log10(),
    limits=(0, inf),
)
expm1 = Function(
    "expm1",
    "Return e^x - 1, accurate near 0.",
    slope=lambda u: u.exp(),
    undo=lambda z, u: z.log1p(),
    limits=(-1, inf),
)
log = Function(
    "log",
    "Return the natural logarithm; the domain is x > 0.",
    _POSITIVE,
    lambda u: 1 / u,
    lambda z, u: z.exp(),
)
log2 = Function(
    "log2",
    "Return the logarithm to base 2; the domain is x > 0.",
    _POSITIVE,
    lambda u: 1 / (u * u.constant(2).log()),
    lambda z, u: z.exp2(),
)
log10 = Function(
    "log10",
    "Return the logarithm to base 10; the domain is x > 0.",
    _POSITIVE,
    lambda u: 1 / (u * u.constant(10).log()),
    lambda z, u: z.exp10(),
)
log1p = Function(
    "log1p",
    "Return log(1 + x), accurate near 0; the domain is x > -1.",
    Domain(-1, None, closed=False),
    lambda u: 1 / (1 + u),
    lambda z, u: z.expm1(),
)
sin = Function("sin", "Return the sine.", slope=lambda u: u.cos(), limits=(-1, 1))
cos = Function("cos", "Return the cosine.", slope=lambda u: -u.sin(), limits=(-1, 1))
tan = Function(
    "tan",
    "Return the tangent; DomainError where a pole is, or may be, inside.",
    slope=lambda u: 1 / u.cos().sqr(),
)
asin = Function(
    "asin",
    "Return the arc sine in [-pi/2, pi/2]; the domain is [-1, 1].",
    Domain(-1, 1, closed=True),
    lambda u: 1 / (1 - u.sqr()).sqrt(),
    lambda z, u: z.sin(),
)
acos = Function(
    "acos",
    "Return the arc cosine in [0, pi]; the domain is [-1, 1].",
    Domain(-1, 1, closed=True),
    lambda u: -1 / (1 - u.sqr()).sqrt(),
    lambda z, u: z.cos(),
    falls=True,
)
atan = Function(
    "atan",
    "Return the arc tangent in (-pi/2, pi/2).",
    slope=lambda u: 1 / (1 + u.sqr()),
    undo=lambda z, u: z.tan(),
    limits=(-1.5707963267948968, 1.5707963267948968),  # and a little more
)
sinh = Function(
    "sinh", "Return the hyperbolic sine.", slope=lambda u: u.cosh(), undo=lambda z, u: z.asinh()
)
cosh = Function(
    "cosh",
    "Return the hyperbolic cosine, which is even and increases with |x|.",
    slope=lambda u: u.sinh(),
)
tanh = Function(
    "tanh",
    "Return the hyperbolic tangent.",
    slope=lambda u: 1 / u.cosh().sqr(),
    undo=lambda z, u: z.atanh(),
    limits=(-1, 1),
)
asinh = Function(
    "asinh",
    "Return the inverse hyperbolic sine.",
    slope=lambda u: 1 / (1 + u.sqr()).sqrt(),
    undo=lambda z, u: z.sinh(),
)
acosh = Function(
    "acosh",
    "Return the inverse hyperbolic cosine >= 0; the domain is x >= 1.",
    Domain(1, None, closed=True),
    lambda u: 1 / (u.sqr() - 1).sqrt(),
    lambda z, u: z.cosh(),
)
atanh = Function(
    "atanh",
    "Return the inverse hyperbolic tangent; the domain is (-1, 1).",
    Domain(-1, 1, closed=False),
    lambda u: 1 / (1 - u.sqr()),
    lambda z, u: z.tanh(),
)
floor = Function("floor", "Return the hull of the largest integers <= x.")
ceil = Function("ceil", "Return the hull of the smallest integers >= x.")
trunc = Function("trunc", "Return the hull of x without its fraction.")
round_ties_to_even = Function(
    "round_ties_to_even", "Return the hull of the nearest integers, the even one of two."
)
round_ties_to_away = Function(
    "round_ties_to_away", "Return the hull of the nearest integers, of two the one farther from 0."
)
sign = Function("sign", "Return the hull of the signs -1, 0, 1.", limits=(-1, 1))

DOMAINS = {name: f.domain for name, f in TABLE.items() if f.domain != REALS}
STEPS = frozenset(name for name, f in TABLE.items() if f.slope is None)


def _method(name: str) -> Callable[[_S], _S]:
    """Return the method of that name, which leaves it to the number type."""

    def method(self: Any) -> Any:
        return self._monotone(name)

    method.__name__ = method.__qualname__ = name
    method.__doc__ = TABLE[name].text
    return method


class Elementary:
    """The elementary functions as methods, for every number type here."""

    __slots__ = ()

    def _monotone(self, name: str) -> Self:
        """Return f(X) for a function of the table.

        Where X is a set of reals: one that is monotone on its domain, which X is checked to be in,
        or cosh, for X within x >= 0.
        """
        raise NotImplementedError

    def __abs__(self) -> Self:
        raise NotImplementedError

    def __neg__(self) -> Self:
        raise NotImplementedError

    def __sub__(self, other: Any) -> Self:
        raise NotImplementedError

    sqrt, cbrt = _method("sqrt"), _method("cbrt")
    exp, exp2, exp10, expm1 = map(_method, ("exp", "exp2", "exp10", "expm1"))
    log, log2, log10, log1p = map(_method, ("log", "log2", "log10", "log1p"))
    sin, cos, tan = map(_method, ("sin", "cos", "tan"))
    asin, acos, atan = map(_method, ("asin", "acos", "atan"))
    sinh, tanh = map(_method, ("sinh", "tanh"))
    asinh, acosh, atanh = map(_method, ("asinh", "acosh", "atanh"))
    floor, ceil, trunc, sign = map(_method, ("floor", "ceil", "trunc", "sign"))
    round_ties_to_even = _method("round_ties_to_even")
    round_ties_to_away = _method("round_ties_to_away")

    def cosh(self) -> Self:
        """Return the hyperbolic cosine, which is even and increases with |x|."""
        return self.__abs__()._monotone("cosh")

    def rootn(self, n: int) -> Self:
        """Return the real n-th root, n >= 1; the domain is x >= 0 for even n."""
        if n < 1:
            raise ValueError("a root has a degree of at least 1")
        if n % 2 == 0:
            return self.sqrt().rootn(n // 2)
        if n in (1, 3):
            return self if n == 1 else self.cbrt()
        return self.maximum(0).pow(Fraction(1, n)) - (-self).maximum(0).pow(Fraction(1, n))

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


def _function_of_two(name: str) -> Callable[[Any, Any], Any]:
    """Return the function of two variables that calls the method `name` of the first."""

    def function(x: Any, y: Any) -> Any:
        if not hasattr(x, name) and hasattr(y, name):
            x = 0 * y + x  # an exact number beside an interval
        return getattr(_with_methods(name, x), name)(y)

    function.__name__ = function.__qualname__ = name
    function.__doc__ = f"Enclose {name} over x and y: see Elementary.{name}."
    return function


atan2, hypot = _function_of_two("atan2"), _function_of_two("hypot")
pow = _function_of_two("pow")
minimum, maximum = _function_of_two("minimum"), _function_of_two("maximum")


def rootn(x: _N, n: int) -> _N:
    """Enclose the real n-th root over x: see Elementary.rootn."""
    return cast("_N", _with_methods("rootn", x).rootn(n))
