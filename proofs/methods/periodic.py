"""All periodic orbits of a map in a region: the equations of a whole orbit, solved completely.

Theorem. Let f be a map given by a formula, R a region, n >= 1. If `periodic_orbits` returns, its
list has every periodic orbit in R whose period divides n, once, with its exact period. Otherwise
Undecided is raised.

Proof. (1) The points z_0, ..., z_(n-1) of such an orbit solve f(z_i) = z_(i+1), i mod n, and so do
the rotations z_k, z_(k+1), ...; one of them has its least first coordinate in front. `zeros` lists
every solution that is in R and has it in front, each one as the only solution in its box.
(2) A solution with a point outside R, or with a smaller first coordinate behind, goes: the latter
has a rotation that stays. If some point is not proved to be in R, Undecided is raised.
(3) Two of those that stay are the same orbit exactly if one is a rotation of the other, by some k;
then z_k has the least first coordinate, too. So where z_k may have it, the rotation by k is
compared with all: boxes that are disjoint hold different solutions; a larger box around two, with
exactly one solution in it, the same. Else Undecided is raised. The least k > 0 for which a solution
is its own rotation is its period, n if there is none.

Source: Galias, Interval methods for rigorous investigations of periodic orbits, Int. J. Bifurcation
Chaos 11 (2001), where the system for the whole orbit is solved as well.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np

from intervals import Interval, IntervalArray, Undecided
from intervals.array import Mask
from intervals.branch import Boxes, as_box, meets, select
from intervals.krawczyk import contract
from intervals.newton import Roots
from intervals.systems import Function, components, jacobian
from intervals.zeros import zeros
from proofs.methods.cells import Cover

_REACH = Fraction(1, 2**26)  # around cells, and around two solutions that may be one


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
        for _ in range(n):
            x = tuple(components(f(*x)))
        return list(x)

    return power


def periodic_orbits(cover: Cover, period: int, *, limit: int = 1_000_000) -> list[Orbit]:
    """Return the orbits of the theorem, by period, then by their first point.

    The first point has the least first coordinate. Raises Undecided where a sub-box is too small to
    be split, or after about `limit` of them: at a fixed point of f^n that is not isolated, say.
    """
    if period < 1:
        raise ValueError("a period is at least 1")
    if not len(cover.cells[0]):
        return []
    points = _solutions(cover, period, limit)
    if not points:
        return []
    kept = _in_region(cover, points)
    points = [select(point, kept) for point in points]
    orbits = []
    for i, length in _periods(cover, period, points).items():
        boxes = tuple(as_box(point, i) for point in points[:length])
        _, rows = jacobian(iterate(cover.f, length), boxes[0])
        orbits.append(Orbit(boxes, tuple(tuple(row) for row in rows)))
    return sorted(orbits, key=lambda orbit: (orbit.period, [x.inf for x in orbit.points[0]]))


def _system(f: Function, size: int) -> Function:
    """Return f(z_i) - z_(i+1) as a function of all coordinates of the points, of so many each."""

    def equations(*z: Any) -> list[Any]:
        points = _points(z, size)
        following = (*points[1:], points[0])
        return [
            value - coordinate
            for point, after in zip(points, following, strict=True)
            for value, coordinate in zip(components(f(*point)), after, strict=True)
        ]

    return equations


def _points(z: Sequence[Any], size: int) -> list[tuple[Any, ...]]:
    return [tuple(z[i : i + size]) for i in range(0, len(z), size)]


def _solutions(cover: Cover, period: int, limit: int) -> list[Boxes]:
    """Return the points of all solutions of (1): for each place on the orbit an array of boxes."""
    size, g = len(cover.cells), cover.region.g
    hull = tuple(
        Interval.from_float(x.inf.min()).hull(Interval.from_float(x.sup.max())) for x in cover.cells
    )

    def asked(*z: Any) -> list[Any]:
        points = _points(z, size)
        in_region = [value for point in points for value in (components(g(*point)) if g else [])]
        return in_region + [point[0] - z[0] for point in points[1:]]

    around = tuple(IntervalArray([x]).widen(_REACH).item() for x in hull)
    found = zeros(_system(cover.f, size), around * period, where=asked, limit=limit)
    for result in found:
        if result.outcome is not Roots.UNIQUE:
            place = " x ".join(f"{side:12}" for side in (result.box or ())[:size])
            raise Undecided(f"whether there is a periodic point in {place}")
    columns = zip(*(result.box or () for result in found), strict=True)
    return _points([IntervalArray(list(column)) for column in columns], size)


def _in_region(cover: Cover, points: list[Boxes]) -> Mask:
    """Return which solutions are in R with the least first coordinate in front, as in (2)."""
    out = np.zeros(len(points[0][0]), dtype=bool)
    inside = ~out
    for point in points:
        out |= cover.region.misses(point) | (point[0].sup < points[0][0].inf)
        inside &= cover.region.contains(point)
    unclear = np.flatnonzero(~out & ~inside)
    if unclear.size:
        boxes = [as_box(point, int(unclear[0])) for point in points]
        place = ", ".join(" x ".join(f"{side:12}" for side in box) for box in boxes)
        raise Undecided(f"a periodic point at the boundary of the region, in {place}")
    return ~out


def _periods(cover: Cover, period: int, points: list[Boxes]) -> dict[int, int]:
    """Return one solution of each orbit, with its period: (3)."""
    found = dict.fromkeys(range(len(points[0][0])), period)
    system = _system(cover.f, len(points[0]))
    for k in range(1, period):
        turned = [*points[k:], *points[:k]]
        for i in np.flatnonzero(~(points[k][0].inf > points[0][0].sup)).tolist():
            here = [select(point, slice(i, i + 1)) for point in turned]
            for j in np.flatnonzero(meets(_flat(here), _flat(points))).tolist():
                if not _same(system, here, [select(point, slice(j, j + 1)) for point in points]):
                    raise Undecided(f"whether two orbits are one, in {as_box(here[0], 0)}")
                if i != j:
                    found.pop(max(i, j), None)
                elif i in found:
                    found[i] = min(k, found[i])
    return found


def _same(system: Function, points: list[Boxes], other: list[Boxes]) -> bool:
    """Whether there is exactly one solution in a box around two."""
    pairs = zip(_flat(points), _flat(other), strict=True)
    _, unique, _ = contract(system, [x.hull(y).widen(_REACH) for x, y in pairs], steps=1)
    return bool(unique.all())


def _flat(points: list[Boxes]) -> list[IntervalArray]:
    return [side for point in points for side in point]
