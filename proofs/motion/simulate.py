"""Motions with restitution in floating point: observations, never evidence.

Impacts are located to rounding error. Chatter is cut off as Lemma 2 of
`s34_circle.persistence` allows: where the table pushes and a rebound is weaker than 1e-6, the
mass is at rest there, and leaves at the separation phase. From then on its motion is the stable one
of claim G7.
"""

from __future__ import annotations

import math
import random
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from statistics import mean, median

from proofs.motion.system import System
from proofs.trusted.equations import Clock, Launch, clock, gap, launch, launch_acceleration

_WEAKEST = 1e-6  # a rebound that counts as none where the table pushes; its height is 1e-12
_NO_PUSH = 1e-12  # a launch acceleration that is no more than rounding above 0
_CLOSE = 1e-13  # relative, of the time of an impact
EPSILONS = tuple(Fraction(k, 20) for k in range(8))
TURNS = 200
INITIAL_STATES = 500


@dataclass(frozen=True)
class Transient:
    """From an impact to the first rest: turns of the table, flights longer than a turn, impacts.

    Impacts count down to rebounds of 1e-6. rests: False where the time ran out.
    """

    rests: bool
    turns: float
    long_flights: int
    impacts: int


@dataclass(frozen=True)
class Summary:
    """The transients of some initial conditions at one epsilon; those that ran out count in full.

    rested: the share that came to rest in the time simulated.
    """

    epsilon: str
    rested: float
    mean_turns: float
    median_turns: float


def next_impact(
    system: System, phase: float, kick: float, horizon: float
) -> tuple[float, float] | None:
    """Return about (time, speed) of the impact after a rebound with relative velocity kick >= 0.

    None if there is none up to the horizon. The gap is positive as long as the launch acceleration
    a is along the flight, and eta t < pi: it is (kick sin(eta t) + int_0^t sin(eta (t - s))
    a(phase + s) ds) / eta. Then by steps that cannot pass a zero: with |gap''| <= m the gap stays
    positive for (v + sqrt(v^2 + 2 m gap)) / m, v = gap'. Near an impact they are Newton's, and
    end where they are at rounding level.
    """
    eta, nu = float(system.eta), float(system.nu)
    start = launch(system.side, eta, nu, phase)
    acceleration = launch_acceleration(start)
    start = start._replace(kick=system.side * kick)
    bend = abs(nu) + eta * math.hypot(eta * (1 + start.lift), abs(start.rate) + kick)
    time = kick / bend
    if acceleration >= _NO_PUSH:
        time = max(time, min(_pull_ends(system, phase), 3 / eta))
    while time < horizon:
        height, speed = _state(start, clock(eta, time))
        step = (speed + math.sqrt(max(speed * speed + 2 * bend * height, 0.0))) / bend
        if height <= 0 or step < _CLOSE * time:
            return time, max(-speed, 0.0)
        time += step
    return None


def _pull_ends(system: System, phase: float) -> float:
    """Return the time until the launch acceleration, positive now, vanishes; inf if it never does.

    It falls through 0 where the sine is the paper's and the cosine has the sign of eta - 1.
    """
    sine = system.separation_sine
    if sine is None or system.sticking_arc != "some":
        return math.inf
    root = math.asin(float(sine))
    return ((math.pi - root if system.eta < 1 else root) - phase) % math.tau


def _state(start: Launch, now: Clock) -> tuple[float, float]:
    return gap(start, now), gap(start, now, 1)


def transient(
    system: System, epsilon: float, phase: float, speed: float, turns: float = TURNS
) -> Transient:
    """Follow the motion after an impact at this phase and relative speed until the mass rests."""
    time, kick = 0.0, epsilon * speed
    long_flights = impacts = 0
    while True:
        here = (phase + time) % math.tau
        start = launch(system.side, float(system.eta), float(system.nu), here)
        if kick < _WEAKEST and launch_acceleration(start) < _NO_PUSH:
            return Transient(True, time / math.tau, long_flights, impacts)
        found = next_impact(system, here, kick, math.tau * turns - time)
        if found is None:
            return Transient(False, turns, long_flights, impacts)
        flight, speed = found
        time, kick = time + flight, epsilon * speed
        long_flights += flight > math.tau
        impacts += 1


def late_state(
    system: System, epsilon: float, phase: float, speed: float, impacts: int
) -> tuple[float, float] | None:
    """Return the phase and speed so many impacts later, None if the mass rests or flies on."""
    for _ in range(impacts):
        kick = epsilon * speed
        start = launch(system.side, float(system.eta), float(system.nu), phase)
        if kick < _WEAKEST and launch_acceleration(start) < _NO_PUSH:
            return None
        found = next_impact(system, phase, kick, math.tau * TURNS)
        if found is None:
            return None
        phase, speed = (phase + found[0]) % math.tau, found[1]
    return phase, speed


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
    rows = []
    for epsilon in epsilons:
        found = [transient(system, float(epsilon), *state, turns) for state in states]
        rows.append(
            Summary(
                str(float(epsilon)),
                mean(one.rests for one in found),
                mean(one.turns for one in found),
                median(one.turns for one in found),
            )
        )
    return rows
