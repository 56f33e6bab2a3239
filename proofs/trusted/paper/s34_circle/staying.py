"""The phases whose orbits stay in an interval, by the graph of a few cells. Trusted, and shared."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.numbers import TURN, Range
from proofs.trusted.slopes import SlopeRange

Edges = frozenset[tuple[int, int]]


@dataclass(frozen=True)
class Cell:
    """An interval of phases on which f is C^1, monotone, with |f'| > 1, and its image.

    slopes bound f'; the image is the arc of [0, 2 pi) from a number in image[0] to one in image[1].
    """

    phases: Range
    slopes: Range
    image: tuple[Range, Range]

    def meets(self, other: Cell) -> bool:
        """Return False only if the image is proved to miss another cell."""
        return self.image[0][0] <= other.phases[1] and other.phases[0] <= self.image[1][1]

    def covers(self, target: Range) -> bool:
        """Whether the image is proved to contain an interval."""
        return self.image[0][1] <= target[0] and target[1] <= self.image[1][0]


@dataclass(frozen=True)
class StayingSet(Conclusion):
    """All phases whose orbits stay in an interval: each such orbit runs through the cells."""

    interval: Range
    cells: tuple[Cell, ...]

    @classmethod
    def of(
        cls,
        interval: Range,
        pieces: Sequence[tuple[SlopeRange, Sequence[Fraction]]],
        gaps: Sequence[tuple[Range, Range]],
    ) -> StayingSet:
        """Cut pieces, on which f' is known, into cells; ValueError unless all hypotheses hold.

        Hypotheses: the cuts x_0 < ... < x_n of a piece are points of its `SlopeRange`, the cells
        the parts between neighbours, each as `_cell` asks. f maps each gap (phases, target)
        outside its target, which contains the interval. Pieces, in the interval, and gaps together
        cover it. Then an orbit that stays has no point in a gap, so all are in cells.
        """
        cells = [_cell(slopes, ends) for slopes, cuts in pieces for ends in pairwise(cuts)]
        if any(target[0] > interval[0] or target[1] < interval[1] for _, target in gaps):
            raise ValueError("a gap is not proved to avoid the interval")
        parts = sorted([*(cell.phases for cell in cells), *(phases for phases, _ in gaps)])
        if any(x.phases[0] < interval[0] or x.phases[1] > interval[1] for x in cells):
            raise ValueError("a piece leaves the interval")
        reached = interval[0]
        for low, high in parts:
            if low <= reached:
                reached = max(reached, high)
        if reached < interval[1] or not any(low <= interval[0] <= high for low, high in parts):
            raise ValueError("pieces and gaps do not cover the interval")
        return cls(interval, tuple(cells))

    @property
    def paths(self) -> Edges:
        """The pairs (i, j), f of cell i perhaps meeting cell j, that lie on infinite paths."""
        count = range(len(self.cells))
        edges = {(i, j) for i in count for j in count if self.cells[i].meets(self.cells[j])}
        while True:
            alive = {i for i, _ in edges}
            kept = {(i, j) for i, j in edges if j in alive}
            if kept == edges:
                return frozenset(edges)
            edges = kept

    @property
    def finite(self) -> bool:
        """Whether at most one path starts in each cell; then at most one phase of it stays.

        Two phases with the same path move apart, by |f'| > 1 on arcs shorter than the circle, as
        long as both stay: they are the same.
        """
        return len({i for i, _ in self.paths}) == len(self.paths)

    @property
    def cycle(self) -> tuple[Cell, ...]:
        """The cells of the one closed path that all staying orbits follow; () if it is not so.

        Theorem. If the paths are one closed path without repetition, through disjoint cells, and
        f of each of its cells covers the next one, the phases that stay are the points of one
        periodic orbit, of this period. Proof. The inverse branches along the path contract the
        first cell into itself: it holds one periodic point. Else `finite`.
        """
        step = dict(self.paths)
        if not step or not self.finite:
            return ()
        path = [min(step)]
        while (following := step[path[-1]]) not in path:
            path.append(following)
        cells = tuple(self.cells[i] for i in path)
        closed = following == path[0] and len(path) == len(step)
        covered = all(self.cells[i].covers(self.cells[j].phases) for i, j in step.items())
        return cells if closed and covered and _disjoint(cells) else ()

    @property
    def is_full_shift(self) -> bool:
        """Whether the cells are disjoint, two or more, and f of each covers the interval.

        Theorem. Then phase -> (index of the cell of f^n(phase))_n is a homeomorphism of the
        staying set onto the sequences over the cells, and turns f into the shift. Proof. The
        phases that follow a word of length n in one cell are an interval, by the inverse branches,
        which are defined on all cells; it is at most |cell| / mu^(n-1) long, mu = min |f'| > 1. So
        every sequence has one phase, which depends continuously on it; sequences are compact.
        """
        covered = all(cell.covers(self.interval) for cell in self.cells)
        return len(self.cells) > 1 and covered and _disjoint(self.cells)

    @property
    def orbits(self) -> tuple[tuple[Cell, ...], ...]:
        """Cells of periodic orbits worth naming: the cycle; fixed points of the outermost cells."""
        if self.is_full_shift:
            return (self.cells[0],), (self.cells[-1],)
        return (self.cycle,) if self.cycle else ()

    @property
    def increasing(self) -> bool:
        """Whether f' > 0 on all cells."""
        return all(cell.slopes[0] > 0 for cell in self.cells)

    @property
    def slopes(self) -> Range:
        """Bounds on f' over all cells."""
        return min(x.slopes[0] for x in self.cells), max(x.slopes[1] for x in self.cells)


def _cell(of: SlopeRange, phases: Range) -> Cell:
    """Return a cell between two points; ValueError unless its hypotheses hold.

    f is monotone, |f'| > 1, so its image is an arc with the images of the ends as ends: shorter
    than 2 pi, by the bound on f', and not through phase 0 if these are in order in [0, 2 pi).
    """
    low, high = phases
    if low >= high or not {low, high} <= set(of.points):
        raise ValueError("a cut is not a point of the step, or out of order")
    first, last = of.points.index(low), of.points.index(high)
    bounds = of.pieces[first:last]
    slopes = min(x for x, _ in bounds), max(x for _, x in bounds)
    if slopes[0] <= 1 and slopes[1] >= -1:
        raise ValueError("f does not expand on a cell")
    if max(map(abs, slopes)) * (high - low) >= TURN:
        raise ValueError("the image of a cell may be longer than the circle")
    ends = of.images[first], of.images[last]
    bottom, top = ends if slopes[0] > 1 else ends[::-1]
    if bottom[0] < 0 or bottom[1] >= top[0] or top[1] >= TURN:
        raise ValueError("the image of a cell passes phase 0, or is not ordered")
    return Cell(phases, slopes, (bottom, top))


def _disjoint(cells: Iterable[Cell]) -> bool:
    parts = sorted(cell.phases for cell in cells)
    return all(one[1] < two[0] for one, two in pairwise(parts))
