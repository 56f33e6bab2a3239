"""Where f jumps: phases after which the mass grazes the table, f's square root there."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from proofs.trusted.certificate import Reader
from proofs.trusted.equations import launch_acceleration
from proofs.trusted.flights import Motion, lifted, whole_turns
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved, rational
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.enclose import integer
from proofs.trusted.kernel.gaps import falls
from proofs.trusted.kernel.operations import sqrt
from proofs.trusted.numbers import Phases, Range, between, increasing, show_range
from proofs.trusted.paper.branches import MOST_TURNS
from proofs.trusted.parameters import Place
from proofs.trusted.windows import BITS, DEEPEST, Meetings, clear, leaves, level

_PLACES = 9


@dataclass(frozen=True)
class Grazing(Conclusion):
    """After one phase phi_g of `phases` the gap is > 0 until a graze: gap = gap' = 0 < gap''.

    It comes after a time in `time`, in window `turn`. After the other phases below phi_g if
    `below`, else above, the first impact is in this window, later than `begin`; after those on the
    other side in the window `beyond`, after a time in `landing`, or where that is None there is
    none for 2 pi q, eta = p/q. These impacts are transversal, and on both sides f' > 0 if `below`,
    else f' < 0. On the former side f = f_g - a |phi - phi_g|^(1/2) + O(phi - phi_g), f_g the phase
    of the graze and a in `root`.
    """

    at: Place
    phases: Phases
    turn: int
    begin: Fraction
    time: Range
    below: bool
    beyond: int
    landing: Range | None
    root: Range

    @property
    def graze(self) -> Range:
        """Enclose the phase of the graze, f's limit on its side, less 2 pi turn."""
        return self._after(self.time, self.turn)

    @property
    def other(self) -> Range | None:
        """Enclose f's limit on the other side, less 2 pi beyond; None if f is not defined there."""
        return None if self.landing is None else self._after(self.landing, self.beyond)

    @property
    def motion(self) -> Motion:
        """The flights from these phases."""
        return Motion(self.at, self.phases, BITS)

    def _after(self, time: Range, turns: int) -> Range:
        return lifted((self.phases[0] + time[0], self.phases[1] + time[1]), -turns, BITS)

    @property
    def sentence(self) -> str:
        side, rest, rises = "above", "below", "decreases"
        if self.below:
            side, rest, rises = "below", "above", "increases"
        low, high = self.root[0] / 2, self.root[1] / 2
        there = "the mass does not come back to the table for q turns, eta = p/q"
        if self.other is not None:
            there = f"f is C^1 and {rises}, with a limit at phi_g in {between(self.other, _PLACES)}"
        return (
            f"one phase phi_g in {show_range(self.phases)} is followed by a graze, at the phase "
            f"f_g in {between(self.graze, _PLACES)}, before any impact. For the phases of this "
            f"interval, which is less than {self._width} wide, {side} phi_g f is C^1 and {rises}: "
            "f = f_g - a |phi - phi_g|^(1/2) + O(phi - phi_g), |f'| = b |phi - phi_g|^(-1/2) + "
            f"O(1), a in {between(self.root, _PLACES)}, b = a/2 in "
            f"{between((low, high), _PLACES)}; for those {rest} phi_g {there}."
        )

    @property
    def _width(self) -> str:
        """A power of ten above the width: that is how near phi_g what is said of f holds."""
        low, high = self.phases
        return f"10^(-{len(str((1 / (high - low)).__ceil__() - 1)) - 1})"

    @property
    def brief(self) -> str:
        return f"a graze after {between(self.phases, _PLACES)}, a in {between(self.root)}"


