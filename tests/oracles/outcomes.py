"""Judges of what comes after a launch, by simulation: no impact, no flight, a graze."""

import numpy as np

from tests.once import EFFORT
from tests.oracles.flights import Simulation, system_of_record

LONG, SHORT = (20 if EFFORT.quick else 80), 1 / 200  # times
SLIP = 1e-10  # of the gaps


def _simulated(view):
    return Simulation(system_of_record(view.function))


def _states(view, rng, count=12):
    """Corners and random points of the box, a column each."""
    sides = [(float(low), float(high)) for low, high in view.box]
    shares = [[rng.choice((0, 1, rng.random())) for _ in sides] for _ in range(count)]
    return np.array(
        [[a + (b - a) * s for (a, b), s in zip(sides, x, strict=True)] for x in shares]
    ).T


def no_impact(view, rng):
    """Gaps are > 0 for a long time."""
    heights = _simulated(view).heights(_states(view, rng), LONG)
    return [] if heights.min() > -SLIP else [f"a gap of {heights.min():.3g} is seen"]


def pressed(view, rng):
    """A gap is < 0 soon."""
    heights = _simulated(view).heights(_states(view, rng), SHORT)
    most = heights.min(axis=(0, 1)).max()
    return [] if most < 0 else [f"all gaps are {most:.3g} at least, soon after launch"]


def graze(view, rng):
    """The least gap in the window, between the steps, is < 0 on one side, and > 0 on the other."""
    states = _states(view, rng, 2)
    states[:] = states[:, :1]
    states[view.axis] = [float(x) for x in view.box[view.axis]]
    low, high = map(float, view.time)
    gaps = _simulated(view).heights(states, high + 4 * SHORT)
    below, above = (0, 1) if view.rises else (1, 0)
    told = [] if gaps[: int(low / SHORT)].min() > 0 else ["a gap is < 0 before"]
    for side, sign in ((below, -1), (above, 1)):
        least, time = _least(gaps[:, 0, side], round((low + high) / 2 / SHORT) - 1)
        if sign * least < 0 or not low <= time <= high:
            told.append(f"on one side the gap is {least:.3g} at the least, at the time {time:.9g}")
    return told


def _least(gap, near):
    """The least value between some steps, by interpolation, and the time."""
    about = near + np.arange(-3, 4)
    curve = np.polynomial.Polynomial.fit(SHORT * (about + 1), gap[about], 6)
    times = [x.real for x in curve.deriv().roots() if abs(x.imag) < 1e-9]
    time = min(times, key=lambda t: abs(t - SHORT * (near + 1)))
    return curve(time), time
