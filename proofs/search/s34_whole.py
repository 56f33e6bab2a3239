"""Section 3.4: the chaos of the plastic map as a whole. Claims G17, G18 and H18.

G17: the entropy from both sides. G18: what expands, and which words occur. H18: square roots.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from types import MappingProxyType
from typing import Any

from intervals import Undecided
from proofs.motion.digits import middle
from proofs.motion.landing import NEWTON, short, zero
from proofs.motion.windows import Candidates
from proofs.search.evidence import FAILED, Evidence, Proof, search_each
from proofs.search.request import Request, proving
from proofs.search.s34_chaos import prove_covering
from proofs.search.s34_laps import FINE, Images, Laps, flight, record, rise
from proofs.search.steps import Prover
from proofs.trusted.certificate import texts
from proofs.trusted.equations import launch_acceleration
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.numbers import Phases, Range, hull
from proofs.trusted.paper.branches import Branch
from proofs.trusted.paper.s34_circle.cycles import Cycles, Outer, is_least, word_of
from proofs.trusted.paper.s34_circle.expansion import (
    BRACKET,
    Expansion,
    part,
)
from proofs.trusted.paper.s34_circle.grazing import Grazing
from proofs.trusted.paper.s34_circle.laps import EntropyRange
from proofs.trusted.paper.s34_circle.pieces import Piece
from proofs.trusted.paper.s34_circle.roots import ENDS

_DEPTHS = 3, 4  # of the towers of states, from below and from above
_SCALE, _RATE = Fraction(1, 7), Fraction(5, 4)  # of lengths above pi/2, and how they grow
_DEEPEST = 40  # halvings of a piece
_BRACKET_PLACES = 40  # binary, of a time in a bracket
_LONGEST, _RADIUS = 3, Fraction(1, 10**7)  # period of orbits, and how near they are
_SWEEPS, _STILL = 40, 1e-14
_ROOT_PLACES = 16  # of narrow grazes
_ROOT_TURNS, _ROOT_GRID, _BESIDE = 2000, 20, 0.005
_SOONER = Fraction(1, 10**6)  # than a narrow graze, impacts beside it


@proving
def prove(request: Request) -> Evidence:
    """Prove what the claims asked for rest on, as far as it goes."""
    prover = request.prover()
    evidence = Evidence(prover.steps, {claim: [] for claim in request.claims})
    return search_each(evidence, request.claims, _SEARCHES, request.tell, _Shared(prover))


@dataclass
class _Shared:
    """What several claims rest on, proved once."""

    prover: Prover

    @cached_property
    def laps(self) -> Laps:
        """The pieces."""
        return Laps.cut(self.prover)

    @cached_property
    def range(self) -> tuple[str, EntropyRange]:
        """Lower and upper bounds of the entropy (rules covering-graph, itinerary-graph)."""
        lower = prove_covering(self.prover, self.laps.branches, _DEPTHS[0])
        if not lower:
            raise Undecided("no orbits are seen to stay on the branches")
        return self.laps.bound(lower[0], _DEPTHS[1])


# -- expansion -------------------------------------------------------------------------------------


def prove_expansion(laps: Laps) -> tuple[str, Cycles]:
    """Prove that lengths grow, those of phases above pi/2 times a factor, and all periodic orbits
    up to a period (rule expansion).
    """
    pieces = laps.pieces
    scales = tuple(
        _SCALE if piece.phases[0] > Fraction(math.pi / 2) else Fraction(1)
        for piece in pieces.monotone
    )
    cutting = [
        _Cutting(laps, piece, scale, scales)
        for piece, scale in zip(pieces.monotone, scales, strict=True)
    ]
    for each in cutting:
        each.cut()
    witness = {
        "pieces": laps.name,
        "cells": [each.witness() for each in cutting],
        "scales": texts(scales),
        "rate": str(_RATE),
        **_orbits(laps, Expansion(pieces, scales, _RATE)),
    }
    return laps.prover.derive("expansion", witness)


@dataclass
class _Cutting:
    """Cuts of one piece, each with a time just before its impact."""

    laps: Laps
    piece: Piece
    scale: Fraction
    scales: Sequence[Fraction]
    times: dict[Fraction, Fraction] = field(default_factory=dict)

    def cut(self) -> None:
        """Cut the branch into parts on which f expands from piece to piece."""
        self._halve(*self.piece.branch.phases, _DEEPEST)

    def witness(self) -> dict[str, list[str]]:
        """Return the cuts and times."""
        cuts = sorted(self.times)
        return {"cuts": texts(cuts), "times": texts([self.times[cut] for cut in cuts])}

    def _halve(self, low: Fraction, high: Fraction, depth: int) -> None:
        if self._expands(low, high):
            return
        if depth == 0:
            raise Undecided("f is not seen to expand from piece to piece")
        half = round((low + high) / 2, 14)
        self._halve(low, half, depth - 1)
        self._halve(half, high, depth - 1)

    def _expands(self, low: Fraction, high: Fraction) -> bool:
        """Whether f expands between two phases."""
        try:
            image = hull([self._image(low), self._image(high)])
            bound, (first, last) = part(self.piece.branch, (low, high), image)
        except Unproved:
            return False
        targets = zip(self.laps.pieces.monotone, self.scales, strict=True)
        reached = [s for x, s in targets if x.phases[0] <= last and first <= x.phases[1]]
        return all(_RATE * bound * self.scale <= scale for scale in reached)

    def _image(self, phase: Fraction) -> Range:
        """Prove a bracket of the impact, and enclose the image."""
        if phase not in self.times:
            about = Fraction(self.laps.branches.impact(float(phase)).time)
            time = zero(flight(self.laps.prover, phase), about, 0) - BRACKET / 2
            self.times[phase] = short(time, _BRACKET_PLACES)
        time = self.times[phase]
        return self.piece.branch.image(phase, (time, time + BRACKET))


# -- periodic orbits -------------------------------------------------------------------------------


def _orbits(laps: Laps, expansion: Expansion) -> dict[str, Any]:
    """Return what the rule expansion reads about periodic orbits up to a period."""
    images, points = Images(laps.branches), Images(laps.branches)
    outer = Outer(expansion, images)
    alive = [
        word
        for length in range(1, _LONGEST + 1)
        for word, state in outer.words(length)
        if is_least(word) and not outer.dies(word, state)
    ]
    pieces = expansion.pieces.monotone
    orbits = []
    for word in alive:
        orbit = _cycle(laps, [pieces[i].branch for i in word])
        with suppress(*FAILED):
            if word_of(expansion, [(x, points(x)) for x in orbit], _RADIUS) == word:
                orbits.append(orbit)
    return {
        "orbits": [[points.bracket(x) for x in orbit] for orbit in orbits],
        "radius": str(_RADIUS),
        "longest": str(_LONGEST),
        "images": images.witness(),
    }


def _cycle(laps: Laps, branches: Sequence[Branch]) -> list[Fraction]:
    """Return about the phases of a periodic orbit through branches, by Newton's method."""
    ends = [(float(x.phases[0]), float(x.phases[1])) for x in branches]
    phases = [(low + high) / 2 for low, high in ends]
    for _ in range(_SWEEPS):
        before = list(phases)
        for k in reversed(range(len(phases))):
            seen = laps.branches.impact(phases[k])
            image = phases[k] + seen.time - math.tau * branches[k].turn
            moved = phases[k] + (phases[(k + 1) % len(phases)] - image) / seen.slope
            phases[k] = min(max(moved, ends[k][0]), ends[k][1])
        if max(abs(x - y) for x, y in zip(phases, before, strict=True)) < _STILL:
            break
    return [round(Fraction(phase), 14) for phase in phases]


