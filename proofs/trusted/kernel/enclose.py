"""What rules about formulas compute with: enclosures on boxes and on their parts.

Precision adapts: 64 bits first, then twice as many while a question is undecided."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from typing import NamedTuple, Protocol, TypeVar

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Enclosure, Futile, Unproved
from proofs.trusted.kernel.meter import METER
from proofs.trusted.numbers import Range, show, show_range

PRECISIONS = (64, 128, 256, 512, 1024, 2048, 4096)
_MAX_DEPTH = 60
_LONGEST = 300  # characters of a box in a message

Box = tuple[Range, ...]
T = TypeVar("T")


class Circle(NamedTuple):
    """An angle, by its place among the variables; its period, on a tape and as it is written.

    With the period go the values of the parameters in it.
    """

    place: int
    root: int
    period: tuple[str, ...]


def size(value: Fraction) -> int:
    """Return the bits of a rational's longer part."""
    return max(value.numerator.bit_length(), value.denominator.bit_length())


Matrix = list[list[Enclosure]]


class Differentiable(Protocol):
    """A differentiable map on boxes: enclosures of its values and of its partial derivatives."""

    def values(self, x: Sequence[Enclosure]) -> list[Enclosure]:
        """Enclose the values; Unproved where the map is not proved defined on the whole box."""

    def jacobian(self, x: Sequence[Enclosure]) -> Matrix:
        """Enclose the partial derivatives, a row a component."""


def enclosed(box: Box, bits: int) -> list[Enclosure]:
    """Enclose each side of a box."""
    METER.get().spend(len(box) + (sum(size(end) for side in box for end in side) >> 8))
    return [Enclosure.of(low, high, bits) for low, high in box]


def centre_of(box: Box) -> tuple[Fraction, ...]:
    """Return the midpoint."""
    return tuple((low + high) / 2 for low, high in box)


def point_box(point: Sequence[Fraction]) -> Box:
    """Return the box of one point."""
    return tuple((value, value) for value in point)


def tried(compute: Callable[[int], T], precisions: Sequence[int] = PRECISIONS) -> Iterator[T]:
    """Compute something at better and better precisions, where it is defined, while asked.

    Futile where nothing could be computed, and more digits would not help.
    """
    is_computed = False
    for bits in precisions:
        try:
            result = compute(bits)
        except Futile:
            if not is_computed:
                raise
            return
        except Unproved:
            continue
        is_computed = True
        yield result


def attempts(
    map_: Differentiable, box: Box, precisions: Sequence[int] = PRECISIONS
) -> Iterator[list[Enclosure]]:
    """Enclose the map on a box in better and better ways, as long as the caller asks.

    At each precision the natural form, then its intersection with the mean value form: on a box
    X that contains m, f(x) lies in f(m) + f'(X) (X - m). Both contain the values, so they meet.
    It ends where more digits no longer help.
    """
    before: list[Enclosure] = []
    for bits in precisions:
        x = enclosed(box, bits)
        try:
            natural = map_.values(x)
            yield natural
            values = list(map(Enclosure.meet, natural, mean_value_form(map_, x)))
            yield values
        except Futile:
            if not before:
                raise
            return
        except Unproved:
            continue
        if before and not is_narrower(values, before):
            return
        before = values


def is_narrower(values: Sequence[Enclosure], before: Sequence[Enclosure]) -> bool:
    """Whether the widest of some enclosures is at most half as wide as before, in fewer bits."""
    now, then = (max(x.hi - x.lo for x in each) for each in (values, before))
    return 2 * now <= then << (values[0].bits - before[0].bits)


def mean_value_form(map_: Differentiable, x: Sequence[Enclosure]) -> list[Enclosure]:
    """Enclose f(m) + f'(X) (X - m), m the middle of X; a map of parameters may know better."""
    own: Callable[..., list[Enclosure]] | None = getattr(map_, "mean_value_form", None)
    if own is not None:
        return own(x)
    centre = [Enclosure(m := (a.lo + a.hi) >> 1, m, a.bits) for a in x]
    steps = [a - m for a, m in zip(x, centre, strict=True)]
    rows = zip(map_.values(centre), map_.jacobian(x), strict=True)
    return [add(value, row, steps) for value, row in rows]


def add(value: Enclosure, row: Sequence[Enclosure], column: Sequence[Enclosure]) -> Enclosure:
    """Enclose value + row . column."""
    return sum((a * b for a, b in zip(row, column, strict=True)), value)


def multiply(a: Matrix, b: Matrix) -> Matrix:
    """Enclose a product of matrices."""
    columns = list(zip(*b, strict=True))
    return [[add(a[0][0] * 0, row, column) for column in columns] for row in a]


def decide(map_: Differentiable, box: Box, holds: Callable[[list[Enclosure]], bool]) -> None:
    """Prove that some enclosures of the map on the box have a property, or raise Unproved."""
    if not any(holds(values) for values in attempts(map_, box)):
        raise Unproved(f"not proved on {shown(box)}")


def sign_on(map_: Differentiable, box: Box) -> int:
    """Return the strict sign of a function on a box, or raise Unproved."""
    for (value,) in attempts(map_, box):
        if value.lo > 0 or value.hi < 0:
            return 1 if value.lo > 0 else -1
    raise Unproved(f"the sign is not decided on {shown(box)}")


def leaves(tree: Reader, box: Box) -> Iterator[Box]:
    """Iterate over the leaves of a subdivision tree, which cover the box.

    A tree is null, the box itself, or [axis, cut, left, right]: the parts where the coordinate of
    that number (from 1) is <= cut and >= cut, each divided by a tree of its own.
    """
    waiting = [(tree, box, 0)]
    while waiting:
        node, part, depth = waiting.pop()
        if node.is_null():
            yield part
            continue
        if depth == _MAX_DEPTH:
            raise node.fail(f"a tree more than {_MAX_DEPTH} deep")
        axis_of, cut_of, left, right = node.items(4, 4)
        axis, cut = integer(axis_of, 1, len(box)) - 1, cut_of.number()
        low, high = part[axis]
        if not low < cut < high:
            raise cut_of.fail("the cut is not inside")
        for side, ends in ((right, (cut, high)), (left, (low, cut))):
            waiting.append((side, (*part[:axis], ends, *part[axis + 1 :]), depth + 1))


def read_box(reader: Reader, dimension: int) -> Box:
    """Read a closed box with exact ends; a side may be a point."""
    return tuple(side.range() for side in reader.items(dimension, dimension))


def integer(reader: Reader, least: int, most: int) -> int:
    """Read an integer."""
    value = reader.number()
    if value.denominator != 1 or not least <= value <= most:
        raise reader.fail(f"an integer from {least} to {most} is expected")
    return int(value)


def shown(box: Sequence[Range]) -> str:
    """Write a box for a message, in a line of bounded length."""
    return box_text(box)[:_LONGEST]


def box_text(box: Sequence[Range], variables: Sequence[str] = ()) -> str:
    """Write a box: `x` = 1/2, `y` in [0, 1]; without names [1/2, 1/2] x [0, 1]."""
    if not variables:
        return " x ".join(map(show_range, box))
    return ", ".join(
        f"`{name}` = {show(ends[0])}" if ends[0] == ends[1] else f"`{name}` in {show_range(ends)}"
        for name, ends in zip(variables, box, strict=True)
    )
