"""What floating point sees of points at random under a map: where they settle, and how they end."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from functools import partial
from math import e
from typing import NamedTuple

import numpy as np

from proofs.methods.newton import FAR, Cycle, cycles, distance, seeds, whole_periods
from proofs.methods.sampling import Floats, Sampled
from proofs.trusted.numbers import Range

_FOLLOWED, _CLOSE = 30, 1e-3  # points of an attractor
_SETTLING, _BRIEFLY = 150, 50  # steps, and those of flows
_NEUTRAL = 1e-6  # so much less than 1 are multipliers of an attracting orbit
_ANGLES = (("2*pi", 2 * np.pi), ("1", 1.0))  # periods that a variable may have, not being given


class Followed(NamedTuple):
    """Where points at random are after many steps, a column each, and how many ended, and why.

    orbits: those attracting ones, up to a period, that they come to.
    """

    points: Floats
    ends: Counter[str]
    steps: int
    orbits: list[Cycle]


@np.errstate(all="ignore")
def followed(sampled: Sampled, box: Sequence[Range], longest: int) -> Followed:
    """Follow points at random in a box, and look at periods up to the longest."""
    x, ends = seeds(sampled, box, _FOLLOWED, 0)[:, :_FOLLOWED], Counter[str]()
    steps = _BRIEFLY if sampled.has_flows else _SETTLING
    for _ in range(steps):
        after = sampled.reduced(sampled(x))
        goes_on = np.isfinite(after).all(axis=0) & (np.abs(after) < FAR).all(axis=0)
        ends.update(map(partial(_end, sampled), x.T[~goes_on], after.T[~goes_on]))
        x = after[:, goes_on]
    return Followed(x, ends, steps, _attractors(sampled, x, longest))


def _end(sampled: Sampled, point: Floats, image: Floats) -> str:
    """Say why a point has no image, or goes far away."""
    if np.isfinite(image).all():
        return f"beyond {FAR:g}"
    *parts, last = sampled.parts
    for part in parts:
        image = Sampled(part, sampled.shares)(point[:, None])[:, 0]
        if not np.isfinite(image).all():
            return sampled.undefined(part, point[:, None])
        point = image
    return sampled.undefined(last, point[:, None])


@np.errstate(all="ignore")
def _attractors(sampled: Sampled, x: Floats, longest: int) -> list[Cycle]:
    """Return the attracting periodic orbits, up to a period, that settled points come to."""
    orbits: list[Cycle] = []
    after = x
    for period in range(1, longest + 1):
        after = sampled(after)
        apart = after - x - whole_periods(sampled, (after - x).T).T
        near = (np.abs(apart) < _CLOSE * (1 + np.abs(x))).all(axis=0)
        seen = cycles(sampled, period, x[:, near])
        orbits += [each for each in seen if each.multipliers[-1] < 1 - _NEUTRAL]
        x, after = x[:, ~near], after[:, ~near]
    return orbits


@np.errstate(all="ignore")
def fates(sampled: Sampled, box: Sequence[Range], way: Followed, longest: int) -> list[str]:
    """Say what becomes of points at random in a box, which were followed."""
    points, ends, steps, orbits = way
    place = ", ".join(
        f"{name} in [{float(low):.6g}, {float(high):.6g}]"
        for name, (low, high) in zip(sampled.map.variables, box, strict=True)
    )
    lines = [
        f"of {_FOLLOWED} points at random, {place}, {points.shape[1]} are followed for "
        f"{steps} steps"
    ]
    lines += [f"{count} end before: {why}" for why, count in ends.most_common()]
    near = [{k for k, each in enumerate(orbits) if _comes_to(sampled, x, each)} for x in points.T]
    for k, cycle in enumerate(orbits):
        if count := sum(k in each for each in near):
            start = ", ".join(f"{value:.6g}" for value in cycle.points[0])
            lines.append(
                f"{count} come to an orbit of period {len(cycle.points)} through ({start})"
            )
    if others := sum(not each for each in near):
        lines.append(f"{others} come to no attracting orbit of a period up to {longest}")
    return [*lines, *_angles(sampled, seeds(sampled, box, _FOLLOWED, 0))]


def _comes_to(sampled: Sampled, point: Floats, cycle: Cycle) -> bool:
    return bool((distance(sampled, point, cycle.points) < _CLOSE).any())


def _angles(sampled: Sampled, x: Floats) -> list[str]:
    """Say which variables without a period could have one, from points at random."""
    lines, after = [], sampled(x)
    x, after = (each[:, np.isfinite(after).all(axis=0)] for each in (x, after))
    for k, name in enumerate(sampled.map.variables):
        if np.isfinite(sampled.periods[k]) or not x.size:
            continue

        def has(period: float, k: int = k) -> bool:
            return _respects(sampled, x, after, k, period)

        for text, period in _ANGLES:
            if has(period) and not has(period / e):
                lines.append(f"{name} may be an angle: give it the period {text}")
                break
    return lines


def _respects(sampled: Sampled, x: Floats, after: Floats, k: int, period: float) -> bool:
    """Whether a variable may have a period: with it added images are the same, but for turns."""
    turned = np.array(x)
    turned[k] += period
    change = (sampled(turned) - after) / period
    change[k] -= np.round(change[k, 0])  # so many whole ones at all points
    return bool((np.abs(change) < _NEUTRAL).all())
