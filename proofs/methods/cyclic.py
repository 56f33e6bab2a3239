"""All solutions of f(z_i) = z_(i+1), i mod n, in a box: the points of periodic orbits, as a system.

N boxes are one array of the shape (N, n, d): N times n points with d coordinates. A solution is in
front if no z_i has a smaller first coordinate than z_0: each orbit has a rotation that is.

Theorem. The boxes that `solutions` returns contain all solutions in the given box that are in front
and in the region g >= 0, and each of them contains exactly one solution, not necessarily another
one than the next box, nor in front or in the region.

Proof. The given box is halved again and again; a part goes in two ways only. (1) `_contracted` cuts
(z_i, z_(i+1)) by f(z_i) - z_(i+1) = 0 for each i, z_i by g >= 0, and all z_i by the first
coordinate of z_0: see `intervals.contractor` for why no solution is lost. (2) Krawczyk's operator
for a larger part finds none in the given one, or exactly one, which is in its image. The variable
z_i occurs in f(z_i) - z_(i+1) with the derivative J_i, and in f(z_(i-1)) - z_i with -1. So with C_i
the columns of a matrix C that multiply f(z_i) - z_(i+1), the columns of C J that multiply z_i are
C_i J_i - C_(i-1). The rest is the theorem of `intervals.operators`.

Source: Galias, Interval methods for rigorous investigations of periodic orbits, Int. J. Bifurcation
Chaos 11 (2001).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from math import inf
from typing import Any, NamedTuple, cast

import numpy as np

from intervals import IntervalArray, Undecided
from intervals.array import Mask
from intervals.branch import Bounds, Boxes, concatenated, evaluated, larger
from intervals.contractor import contracted
from intervals.formula import Formula, NoFormula
from intervals.generic import meet, middle, where
from intervals.systems import Function, components, inverses, jacobian

_AT_ONCE = 2048  # boxes that are contracted together
_MATRICES = 128  # of them at a time by Krawczyk's operator
_PASSES = 16  # along the orbit, before a box is halved
_NARROW = 1 / 8  # of the given box: where Krawczyk's operator is worth its price
_SMALLEST = 2.0**-38
_ZERO, _POSITIVE = IntervalArray([0]), IntervalArray.from_floats([0.0], [inf])


class Isolation(NamedTuple):
    """Where there is no solution, where exactly one; its box, or what is left of the given one."""

    none: Mask
    unique: Mask
    boxes: IntervalArray


@dataclass(frozen=True)
class CyclicSystem:
    """The equations f(z_i) = z_(i+1) of n points with d coordinates, and g(z_i) >= 0."""

    f: Function
    g: Function | None
    size: int

    @cached_property
    def relation(self) -> Formula | None:
        """f(z) - z', if it can be undone."""
        d = self.size

        def difference(*z: Any) -> list[Any]:
            pairs = zip(components(self.f(*z[:d])), z[d:], strict=True)
            return [value - following for value, following in pairs]

        return _recorded(difference, 2 * d)

    @cached_property
    def region(self) -> Formula | None:
        """The function g, if there is one and it can be undone."""
        return self.g and _recorded(self.g, self.size)

    def solutions(self, given: IntervalArray, limit: int) -> IntervalArray:
        """Return the boxes of the theorem.

        Raises Undecided where a part is too small to be halved, or after about `limit` of them.
        """
        found, waiting, scale = [given[:0]], [given], given.wid
        while waiting:
            boxes = waiting.pop()
            while waiting and len(boxes) < _AT_ONCE:
                boxes = concatenated([boxes, waiting.pop()])
            limit -= len(boxes)
            boxes = self._pruned(boxes)
            narrow = _all(boxes.wid <= self._narrow * scale)
            isolated, rest = self._isolated(boxes[narrow])
            found.append(isolated)
            boxes = concatenated([boxes[~narrow], rest])
            if len(boxes):
                waiting.append(_halves(boxes, scale, _SMALLEST if limit > 0 else inf))
        return self.narrowed(concatenated(found))

    @property
    def _narrow(self) -> float:
        return _NARROW if self.relation else inf

    def _pruned(self, boxes: IntervalArray) -> IntervalArray:
        """Do (1) with all boxes, and leave those as they are where that is not defined."""
        parts = [boxes[:0]]
        for part, smaller in evaluated(lambda some: self._contracted(*some), (boxes,)):
            parts.append(boxes[part] if smaller is None else smaller)
        return concatenated(parts)

    def _contracted(self, boxes: IntervalArray) -> IntervalArray:
        """Do (1) until few boxes shrink by a quarter."""
        boxes = _in_front(boxes)
        if self.region:
            boxes = _cut(self.region, boxes, _POSITIVE)[0]
        if not self.relation:
            return boxes
        for _ in range(_PASSES):
            before = boxes.wid
            pairs = concatenated((boxes, turned(boxes, 1)), 2)
            pairs, kept = _cut(self.relation, pairs, _ZERO)
            here, before = pairs[..., : self.size], before[kept]
            there = turned(pairs[..., self.size :], -1)
            kept = _all(~here.disjoint(there))
            boxes, before = meet(here, there)[kept], before[kept]
            stays = _all(4 * boxes.wid >= 3 * before)
            boxes = _in_front(boxes)
            if 4 * stays.sum() >= 3 * len(stays):
                break
        return boxes

    def _isolated(self, boxes: IntervalArray) -> tuple[IntervalArray, IntervalArray]:
        """Do (2): return boxes with exactly one solution, and what else may have some."""
        found, rest = [boxes[:0]], [boxes[:0]]
        for some in portions(boxes):
            for part, answer in evaluated(lambda x: self.krawczyk(*x), (larger(some),)):
                here = some[part]
                if answer is None:
                    rest.append(here)
                    continue
                met = ~answer.none & _all(~here.disjoint(answer.boxes))
                found.append(answer.boxes[answer.unique])
                rest.append(meet(here, answer.boxes)[met & ~answer.unique])
        return concatenated(found), concatenated(rest)

    def narrowed(self, boxes: IntervalArray) -> IntervalArray:
        """Contract boxes with one solution each until they stay."""
        parts = [boxes[:0]]
        for portion in portions(boxes):
            some = portion
            while len(some):
                after = self.krawczyk(some).boxes
                stays = _all(16 * after.wid >= 15 * some.wid)
                parts.append(after[stays])
                some = after[~stays]
        return concatenated(parts)

    def krawczyk(self, boxes: IntervalArray) -> Isolation:
        """Apply Krawczyk's operator once, to boxes all of which are in the domain of f'."""
        count, n, d = boxes.shape
        centre, slopes = middle(boxes), self.derivatives(boxes)
        values = stacked(components(self.f(*_coordinates(centre)))) - turned(centre, 1)
        inverse = IntervalArray.from_floats(_inverse(slopes.mid))
        image = centre.reshape(count, n * d) - _times(inverse, values.reshape(count, n * d))
        columns = inverse.reshape(count, n * d, n, d)
        unit = IntervalArray(np.eye(n * d, dtype=int))
        for i in range(n):
            product = columns[:, :, i] @ slopes[:, i] - columns[:, :, i - 1]
            rest = product - unit[:, i * d : (i + 1) * d]
            image = image - _times(rest, boxes[:, i] - centre[:, i])
        image = image.reshape(count, n, d)
        none = ~_all(~image.disjoint(boxes))
        unique = _all(image.subset(boxes) & ~image.equal(boxes))
        return Isolation(none, unique, meet(boxes, image))

    def derivatives(self, boxes: IntervalArray) -> IntervalArray:
        """Enclose f' over all points of the boxes, in the shape (N, n, d, d)."""
        _, rows = jacobian(self.f, tuple(x.reshape(-1) for x in _coordinates(boxes)))
        matrix = stacked([stacked(column) for column in zip(*rows, strict=True)])
        return matrix.reshape(*boxes.shape, self.size)


