"""How long motions with restitution take until the mass rests: many at a time, simulated.

Chatter is cut off, and impacts are found, as in `simulate`: observations, never evidence.
"""

from __future__ import annotations

import math
import random
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from statistics import median

import numpy as np
from numpy.typing import NDArray

from proofs.motion.many import Floats, next_impacts
from proofs.motion.simulate import NO_PUSH, TURNS, WEAKEST
from proofs.motion.system import System
from proofs.trusted.equations import launch_acceleration

EPSILONS = tuple(Fraction(k, 20) for k in range(8))
INITIAL_STATES = 500
FASTEST = 0.4
Flags = NDArray[np.bool_]


@dataclass(frozen=True)
class Summary:
    """The transients of some initial conditions at one epsilon; those that ran out count in full.

    rested: the share that came to rest in the time simulated.
    """

    epsilon: str
    rested: float
    mean_turns: float
    median_turns: float


GOING, RESTS, FLIES, TOUCHES = 0, -1, -2, -3


class Motions:
    """Motions from impacts at these phases and speeds before them, and what has become of each.

    epsilons: one, or one for each; until: the time after which none is followed. kinds: the period
    of the stable orbit that it has come to, or one of the four numbers above; counts: of the
    impacts that were followed; times: of the last ones.
    """

    def __init__(
        self,
        system: System,
        epsilons: Floats | float,
        states: Sequence[tuple[float, float]] | Floats,
        until: float = math.inf,
    ):
        self._system, self._epsilons, self._until = system, epsilons, until
        self.phases, self.speeds = np.array(states, float).T
        self.kinds, self.counts = (np.full(len(self.phases), GOING) for _ in range(2))
        self.times = np.zeros(len(self.phases))

    def follow(self, impacts: int = sys.maxsize) -> None:
        """Go on with those that have no end yet."""
        system = self._system
        for _ in range(impacts):
            going = np.flatnonzero(self.kinds == GOING)
            if not going.size:
                return
            phases, kicks = self.phases[going], (self._epsilons * self.speeds)[going]
            push = launch_acceleration(system.launched(phases))
            still = (kicks < WEAKEST) & (push < NO_PUSH)
            horizons = np.minimum(math.tau * TURNS, self._until - self.times[going]) * ~still
            where = system.side, float(system.eta), float(system.nu), phases
            impact = next_impacts(*where, horizons, kicks=kicks)
            hit = np.isfinite(impact.times)
            self.kinds[going] = np.where(still, RESTS, np.where(hit, GOING, FLIES))
            on = going[hit]
            self.phases[on], self.speeds[on] = impact.images[hit] % math.tau, impact.speeds[hit]
            self.times[on] += impact.times[hit]
            self.counts[on] += 1

    def find_cycles(self, longest: int, near: float) -> None:
        """Name the periods of those that are back where they are now after so many impacts."""
        phases, speeds = self.phases.copy(), self.speeds.copy()
        for period in range(1, longest + 1):
            self.follow(1)
            soft = (self.speeds < WEAKEST) & (speeds < WEAKEST)
            same = soft | (abs(self.speeds - speeds) <= near * speeds)
            back = (self.kinds == GOING) & same & (abs(self.phases - phases) < near)
            self.kinds[back] = np.where(soft[back], TOUCHES, period)


def until_rest(
    system: System, epsilons: Floats, phases: Floats, speeds: Floats, turns: float = TURNS
) -> tuple[Flags, Floats]:
    """Follow motions after impacts at these phases and relative speeds until the mass rests.

    Return which come to rest within so many turns of the table, and after how many; else `turns`.
    """
    motions = Motions(system, epsilons, np.transpose([phases, speeds]), math.tau * turns)
    motions.follow()
    rests = motions.kinds == RESTS
    return rests, np.where(rests, motions.times / math.tau, turns)


def random_impacts(count: int) -> list[tuple[float, float]]:
    """Return phases, uniform on the circle, and relative speeds, uniform up to `FASTEST`."""
    generator = random.Random(1)
    return [(generator.uniform(0, math.tau), generator.uniform(0, FASTEST)) for _ in range(count)]


def transients(system: System) -> list[Summary]:
    """Summarise, for each of some epsilon, the transients of the same random initial conditions."""
    states = zip(*random_impacts(INITIAL_STATES), strict=True)
    phases, speeds = (np.tile(each, len(EPSILONS)) for each in states)
    every = np.repeat([float(epsilon) for epsilon in EPSILONS], INITIAL_STATES)
    rows = (each.reshape(-1, INITIAL_STATES) for each in until_rest(system, every, phases, speeds))
    return [
        Summary(str(float(epsilon)), *(float(x) for x in (rests.mean(), last.mean(), median(last))))
        for epsilon, rests, last in zip(EPSILONS, *rows, strict=True)
    ]
