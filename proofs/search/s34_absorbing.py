"""A partition of the circle into cells, and what a map sends where: the search.

On the line from the separation phase, less 2 pi, to the start of the sticking arc: phases that land
on the arc at once, on both sides; between them branches of f, cut into cells; between branches
grazing phases, where f jumps, and the phases that never impact. The theorem is rule `absorption`.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from typing import Any

import numpy as np

from intervals import Undecided
from proofs.methods.basin import Cutting, Density, Mesh, Piece, Whole
from proofs.motion.digits import middle
from proofs.motion.landing import short, zero
from proofs.motion.many import Floats
from proofs.motion.system import System
from proofs.motion.windows import Candidates
from proofs.search.evidence import FAILED
from proofs.search.s34_chaos import Branches
from proofs.search.steps import Prover
from proofs.trusted.certificate import Reader, texts
from proofs.trusted.equations import (
    Clock,
    clock,
    gap,
    inverse_bend,
    inverse_slope,
    launch_acceleration,
)
from proofs.trusted.flights import Motion, lifted
from proofs.trusted.kernel.arithmetic import pi
from proofs.trusted.numbers import Range
from proofs.trusted.paper.branches import Branch
from proofs.trusted.paper.s34_circle.absorption import (
    BRACKET,
    UNIT,
    Absorption,
    branch_cells,
    followed,
)
from proofs.trusted.paper.s34_circle.cells import Cell
from proofs.trusted.paper.s34_circle.landing import Lands, NeverImpacts, Separation
from proofs.trusted.windows import BITS

_GRID = 2000
_EDGES = (5e-10, 8e-10, 1e-8, 1e-6)  # how far from grazing phases cells end
_OUTSIDE = 1e-5  # how far outside of the line branches are looked for
_MOST_TURNS = 10_000
_HALVINGS, _NEWTON = 20, 5  # steps to an inverse image: close first, then by Newton's method
_WIDER = 6  # than between its ends what is proved of the derivative may be
_ONWARD = 60  # images of the ends of branches that are cuts
_SLOW = 3e-3  # gap' from which on floats seem to tell an impact's time


@dataclass
class Partition:
    """The cells, and the steps that prove them; `arc`: the step `separation`.

    never: the step `never-impacts`, if there is one. Cells are made finer until `goal`, a measure,
    is all that this is thought to gain, or there are `most` cuts; flights over more than `turns`
    turns of the table are left out, and `impacts` impacts are followed. spare, pieces: how far from
    the ends of the phases that land on the arc at once, and in how many pieces, these are proved.
    """

    prover: Prover
    arc: tuple[str, Separation]
    never: tuple[str, NeverImpacts] | None = None
    goal: float = 1e-4
    most: int = 12_000
    turns: int = _MOST_TURNS
    impacts: int = 90
    spare: float = 1e-9
    pieces: int = 16
    cells: list[Cell] = field(default_factory=list)
    entries: dict[str, list[Any]] = field(default_factory=dict)
    lands: tuple[Lands, ...] = ()

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
        """Prove how much of the circle ends up where (rule absorption)."""
        between = self.prove_lands()
        turns = min(self.turns, self.system.eta.denominator)
        branches = Branches(self.system, Candidates(self.system, turns), _EDGES)
        first, last = float(between[0]) - _OUTSIDE, float(between[1]) + _OUTSIDE
        for low, high in branches.candidates.runs(first, last, _GRID):
            try:
                branches.prove(self.prover, low, high)
            except FAILED:
                continue  # nothing is known there
        if not branches.branches:
            raise Undecided("no branch of f is proved between phases that stick at the next impact")
        pieces = _Pieces(self.system, branches, between, float(self.line[0]))
        mesh = self._mesh(pieces, between)
        cuts = mesh.grow(self.goal, self.most, self.impacts).cutting
        self.entries["cells"] = []
        for index, branch in enumerate(branches.branches):
            at = np.flatnonzero(cuts.branch == index)
            self._prove_cells(branches.names[index], branch, cuts.at(at))
        return self._conclude()

    def _mesh(self, pieces: _Pieces, between: Range) -> Mesh:
        """Return the mesh with its first cuts: ends, some of their images, and preimages."""
        first, last = map(float, self.line)
        never = () if self.never is None else map(float, self.never[1].phases)
        fixed = np.array([first, last, *never])
        landed = [first, float(between[1]), last]
        sink = fixed[2] if self.never else None
        mesh = Mesh(first, pieces.parts, pieces.inverse, pieces.density, landed, sink)
        none, no_turns = np.full(len(fixed), -1), np.zeros(len(fixed), np.int64)
        mesh.add(Cutting(fixed, none, fixed, no_turns))
        mesh.add(pieces.orbits())
        mesh.seed()
        return mesh

    def prove_lands(self) -> Range:
        """Prove which phases on both sides land on the arc; return the ends of those between."""
        name, arc = self.arc
        start, leave = float(arc.start[0]), float(arc.phase[0])
        turns = int((leave - math.tau + float(arc.time[0]) - start) // math.tau)
        right = _last(lambda x: self._height(x, leave + math.tau * turns), leave - math.tau, start)
        left = _last(lambda x: self._height(x, leave), start - 1e-3, leave - math.tau)
        first, last = self.line
        between = short(Fraction(right - self.spare), 40), short(Fraction(left + self.spare), 40)
        if not first < between[0] < between[1] < last:
            raise Undecided("no phases are seen on both sides that land on the arc")
        cuts = [first + (between[0] - first) * i / self.pieces for i in range(self.pieces + 1)]
        for ends, count in ((cuts, turns), ([between[1], last], 0)):
            witness = {"separation": name, "cuts": texts(ends), "turns": str(count)}
            step, lands = self.prover.derive("lands", witness)
            self.entries.setdefault("lands", []).append(step)
            self.lands = *self.lands, lands
        return between

    def _height(self, phase: float, image: float) -> float:
        """Return about the gap at a phase on the line after a launch."""
        start = self.system.launched(np.array(phase))
        return float(gap(start, clock(float(self.system.eta), np.array(image - phase))))

    def _prove_cells(self, name: str, branch: Branch, cuts: Cutting) -> None:
        """Prove the cells of one branch between cuts."""
        after = str(after_reversal(self.system, branch))
        for slow in (_SLOW, math.inf):
            phases, times = self._impacts(cuts, slow)
            cuts_of, times_of = ([str(x / UNIT) for x in each] for each in (phases, times))
            entry = {"branch": name, "cuts": cuts_of, "times": times_of, "after": after}
            with suppress(*FAILED):
                self.cells += [*branch_cells(self.prover.context, Reader(entry), self.line[0])]
                self.entries["cells"].append(entry)
                return

    def _impacts(self, cuts: Cutting, slow: float) -> tuple[list[Fraction], list[Fraction]]:
        """Return the cuts in units, and times just before the impacts after launches there.

        Where gap' is less than `slow`, floats are not trusted to tell an impact's time.
        """
        rounded = np.round(cuts.phases / float(UNIT)) * float(UNIT)
        images, falls = polished(self.system, rounded, cuts.images, cuts.turns)
        turn, times = 2 * middle(pi(BITS)), []
        phases = [Fraction(x) for x in rounded.tolist()]
        for x, y, n, fall in zip(phases, images.tolist(), cuts.turns.tolist(), falls, strict=True):
            time = Fraction(y) - x + n * turn
            if abs(fall) < slow:
                time = zero(Motion(self.prover.at, (x, x), BITS), time, 0)
            times.append(short(time, 48) - BRACKET / 2)
        return phases, times

    def _conclude(self) -> tuple[str, Absorption]:
        """Follow all cells, by the theorem of the rule, and record the step."""
        name, never = self.never or (None, None)
        absorption = followed(self.arc[1], self.lands, never, self.cells, self.impacts)
        witness = {
            "separation": self.arc[0],
            "never": [] if name is None else [name],
            **self.entries,
            "impacts": str(self.impacts),
        }
        return self.prover.record("absorption", witness, absorption), absorption


def _inside(low: Fraction, high: Fraction) -> tuple[float, float]:
    """Round an interval inward, to units."""
    return float(math.ceil(low / UNIT) * UNIT), float(math.floor(high / UNIT) * UNIT)


def after_reversal(system: System, branch: Branch) -> Fraction:
    """Return a time before the impacts of a branch, after the last zero of sin(eta t)."""
    half = math.pi / float(system.eta)
    last = math.floor(float(min(end for _, end in branch.windows)) / half) * half
    return max(branch.times[0], short(Fraction(last + 1e-3), 20))


# -- in floating point ---------------------------------------------------------------------------


@dataclass(frozen=True)
class _Pieces:
    """The branches between two phases, and their inverses: candidates, never evidence.

    An image is a number on the line from `origin` and a number of turns, so that long flights lose
    no digits: eta times 2 pi turns is reduced exactly.
    """

    system: System
    branches: Branches
    between: Range
    origin: float

    @cached_property
    def parts(self) -> list[Piece]:
        """The parts of the branches, with the images of their ends."""
        parts = []
        for branch in self.branches.branches:
            low, high = max(branch.cuts[0], self.between[0]), min(branch.cuts[-1], self.between[1])
            ends = _inside(low, high)
            images = [x + self.branches.impact(x).time for x in ends]
            parts.append(Piece(ends, (images[0], images[1])))
        return parts

    def _along(self, phases: Floats, now: Clock) -> Floats:
        """Return about minus the derivative of the gap in the phase at a fixed image."""
        start = self.system.launched(phases)
        along: Floats = now.mass_sin / start.eta * launch_acceleration(start)
        return along

    def inverse(self, index: int, images: Floats, turns: Whole) -> Floats:
        """Return about the phases of a branch with these images: there the gap is monotone."""
        low, high = (np.full(len(images), end) for end in self.parts[index].phases)
        sign = -1 if self.parts[index].images[0] < self.parts[index].images[1] else 1
        for count in range(_HALVINGS + _NEWTON):
            middle = (low + high) / 2
            now = reduced_clock(self.system, middle, images, turns)
            height = gap(self.system.launched(middle), now)
            if count >= _HALVINGS:
                step = height / self._along(middle, now)
                low = high = np.clip(middle + step, low.min(initial=9), high.max(initial=-9))
                continue
            below = sign * height > 0
            low, high = np.where(below, middle, low), np.where(below, high, middle)
        return low

    def density(self, cuts: Cutting) -> Density:
        """Guess bounds of 1/|f'| on the cells between cuts, from the values at their ends."""
        start = self.system.launched(cuts.phases)
        now = reduced_clock(self.system, cuts.phases, cuts.images, cuts.turns)
        with np.errstate(all="ignore"):
            first = inverse_slope(start, now)
            bent = inverse_bend(start, now, first) * np.sign(first)
        middle, spread = (bent[1:] + bent[:-1]) / 2, _WIDER * abs(np.diff(bent)) / 2
        return Density((abs(first[:-1]), abs(first[1:])), (middle - spread, middle + spread))

    def orbits(self) -> Cutting:
        """Return the ends of the branches, and some of their images, with their images."""
        starts = [end for part in self.parts for end in part.phases]
        rows: dict[float, tuple[int, float, int]] = {}
        for _ in range(_ONWARD + 1):
            onward = []
            for x in starts:
                index = next(
                    (
                        i
                        for i, each in enumerate(self.parts)
                        if each.phases[0] <= x <= each.phases[1]
                    ),
                    None,
                )
                if index is None or x in rows:
                    continue
                lifted_one = x + self.branches.impact(x).time
                turns = math.floor((lifted_one - self.origin) / math.tau)
                row = np.array(x), np.array(lifted_one - math.tau * turns), np.array(turns)
                image = float(polished(self.system, *row)[0])
                rows[x] = index, image, turns
                onward.append(image)
            starts = onward
        phases = np.array(list(rows))
        columns = [np.array(column) for column in zip(*rows.values(), strict=True)]
        return Cutting(phases, columns[0], columns[1], columns[2])