# -- square roots ----------------------------------------------------------------------------------


def prove_roots(shared: _Shared) -> Proof:
    """Prove grazes narrowly, and the pieces between them."""
    roots = prove_grazes(shared.prover)
    with suppress(*FAILED):
        roots.append((shared.laps.name, shared.laps.pieces))
    return roots


def prove_grazes(prover: Prover) -> Proof:
    """Prove the grazes near the phases asked about, narrowly (rule grazing)."""
    if not -1 < prover.system.nu < 0:
        raise Undecided("windows of flights are known for -1 < nu < 0 only")
    candidates = Candidates(prover.system, _ROOT_TURNS)
    return [_prove_root(prover, candidates, float(end)) for end in ENDS]


def _prove_root(prover: Prover, candidates: Candidates, end: float) -> tuple[str, Grazing]:
    """Prove the graze after the shortest flight near a phase."""
    runs = candidates.runs(end - _BESIDE, end + _BESIDE, _ROOT_GRID)
    ends = [(low, high) for (_, low), (high, _) in pairwise(runs)]
    seen = {low: (candidates.impact(low), candidates.impact(high)) for low, high in ends}
    jumps = [(left, right, low) for low, (left, right) in seen.items() if left and right]
    if not jumps:
        raise Undecided("no graze is seen")
    left, right, low = min(jumps, key=lambda jump: min(jump[0].turn, jump[1].turn))
    first, later = (left, right) if left.turn < right.turn else (right, left)
    phase, time = _graze(prover, Fraction(low), Fraction(first.time))
    arrival = zero(flight(prover, phase), Fraction(later.time), 0)
    unit, centre = Fraction(1, 10**_ROOT_PLACES), round(phase, _ROOT_PLACES)
    wide = 1000 * unit
    times = [time - _SOONER, time - wide, time + wide, time + rise(prover.system, time)]
    around, turns = Phases(centre - unit, centre + unit), (first.turn, later.turn)
    return record(prover, around, turns, times, (arrival - wide, arrival + wide))


def _graze(prover: Prover, phase: Fraction, time: Fraction) -> tuple[Fraction, Fraction]:
    """Return about the phase and the time of a graze, by Newton's method.

    The least gap has the derivative -(sin(eta t) / eta) A in the phase, see `slope`.
    """
    for _ in range(NEWTON):
        motion = flight(prover, phase)
        time = zero(motion, time, 1)
        now, push = motion.clock((time, time)), launch_acceleration(motion.start)
        along = middle(now.mass_sin) / prover.system.eta * middle(push)
        step = middle(motion.gap_of((time, time), 0)) / along
        phase = round((phase + step) * 2**FINE) / Fraction(2**FINE)
    return phase, time


_SEARCHES: Mapping[str, tuple[str, Callable[[_Shared], Proof]]] = MappingProxyType(
    {
        "G17": ("where f jumps, and what its pieces lead to", lambda shared: [shared.range]),
        "G18": (
            "where f expands, and periodic orbits",
            lambda shared: [shared.range, prove_expansion(shared.laps)],
        ),
        "H18": ("square roots", prove_roots),
    }
)
