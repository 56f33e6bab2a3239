"""Sub-boxes for branch and bound: many at once, split along their widest sides.

Boxes are n IntervalArrays of the shape (N,): the i-th sides of N boxes.

Shaving (3B, constructive interval disjunction): a contractor made sharper by slices.

Theorem. Let a contractor return, for each box, a box with all solutions that the given one has, or
that it has none. For a box X and each i cut the i-th side of X into slices, let the contractor work
on each slice, and let H_i be the hull of what it returns for those that may have solutions. Then
the common part of X and all H_i has all solutions in X. Proof: a solution in X is, for each i, in
one of the slices, hence in what the contractor returns for that one, hence in H_i.

Source: Lhomme 1993, Consistency techniques for numeric CSPs; Trombettoni, Chabert 2007,
Constructive interval disjunction.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from fractions import Fraction
from math import inf
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
    sizes = [min(max(float(side.wid[0]), 2.0**-1000), MAX) for side in scale]
    widths = np.stack([np.minimum(x.wid, MAX) / size for x, size in zip(boxes, sizes, strict=True)])
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


_SLICES = 4
_AT_ONCE = 16384  # slices


def shaved(contract: Callable[[Boxes], tuple[Boxes, Mask]], boxes: Boxes) -> tuple[Boxes, Mask]:
    """Return parts of the boxes with all solutions, and where there is none: it means nothing.

    Where the contractor raises DomainError or OverflowError for a slice, it is left as it is.
    """
    n, count = len(boxes), len(boxes[0])
    lower, upper = (np.array([getattr(x, end) for x in boxes]) for end in ("inf", "sup"))
    step = max(1, _AT_ONCE // (n * _SLICES))
    for start in range(0, count, step):
        part = slice(start, start + step)
        low, high = _contracted_slices(contract, lower[:, part], upper[:, part])
        np.maximum(low.min(axis=2).max(axis=1), lower[:, part], out=lower[:, part])
        np.minimum(high.max(axis=2).min(axis=1), upper[:, part], out=upper[:, part])
    empty: Mask = np.asarray((lower > upper).any(axis=0))
    ends = np.where(empty, 0.0, lower), np.where(empty, 0.0, upper)
    return tuple(IntervalArray.from_floats(*side) for side in zip(*ends, strict=True)), empty


def _contracted_slices(
    contract: Callable[[Boxes], tuple[Boxes, Mask]], lower: Bounds, upper: Bounds
) -> tuple[Bounds, Bounds]:
    """Return the ends (j, i, k, box) of side j of the k-th slice along i; reversed if empty."""
    n, count = lower.shape
    shape = n, n, _SLICES, count
    low, high = (np.array(np.broadcast_to(x[:, None, None], shape)) for x in (lower, upper))
    for i in range(n):
        for k in range(1, _SLICES):
            cut = (1 - k / _SLICES) * lower[i] + k / _SLICES * upper[i]  # a width may be inf
            low[i, i, k] = high[i, i, k - 1] = np.clip(cut, low[i, i, k - 1], upper[i])
    slices = tuple(map(IntervalArray.from_floats, low.reshape(n, -1), high.reshape(n, -1)))
    low, high = low.reshape(n, -1), high.reshape(n, -1)
    for part, answer in evaluated(contract, slices):
        if answer:
            left, empty = answer
            low[:, part] = [np.where(empty, inf, x.inf) for x in left]
            high[:, part] = [np.where(empty, -inf, x.sup) for x in left]
    return low.reshape(shape), high.reshape(shape)
