"""Rigorous interval arithmetic: any precision (`Interval`) and vectorised (`IntervalArray`).

The inclusion principle, on which every proof stands: for every operation op of this package
and intervals X, Y, the result contains op(x, y) for all x in X and y in Y, whatever was
rounded on the way. So what is shown for the result is shown for every number inside.
"""

from typing import TYPE_CHECKING, Any, Protocol, Self, TypeVar

from intervals.errors import DomainError, IntervalError, Undecided
from intervals.exact import decimal_bounds, decimal_down, decimal_up, fraction
from intervals.interval import Interval
from intervals.jet import Jet

if TYPE_CHECKING:
    from intervals.array import IntervalArray

__all__ = [
    "DomainError",
    "Interval",
    "IntervalArray",
    "IntervalError",
    "Jet",
    "Undecided",
    "cos",
    "decimal_bounds",
    "decimal_down",
    "decimal_up",
    "exp",
    "fraction",
    "log",
    "sin",
    "sqrt",
]


class Elementary(Protocol):
    """What a number type brings: Interval, IntervalArray and Jet do."""

    def sin(self) -> Self: ...
    def cos(self) -> Self: ...
    def exp(self) -> Self: ...
    def log(self) -> Self: ...
    def sqrt(self) -> Self: ...


_N = TypeVar("_N", bound=Elementary)


def sin(x: _N) -> _N:
    """Enclose sin over x."""
    return x.sin()


def cos(x: _N) -> _N:
    """Enclose cos over x."""
    return x.cos()


def exp(x: _N) -> _N:
    """Enclose exp over x."""
    return x.exp()


def log(x: _N) -> _N:
    """Enclose the natural logarithm over x > 0."""
    return x.log()


def sqrt(x: _N) -> _N:
    """Enclose the square root over x >= 0."""
    return x.sqrt()


def __getattr__(name: str) -> Any:
    """Import IntervalArray, and numpy with it, only where it is used."""
    if name == "IntervalArray":
        from intervals.array import IntervalArray

        return IntervalArray
    raise AttributeError(f"module 'intervals' has no attribute {name!r}")
