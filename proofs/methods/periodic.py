"""All periodic orbits of a map in a region: subdivision, Krawczyk's operator, exclusion.

Theorem. Let f be a map given by a formula, R a region, `cover` cells that contain all full orbits
of f in R, n >= 1. If `periodic_orbits` returns, its list has every periodic orbit in R whose
period divides n, once, with its exact period; each of its points is the only fixed point of f^n
in a box around it. Otherwise Undecided is raised.

Proof. (1) Boxes around the cells, and around the halves of those that remain, are examined by the
Krawczyk operator of f^n(x) - x. A cell goes if no fixed point of f^n in the box has its orbit in R;
also if there is exactly one fixed point in the box, which is noted. When none is left, each point
of the orbits in question is the one of a noted box.
(2) Let p be the point of one noted box, Z a narrow enclosure of it, X another noted box with the
point q. If Z is within X, then p = q; if their narrow enclosures are disjoint, p and q differ. Each
pair is one or the other, so the points can be listed once.
(3) f(p) is fixed by f^n. If f(Z) is within the box of q, then f(p) = q. If f(Z) meets no narrow
enclosure, f(p) is not listed, so it is not on an orbit in R, and p neither. One holds for each p.
(4) What remains when such p go, with all that lead to them, is permuted by f: it falls into cycles,
of which the length is the period. If an enclosure of a point on one is not in R, Undecided is
raised; those with an image that misses R went before.

Source: Galias, Interval methods for rigorous investigations of periodic orbits, Int. J. Bifurcation
Chaos 11 (2001); (1) for the operator is Neumaier 1990, chapter 5 (see `intervals.krawczyk`).
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from intervals import DomainError, Interval, Undecided
from intervals.array import Mask
from intervals.branch import Boxes, as_box, evaluated, join, one_box, select, split
from intervals.generic import meet, middle, where
from intervals.systems import (
    Box,
    Function,
    Matrix,
    approximate_inverse,
    components,
    dot,
    jacobian,
    matrix_product,
)
from proofs.methods.cells import Cover

_SMALLEST = 2.0**-40  # in proportion to the region's box
_REACH = 2.0**-26  # likewise
_NOWHERE = -1
_FEW = 256


@dataclass(frozen=True)
class Orbit:
    """A periodic orbit p_0, p_1 = f(p_0), ..., and enclosures of the derivative of f^n at p_0.

    n is the number of points, the least period.
    """

    points: tuple[tuple[Interval, ...], ...]
    derivative: tuple[tuple[Interval, ...], ...]

    @property
    def period(self) -> int:
        """The least period."""
        return len(self.points)

    @property
    def trace(self) -> Interval:
        """The sum of the multipliers; in one dimension the multiplier."""
        first, *others = (row[i] for i, row in enumerate(self.derivative))
        return sum(others, first)


def iterate(f: Function, n: int) -> Function:
    """Return f^n."""

    def power(*x: Any) -> list[Any]:
        values = list(x)
        for _ in range(n):
            values = components(f(*values))
        return values

    return power


def periodic_orbits(cover: Cover, period: int, *, limit: int = 1_000_000) -> list[Orbit]:
    """Return the orbits of the theorem, by period, then by their least point.

    Raises Undecided where a sub-box is not decided when its sides are 2^-40 of those of the
    region, or after about `limit` of them: at a fixed point of f^n that is not isolated, say.
    """
    if period < 1:
        raise ValueError("a period is at least 1")
    points, near = _narrow(cover, period, _isolate(cover, period, limit))
    points, near = _distinct(points, _widened(cover, period, points, near))
    cycles = _cycles(_successors(cover.f, points, near))
    inside = cover.region.contains(points)
    for cycle in cycles:
        if not inside[cycle].all():
            place = _shown(points, cycle[int(np.argmin(inside[cycle]))])
            raise Undecided(f"a periodic point at the boundary of the region, in {place}")
    orbits = [_orbit(cover.f, points, cycle) for cycle in cycles]
    return sorted(orbits, key=lambda orbit: (orbit.period, [x.inf for x in orbit.points[0]]))


def _isolate(cover: Cover, period: int, limit: int) -> Boxes:
    """Return boxes with one fixed point of f^n each; among them are all points in question: (1)."""
    scale, waiting = one_box(cover.region.box), cover.cells
    found = [select(waiting, slice(0))]
    while len(waiting[0]):
        limit -= len(waiting[0])
        if limit < 0:
            raise Undecided(f"too many sub-boxes; one that is left is {_shown(waiting, 0)}")
        rest, around = [select(waiting, slice(0))], _larger(waiting)
        for part, answer in evaluated(partial(_examined, cover, period), around):
            here = select(waiting, part)
            if answer is None:
                rest.append(here)
                continue
            found.append(select(select(around, part), answer.unique & ~answer.none))
            going = ~(answer.none | answer.unique) & _meet(here, answer.box)
            rest.append(select(_common(here, answer.box), going))
        left = join(rest)
        waiting, cut = split(left, scale, _SMALLEST)
        if not cut.all():
            place = _shown(left, int(np.argmin(cut)))
            raise Undecided(f"whether there is a periodic point in {place}")
    return join(found)


class _Answer(NamedTuple):
    """Where no orbit in R has a point in the box, where f^n has one fixed point there; K."""

    none: Mask
    unique: Mask
    box: Boxes


def _examined(cover: Cover, period: int, boxes: Boxes) -> _Answer:
    """Apply Krawczyk's operator of f^n(x) - x; to a few boxes in vain, where one has no enclosure.

    One by one they would take longer than their halves do.
    """
    try:
        return _krawczyk(cover, period, boxes)
    except (DomainError, OverflowError):
        if len(boxes[0]) > _FEW:
            raise
        nowhere = np.zeros(len(boxes[0]), dtype=bool)
        return _Answer(nowhere, nowhere, boxes)


def _krawczyk(cover: Cover, period: int, boxes: Boxes) -> _Answer:
    """Return K = m - C (f^n(m) - m) + (1 - C (J - 1)) (X - m), where J contains (f^n)' over X.

    f^k(X) lies in f(f^(k-1)(X)) and in f^k(m) + J_k (X - m), J_k the product of k derivatives.
    Where it misses R there is no orbit in R, and X and m take its place and that of f^k(m): what
    comes of them means nothing, but does not leave the domain of f.
    """
    centre = tuple(middle(x) for x in boxes)
    offsets = [x - m for x, m in zip(boxes, centre, strict=True)]
    none = np.zeros(len(boxes[0]), dtype=bool)
    images, points, product = boxes, centre, _identity(boxes)
    for _ in range(period):
        values, slopes = jacobian(cover.f, images)
        product = matrix_product(slopes, product)
        points = tuple(components(cover.f(*points)))
        means = (p + dot(row, offsets) for p, row in zip(points, product, strict=True))
        images = _common(values, tuple(means))
        none |= cover.region.misses(images)
        images, points = _replaced(none, images, boxes), _replaced(none, points, centre)
    matrix = [[a - int(i == j) for j, a in enumerate(row)] for i, row in enumerate(product)]
    inverse = approximate_inverse(matrix)
    defect = [p - m for p, m in zip(points, centre, strict=True)]
    found = []
    for i, row in enumerate(matrix_product(inverse, matrix)):
        rest = [int(i == j) - a for j, a in enumerate(row)]
        found.append(centre[i] - dot(inverse[i], defect) + dot(rest, offsets))
    proper = [y.subset(x) & ~y.equal(x) for x, y in zip(boxes, found, strict=True)]
    none |= ~(_meet(found, boxes) & _meet(images, boxes))
    return _Answer(none, _all(proper), tuple(found))


def _replaced(mask: Mask, boxes: Box, others: Box) -> Boxes:
    """Return the others where the mask holds."""
    return tuple(where(mask, y, x) for x, y in zip(boxes, others, strict=True))


def _identity(boxes: Boxes) -> Matrix:
    n = len(boxes)
    return [[0 * boxes[0] + int(i == j) for j in range(n)] for i in range(n)]


def _narrow(cover: Cover, period: int, near: Boxes) -> tuple[Boxes, Boxes]:
    """Apply the operator until nothing shrinks by a quarter; return narrow and given boxes.

    Those without an orbit in R are left out: their images may be another's, see `_krawczyk`.
    """
    points = near
    while True:
        answer = _krawczyk(cover, period, points)
        near, points, image = (select(boxes, ~answer.none) for boxes in (near, points, answer.box))
        smaller = _common(points, image)
        if _all([4 * y.wid >= 3 * x.wid for x, y in zip(points, smaller, strict=True)]).all():
            order = np.lexsort([x.inf for x in reversed(smaller)])
            return tuple(x[order] for x in smaller), tuple(x[order] for x in near)
        points = smaller


def _widened(cover: Cover, period: int, points: Boxes, near: Boxes) -> Boxes:
    """Return boxes a little larger than `points`, or `near` where uniqueness fails on them.

    A box that was cut to a fixed point may end next to it, and does not hold its neighbourhood.
    """
    sides = [_REACH * float(side.wid[0]) for side in one_box(cover.region.box)]
    wide = tuple(x.widen(Fraction(reach)) for x, reach in zip(points, sides, strict=True))
    only = np.zeros(len(points[0]), dtype=bool)
    for part, answer in evaluated(partial(_examined, cover, period), wide):
        if answer is not None:
            only[part] = answer.unique & ~answer.none
    return _replaced(only, near, wide)


def _common(boxes: Box, other: Box) -> Boxes:
    return tuple(meet(x, y) for x, y in zip(boxes, other, strict=True))


def _larger(boxes: Boxes) -> Boxes:
    """Return boxes that contain the given ones, a quarter wider."""
    return tuple(x + (x - middle(x)) / 4 for x in boxes)


def _distinct(points: Boxes, near: Boxes) -> tuple[Boxes, Boxes]:
    """Return narrow and wide boxes for each zero once: (2)."""
    kept: list[int] = []
    for i in range(len(points[0])):
        one, around = _row(points, i), _row(near, i)
        narrow, wide = select(points, _mask(kept, points)), select(near, _mask(kept, near))
        if (_within(one, wide) | _within(narrow, around)).any():
            continue
        if _meet(one, narrow).any():
            raise Undecided(f"perhaps two periodic points in {_shown(points, i)}")
        kept.append(i)
    index = _mask(kept, points)
    return select(points, index), select(near, index)


def _successors(f: Function, points: Boxes, near: Boxes) -> list[int]:
    """Return for each point p the place of f(p), or _NOWHERE: (3)."""
    images = tuple(components(f(*points)))
    places = []
    for i in range(len(points[0])):
        image = _row(images, i)
        hits = np.flatnonzero(_within(image, near))
        if not len(hits) and _meet(image, points).any():
            raise Undecided(f"which point follows that in {_shown(points, i)}")
        places.append(int(hits[0]) if len(hits) else _NOWHERE)
    return places


def _cycles(following: list[int]) -> list[list[int]]:
    """Return the cycles of a map of places, each from its least place: (4)."""
    found, seen = [], set[int]()
    for first in range(len(following)):
        path: list[int] = []
        at = first
        while at != _NOWHERE and at not in seen:
            seen.add(at)
            path.append(at)
            at = following[at]
        if at in path:
            cycle = path[path.index(at) :]
            least = cycle.index(min(cycle))
            found.append(cycle[least:] + cycle[:least])
    return found


def _orbit(f: Function, points: Boxes, cycle: list[int]) -> Orbit:
    boxes = [as_box(points, i) for i in cycle]
    _, rows = jacobian(iterate(f, len(cycle)), list(boxes[0]))
    return Orbit(tuple(boxes), tuple(tuple(row) for row in rows))


def _row(boxes: Boxes, i: int) -> Boxes:
    return select(boxes, slice(i, i + 1))


def _mask(kept: list[int], boxes: Boxes) -> Mask:
    mask = np.zeros(len(boxes[0]), dtype=bool)
    mask[kept] = True
    return mask


def _within(boxes: Box, other: Box) -> Mask:
    return _all([x.subset(y) for x, y in zip(boxes, other, strict=True)])


def _meet(boxes: Box, other: Box) -> Mask:
    return _all([~x.disjoint(y) for x, y in zip(boxes, other, strict=True)])


def _all(masks: list[NDArray[np.bool_]]) -> Mask:
    return np.asarray(np.logical_and.reduce(masks))


def _shown(boxes: Boxes, i: int) -> str:
    return " x ".join(f"[{side.inf[i]:.12g}, {side.sup[i]:.12g}]" for side in boxes)
