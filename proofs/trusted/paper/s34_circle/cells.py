"""How much of a circle a map sends into an arc: exact bookkeeping with cells.

A phase is absorbed within n steps if one of its images under f^0, ..., f^n is in the arc. Special,
beside the covering graphs of the kernel: what counts is the measure of what is sent on, so the
lengths of the common parts of images and thousands of cells, followed over a hundred steps; in
whole numbers, since enclosures would take minutes.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import NamedTuple

from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.meter import METER
from proofs.trusted.numbers import Range

_UNIT = 1 << 64
_ZERO = Fraction(0)


@dataclass(frozen=True)
class Cell:
    """A closed interval of phases, and what is known of f there.

    images: closed intervals that hold all images, None where nothing is known. stretch: a bound
    of 1/|f'| where f is differentiable and one-to-one on the cell, None elsewhere. The cells,
    with the arc, cover the circle; they lie on one line on which each image is an interval.
    """

    phases: Range
    images: tuple[Range, ...] | None = None
    stretch: Fraction | None = None


def in_order(cells: Sequence[Cell]) -> list[Cell]:
    """Sort cells, and add one of which nothing is known between two that do not adjoin.

    Raises Unproved where cells share more than an end.
    """
    result: list[Cell] = []
    for cell in sorted(cells, key=lambda cell: cell.phases):
        end = result[-1].phases[1] if result else cell.phases[0]
        if end > cell.phases[0]:
            raise Unproved("cells overlap")
        if end < cell.phases[0]:
            result.append(Cell((end, cell.phases[0])))
        result.append(cell)
    return result


def cells_met(cells: Sequence[Cell], image: Range) -> list[tuple[int, Fraction]]:
    """Return which of the ordered cells an interval meets, and the lengths in common."""
    met = []
    index = max(0, bisect_right(cells, image[0], key=lambda cell: cell.phases[0]) - 1)
    while index < len(cells) and cells[index].phases[0] <= image[1]:
        low, high = cells[index].phases
        if high >= image[0]:
            met.append((index, min(high, image[1]) - max(low, image[0])))
        index += 1
    METER.get().spend(8 * len(met))
    return met


class Absorbed(NamedTuple):
    """For each cell the number of steps within which all of it is absorbed, None if unknown;
    and for n = 0, 1, ... a bound of the measure of all phases that are not absorbed within n.
    """

    steps: Sequence[int | None]
    rest: Sequence[Fraction]


def absorbed(cells: Sequence[Cell], count: int) -> Absorbed:
    """Bound what is not absorbed within n <= count steps, for cells that are `in_order`.

    Theorem. (1) A cell whose images meet only cells that are absorbed within n - 1 steps (and the
    arc) is absorbed within n. (2) Let N_n be the phases not absorbed within n steps. In a cell
    that f maps one-to-one, with 1/|f'| <= s, the phases of N_n are sent into N_(n-1); so their
    measure is at most s times that of N_(n-1) in the image: of each cell j that this meets, at
    most the bound for cell j and at most the common length. And it is at most the cell's length.
    """
    links = [
        None
        if cell.images is None
        else [(j, _up(common)) for image in cell.images for j, common in cells_met(cells, image)]
        for cell in cells
    ]
    factors = [None if None in (x.images, x.stretch) else _up(x.stretch or _ZERO) for x in cells]
    lengths = [_up(cell.phases[1] - cell.phases[0]) for cell in cells]
    steps: list[int | None] = [None] * len(cells)
    bounds, rest = lengths, [sum(lengths)]
    for n in range(1, count + 1):
        METER.get().spend(sum(1 + len(met or ()) for met in links))
        steps = [
            old or (n if met is not None and all(steps[j] for j, _ in met) else None)
            for old, met in zip(steps, links, strict=True)
        ]
        sent = [sum(min(bounds[j], common) for j, common in met or ()) for met in links]
        bounds = [
            0 if done else length if factor is None else min(length, (total * factor >> 64) + 1)
            for done, length, factor, total in zip(steps, lengths, factors, sent, strict=True)
        ]
        rest.append(sum(bounds))
    return Absorbed(steps, [Fraction(total, _UNIT) for total in rest])


def _up(value: Fraction) -> int:
    """Round up, in units of 2^-64."""
    return -(-value.numerator * _UNIT // value.denominator)
