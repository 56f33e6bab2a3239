"""Where phases end up (section 3.4): on the arc where the mass sticks, or off the table."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from proofs.trusted.certificate import Reader
from proofs.trusted.equations import gap, inverse_bend, inverse_slope
from proofs.trusted.flights import lifted, whole_turns
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.conclusion import About, Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.meter import METER
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
from proofs.trusted.paper.s34_circle.cells import Absorbed, Cell, Inverse, absorbed, in_order
from proofs.trusted.paper.s34_circle.entropy import Branch
from proofs.trusted.paper.s34_circle.landing import TURN_AT_MOST, Lands, NeverImpacts, Separation
from proofs.trusted.windows import BITS

BRACKET = Fraction(1, 2**40)  # the width of the time brackets in the rule `absorption`
UNIT = Fraction(1, 2**48)  # of the cuts and times there
_MOST_STEPS = 400
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
    ones, where they are known.
    """

    arc: Separation
    rest: tuple[Fraction, ...]
    within: tuple[tuple[Range, int], ...]
    sink: Sink | None = None

    def __post_init__(self) -> None:
        ends = [end for phases, _ in self.within for end in phases]
        empty = any(low >= high for (low, high), _ in self.within)
        if min(self.rest) < 0 or empty or ends != sorted(ends):
            raise Unproved("no bound, or intervals that are not in order")

    at = About("arc")

    @property
    def share(self) -> Fraction:
        """The least share of the circle that reaches the arc."""
        return 1 - self.rest[-1] / TURN

    @property
    def sentence(self) -> str:
        table = ", ".join(
            f"{n}: {floor_text(100 * (1 - rest / TURN), 2)}"
            for n, rest in enumerate(self.rest)
            if n in _TABLE
        )
        named = ", ".join(
            f"[{ceil_text(low)}, {floor_text(high)}] within {steps}"
            for (low, high), steps in self.within
            if high - low > _LENGTH_NAMED
        )
        each = f" All phases, mod 2 pi, of these intervals do: {named}." if named else ""
        return f"{self.brief}; percentages by number of impacts, at least: {table}.{each}"

    @property
    def brief(self) -> str:
        return (
            f"at least {floor_text(100 * self.share, 5)} percent of the circle come to the arc "
            f"where the mass sticks, within {len(self.rest) - 1} impacts"
        )


def absorption(context: Context, reader: Reader) -> Absorption:
    """Rule `absorption`: {separation, lands, never, cells: [{branch, cuts, times, after}], rest,
    within, sunk}.

    Cuts and times are counted in units of 2^-48. Hypotheses: the phases of the `lands` steps, of
    the `never-impacts` step, if there is one, and of cells between the cuts of each branch do not
    overlap, and lie on a line that reaches from before the separation phase, less 2 pi, to beyond
    the start of the sticking arc; at each cut the gap is > 0 at the time given and < 0 by 2^-40
    later, both in the window of the branch, which begins at `after` if gap > 0 then; sin(eta t) has
    one sign there. rest: bounds of what is left after 0, 1, ... steps, by `absorbed`; within: [low,
    high, n] such that all cells in [low, high] are absorbed within n; sunk: a lower bound of what
    comes to the phases of the `never-impacts` step, between which and those of branches, on both
    sides, there is one cell. Conclusion: `Absorption`.

    Proof. f' = (sin(eta t) / eta) A / gap' has one sign on a branch, so that f is monotone there
    and a cell's image lies between those of its ends, and has an inverse. Phases between cells form
    cells of which nothing is known, the arc one more cell. Then `absorbed` applies.
    """
    separation_of, lands_of, never_of, cells_of, rest_of, within_of, sunk_of = reader.fields(
        "separation", "lands", "never", "cells", "rest", "within", "sunk"
    )
    arc = context.step(separation_of, Separation)
    cells = [Cell(context.step(name, Lands).phases, ()) for name in lands_of.items(least=2)]
    origin, end = hull([cell.phases for cell in cells])
    if origin > lifted(arc.phase, -1, BITS)[0] or end < arc.start[1]:
        raise Unproved("the cells do not reach the sticking arc on both sides")
    never = [context.step(name, NeverImpacts) for name in never_of.items(0, 1)]
    cells += [Cell((each.phases[0], each.phases[1])) for each in never]
    for entry in cells_of.items():
        cells += branch_cells(context, entry, origin)
    cells = in_order([*cells, Cell((end, origin + whole_turns(1, BITS)[1]), ())])
    phases = [cell.phases for cell in cells]
    if phases[0][0] < origin or phases[-1][0] != end:
        raise Unproved("cells lie beyond the line")
    place = phases.index(never[0].phases) if never else None
    rest, sunk = rest_of.numbers(1, _MOST_STEPS), sunk_of.number()
    found = absorbed(cells, len(rest) - 1, len(cells) - 1, place)
    if any(own > given for own, given in zip(found.rest, rest, strict=True)) or found.sunk < sunk:
        raise Unproved("more may be left than is said, or less come to the sink")
    within = [_within(item, cells, found) for item in within_of.items()]
    sink = None
    if place is not None:
        ends = phases[place - 1], phases[place + 1]
        if not all(cells[i].inverses for i in (place - 2, place + 2)):
            raise Unproved("no impact is proved near phases that never impact")
        sink = Sink(never[0], ends, sunk)
    return Absorption(arc, rest, tuple(within), sink)


def _within(reader: Reader, cells: Sequence[Cell], found: Absorbed) -> tuple[Range, int]:
    """Read [low, high, n], all cells between being absorbed within n."""
    low, high, steps = reader.numbers(3, 3)
    first = bisect_right(cells, low, key=lambda cell: cell.phases[1])
    last = bisect_left(cells, high, key=lambda cell: cell.phases[0])
    METER.get().spend(last - first)
    known = found.steps[first:last]
    if not cells[0].phases[0] <= low < high <= cells[-1].phases[1]:
        raise reader.fail("an interval of the line is expected")
    if any(n is None or n > steps for n in known):
        raise Unproved("a phase is not proved to be absorbed so soon")
    return (low, high), int(steps)


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
        start, now = motion.start(), motion.clock(flight)
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
    start, now = motion.start(), motion.clock((time, time))
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
