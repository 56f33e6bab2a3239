"""Section 3.4: the entropy of f from both sides. Claim G17.

The circle is cut at the phases after which the mass grazes the table, where f jumps. A graph of
what the pieces are mapped into at most bounds from above what covering graphs bound from below.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from itertools import pairwise

from intervals import Undecided
from proofs.methods.subshifts import least_ceiling, outer_tower
from proofs.motion.impact import HORIZON
from proofs.motion.system import System
from proofs.motion.windows import BITS, Candidates
from proofs.search.evidence import FAILED, Evidence, Proof
from proofs.search.s34_absorbing import Partition, after_reversal
from proofs.search.s34_chaos import Branches, prove_covering
from proofs.search.s34_circle import prove_arc, prove_longest
from proofs.search.steps import Prover
from proofs.trusted.certificate import texts
from proofs.trusted.equations import clock, gap, launch
from proofs.trusted.flights import Motion
from proofs.trusted.numbers import Phases, Range
from proofs.trusted.paper.s34_circle.entropy import Branch, EntropyBound
from proofs.trusted.paper.s34_circle.grazing import Grazing, graze
from proofs.trusted.paper.s34_circle.landing import Lands, NeverImpacts
from proofs.trusted.paper.s34_circle.laps import EntropyRange, OuterGraph, entropy_range
from proofs.trusted.paper.s34_circle.pieces import Pieces
from proofs.trusted.parameters import Parameters

_GRID = 1200
_OUTSIDE = 1e-5  # how far outside of the phases that do not lead to the arc branches begin
_DEPTHS = 3, 4  # of the towers of states, from below and from above
_PLACES = 8  # of the ends of states
_LONGEST = 0.01  # time after a graze in which the gap is proved to rise
_SPARE = 1e-8  # of times
_MOST_TURNS = 20_000
_NEWTON = 20  # steps


def prove(
    of: Parameters,
    claims: Sequence[str],
    *,
    digits: int = 30,
    tell: Callable[[str], None] = lambda stage: None,
) -> Evidence:
    """Prove what the claims asked for rest on, as far as it goes."""
    prover = Prover(System(of.eta, of.nu), digits, HORIZON)
    evidence = Evidence(prover.steps, {claim: [] for claim in claims})
    if "G17" in claims:
        tell("where f jumps, and what its pieces lead to")
        try:
            with prover.undone():
                evidence.proofs["G17"] = prove_entropy_range(prover)
        except FAILED as failure:
            evidence.notes["G17"] = str(failure)
    return evidence


def prove_entropy_range(prover: Prover, depths: tuple[int, int] = _DEPTHS) -> Proof:
    """Prove lower and upper bounds of the entropy (rules covering-graph, itinerary-graph)."""
    laps = Laps.cut(prover)
    lower = prove_covering(prover, laps.found, depths[0])
    if not lower:
        raise Undecided("no orbits are seen to stay on the branches")
    return [laps.bound(lower[0], depths[1])]


@dataclass
class Laps:
    """The circle, cut where f jumps; `name`: the step `pieces`."""

    prover: Prover
    found: Branches
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
        found = Branches(system, Candidates(system, system.eta.denominator - 1))
        for ends in found.candidates.runs(low - _OUTSIDE, high + _OUTSIDE, _GRID):
            found.prove(prover, *ends)
        after = {one: after_reversal(system, one) for one in found.branches}
        names = dict(zip(found.branches, found.names, strict=True))
        parts: list[Branch | NeverImpacts] = [*found.branches, silent]
        between = pairwise(sorted(parts, key=lambda each: each.phases))
        grazes = [prove_grazing(prover, found, *pair) for pair in between]
        pieces = Pieces(
            arc[1],
            (Lands(prover.at, landing.cells[0].phases), Lands(prover.at, landing.cells[1].phases)),
            tuple(sorted([*after, silent, *(g for _, g in grazes)], key=lambda x: x.phases)),
        )
        witness = {
            "separation": arc[0],
            "lands": landing.entries["lands"],
            "branches": [{"branch": names[x], "after": str(after[x])} for x in after],
            "grazings": [name for name, _ in grazes],
            "never": [never],
        }
        return cls(prover, found, prover.add("pieces", witness), pieces)

    def bound(self, lower: tuple[str, EntropyBound], depth: int) -> tuple[str, EntropyRange]:
        """Record the step `itinerary-graph`, the growth rounded up."""
        region = self.pieces.region
        used: dict[Fraction, int] = {}

        def known(phase: Fraction) -> Range:
            used[phase] = index = self.found.on(phase)
            return self.found.image(index, phase)

        @cache
        def images(state: Range) -> list[Range]:
            found = (piece.image(state, known) for piece in self.pieces.monotone)
            cut = ((max(x[0], region[0]), min(x[1], region[1])) for x in found if x is not None)
            return [x for x in cut if x[0] <= x[1]]

        states = outer_tower((region[0], region[1]), images, depth, _PLACES)
        ceiling = least_ceiling(states, images)
        growth = -Fraction(-ceiling.growth * 10**4 // 1, 10**4)
        weights = [Fraction(each) for each in ceiling.vector]
        found = entropy_range(
            self.pieces, lower[1], known, OuterGraph(ceiling.states, weights, growth)
        )
        times = [
            {"phase": str(phase), "time": texts(self.found.times[index, phase])}
            for phase, index in sorted(used.items())
        ]
        witness = {
            "pieces": self.name,
            "lower": lower[0],
            "images": times,
            "states": [texts(state) for state in ceiling.states],
            "weights": texts(weights),
            "growth": str(growth),
        }
        return self.prover.add("itinerary-graph", witness), found


# -- grazes ----------------------------------------------------------------------------------------


def prove_grazing(
    prover: Prover, found: Branches, left: Branch | NeverImpacts, right: Branch | NeverImpacts
) -> tuple[str, Grazing]:
    """Prove that f jumps once, at a graze, between two neighbours (rule grazing)."""
    system, phases = prover.system, Phases(left.phases[1], right.phases[0])
    never = system.eta.denominator
    one, two = (x.turn if isinstance(x, Branch) else never for x in (left, right))
    turns = min(one, two), max(one, two)
    near, far = map(float, phases if one < two else phases[::-1])
    width = float(phases[1] - phases[0])
    impact = found.impact(near)
    time = _zero(system, near, impact.time, 1)
    reversal = round(time * float(system.eta) / math.tau) * math.tau / float(system.eta)
    around = 8 * width + _SPARE
    rise = min(_LONGEST, abs(time - reversal) / 2)
    before = impact.time - (time - impact.time) / 2 - around
    times = [Fraction(t) for t in (before, time - around, time + around, time + rise)]
    landing = None
    if turns[1] != never:
        later = found.impact(far)
        spare = 2 * (1 + abs(later.slope)) * width + _SPARE
        arrival = _zero(system, far, later.time, 0)
        landing = Fraction(arrival - spare), Fraction(arrival + spare)
    motion = Motion(system.eta, system.nu, phases, BITS)
    witness = {
        "phases": texts(phases),
        "turn": str(turns[0]),
        "times": texts(times),
        "beyond": str(turns[1]),
        "landing": None if landing is None else texts(landing),
    }
    return prover.add("grazing", witness), graze(motion, prover.at, turns, times, landing)


def _zero(system: System, phase: float, time: float, order: int) -> float:
    """Return about where a derivative of the gap is 0, near a time, by Newton's method."""
    start = launch(system.side, float(system.eta), float(system.nu), phase)
    for _ in range(_NEWTON):
        now = clock(float(system.eta), time)
        time -= gap(start, now, order) / gap(start, now, order + 1)
    return time
