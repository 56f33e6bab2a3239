"""Rigorous interval arithmetic: any precision (`Interval`) and vectorised (`IntervalArray`).

The inclusion principle, on which every proof stands: for every operation op of this package
and intervals X, Y, the result contains op(x, y) for all x in X and y in Y, whatever was
rounded on the way. So what is shown for the result is shown for every number inside.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from intervals.array import IntervalArray as IntervalArray
    from intervals.array import TightArray as TightArray
    from intervals.complex import ComplexInterval as ComplexInterval
    from intervals.decorated import Decorated as Decorated
    from intervals.decorations import Decoration as Decoration
    from intervals.errors import DomainError as DomainError
    from intervals.errors import IntervalError as IntervalError
    from intervals.errors import Undecided as Undecided
    from intervals.exact import decimal_bounds as decimal_bounds
    from intervals.exact import decimal_down as decimal_down
    from intervals.exact import decimal_up as decimal_up
    from intervals.exact import fraction as fraction
    from intervals.formula import Formula as Formula
    from intervals.functions import *  # noqa: F403 - the table
    from intervals.interval import Interval as Interval
    from intervals.jet import Jet as Jet
    from intervals.operators import krawczyk as krawczyk
    from intervals.relations import Overlap as Overlap
    from intervals.zero_finder import zeros as zeros

    pi, e = Interval.pi, Interval.e

_HOMES = {  # of names that are here when they are asked for
    "ComplexInterval": "complex",
    "Decorated": "decorated",
    "Decoration": "decorations",
    "DomainError": "errors",
    "Formula": "formula",
    "Interval": "interval",
    "IntervalArray": "array",
    "IntervalError": "errors",
    "Jet": "jet",
    "Overlap": "relations",
    "TightArray": "array",
    "Undecided": "errors",
    "decimal_bounds": "exact",
    "decimal_down": "exact",
    "decimal_up": "exact",
    "fraction": "exact",
    "krawczyk": "operators",
    "zeros": "zero_finder",
}
_CONSTANTS = ("e", "pi")


def __getattr__(name: str) -> Any:
    """Import what is used when it is: mpmath and numpy take longer than many a proof."""
    if name in _HOMES:
        value = getattr(import_module(f"intervals.{_HOMES[name]}"), name)
    elif name in _CONSTANTS:
        value = getattr(__getattr__("Interval"), name)
    else:
        functions = import_module("intervals.functions")
        if name == "__all__":
            return [*_HOMES, *_CONSTANTS, *functions.__all__]
        if name not in functions.__all__:
            raise AttributeError(f"module 'intervals' has no attribute {name!r}")
        value = getattr(functions, name)
    globals()[name] = value
    return value
