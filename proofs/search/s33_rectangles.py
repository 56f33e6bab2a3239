"""Rectangles on which a horseshoe with restitution may be proved: candidates, never evidence."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from functools import cache, lru_cache
from itertools import product

from proofs.motion.simulate import landing
from proofs.motion.system import System
from proofs.search.repair import moved_ends, places
from proofs.trusted.numbers import Range
from proofs.trusted.parameters import Parameters, Place

Sets = tuple[Range, Range]
Images = Callable[[Fraction], tuple[float, float] | None]
_MOST_UNITS = 2
_HALVINGS = 12  # of a candidate for an end


@lru_cache(maxsize=4096)
def state_after(
    eta: float, nu: float, epsilon: float, state: tuple[float, float]
) -> tuple[float, float] | None:
    """Return about F(phi, gamma), its phase in [0, 2 pi); None if it sticks or flies on."""
    after = landing(System(Fraction(eta), Fraction(nu)), epsilon, *state)
    return None if after is None else (after.phase, after.velocity)


def image_phases(at: Place, velocities: Range) -> Images:
    """Return a function: about the least and the greatest next phase of the states of a phase.

    For all oscillators of a box and all velocities, as its corners and the ends of these have it.
    """
    corners = list(product(*(sorted({float(end) for end in side}) for side in at.sides)))

    @cache
    def images(phase: Fraction) -> tuple[float, float] | None:
        states = [(float(phase), float(end)) for end in velocities]
        ends = [
            state_after(eta, nu, epsilon, state) for eta, nu, epsilon in corners for state in states
        ]
        phases = [end[0] for end in ends if end is not None]
        return (min(phases), max(phases)) if len(phases) == len(ends) else None

    return images


def overshoot(ends: tuple[Fraction, ...], images: Images) -> float:
    """Return about the least margin by which the four edges are mapped beyond the rectangles."""
    margins = []
    for index, end in enumerate(ends):
        reach = images(end)
        if reach is None:
            return -math.inf
        margins.append(ends[0] - reach[1] if index % 2 == 0 else reach[0] - ends[3])
    return float(min(margins))


def is_short(ends: tuple[Fraction, ...], images: Images) -> bool:
    """Whether all of an edge seems to be mapped short of the outer edges.

    And that of each rectangle the right edge is mapped to the right of the left one: where it is
    not, some of its impacts graze.
    """
    reaches = [images(end) for end in ends]
    certain = [each for each in reaches if each is not None]
    if len(certain) < len(ends) or any(certain[k][1] >= certain[k + 1][0] for k in (0, 2)):
        return False
    return any(ends[0] < low and high < ends[3] for low, high in certain)


def stays(at: Place, velocities: Range, sets: Sets) -> bool:
    """Whether image velocities seem to stay in the rectangles, for the middle of a box."""
    middle = [float(low + high) / 2 for low, high in at.sides]
    low, high = map(float, velocities)
    images = [
        state_after(middle[0], middle[1], middle[2], (float(phi), gamma))
        for ends in sets
        for phi, gamma in product(ends, (low, high))
    ]
    return all(image is not None and low < image[1] < high for image in images)


def nearest_rectangles(statement: Parameters, images: Images) -> Iterator[Sets]:
    """Yield phases of rectangles that seem to be mapped across both, nearest first."""
    for ends in moved_ends((*statement.left, *statement.right)):
        if overshoot(ends, images) > 0:
            yield (ends[0], ends[1]), (ends[2], ends[3])


def widened(statement: Parameters, sets: Sets, corners: Sequence[Images]) -> Iterator[Sets]:
    """Yield the sets with ends moved outward, by up to two units of the last printed place.

    Those first whose edges seem to be mapped beyond them by most at all the corners.
    """
    ends = (*sets[0], *sets[1])
    unit = Fraction(1, 10 ** places((*statement.left, *statement.right)))
    choices = []
    for steps in product(range(_MOST_UNITS + 1), repeat=4):
        moves = (-steps[0], steps[1], -steps[2], steps[3])
        moved = tuple(end + unit * move for end, move in zip(ends, moves, strict=True))
        if sorted(set(moved)) == list(moved) and moved[0] >= 0:
            choices.append((min(overshoot(moved, each) for each in corners), moved))
    for margin, moved in sorted(choices, reverse=True):
        if margin > 0:
            yield (moved[0], moved[1]), (moved[2], moved[3])


def narrowed(statement: Parameters, images: Images) -> Range | None:
    """Return candidates x for a right end of V2: its edge goes beyond V1, and V1's beyond it.

    Both ends of the range of such x, found by bisection; None if there is none.
    """
    beyond, outer = images(statement.left[1]), images(statement.right[1])
    if beyond is None or outer is None or outer[0] <= statement.left[1]:
        return None
    low, high = statement.right
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        reach = images(middle)
        if reach is None:
            return None
        low, high = (low, middle) if reach[0] > statement.left[1] else (middle, high)
    top = min(Fraction(beyond[0]), statement.right[1])
    return (high, top) if high < top else None
