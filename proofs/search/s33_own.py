"""Rectangles at parameters of one's own: from the horseshoe of the plastic map, epsilon growing.

Candidates in floating point: `ReboundProver` proves or discards them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction

from proofs.motion.simulate import next_impact
from proofs.motion.system import System
from proofs.search.s33_rectangles import Sets
from proofs.search.shifts import Symbol, families, rounded_out
from proofs.search.shifts import cells as plastic_cells
from proofs.trusted.equations import arrival, clock, closing, launch_with_restitution
from proofs.trusted.numbers import Range

_SPARES = (0.05, 0.02, 0.01, 0.005, 0.002, 0.001)  # by how much edges overshoot, from the most
_STEPS = 4  # of epsilon, from 0
_ROUNDS = 12  # until the edges and the velocities settle
_CUTS, _CLOSE = 45, 1e-11  # until the image of an edge is so close
_BLIND = 8  # cuts, until images on both sides are seen
_SAMPLES = 9
_FARTHEST = 400.0  # the longest flight
_ROOM = 0.2  # of the velocities' range, kept around the images
Floats = tuple[float, float]


@dataclass(frozen=True)
class _Map:
    """F at one oscillator: images on the line, and velocities; None where the mass sticks."""

    system: System
    epsilon: float

    def image(self, phase: float, gamma: float) -> Floats | None:
        """Return about the next phase, not reduced, and velocity."""
        eta, nu = float(self.system.eta), float(self.system.nu)
        start = launch_with_restitution(
            self.system.side, eta, nu, phase, epsilon=self.epsilon, gamma=gamma
        )
        speed = self.system.side * closing(start, gamma)
        found = (
            next_impact(self.system, phase, self.epsilon * speed, _FARTHEST) if speed >= 0 else None
        )
        if found is None or found[0] == 0:
            return None
        return phase + found[0], arrival(start, clock(eta, found[0]))[1]

    def edge(self, phase: float, gammas: Floats, worst: int) -> float | None:
        """Return about the least (worst = 0) or the greatest (1) image of a vertical edge."""
        images = [self.image(phase, gamma) for gamma in gammas]
        known = [each[0] for each in images if each is not None]
        return sorted(known)[-worst] if len(known) == len(images) else None

    def velocities(self, sets: list[Floats], gammas: Floats) -> Floats | None:
        """Return about the range of velocities after impacts in rectangles, with room around."""
        shares = [k / _SAMPLES for k in range(_SAMPLES + 1)]
        grid = [low + (high - low) * share for low, high in sets for share in shares]
        images = [self.image(phase, gamma) for phase in grid for gamma in gammas]
        known = [each[1] for each in images if each is not None]
        if len(known) < len(images):
            return None
        least, most = min(known), max(known)
        low, high = least - _ROOM * (most - least), most + _ROOM * (most - least)
        eta, nu = float(self.system.eta), float(self.system.nu)
        at_rest = [-nu * math.cos(phase) / eta for phase in grid]
        if self.system.side < 0:  # beyond, the mass would come from inside the table
            high = min(high, (most + min(at_rest)) / 2)
        else:
            low = max(low, (least + max(at_rest)) / 2)
        return (low, high) if low < least and most < high else None


def rectangles(
    system: System, epsilon: Fraction, symbols: list[Symbol]
) -> Iterator[tuple[Sets, Range]]:
    """Yield two sets of phases, and velocities, on which F seems to be a full shift."""
    for family in families(symbols, 2):
        for spare in _SPARES:
            start = plastic_cells(family, spare)
            found = start and _grown(system, float(epsilon), family, start, spare)
            if found:
                (left, right), gammas = found
                unit = 10.0 ** -math.ceil(2 - math.log10(gammas[1] - gammas[0]))
                ends = math.floor(gammas[0] / unit), math.ceil(gammas[1] / unit)
                low, high = (Fraction(end) * Fraction(str(unit)) for end in ends)
                first, second = rounded_out([left, right], spare)
                yield (first, second), (low, high)


def _grown(
    system: System, epsilon: float, family: list[Symbol], sets: list[Floats], spare: float
) -> tuple[list[Floats], Floats] | None:
    """Follow sets from epsilon = 0, edges and velocities adjusted; None if they are lost."""
    plastic = _Map(system, 0.0)
    ways = []
    for low, high in sets:
        images = [plastic.image(low + (high - low) * share, 0.0) for share in (0.25, 0.5, 0.75)]
        first, found, last = (None if each is None else each[0] for each in images)
        if first is None or found is None or last is None:
            return None
        turns = round((found - (sets[0][0] + sets[1][1]) / 2) / math.tau)
        ways.append((math.tau * turns, last < first))
    gammas = plastic.velocities(sets, (0.0,) * 2)
    for step in range(1, _STEPS + 1):
        moving = _Map(system, epsilon * step / _STEPS)
        for _ in range(_ROUNDS):
            if gammas is None:
                return None
            outer = sets[0][0] - spare, sets[1][1] + spare
            moved = [
                _edges(moving, ends, gammas, (outer[0] + x, outer[1] + x), falls)
                for ends, (x, falls) in zip(sets, ways, strict=True)
            ]
            known = [ends for ends in moved if ends is not None]
            if len(known) < len(moved) or known[0][1] >= known[1][0]:
                return None
            before, sets = sets, known
            gammas = moving.velocities(sets, gammas)
            if max(math.dist(a, b) for a, b in zip(before, sets, strict=True)) < spare / 50:
                break
    return None if gammas is None else (sets, gammas)


def _edges(
    moving: _Map, ends: Floats, gammas: Floats, target: Floats, falls: bool
) -> Floats | None:
    """Move both ends of a set to where the whole edge is mapped to the ends of a target."""
    width = ends[1] - ends[0]
    goals = (target[0], 1, falls), (target[1], 0, falls)
    first, last = reversed(goals) if falls else goals
    low = _moved(moving, ends[0], width, gammas, first)
    high = _moved(moving, ends[1], width, gammas, last)
    return None if low is None or high is None or low >= high else (low, high)


def _moved(
    moving: _Map, end: float, width: float, gammas: Floats, goal: tuple[float, int, bool]
) -> float | None:
    """Return about the phase near an end whose edge has this image at worst."""
    image, worst, falls = goal
    way = -1 if falls else 1
    low, high = end - width / 3, end + width / 3
    below, above, kept = None, None, 0
    for cut in range(_CUTS):
        if below is None or above is None:
            if cut > _BLIND:
                return None
            middle = (low + high) / 2
        else:  # regula falsi, Illinois: an end that stays twice counts half
            middle = high - above * (high - low) / (above - below)
        found = moving.edge(middle, gammas, worst)
        if found is None:
            return None
        value = way * (found - image)
        if abs(value) < _CLOSE:
            return middle
        if value < 0:
            above = above and above / (2 if kept > 0 else 1)
            low, below, kept = middle, value, 1
        else:
            below = below and below / (2 if kept < 0 else 1)
            high, above, kept = middle, value, -1
    return low
