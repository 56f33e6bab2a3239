"""Where phases end up (section 3.4): on the arc where the mass sticks, or off the table."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import groupby, pairwise

from proofs.trusted.certificate import Reader
from proofs.trusted.equations import gap, inverse_bend, inverse_slope
from proofs.trusted.flights import lifted, whole_turns
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.conclusion import About, Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.numbers import (
    TURN,
    Range,
    between,
    ceil_text,
    floor_text,
    hull,
    increasing,
    show_range,
    within,
)
from proofs.trusted.paper.branches import Branch
from proofs.trusted.paper.s34_circle.cells import Cell, Inverse, absorbed, in_order
from proofs.trusted.paper.s34_circle.landing import TURN_AT_MOST, Lands, NeverImpacts, Separation
from proofs.trusted.windows import BITS

BRACKET = Fraction(1, 2**40)  # the width of the time brackets in the rule `absorption`
UNIT = Fraction(1, 2**48)  # of the cuts and times there
_MOST_STEPS = 400
_SHORTEST = Fraction(1, 10**4)  # of the intervals whose numbers of impacts are told
_LENGTH_NAMED = Fraction(1, 50)
_TABLE = (0, 1, 2, 3, 4, 6, 8, 10, 15, 20, 30, 40, 60)


@dataclass(frozen=True)
class Sink(Conclusion):
    """So much of the circle, at least, comes to phases that never impact again.

    measure: of the phases with an iterate, the phase itself included, in never.phases. ends:
    brackets of the ends of the longest interval of phases around it that never impact again: at
    the outer end of each there is an impact.
    """

    never: NeverImpacts
    ends: tuple[Range, Range]
    measure: Fraction

    def __post_init__(self) -> None:
        (low, first), (last, high) = self.ends
        if (first, last) != tuple(self.never.phases) or not low < first or not last < high:
            raise Unproved("the ends of an interval of phases that never impact are not bracketed")

    at = About("never")

    @property
    def share(self) -> Fraction:
        """The least share of the circle."""
        return self.measure / TURN_AT_MOST

    @property
    def quantities(self) -> dict[str, Range]:
        first, last = self.ends
        return {"never_impacts_from": first, "never_impacts_to": last}

    @property
    def sentence(self) -> str:
        first, last = (between(end, 12) for end in self.ends)
        return (
            f"{self.brief}. The longest interval of such phases around "
            f"{show_range(self.never.phases)} begins in {first} and ends in {last}."
        )

    @property
    def brief(self) -> str:
        return (
            f"at least {floor_text(100 * self.share, 5)} percent of the circle come to phases after"
            " which there is no impact, only touches without relative velocity, if any"
        )


@dataclass(frozen=True)
class Absorption(Conclusion):
    """Phases that reach the sticking arc.

    The phases that do not within n impacts have a measure of at most rest[n]. within: intervals
    of phases, mod 2 pi, in order, all of which do within that number of impacts. sink: the other
    ones, where they are known; open: a bound of the measure of those that come to neither, within
    as many impacts as `rest` goes up to.
    """

    arc: Separation
    rest: tuple[Fraction, ...]
    within: tuple[tuple[Range, int], ...]
    open: Fraction
    sink: Sink | None = None

    def __post_init__(self) -> None:
        ends = [end for phases, _ in self.within for end in phases]
        empty = any(low >= high for (low, high), _ in self.within)
        if not 0 <= self.open <= min(self.rest) or empty or ends != sorted(ends):
            raise Unproved("no bound, or intervals that are not in order")
        if self.sink is None and self.open != self.rest[-1]:
            raise Unproved("phases come to a sink that is not known")
        if self.sink is not None and self.sink.at != self.arc.at:
            raise Unproved("the arc and the sink are about different oscillators")

    at = About("arc")

    @property
    def share(self) -> Fraction:
        """The least share of the circle that reaches the arc."""
        return 1 - self.rest[-1] / TURN

    @property
    def open_share(self) -> Fraction:
        """The largest share of the circle of which nothing is said."""
        return self.open / TURN

    @property
    def sentence(self) -> str:
        table = ", ".join(
            f"{n}: {floor_text(100 * (1 - rest / TURN), 2)}"
            for n, rest in enumerate(self.rest)
            if n in _TABLE
        )
        named = ", ".join(
            f"{_inner(low, high)} within {steps}"
            for (low, high), steps in self.within
            if high - low > _LENGTH_NAMED
        )
        each = f" All phases of these intervals do: {named}." if named else ""
        return (
            f"{self.brief}; percentages by number of impacts, at least: {table}.{each}"
            f"{self._others}"
        )

    @property
    def _others(self) -> str:
        """What is said of phases that do not come to the arc."""
        if self.sink is None:
            return ""
        least, most = floor_text(100 * self.sink.share, 5), ceil_text(100 * (1 - self.share), 5)
        return (
            f" All but at most {ceil_text(100 * self.open_share, 7)} percent come, within "
            f"{len(self.rest) - 1} impacts, there or to phases of "
            f"{show_range(self.sink.never.phases)}, after which there is no impact; between "
            f"{least} and {most} percent come to the latter."
        )

    @property
    def brief(self) -> str:
        least = f"at least {floor_text(100 * self.share, 5)}"
        if self.sink is not None:
            most = ceil_text(100 * (1 - self.sink.share), 5)
            least = f"between {floor_text(100 * self.share, 5)} and {most}"
        return (
            f"{least} percent of the circle come to the arc where the mass sticks, "
            f"{'at least the former ' if self.sink else ''}within {len(self.rest) - 1} impacts"
        )


def _inner(low: Fraction, high: Fraction) -> str:
    """Write phases of an interval on the line, mod 2 pi, rounded inward."""
    if low >= 0:
        return f"[{ceil_text(low)}, {floor_text(high)}]"
    if high < 0:
        return f"[{ceil_text(low + TURN_AT_MOST)}, {floor_text(high + TURN)}]"
    return f"[{ceil_text(low + TURN_AT_MOST)}, 2 pi) and [0, {floor_text(high)}]"


def absorption(context: Context, reader: Reader) -> Absorption:
    """Rule `absorption`: {separation, lands, never, cells: [{branch, cuts, times, after}],
    impacts}.

    Cuts and times are counted in units of 2^-48. Hypotheses: the phases of the `lands` steps, of
    the `never-impacts` step, if there is one, and of cells between the cuts of each branch do not
    overlap, and lie on a line that reaches from before the separation phase, less 2 pi, to beyond
    the start of the sticking arc; at each cut the gap is > 0 at the time given and < 0 by 2^-40
    later, both in the window of the branch, which begins at `after` if gap > 0 then; sin(eta t) has
    one sign there. impacts: how many are followed. Conclusion: `Absorption`, by `followed`.

    Proof. f' = (sin(eta t) / eta) A / gap' has one sign on a branch, so that f is monotone there
    and a cell's image lies between those of its ends, and has an inverse.
    """
    separation_of, lands_of, never_of, cells_of, impacts_of = reader.fields(
        "separation", "lands", "never", "cells", "impacts"
    )
    arc = context.step(separation_of, Separation)
    lands = [context.step(name, Lands) for name in lands_of.items(least=2)]
    never = [context.step(name, NeverImpacts) for name in never_of.items(0, 1)]
    origin = min(each.phases[0] for each in lands)
    cells = [cell for entry in cells_of.items() for cell in branch_cells(context, entry, origin)]
    impacts = impacts_of.number()
    if impacts not in range(1, _MOST_STEPS + 1):
        raise impacts_of.fail(f"a number of impacts up to {_MOST_STEPS} is expected")
    return followed(arc, lands, never[0] if never else None, cells, int(impacts))


def followed(
    arc: Separation,
    lands: Sequence[Lands],
    never: NeverImpacts | None,
    cells: Sequence[Cell],
    impacts: int,
) -> Absorption:
    """Follow phases for so many impacts, by cells of branches and by what lands on the arc at once.

    Theorem. Phases between cells form cells of which nothing is known, the arc is one more cell.
    Then `absorbed` applies. Where between the phases that never impact again and those of branches
    there is one cell on each side, they are a sink: in these cells the longest interval ends.
    """
    origin, end = hull([each.phases for each in lands])
    if origin > lifted(arc.phase, -1, BITS)[0] or end < arc.start[1]:
        raise Unproved("the cells do not reach the sticking arc on both sides")
    silent = [] if never is None else [Cell((never.phases[0], never.phases[1]))]
    whole = Cell((end, origin + whole_turns(1, BITS)[1]), ())
    line = in_order([*(Cell(each.phases, ()) for each in lands), *silent, *cells, whole])
    phases = [cell.phases for cell in line]
    if phases[0][0] < origin or phases[-1] != whole.phases:
        raise Unproved("cells lie beyond the line")
    place = None if never is None else phases.index((never.phases[0], never.phases[1]))
    if place is not None and not all(line[i].inverses for i in (place - 2, place + 2)):
        place = None  # no impact is proved near them
    found = absorbed(line, impacts, len(line) - 1, place)
    sink = None
    if never is not None and place is not None:
        sink = Sink(never, (phases[place - 1], phases[place + 1]), found.sunk)
    return Absorption(arc, tuple(found.rest), tuple(_within(line, found.steps)), found.open, sink)


def _within(cells: Sequence[Cell], steps: Sequence[int | None]) -> Iterator[tuple[Range, int]]:
    """Join neighbouring cells that are absorbed within the same number of steps."""
    for count, group in groupby(zip(steps, cells, strict=True), key=lambda pair: pair[0]):
        members = [cell.phases for _, cell in group]
        low, high = members[0][0], members[-1][1]
        if count and high - low >= _SHORTEST:
            yield (low, high), count


def branch_cells(context: Context, reader: Reader, origin: Fraction) -> Iterator[Cell]:
    """Read and prove the cells of one branch."""
    branch_of, cuts_of, times_of, after_of = reader.fields("branch", "cuts", "times", "after")
    branch, after = context.step(branch_of, Branch), after_of.number()
    cuts = [x * UNIT for x in cuts_of.numbers(2)]
    times = [t * UNIT for t in times_of.numbers(len(cuts), len(cuts))]
    if not increasing(cuts):
        raise cuts_of.fail("phases must increase")
    window, sign = branch.direction((cuts[0], cuts[-1]), after)
    known = [_impact(branch, x, t) for x, t in zip(cuts, times, strict=True)]
    for i, phases in enumerate(pairwise(cuts)):
        (low, first), (high, last) = known[i : i + 2][::sign]
        flight = max(window[0], low[0] - phases[1]), min(window[1], high[1] - phases[0])
        motion = branch.motion(phases)
        start, now = motion.start, motion.clock(flight)
        bend = inverse_bend(start, now, inverse_slope(start, now)) * sign
        slopes = (first * sign).range, (last * sign).range
        turned = [*_reduced((low, high), origin)]
        yield Cell(
            phases,
            tuple((begin[0], end[1]) for begin, end in turned),
            tuple(Inverse.of(pair, slopes, bend.range) for pair in turned),
        )


def _impact(branch: Branch, phase: Fraction, time: Fraction) -> tuple[Range, Enclosure]:
    """Enclose the image of a phase, not reduced, and 1/f': an impact within 2^-40 of a time.

    Hypotheses: gap > 0 at the time, and by Taylor's formula with |gap''| <= |nu| + eta |nu| + eta^2
    (1 + |nu|) gap < 0 by 2^-40 later, in the window of the branch.
    """
    window = branch.window(phase)
    if not within((time, time + BRACKET), window):
        raise Unproved("a bracket leaves the window of the first impact")
    motion = branch.motion((phase, phase))
    start, now = motion.start, motion.clock((time, time))
    eta, nu = motion.at.point
    size, bits = abs(nu), motion.bits
    most = BRACKET * (size + eta * size + eta * eta * (1 + size))
    height, fall = gap(start, now), gap(start, now, 1)
    if height.lo <= 0 or height.range[1] + BRACKET * (fall.range[1] + most) >= 0:
        raise Unproved("a bracket does not have the signs +, - at its ends")
    fall, swing = fall + Enclosure.of(-most, most, bits), BRACKET * eta
    near = now._replace(mass_sin=now.mass_sin + Enclosure.of(-swing, swing, bits))
    return (phase + time, phase + time + BRACKET), inverse_slope(start, near, fall)


def _reduced(image: tuple[Range, Range], origin: Fraction) -> Iterator[tuple[Range, Range]]:
    """Yield the brackets of an image's ends, less multiples of 2 pi, of all parts on the line."""
    turn = whole_turns(1, BITS)
    if image[1][1] - image[0][0] >= turn[0]:
        raise Unproved("a cell's image is longer than the circle")
    count = int((image[0][0] - origin) // turn[1]) - 1
    for turns in range(count, count + 4):
        first, last = whole_turns(-turns, BITS)
        if image[1][1] + last >= origin and image[0][0] + first <= origin + turn[1]:
            yield lifted(image[0], -turns, BITS), lifted(image[1], -turns, BITS)
