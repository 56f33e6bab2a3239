"""How much of the circle a map sends into an absorbing arc: exact bookkeeping. Trusted, and shared.

A phase is absorbed within n steps if one of its images under f^0, ..., f^n is in the arc.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from proofs.trusted.numbers import Range

_UNIT = 1 << 64


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


def with_gaps(cells: Sequence[Cell]) -> list[Cell]:
    """Add a cell of which nothing is known between two that do not adjoin."""
    result = list(cells[:1])
    for before, after in pairwise(cells):
        if before.phases[1] < after.phases[0]:
            result.append(Cell((before.phases[1], after.phases[0])))
        result.append(after)
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
    return met


Links = list[list[tuple[int, int]] | None]


def links(cells: Sequence[Cell]) -> Links:
    """Return for each cell the cells that its images meet, with the common lengths, rounded up.

    Lengths are in units of 2^-64. Cells in increasing order may share ends only: else ValueError.
    """
    if any(a.phases[1] > b.phases[0] for a, b in pairwise(cells)):
        raise ValueError("cells overlap or are out of order")
    return [
        None
        if cell.images is None
        else [(j, _up(common)) for image in cell.images for j, common in cells_met(cells, image)]
        for cell in cells
    ]


@dataclass(frozen=True)
class Absorbed:
    """For each cell the number of steps within which all of it is absorbed, None if unknown;
    and for n = 0, 1, ... a bound of the measure of all phases that are not absorbed within n.
    """

    steps: tuple[int | None, ...]
    rest: tuple[Fraction, ...]


def absorbed(cells: Sequence[Cell], met: Links, count: int) -> Absorbed:
    """Bound what is not absorbed within n <= count steps; met: the `links` of the cells.

    Theorem. (1) A cell whose images meet only cells that are absorbed within n - 1 steps (and the
    arc) is absorbed within n. (2) Let N_n be the phases not absorbed within n steps. In a cell
    that f maps one-to-one, with 1/|f'| <= s, the phases of N_n are sent into N_(n-1); so their
    measure is at most s times that of N_(n-1) in the image: of each cell j that this meets, at
    most the bound for cell j and at most the common length. And it is at most the cell's length.
    """
    factors = [None if cell.stretch is None else _up(cell.stretch) for cell in cells]
    lengths = [_up(cell.phases[1] - cell.phases[0]) for cell in cells]
    steps: list[int | None] = [None] * len(cells)
    bounds, rest = lengths, [sum(lengths)]
    for n in range(1, count + 1):
        reached = [linked is not None and _all_within(linked, steps) for linked in met]
        steps = [n if now and old is None else old for now, old in zip(reached, steps, strict=True)]
        rows = zip(lengths, met, factors, steps, strict=True)
        bounds = [_bound(bounds, *row) for row in rows]
        rest.append(sum(bounds))
    return Absorbed(tuple(steps), tuple(Fraction(total, _UNIT) for total in rest))


def _all_within(linked: Sequence[tuple[int, int]], steps: Sequence[int | None]) -> bool:
    return all(steps[j] is not None for j, _ in linked)


def _bound(
    bounds: Sequence[int],
    length: int,
    linked: Sequence[tuple[int, int]] | None,
    factor: int | None,
    done: int | None,
) -> int:
    """Bound what is left in one cell, from what was left in all of them a step before."""
    if done is not None:
        return 0
    if linked is None or factor is None:
        return length
    total = sum(min(bounds[j], common) for j, common in linked)
    return min(length, (total * factor >> 64) + 1)


def _up(value: Fraction) -> int:
    return -(-value.numerator * _UNIT // value.denominator)
