"""Rules: what comes after a launch other than an impact: none ever, a graze, no flight at all."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved, rational
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.enclose import (
    PRECISIONS,
    Box,
    box_text,
    enclosed,
    integer,
    leaves,
    read_box,
)
from proofs.trusted.kernel.firstzero import FirstZero, shown
from proofs.trusted.kernel.flight import Flight
from proofs.trusted.kernel.returns import LATEST, Launches
from proofs.trusted.kernel.tails import require_positive
from proofs.trusted.numbers import Range, show, show_range

_BITS = PRECISIONS[0]


def _read(context: Context, function_of: Reader, box_of: Reader) -> tuple[Flight, Box]:
    flight = context.function(function_of)
    if not isinstance(flight, Flight):
        raise function_of.fail("a flight is expected")
    return flight, read_box(box_of, flight.state)


def _launches(flight: Flight, box: Box) -> Launches:
    return Launches(flight, enclosed(box, _BITS), enclosed(flight.ranges, _BITS))


# -- no further impact -----------------------------------------------------------------------------


@dataclass(frozen=True)
class NoImpact(Conclusion):
    """After every state of the box all gaps are > 0 at all times t > 0."""

    function: Flight
    box: Box

    @property
    def sentence(self) -> str:
        flight = self.function
        gaps = " and ".join(f"`{gap}` > 0" for gap in flight.walls)
        return (
            f"for {flight.definition}: after {box_text(self.box, flight.variables)}, {gaps} at all "
            f"`{flight.time}` > 0: there is no further impact."
        )


def no_impact(context: Context, reader: Reader) -> NoImpact:
    """Rule `no-impact`: {flight function, box, tree, time T}.

    Hypotheses, for all launches from a leaf of the tree, which divides the box, and each gap: it is
    > 0 on (0, T] (see `FirstZero`); and for a k of 0, 1, 2 its derivatives by the time of the
    orders below k are > 0 at T, and that of order k is > 0 (k = 0), or >= 0, for all t >= T.
    Conclusion: `NoImpact`. Proof. For t >= T by Taylor's formula at T. What is the case for all
    t >= T is enclosed at once, in numbers between ends that may be infinite (`tails`).
    """
    function_of, box_of, tree, time_of = reader.fields("function", "box", "tree", "time")
    (flight, box), time = _read(context, function_of, box_of), time_of.number()
    if not 0 < time <= LATEST:
        raise time_of.fail(f"a time between 0 and {LATEST} is expected")
    for leaf in leaves(tree, box):
        launches = _launches(flight, leaf)
        for gap in flight.gaps:
            FirstZero(launches, gap).require_none(time)
            require_positive(flight.formulas, launches, gap, time)
    return NoImpact(flight, box)


# -- no flight at all ------------------------------------------------------------------------------


@dataclass(frozen=True)
class Pressed(Conclusion):
    """After no state of the box does the motion leave the wall where it starts.

    wall: the number of its gap, from 0; order: that of the gap's derivative that is < 0.
    """

    function: Flight
    box: Box
    wall: int
    order: int

    @property
    def sentence(self) -> str:
        flight, gap, t = self.function, self.function.walls[self.wall], self.function.time
        rate = f"`D({', '.join((str(gap), *[t] * self.order))})`"
        lower, why = "", "it moves into the wall, as before an impact"
        if self.order > 1:
            lower = f", as are its derivatives of orders below {self.order},"
            why = "the motion is pressed against the wall"
        return (
            f"for {flight.definition}: for {box_text(self.box, flight.variables)}, `{gap}` is 0 at "
            f"`{t}` = 0{lower} and {rate} is < 0 there: no flight begins, {why}."
        )


def pressed(context: Context, reader: Reader) -> Pressed:
    """Rule `pressed`: {flight function, box, tree}.

    Hypothesis: one gap is 0 at launch; the first of its derivatives by the time that is not the
    function 0 there is < 0 on each leaf of the tree, which divides the box. Conclusion: `Pressed`.
    Proof. By Taylor's formula the gap is < 0 right after launch.
    """
    function_of, box_of, tree = reader.fields("function", "box", "tree")
    flight, box = _read(context, function_of, box_of)
    left = [(k, gap) for k, gap in enumerate(flight.gaps) if gap.order]
    if len(left) != 1:
        raise Unproved("the flights do not start at one wall")
    ((wall, gap),) = left
    for leaf in leaves(tree, box):
        launches = _launches(flight, leaf)
        (rate,) = launches.on((gap.launch,), rational(Fraction(0), _BITS))
        if rate.hi >= 0:
            raise Unproved(f"it is not proved that no flight begins, {shown(launches.states)}")
    return Pressed(flight, box, wall, gap.order)


# -- a graze ---------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Graze(Conclusion):
    """For one value of a variable, the others being any in the box, the gap touches 0 in `time`.

    Before, all gaps are > 0. rises: whether it is the greater values after which there is no
    impact up to the end of `time`; after those on the other side the first one is in it.
    """

    function: Flight
    box: Box
    axis: int
    time: Range
    rises: bool

    @property
    def sentence(self) -> str:
        flight, gap, t = self.function, self.function.walls[0], self.function.time
        names, sides = list(flight.variables), list(self.box)
        free, side = names.pop(self.axis), sides.pop(self.axis)
        window = show_range(self.time)
        hit, missed = ("smaller", "greater") if self.rises else ("greater", "smaller")
        return (
            f"for {flight.definition}: {f'for any {box_text(sides, names)} ' if names else ''}"
            f"exactly one `{free}` in {show_range(side)} has a graze at a `{t}` in {window}, where "
            f"`{gap}` = `D({gap}, {t})` = 0 < `D({gap}, {t}, {t})`, and all gaps are > 0 before. "
            f"After {hit} `{free}` there the first impact is transversal, at a `{t}` in "
            f"{window}, after {missed} ones there is none up to `{t}` = {show(self.time[1])}."
        )


def graze(context: Context, reader: Reader) -> Graze:
    """Rule `graze`: {flight function, box, axis i, from 1, time [s, e]}.

    Hypotheses, for all launches from the box, g being the gap of the impact: g > 0 on (0, s], other
    gaps are > 0 on (0, e]; g_t < 0 at s, g_t > 0 at e; g_tt > 0 and g_(x_i) has one sign on [s, e].
    At m = (s + e)/2: g < 0 at one end of the side i, g > g_t^2 / (2 inf g_tt) at the other one.
    Conclusion: `Graze`.

    Proof. On [s, e] the gap is convex with a minimum M inside, which depends smoothly on x_i, with
    the derivative g_(x_i): it is monotone. M is < 0 at one end, and > 0 at the other one, since
    g >= g(m) + g_t(m) h + inf g_tt h^2/2. So M = 0 for one x_i: there g > 0 before its minimum.
    Where M < 0, g falls through 0 once before the minimum, with g_t < 0; where M > 0 it never does.
    """
    function_of, box_of, axis_of, time_of = reader.fields("function", "box", "axis", "time")
    flight, box = _read(context, function_of, box_of)
    axis, (start, end) = integer(axis_of, 1, flight.state) - 1, time_of.range()
    if not 0 < start < end <= LATEST:
        raise time_of.fail(f"times between 0 and {LATEST} are expected")
    launches, (gap, *others) = _launches(flight, box), flight.gaps
    FirstZero(launches, gap).require_none(start)
    for other in others:
        FirstZero(launches, other).require_none(end)
    lead, bend = _minimum(launches, axis, (start, end))
    below, above = (
        _launches(flight, (*box[:axis], (x, x), *box[axis + 1 :])).on(
            gap.orders[:2], rational((start + end) / 2, _BITS)
        )
        for x in sorted(box[axis], reverse=lead.hi < 0)
    )
    room = 2 * above[0].lo * bend.lo - max(-above[1].lo, above[1].hi) ** 2
    if below[0].hi >= 0 or above[0].lo <= 0 or room <= 0:
        raise Unproved(f"it is not proved that a gap touches 0, {shown(launches.states)}")
    return Graze(flight, box, axis, (start, end), lead.lo > 0)


def _minimum(launches: Launches, axis: int, window: Range) -> tuple[Enclosure, Enclosure]:
    """Enclose g_(x_i) and g_tt, the gap having one minimum in a window, which moves with x_i."""
    flight, gap = launches.flight, launches.flight.gaps[0]
    first, last = (launches.on(gap.orders[1:2], rational(t, _BITS))[0] for t in window)
    slope = flight.slopes(gap.orders[0], [axis])[0]
    lead, bend = launches.on((slope, gap.orders[2]), Enclosure.of(*window, _BITS))
    if not (first.hi < 0 < last.lo and bend.lo > 0 and not lead.has_zero):
        raise Unproved(f"it is not proved that a gap has one minimum, {shown(launches.states)}")
    return lead, bend
