"""A partition of the circle into cells, and what a map sends into the sticking arc: the search.

On the line from the separation phase, less 2 pi, to the start of the sticking arc: phases that land
on the arc at once, on both sides; between them branches of f, cut into cells; and grazing phases,
where f jumps, in narrow cells of their own. The theorem is rule `absorption`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from itertools import groupby, pairwise
from typing import Any

import numpy as np

from intervals import Undecided
from proofs.methods.basin import Cuts, Sampled
from proofs.motion.flight import Flight
from proofs.motion.impact import first_impact
from proofs.motion.landing import (
    Cutting,
    prove_cells,
    prove_lands,
    reduced,
    short,
)
from proofs.motion.many import float_clock, float_launch
from proofs.motion.phase import lifted
from proofs.motion.system import System
from proofs.motion.windows import BITS, Candidates
from proofs.search.evidence import FAILED
from proofs.search.s34_chaos import Branches
from proofs.search.steps import Prover
from proofs.trusted.certificate import texts
from proofs.trusted.equations import gap, launch_acceleration
from proofs.trusted.numbers import Range
from proofs.trusted.paper.s34_circle.absorption import (
    BRACKET,
    Absorption,
    Cell,
    absorbed,
    in_order,
)
from proofs.trusted.paper.s34_circle.entropy import Branch
from proofs.trusted.paper.s34_circle.landing import Separation

_GRID = 2000
_SAMPLES = 40
_PIECES = 16
_EDGE = Fraction(1, 2**22)  # how far from grazing phases cells end
_LEAN = 2e-8  # more than the brackets of images are wide
_SHORT_FLIGHTS = Fraction(150)
_CLOSE = Fraction(1, 2**40)
_OUTSIDE = 1e-5  # how far outside of the line branches are looked for
Turn = int | None


@dataclass
class Partition:
    """The cells, and the steps that prove them; `arc`: the step `separation`.

    Cells are not made narrower than `finest`, flights over more than `turns` turns of the table
    are left out, and `impacts` impacts are followed.
    """

    prover: Prover
    arc: tuple[str, Separation]
    finest: float = 1e-4
    turns: int = 3000
    impacts: int = 100
    cells: list[Cell] = field(default_factory=list)
    entries: dict[str, list[Any]] = field(default_factory=dict)

    @property
    def system(self) -> System:
        """The oscillator."""
        return self.prover.system

    @cached_property
    def line(self) -> Range:
        """The line's ends, a little outside."""
        arc, unit = self.arc[1], Fraction(1, 2**24)
        return short(lifted(arc.phase, -1, BITS)[0], 24), short(arc.start[1], 24) + unit

    def prove(self) -> tuple[str, Absorption]:
        """Prove how much of the circle is absorbed by the sticking arc (rule absorption)."""
        between = self._prove_lands()
        branches = Branches(self.system, Candidates(self.system, self.turns))
        first, last = float(between[0]) - _OUTSIDE, float(between[1]) + _OUTSIDE
        for low, high in branches.candidates.runs(first, last, _GRID):
            try:
                branches.prove(self.prover, low, high)
            except FAILED:
                continue  # nothing is known there
        pieces = [
            (
                max(short(one.phases[0], 40) + _EDGE, between[0]),
                min(short(one.phases[1], 40) - _EDGE, between[1]),
            )
            for one in branches.branches
        ]
        self._prove_grazing(pieces)
        samples = [_sampled(branches.candidates, *piece) for piece in pieces]
        seeds = {*self.line, *between, *(end for piece in pieces for end in piece)}
        cuts = Cuts(samples, lambda i, x, y: self._refine(samples[i], x, y), self.finest)
        cuts.grow(map(float, seeds), [float(self.arc[1].phase[0])])
        moved = cuts.lean(self._sides(cuts))
        self.entries["cells"] = []
        for index, piece in enumerate(pieces):
            inside = [moved[x] for x in cuts.cuts if x in moved and piece[0] < x < piece[1]]
            ends = zip(map(float, piece), samples[index].images[[0, -1]], strict=True)
            self._prove_cells(branches, index, sorted([*ends, *inside]))
        return self._conclude()

    def _prove_lands(self) -> Range:
        """Prove which phases on both sides land on the arc; return the ends of those between."""
        name, arc = self.arc
        start, leave = float(arc.start[0]), float(arc.phase[0])
        turns = int((leave - math.tau + float(arc.time[0]) - start) // math.tau)
        right = _last(lambda x: self._height(x, leave + math.tau * turns), leave - math.tau, start)
        left = _last(lambda x: self._height(x, leave), start - 1e-3, leave - math.tau)
        first, last = self.line
        between = short(Fraction(right - 1e-9), 40), short(Fraction(left + 1e-9), 40)
        cuts = [first + (between[0] - first) * i / _PIECES for i in range(_PIECES + 1)]
        names = []
        for ends, count in ((cuts, turns), ([between[1], last], 0)):
            found = prove_lands(self.system, arc, ends, count)
            witness = {"separation": name, "cuts": texts(ends), "turns": str(count)}
            names.append(self.prover.add("lands", witness))
            self.cells.append(Cell(found.phases, ()))
        self.entries["lands"] = names
        return between

    def _height(self, phase: float, image: float) -> float:
        """Return about the gap at a phase on the line after a launch."""
        start = float_launch(self.system, np.array(phase))
        return float(gap(start, float_clock(self.system, np.array(image - phase))))

    def _prove_grazing(self, pieces: Sequence[Range]) -> None:
        """Enclose the images of the phases between branches, where the flights are short."""
        names = []
        for (_, low), (high, _) in pairwise(pieces):
            flight = Flight(self.system, (low, high))
            try:
                found = first_impact(flight, _SHORT_FLIGHTS, Fraction(1, 2**8))
            except Undecided:
                continue
            names.append(self.prover.add_impact(found))
            arrivals = [(low + t, high + u) for t, u in found.windows]
            images = (image for one in arrivals for image in reduced(one, self.line[0]))
            self.cells.append(Cell((low, high), tuple(images)))
        self.entries["impacts"] = names

    def _prove_cells(
        self, branches: Branches, index: int, ends: Sequence[tuple[float, float]]
    ) -> None:
        """Prove the cells of one branch between phases, each given with about its image."""
        branch = branches.branches[index]
        cuts = [Fraction(phase) for phase, _ in ends]
        times = [short(Fraction(y - x) - BRACKET / 2, 32) for x, y in ends]
        cutting = Cutting(cuts, times, self._after(branch))
        try:
            self.cells += prove_cells(self.system, branch, cutting, self.line[0])
        except FAILED:
            return
        witness = {"cuts": texts(cuts), "times": texts(times), "after": str(cutting.after)}
        self.entries["cells"].append({"branch": branches.names[index], **witness})

    def _after(self, branch: Branch) -> Fraction:
        """Return a time before the impacts of a branch, after the last zero of sin(eta t)."""
        half = math.pi / float(self.system.eta)
        zero = math.floor(float(min(branch.ends)) / half) * half
        return max(branch.begin, short(Fraction(zero + 1e-3), 20))

    def _refine(self, branch: Sampled, phase: float, image: float) -> float:
        """Return the phase near the given one with this image, by Newton's method.

        At a fixed image the gap has the derivative -(sin(eta t) / eta) A, see `slope`.
        """
        for _ in range(6):
            start = float_launch(self.system, np.array(phase))
            now = float_clock(self.system, np.array(image - phase))
            along = -now.mass_sin / start.eta * launch_acceleration(start)
            phase = float(np.clip(phase - gap(start, now) / along, *branch.phases[[0, -1]]))
        return float(short(Fraction(phase), 40))

    def _sides(self, cuts: Cuts) -> Callable[[float], float]:
        """Return to which side of a cut images should lean: to the one absorbed sooner."""
        images = {cut: image + shift for cut, (_, image, shift) in cuts.origins.items()}
        for sample in cuts.branches:
            images |= zip(sample.phases[[0, -1]].tolist(), sample.images[[0, -1]], strict=True)
        landed = {cell.phases for cell in self.cells}
        cells = []
        for low, high in pairwise(cuts.cuts):
            phases = Fraction(low), Fraction(high)
            first, last = images.get(low, 0.0), images.get(high, math.inf)
            seen: tuple[Range, ...] | None = () if phases in landed else None
            if seen is None and abs(first - last) < 6.0:
                slack = min(2.5 * _LEAN, abs(first - last) / 4)
                ends = Fraction(min(first, last) + slack), Fraction(max(first, last) - slack)
                seen = tuple(reduced(ends, self.line[0]))
            cells.append(Cell(phases, seen))
        found = absorbed(cells, self.impacts)
        steps = [self.impacts if n is None else n for n in found.steps]
        after = dict(zip(cuts.cuts, steps, strict=False))
        before = dict(zip(cuts.cuts[1:], steps, strict=True))

        def side(cut: float) -> float:
            difference = before.get(cut, 0) - after.get(cut, 1)
            return math.copysign(_LEAN, difference) if difference else 0.0

        return side

    def _conclude(self) -> tuple[str, Absorption]:
        """Follow all cells, and record what is found, a little rounded up."""
        cells = in_order(self.cells)
        found = absorbed(cells, self.impacts)
        rest = tuple(Fraction(math.ceil(bound * 10**7) + 1, 10**7) for bound in found.rest)
        within = tuple(_runs_of_equal(cells, found.steps))
        witness = {
            "separation": self.arc[0],
            **self.entries,
            "rest": texts(rest),
            "within": [texts([*phases, Fraction(steps)]) for phases, steps in within],
        }
        return self.prover.add("absorption", witness), Absorption(self.arc[1], rest, within)


def _runs_of_equal(cells: Sequence[Cell], steps: Sequence[Turn]) -> Iterator[tuple[Range, int]]:
    """Join neighbouring cells that are absorbed within the same number of steps."""
    for count, group in groupby(zip(steps, cells, strict=True), key=lambda pair: pair[0]):
        if count is not None:
            members = [cell.phases for _, cell in group]
            yield (members[0][0], members[-1][1]), count


# -- in floating point ---------------------------------------------------------------------------


def _sampled(candidates: Candidates, low: Fraction, high: Fraction) -> Sampled:
    """Sample f on an interval, more densely at the ends."""
    share = (1 - np.cos(np.linspace(0, np.pi, _SAMPLES))) / 2
    phases = float(low) + float(high - low) * share
    phases[-1] = float(high)
    flights = [found.time for x in phases if (found := candidates.impact(float(x)))]
    return Sampled(phases, phases + np.array(flights))


def _last(function: Callable[[float], float], low: float, high: float) -> float:
    """Return about the end of the phases from `low` towards `high` where a function is < 0."""
    grid = [low + (high - low) * i / 400 for i in range(1, 401)]
    outside = next((x for x in grid if function(x) >= 0), high)
    inside = outside - (high - low) / 400
    for _ in range(60):
        middle = (inside + outside) / 2
        inside, outside = (middle, outside) if function(middle) < 0 else (inside, middle)
    return inside
