"""How much of the circle ends up on the arc where the mass sticks (section 3.4): cells, followed.

A phase is absorbed within n steps if one of its images under f^0, ..., f^n is in the arc. Special,
beside the covering graphs of the kernel: what counts is the measure of what is sent on, so the
lengths of the common parts of images and thousands of cells, followed over a hundred steps; in
whole numbers, since enclosures would take minutes.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import NamedTuple

from proofs.trusted.certificate import Reader
from proofs.trusted.equations import launch_acceleration
from proofs.trusted.flights import FirstImpact, Motion, lifted, whole_turns
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.meter import METER
from proofs.trusted.numbers import TURN, Range, ceil_text, covered, floor_text, hull, increasing
from proofs.trusted.paper.s34_circle.entropy import Branch
from proofs.trusted.paper.s34_circle.landing import Lands, Separation
from proofs.trusted.parameters import Place
from proofs.trusted.windows import BITS, level

BRACKET = Fraction(1, 2**26)  # the width of the time brackets in the rule `absorption`
_UNIT = 1 << 64
_MOST_STEPS = 400
_LENGTH_NAMED = Fraction(1, 50)
_TABLE = (0, 1, 2, 3, 4, 6, 8, 10, 15, 20, 30, 40, 60)


# -- cells -----------------------------------------------------------------------------------------


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
    factors = [
        None if cell.images is None or cell.stretch is None else _up(cell.stretch) for cell in cells
    ]
    lengths = [_up(cell.phases[1] - cell.phases[0]) for cell in cells]
    steps: list[int | None] = [None] * len(cells)
    bounds, rest = lengths, [sum(lengths)]
    for n in range(1, count + 1):
        METER.get().spend(sum(1 + len(met or ()) for met in links) >> 2)
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


# -- cells of f ------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Absorption(Conclusion):
    """Phases that reach the sticking arc.

    The phases that do not within n impacts have a measure of at most rest[n]. within: intervals
    of phases, mod 2 pi, in order, all of which do within that number of impacts.
    """

    arc: Separation
    rest: tuple[Fraction, ...]
    within: tuple[tuple[Range, int], ...]

    def __post_init__(self) -> None:
        ends = [end for phases, _ in self.within for end in phases]
        empty = any(low >= high for (low, high), _ in self.within)
        if min(self.rest) < 0 or empty or ends != sorted(ends):
            raise Unproved("no bound, or intervals that are not in order")

    @property
    def at(self) -> Place:
        """The oscillator."""
        return self.arc.at

    @property
    def share(self) -> Fraction:
        """The least share of the circle that reaches the arc."""
        return 1 - self.rest[-1] / TURN

    def reaches(self, phases: Range) -> bool:
        """Whether all of an interval of phases is proved to reach the arc."""
        return covered(phases, (part for part, _ in self.within))

    @property
    def sentence(self) -> str:
        table = ", ".join(
            f"{n}: {floor_text(100 * (1 - rest / TURN), 2)}"
            for n, rest in enumerate(self.rest)
            if n in _TABLE
        )
        named = ", ".join(
            f"{steps} from [{ceil_text(low)}, {floor_text(high)}]"
            for (low, high), steps in self.within
            if high - low > _LENGTH_NAMED
        )
        return (
            f"{self.brief}; percentages by number of impacts, at least: {table}. The most impacts "
            f"that it takes are, for every phase mod 2 pi of the longest intervals: {named}."
        )

    @property
    def brief(self) -> str:
        return (
            f"at least {floor_text(100 * self.share, 3)} percent of the circle come to the arc "
            f"where the mass sticks, within {len(self.rest) - 1} impacts"
        )


def absorption(context: Context, reader: Reader) -> Absorption:
    """Rule `absorption`: {separation, lands, impacts, cells: [{branch, cuts, times, after}], rest,
    within}.

    Hypotheses: the phases of the `lands` steps, of the `first-impact` steps, and of cells between
    the cuts of each branch do not overlap, and lie on a line that reaches from before the
    separation phase, less 2 pi, to beyond the start of the sticking arc; at each cut the gap is
    > 0 at the time given and < 0 by 2^-26 later, both in the window of the branch, which begins at
    `after` if gap > 0 then; sin(eta t) has one sign there. rest: bounds of what `absorbed` leaves
    after 0, 1, ... steps; within: [low, high, n] such that all cells in [low, high] are absorbed
    within n. Conclusion: `Absorption`.

    Proof. f' = (sin(eta t) / eta) A / gap' has one sign on a branch, so that f is monotone there
    and a cell's images lie between those of its ends; those of a `first-impact` step are in its
    windows. Phases between cells form cells of which nothing is known. Then `absorbed` applies.
    """
    separation_of, lands_of, impacts_of, cells_of, rest_of, within_of = reader.fields(
        "separation", "lands", "impacts", "cells", "rest", "within"
    )
    arc = context.step(separation_of, Separation)
    cells = [Cell(context.step(name, Lands).phases, ()) for name in lands_of.items(least=2)]
    origin, end = hull([cell.phases for cell in cells])
    if origin > lifted(arc.phase, -1, BITS)[0] or end < arc.start[1]:
        raise Unproved("the cells do not reach the sticking arc on both sides")
    for name in impacts_of.items():
        step = context.step(name, FirstImpact)
        first, last = step.motion.phases
        images = [_reduced((first + t, last + u), origin) for t, u in step.windows]
        cells.append(Cell((first, last), tuple(image for pair in images for image in pair)))
    for entry in cells_of.items():
        cells += _cells(context, entry, origin)
    cells = in_order(cells)
    rest = rest_of.numbers(1, _MOST_STEPS)
    found = absorbed(cells, len(rest) - 1)
    if any(own > given for own, given in zip(found.rest, rest, strict=True)):
        raise Unproved("more may be left than is said")
    within = []
    for item in within_of.items():
        low, high, steps = item.numbers(3, 3)
        counts = [found.steps[i] for i, common in cells_met(cells, (low, high)) if common > 0]
        if not origin <= low < high <= end or any(n is None or n > steps for n in counts):
            raise Unproved("a phase is not proved to be absorbed so soon")
        within.append(((low, high), int(steps)))
    return Absorption(arc, rest, tuple(within))


def _cells(context: Context, reader: Reader, origin: Fraction) -> list[Cell]:
    """Read and prove the cells of one branch."""
    branch_of, cuts_of, times_of, after_of = reader.fields("branch", "cuts", "times", "after")
    branch, cuts, after = context.step(branch_of, Branch), cuts_of.numbers(2), after_of.number()
    times = times_of.numbers(len(cuts), len(cuts))
    if not increasing(cuts):
        raise cuts_of.fail("phases must increase")
    if not branch.begin <= after < min(branch.ends):
        raise Unproved("the window of the first impact begins later, or ends before")
    images = [branch.image(x, (t, t + BRACKET)) for x, t in zip(cuts, times, strict=True)]
    for phases in pairwise(cuts) if after > branch.begin else ():
        if level(branch.motion(phases), after)[0] <= 0:
            raise Unproved("an impact before the time given is not excluded")
    window = after, max(branch.ends)
    along = branch.motion((cuts[0], cuts[-1])).clock(window).mass_sin
    if along.lo <= 0 <= along.hi:
        raise Unproved("f' is not proved to have one sign on a branch")
    cells = []
    for phases, ends in zip(pairwise(cuts), pairwise(images), strict=True):
        low, high = hull(ends)
        flight = max(window[0], low - phases[1]), min(window[1], high - phases[0])
        stretch = _stretch(branch.motion(phases), flight)
        cells.append(Cell(phases, tuple(_reduced((low, high), origin)), stretch))
    return cells


def _stretch(motion: Motion, time: Range) -> Fraction | None:
    """Bound 1/|f'| = |gap'| / |(sin(eta t) / eta) A|; None where that may vanish."""
    sin, push = motion.clock(time).mass_sin, launch_acceleration(motion.start())
    along = sin / motion.eta * push
    if along.lo <= 0 <= along.hi:
        return None
    ratio: Enclosure = motion.gap_of(time, 1) / along
    return max(-ratio.range[0], ratio.range[1])


def _reduced(image: Range, origin: Fraction) -> Iterator[Range]:
    """Yield the images, less multiples of 2 pi, that meet [origin, origin + 2 pi]."""
    turn = whole_turns(1, BITS)
    if image[1] - image[0] >= turn[0]:
        raise Unproved("a cell's image is longer than the circle")
    count = int((image[0] - origin) // turn[1]) - 1
    for turns in range(count, count + 4):
        low, high = lifted(image, -turns, BITS)
        if high >= origin and low <= origin + turn[1]:
            yield low, high
