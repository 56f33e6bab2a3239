"""Candidates for a partition of the circle on which a map can be followed: floating point.

Cuts are placed at preimages of cuts, so that most cells are mapped onto unions of cells, and the
bookkeeping of `s34_circle.cells` loses little: first where most is lost. Nothing here is evidence.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Whole = NDArray[np.int64]
_NEAR = 3e-11  # images as close to a cut are meant to be there
_SHARE = 8  # one cell in so many is cut in each round
_DEEPEST = 6  # how far on a cell is looked for that can be cut
_MOST_VISITS = 300.0


class Piece(NamedTuple):
    """The part of a monotone branch: the ends, in order, and their images, counted on the line."""

    phases: tuple[float, float]
    images: tuple[float, float]


class Cutting(NamedTuple):
    """Cuts in order; of each the branch, -1 if there is none, and the image, less 2 pi turns."""

    phases: Floats
    branch: Whole
    images: Floats
    turns: Whole

    def at(self, which: Whole) -> Cutting:
        """Return some of the cuts."""
        return Cutting(self[0][which], self[1][which], self[2][which], self[3][which])


class Density(NamedTuple):
    """Bounds of |X'| at the ends of cells, lower phases first, and of its derivative between."""

    ends: tuple[Floats, Floats]
    bend: tuple[Floats, Floats]


class Links(NamedTuple):
    """Cells and those that their images meet: lengths in common, bounds of |X'| there."""

    source: Whole
    target: Whole
    common: Floats
    dense: Floats
    sparse: Floats

    def send(self, left: Floats, held: Floats, width: Floats) -> tuple[Floats, Floats, Floats]:
        """Bound what is sent into three sets, given by cell: left, held (from below), not held."""
        count, inner = len(width), self.common - width[self.target]
        measures = (
            self.dense * np.minimum(left[self.target], self.common),
            self.sparse * np.maximum(0, held[self.target] + inner),
            self.dense * np.minimum((width - held)[self.target], self.common),
        )
        first, second, third = (
            np.bincount(self.source, x, minlength=count).astype(float) for x in measures
        )
        return first, second, third


@dataclass
class Mesh:
    """Cells of the circle, laid out from `origin`; those of `landed` are absorbed at once.

    inverse(branch, images, turns): the phases of a branch with these images.
    density(cutting): `Density` of the cells, NaN where the cuts are on no common branch. landed,
    sink: the lower ends of the cells absorbed at once, and of the one that keeps what it gets.
    """

    origin: float
    branches: Sequence[Piece]
    inverse: Callable[[int, Floats, Whole], Floats]
    density: Callable[[Cutting], Density]
    landed: Sequence[float]
    sink: float | None
    made: Cutting = field(
        default_factory=lambda: Cutting(
            np.zeros(0), np.zeros(0, np.int64), np.zeros(0), np.zeros(0, np.int64)
        )
    )

    def add(self, new: Cutting) -> None:
        """Add cuts."""
        old = self.made
        self.made = Cutting(
            np.concatenate([old.phases, new.phases]),
            np.concatenate([old.branch, new.branch]),
            np.concatenate([old.images, new.images]),
            np.concatenate([old.turns, new.turns]),
        )

    def add_preimages(self, branch: int, lifted: Floats, cuts: Whole) -> None:
        """Add the phases of a branch that are mapped to images on the line, unless too close."""
        turns = np.floor((lifted - self.origin + _NEAR) / math.tau).astype(np.int64)
        images = self.made.phases[cuts]
        phases = self.inverse(branch, images, turns)
        order = np.sort(self.made.phases)
        place = np.clip(np.searchsorted(order, phases), 1, len(order) - 1)
        gap = np.minimum(abs(order[place] - phases), abs(order[place - 1] - phases))
        low, high = self.branches[branch].phases
        keep = (gap > 1e-12) & (low < phases) & (phases < high)
        _, first = np.unique(phases, return_index=True)
        keep &= np.isin(np.arange(len(phases)), first)
        where = np.full(int(keep.sum()), branch)
        self.add(Cutting(phases[keep], where, images[keep], turns[keep]))

    def seed(self) -> None:
        """Add all preimages of the cuts that are on no branch."""
        fixed = np.flatnonzero(self.made.branch < 0)
        for index, branch in enumerate(self.branches):
            low, high = sorted(branch.images)
            for parent in fixed:
                image = self.made.phases[parent]
                first, last = math.ceil((low - image) / math.tau), (high - image) // math.tau
                lifted = image + math.tau * np.arange(first, last + 1)
                self.add_preimages(index, lifted, np.full(len(lifted), parent))

    def grow(self, goal: float, most: int, steps: int) -> Followed:
        """Cut where most is lost, until that is below the goal, or there are so many cuts."""
        while True:
            followed = Followed.of(self, steps)
            if followed.lost.sum() < goal or len(self.made.phases) >= most:
                return followed
            before = len(self.made.phases)
            for branch, (lifted, cuts) in followed.wanted().items():
                self.add_preimages(branch, np.array(lifted), np.array(cuts))
            if len(self.made.phases) == before:
                return followed


