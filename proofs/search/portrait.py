"""The impact map on the whole circle as floating point sees it: branches, and where orbits go.

Candidates only, never evidence: what is proved is said by conclusions, elsewhere.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

from proofs.motion.simulate import TURNS, next_impact, separation_phase
from proofs.motion.system import System
from proofs.search.orbits import (
    FALLS,
    FLIES,
    LONGEST,
    NEAR,
    RISES,
    STICKS,
    TOUCHES,
    Seen,
    look,
)

_NARROWEST = 1e-9  # to which the ends of branches are located
_MOST_ENDS = 400  # that are located; branches are infinitely many where flights are ever longer
_STEEP, _FLAT = 30.0, 1e-3  # |f'| at an end where f' is unbounded, or 0
_AFTER = 1e-8  # the separation: the derivative of the next impact's phase is 0 there
_ROUNDS = 5  # of impacts, until orbits have come to their ends


Check = Callable[[], None]


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
    for left_point, right_point in pairwise(points):
        check()
        for left, right in _breaks(system, left_point, right_point, farthest, budget):
            if left is not runs[-1][-1]:
                runs[-1].append(left)
            runs.append([right])
        if right_point is not runs[-1][-1]:
            runs[-1].append(right_point)
    return [Stretch(tuple(run)) for run in runs]


def _breaks(
    system: System, left: Seen, right: Seen, farthest: float, budget: list[int]
) -> Iterator[tuple[Seen, Seen]]:
    """Yield the neighbouring phases, between two, at which a stretch ends and another begins."""
    if continues(left, right):
        return
    width = right.phase - left.phase
    if width < _NARROWEST or budget[0] <= 0:
        budget[0] -= 1
        yield left, right
        return
    middle = look(system, (left.phase + right.phase) / 2, farthest)
    yield from _breaks(system, left, middle, farthest, budget)
    yield from _breaks(system, middle, right, farthest, budget)


def continues(left: Seen, right: Seen) -> bool:
    """Whether the second of two neighbours is on the stretch of the first, by the slopes."""
    if left.kind != right.kind:
        return False
    expected = (left.slope + right.slope) / 2 * (right.phase - left.phase)
    return abs(right.image - left.image - expected) < 0.3 * abs(expected) + 1e-3


# -- where orbits go -------------------------------------------------------------------------------


_NAMES = {
    TOUCHES: "it only touches the table, again and again",
    FLIES: "no impact is seen so far",
}
_RESTS = "it rests on the table for ever"
_LEAVES = "it sticks or rests on the table in each period, and leaves it again"
_WANDERS = "no end of it is seen"


@dataclass(frozen=True)
class Fate:
    """What a share of the orbits that were followed comes to; impacts: the most until then.

    impacts counts those up to the first sticking, from where on all that stick are one motion.
    """

    name: str
    share: float
    impacts: int


def _counted(ends: Sequence[tuple[str, int]]) -> list[Fate]:
    """Return the fates, the most frequent first, from what each orbit comes to, and when."""
    counts = Counter(name for name, _ in ends)
    return [
        Fate(name, count / len(ends), max(until for each, until in ends if each == name))
        for name, count in counts.most_common()
    ]


def fates(
    system: System, epsilon: float, starts: int, impacts: int, check: Check = lambda: None
) -> list[Fate]:
    """Follow motions from random impacts to their ends, and count these; epsilon: 0 if plastic.

    A mass that sticks or rests leaves at the separation phase: all that do go on as one motion.
    """
    from proofs.motion import transients

    kinds = {
        transients.GOING: _WANDERS,
        transients.RESTS: STICKS,
        transients.FLIES: FLIES,
        transients.TOUCHES: TOUCHES,
    }

    def ends(states: Sequence[tuple[float, float]]) -> list[tuple[str, int]]:
        motions = transients.Motions(system, epsilon, states)
        for _ in range(_ROUNDS):
            check()
            motions.follow(impacts)
            motions.find_cycles(LONGEST, NEAR)
        each = zip(motions.kinds.tolist(), motions.counts.tolist(), strict=True)
        return [(kinds.get(kind) or _stable(kind), count) for kind, count in each]

    names = _NAMES | {STICKS: _after_rest(system, lambda state: ends([state])[0][0])}
    seen = ends(transients.random_impacts(starts))
    return _counted([(names.get(name, name), until) for name, until in seen])


def _after_rest(system: System, end: Callable[[tuple[float, float]], str]) -> str:
    """Return what a mass that sticks comes to.

    end: of a motion from an impact, given by phase and speed; STICKS where it sticks.
    """
    if system.sticking_arc != "some":
        return _RESTS
    landing = next_impact(system, separation_phase(system) + _AFTER, math.tau * TURNS)
    name = FLIES if landing is None else end((landing.phase, landing.speed))
    return _LEAVES if name == STICKS else _NAMES.get(name, name)


def _stable(period: int) -> str:
    return f"a stable orbit of period {period}"


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
