"""Proof steps of the horseshoe with restitution for all oscillators of a box of parameters."""

from __future__ import annotations

import math
from contextlib import suppress
from fractions import Fraction
from itertools import islice, product

from intervals.cover import cover
from proofs.methods.divisions import halved
from proofs.search.s33_rectangles import (
    Sets,
    image_phases,
    is_short,
    nearest_rectangles,
    overshoot,
    stays,
)
from proofs.search.s33_steps import ReboundProver
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.numbers import Range
from proofs.trusted.parameters import Place

_ATTEMPTS = 24  # at parts of a box
_NEAREST = 24  # rectangles tried on a box
_SHRUNK = 6  # times that a box is halved for a correction
_WORDS = 3  # points at which a word without orbit is looked for, or edges that fail
_RAYS = 8  # points looked at on the way from the middle of a box to its boundary


def on_box(prover: ReboundProver, box: Place) -> tuple[list[str], str]:
    """Return the steps for N4, and what failed: the statement's box; or a failure in it, and what
    is true instead.

    Without a proof for the whole box nothing is kept of the parts of it that have one.
    """
    sets = prover.of.left, prover.of.right
    try:
        return over(prover, box, sets, _ATTEMPTS), ""
    except Unproved as failure:
        return _failure(prover, box, sets) + _instead(prover, box), str(failure)


def over(prover: ReboundProver, box: Place, sets: Sets, attempts: int) -> list[str]:
    """Prove the horseshoe on rectangles for a box, in parts while it must be; or Unproved."""
    if not stays(box, prover.velocities, sets):
        raise Unproved("an image velocity leaves the rectangles")

    def decide(part: Place) -> str | None:
        if overshoot((*sets[0], *sets[1]), image_phases(part, prover.velocities)) <= 0:
            raise Unproved("an edge falls short at a corner of the box")
        with suppress(Unproved):
            return prover.crossing(part, sets)
        return None

    def split(part: Place) -> list[Place]:
        return [Place(*sides) for sides in halved(part.sides, box.sides)[1:]]

    with prover.attempt():
        return [name for _, name in cover([box], decide, split, limit=attempts)]


def _point(box: Place, direction: tuple[int, ...], share: Fraction = Fraction(1)) -> Place:
    """Return the point a share of the way from the middle to the boundary, in a direction."""

    def moved(side: Range, sign: int) -> Range:
        value = (side[0] + side[1]) / 2 + sign * share * (side[1] - side[0]) / 2
        return value, value

    return Place(*map(moved, box.sides, direction))


def _points(box: Place) -> list[Place]:
    """Return points of a box, the middle first, then on rays to corners, edges and faces."""
    directions = list(product((0, 1, -1), repeat=3))
    shares = (Fraction(step, _RAYS) for step in range(_RAYS + 1))
    return list(dict.fromkeys(_point(box, each, share) for share in shares for each in directions))


def _failure(prover: ReboundProver, box: Place, sets: Sets) -> list[str]:
    """Prove that a word has no orbit at a point of the box; else which edges fail there."""
    ends = (*sets[0], *sets[1])
    images = {point: image_phases(point, prover.velocities) for point in _points(box)}
    short = [point for point, each in images.items() if is_short(ends, each)]
    likely = short[:: max(1, len(short) // _WORDS)]
    failing = [p for p, each in images.items() if -math.inf < overshoot(ends, each) < 0]
    middle = _point(box, (0, 0, 0))
    if middle in failing:
        likely = [middle, *likely]
    for point in dict.fromkeys(likely):
        with suppress(Unproved):
            word = prover.missing_word(prover.pair(point, sets))
            return [word, *prover.corners(point, sets, short=True)]
    for point in failing[:_WORDS]:
        if states := prover.corners(point, sets, short=True):
            return states
    return []


def _instead(prover: ReboundProver, box: Place) -> list[str]:
    """Prove the horseshoe on the nearest rectangles for the box, else for half of it, and so on."""
    for halvings in range(_SHRUNK + 1):
        smaller = Place(*(_scaled(side, Fraction(1, 2**halvings)) for side in box.sides))
        nearest = nearest_rectangles(prover.of, image_phases(smaller, prover.velocities))
        for sets in islice(nearest, _NEAREST):
            with suppress(Unproved):
                return over(prover, smaller, sets, 1)
    return []


def _scaled(side: Range, factor: Fraction) -> Range:
    """Return a side shrunk about its middle."""
    middle, half = (side[0] + side[1]) / 2, factor * (side[1] - side[0]) / 2
    return middle - half, middle + half
