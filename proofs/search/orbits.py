"""Orbits of the impact map in floating point, and the stable periodic ones that they come to.

Candidates only, never evidence.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from proofs.motion.simulate import next_impact
from proofs.motion.system import System
from proofs.trusted.equations import launch_acceleration

LONGEST = 60  # period
NEAR = 1e-7  # of an orbit to itself, in phase
_CLOSE, _EXACT, _STEPS = 1e-2, 1e-11, 20  # of Newton's method: where it begins, and ends
_TOUCH = 1e-4  # how exactly the time of a touch is found: the gap has a double zero there
STICKS, TOUCHES, FLIES = "sticks", "touches, no impact", "flies on"
RISES, FALLS = "rises", "falls"


class Seen(NamedTuple):
    """What becomes of a launch: the image, phase + time, and f'; both 0 where there is none."""

    phase: float
    kind: str
    image: float = 0.0
    slope: float = 0.0

    @property
    def goes_on(self) -> bool:
        """Whether there is an image."""
        return self.kind in (RISES, FALLS)


def look(system: System, phase: float, farthest: float) -> Seen:
    """Return what becomes of one launch, flights being followed so far."""
    impact = next_impact(system, phase, farthest)
    if impact is not None and abs(impact.time - math.tau * system.eta.denominator) < _TOUCH:
        return Seen(phase, TOUCHES)
    if impact is not None:
        slope = impact.slope
        return Seen(phase, RISES if slope > 0 else FALLS, impact.lifted, slope)
    return Seen(phase, STICKS if launch_acceleration(system.launched(phase)) <= 0 else FLIES)


def follow(system: System, phase: float, farthest: float, most: int) -> Iterator[Seen]:
    """Yield what becomes of the launches of an orbit, up to the first one without an image."""
    for _ in range(most):
        seen = look(system, phase, farthest)
        yield seen
        if not seen.goes_on:
            return
        phase = seen.image % math.tau


def stable_cycle(system: System, start: float, farthest: float) -> list[Seen]:
    """Return the stable periodic orbit that a phase is near, from there on; [] if it is near none.

    An orbit whose multiplier is near 1 or -1 is still away from it: Newton's method finds it.
    """
    orbit = [*follow(system, start, farthest, LONGEST)]
    for period, seen in enumerate(orbit, 1):
        if seen.goes_on and abs(math.remainder(seen.image - start, math.tau)) < _CLOSE:
            cycle = _nearest_cycle(system, start, farthest, period)
            if cycle and abs(multiplier(cycle)) < 1:
                return _nearest_cycle(system, cycle[0].phase, farthest, _least_period(cycle))
    return []


def _least_period(cycle: Sequence[Seen]) -> int:
    """Return after how many impacts a cycle first comes back."""
    misses = (abs(math.remainder(seen.image - cycle[0].phase, math.tau)) for seen in cycle)
    return next(k for k, miss in enumerate(misses, 1) if miss < NEAR)


def multiplier(cycle: Sequence[Seen]) -> float:
    """Return the product of the slopes."""
    return math.prod(seen.slope for seen in cycle)


def _nearest_cycle(system: System, phase: float, farthest: float, period: int) -> list[Seen]:
    for _ in range(_STEPS):
        orbit = [*follow(system, phase, farthest, period)]
        slope, miss = multiplier(orbit), math.remainder(orbit[-1].image - phase, math.tau)
        if len(orbit) < period or not orbit[-1].goes_on or slope == 1:
            return []
        if abs(miss) < _EXACT:
            return orbit
        phase = (phase + miss / (1 - slope)) % math.tau
    return []
