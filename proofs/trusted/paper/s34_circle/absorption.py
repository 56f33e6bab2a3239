"""How much of the circle ends up on the arc where the mass sticks (section 3.4)."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from proofs.trusted.certificate import Reader
from proofs.trusted.equations import launch_acceleration
from proofs.trusted.flights import FirstImpact, Motion, brackets, lifted, whole_turns
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved, rational
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.numbers import TURN, Range, ceil_text, floor_text
from proofs.trusted.paper.s34_circle.cells import Cell, absorbed, cells_met, in_order
from proofs.trusted.paper.s34_circle.entropy import Branch
from proofs.trusted.paper.s34_circle.landing import Lands, Separation, motion_at
from proofs.trusted.parameters import Parameters, Place
from proofs.trusted.windows import BITS, level

BRACKET = Fraction(1, 2**26)  # the width of the time brackets in the rule `absorption`
_MOST_STEPS = 400
_LENGTH_NAMED = Fraction(1, 50)
_TABLE = (0, 1, 2, 3, 4, 6, 8, 10, 15, 20, 30, 40, 60)


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
        """Raise Unproved unless the intervals are in order."""
        ends = [end for phases, _ in self.within for end in phases]
        empty = any(low >= high for (low, high), _ in self.within)
        if min(self.rest) < 0 or empty or any(after < end for end, after in pairwise(ends)):
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
        low, high = phases
        for (first, last), _ in self.within:
            low = max(low, last) if first <= low else low
        return high <= low

    @property
    def sentence(self) -> str:
        """Return the theorem, with the longest intervals, rounded inward."""
        percents = [floor_text(100 * (1 - rest / TURN), 2) for rest in self.rest]
        table = ", ".join(f"{n}: {percents[n]}" for n in _TABLE if n < len(percents))
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
        """Return the share."""
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
    origin = min(cell.phases[0] for cell in cells)
    end = max(cell.phases[1] for cell in cells)
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
    branch, of = context.step(branch_of, Branch), context.of
    cuts = cuts_of.numbers(2)
    times = times_of.numbers(len(cuts), len(cuts))
    if cuts[0] < branch.cuts[0] or cuts[-1] > branch.cuts[-1]:
        raise cuts_of.fail("cuts outside the branch")
    if any(high <= low for low, high in pairwise(cuts)):
        raise cuts_of.fail("phases must increase")
    window = after_of.number(), max(branch.ends)
    if not branch.begin <= window[0] < min(branch.ends):
        raise Unproved("the window of the first impact begins later, or ends before")
    for phases in pairwise(cuts) if window[0] > branch.begin else ():
        if level(motion_at(of, phases), window[0])[0] <= 0:
            raise Unproved("an impact before the time given is not excluded")
    along = motion_at(of, (cuts[0], cuts[-1])).clock(window).mass_sin
    if along.lo <= 0 <= along.hi:
        raise Unproved("f' is not proved to have one sign on a branch")
    images = [_image(of, branch, window[0], x, t) for x, t in zip(cuts, times, strict=True)]
    cells = []
    for phases, ends in zip(pairwise(cuts), pairwise(images), strict=True):
        low, high = min(ends[0][0], ends[1][0]), max(ends[0][1], ends[1][1])
        flight = max(window[0], low - phases[1]), min(window[1], high - phases[0])
        stretch = _stretch(motion_at(of, phases), flight)
        cells.append(Cell(phases, tuple(_reduced((low, high), origin)), stretch))
    return cells


def _image(
    of: Parameters, branch: Branch, after: Fraction, phase: Fraction, time: Fraction
) -> Range:
    """Return phase + impact time, bracketed by the signs of the gap in the branch's window."""
    piece = max(0, bisect_left(branch.cuts, phase) - 1)
    later = time + BRACKET
    if time < after or later > branch.ends[piece]:
        raise Unproved("a bracket leaves the window of the first impact")
    if not brackets(motion_at(of, (phase, phase)).gap_of, (time, later)):
        raise Unproved("a bracket does not have the signs +, - at its ends")
    return phase + time, phase + later


def _stretch(motion: Motion, time: Range) -> Fraction | None:
    """Bound 1/|f'| = |gap'| / |(sin(eta t) / eta) A|; None where that may vanish."""
    start, now = motion.start(), motion.clock(time)
    along = now.mass_sin / rational(motion.eta, motion.bits) * launch_acceleration(start)
    if along.lo <= 0 <= along.hi:
        return None
    ratio: Enclosure = motion.gap(start, time, 1) / along
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
