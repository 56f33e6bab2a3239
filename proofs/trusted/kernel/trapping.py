"""Rule: a union of boxes that a map takes into its interior, and the attractor in it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import AboutMap, given
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.differential import Image
from proofs.trusted.kernel.enclose import Box, box_text, shown
from proofs.trusted.kernel.maps import Map
from proofs.trusted.kernel.meter import METER
from proofs.trusted.numbers import Range

_MOST_IMAGES, _MOST_PARTS = 1000, 10_000
_MARGIN = Fraction(1, 2**64)  # by which images are wider, to be in the interior
_BITS = 128


@dataclass(frozen=True)
class Trapped(AboutMap):
    """A map takes the union of some boxes into its interior; sides of angles are all around."""

    function: Map
    boxes: tuple[Box, ...]

    @property
    def sentence(self) -> str:
        """Return the statement."""
        f, names = self.function.name, self.function.variables
        boxes = "; ".join(box_text(box, names) for box in self.boxes)
        what = "the box" if len(self.boxes) == 1 else f"the union of the {len(self.boxes)} boxes"
        is_ball = len(self.boxes) == 1 and not self.function.circles
        fixed = f" `{f}` has a fixed point in T." if is_ball else ""
        return (
            f"{given(self.function)}`{f}` is continuous on T, {what} {boxes}, and takes T into its "
            f"interior. So the points that are in `{f}`^n(T) for all n form a compact set K, not "
            f"empty, with `{f}`(K) = K, in the interior of T, and T comes to it: each open set "
            f"around K contains `{f}`^n(T) from some n on.{fixed}"
        )


def trapped(images: Sequence[Image]) -> Trapped:
    """Theorem. Let F be a map, defined and continuous on the boxes of the images, to points of the
    same variables, T their union, each of the bounds, a little wider, a part of T; if a variable is
    an angle, let all boxes be at least a period long in it. Then what `Trapped.sentence` says.

    Proof. F takes T into its interior. The sets F^n(T) are compact, not empty, and each contains
    the next one, F^(n+1)(T) = F^n(F(T)) in F^n(T); so is their intersection K, in F(T). F(K) = K:
    a point y of K has preimages in each F^n(T), compact sets one in the other, so one in K; and
    F(K) is in F^(n+1)(T) for all n. Were F^n(T) never in an open set around K, the compact parts of
    the F^n(T) outside of it would have a point in common, in K. T is convex if it is one box, and
    then F has a fixed point (Brouwer). An angle may be any one: T and its interior know no other.
    """
    function = images[0].function
    boxes = tuple(each.box for each in images)
    if any(each.function is not function for each in images):
        raise Unproved("the images are those of different maps")
    if function.size != len(function.variables):
        raise Unproved("a map from points to points of the same variables is expected")
    for place, period in function.periods(_BITS).items():
        if any(box[place][1] - box[place][0] < period.range[1] for box in boxes):
            raise Unproved("a side that is an angle is not proved to reach all around")
    union = [sides_of(function, box) for box in boxes]
    for each in images:
        image = tuple((a - _MARGIN, b + _MARGIN) for a, b in sides_of(function, each.bounds))
        if left := outside(image, union):
            raise Unproved(
                f"an image is not proved inside the boxes: {shown(left[0])} may be in it"
            )
    return Trapped(function, boxes)


def sides_of(function: Map, box: Box) -> Box:
    """Return the sides of a box that are no angles."""
    angles = {circle.place for circle in function.circles}
    return tuple(side for i, side in enumerate(box) if i not in angles)


def outside(box: Box, union: Sequence[Box]) -> list[Box]:
    """Return boxes whose union contains what is in a box, and in none of others."""
    rest = [box]
    for other in union:
        METER.get().spend(4 * len(rest) * len(box))
        rest = [part for each in rest for part in _less(each, other)]
        if len(rest) > _MOST_PARTS:
            raise Unproved("an image that is cut into too many parts")
    return rest


def _less(box: Box, other: Box) -> list[Box]:
    """Return parts of a box that have no interior in common, and contain what another has not."""
    if any(high < a or b < low for (low, high), (a, b) in zip(box, other, strict=True)):
        return [box]
    parts, inner = list[Box](), box
    for i, (low, high) in enumerate(other):
        a, b = inner[i]
        if a < low:
            parts.append(_with(inner, i, (a, low)))
        if high < b:
            parts.append(_with(inner, i, (high, b)))
        inner = _with(inner, i, (max(a, low), min(b, high)))
    return parts


def _with(box: Box, axis: int, side: Range) -> Box:
    return (*box[:axis], side, *box[axis + 1 :])


def trapping(context: Context, reader: Reader) -> Trapped:
    """Rule `trapping`: {images: steps `image` of one map}. Conclusion: `trapped`."""
    (images_of,) = reader.fields("images")
    return trapped([context.step(name, Image) for name in images_of.items(1, _MOST_IMAGES)])
