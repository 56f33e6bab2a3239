"""Sub-boxes for branch and bound: many at once, split along their widest sides.

Boxes are n IntervalArrays of the shape (N,): the i-th sides of N boxes.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from fractions import Fraction
from typing import Any, TypeAlias, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

from intervals.array import IntervalArray, Mask
from intervals.errors import DomainError
from intervals.generic import where
from intervals.interval import Interval
from intervals.rounding import MAX

Given: TypeAlias = "Interval | Sequence[Interval]"
Boxes: TypeAlias = tuple[IntervalArray, ...]
Bounds: TypeAlias = NDArray[np.float64]

_Answer = TypeVar("_Answer")
_AT_ONCE = 4096  # boxes in one evaluation


def one_box(box: Given) -> Boxes:
    """Return a box as an array of one; ValueError if an endpoint is no binary64 number."""
    sides = [box] if isinstance(box, Interval) else list(box)
    for side in sides:
        if not IntervalArray([side]).subset(side).all():
            raise ValueError(f"the endpoints must be binary64 numbers: {side}")
    return tuple(IntervalArray([side]) for side in sides)


def as_box(boxes: Boxes, index: int) -> tuple[Interval, ...]:
    """Return one of the boxes as Intervals."""
    return tuple(Interval(Fraction(x.inf[index]), Fraction(x.sup[index])) for x in boxes)


def select(boxes: Boxes, index: slice | Mask) -> Boxes:
    """Return some of the boxes."""
    return tuple(x[index] for x in boxes)


def join(parts: Sequence[Boxes]) -> Boxes:
    """Return all boxes of the parts."""
    return tuple(concatenated(sides) for sides in zip(*parts, strict=True))


def all_of(masks: Iterable[Any]) -> Mask:
    """Return where all masks hold."""
    return np.asarray(np.logical_and.reduce([np.asarray(mask) for mask in masks]))


def meets(boxes: Iterable[Any], other: Iterable[Any]) -> Mask:
    """Return which boxes have a point in common with another one."""
    return all_of(~x.disjoint(y) for x, y in zip(boxes, other, strict=True))


def larger(x: IntervalArray) -> IntervalArray:
    """Return intervals that contain the given ones, as a rule in their interior."""
    reach = x.wid / 8 + np.maximum(abs(x.inf), abs(x.sup)) * 2.0**-45 + 2.0**-1000
    low, high = np.maximum(x.inf - reach, -MAX), np.minimum(x.sup + reach, MAX)
    return IntervalArray.from_floats(np.minimum(low, x.inf), np.maximum(high, x.sup))


def concatenated(arrays: Sequence[IntervalArray], axis: int = 0) -> IntervalArray:
    """Return np.concatenate, with the type that it has for IntervalArrays."""
    return cast(IntervalArray, np.concatenate(arrays, axis))


def evaluated(
    function: Callable[[Boxes], _Answer], boxes: Boxes
) -> Iterator[tuple[slice, _Answer | None]]:
    """Yield (part, function(boxes of the part)) for slices that partition the boxes.

    Where the function leaves its domain or binary64 the part is halved; for a part of one box
    None takes the place of the answer.
    """
    count = len(boxes[0])
    waiting = [slice(i, min(i + _AT_ONCE, count)) for i in range(0, count, _AT_ONCE)][::-1]
    while waiting:
        part = waiting.pop()
        answer = None
        with suppress(DomainError, OverflowError):
            answer = function(select(boxes, part))
        half = (part.start + part.stop) // 2
        if answer is None and half > part.start:
            waiting += [slice(half, part.stop), slice(part.start, half)]
        else:
            yield part, answer


def split(boxes: Boxes, scale: Boxes, smallest: float) -> tuple[Boxes, Mask]:
    """Return the halves of the boxes that are split, and which these are.

    A box is cut at the middle of the side that is widest in proportion to that of `scale`, one box,
    if this proportion is above `smallest` and binary64 has a number between the ends.
    """
    sizes = [max(float(side.wid[0]), 2.0**-1000) for side in scale]
    widths = np.stack([x.wid / size for x, size in zip(boxes, sizes, strict=True)])
    widest = np.argmax(widths, axis=0)
    inside = np.stack([(x.inf < x.mid) & (x.mid < x.sup) for x in boxes])
    chosen = np.arange(len(boxes))[:, np.newaxis] == widest
    kept = np.asarray((chosen & inside & (widths > smallest)).any(axis=0))
    halves = []
    for x, here in zip(select(boxes, kept), chosen[:, kept], strict=True):
        halves.append(concatenated([where(here, half, x) for half in x.bisect()]))
    return tuple(halves), kept


def clusters(lower: Bounds, upper: Bounds) -> list[tuple[Bounds, Bounds, list[int]]]:
    """Return groups of boxes, as the corners of their hulls and the indices of their members.

    The i-th box has the corners lower[i], upper[i]. Boxes that meet are in one group, the hulls
    of different groups are disjoint: groups are separated where an axis shows a gap, again and
    again until none does.
    """
    result = []
    waiting = [np.arange(len(lower))] if len(lower) else []
    while waiting:
        group = waiting.pop()
        parts = _apart(lower[group], upper[group])
        if len(parts) > 1:
            waiting += [group[part] for part in parts]
        else:
            result.append((lower[group].min(axis=0), upper[group].max(axis=0), group.tolist()))
    return result


def _apart(lower: Bounds, upper: Bounds) -> list[NDArray[np.intp]]:
    """Return the indices of the boxes, apart where some axis has a gap between them."""
    for low, high in zip(lower.T, upper.T, strict=True):
        order = np.argsort(low)
        reach = np.maximum.accumulate(high[order])
        cuts = np.flatnonzero(low[order][1:] > reach[:-1]) + 1
        if cuts.size:
            return np.split(order, cuts)
    return [np.arange(len(lower))]
