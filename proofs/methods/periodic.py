"""All periodic orbits of a map in a region: the equations of a whole orbit, solved completely.

Theorem. Let f be a map given by a formula, R a region, n >= 1. If `periodic_orbits` returns, its
list has every periodic orbit in R whose period divides n, once, with its exact period. Otherwise
Undecided is raised.

Proof. (1) The points z_0, ..., z_(n-1) of such an orbit solve f(z_i) = z_(i+1), i mod n, and so do
the rotations z_k, z_(k+1), ...; one of them has its least first coordinate in front. `cyclic` has
every solution that is in R and has it in front, each one as the only solution in a box.
(2) A solution with a point outside R, or with a smaller first coordinate behind, goes: the latter
has a rotation that stays. If some point is not proved to be in R, Undecided is raised.
(3) Two boxes have the same orbit exactly if the solution of one is a rotation of the other's, by
some k; then z_k has the least first coordinate, too. So where z_k may have it, the rotation by k is
compared with all: boxes that are disjoint hold different solutions; a larger box around two, with
exactly one solution in it, the same. Else Undecided is raised. The least k > 0 for which a solution
is its own rotation is its period, n if there is none.

Source: Galias, Interval methods for rigorous investigations of periodic orbits, Int. J. Bifurcation
Chaos 11 (2001), where the system for the whole orbit is solved as well.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from intervals import Interval, IntervalArray, Undecided
from intervals.array import Mask
from intervals.branch import concatenated
from proofs.methods.cells import Cover
from proofs.methods.cyclic import CyclicSystem, portions, turned

_REACH = Fraction(1, 2**26)  # around cells
_NEAR = Fraction(1, 2**30)  # around two solutions that may be one

Indices = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class Orbit:
    """A periodic orbit p_0, p_1 = f(p_0), ...: boxes of its points, and f^n' at p_0, n the period.

    `boxes` has the shape (n, d), d coordinates, and `slopes` the shape (d, d).
    """

    boxes: IntervalArray
    slopes: IntervalArray

    @property
    def period(self) -> int:
        """The least period, the number of points."""
        return len(self.boxes)

    @cached_property
    def points(self) -> tuple[tuple[Interval, ...], ...]:
        """The boxes of p_0, p_1, ..."""
        return tuple(map(tuple, self.boxes.tolist()))

    @cached_property
    def derivative(self) -> tuple[tuple[Interval, ...], ...]:
        """Enclosures of the derivative of f^n at p_0."""
        return tuple(map(tuple, self.slopes.tolist()))

    @property
    def trace(self) -> Interval:
        """The sum of the multipliers; in one dimension the multiplier."""
        first, *others = (row[i] for i, row in enumerate(self.derivative))
        return sum(others, first)


def periodic_orbits(cover: Cover, period: int, *, limit: int = 10_000_000) -> list[Orbit]:
    """Return the orbits of the theorem, by period, then by their first point.

    The first point has the least first coordinate. Raises Undecided where a sub-box is too small to
    be split, or after about `limit` of them: at a fixed point of f^n that is not isolated, say.
    """
    if period < 1:
        raise ValueError("a period is at least 1")
    if not len(cover.cells[0]):
        return []
    system = CyclicSystem(cover.f, cover.region.g, len(cover.cells))
    hull = np.array([[x.inf.min(), x.sup.max()] for x in cover.cells])
    around = IntervalArray.from_floats(*hull.T).widen(_REACH)
    boxes = system.solutions(concatenated([around[np.newaxis]] * period)[np.newaxis], limit)
    boxes = boxes[_in_region(cover, boxes)]
    kept, periods = _least_periods(system, boxes)
    orbits: list[Orbit] = []
    for length in sorted(set(periods[kept].tolist())):
        some = boxes[kept & (periods == length)][:, :length]
        some = some[np.lexsort(some.inf[:, 0].T[::-1])]
        orbits += map(Orbit, some, _products(system.derivatives(some)))
    return orbits


def _products(slopes: IntervalArray) -> IntervalArray:
    """Return f'(p_(n-1)) ... f'(p_0) for all orbits (chain rule)."""
    product = slopes[:, 0]
    for i in range(1, slopes.shape[1]):
        product = slopes[:, i] @ product
    return product


def _in_region(cover: Cover, boxes: IntervalArray) -> Mask:
    """Return which solutions are in R with the least first coordinate in front, as in (2)."""
    points = tuple(boxes[..., k].reshape(-1) for k in range(boxes.shape[2]))
    first = boxes[..., 0]
    out = cover.region.misses(points).reshape(first.shape) | (first.sup < first.inf[:, :1])
    gone = out.any(axis=1)
    inside = cover.region.contains(points).reshape(first.shape).all(axis=1)
    for sides in boxes[~gone & ~inside][:1].tolist():
        place = ", ".join(" x ".join(f"{side:12}" for side in point) for point in sides)
        raise Undecided(f"a periodic point at the boundary of the region, in {place}")
    return np.asarray(~gone)


def _least_periods(system: CyclicSystem, boxes: IntervalArray) -> tuple[Mask, Indices]:
    """Return which solutions to keep, one of each orbit, and their periods: (3)."""
    count, n = boxes.shape[:2]
    kept, periods = np.ones(count, dtype=bool), np.full(count, n)
    for k in range(n):
        rotations = turned(boxes, k)
        i, j = _pairs(rotations, boxes, k)
        hulls = rotations[i].hull(boxes[j]).widen(_NEAR)
        for some in portions(hulls):
            if not (unique := system.krawczyk(some).unique).all():
                box = some[~unique][0, 0].tolist()
                raise Undecided(f"whether two orbits are one, in {box}")
        kept[np.maximum(i, j)[i != j]] = False
        own = i[i == j]
        periods[own] = np.minimum(periods[own], k)
    return kept, periods


def _pairs(rotations: IntervalArray, boxes: IntervalArray, by: int) -> tuple[Indices, Indices]:
    """Return i, j for which the i-th rotation may be the j-th solution; each pair once for k = 0.

    Solutions are compared where their first coordinates meet, with the help of their order.
    """
    low, high = boxes.inf[:, 0, 0], boxes.sup[:, 0, 0]
    order = np.argsort(low)
    asked = np.flatnonzero(rotations.inf[:, 0, 0] <= high)
    begin = np.searchsorted(np.maximum.accumulate(high[order]), rotations.inf[asked, 0, 0])
    end = np.searchsorted(low[order], rotations.sup[asked, 0, 0], side="right")
    size = np.maximum(end - begin, 0)
    i = np.repeat(asked, size)
    j = order[np.arange(len(i)) - np.repeat(np.cumsum(size) - size - begin, size)]
    meets = ~rotations[i].disjoint(boxes[j]).any(axis=(1, 2)) & ((by > 0) | (i < j))
    return i[meets], j[meets]
