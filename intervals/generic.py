"""What an Interval and an IntervalArray spell differently, under one name.

A mask is a bool, or an array of shape (), beside Intervals; an array beside IntervalArrays.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar, cast

from intervals.interval import Interval

if TYPE_CHECKING:
    from intervals.array import IntervalArray

Number = TypeVar("Number", "Interval", "IntervalArray")


def middle(x: Number) -> Number:
    """Return the midpoint up to rounding: an interval within x that holds at least one number."""
    if isinstance(x, Interval):
        return Interval(x.mid, precision=x.precision)
    return type(x).from_floats(x.mid)


def ends(x: Number) -> tuple[Number, Number]:
    """Return the two endpoints as points."""
    if isinstance(x, Interval):
        return Interval(x.inf, precision=x.precision), Interval(x.sup, precision=x.precision)
    return type(x).from_floats(x.inf), type(x).from_floats(x.sup)


def where(mask: Any, x: Number, y: Number) -> Number:
    """Return x where the mask holds, y elsewhere."""
    if isinstance(x, Interval):
        return x if mask else y
    from numpy import where as choose

    return cast(Number, choose(mask, x, y))  # by IntervalArray's own __array_function__


def meet(x: Number, y: Number) -> Number:
    """Return the common part of x and y, and x where they are disjoint."""
    common = x.intersection(where(x.disjoint(y), x, y))
    return x if common is None else common