def _recorded(f: Function, variables: int) -> Formula | None:
    """Return f as a formula, None where it looks at its arguments as sets."""
    try:
        return Formula(f, variables)
    except NoFormula:
        return None


def turned(boxes: IntervalArray, by: int) -> IntervalArray:
    """Return the rotations z_by, z_(by+1), ..."""
    return concatenated((boxes[:, by:], boxes[:, :by]), 1)


def portions(boxes: IntervalArray) -> list[IntervalArray]:
    """Return the boxes, so many at a time as Krawczyk's operator may have matrices for."""
    return [boxes[i : i + _MATRICES] for i in range(0, len(boxes), _MATRICES)]


def _all(mask: Mask) -> Mask:
    """Return for which boxes something holds of all sides."""
    return np.asarray(mask.all(axis=(1, 2)))


def stacked(arrays: Sequence[IntervalArray]) -> IntervalArray:
    """Return np.stack along a last axis, with the type that it has for IntervalArrays."""
    return cast(IntervalArray, np.stack(arrays, -1))


def _coordinates(boxes: IntervalArray) -> Boxes:
    return tuple(boxes[..., k] for k in range(boxes.shape[2]))


def _times(matrices: IntervalArray, vectors: IntervalArray) -> IntervalArray:
    return (matrices @ vectors[..., np.newaxis])[..., 0]


