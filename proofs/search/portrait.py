"""The impact map on the whole circle as floating point sees it: branches, and where orbits go.

Candidates only, never evidence: what is proved is said by conclusions, elsewhere.
"""

from __future__ import annotations

import math
import random
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

from proofs.motion.candidate import next_impact
from proofs.motion.simulate import late_state
from proofs.motion.system import System
from proofs.trusted.equations import launch, launch_acceleration

_NARROWEST = 1e-9  # to which the ends of branches are located
_MOST_ENDS = 400  # that are located; branches are infinitely many where flights are ever longer
_STEEP, _FLAT = 30.0, 1e-3  # |f'| at an end where f' is unbounded, or 0
_NEAR = 1e-7  # of an orbit to itself, in phase
_LONGEST = 60  # period
_TOUCH = 1e-4  # how exactly the time of a touch is found: the gap has a double zero there
STICKS, TOUCHES, FLIES = "sticks", "touches, no impact", "flies on"
RISES, FALLS = "rises", "falls"


Check = Callable[[], None]


class Seen(NamedTuple):
    """What becomes of a launch: the image, phase + time, and f'; both 0 where there is none."""

    phase: float
    kind: str
    image: float = 0.0
    slope: float = 0.0


@dataclass(frozen=True)
class Stretch:
    """Phases in a row with one fate: a monotone branch of f, or no impact, or the mass sticks."""

    points: tuple[Seen, ...]

    @property
    def kind(self) -> str:
        """What becomes of them."""
        return self.points[0].kind

    @property
    def width(self) -> float:
        """How long the interval is."""
        return self.points[-1].phase - self.points[0].phase


def look(system: System, phase: float, farthest: float) -> Seen:
    """Return what becomes of one launch, flights being followed so far."""
    found = next_impact(system, phase, farthest)
    if found is not None and abs(found[0] - math.tau * system.eta.denominator) < _TOUCH:
        return Seen(phase, TOUCHES)
    if found is not None:
        return Seen(phase, RISES if found[2] > 0 else FALLS, phase + found[0], found[2])
    start = launch(system.side, float(system.eta), float(system.nu), phase)
    return Seen(phase, STICKS if launch_acceleration(start) <= 0 else FLIES)


def stretches(
    system: System, grid: int, farthest: float, check: Check = lambda: None
) -> list[Stretch]:
    """Cut the circle into stretches, from a grid of phases and what lies where they differ.

    check: is called at every phase, to end the work by an exception.
    """
    budget, points = [_MOST_ENDS], []
    for k in range(grid):
        check()
        points.append(look(system, math.tau * (k + 0.5) / grid, farthest))
    runs = [[points[0]]]
    for one, two in pairwise(points):
        check()
        for left, right in _breaks(system, one, two, farthest, budget):
            if left is not runs[-1][-1]:
                runs[-1].append(left)
            runs.append([right])
        if two is not runs[-1][-1]:
            runs[-1].append(two)
    return [Stretch(tuple(run)) for run in runs]


def _breaks(
    system: System, one: Seen, two: Seen, farthest: float, budget: list[int]
) -> Iterator[tuple[Seen, Seen]]:
    """Yield the neighbouring phases, between two, at which a stretch ends and another begins."""
    if continues(one, two):
        return
    width = two.phase - one.phase
    if width < _NARROWEST or budget[0] <= 0:
        budget[0] -= 1
        yield one, two
        return
    middle = look(system, (one.phase + two.phase) / 2, farthest)
    yield from _breaks(system, one, middle, farthest, budget)
    yield from _breaks(system, middle, two, farthest, budget)


def continues(one: Seen, two: Seen) -> bool:
    """Whether the second of two neighbours is on the stretch of the first, by the slopes."""
    if one.kind != two.kind:
        return False
    expected = (one.slope + two.slope) / 2 * (two.phase - one.phase)
    return abs(two.image - one.image - expected) < 0.3 * abs(expected) + 1e-3


# -- where orbits go -------------------------------------------------------------------------------


_NAMES = {
    STICKS: "the mass sticks",
    TOUCHES: "it only touches the table, again and again",
    FLIES: "no impact is seen so far",
}


_WANDERS = "no end of it: they wander"


