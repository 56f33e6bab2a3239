"""Rectangles that move with epsilon, on which a full shift may be proved: candidates only."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from itertools import pairwise, product
from typing import NamedTuple

from proofs.motion.simulate import next_impact
from proofs.motion.system import System
from proofs.trusted.equations import (
    arrival,
    clock,
    closing,
    launch_with_restitution,
    return_map_derivative,
)

_HORIZON = 1000.0
_SWEEPS = 24
_SAMPLES = 5  # of a rectangle, along its phases
_STEP = 0.02  # the most that an edge moves at once
_SAME_FLIGHT = 2.0  # flights of one branch differ by less, those of two by more
_CLOSE = 2e-4  # edges and velocities do not move any more
_SLACK, _LEAST_SLACK = 0.2, 0.005  # beside images: of their height, and at least

Pair = tuple[float, float]


class Landing(NamedTuple):
    """F and DF at a state: the phase on the line, the velocity, rows of DF; the time of flight."""

    phase: float
    velocity: float
    derivative: tuple[Pair, Pair]
    time: float


def landing(system: System, epsilon: float, state: Pair, near: float) -> Landing | None:
    """Return about F and DF, the phase near the one given; None if it sticks or flies on."""
    eta, nu, (phase, gamma) = float(system.eta), float(system.nu), state
    start = launch_with_restitution(system.side, eta, nu, phase, epsilon=epsilon, gamma=gamma)
    speed = system.side * closing(start, gamma)
    found = next_impact(system, phase, epsilon * speed, _HORIZON) if speed >= 0 else None
    if not found or found[0] == 0:
        return None
    now = clock(eta, found[0])
    turned = phase + found[0] + math.tau * round((near - phase - found[0]) / math.tau)
    derivative = return_map_derivative(start, now, epsilon)
    return Landing(turned, arrival(start, now)[1], derivative, found[0])


@dataclass(frozen=True)
class Moving:
    """Phases and velocities of rectangles for a range of epsilon, V1 and V2 by turns.

    Two, or four: those for the states after V1, then those after V2. flights: how long flights
    from each about are. axis: dgamma / dphi of images, as nearly as one number says it.
    """

    epsilon: Pair
    phases: tuple[Pair, ...]
    velocities: tuple[Pair, ...]
    flights: tuple[float, ...]
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
        )

    def cuts(self, index: int) -> list[float]:
        """Return phases that divide a rectangle."""
        low, high = self.phases[index]
        return [low + (high - low) * k / (_SAMPLES - 1) for k in range(_SAMPLES)]


def first_guess(system: System, sets: tuple[Pair, Pair]) -> Moving | None:
    """Return two sets of phases with the velocities and flights that plastic impacts have there."""
    forward = system.side * abs(float(system.nu)) / float(system.eta)  # meets the table anywhere
    found = [landing(system, 0.0, (sum(each) / 2, forward), sets[0][0]) for each in sets]
    if None in found:
        return None
    known = [each for each in found if each is not None]
    gammas = [each.velocity for each in known]
    common = min(gammas) - 0.03, max(gammas) + 0.03
    return Moving((0.0, 0.0), sets, (common, common), tuple(each.time for each in known))


def settled(system: System, guess: Moving, margin: float) -> Moving | None:
    """Move edges until they overshoot what follows by the margin, velocities until they hold the
    images; None where that fails: a flight grazes.
    """
    now = guess
    for sweep in range(_SWEEPS):
        phases = [_edges(system, now, k, margin) for k in range(len(now.phases))]
        moved = [
            max(abs(a - b) for a, b in zip(one, two, strict=True))
            for one, two in zip(now.phases, phases, strict=True)
            if two is not None
        ]
        if len(moved) < len(phases):
            return None
        now = replace(now, phases=tuple(x for x in phases if x is not None))
        if any(low >= high for low, high in now.phases):
            return None
        if sweep % 4 == 3 or max(moved) < _CLOSE:
            found = _heights(system, now)
            if found is None:
                return None
            pairs = zip(now.velocities, found.velocities, strict=True)
            grown = max(max(abs(a - b) for a, b in zip(*pair, strict=True)) for pair in pairs)
            now = found
            if max(grown, *moved) < _CLOSE:
                return now
    return None


def _edges(system: System, now: Moving, index: int, margin: float) -> Pair | None:
    """Move both edges of a rectangle by a step of Newton's method."""
    left, right = (now.phases[k] for k in now.following(index))
    targets = (left[0] - margin, max), (right[1] + margin, min)
    edges = []
    for edge, (target, extreme) in zip(now.phases[index], targets, strict=True):
        moved = edge
        for _ in range(4):  # back from where flights graze
            images = [
                landing(system, epsilon, (moved, gamma), target)
                for epsilon, gamma in now.corners(index)
            ]
            known = [x for x in images if x and abs(x.time - now.flights[index]) < _SAME_FLIGHT]
            if len(known) == len(images):
                break
            moved = moved * 0.75 + sum(now.phases[index]) / 2 * 0.25
        else:
            return None
        image = extreme(known, key=lambda each: each.phase)
        step = (target - image.phase) / image.derivative[0][0]
        edges.append(moved + min(_STEP, max(-_STEP, step)))
    return edges[0], edges[1]


def _heights(system: System, now: Moving) -> Moving | None:
    """Return the rectangles with velocities that hold the images of those before, and an axis."""
    speeds: list[list[float]] = [[] for _ in now.phases]
    ratios = []
    for index in range(len(now.phases)):
        rows = []
        for phi in now.cuts(index):
            images = [
                landing(system, epsilon, (phi, gamma), now.phases[0][0])
                for epsilon, gamma in now.corners(index)
            ]
            rows.append([x for x in images if x])
            if len(rows[-1]) < len(images):
                return None
        ratios += [x.derivative[1][0] / x.derivative[0][0] for row in rows for x in row]
        for one, two in pairwise(rows):
            part = [*one, *two]
            reach = min(x.phase for x in part), max(x.phase for x in part)
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
    grown = tuple((low - s, high + s) for (low, high), s in zip(bounds, slack, strict=True))
    return replace(now, velocities=grown, axis=(min(ratios) + max(ratios)) / 2)
