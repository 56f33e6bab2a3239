"""Shaving (3B, constructive interval disjunction): a contractor made sharper by slices.

Theorem. Let a contractor return, for each box, a box with all solutions that the given one has, or
that it has none. For a box X and each i cut the i-th side of X into slices, let the contractor work
on each slice, and let H_i be the hull of what it returns for those that may have solutions. Then
the common part of X and all H_i has all solutions in X. Proof: a solution in X is, for each i, in
one of the slices, hence in what the contractor returns for that one, hence in H_i.

Source: Lhomme 1993, Consistency techniques for numeric CSPs; Trombettoni, Chabert 2007,
Constructive interval disjunction.
"""

from __future__ import annotations

from collections.abc import Callable
from math import inf

import numpy as np

from intervals.array import IntervalArray, Mask
from intervals.branch import Bounds, Boxes, evaluated

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
            cut = lower[i] + k / _SLICES * (upper[i] - lower[i])
            low[i, i, k] = high[i, i, k - 1] = np.clip(cut, low[i, i, k - 1], upper[i])
    slices = tuple(map(IntervalArray.from_floats, low.reshape(n, -1), high.reshape(n, -1)))
    low, high = low.reshape(n, -1), high.reshape(n, -1)
    for part, answer in evaluated(contract, slices):
        if answer:
            left, empty = answer
            low[:, part] = [np.where(empty, inf, x.inf) for x in left]
            high[:, part] = [np.where(empty, -inf, x.sup) for x in left]
    return low.reshape(shape), high.reshape(shape)
