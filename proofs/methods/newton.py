"""Periodic orbits of any map: found by Newton's method in floating point, concluded by a rule."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import Any, NamedTuple

import numpy as np

from intervals import Undecided
from proofs.methods.derivation import Derivation
from proofs.methods.sampling import Floats, Sampled, ranges_of
from proofs.trusted.certificate import texts
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.covers import Rows
from proofs.trusted.kernel.enclose import Box, centre_of
from proofs.trusted.kernel.meter import DEFAULT, Exhausted, metered
from proofs.trusted.kernel.periodic import Closing
from proofs.trusted.kernel.zeros import Piece, krawczyk
from proofs.trusted.numbers import Range

FAR = 1e6  # where points are lost
_STEPS, _NEAR, _STILL = 12, 1e-9, 1e-13  # of Newton's method
_WAY, _CELLS = 20, 50  # steps of points at random; of each side of their box
_SAME = 1e-6  # the distance of points that are one
_ALIKE = 9  # decimal places in which most starts agree with others
_BITS = 160  # of boxes around points
_RADII = ("1/1000000000", "1/100000000000", "1/10000000", "1/100000")  # of boxes around points
_FIRST, _MORE, _INFLATIONS = Fraction(1, 10**6), 1.3, 12  # of boxes where parameters have ranges


class Cycle(NamedTuple):
    """A periodic orbit in floating point: its points, a row each, and (F^n)' at the first."""

    points: Floats
    derivative: Floats

    @property
    def multipliers(self) -> Floats:
        """The absolute values of the multipliers, in increasing order; nan without a derivative."""
        if not np.isfinite(self.derivative).all():
            return np.full(len(self.derivative), np.nan)
        return np.asarray(np.sort(np.abs(np.linalg.eigvals(self.derivative))))

    @property
    def is_saddle(self) -> bool:
        """Whether it has one unstable direction, and no other is neutral."""
        sizes = self.multipliers
        return bool(sizes[-1] > 1.05 and (len(sizes) == 1 or sizes[-2] < 0.95))

    def meets(self, box: Sequence[Range]) -> bool:
        """Whether a point of it is in a box."""
        low, high = np.array(box, float).T
        return bool(((low <= self.points) & (self.points <= high)).all(axis=1).any())


def cycles(sampled: Sampled, period: int, starts: Floats) -> list[Cycle]:
    """Return the periodic orbits of a least period to which Newton's method leads.

    starts: of the shape (variables, points).
    """
    x = _fixed(sampled.iterate(period), starts)
    return _distinct(sampled, period, x[:, np.isfinite(x).all(axis=0)])


def _fixed(iterate: Sampled, starts: Floats) -> Floats:
    """Return the fixed points to which Newton's method leads, nan where to none."""
    x = starts.copy()
    with np.errstate(all="ignore"):
        for _ in range(_STEPS):
            image, derivatives = iterate.expanded(x)
            matrix, missed = derivatives - np.eye(len(x)), image - x.T
            step = _solved(matrix, missed - whole_periods(iterate, missed)).T
            x = x - step
            if np.nanmax(np.abs(step), initial=0) < _STILL:
                break
        good = (np.abs(step) < _NEAR * (1 + np.abs(x))).all(axis=0) & np.isfinite(x).all(axis=0)
    return np.where(good, x, np.nan)


def _solved(matrices: Floats, right: Floats) -> Floats:
    finite = np.isfinite(matrices).all(axis=(1, 2)) & np.isfinite(right).all(axis=1)
    regular = np.array(finite)
    regular[finite] = np.abs(np.linalg.det(matrices[finite])) > 1e-12
    result = np.full(right.shape, np.nan)
    result[regular] = np.linalg.solve(matrices[regular], right[regular][..., None])[..., 0]
    return result


def _distinct(sampled: Sampled, period: int, starts: Floats) -> list[Cycle]:
    """Return each orbit once, from its first point in lexicographic order."""
    result: list[Cycle] = []
    seen: Floats = np.empty((0, len(starts)))
    starts = sampled.reduced(starts)
    _, places = np.unique(np.round(starts, _ALIKE), axis=1, return_index=True)
    for start in starts.T[np.sort(places)]:
        if (distance(sampled, start, seen) < _SAME).any():
            continue
        orbit = [start]
        while len(orbit) < period:
            orbit.append(sampled.reduced(sampled(orbit[-1][:, None]))[:, 0])
        points = np.array(orbit)
        if not np.isfinite(points).all() or (distance(sampled, start, points[1:]) < _SAME).any():
            continue
        seen = np.concatenate([seen, points])
        first = min(range(period), key=lambda k: tuple(np.round(points[k], 6)))
        turned = np.roll(points, -first, axis=0)
        result.append(Cycle(turned, along_orbit(sampled, turned)))
    return sorted(result, key=lambda cycle: tuple(cycle.points[0]))


def distance(sampled: Sampled, x: Floats, y: Floats) -> Any:
    """Return how far points are apart, a row each; angles are taken modulo their periods."""
    gap = x - y - whole_periods(sampled, x - y)
    return np.abs(gap).max(axis=-1) / (1 + np.abs(y).max(axis=-1))


def along_orbit(sampled: Sampled, points: Floats) -> Floats:
    """Return the product of the derivatives along an orbit."""
    product_ = np.eye(points.shape[1])
    for derivative in sampled.expanded(points.T)[1]:
        product_ = derivative @ product_
    return product_


@np.errstate(all="ignore")
def whole_periods(sampled: Sampled, apart: Floats) -> Floats:
    """Return the whole periods next to differences of points, a row each; 0 without a period."""
    turns = np.where(np.isfinite(sampled.periods), np.round(apart / sampled.periods), 0)
    return np.asarray(turns * np.where(np.isfinite(sampled.periods), sampled.periods, 0))


