"""Proof steps of the horseshoe with restitution for all oscillators of a box of parameters."""

from __future__ import annotations

import math
from contextlib import suppress
from fractions import Fraction
from itertools import islice, product

from intervals import DomainError, Undecided
from proofs.search.s33_rectangles import (
    Sets,
    images_over,
    is_short,
    nearest_rectangles,
    overshoot,
    stays,
)
from proofs.search.s33_steps import ReboundProver
from proofs.trusted.numbers import Range
from proofs.trusted.paper.s33_restitution.rebound_boxes import with_side
from proofs.trusted.paper.s33_restitution.rebounds import Box, Unjoined

_ATTEMPTS = 24  # at parts of a box
_NEAREST = 24  # rectangles tried on a box
_SHRUNK = 6  # times that a box is halved for a correction
_WORDS = 3  # points at which a word without orbit is looked for, or edges that fail
_RAYS = 8  # points looked at on the way from the middle of a box to its boundary


def on_box(prover: ReboundProver) -> list[str]:
    """Return the steps for N4: the statement's box; or a failure in it, and what is true instead.

    Without a proof for the whole box nothing is kept of the parts of it that have one.
    """
    of, sets = prover.of, (prover.of.left, prover.of.right)
    if of.box is None:
        return []
    with suppress(Unjoined):
        return over(prover, of.box, sets, _ATTEMPTS)
    return _failure(prover, of.box, sets) + _instead(prover, of.box)


def over(prover: ReboundProver, box: Box, sets: Sets, attempts: int) -> list[str]:
    """Prove the horseshoe on rectangles for a box, cut in parts while it must be; or Unjoined."""
    if not stays(prover.of, box, sets):
        raise Unjoined("an image velocity leaves the rectangles")
    before = dict(prover.steps)
    names: list[str] = []
    rest = [box]
    while rest:
        part, attempts = rest.pop(), attempts - 1
        try:
            if overshoot((*sets[0], *sets[1]), images_over(prover.of, part)) <= 0:
                raise Unjoined("an edge falls short at a corner of the box")
            try:
                names += prover.horseshoe(part, sets)
            except Unjoined:
                if attempts <= len(rest):
                    raise
                rest += _halves(prover, part, sets)
        except Unjoined:
            prover.forget(before)
            raise
    return names


def _halves(prover: ReboundProver, box: Box, sets: Sets) -> list[Box]:
    """Cut a box across the side along which the images of the edges move most."""
    ends = (*sets[0], *sets[1])
    middle = _point(box, (0, 0, 0))
    moves = []
    for side, values in enumerate(box):
        if values[0] < values[1]:
            one, two = (
                images_over(prover.of, with_side(middle, side, (end, end))) for end in values
            )
            pairs = [(one(end), two(end)) for end in ends]
            move = sum(abs(a[0] - b[0]) if a and b else math.inf for a, b in pairs)
            moves.append((move, side))
    if not moves:
        raise Unjoined("a point is not cut")
    side = max(moves)[1]
    low, high = box[side]
    centre = (low + high) / 2
    return [with_side(box, side, ends) for ends in ((low, centre), (centre, high))]


def _point(box: Box, direction: tuple[int, ...], share: Fraction = Fraction(1)) -> Box:
    """Return the point a share of the way from the middle to the boundary, in a direction."""

    def moved(side: Range, sign: int) -> Range:
        value = (side[0] + side[1]) / 2 + sign * share * (side[1] - side[0]) / 2
        return value, value

    eta, nu, epsilon = map(moved, box, direction)
    return eta, nu, epsilon


def _points(box: Box) -> list[Box]:
    """Return points of a box, the middle first, then on rays to corners, edges and faces."""
    directions = list(product((0, 1, -1), repeat=3))
    shares = (Fraction(step, _RAYS) for step in range(_RAYS + 1))
    return list(dict.fromkeys(_point(box, each, share) for share in shares for each in directions))


def _failure(prover: ReboundProver, box: Box, sets: Sets) -> list[str]:
    """Prove that a word has no orbit at a point of the box; else which edges fail, or may."""
    ends = (*sets[0], *sets[1])
    images = {point: images_over(prover.of, point) for point in _points(box)}
    short = [point for point, each in images.items() if is_short(ends, each)]
    likely = short[:: max(1, len(short) // _WORDS)]
    if -math.inf < overshoot(ends, images[_point(box, (0, 0, 0))]) < 0:
        likely = [_point(box, (0, 0, 0)), *likely]
    for point in dict.fromkeys(likely):
        with suppress(Unjoined, Undecided, DomainError):
            word = prover.missing_word(prover.pair(point, sets, ()))
            return [word, *_states(prover, point, sets)]
    failing = (p for p, each in images.items() if -math.inf < overshoot(ends, each) < 0)
    for point in islice(failing, _WORDS):
        if states := _states(prover, point, sets):
            return states
    names = []
    for end in ends:
        with suppress(Undecided, DomainError):
            names.append(prover.rebound(box, (end, end), prover.velocities)[0])
    return names


def _states(prover: ReboundProver, point: Box, sets: Sets) -> list[str]:
    """Prove the images of states on edges that fall short at a point, if it can be done."""
    with suppress(Undecided, DomainError):
        return prover.refuting_states(point, sets)
    return []


def _instead(prover: ReboundProver, box: Box) -> list[str]:
    """Prove the horseshoe on the nearest rectangles for the box, else for half of it, and so on."""
    for halvings in range(_SHRUNK + 1):
        smaller = _scaled(box, Fraction(1, 2**halvings))
        nearest = nearest_rectangles(prover.of, images_over(prover.of, smaller))
        for sets in islice(nearest, _NEAREST):
            with suppress(Unjoined):
                return over(prover, smaller, sets, 1)
    return []


def _scaled(box: Box, factor: Fraction) -> Box:
    """Return the box shrunk about its middle."""

    def scaled(side: Range) -> Range:
        middle, half = (side[0] + side[1]) / 2, factor * (side[1] - side[0]) / 2
        return middle - half, middle + half

    eta, nu, epsilon = map(scaled, box)
    return eta, nu, epsilon
