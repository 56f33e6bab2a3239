"""Is there a horseshoe? Some sets for each box of oscillators, and where there is none."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from contextlib import suppress
from fractions import Fraction
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from intervals import Undecided
from proofs.motion.many import next_impacts
from proofs.plane.settling import settles
from proofs.plane.steps import Steps, corners
from proofs.search.orbits import FALLS, RISES, Seen
from proofs.search.portrait import continues
from proofs.search.shifts import Piece, expanding, families, symbols, with_spare
from proofs.trusted.certificate import texts
from proofs.trusted.equations import clock, gap, launch
from proofs.trusted.flights import lifted
from proofs.trusted.numbers import Range
from proofs.trusted.parameters import Place
from proofs.trusted.windows import BITS

Floats = NDArray[np.float64]

_GRID = 800  # phases that are looked at
_FARTHEST = 200.0
_LEAST = 1e-4  # by which images must seem to reach beyond the sets
_SHARE, _BEST = 0.2, 0.8  # least and best, of that in units of how images differ over a box
_TRIES = 3
_UNIT = Fraction(1, 2**20)  # of times


class Sets(NamedTuple):
    """Sets that f seems to map over them all, in order.

    turns: those that the images of each are less; latest: the longest flight from each.
    """

    phases: tuple[Range, ...]
    turns: tuple[int, ...]
    latest: tuple[float, ...]

    @property
    def text(self) -> str:
        """The sets in a line."""
        rows = zip(self.phases, self.turns, self.latest, strict=True)
        return " ".join(f"{low} {high} {turns} {time:.6g}" for (low, high), turns, time in rows)

    @classmethod
    def of(cls, text: str) -> Sets:
        """Read what `text` gives."""
        words = text.split()
        phases = zip(map(Fraction, words[::4]), map(Fraction, words[1::4]), strict=True)
        turns, latest = map(int, words[2::4]), map(float, words[3::4])
        return cls(tuple(phases), tuple(turns), tuple(latest))


def propose(
    box: Place, hints: Sequence[Sets], count: int = 2
) -> Iterator[tuple[Steps, Sets | None]]:
    """Yield certificates that seem to answer the question, with the sets that they are about.

    hints: sets of neighbours, to be tried first; count: of the sets.
    """
    with suppress(Undecided):
        yield settles(box), None
        return
    failure = f"no {_number(count)} sets are seen that f maps over each other all over the box"
    tried = [sets for sets in hints if _holds(box, sets)] or _seen(box, count)
    for sets in tried[:_TRIES]:
        try:
            yield _covering(box, sets), sets
        except Undecided as error:
            failure = str(error)
    raise Undecided(failure)


def _holds(box: Place, sets: Sets) -> bool:
    """Whether the images of the ends seem to be beyond the sets at the corners of a box."""
    etas, nus = (np.array(each)[:, None] for each in corners(box))
    target = np.array([float(sets.phases[0][0]), float(sets.phases[-1][1])])
    for phases, turns in zip(sets.phases, sets.turns, strict=True):
        sides = []
        for end in map(float, phases):
            times = target + math.tau * turns - end
            below, above = gap(launch(box.side, etas, nus, end), clock(etas, times)).T
            sides.append(-int((below < 0).all()) + int((above > 0).all()))
        if sorted(sides) != [-1, 1]:
            return False
    return True


def _number(count: int) -> str:
    return "two" if count == 2 else f"{count}"


def _seen(box: Place, count: int) -> list[Sets]:
    """Return so many sets that are seen at the centre, and seem to fit all over a box."""
    etas, nus = corners(box)
    letters = symbols(_pieces(box.side, etas[0], nus[0]))
    grown = [family for family in families(letters, count) if len(family) == count]
    pairs = [sets for family in grown for sets in with_spare(family)]
    if not pairs:
        return []
    points = np.array([[(a, b, (a + b) / 2) for a, b in sets] for sets in pairs], float)
    flights = next_impacts(box.side, etas, nus, points[..., None], _FARTHEST)
    fits = []
    for phases, images, times in zip(pairs, flights.images, flights.times, strict=True):
        turns = np.floor(images[:, 2, 0] / math.tau)
        margin = _margin(phases, images[:, :2] - math.tau * turns[:, None, None])
        if margin > _SHARE:
            latest = tuple(float(x) for x in times.max(axis=(1, 2)))
            sets = Sets(tuple(phases), tuple(int(x) for x in turns), latest)
            fits.append((abs(math.log(margin / _BEST)), sets))
    return [sets for _, sets in sorted(fits)]


def _pieces(sign: int, eta: float, nu: float) -> list[Piece]:
    """Return pieces of branches, as far as a grid of phases shows them."""
    phases = math.tau * (np.arange(_GRID) + 0.5) / _GRID
    _, images, slopes, _ = next_impacts(sign, eta, nu, phases, _FARTHEST)
    branches: list[list[Seen]] = [[]]
    for phase, image, slope in zip(phases.tolist(), images.tolist(), slopes.tolist(), strict=True):
        point = Seen(phase, FALLS if slope < 0 else RISES, image, slope)  # NaN continues nothing
        if branches[-1] and not continues(branches[-1][-1], point):
            branches.append([])
        branches[-1].append(point)
    return [piece for branch in branches for piece in expanding(branch)]


def _margin(phases: Sequence[Range], images: Floats) -> float:
    """Return by how much the images of ends are beyond all sets, in units of how they differ."""
    if not np.isfinite(images).all():
        return -math.inf
    first, last, ends = float(phases[0][0]), float(phases[-1][1]), np.sort(images, axis=1)
    margin = min(float((first - ends[:, 0]).min()), float((ends[:, 1] - last).min()))
    return margin / (float(np.ptp(ends, axis=2).max()) + _LEAST)


def _covering(box: Place, sets: Sets) -> Steps:
    """Return the steps for rule `covering-graph`: each set is a branch, their hull the one state.

    The image of an end is bracketed between that of the hull's end which it is beyond, and that of
    an end of the window of the impact.
    """
    made = Steps(box)
    eta, nu = (each[0] for each in corners(box))
    target, names, images = (sets.phases[0][0], sets.phases[-1][1]), [], []
    for phases, turns, latest in zip(*sets, strict=True):
        windows = made.windows(phases, latest)
        cuts = texts([phases[0], *(high for _, high in windows)])
        names.append(made.add("branch", {"cuts": cuts, "turn": str(turns)}))
        first, *_, last = [*windows.values()] * 2
        for phase, (begin, end) in zip(phases, (first, last), strict=True):
            low, high = lifted((target[0] - phase, target[1] - phase), turns, BITS)
            early = min(low // _UNIT * _UNIT, end)
            late = max(-(-high // _UNIT) * _UNIT, begin)
            is_below = gap(launch(box.side, eta, nu, float(phase)), clock(eta, float(early))) < 0
            time = (begin, early) if is_below else (late, end)
            images.append({"phase": str(phase), "time": texts(time)})
    graph = {"states": [texts(target)], "weights": ["1"], "growth": str(len(names))}
    made.add("covering-graph", {"branches": names, "images": images, **graph})
    return made
