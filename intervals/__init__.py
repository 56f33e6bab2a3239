"""Rigorous interval arithmetic: any precision (`Interval`) and vectorised (`IntervalArray`).

The inclusion principle, on which every proof stands: for every operation op of this package
and intervals X, Y, the result contains op(x, y) for all x in X and y in Y, whatever was
rounded on the way. So what is shown for the result is shown for every number inside.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from intervals import functions
from intervals.errors import DomainError, IntervalError, Undecided
from intervals.exact import decimal_bounds, decimal_down, decimal_up, fraction
from intervals.functions import *  # noqa: F403 - the table

if TYPE_CHECKING:
    from intervals.array import IntervalArray, TightArray
    from intervals.complex import ComplexInterval
    from intervals.decorated import Decorated
    from intervals.decorations import Decoration
    from intervals.formula import Formula
    from intervals.interval import Interval
    from intervals.jet import Jet
    from intervals.operators import krawczyk
    from intervals.relations import Overlap
    from intervals.zero_finder import zeros

    pi, e = Interval.pi, Interval.e

_HOMES = {
    "ComplexInterval": "complex",
    "Decorated": "decorated",
    "Decoration": "decorations",
    "Formula": "formula",
    "Interval": "interval",
    "IntervalArray": "array",
    "Jet": "jet",
    "Overlap": "relations",
    "TightArray": "array",
    "krawczyk": "operators",
    "zeros": "zero_finder",
}

__all__ = [
    "ComplexInterval",
    "Decorated",
    "Decoration",
    "DomainError",
    "Formula",
    "Interval",
    "IntervalArray",
    "IntervalError",
    "Jet",
    "Overlap",
    "TightArray",
    "Undecided",
    "decimal_bounds",
    "decimal_down",
    "decimal_up",
    "e",
    "fraction",
    "krawczyk",
    "pi",
    "zeros",
]
__all__ += functions.__all__


def __getattr__(name: str) -> Any:
    """Import what is used when it is: mpmath and numpy take longer than many a proof."""
    if name not in __all__:
        raise AttributeError(f"module 'intervals' has no attribute {name!r}")
    if name in ("pi", "e"):
        found = getattr(__getattr__("Interval"), name)
    else:
        found = getattr(import_module(f"intervals.{_HOMES[name]}"), name)
    globals()[name] = found
    return found
