"""Section 3.3: V1 and V2, two rectangles of states, or two unions of two."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.horseshoe import Horseshoe
from proofs.trusted.numbers import Phases, Range, hull, show_range

Box = tuple[Phases, Range]  # a rectangle: phases x velocities
SMOOTH = "all their states are physically possible (gap' <= 0), and F is smooth on them"
_CLOSED = " (closed, phases x velocities)"
ALL = (0, 1), (0, 1)  # the arrows of two rectangles that are mapped across both
BY_LAST = ((0, 1), (2, 3)) * 2  # of four: the first two are for states next after V1


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
    def boxes(self) -> tuple[Box, Box]:
        """V1 and V2."""
        return (self.left, self.velocities), (self.right, self.velocities)

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


def sets_of(shoe: Horseshoe) -> Strips | Blocks:
    """Return V1 and V2 of a horseshoe of two rectangles, or of four; Unproved if it has others.

    Of four, all full orbits in V1 and V2 must be known to follow the arrows.
    """
    boxes: list[Box] = [(Phases(*phases), velocities) for phases, velocities in shoe.boxes]
    if shoe.arrows == ALL and boxes[0][1] == boxes[1][1]:
        return Strips(boxes[0][0], boxes[1][0], boxes[0][1])
    if shoe.arrows == BY_LAST and shoe.is_complete:
        return Blocks((boxes[0], boxes[1]), (boxes[2], boxes[3]))
    raise Unproved("two rectangles of one height, or a first and a second one of each, are needed")
