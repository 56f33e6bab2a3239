"""What a map of a circle sends where: cells of phases, followed over many steps.

Special, beside the covering graphs of the kernel: what counts is the measure of what is sent on, so
how dense each part of an image is, for thousands of cells, over a hundred steps. In whole numbers,
units of 2^-64, rounded outward, since enclosures would take minutes.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise, repeat
from operator import mul, sub
from typing import NamedTuple, Self

from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.meter import METER
from proofs.trusted.numbers import Range

_BITS = 64
_UNIT = 1 << _BITS
_LEAST_GAIN = _UNIT >> 24  # of a sweep that is followed by another one
_Units = tuple[int, int]


def _outward(bounds: Range) -> _Units:
    low, high = bounds
    return low.numerator * _UNIT // low.denominator, -(-high.numerator * _UNIT // high.denominator)


class Inverse(NamedTuple):
    """The inverse X of a map that is one-to-one on a cell, in units of 2^-64.

    images: brackets of the ends of the cell's image; ends: bounds of |X'| there; bend: bounds of
    the derivative of |X'| on the image.
    """

    images: tuple[_Units, _Units]
    ends: tuple[_Units, _Units]
    bend: _Units

    @classmethod
    def of(cls, images: Sequence[Range], ends: Sequence[Range], bend: Range) -> Self:
        """Round what is known of X outward; the lower end of the image comes first."""
        (u, v), (low, high) = map(_outward, images), map(_outward, ends)
        return cls((u, v), (low, high), _outward(bend))

    def density(self, low: int, high: int) -> _Units:
        """Bound |X'| on a part of the image: by the mean value theorem, from both its ends."""
        (first, last), (down, up) = self.images, self.bend
        from_first = max(0, low - first[1]), high - first[0]
        to_last = max(0, last[0] - high), last[1] - low
        least = min(down * x for x in from_first), min(-up * x for x in to_last)
        most = max(up * x for x in from_first), max(-down * x for x in to_last)
        return (
            max(
                0,
                *(end[0] + (change >> _BITS) for end, change in zip(self.ends, least, strict=True)),
            ),
            min(end[1] - (-change >> _BITS) for end, change in zip(self.ends, most, strict=True)),
        )


@dataclass(frozen=True)
class Cell:
    """A closed interval of phases, and what is known of f there.

    images: closed intervals that hold all images; None where nothing is known. inverses: where f is
    one-to-one on the cell, one for each of the images, which then is the whole image, less a
    multiple of 2 pi. The cells cover the circle, laid out on a line.
    """

    phases: Range
    images: tuple[Range, ...] | None = None
    inverses: tuple[Inverse, ...] | None = None


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


class _Links(NamedTuple):
    """The cells first, ..., last - 1 that an image meets: bounds of |X'|, above and below, on the
    part in common with each. partial: the place of each cell that may not be in the image, and
    bounds of the lengths of the part in common, and of the rest of it.
    """

    first: int
    last: int
    dense: list[int]
    sparse: list[int]
    partial: list[tuple[int, int, int]]

    def most(self, left: list[int]) -> int:
        """Bound, in units of 2^-128, what is sent into a set, by what is in it of each cell."""
        inside = left[self.first : self.last]
        for place, common, _ in self.partial:
            inside[place] = min(inside[place], common)
        return sum(map(mul, self.dense, inside))

    def least(self, held: list[int]) -> int:
        """Do the same from below; each cell may be a unit longer, its ends being rounded down."""
        inside = held[self.first : self.last]
        for place, _, missed in self.partial:
            inside[place] = max(0, inside[place] - missed)
        return int(sum(map(mul, self.sparse, inside))) - sum(self.sparse)


def _links(marks: Sequence[int], image: _Units, inverse: Inverse | None) -> _Links:
    """Find what an image meets; marks: the ends of the cells, rounded down."""
    low, high = image[0] - 1, image[1] + 1
    first = max(0, bisect_left(marks, low) - 1)
    last = min(len(marks) - 1, bisect_right(marks, high))
    found = _Links(first, last, [], [], [])
    METER.get().spend(4 + 12 * (last - first))
    if inverse is None:
        return found
    inner = inverse.images[0][1], inverse.images[1][0]
    for place, (left, right) in enumerate(pairwise(marks[first : last + 1])):
        begin, end = max(low, left), min(high, right)
        least, most = inverse.density(begin, end + 1)  # the cell may end within a unit after
        found.dense.append(most)
        found.sparse.append(least)
        if left < inner[0] or inner[1] < right:
            held = max(0, min(end, inner[1]) - max(begin, inner[0]))
            found.partial.append((place, end - begin + 2, right - left - held))
    return found


class Absorbed(NamedTuple):
    """For each cell the number of steps within which all of it is absorbed, None if unknown; for
    n = 0, 1, ... a bound of the measure of all phases that are not absorbed within n; such a bound
    of the phases that within all these steps are neither absorbed nor come to the sink; and a lower
    bound of the measure of those that come to the sink, sooner or later.
    """

    steps: Sequence[int | None]
    rest: Sequence[Fraction]
    open: Fraction
    sunk: Fraction


