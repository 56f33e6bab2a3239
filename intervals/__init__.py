"""Rigorous interval arithmetic: any precision (`Interval`) and vectorised (`IntervalArray`).

The inclusion principle, on which every proof stands: for every operation op of this package
and intervals X, Y, the result contains op(x, y) for all x in X and y in Y, whatever was
rounded on the way. So what is shown for the result is shown for every number inside.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from intervals.errors import DomainError, IntervalError, Undecided
from intervals.exact import decimal_bounds, decimal_down, decimal_up, fraction

if TYPE_CHECKING:
    from intervals.array import IntervalArray
    from intervals.complex import ComplexInterval
    from intervals.decorated import Decorated
    from intervals.decorations import Decoration
    from intervals.functions import (
        acos,
        acosh,
        asin,
        asinh,
        atan,
        atan2,
        atanh,
        cbrt,
        ceil,
        cos,
        cosh,
        exp,
        exp2,
        exp10,
        expm1,
        floor,
        hypot,
        log,
        log1p,
        log2,
        log10,
        maximum,
        minimum,
        pow,
        rootn,
        round_ties_to_away,
        round_ties_to_even,
        sign,
        sin,
        sinh,
        sqrt,
        tan,
        tanh,
        trunc,
    )
    from intervals.interval import Interval
    from intervals.jet import Jet
    from intervals.relations import Overlap

    pi, e = Interval.pi, Interval.e

__all__ = [
    "ComplexInterval",
    "Decorated",
    "Decoration",
    "DomainError",
    "Interval",
    "IntervalArray",
    "IntervalError",
    "Jet",
    "Overlap",
    "Undecided",
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
    "decimal_bounds",
    "decimal_down",
    "decimal_up",
    "e",
    "exp",
    "exp2",
    "exp10",
    "expm1",
    "floor",
    "fraction",
    "hypot",
    "log",
    "log1p",
    "log2",
    "log10",
    "maximum",
    "minimum",
    "pi",
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

_HOMES = {
    "ComplexInterval": "complex",
    "Decorated": "decorated",
    "Decoration": "decorations",
    "Interval": "interval",
    "IntervalArray": "array",
    "Jet": "jet",
    "Overlap": "relations",
}  # of the others: functions


def __getattr__(name: str) -> Any:
    """Import what is used when it is: mpmath and numpy take longer than many a proof."""
    if name not in __all__:
        raise AttributeError(f"module 'intervals' has no attribute {name!r}")
    if name in ("pi", "e"):
        found = getattr(__getattr__("Interval"), name)
    else:
        found = getattr(import_module(f"intervals.{_HOMES.get(name, 'functions')}"), name)
    globals()[name] = found
    return found
