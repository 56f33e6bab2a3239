"""Boxes whose images a map takes into the interior of their union: steps `image`, `trapping`."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import product

import numpy as np

from intervals import Undecided
from proofs.methods.derivation import Derivation
from proofs.methods.divisions import Tree, holds, image_of, scale_of, subdivide
from proofs.methods.lemmas import undecided
from proofs.methods.newton import seeds
from proofs.methods.sampling import Floats, Sampled
from proofs.trusted.certificate import texts
from proofs.trusted.kernel.arithmetic import Enclosure
from proofs.trusted.kernel.enclose import Box
from proofs.trusted.kernel.maps import Map
from proofs.trusted.kernel.trapping import outside, sides_of
from proofs.trusted.numbers import Range, ceil_text, floor_text, hull

_MOST_BOXES = 1000  # of a tree
_DIGITS, _BITS = 12, 128  # of bounds; of an image that is asked for
_SEEN = 200  # points at random that are looked at where images are not proved to be inside


def prove_image(file: Derivation, function: str, box: Box) -> str:
    """Add bounds on the image of a box; raises Undecided."""
    with undecided():
        tree, image = image_of(file.map(function), box, _BITS)
        return _add(file, function, box, tree, [*map(_rounded, image)])


def prove_trapping(file: Derivation, function: str, boxes: Sequence[Box]) -> str:
    """Add the images of boxes, and that their union holds them; raises Undecided."""
    map_ = file.map(function)
    with undecided():
        images = [_add(file, function, box, *_image(map_, box, boxes)) for box in boxes]
        return file.add("trapping", {"images": images})


def _add(file: Derivation, function: str, box: Box, tree: Tree, bounds: Sequence[Range]) -> str:
    witness = {"function": function, "box": list(map(texts, box)), "tree": tree}
    return file.add("image", {**witness, "bounds": list(map(texts, bounds))})


def _image(map_: Map, box: Box, union: Sequence[Box]) -> tuple[Tree, Box]:
    """Return bounds on the image of a box, and a tree of parts whose images lie in the union."""
    images: list[Box] = []

    def inside(values: list[Enclosure]) -> bool:
        image = tuple(_rounded(value.range) for value in values)
        is_inside = not outside(sides_of(map_, image), [sides_of(map_, each) for each in union])
        if is_inside:
            images.append(image)
        return is_inside

    try:
        scale = scale_of(map_, box)
        tree = subdivide(box, lambda part: holds(map_, part, inside), scale, _MOST_BOXES)
    except Undecided as error:
        raise Undecided(_leaving(map_, box, union) or f"images may be outside: {error}") from None
    return tree, tuple(map(hull, zip(*images, strict=True)))


def _leaving(map_: Map, box: Box, union: Sequence[Box]) -> str:
    """Say which point of a box is seen to leave the union, if one is; not proved."""
    sampled, corners = Sampled(map_), np.array([*product(*box)], float).T
    points = np.concatenate([corners, seeds(sampled, box, _SEEN, 0)], axis=1)
    for point, image in zip(points.T, sampled(points).T, strict=True):
        place = tuple((Fraction(x), Fraction(x)) for x in image) if np.isfinite(image).all() else ()
        if not place:
            return f"no image of {_shown(point)} is seen"
        if outside(sides_of(map_, place), [sides_of(map_, each) for each in union]):
            return f"{_shown(point)} is seen to go to {_shown(image)}, outside"
    return ""


def _shown(point: Floats) -> str:
    return f"({', '.join(f'{value:.6g}' for value in point)})"


def _rounded(values: Range) -> Range:
    return Fraction(floor_text(values[0], _DIGITS)), Fraction(ceil_text(values[1], _DIGITS))