def grazing(context: Context, reader: Reader) -> Grazing:
    """Rule `grazing`: {phases [x, y], turn K, times t_0 < t_1 < t_2 < t_3, beyond L, landing [u, v]
    or null}, for -1 < nu < 0.

    Hypotheses, for the launches in [x, y]: with window K of `Meetings` from s to e, gap' < 0 on
    [s, t_1], gap(t_0) > 0, gap'' > 0 on [t_1, t_2], gap' > 0 on [t_2, t_3]; gap > 0 on the windows
    before L but K, and on [t_3, e]. In window L, from s' on, gap(u) > 0, gap' < 0 on [s', v],
    gap(v) < 0; or L = q, eta = p/q, and gap'' > 0 on [s', 2 pi q]. sin(eta t) has one sign on
    [t_0, t_2] and [u, v]. At m = (t_1 + t_2)/2: gap < 0 at x if sin < 0, else at y; at the other
    end gap > gap'^2 / (2 inf gap''). Conclusion: `Grazing`, a^2 = 2 |sin(eta t)/eta A| / gap''.

    Proof. On [s, t_3] the gap has one minimum, at a time t* in (t_1, t_2), and is monotone on both
    sides. Let M be its value. By the theorem of `slope`, M' = -(sin(eta t*) / eta) A, A > 0 the
    launch acceleration: M is monotone in the phase. By the values at m it has opposite signs at x
    and y (the second by gap'' >= inf gap''): so one phi_g has M = 0. Where M < 0, the gap falls
    through a first zero, between t_0 and t*. Where M >= 0, the next zero is in window L. In the
    last case gap = gap' = 0 at 2 pi q, so that the gap, being convex, is > 0 before. f' has the
    sign of -sin(eta t). At (phi_g, t*) gap = gap' = 0, gap'' > 0 and dgap/dphi = M', so that
    the zeros satisfy M' (phi - phi_g) + gap''/2 (t - t*)^2 + ... = 0, t < t*: the expansion.
    """
    phases_of, turn_of, times_of, beyond_of, landing_of = reader.fields(
        "phases", "turn", "times", "beyond", "landing"
    )
    at, phases, times = context.place, Phases(*phases_of.range()), times_of.numbers(4, 4)
    if not -1 < at.point[1] < 0:
        raise Unproved("windows are known for -1 < nu < 0 only")
    if not increasing(times):
        raise times_of.fail("times must increase")
    landing = None if landing_of.is_null() else landing_of.range()
    turns = integer(turn_of, 1, MOST_TURNS), integer(beyond_of, 1, MOST_TURNS)
    return graze(Motion(at, phases, BITS), turns, times, landing)


def graze(
    motion: Motion,
    turns: tuple[int, int],
    times: Sequence[Fraction],
    landing: Range | None,
) -> Grazing:
    """Prove what the rule `grazing` concludes, or raise Unproved."""
    turn, beyond = turns
    before, first, last, after = times
    meetings, launched, gap_of = Meetings.of(motion), leaves(motion), motion.gap_of
    window, final = meetings.window(turn), meetings.window(beyond)
    if not launched < window[0] <= before or not window[1] <= final[0]:
        raise Unproved("the windows of the graze and of the later impact are not in order")
    for low, high in meetings.before(beyond):
        begin = max(low, launched) if (low, high) != window else after
        if high > begin:
            clear(motion, (begin, high))
    if level(motion, before)[0] <= 0 or not falls(gap_of, (window[0], first), DEEPEST):
        raise Unproved("the gap is not proved to fall to the graze")
    bend = gap_of((first, last), 2)
    if bend.lo <= 0 or not falls(lambda t, order: -gap_of(t, order), (last, after), DEEPEST):
        raise Unproved("the gap is not proved to rise after the graze")
    below = _falling(motion, (before, last))
    if landing is not None:
        _lands(motion, final[0], landing)
        if _falling(motion, landing) is not below:
            raise Unproved("f is not proved to be monotone alike on both sides")
    elif not _returns(motion, final[0], beyond):
        raise Unproved("an impact within q turns is not excluded")
    push = launch_acceleration(motion.start) / motion.eta
    along = motion.clock((first, last)).mass_sin * push
    _separates(motion, (first + last) / 2, bend, below)
    root = sqrt((-along if below else along) * 2 / bend).range
    phases = Phases(*motion.phases)
    time = first, last
    return Grazing(motion.at, phases, turn, before, time, below, beyond, landing, root)


def _falling(motion: Motion, time: Range) -> bool:
    """Whether sin(eta t) < 0 on an interval of times; Unproved unless it has one sign there."""
    sin: Enclosure = motion.clock(time).mass_sin
    if sin.has_zero:
        raise Unproved("f' is not proved to have one sign")
    return sin.hi < 0


def _lands(motion: Motion, begin: Fraction, landing: Range) -> None:
    """Prove that the gap of all launches falls from a time on, to its zero in `landing`."""
    high, low = (level(motion, time) for time in landing)
    if begin >= landing[1] or not falls(motion.gap_of, (begin, landing[1]), DEEPEST):
        raise Unproved("the gap is not proved to fall to the later impact")
    if not high[0] > 0 > low[1]:
        raise Unproved("a bracket of the later impact does not have the signs +, - at its ends")


def _returns(motion: Motion, begin: Fraction, turns: int) -> bool:
    """Whether the gap is convex from a time on, up to 2 pi q, eta = p/q, where it is 0."""
    end = whole_turns(turns, BITS)[1]
    eta, _ = motion.at.point
    return turns == eta.denominator and motion.gap_of((begin, end), 2).lo > 0


def _separates(motion: Motion, time: Fraction, bend: Enclosure, below: bool) -> None:
    """Prove that the least gap is < 0 at one end of the phases, > 0 at the other."""
    inside, outside = motion.phases if below else motion.phases[::-1]
    meets, misses = (replace(motion, phases=(x, x)).gap_of for x in (inside, outside))
    slope = misses((time, time), 1)
    clearance = misses((time, time), 0) - slope * slope / (2 * rational(bend.range[0], BITS))
    if not meets((time, time), 0).hi < 0 < clearance.lo:
        raise Unproved("the graze is not proved to be between the phases")
