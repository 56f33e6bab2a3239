"""The impact map in floating point at many phases and oscillators at once: candidates only."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from proofs.motion.system import System
from proofs.trusted.equations import Clock, Launch, gap, launch_acceleration, slope

Floats = NDArray[np.float64]
_MOST_STEPS = 3000


class Impacts(NamedTuple):
    """Times of flight, images phi + t on the line, slopes; NaN where there is no next impact."""

    times: Floats
    images: Floats
    slopes: Floats


def float_launch(system: System, phases: Floats) -> Launch:
    """Return launches in floating point: for candidates, never evidence."""
    return _launch(system.side, float(system.eta), float(system.nu), phases)


def float_clock(system: System, times: Floats) -> Clock:
    """Return the functions of time in floating point, likewise."""
    return _clock(float(system.eta), times)


def _launch(side: int, eta: Any, nu: Any, phases: Floats) -> Launch:
    return Launch(side, eta, nu * np.sin(phases), nu * np.cos(phases))


def _clock(eta: Any, times: Floats) -> Clock:
    mass = eta * times
    return Clock(np.sin(mass), np.cos(mass), np.sin(times), np.cos(times))


def float_gap(side: int, eta: Any, nu: Any, phases: Any, times: Any) -> Floats:
    """Return about the gap at times after launches; arrays broadcast."""
    heights: Floats = gap(_launch(side, eta, nu, phases), _clock(eta, times))
    return heights


def next_impacts(side: int, eta: Any, nu: Any, phases: Any, horizon: float) -> Impacts:
    """Return about the next impacts, as `candidate.next_impact` finds them; arrays broadcast."""
    eta, nu, phases = (np.asarray(x, float) for x in np.broadcast_arrays(eta, nu, phases))
    shape = phases.shape
    eta, nu, phases = eta.ravel(), nu.ravel(), phases.ravel()
    start = _launch(side, eta, nu, phases)
    push = launch_acceleration(start)
    bend = np.abs(nu) + eta * np.hypot(eta * (1 + start.lift), start.rate)
    rounding = np.maximum(1e-13, 1e-15 * (2 + 2 * np.abs(nu) + np.abs(start.rate) / eta))
    times = np.minimum(1.0, push / (2 * (np.abs(nu) + eta * bend)))
    hits, slopes = np.full(eta.size, math.nan), np.full(eta.size, math.nan)
    left = np.flatnonzero(push > 0)
    for _ in range(_MOST_STEPS):
        if not left.size:
            break
        here = Launch(side, eta[left], start.lift[left], start.rate[left])
        now = _clock(here.eta, times[left])
        height, speed = gap(here, now), gap(here, now, 1)
        met = height < rounding[left]
        if met.any():
            hits[left[met]] = times[left[met]]
            with np.errstate(all="ignore"):
                slopes[left[met]] = slope(here, now)[met]
        ahead, speed, height = left[~met], speed[~met], height[~met]
        times[ahead] += (speed + np.sqrt(speed**2 + 2 * bend[ahead] * height)) / bend[ahead]
        left = ahead[times[ahead] < horizon]
    return Impacts(*(x.reshape(shape) for x in (hits, phases + hits, slopes)))
