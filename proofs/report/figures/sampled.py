"""The impact map in floating point, for the dots of figures: it proves nothing."""

from __future__ import annotations

import math

from proofs.motion.simulate import next_impact, separation_phase
from proofs.motion.system import System
from proofs.trusted.equations import launch, launch_acceleration

_HORIZON = 7000.0
_STEPS = 8


def image(system: System, phase: float) -> float | None:
    """Return f(phase), the separation phase where the mass sticks; None if there is no impact."""
    start = launch(system.side, float(system.eta), float(system.nu), phase)
    if launch_acceleration(start) < 0:
        return separation_phase(system) % math.tau
    impact = next_impact(system, phase, _HORIZON)
    return None if impact is None else impact.phase


def graph(system: System, first: float, last: float, count: int) -> list[tuple[float, float]]:
    """Return phases, evenly spaced, with their images, where there are some."""
    phases = [first + (last - first) * (k + 0.5) / count for k in range(count)]
    return [(phase, y) for phase in phases if (y := image(system, phase)) is not None]


def preimage(system: System, target: float, first: float, last: float) -> float:
    """Return the phase in [first, last], where f is steep, that f takes to the target: by Newton's
    method, from the middle.
    """
    phase = (first + last) / 2
    for _ in range(_STEPS):
        impact = next_impact(system, phase)
        if impact is None:
            break
        phase = min(max(phase - (impact.phase - target) / impact.slope, first), last)
    return phase
