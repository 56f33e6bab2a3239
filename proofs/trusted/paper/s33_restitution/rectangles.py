"""Section 3.3: rectangles of states, and which of them F maps across which."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import ClassVar

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.context import Context
from proofs.trusted.numbers import TURN, Phases, Range, ceil_text, hull, show_range
from proofs.trusted.paper.s33_restitution.rebounds import Rebound, RectangleMap

Maps = Sequence[RectangleMap]
Box = tuple[Phases, Range]  # a rectangle: phases x velocities
Arrows = Sequence[Sequence[int]]  # from each rectangle to these
SMOOTH = "all their states are physically possible (gap' <= 0), and F is smooth on them"
_CLOSED = " (closed, phases x velocities)"
ALL = (0, 1), (0, 1)  # the arrows of two rectangles that are mapped across both


@dataclass(frozen=True)
class Strips:
    """Two rectangles of states, V1 = left x velocities to the left of V2 = right x velocities."""

    left: Phases
    right: Phases
    velocities: Range
    CROSSED: ClassVar[str] = "F maps each across both"

    def __post_init__(self) -> None:
        if self.left[1] >= self.right[0] or self.velocities[0] >= self.velocities[1]:
            raise Unproved("the rectangles overlap or have no width")

    @property
    def outer(self) -> Range:
        """The phases of the left edge of V1 and of the right edge of V2."""
        return self.left[0], self.right[1]

    @property
    def named(self) -> str:
        """V1 and V2, written."""
        left, right, gamma = map(show_range, (self.left, self.right, self.velocities))
        return f"V1 = {left} x {gamma}, V2 = {right} x {gamma}"

    def __str__(self) -> str:
        return self.named + _CLOSED

    @property
    def smooth(self) -> str:
        """The beginning of a theorem about them."""
        return f"let {self}: {SMOOTH}"


@dataclass(frozen=True)
class Blocks:
    """Four rectangles: a part of V1 and one of V2 for states next after V1, two for those after V2.

    The velocities of the first two are apart from those of the others: they tell where a state
    comes from.
    """

    after_first: tuple[Box, Box]
    after_second: tuple[Box, Box]
    CROSSED: ClassVar[str] = (
        "F maps both rectangles of V1 across the first ones of V1 and of V2, and both of V2 across "
        "the second ones"
    )

    def __post_init__(self) -> None:
        for left, right in (self.after_first, self.after_second):
            if left[0][1] >= right[0][0]:
                raise Unproved("the rectangles overlap")
        if any(low >= high for _, (low, high) in (*self.after_first, *self.after_second)):
            raise Unproved("a rectangle has no width")
        one, two = (hull([each[1] for each in x]) for x in (self.after_first, self.after_second))
        if one[0] <= two[1] and two[0] <= one[1]:
            raise Unproved("velocities after V1 and after V2 are not apart")

    @property
    def named(self) -> str:
        """V1 and V2, written."""
        sets = (
            " union ".join(" x ".join(map(show_range, box)) for box in boxes)
            for boxes in zip(self.after_first, self.after_second, strict=True)
        )
        return "V1 = {}, V2 = {}".format(*sets)

    def __str__(self) -> str:
        return self.named + _CLOSED

    @property
    def smooth(self) -> str:
        """The beginning of a theorem about them."""
        return f"let {self}: {SMOOTH}"


def strips(maps: Maps) -> Strips:
    """Return the rectangles of two maps with the same velocities, or raise Unproved."""
    first, second = maps
    if first.velocities != second.velocities:
        raise Unproved("the rectangles are about different velocities")
    found = Strips(first.phases, second.phases, first.velocities)
    _check_on_line(maps)
    return found


def blocks(maps: Maps) -> Blocks:
    """Return the rectangles of four maps, or raise Unproved.

    Images that may have phases of rectangles of the other velocities are apart from these: states
    of V1 and V2 whose images lie there, too, go to the rectangles that are next.
    """
    boxes = [(each.phases, each.velocities) for each in maps]
    found = Blocks((boxes[0], boxes[1]), (boxes[2], boxes[3]))
    _check_on_line(maps)
    for k, each in enumerate(maps):
        other = boxes[2:] if k % 2 == 0 else boxes[:2]
        for part in each.parts:
            if any(meet(part.phase, box[0]) and meet(part.velocity, box[1]) for box in other):
                raise Unproved("an image may lie in a rectangle that is not next")
    return found


def _check_on_line(maps: Maps) -> None:
    """Raise Unproved unless maps are about one box of oscillators and in all the next phase
    is monotone in phi, and images do not reach around the circle.

    So only one of the values of a next phase modulo 2 pi can lie in a rectangle, as image phases
    are between those of the edges: the line replaces the circle.
    """
    low, high = hull([each.phases for each in maps])
    for each in maps:
        if each.at != maps[0].at:
            raise Unproved("the rectangles are about different oscillators")
        lesser, greater = each.reach
        if greater[1] >= low + TURN or lesser[0] <= high - TURN:
            raise Unproved("an image reaches around the circle")


def require_rising(maps: Maps) -> None:
    """Raise Unproved unless in all maps the next phase increases with phi."""
    if min(each.sign for each in maps) < 0:
        raise Unproved("the next phase is not proved to increase with the phase")


def parts_of(maps: Maps) -> list[Rebound]:
    """Return the boxes of states that cover rectangles."""
    return [part for each in maps for part in each.parts]


def meet(one: Range, two: Range) -> bool:
    """Whether two closed intervals have a point in common."""
    return one[0] <= two[1] and two[0] <= one[1]


def read_maps(context: Context, names: Reader, most: int = 2) -> list[RectangleMap]:
    """Read the names of two rectangle steps, or of up to so many."""
    return [context.step(name, RectangleMap) for name in names.items(2, most)]


def crossing(maps: Maps, arrows: Arrows) -> Fraction:
    """Check hypothesis 2 of the rule `rectangle-horseshoe` for these arrows, or Unproved.

    Return by how much at least edges overshoot the rectangles that they should.
    """
    margins = []
    for each, targets in zip(maps, arrows, strict=True):
        low, high = hull([maps[target].phases for target in targets])
        lesser, greater = each.reach
        margins += [low - lesser[1], greater[0] - high]
        for part, target in ((part, maps[k]) for part in each.parts for k in targets):
            (lowest, highest), (least, most) = target.velocities, part.velocity
            if meet(part.phase, target.phases) and not lowest < least <= most < highest:
                raise Unproved("an image velocity is not in the interior of the velocities")
    if min(margins) <= 0:
        short = ceil_text(-min(margins))
        raise Unproved(f"an edge is not mapped beyond the rectangles: up to {short} short")
    return min(margins)
