"""Rectangles that move with epsilon, on which a full shift may be proved: candidates only."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from itertools import pairwise, product

from proofs.motion.simulate import Impact, landing
from proofs.motion.system import System

_SWEEPS = 24
_STEPS = 4  # of epsilon, from 0
_SAMPLES = 5  # of a rectangle, along its phases
_STEP = 0.02  # the most that an edge moves at once
_SAME_FLIGHT = 2.0  # flights of one branch differ by less, those of two by more
_CLOSE = 2e-4  # edges and velocities do not move any more
_SLACK, _LEAST_SLACK = 0.2, 0.005  # beside images: of their height, and at least

Pair = tuple[float, float]


@dataclass(frozen=True)
class Moving:
    """Phases and velocities of rectangles for a range of epsilon, V1 and V2 by turns.

    Two, or four: those for the states after V1, then those after V2. flights: how long flights
    from each about are; falls: whether later phases are sent to earlier ones.
    axis: dgamma / dphi of images, as nearly as one number says it.
    """

    epsilon: Pair
    phases: tuple[Pair, ...]
    velocities: tuple[Pair, ...]
    flights: tuple[float, ...]
    falls: tuple[bool, ...]
    axis: float = 0.0

    def following(self, index: int) -> tuple[int, int]:
        """Return which rectangles the images of one should cross."""
        return (0, 1) if len(self.phases) == 2 or index % 2 == 0 else (2, 3)

    def corners(self, index: int) -> list[Pair]:
        """Return the extreme epsilons and velocities of a rectangle."""
        return list(product(self.epsilon, self.velocities[index]))

    def split(self) -> Moving:
        """Return four rectangles in the place of two."""
        return replace(
            self,
            phases=self.phases * 2,
            velocities=self.velocities * 2,
            flights=self.flights * 2,
            falls=self.falls * 2,
        )

    def cuts(self, index: int) -> list[float]:
        """Return phases that divide a rectangle."""
        low, high = self.phases[index]
        return [low + (high - low) * k / (_SAMPLES - 1) for k in range(_SAMPLES)]


def first_guess(system: System, sets: tuple[Pair, Pair]) -> Moving | None:
    """Return two sets of phases with the velocities and flights that plastic impacts have there."""
    forward = system.side * abs(float(system.nu)) / float(system.eta)  # meets the table anywhere
    landings = [landing(system, 0.0, sum(each) / 2, forward) for each in sets]
    certain = [each for each in landings if each is not None]
    if len(certain) < len(landings):
        return None
    gammas = [each.velocity for each in certain]
    common = min(gammas) - 0.03, max(gammas) + 0.03
    times, falls = zip(*((x.time, x.derivative[0][0] < 0) for x in certain), strict=True)
    return Moving((0.0, 0.0), sets, (common, common), times, falls)


def grown(system: System, epsilon: float, sets: tuple[Pair, Pair], margin: float) -> Moving | None:
    """Follow two sets of a plastic horseshoe from epsilon = 0 on; None if they are lost."""
    now = first_guess(system, sets)
    for step in range(1, _STEPS + 1):
        at = epsilon * step / _STEPS
        now = now and settled(system, replace(now, epsilon=(at, at)), margin)
    return now


def settled(system: System, guess: Moving, margin: float) -> Moving | None:
    """Move edges until they overshoot what follows by the margin, velocities until they hold the
    images; None where that fails: a flight grazes.
    """
    now, close = guess, min(_CLOSE, margin / 20)
    for sweep in range(_SWEEPS):
        phases = [_edges(system, now, k, margin) for k in range(len(now.phases))]
        moved = [
            max(abs(a - b) for a, b in zip(before, after, strict=True))
            for before, after in zip(now.phases, phases, strict=True)
            if after is not None
        ]
        if len(moved) < len(phases):
            return None
        now = replace(now, phases=tuple(x for x in phases if x is not None))
        if any(low >= high for low, high in now.phases):
            return None
        if sweep % 4 == 3 or max(moved) < close:
            raised = _heights(system, now)
            if raised is None:
                return None
            pairs = zip(now.velocities, raised.velocities, strict=True)
            grown = max(max(abs(a - b) for a, b in zip(*pair, strict=True)) for pair in pairs)
            now = raised
            if max(grown, *moved) < close:
                return now
    return None


def _edges(system: System, now: Moving, index: int, margin: float) -> Pair | None:
    """Move both edges of a rectangle by a step of Newton's method."""
    left, right = (now.phases[k] for k in now.following(index))
    targets = (left[0] - margin, max), (right[1] + margin, min)
    edges = []
    goals = reversed(targets) if now.falls[index] else targets
    for edge, (target, extreme) in zip(now.phases[index], goals, strict=True):
        images = [landing(system, epsilon, edge, gamma) for epsilon, gamma in now.corners(index)]
        nearby = [x for x in images if x and abs(x.time - now.flights[index]) < _SAME_FLIGHT]
        if len(nearby) < len(images):
            return None  # a flight grazes
        image = extreme(nearby, key=lambda each: _near(each, target))
        step = (target - _near(image, target)) / image.derivative[0][0]
        edges.append(edge + min(_STEP, max(-_STEP, step)))
    return edges[0], edges[1]


def _near(image: Impact, phase: float) -> float:
    """Return the phase of an image on the line, next to another."""
    return image.lifted + math.tau * round((phase - image.lifted) / math.tau)


def _heights(system: System, now: Moving) -> Moving | None:
    """Return the rectangles with velocities that hold the images of those before, and an axis."""
    speeds: list[list[float]] = [[] for _ in now.phases]
    ratios = []
    for index in range(len(now.phases)):
        rows = []
        for phi in now.cuts(index):
            images = [landing(system, epsilon, phi, gamma) for epsilon, gamma in now.corners(index)]
            rows.append([x for x in images if x])
            if len(rows[-1]) < len(images):
                return None
        ratios += [x.derivative[1][0] / x.derivative[0][0] for row in rows for x in row]
        for left, right in pairwise(rows):
            part = [*left, *right]
            phases = [_near(x, now.phases[0][0]) for x in part]
            reach = min(phases), max(phases)
            for k in now.following(index):
                low, high = now.phases[k]
                if reach[0] <= high and reach[1] >= low:
                    speeds[k] += [x.velocity for x in part]
    if not all(speeds):
        return None
    if len(speeds) == 2:
        speeds = [speeds[0] + speeds[1]] * 2
    bounds = [(min(each), max(each)) for each in speeds]
    slack = [_SLACK * (high - low) + _LEAST_SLACK for low, high in bounds]
    grown = [(low - s, high + s) for (low, high), s in zip(bounds, slack, strict=True)]
    edge = min if system.side < 0 else max
    at_rest = edge(
        -float(system.nu) * math.cos(x) / float(system.eta) for y in now.phases for x in y
    )
    for k, (low, high) in enumerate(bounds):  # beyond, the mass would come from inside the table
        if system.side < 0:
            grown[k] = grown[k][0], min(grown[k][1], (high + at_rest) / 2)
        else:
            grown[k] = max(grown[k][0], (low + at_rest) / 2), grown[k][1]
        if not grown[k][0] < low <= high < grown[k][1]:
            return None
    return replace(now, velocities=tuple(grown), axis=(min(ratios) + max(ratios)) / 2)
