"""Is there a horseshoe? Two sets for each box of oscillators, and where there is none."""

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
from proofs.motion.system import System
from proofs.plane.settling import settles
from proofs.plane.steps import Steps, corners, side
from proofs.search.shifts import families, pieces, symbols, with_spare
from proofs.trusted.numbers import Range
from proofs.trusted.parameters import Place

Floats = NDArray[np.float64]
Sets = list[Range]  # two or more, in order

_GRID = 800  # phases that are looked at
_FARTHEST = 200.0
_LEAST = 1e-4  # by which images must seem to reach beyond the sets, and the share of how they vary
_SHARE = 0.2
_BEST = 0.8
_TRIES = 3


class Reach(NamedTuple):
    """How sets fit a box, in floating point.

    margin: by how much, at least, images of ends are beyond the sets at the centre and at the
    corners, in units of by how much they differ there; turns: those that the images of each set
    are less; latest: its longest flight.
    """

    margin: float
    turns: list[int]
    latest: list[float]


def propose(box: Place, hints: Sequence[Sets]) -> Iterator[tuple[Steps, Sets | None]]:
    """Yield certificates that seem to answer the question, with the sets that they are about.

    hints: sets of neighbours, to be tried first.
    """
    with suppress(Undecided):
        yield settles(box), None
        return
    tried = [(reach.margin, sets, reach) for sets, reach in _fitting(box, hints)]
    if not tried:
        tried = [(reach.margin, sets, reach) for sets, reach in _fitting(box, _seen(box))]
    failure = "no two sets are seen that f maps over each other all over the box"
    for _, sets, reach in sorted(tried, key=lambda each: abs(math.log(each[0] / _BEST)))[:_TRIES]:
        try:
            yield _covering(box, sets, reach), sets
        except Undecided as error:
            failure = str(error)
    raise Undecided(failure)


def _seen(box: Place) -> list[Sets]:
    """Return pairs of sets that are seen at the centre of the box."""
    (eta, last), (nu, most) = box.eta, box.nu
    system = System((eta + last) / 2, (nu + most) / 2)
    found = symbols(pieces(system, _GRID))
    return [sets for family in families(found, 2) for sets in with_spare(family)]


def _fitting(box: Place, candidates: Sequence[Sets]) -> list[tuple[Sets, Reach]]:
    """Return the candidates that seem to fit all over a box."""
    if not candidates:
        return []
    etas, nus = corners(box)
    ends = np.array([[(a, b, (a + b) / 2) for a, b in sets] for sets in candidates], float)
    found = next_impacts(side(box), etas, nus, ends[..., None], _FARTHEST)
    fits = []
    for sets, images, times in zip(candidates, found.images, found.times, strict=True):
        reach = _reach(sets, images, times)
        if reach.margin > _SHARE:
            fits.append((sets, reach))
    return fits


def _reach(sets: Sets, images: Floats, times: Floats) -> Reach:
    """Return how sets fit, by images and times of their ends and middles at some oscillators."""
    if not np.isfinite(images).all():
        return Reach(-math.inf, [], [])
    first, last = float(sets[0][0]), float(sets[-1][1])
    turns = np.floor(images[:, 2, 0] / math.tau)
    ends = np.sort(images[:, :2, :], axis=1) - math.tau * turns[:, None, None]
    margin = min(float((first - ends[:, 0]).min()), float((ends[:, 1] - last).min()))
    spread = float(np.ptp(ends, axis=2).max())
    latest = [float(x) for x in times.max(axis=(1, 2))]
    return Reach(margin / (spread + _LEAST), [int(x) for x in turns], latest)


def _covering(box: Place, sets: Sets, reach: Reach) -> Steps:
    """Return the steps for rule `covering-shift`."""
    made = Steps(box)
    cells = [
        {"flights": made.impacts(phases, latest), "turns": str(turns)}
        for phases, turns, latest in zip(sets, reach.turns, reach.latest, strict=True)
    ]
    made.add("covering-shift", {"cells": cells})
    return made


def sets_to_text(sets: Sets) -> str:
    """Write sets, to be tried elsewhere."""
    return " ".join(str(end) for phases in sets for end in phases)


def sets_from_text(text: str) -> Sets:
    """Read them."""
    ends = [Fraction(end) for end in text.split()]
    return list(zip(ends[::2], ends[1::2], strict=True))
