"""How boxes are divided until what a map does on their parts is seen."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from fractions import Fraction
from itertools import islice
from typing import Any

from intervals import Undecided
from intervals.cover import halves
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.covers import LocalMap
from proofs.trusted.kernel.differential import sharp_values
from proofs.trusted.kernel.enclose import Box, Differentiable, attempts, enclosed
from proofs.trusted.kernel.flow import Flow
from proofs.trusted.kernel.maps import Map

_MOST_BOXES = 10_000
_DEEPEST = 40
_BITS = 64
_HALVINGS = 6  # of a box for its image
_STRIPS, _LEAST = 16, Fraction(1, 2**20)
Tree = list[Any] | None


def subdivide(
    box: Box, decided: Callable[[Box], bool], scale: Box | None = None, most: int = _MOST_BOXES
) -> Tree:
    """Return a tree whose leaves are all decided: undecided boxes are halved, longest side first.

    Sides are compared as parts of those of `scale`, the box itself where none is given. Raises
    Undecided if that does not end.
    """
    left = [most]

    def divide(part: Box, depth: int) -> Tree:
        left[0] -= 1
        if left[0] < 0 or depth > _DEEPEST:
            raise Undecided(f"{most} boxes, divided {_DEEPEST} times, do not suffice")
        if decided(part):
            return None
        axis, *sides = halved(part, scale or box)
        cut = sides[0][axis][1]
        return [str(axis + 1), str(cut), *(divide(side, depth + 1) for side in sides)]

    return divide(box, 0)


def halved(box: Box, scale: Box) -> tuple[int, Box, Box]:
    """Return the place of the side that is longest as a part of a scale's, and both halves of it.

    Undecided where the box is a point.
    """
    lengths = shares(box, scale)
    axis = lengths.index(max(lengths))
    if not lengths[axis]:
        raise Undecided("not decided at a point")
    lower, upper = ((*box[:axis], half, *box[axis + 1 :]) for half in halves(box[axis]))
    return axis, lower, upper


def shares(box: Box, scale: Box) -> list[Fraction]:
    """Return the sides of a box as parts of those of a scale, where these are no points."""
    return [(b - a) / (d - c or 1) for (a, b), (c, d) in zip(box, scale, strict=True)]


def holds(map_: Differentiable, box: Box, test: Callable[[list[Enclosure]], bool]) -> bool:
    """Whether some enclosure of a map on a box, in numbers of few bits, has a property."""
    plain: Any = map_.map if isinstance(map_, LocalMap) else map_
    ways = 1 if isinstance(plain, Flow) else 2  # a flow's values have the mean value form
    try:
        return any(test(values) for values in islice(attempts(map_, box, (_BITS,)), ways))
    except Unproved:
        return False


def scale_of(map_: Differentiable, box: Box) -> Box:
    """Return sides whose images are enclosed about equally widely, to halve parts of a box by.

    A map from points to points of the same variables. Widths are parts of the sides of the box.
    """
    try:
        return _scale(map_, box, _STRIPS)
    except Unproved:
        return _scale(map_, box, _STRIPS**2)


def _scale(map_: Differentiable, box: Box, strips: int) -> Box:
    units, sides = list[tuple[Fraction, Fraction]](), [high - low for low, high in box]
    for j, side in enumerate(sides):
        reach = [side / (2 * strips) * (k == j) for k in range(len(box))]
        middles = [(low + high) / 2 for low, high in box]
        strip = tuple((m - r, m + r) for m, r in zip(middles, reach, strict=True))
        ranges = [value.range for value in map_.values(enclosed(strip, _BITS))]
        widths = [(b - a) / whole for (a, b), whole in zip(ranges, sides, strict=True) if whole]
        units.append((Fraction(0), side / max(*widths, _LEAST)))
    return tuple(units)


def image_of(map_: Map, box: Box, bits: int) -> tuple[Tree, Box]:
    """Return a tree of parts of a box, and bounds of the values on all of them.

    A box of two and more sides, and of a flow, has fewer parts a side. Raises Unproved.
    """
    wide, images = sum(low < high for low, high in box), list[list[Enclosure]]()
    least = Fraction(1, 2 ** (0 if isinstance(map_, Flow) else _HALVINGS // max(wide, 1)))

    def is_small(part: Box) -> bool:
        if max(shares(part, box), default=0) > least:
            return False
        images.append(_sharp(map_, enclosed(part, bits)))
        return True

    tree = subdivide(box, is_small)
    ranges = [[value.range for value in values] for values in zip(*images, strict=True)]
    return tree, tuple((min(a for a, _ in each), max(b for _, b in each)) for each in ranges)


def _sharp(map_: Map, x: list[Enclosure]) -> list[Enclosure]:
    with suppress(Unproved):
        return sharp_values(map_, x)
    return map_.values(x)
