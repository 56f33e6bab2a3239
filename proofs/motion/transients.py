"""How long motions with restitution take until the mass rests: many at a time, simulated.

Chatter is cut off, and impacts are found, as in `simulate`: observations, never evidence.
"""

from __future__ import annotations

import math
import random
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from statistics import median

import numpy as np
from numpy.typing import NDArray

from proofs.motion.many import Floats, float_clock, float_launch
from proofs.motion.simulate import CLOSE, NO_PUSH, TURNS, WEAKEST, pull_ends, state_at
from proofs.motion.system import System
from proofs.trusted.equations import Launch, launch_acceleration

EPSILONS = tuple(Fraction(k, 20) for k in range(8))
INITIAL_STATES = 500
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


def next_impacts(
    system: System, phases: Floats, kicks: Floats, horizons: Floats
) -> tuple[Floats, Floats]:
    """Do `simulate.next_impact` for many rebounds; times are infinite where there is none."""
    start = float_launch(system, phases)
    pushed = launch_acceleration(start) >= NO_PUSH
    eta, kick = start.eta, system.side * kicks
    bend = np.hypot(eta * (1 + start.lift), abs(start.rate) + kicks) * eta + abs(float(system.nu))
    time, speed = kicks / bend, np.zeros(len(phases))
    pull = np.minimum(pull_ends(system, phases), 3 / eta)
    time = np.where(pushed, np.maximum(time, pull), time)
    going = np.arange(len(phases))
    while going.size:
        time[going[time[going] >= horizons[going]]] = np.inf
        going = going[np.isfinite(time[going])]
        lift, rate, push, most, now = (x[going] for x in (start.lift, start.rate, kick, bend, time))
        here = Launch(system.side, eta, lift, rate, push)
        height, rise = state_at(here, float_clock(system, now))
        step = (rise + np.sqrt(np.maximum(rise * rise + 2 * most * height, 0.0))) / most
        hit = (height <= 0) | (step < CLOSE * now)
        speed[going] = np.maximum(-rise, 0.0)
        time[going] += np.where(hit, 0.0, step)
        going = going[~hit]
    return time, speed


GOING, RESTS, FLIES, TOUCHES = 0, -1, -2, -3


class Motions:
    """Motions from impacts at these phases and speeds before them, and what has become of each.

    kinds: the period of the stable orbit that it has come to, or one of the four numbers above;
    counts: of the impacts that were followed.
    """

    def __init__(self, system: System, epsilon: float, states: Sequence[tuple[float, float]]):
        self._system, self._epsilon = system, epsilon
        self.phases, self.speeds = np.array(states, float).T
        self.kinds, self.counts = (np.full(len(states), GOING) for _ in range(2))

    def follow(self, impacts: int) -> None:
        """Go on with those that have no end yet."""
        for _ in range(impacts):
            going = np.flatnonzero(self.kinds == GOING)
            if not going.size:
                return
            phases, kicks = self.phases[going], self._epsilon * self.speeds[going]
            push = launch_acceleration(float_launch(self._system, phases))
            still = (kicks < WEAKEST) & (push < NO_PUSH)
            horizons = np.where(still, 0.0, math.tau * TURNS)
            times, speeds = next_impacts(self._system, phases, kicks, horizons)
            hit = np.isfinite(times)
            self.kinds[going] = np.where(still, RESTS, np.where(hit, GOING, FLIES))
            on = going[hit]
            self.phases[on], self.speeds[on] = (phases + times)[hit] % math.tau, speeds[hit]
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
    time, kicks = np.zeros(len(phases)), epsilons * speeds
    rests, going = np.zeros(len(phases), bool), np.arange(len(phases))
    while going.size:
        here = (phases[going] + time[going]) % math.tau
        push = launch_acceleration(float_launch(system, here))
        still = (kicks[going] < WEAKEST) & (push < NO_PUSH)
        rests[going[still]] = True
        going, here = going[~still], here[~still]
        flights, ends = next_impacts(system, here, kicks[going], math.tau * turns - time[going])
        time[going] += flights
        kicks[going] = epsilons[going] * ends
        going = going[np.isfinite(flights)]
    return rests, np.where(rests, time / math.tau, turns)


def transients(
    system: System,
    epsilons: Sequence[Fraction] = EPSILONS,
    count: int = INITIAL_STATES,
    *,
    fastest: float = 0.4,
    turns: float = TURNS,
    seed: int = 1,
) -> list[Summary]:
    """Summarise, for each epsilon, the transients of the same `count` random initial conditions.

    A state is an impact: its phase uniform on the circle, its relative speed before the impact
    uniform on [0, fastest].
    """
    generator = random.Random(seed)
    states = [(generator.uniform(0, math.tau), generator.uniform(0, fastest)) for _ in range(count)]
    phases, speeds = (np.tile(each, len(epsilons)) for each in zip(*states, strict=True))
    every = np.repeat([float(epsilon) for epsilon in epsilons], count)
    ends = until_rest(system, every, phases, speeds, turns)
    return [
        Summary(str(float(epsilon)), *(float(x) for x in (rests.mean(), last.mean(), median(last))))
        for epsilon, rests, last in zip(
            epsilons, *(each.reshape(-1, count) for each in ends), strict=True
        )
    ]
