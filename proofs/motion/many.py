"""Flights in floating point, many phases and oscillators at once: candidates only."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from proofs.motion.simulate import CLOSE, NO_PUSH
from proofs.trusted.equations import (
    Launch,
    clock,
    gap,
    launch,
    launch_acceleration,
    registered_sincos,
    slope,
)

Floats = NDArray[np.float64]


class Impacts(NamedTuple):
    """Times of flight, images phi + t on the line, slopes of the plastic map, relative speeds.

    NaN where there is no next impact.
    """

    times: Floats
    images: Floats
    slopes: Floats
    speeds: Floats


@registered_sincos.register
def _(x: np.ndarray) -> tuple[Floats, Floats]:
    return np.sin(x), np.cos(x)


def separation_phases(eta: Any, nu: Any) -> Floats:
    """Return about the phases at which a mass that sticks leaves the table, NaN where none is."""
    with np.errstate(all="ignore"):
        roots = np.arcsin(eta**2 / (nu * (1 - eta**2)))
    return np.asarray(np.where(eta < 1, roots, math.pi - roots))


def next_impacts(
    side: int, eta: Any, nu: Any, phases: Any, horizons: Any, *, kicks: Any = 0.0
) -> Impacts:
    """Return about the next impacts, as `simulate.next_impact` finds them; arrays broadcast."""
    given = np.broadcast_arrays(eta, nu, phases, horizons, kicks)
    eta, nu, phases, horizons, kicks = (np.asarray(x, float).ravel() for x in given)
    start = launch(side, eta, nu, phases)
    pull = (math.pi - separation_phases(eta, nu) - phases) % math.tau
    pull = np.fmin(pull, 3 / eta) * (launch_acceleration(start) >= NO_PUSH)
    start = start._replace(kick=side * kicks)
    bend = np.abs(nu) + eta * np.hypot(eta * (1 + start.lift), np.abs(start.rate) + kicks)
    times = np.maximum(kicks / bend, pull)
    hits, going = np.full(eta.size, math.nan), np.flatnonzero(times > 0)
    while (going := going[times[going] < horizons[going]]).size:
        here = Launch(side, *(np.asarray(x)[going] for x in start[1:]))
        now = clock(here.eta, times[going])
        height, speed, most = gap(here, now), gap(here, now, 1), bend[going]
        step = (speed + np.sqrt(np.maximum(speed * speed + 2 * most * height, 0.0))) / most
        hit = (height <= 0) | (step < CLOSE * times[going])
        hits[going[hit]] = times[going[hit]]
        times[going] += step
        going = going[~hit]
    now = clock(eta, hits)
    with np.errstate(all="ignore"):
        columns = hits, phases + hits, slope(start, now), np.maximum(-gap(start, now, 1), 0.0)
    return Impacts(*(np.reshape(x, given[0].shape) for x in columns))
