"""Motions with restitution in floating point: observations, never evidence.

Impacts are located to rounding error. Chatter is cut off as Lemma 2 of
`s34_circle.persistence` allows: where the table pushes and a rebound is weaker than 1e-6, the
mass is at rest there, and leaves at the separation phase. From then on its motion is the stable one
of claim G7.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from proofs.motion.system import System
from proofs.trusted.equations import (
    Clock,
    Launch,
    arrival,
    clock,
    closing,
    gap,
    launch,
    launch_acceleration,
    launch_with_restitution,
    return_map_derivative,
)

Number = Any  # a float, or an array of such
WEAKEST = 1e-6  # a rebound that counts as none where the table pushes; its height is 1e-12
NO_PUSH = 1e-12  # a launch acceleration that is no more than rounding above 0
CLOSE = 1e-13  # relative, of the time of an impact
TURNS = 200
HORIZON = 1000.0  # of flights


@dataclass(frozen=True)
class Landing:
    """The impact after one at a phase: how long the flight takes, and phase + time."""

    time: float
    phase: float
    start: Launch
    now: Clock
    epsilon: float

    @property
    def velocity(self) -> float:
        """The velocity before the impact."""
        return float(arrival(self.start, self.now)[1])

    @property
    def derivative(self) -> Any:
        """The rows of DF."""
        return return_map_derivative(self.start, self.now, self.epsilon)


def landing(
    system: System, epsilon: float, phase: float, gamma: float, horizon: float = HORIZON
) -> Landing | None:
    """Return about the next impact after one with velocity gamma.

    None where the mass would come from inside the table, sticks, or flies on.
    """
    eta, nu = float(system.eta), float(system.nu)
    start = launch_with_restitution(system.side, eta, nu, phase, epsilon=epsilon, gamma=gamma)
    speed = system.side * closing(start, gamma)
    flown = next_impact(system, phase, epsilon * speed, horizon) if speed >= 0 else None
    if not flown or not flown[0]:
        return None
    return Landing(flown[0], phase + flown[0], start, clock(eta, flown[0]), epsilon)


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
    if acceleration >= NO_PUSH:
        time = max(time, min(pull_ends(system, phase), 3 / eta))
    while time < horizon:
        height, speed = state_at(start, clock(eta, time))
        step = (speed + math.sqrt(max(speed * speed + 2 * bend * height, 0.0))) / bend
        if height <= 0 or step < CLOSE * time:
            return time, max(-speed, 0.0)
        time += step
    return None


def pull_ends(system: System, phase: Number) -> Number:
    """Return the time until the launch acceleration, positive now, vanishes; inf if it never does.

    It falls through 0 where the sine is the paper's and the cosine has the sign of eta - 1.
    """
    if system.sticking_arc != "some":
        return math.inf
    return (math.pi - separation_phase(system) - phase) % math.tau


def separation_phase(system: System) -> float:
    """Return about the phase at which a mass that sticks leaves the table, where there is one."""
    root = math.asin(float(system.separation_sine or 0))
    return root if system.eta < 1 else math.pi - root


def state_at(start: Launch, now: Clock) -> tuple[Number, Number]:
    """Return the gap and its rate."""
    return gap(start, now), gap(start, now, 1)