def seeds(sampled: Sampled, box: Sequence[Range], count: int, steps: int = 20) -> Floats:
    """Return points at random in a box, and where the map takes them in some steps."""
    x = _at_random(box, count)
    return np.concatenate([x, _settled(sampled, x, steps)], axis=1)


@np.errstate(all="ignore")
def returning(sampled: Sampled, box: Sequence[Range], count: int, period: int) -> Floats:
    """Return points on the ways of points at random that come back closest in a period, apart."""
    way = [_at_random(box, count)]
    while len(way) <= _WAY + period:
        way.append(sampled.reduced(sampled(way[-1])))
    points, later = (np.concatenate(x, axis=1) for x in (way[:-period], way[period:]))
    closest = points[:, np.argsort(distance(sampled, later.T, points.T))]
    low, high = np.array(box, float).T[:, :, None]
    cells = np.floor((closest - low) / (high - low) * _CELLS)
    inside = ((cells >= 0) & (cells < _CELLS)).all(axis=0)
    _, places = np.unique(cells[:, inside], axis=1, return_index=True)
    return closest[:, inside][:, np.sort(places)[:count]]


def _at_random(box: Sequence[Range], count: int) -> Floats:
    low, high = np.array(box, float).T[:, :, None]
    shares = np.random.default_rng(len(box)).random((len(box), count))
    return np.asarray(low + (high - low) * shares)


def as_points(states: Sequence[Sequence[Fraction]]) -> Floats:
    """Return states as columns of floats."""
    return np.array(states, float).T


def _settled(sampled: Sampled, x: Floats, steps: int) -> Floats:
    """Return where points are after some steps, those that stay finite."""
    for _ in range(steps):
        x = sampled.reduced(sampled(x))
        x = x[:, np.isfinite(x).all(axis=0) & (np.abs(x) < FAR).all(axis=0)]
    return x


def prove_orbits(
    file: Derivation, function: str, cycles: Sequence[Cycle], work: int = DEFAULT
) -> list[str]:
    """Add steps `periodic-orbit` about those orbits for which they are concluded.

    Each in some work at the most, by default that of a check. Raises Undecided where there is none,
    with the last reason.
    """
    steps, reason = [], "no isolated one is seen"
    for cycle in cycles:
        try:
            with metered(work):
                steps.append(_prove_orbit(file, function, cycle))
        except (Unproved, Exhausted) as error:
            why = "it takes too long to prove" if isinstance(error, Exhausted) else error
            place = ", ".join(f"{value:.6g}" for value in cycle.points[0])
            reason = f"of {len(cycles)} that are seen none, such as that through ({place}): {why}"
    if not steps:
        raise Undecided(reason)
    return steps


def _prove_orbit(file: Derivation, function: str, cycle: Cycle) -> str:
    """Add a step `periodic-orbit` about an orbit; raises Unproved where that is not concluded."""
    map_, n = file.map(function), len(cycle.points)
    if not np.isfinite(cycle.derivative).all():
        raise Unproved("the map has no derivative on it, as far as is seen")
    matrix = np.linalg.inv(cycle.derivative - np.eye(len(map_.variables)))
    rows = [tuple(Fraction(f"{entry:.10g}") for entry in row) for row in matrix]
    witness: dict[str, Any] = {"function": function, "period": str(n)}
    turns: tuple[int, ...] = ()
    if map_.circles:
        sampled = Sampled(map_).iterate(n)
        apart = (sampled(cycle.points[:1].T)[:, 0] - cycle.points[0]) / sampled.periods
        turns = tuple(round(apart[circle.place]) for circle in map_.circles)
        witness["turns"] = list(map(str, turns))
    witness["matrix"] = list(map(texts, rows))
    closing, reason = Closing(map_, n, turns), Unproved("no box around the orbit is found")
    for box in _boxes(closing, cycle.points[0], tuple(rows), bool(ranges_of(map_))):
        try:
            return file.add("periodic-orbit", {**witness, "box": list(map(texts, box))})
        except Unproved as error:
            reason = error
    raise reason


def _boxes(closing: Closing, point: Floats, matrix: Rows, has_ranges: bool) -> Iterator[Box]:
    """Yield boxes around a point of an orbit, to be tried in turn.

    Where parameters have ranges, they are grown until the checker's operator maps one inside
    (epsilon-inflation: Rump, Kleine Fehlerschranken bei Matrixproblemen, 1980).
    """
    if not has_ranges:
        yield from (_around(point, [Fraction(radius)] * len(point)) for radius in _RADII)
        return
    box = _around(point, [_FIRST] * len(point))
    for _ in range(_INFLATIONS):
        middle = centre_of(box)
        flat = Piece(box, (Fraction(0),) * len(box))
        enclosures = krawczyk(closing, flat, middle, matrix, (None, _BITS))
        image = {k: each.range for k, each in enclosures.items()}
        if any(high - low > FAR for low, high in image.values()):
            return
        if all(box[k][0] < low and high < box[k][1] for k, (low, high) in image.items()):
            yield box
            return
        box = _around(
            point,
            [
                Fraction(f"{_MORE * float(max(high - m, m - low)) / 2:.2g}")
                for m, (low, high) in zip(middle, image.values(), strict=True)
            ],
        )


def _around(point: Floats, radii: Sequence[Fraction]) -> Box:
    """Return a box with few digits, of twice the radii."""
    units = [Fraction(10) ** math.floor(math.log10(radius)) for radius in radii]
    middles = [
        round(Fraction(float(x)) / unit) * unit for x, unit in zip(point, units, strict=True)
    ]
    return tuple((m - 2 * r, m + 2 * r) for m, r in zip(middles, radii, strict=True))
