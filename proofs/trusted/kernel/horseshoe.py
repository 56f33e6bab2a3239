"""Rule: rectangles that a map of the plane takes across each other, and what orbits follow them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion, given
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.enclose import Box, integer
from proofs.trusted.kernel.maps import Map
from proofs.trusted.kernel.meter import METER
from proofs.trusted.kernel.rates import Cone, Rates, rates
from proofs.trusted.kernel.rectangles import Arrows, Rectangle, crossing, follows, read_rectangles
from proofs.trusted.kernel.words import BarredWord, never_ends
from proofs.trusted.numbers import floor_text, increasing, show_range

_MOST = 64  # rectangles


@dataclass(frozen=True)
class Horseshoe(Conclusion):
    """A map takes rectangles across those that follow, edges at least `margin` beyond.

    arrows: from each to these. is_rising: whether in all of them the images' x increases with x.
    is_complete: whether no image of a rectangle is in one to which there is no arrow. wider: other
    rectangles that contain them, in the union of which full orbits follow the arrows, too.
    """

    function: Map
    boxes: tuple[Box, ...]
    arrows: tuple[tuple[int, ...], ...]
    margin: Fraction
    rates: Rates
    is_rising: bool
    is_complete: bool
    wider: tuple[Box, ...] = ()

    @property
    def sentence(self) -> str:
        """Return the statement."""
        name, (x, y) = self.function.name, self.function.variables
        boxes = ", ".join(
            f"V{i} = {' x '.join(map(show_range, box))}" for i, box in enumerate(self.boxes, 1)
        )
        arrows = ", ".join(
            f"V{i} => V{j + 1}" for i, each in enumerate(self.arrows, 1) for j in each
        )
        all_of_them = " Full orbits in their union follow the arrows." if self.is_complete else ""
        if self.wider:
            union = " and ".join(" x ".join(map(show_range, box)) for box in self.wider)
            all_of_them += f" Full orbits in the union of {union} stay in them, and do so."
        return (
            f"{given(self.function)}let {boxes} (closed, `{x}` x `{y}`). `{name}` is continuously "
            f"differentiable on them and takes them across each other: {arrows}; edges overshoot "
            f"by at least {floor_text(self.margin)}. Each bi-infinite path of these arrows is "
            "followed by exactly one full orbit; the points of these orbits are a compact set in "
            f"the open rectangles, on which `{name}` is {self.rates.said(x, y)}, and semiconjugate "
            "to the two-sided shift on paths; conjugate, where it is one-to-one."
            f"{all_of_them}"
        )


def horseshoe(context: Context, reader: Reader) -> Horseshoe:
    """Rule `horseshoe`: {rectangles N_1, ..., N_n: names, arrows: for each those that follow, by
    increasing numbers, cone: [slope, width]}, and if given wider: {rectangles M_1, ..., M_n,
    words}.

    Hypotheses: 1. All are about one map F; they are disjoint; in each the image's x is monotone in
    x, and images do not reach around the circle of an angle x. 2. Of each N_i the left edge goes to
    the left and the right edge to the right of all next N_j, or the other way around where images
    decrease; images of parts of N_i that may have an x of a next N_j have a y in the interior of
    that of N_j. 3. The inequalities of `rates`.

    Conclusion: each bi-infinite path of arrows is followed by exactly one full orbit x_(n+1) =
    F(x_n). The points of these orbits are compact, in the interiors of the N_i, and hyperbolic; if
    F is one-to-one there, it is conjugate to the two-sided shift on paths. If no image of a part is
    in an N_j to which there is no arrow, all full orbits in the union of the N_i follow paths.
    All full orbits in the union of the M_i do, by the theorem `around`.

    Proof. 1. Call a compact connected part of N_i that meets its left and its right edge a crossing
    set, as N_i is itself. By 2 its image, connected, reaches beyond each next N_j on both sides,
    and where it has an x of N_j, it has a y of N_j: so it contains a crossing set of N_j (boundary
    bumping). So finite paths are followed, by compactness all. 2. Let z_n be the differences of two
    orbits of one path, both in the same rectangle for each n; z_(n+1) is D times z_n, D a mean of
    the derivative. Were one z_n != 0 in the cone, then all after it, by (1) of `rates`, and they
    would grow without bound. So all z_n != 0 are outside, and by (2) |v| of z_n is at most
    contraction^k times that of z_(n-k), for all k: z_n = 0. No arrow leads from an edge, and each
    point is an image: by hypothesis 2 its y is in the interior. 3. The path of an orbit is a
    continuous function of its point, as the rectangles are disjoint, and one-to-one where the point
    has one past. See Gidea and Zgliczynski, Covering relations for multidimensional dynamical
    systems, J. Differential Equations 202 (2004).
    """
    METER.get().spend(2000)  # all in fractions, which nobody counts
    more = ("wider",) if reader.has("wider") else ()
    names, arrows_of, cone_of, *wider_of = reader.fields("rectangles", "arrows", "cone", *more)
    rectangles = read_rectangles(context, names)
    count = len(rectangles)
    arrows = tuple(
        tuple(integer(each, 1, count) - 1 for each in row.items(1, count))
        for row in arrows_of.items(count, count)
    )
    if not all(map(increasing, arrows)):
        raise arrows_of.fail("the numbers of those that follow one do not increase")
    parts = [part for each in rectangles for part in each.parts]
    METER.get().spend(4 * count * len(parts))
    return Horseshoe(
        rectangles[0].function,
        tuple(each.box for each in rectangles),
        arrows,
        crossing(rectangles, arrows),
        rates(parts, Cone(*cone_of.numbers(2, 2))),
        min(each.sign for each in rectangles) > 0,
        follows(rectangles, arrows),
        around(rectangles, arrows, *_read_wider(context, wider_of[0])) if more else (),
    )


def _read_wider(context: Context, reader: Reader) -> tuple[list[Rectangle], list[BarredWord]]:
    names, words_of = reader.fields("rectangles", "words")
    words = [context.step(name, BarredWord) for name in words_of.items(0, _MOST)]
    return read_rectangles(context, names), words


def around(
    inner: Sequence[Rectangle],
    arrows: Arrows,
    outer: Sequence[Rectangle],
    words: Sequence[BarredWord],
) -> tuple[Box, ...]:
    """Return the wider rectangles, of which full orbits are in the inner ones, along the arrows.

    Theorem. Let N_i be M_i, or a part of it with the same left edge, sides in y and turns, the
    image's x increasing on both, the right edge of N_i going to the right of all M_j to which there
    is an arrow. Let each word of some length in the numbers of the M_i that ends in i j, where
    there is no arrow, contain a barred word of the M_i. Then full orbits in their union are in the
    N_i, and follow the arrows.
    Proof. 1. A full orbit follows no barred word, so no i j without an arrow. 2. If x_n is in M_i,
    beside N_i, its image's x is greater than that of the right edge of N_i, thus than all of M_j:
    the images do not reach around the circle of an angle, as for the rule. So x_n is in N_i.
    """
    boxes = tuple(each.box for each in outer)
    function = inner[0].function
    if len(outer) != len(inner) or any(each.function != function for each in outer):
        raise Unproved("wider rectangles are one for each, and about the same map")
    if any(word.function != function or word.boxes != boxes for word in words):
        raise Unproved("words are about other rectangles, or another map")
    for part, whole, following in zip(inner, outer, arrows, strict=True):
        (low, high), (first, last) = part.box[0], whole.box[0]
        if low != first or high > last or (part.turns, part.box[1]) != (whole.turns, whole.box[1]):
            raise Unproved("a rectangle is no part of the wider one with the same left edge")
        if min(part.sign, whole.sign) < 0:
            raise Unproved("images are not proved to increase")
        if high < last and part.reach[1][0] <= max(boxes[j][0][1] for j in following):
            raise Unproved("an edge is not mapped beyond the wider rectangles")
    count = len(outer)
    for i, j in product(range(count), repeat=2):
        if j not in arrows[i] and not never_ends([x.word for x in words], (i, j), count):
            raise Unproved(f"a step from {i + 1} to {j + 1} is not excluded")
    return boxes
