"""Rule: an iterate of a map that contracts a box, and the periodic orbit that attracts it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations
from typing import NamedTuple

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.conclusion import Conclusion, given
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.covers import MAX_POWER
from proofs.trusted.kernel.cycle import may_be_one
from proofs.trusted.kernel.differential import sharp_values
from proofs.trusted.kernel.enclose import (
    Box,
    Matrix,
    centre_of,
    enclosed,
    integer,
    multiply,
    point_box,
    read_box,
)
from proofs.trusted.kernel.maps import Map
from proofs.trusted.numbers import between, show_range, within

_BITS = 128


@dataclass(frozen=True)
class StableCycle(Conclusion):
    """A map takes the first of these boxes into the second one, and so on; its iterate, of as many
    steps times `rounds`, takes the first into itself, and contracts it.
    """

    function: Map
    boxes: tuple[Box, ...]
    rounds: int = 1

    @property
    def sentence(self) -> str:
        count, map_ = len(self.boxes), self.function
        first, *others = self.boxes
        boxes = ", ".join(
            [" x ".join(map(show_range, first)), *(" x ".join(map(between, box)) for box in others)]
        )
        sides = f"({' x '.join(f'`{each}`' for each in map_.variables)})"
        power = count * self.rounds
        iterate = f"{map_.name}^{power}" if power > 1 else map_.name
        return (
            f"{given(map_)}{map_.name} has a {count}-periodic orbit, a point in each of {boxes} "
            f"{sides}, in this order; {iterate} contracts the first box, so that this orbit "
            "attracts every motion with a point there."
        )

    @property
    def brief(self) -> str:
        where = f"at {self.place} " if self.place else given(self.function)
        return f"{where}{self.function.name} has a stable {len(self.boxes)}-periodic orbit"


class Followed(NamedTuple):
    """A box and its images, angles less whole periods; the derivative of the last one."""

    boxes: tuple[list[Enclosure], ...]
    derivative: Matrix


def stable_cycle(context: Context, reader: Reader) -> StableCycle:
    """Rule `stable-cycle`: {function F, box B, period k, rounds m}; n = k m.

    Hypotheses, D_i enclosing the derivative of F^i on B, C the middle of B, F^i(C) less whole
    periods of angles: B' = F^n(C) + D_n (B - C) lies in B; |D_n| r < r, r the sides of B and |D|
    the largest absolute values of entries; of B, F(B), ..., F^(k-1)(B) no two can have a point in
    common, with angles modulo their periods. If m > 1, F^k(C) + D_k (B' - C) lies in B.
    Conclusion: F has a periodic orbit of least period k, which begins in B and attracts all of B.

    Proof. By the mean value theorem F^n maps the convex B into B', and contracts it in the norm
    max |x_i| / r_i: it has one fixed point x there, by Banach, which attracts B. x is in B', so
    that F^k(x) is in B, and fixed by F^n as well: it is x. Its first k points are different.
    """
    function_of, box_of, period_of, rounds_of = reader.fields("function", "box", "period", "rounds")
    map_ = context.function(function_of)
    period, rounds = integer(period_of, 1, MAX_POWER), integer(rounds_of, 1, MAX_POWER)
    if map_.size != len(map_.variables):
        raise function_of.fail("as many values as variables are expected")
    box = read_box(box_of, map_.size)
    return StableCycle(map_, _cycle(map_, box, period, rounds), rounds)


def follow(map_: Map, x: Sequence[Enclosure], count: int) -> Followed:
    """Enclose images of a box, so many, and the derivative of the last one."""
    boxes, product = [list(x)], map_.jacobian(x)
    for k in range(count):
        if k:
            product = multiply(map_.jacobian(boxes[-1]), product)
        boxes.append(_reduced(map_, sharp_values(map_, boxes[-1])))
    return Followed(tuple(boxes), product)


def _reduced(map_: Map, x: Sequence[Enclosure], near: Sequence[Enclosure] = ()) -> list[Enclosure]:
    """Return x less whole periods of its angles: to within half a period of `near`, else about as
    many as put the lower end in [0, P).
    """
    reduced = list(x)
    for place, period in map_.periods(x[0].bits).items():
        shift = near[place].lo - period.lo // 2 if near else 0
        reduced[place] = x[place] - period * ((x[place].lo - shift) // period.lo)
    return reduced


def _cycle(map_: Map, box: Box, period: int, rounds: int) -> tuple[Box, ...]:
    """Return B, F(B), ..., F^(k-1)(B), or raise Unproved."""
    x, centre = enclosed(box, _BITS), enclosed(point_box(centre_of(box)), _BITS)
    boxes, product = follow(map_, x, period * rounds)
    middles = [centre]
    for _ in range(period * rounds):
        middles.append(_reduced(map_, sharp_values(map_, middles[-1])))
    image = _image(_reduced(map_, middles[-1], centre), product, x, centre)
    if not _inside(image, box):
        raise Unproved("the box is not mapped into itself")
    if rounds > 1:
        once = follow(map_, x, period).derivative
        if not _inside(_image(_reduced(map_, middles[period], centre), once, image, centre), box):
            raise Unproved("the period is not proved")
    radii = [high - low for low, high in box]
    for row, radius in zip(product, radii, strict=True):
        sizes = (max(map(abs, entry.range)) * r for entry, r in zip(row, radii, strict=True))
        if sum(sizes, Fraction(0)) >= radius:
            raise Unproved("the box is not contracted")
    if any(may_be_one(map_, one, two) for one, two in combinations(boxes[:period], 2)):
        raise Unproved("points of the orbit may be the same")
    return (box, *(tuple(side.range for side in each) for each in boxes[1:period]))


def _image(
    value: Sequence[Enclosure],
    matrix: Matrix,
    box: Sequence[Enclosure],
    centre: Sequence[Enclosure],
) -> list[Enclosure]:
    """Enclose value + matrix (box - centre)."""
    steps = [[a - m] for a, m in zip(box, centre, strict=True)]
    return [v + move for v, (move,) in zip(value, multiply(matrix, steps), strict=True)]


def _inside(x: Sequence[Enclosure], box: Box) -> bool:
    return all(within(side.range, ends) for side, ends in zip(x, box, strict=True))