def reduced_clock(system: System, phases: Floats, images: Floats, turns: Whole) -> Clock:
    """Return the time functions at images counted from so many turns, which are reduced exactly."""
    eta, time = system.eta, images - phases
    share = (turns * eta.numerator % eta.denominator) / eta.denominator
    mass = float(eta) * time + math.tau * share
    return Clock(np.sin(mass), np.cos(mass), np.sin(time), np.cos(time))


def polished(system: System, phases: Floats, images: Floats, turns: Whole) -> tuple[Floats, Floats]:
    """Return the images of phases by Newton's method, near the given ones, and gap' there."""
    start = system.launched(phases)
    for _ in range(3):
        now = reduced_clock(system, phases, images, turns)
        fall = gap(start, now, 1)
        images = images - gap(start, now) / fall
    return images, fall


def _last(function: Callable[[float], float], low: float, high: float) -> float:
    """Return about the end of the phases from `low` towards `high` where a function is < 0."""
    grid = [low + (high - low) * i / 400 for i in range(1, 401)]
    outside = next((x for x in grid if function(x) >= 0), high)
    inside = outside - (high - low) / 400
    for _ in range(60):
        middle = (inside + outside) / 2
        inside, outside = (middle, outside) if function(middle) < 0 else (inside, middle)
    return inside