@dataclass(frozen=True)
class Fate:
    """What a share of the orbits that were followed comes to; impacts: the most until then."""

    name: str
    share: float
    impacts: int


def fates(
    system: System, starts: int, impacts: int, farthest: float, check: Check = lambda: None
) -> list[Fate]:
    """Follow orbits of phases all around the circle, and count what they come to."""
    ends: dict[str, list[int]] = {}
    for k in range(starts):
        phase, count = math.tau * (k + 0.5) / starts, 0
        while count < impacts:
            check()
            seen = look(system, phase, farthest)
            if seen.kind not in (RISES, FALLS):
                break
            phase, count = seen.image % math.tau, count + 1
        name = _NAMES.get(seen.kind) or _cycle_name(system, phase, farthest)
        ends.setdefault(name, []).append(count)
    counted = sorted(ends.items(), key=lambda item: -len(item[1]))
    return [Fate(name, len(counts) / starts, max(counts)) for name, counts in counted]


def _cycle_name(system: System, phase: float, farthest: float) -> str:
    """Say on which orbit a phase is, if it is on one."""
    points = [phase]
    for period in range(1, _LONGEST + 1):
        seen = look(system, points[-1], farthest)
        if seen.kind not in (RISES, FALLS):
            break
        if abs(seen.image % math.tau - phase) < _NEAR:
            return f"a stable orbit of period {period} near {min(points):.6f}"
        points.append(seen.image % math.tau)
    return _WANDERS


def rebounding_fates(system: System, epsilon: float, starts: int, impacts: int) -> list[Fate]:
    """Follow motions with restitution from random impacts, and count what they come to."""
    import numpy as np

    from proofs.motion.transients import until_rest

    generator, ends = random.Random(1), Counter[str]()
    for _ in range(starts):
        start = generator.uniform(0, math.tau), generator.uniform(0, 0.4)
        first = state = late_state(system, epsilon, *start, impacts)
        period = 0
        while state is not None and period < _LONGEST:
            state, period = late_state(system, epsilon, *state, 1), period + 1
            if state is not None and first is not None and math.dist(first, state) < _NEAR:
                break
        else:
            period = 0
        if first is not None:
            ends[f"a stable orbit of period {period}" if period else _WANDERS] += 1
        else:
            one, phase, speed = (np.array([x]) for x in (epsilon, *start))
            (rests,), _ = until_rest(system, one, phase, speed)
            ends["it rests on the table for a while" if rests else _NAMES[FLIES]] += 1
    return [Fate(name, count / starts, impacts) for name, count in ends.most_common()]


# -- in words --------------------------------------------------------------------------------------

HEAD = ("phases", "what f does", "images, mod 2 pi", "turns", "f'", "left end", "right end")


def rows(seen: Sequence[Stretch], narrow: float) -> list[tuple[str, ...]]:
    """Return the rows of a table about the stretches that are wider than so much: see `HEAD`."""
    around = [None, *seen, None]
    return [
        _row(stretch, before, after)
        for before, stretch, after in zip(around, seen, around[2:], strict=False)
        if stretch.width > narrow
    ]


def _row(stretch: Stretch, before: Stretch | None, after: Stretch | None) -> tuple[str, ...]:
    first, last = stretch.points[0], stretch.points[-1]
    phases = f"[{first.phase:.6f}, {last.phase:.6f}]"
    if stretch.kind not in (RISES, FALLS):
        return phases, stretch.kind, *[""] * 5
    turns = sorted({int(point.image // math.tau) for point in (first, last)})
    images = " to ".join(f"{point.image % math.tau:.4f}" for point in (first, last))
    slopes = sorted(point.slope for point in stretch.points)
    bounds = f"{slopes[0]:.3g} to {slopes[-1]:.3g}"
    ends = _ending(first, before), _ending(last, after)
    return phases, stretch.kind, images, "-".join(map(str, turns)), bounds, *ends


def _ending(point: Seen, beyond: Stretch | None) -> str:
    """Say what is at an end of a branch: impacts that graze, f' = 0, or what lies beyond."""
    if beyond is None:
        return "phase 0"
    if abs(point.slope) > _STEEP:
        return "grazes"
    if abs(point.slope) < _FLAT and beyond.kind in (RISES, FALLS):
        return "turns"
    return "jumps" if beyond.kind in (RISES, FALLS) else beyond.kind