def _inverse(slopes: Bounds) -> Bounds:
    """Return about the inverses of the derivatives of all equations by all variables."""
    count, n, d, _ = slopes.shape
    matrices, places = np.zeros((count, n, d, n, d)), np.arange(n)
    matrices[:, places, :, places] += np.moveaxis(slopes, 1, 0)
    matrices[:, places, :, (places + 1) % n] -= np.eye(d)
    return inverses(matrices.reshape(count, n * d, n * d))


def _cut(
    formula: Formula, boxes: IntervalArray, target: IntervalArray
) -> tuple[IntervalArray, Mask]:
    """Cut all points by a formula; return the boxes that have points left, and which these are."""
    flat = tuple(x.reshape(-1) for x in _coordinates(boxes))
    sides, empty = contracted(formula, flat, [target] * len(formula.outputs), sweeps=1)
    kept = np.asarray((~empty).reshape(boxes.shape[:2]).all(axis=1))
    return stacked(sides).reshape(*boxes.shape)[kept], kept


def _in_front(boxes: IntervalArray) -> IntervalArray:
    """Cut the boxes by x_0 <= x_i, x the first coordinate."""
    x = boxes[..., 0]
    low, high = np.maximum(x.inf, x.inf[:, :1]), x.sup
    high[:, 0] = high.min(axis=1)
    kept = (low <= high).all(axis=1)
    first = IntervalArray.from_floats(low[kept], high[kept])
    return concatenated((first[..., np.newaxis], boxes[kept][..., 1:]), 2)


def _halves(boxes: IntervalArray, scale: Bounds, smallest: float) -> IntervalArray:
    """Halve the sides that are widest in proportion to `scale`; Undecided if one is too small."""
    shares = (boxes.wid / np.maximum(scale, 2.0**-1000)).reshape(len(boxes), -1)
    widest = np.arange(shares.shape[1]) == shares.argmax(axis=1)[:, np.newaxis]
    cut = widest.reshape(boxes.shape)
    inside = (boxes.inf < boxes.mid) & (boxes.mid < boxes.sup)
    small = ~_all(inside | ~cut) | (shares.max(axis=1) <= smallest)
    if small.any():
        sides = boxes[small][0, 0].tolist()
        place = " x ".join(f"{side:12}" for side in sides)
        raise Undecided(f"whether there is a periodic point in {place}")
    return concatenated([where(cut, half, boxes) for half in boxes.bisect()])