def absorbed(
    cells: Sequence[Cell], count: int, arc: int | None = None, sink: int | None = None
) -> Absorbed:
    """Follow phases until they are absorbed by the cell `arc`, or are in the cell `sink`.

    For cells that are `in_order`, and n <= count steps; all images lie in cells.

    Theorem. (1) A cell whose images meet only cells that are absorbed within n - 1 steps is
    absorbed within n. (2) Let N_n be the phases that within n steps come to none of some cells. In
    a cell that f maps one-to-one, with the inverse X, the phases of N_n are sent into N_(n-1): so
    their measure is the integral of |X'| over N_(n-1) in the image; over what is there of a cell j
    that is at most the maximum of |X'| times the bound for cell j, and times the common length. And
    it is at most the cell's length. (3) See `_sunk`.
    """
    ends = [cell.phases[0] for cell in cells] + [cells[-1].phases[1]]
    marks = [_outward((end, end))[0] for end in ends]
    lengths = [high - low + 1 for low, high in pairwise(marks)]
    links = [_links_of(marks, cell) for cell in cells]
    steps = _steps(cells, links, count, arc)
    moving = [i for i, cell in enumerate(cells) if cell.inverses and i not in (arc, sink)]
    rest = _left(lengths, links, moving, steps, count)
    lost, sunk = rest[-1], 0
    if sink is not None:
        lost = _left([*lengths[:sink], 0, *lengths[sink + 1 :]], links, moving, steps, count)[-1]
        sunk = _sunk(lengths, links, [i for i in moving if steps[i] is None], sink)
    units = [Fraction(total, _UNIT) for total in (*rest, lost, sunk)]
    return Absorbed(steps, units[:-2], units[-2], units[-1])


def _steps(
    cells: Sequence[Cell], links: Sequence[Sequence[_Links]], count: int, arc: int | None
) -> list[int | None]:
    """Return within how many steps all of each cell is absorbed, None if not within count."""
    steps: list[int | None] = [0 if i == arc else None for i in range(len(cells))]
    for n in range(1, count + 1):
        METER.get().spend(len(cells))
        found = [
            n if known is None and _all_known(steps, met, cell) else known
            for known, met, cell in zip(steps, links, cells, strict=True)
        ]
        if found == steps:
            break
        steps = found
    return steps


def _left(
    lengths: Sequence[int],
    links: Sequence[Sequence[_Links]],
    moving: Sequence[int],
    steps: Sequence[int | None],
    count: int,
) -> list[int]:
    """Bound what is left after 0, 1, ..., count steps of cells with these lengths."""
    left = [0 if known == 0 else length for length, known in zip(lengths, steps, strict=True)]
    rest = [sum(left)]
    for n in range(1, count + 1):
        METER.get().spend(_work(links, moving))
        before = list(left)
        for i in moving:
            left[i] = min(left[i], 1 + (sum(link.most(before) for link in links[i]) >> _BITS))
        left = [
            0 if known is not None and known <= n else bound
            for bound, known in zip(left, steps, strict=True)
        ]
        moving = [i for i in moving if left[i]]
        rest.append(sum(left))
    return rest


def _sunk(
    lengths: Sequence[int], links: Sequence[Sequence[_Links]], moving: Sequence[int], sink: int
) -> int:
    """Bound from below how much comes to a sink, from cells that f maps one-to-one.

    Theorem. Let S be the set of phases that come to the sink. What is in a cell of S is what is
    sent into S: its measure is the integral of |X'| over S in the image; and what is in cell j of
    S is in the image, but for the part of cell j that is not. Nor is more of the cell outside of S
    than is sent into the complement. Both hold with lower bounds of S, whatever their order.
    """
    held = [0] * len(lengths)
    held[sink] = lengths[sink] - 2
    away = list(map(sub, lengths, held))
    gained = _UNIT
    while gained > _LEAST_GAIN:
        METER.get().spend(2 * _work(links, moving))
        before = sum(held)
        for i in moving:
            inside = sum(link.least(held) for link in links[i]) >> _BITS
            outside = sum(link.most(away) for link in links[i]) >> _BITS
            held[i] = max(held[i], inside, lengths[i] - 3 - outside)
            away[i] = lengths[i] - held[i]
        gained = sum(held) - before
    return sum(held)


def _work(links: Sequence[Sequence[_Links]], moving: Sequence[int]) -> int:
    """Return the work to follow cells one step."""
    return sum(4 + (len(link.dense) >> 2) for i in moving for link in links[i])


def _links_of(marks: Sequence[int], cell: Cell) -> list[_Links]:
    """Find what the images of a cell meet."""
    images, inverses = cell.images or (), cell.inverses
    known = repeat(None, len(images)) if inverses is None else inverses
    return [_links(marks, _outward(x), each) for x, each in zip(images, known, strict=True)]


def _all_known(steps: Sequence[int | None], links: Sequence[_Links], cell: Cell) -> bool:
    """Whether all that the images of a cell meet is absorbed."""
    return cell.images is not None and all(
        None not in steps[link.first : link.last] for link in links
    )
