"""The circle cut where f jumps: grazes between branches, and graphs of what leads where.

The circle is cut at the phases after which the mass grazes the table, where f jumps. A graph of
what the pieces are mapped into at most bounds from above what covering graphs bound from below.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cache
from itertools import pairwise

from intervals import Undecided
from proofs.methods.subshifts import least_ceiling, outer_tower
from proofs.motion.landing import zero
from proofs.motion.system import System
from proofs.motion.windows import Candidates
from proofs.search.s34_absorbing import Partition, after_reversal
from proofs.search.s34_chaos import Branches
from proofs.search.s34_circle import prove_arc, prove_longest
from proofs.search.steps import Prover
from proofs.trusted.certificate import texts
from proofs.trusted.flights import Motion
from proofs.trusted.kernel.coverings import EntropyBound
from proofs.trusted.numbers import Phases, Range
from proofs.trusted.paper.branches import Branch
from proofs.trusted.paper.s34_circle.grazing import Grazing
from proofs.trusted.paper.s34_circle.landing import NeverImpacts
from proofs.trusted.paper.s34_circle.laps import EntropyRange
from proofs.trusted.paper.s34_circle.pieces import Pieces

_GRID = 1200
_OUTSIDE = 1e-5  # how far outside of the phases that do not lead to the arc branches begin
_PLACES = 8  # of the ends of states
_LONGEST = Fraction(1, 100)  # time after a graze in which the gap is proved to rise
_SPARE = Fraction(1, 10**8)  # of times
_MOST_TURNS = 20_000
FINE = 160  # bits of Newton's method


@dataclass
class Laps:
    """The circle, cut where f jumps; `name`: the step `pieces`."""

    prover: Prover
    branches: Branches
    name: str
    pieces: Pieces

    @classmethod
    def cut(cls, prover: Prover) -> Laps:
        """Prove what leads to the sticking arc, branches, grazes, and what never impacts."""
        system = prover.system
        if not (-1 < system.nu < 0 < system.eta < 1 and system.eta.denominator <= _MOST_TURNS):
            raise Undecided("windows of flights are known for -1 < nu < 0 < eta = p/q < 1 only")
        arc = prove_arc(prover)
        landing = Partition(prover, arc)
        low, high = map(float, landing.prove_lands())
        never, silent = prove_longest(prover)
        proved = Branches(system, Candidates(system, system.eta.denominator - 1))
        for ends in proved.candidates.runs(low - _OUTSIDE, high + _OUTSIDE, _GRID):
            proved.prove(prover, *ends)
        parts: list[Branch | NeverImpacts] = [*proved.branches, silent]
        between = pairwise(sorted(parts, key=lambda each: each.phases))
        grazes = [prove_grazing(prover, proved, *pair) for pair in between]
        witness = {
            "separation": arc[0],
            "lands": landing.entries["lands"],
            "branches": [
                {"branch": name, "after": str(after_reversal(system, branch))}
                for name, branch in zip(proved.names, proved.branches, strict=True)
            ],
            "grazings": [name for name, _ in grazes],
            "never": [never],
        }
        return cls(prover, proved, *prover.derive("pieces", witness))

    def bound(self, lower: tuple[str, EntropyBound], depth: int) -> tuple[str, EntropyRange]:
        """Record the step `itinerary-graph`, the growth rounded up."""
        region = self.pieces.region
        proved = Images(self.branches)

        @cache
        def images(state: Range) -> list[Range]:
            parts = (piece.image(state, proved) for piece in self.pieces.monotone)
            cut = ((max(x[0], region[0]), min(x[1], region[1])) for x in parts if x is not None)
            return [x for x in cut if x[0] <= x[1]]

        states = outer_tower((region[0], region[1]), images, depth, _PLACES)
        ceiling = least_ceiling(states, images)
        growth = -Fraction(-ceiling.growth * 10**4 // 1, 10**4)
        witness = {
            "pieces": self.name,
            "lower": lower[0],
            "images": proved.witness(),
            "states": [texts(state) for state in ceiling.states],
            "weights": list(map(str, ceiling.vector)),
            "growth": str(growth),
        }
        return self.prover.derive("itinerary-graph", witness)


@dataclass
class Images:
    """The images of phases on branches, proved when they are asked for, with brackets."""

    branches: Branches
    used: dict[Fraction, int] = field(default_factory=dict)

    def __call__(self, phase: Fraction) -> Range:
        """Prove and return an image."""
        if phase not in self.used:
            self.used[phase] = self.branches.on(phase)
        return self.branches.image(self.used[phase], phase)

    def witness(self) -> list[dict[str, object]]:
        """Return the phases and brackets."""
        return [self.bracket(phase) for phase in sorted(self.used)]

    def bracket(self, phase: Fraction) -> dict[str, object]:
        """Return a phase and its bracket."""
        return self.branches.bracket(self.used[phase], phase)


# -- grazes ----------------------------------------------------------------------------------------


def prove_grazing(
    prover: Prover, branches: Branches, left: Branch | NeverImpacts, right: Branch | NeverImpacts
) -> tuple[str, Grazing]:
    """Prove that f jumps once, at a graze, between two neighbours (rule grazing)."""
    phases, never = Phases(left.phases[1], right.phases[0]), prover.system.eta.denominator
    before_turn, two = (x.turn if isinstance(x, Branch) else never for x in (left, right))
    turns = min(before_turn, two), max(before_turn, two)
    near, far = phases if before_turn < two else phases[::-1]
    width, impact = phases[1] - phases[0], branches.impact(float(near))
    time = zero(flight(prover, near), Fraction(impact.time), 1)
    around = 8 * width + _SPARE
    before = (time - Fraction(impact.time)) * 3 / 2 + around
    times = [time + x for x in (-before, -around, around, rise(prover.system, time))]
    landing = None
    if turns[1] != never:
        later = branches.impact(float(far))
        spare = 2 * (1 + Fraction(abs(later.slope))) * width + _SPARE
        arrival = zero(flight(prover, far), Fraction(later.time), 0)
        landing = arrival - spare, arrival + spare
    return record(prover, phases, turns, times, landing)


def record(
    prover: Prover,
    phases: Phases,
    turns: tuple[int, int],
    times: Sequence[Fraction],
    landing: Range | None,
) -> tuple[str, Grazing]:
    """Prove and record a step `grazing`."""
    witness = {
        "phases": texts(phases),
        "turn": str(turns[0]),
        "times": texts(list(times)),
        "beyond": str(turns[1]),
        "landing": None if landing is None else texts(landing),
    }
    return prover.derive("grazing", witness)


def rise(system: System, time: Fraction) -> Fraction:
    """Return for how long after a graze the gap is looked at: sin(eta t) keeps its sign."""
    turn = Fraction(math.tau) / system.eta
    return min(_LONGEST, abs(time - round(time / turn) * turn) / 2)


def flight(prover: Prover, phase: Fraction) -> Motion:
    """Return the flight from one phase, for Newton's method."""
    return Motion(prover.at, (phase, phase), FINE)