@dataclass
class Followed:
    """What becomes of the cells of a mesh: bounds, as in `s34_circle.cells`, up to rounding.

    left: of what is not absorbed; held: of what comes to the sink; lost: how much finer cells
    might gain at each.
    """

    mesh: Mesh
    order: Whole
    cutting: Cutting
    marks: Floats
    low: Floats
    high: Floats
    links: Links
    left: Floats
    held: Floats
    lost: Floats

    @classmethod
    def of(cls, mesh: Mesh, steps: int) -> Followed:
        """Follow the cells for so many steps."""
        order = np.argsort(mesh.made.phases)
        cutting = mesh.made.at(order)
        x = cutting.phases
        marks = np.concatenate([x, x + math.tau])
        on = (cutting.branch[1:] == cutting.branch[:-1]) & (cutting.branch[1:] >= 0)
        lifted = cutting.images + math.tau * cutting.turns
        rising = lifted[1:] > lifted[:-1]
        low = np.where(rising, cutting.images[:-1], cutting.images[1:])
        high = low + abs(np.diff(lifted))
        low, high = (_snapped(np.where(on, each, x[:-1]), marks) for each in (low, high))
        on &= high - low < math.tau - 1e-3
        links = _links(marks, (low, high), on, _rising(mesh.density(cutting), rising))
        count = len(x)
        width = np.diff(marks[: count + 1])
        landed, sink = np.isin(x, list(mesh.landed)), x == mesh.sink
        moving = np.append(on, False) & ~landed
        left, held = np.where(landed, 0.0, width), np.where(sink, width, 0.0)
        for _ in range(steps):
            sent, kept, away = links.send(left, held, width)
            left = np.where(moving, np.minimum(left, sent), left)
            held = np.where(moving, np.maximum(np.maximum(held, kept), width - away), held)
        mixed = moving & (left > 1e-14) & (held < width - 1e-14)
        visits = np.ones(count)
        real = mixed[links.source]
        source, target, dense = links.source[real], links.target[real], links.dense[real]
        for _ in range(steps):
            flow = np.bincount(target, dense * visits[source], minlength=count)
            visits = np.minimum(1 + flow, _MOST_VISITS)
        error = (links.dense - links.sparse) * np.minimum(left[links.target], links.common)
        lost = np.where(mixed, np.bincount(links.source, error, minlength=count) * visits, 0)
        return cls(mesh, order, cutting, marks, low, high, links, left, held, lost)

    def wanted(self) -> dict[int, tuple[list[float], list[int]]]:
        """Return by branch the images at whose preimages to cut, and the cuts that they are."""
        count = len(self.order)
        waiting = list(np.argsort(-self.lost)[: max(50, count // _SHARE)])
        seen: set[int] = set()
        wanted: dict[int, tuple[list[float], list[int]]] = {}
        for _ in range(_DEEPEST):
            onward = []
            for i in waiting:
                if i in seen or i >= count - 1 or self.low[i] >= self.high[i]:
                    continue
                seen.add(i)
                first = int(np.searchsorted(self.marks, self.low[i] + _NEAR))
                last = int(np.searchsorted(self.marks, self.high[i] - _NEAR))
                if first == last:
                    onward.append((first - 1) % count)
                    continue
                middle = (self.low[i] + self.high[i]) / 2
                best = first + int(np.argmin(abs(self.marks[first:last] - middle)))
                base = min(
                    self.cutting.images[j] + math.tau * self.cutting.turns[j] for j in (i, i + 1)
                )
                entry = wanted.setdefault(int(self.cutting.branch[i]), ([], []))
                entry[0].append(base + float(self.marks[best] - self.low[i]))
                entry[1].append(int(self.order[best % count]))
            waiting = onward
        return wanted


def _snapped(values: Floats, marks: Floats) -> Floats:
    """Move values that are close to a mark onto it."""
    place = np.clip(np.searchsorted(marks, values), 1, len(marks) - 1)
    before, after = marks[place - 1], marks[place]
    nearest = np.where(abs(after - values) < abs(before - values), after, before)
    return np.where(abs(nearest - values) < _NEAR, nearest, values)


def _rising(density: Density, rising: NDArray[np.bool_]) -> Density:
    """Put the lower ends of the images first."""
    below, above = (np.where(rising, *pair) for pair in (density.ends, density.ends[::-1]))
    return Density((below, above), density.bend)


def _links(
    marks: Floats, images: tuple[Floats, Floats], on: NDArray[np.bool_], density: Density
) -> Links:
    """Find the cells that images meet, and bound |X'| there by the mean value theorem."""
    low, high = images
    first = np.searchsorted(marks, low, "right") - 1
    last = np.searchsorted(marks, np.where(on, high, low), "left")
    count = np.where(on, np.maximum(last - first, 1), 0)
    source = np.repeat(np.arange(len(on)), count)
    target = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count) + first[source]
    begin = np.maximum(marks[target], low[source])
    end = np.minimum(marks[target + 1], high[source])
    below, above = density.ends
    down, up = (bend[source] for bend in density.bend)
    from_low = begin - low[source], end - low[source]
    to_high = high[source] - end, high[source] - begin
    dense = np.minimum(
        below[source] + np.maximum(*(up * x for x in from_low)),
        above[source] + np.maximum(*(-down * x for x in to_high)),
    )
    sparse = np.maximum(
        below[source] + np.minimum(*(down * x for x in from_low)),
        above[source] + np.minimum(*(-up * x for x in to_high)),
    )
    cells = len(marks) // 2
    return Links(
        source,
        target % cells,
        end - begin,
        np.nan_to_num(dense, nan=1e6, posinf=1e6),
        np.maximum(0, np.nan_to_num(sparse, neginf=0)),
    )
