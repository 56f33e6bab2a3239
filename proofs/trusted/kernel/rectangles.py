"""Rectangles of the plane, and which of them a map takes across which: a rule, and lemmas."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion, given
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.differential import BITS, Differential, differential_on, image_of, less
from proofs.trusted.kernel.enclose import Box, box_text, read_box
from proofs.trusted.kernel.maps import Map, read_turns
from proofs.trusted.numbers import Range, between, ceil_text, hull, increasing

Arrows = Sequence[Sequence[int]]  # from each rectangle to these
_MOST_PARTS = 4096
_MOST = 64  # rectangles together


@dataclass(frozen=True)
class Rectangle(Conclusion):
    """What a map of the plane does on a rectangle, x by y: in parts that cover it, from left to
    right, and where its left and its right edge go; images less so many periods.
    """

    function: Map
    box: Box
    turns: tuple[int, ...]
    parts: tuple[Differential, ...]
    edges: tuple[Box, Box]

    @property
    def image(self) -> Box:
        """The hull of the images."""
        return tuple(hull(sides) for sides in zip(*(x.values for x in self.parts), strict=True))

    @property
    def slope(self) -> Range:
        """The derivative of the image's x in x."""
        return hull([part.matrix[0][0] for part in self.parts])

    @property
    def sign(self) -> int:
        """1 where the image's x is proved to increase with x, -1 where it decreases."""
        least, most = self.slope
        if least <= 0 <= most:
            raise Unproved("an image is not proved to be monotone")
        return 1 if least > 0 else -1

    @property
    def reach(self) -> tuple[Range, Range]:
        """The images' x of the edge with the lesser ones, and of that with the greater ones."""
        left, right = (image[0] for image in self.edges)
        return (left, right) if self.sign > 0 else (right, left)

    @property
    def sentence(self) -> str:
        """Return the statement."""
        map_ = self.function
        left, right = (between(image[0]) for image in self.edges)
        return (
            f"{given(map_)}`{map_.name}` is continuously differentiable for "
            f"{box_text(self.box, map_.variables)}, and takes it into "
            f"{' x '.join(map(between, self.image))}{less(map_, self.turns)}, its left edge to "
            f"{left}, its right edge to {right}, in `{map_.variables[0]}`."
        )


def rectangle(context: Context, reader: Reader) -> Rectangle:
    """Rule `rectangle`: {function F of two variables, box, cuts, turns as in `differential`}.

    The first variable may be an angle, the second one is none. Conclusion: F is continuously
    differentiable on the rectangle, as it is, by `differential`, on the parts between the cuts of
    the first side, on which its values and its derivative are enclosed, and on both edges.
    Proof. The parts cover it, and less the same turns the values on the line are continuous.
    """
    names = ("turns",) if reader.has("turns") else ()
    function_of, box_of, cuts_of, *_ = reader.fields("function", "box", "cuts", *names)
    map_ = context.function(function_of)
    if not len(map_.variables) == map_.size == 2 or any(circle.place for circle in map_.circles):
        raise function_of.fail("a map of the plane is expected, the second variable no angle")
    (low, high), side = box = read_box(box_of, 2)
    cuts = low, *cuts_of.numbers(0, _MOST_PARTS), high
    if not increasing(cuts) or not side[0] < side[1]:
        raise cuts_of.fail("cuts increase inside the first side, and sides have a width")
    turns = read_turns(map_, reader)
    parts = tuple(differential_on(map_, (part, side), turns) for part in pairwise(cuts))
    left, right = (image_of(map_, ((end, end), side), turns) for end in (low, high))
    return Rectangle(map_, box, turns, parts, (left, right))


def require_together(rectangles: Sequence[Rectangle]) -> None:
    """Raise Unproved unless rectangles are disjoint and about one map, whose images of each are
    monotone and, where the first variable is an angle, do not reach around the circle.

    So only one of the values of an angle modulo its period can lie in a rectangle, as images are
    between those of the edges: the line replaces the circle.
    """
    map_ = rectangles[0].function
    low, high = hull([each.box[0] for each in rectangles])
    for k, each in enumerate(rectangles):
        if each.function != map_:
            raise Unproved("the rectangles are about different maps")
        if any(overlap(each.box, other.box) for other in rectangles[:k]):
            raise Unproved("the rectangles overlap")
        lesser, greater = each.reach
        for period in map_.periods(BITS).values():
            turn = period.range[0]
            if greater[1] >= low + turn or lesser[0] <= high - turn:
                raise Unproved("an image reaches around the circle")


def overlap(one: Sequence[Range], two: Sequence[Range]) -> bool:
    """Whether two closed boxes have a point in common."""
    return all(a[0] <= b[1] and b[0] <= a[1] for a, b in zip(one, two, strict=True))


def crossing(rectangles: Sequence[Rectangle], arrows: Arrows) -> Fraction:
    """Check hypothesis 2 of the rule `horseshoe` for these arrows, or Unproved.

    Return by how much at least edges overshoot the rectangles that they should.
    """
    margins = []
    for each, following in zip(rectangles, arrows, strict=True):
        low, high = hull([rectangles[k].box[0] for k in following])
        lesser, greater = each.reach
        margins += [low - lesser[1], greater[0] - high]
        for part, k in ((part, k) for part in each.parts for k in following):
            across, (lowest, highest) = rectangles[k].box
            least, most = part.values[1]
            if overlap(part.values[:1], (across,)) and not lowest < least <= most < highest:
                raise Unproved("an image is not between the lower and the upper edge")
    if min(margins) <= 0:
        short = ceil_text(-min(margins))
        raise Unproved(f"an edge is not mapped beyond the rectangles: up to {short} short")
    return min(margins)


def follows(rectangles: Sequence[Rectangle], arrows: Arrows) -> bool:
    """Whether no image of a rectangle is in one to which there is no arrow."""
    return not any(
        overlap(part.values, other.box)
        for each, following in zip(rectangles, arrows, strict=True)
        for k, other in enumerate(rectangles)
        for part in each.parts
        if k not in following
    )


def read_rectangles(
    context: Context, names: Reader, least: int = 1, most: int = _MOST
) -> list[Rectangle]:
    """Read the names of rectangle steps that obey hypothesis 1 of `horseshoe`."""
    rectangles = [context.step(name, Rectangle) for name in names.items(least, most)]
    require_together(rectangles)
    return rectangles
