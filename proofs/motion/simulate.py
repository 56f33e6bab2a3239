"""Flights in floating point, plastic or with restitution: candidates and observations, no evidence.

Impacts are located to rounding error. Chatter is cut off as Lemma 2 of
`s34_circle.persistence` allows: where the table pushes and a rebound is weaker than 1e-6, the
mass is at rest there, and leaves at the separation phase. From then on its motion is the stable one
of claim G7.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from proofs.motion.system import System
from proofs.trusted.equations import (
    Clock,
    Launch,
    arrival,
    clock,
    closing,
    gap,
    launch_acceleration,
    return_map_derivative,
    slope,
)

WEAKEST = 1e-6  # a rebound that counts as none where the table pushes; its height is 1e-12
NO_PUSH = 1e-12  # a launch acceleration that is no more than rounding above 0
CLOSE = 1e-13  # relative, of the time of an impact
TURNS = 200
HORIZON = 1000.0  # of flights


class Impact(NamedTuple):
    """The impact after a launch: how long the flight takes, and phase + time on the line."""

    time: float
    lifted: float
    start: Launch
    now: Clock
    epsilon: float = 0.0

    @property
    def phase(self) -> float:
        """The phase, in [0, 2 pi)."""
        return self.lifted % math.tau

    @property
    def slope(self) -> float:
        """The slope f' of the plastic map."""
        return float(slope(self.start, self.now))

    @property
    def speed(self) -> float:
        """The relative velocity before the impact."""
        return max(-float(gap(self.start, self.now, 1)), 0.0)

    @property
    def velocity(self) -> float:
        """The velocity gamma before the impact."""
        return float(arrival(self.start, self.now)[1])

    @property
    def derivative(self) -> Any:
        """The rows of DF."""
        return return_map_derivative(self.start, self.now, self.epsilon)


def landing(
    system: System, epsilon: float, phase: float, gamma: float, horizon: float = HORIZON
) -> Impact | None:
    """Return about the next impact after one with velocity gamma.

    None where the mass would come from inside the table, sticks, or flies on.
    """
    speed = system.side * closing(system.launched(phase), gamma)
    impact = next_impact(system, phase, horizon, epsilon * speed) if speed >= 0 else None
    return impact and impact._replace(epsilon=epsilon)


def next_impact(
    system: System, phase: float, horizon: float = HORIZON, kick: float = 0.0
) -> Impact | None:
    """Return about the impact after a rebound with relative velocity kick >= 0; 0: after a plastic
    one. None if the mass sticks, or there is none up to the horizon.

    The gap is positive as long as the launch acceleration a is along the flight, and eta t < pi: it
    is (kick sin(eta t) + int_0^t sin(eta (t - s)) a(phase + s) ds) / eta. Then see `marched`.
    """
    eta, nu = float(system.eta), float(system.nu)
    start = system.launched(phase)
    acceleration = launch_acceleration(start)
    if kick:
        start = start._replace(kick=system.side * kick)
    bend = abs(nu) + eta * math.hypot(eta * (1 + start.lift), abs(start.rate) + kick)
    time = kick / bend
    if acceleration >= NO_PUSH:
        time = max(time, min(pull_ends(system, phase), 3 / eta))
    impact = marched(start, bend, time, horizon) if time > 0 else None
    return impact and Impact(impact[0], phase + impact[0], start, impact[1])


def marched(
    start: Launch,
    bend: float,
    time: float,
    horizon: float,
    *,
    level: float = 0.0,
    close: float = CLOSE,
) -> tuple[float, Clock] | None:
    """Return about the first zero of the gap after a time at which it is positive, None if none.

    By steps that cannot pass a zero: with |gap''| <= m = bend the gap stays positive for
    (v + sqrt(v^2 + 2 m gap)) / m, v = gap'. Near an impact they are Newton's, and end where they
    are at rounding level: the gap, or the step beside the time.
    """
    while time < horizon:
        now = clock(start.eta, time)
        height, speed = gap(start, now), gap(start, now, 1)
        step = (speed + math.sqrt(max(speed * speed + 2 * bend * height, 0.0))) / bend
        if height <= level or step < close * time:
            return time, now
        time += step
    return None


def pull_ends(system: System, phase: float) -> float:
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
