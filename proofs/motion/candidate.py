"""The impact map in floating point: a candidate finder, never evidence."""

from __future__ import annotations

import math

from proofs.motion.system import System
from proofs.trusted.equations import clock, gap, launch, launch_acceleration, slope


def next_impact(
    system: System, phase: float, horizon: float = 1000.0
) -> tuple[float, float, float] | None:
    """Return about (flight time, f(phase) mod 2 pi, f'(phase)); None if it sticks or flies on.

    Steps that cannot pass a zero: with |gap''| <= m the gap stays positive for
    (v + sqrt(v^2 + 2 m gap)) / m, v = gap'. Ends where the gap is at rounding level.
    """
    eta, nu = float(system.eta), float(system.nu)
    start = launch(system.side, eta, nu, phase)
    acceleration = launch_acceleration(start)
    if acceleration <= 0:
        return None
    bend = abs(nu) + eta * math.hypot(eta * (1 + start.lift), start.rate)
    rounding = 1e-15 * (2 + 2 * abs(nu) + abs(start.rate) / eta)
    time = min(1.0, acceleration / (2 * (abs(nu) + eta * bend)))
    while time < horizon:
        now = clock(eta, time)
        height, speed = gap(start, now), gap(start, now, 1)
        if height < max(1e-13, rounding):
            return time, (phase + time) % math.tau, slope(start, now)
        time += (speed + math.sqrt(speed * speed + 2 * bend * height)) / bend
    return None
