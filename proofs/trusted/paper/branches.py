"""Branches of f: intervals of phases on which it is smooth, by the first impacts after them."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from itertools import pairwise

from proofs.trusted.certificate import Reader
from proofs.trusted.flights import Motion, lifted
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.enclose import enclosed, integer
from proofs.trusted.kernel.gaps import falls
from proofs.trusted.kernel.laps import Lap
from proofs.trusted.numbers import Phases, Range, hull, increasing, show_range, within
from proofs.trusted.oscillator import PlasticMap
from proofs.trusted.parameters import Place
from proofs.trusted.windows import BITS, DEEPEST, Meetings, clear, leaves, level

MOST_TURNS = 20_000
_HALVINGS = 12


@dataclass(frozen=True)
class Branch(Lap):
    """f is C^1 on [cuts[0], cuts[-1]], each first impact being transversal.

    A launch in [cuts[i], cuts[i+1]] has gap > 0 up to the beginning of windows[i], then one zero,
    that of its first impact, up to the end, where gap < 0. Images are counted from 2 pi turn.
    """

    at: Place
    cuts: tuple[Fraction, ...]
    turn: int
    windows: tuple[Range, ...]
    _proved: set[tuple[Fraction, Range]] = field(
        default_factory=set, init=False, compare=False, repr=False
    )

    def __post_init__(self) -> None:
        ordered = all(0 < begin < end for begin, end in self.windows)
        if len(self.windows) != len(pieces_of(self.cuts)) or not ordered:
            raise Unproved("a branch has a window of the impacts after each piece")

    @cached_property
    def phases(self) -> Phases:
        """The closed interval of phases."""
        return Phases(self.cuts[0], self.cuts[-1])

    @property
    def subject(self) -> PlasticMap:
        """f."""
        return PlasticMap(self.at)

    @property
    def source(self) -> Range:
        """The phases."""
        return self.phases

    def read_image(self, point: Fraction, entry: Reader) -> Range:
        """Enclose f by a bracket of the first impact, {phase, time}, less 2 pi turn."""
        _, time_of = entry.fields("phase", "time")
        return lifted(self.image(point, time_of.range()), -self.turn, BITS)

    @property
    def times(self) -> Range:
        """The times between which all the first impacts are."""
        return hull(self.windows)

    def motion(self, phases: Range) -> Motion:
        """Return the flights from some of the phases."""
        return Motion(self.at, phases, BITS)

    def window(self, phase: Fraction) -> Range:
        """Return the times between which the first impact after a launch at a phase comes."""
        if not within((phase, phase), self.phases):
            raise Unproved("a phase outside the branch")
        return self.windows[max(0, bisect_left(self.cuts, phase) - 1)]

    def side(self, phase: Fraction, image: Range) -> int:
        """Return the sign of f - x at a phase for all x in `image`, 0 if undecided.

        Let T = x - phase + 2 pi turn: f > x if gap > 0 up to T, f < x if gap < 0 at T in the window
        or the window ends before.
        """
        time = lifted((image[0] - phase, image[1] - phase), self.turn, BITS)
        begin, end = self.window(phase)
        if time[1] < begin or time[0] > end:
            return 1 if time[1] < begin else -1
        height = self.motion((phase, phase)).gap_of(time, 0)
        if height.lo > 0 and time[1] <= end:
            return 1
        return -1 if height.hi < 0 and begin <= time[0] else 0

    def image(self, phase: Fraction, time: Range) -> Range:
        """Enclose phase + the time of the first impact, which is proved to be in `time`.

        On its branch the gap has one zero, falling: gap > 0 and gap < 0 at the ends bracket it.
        """
        if (phase, time) not in self._proved:
            self._require_bracket(phase, time)
            self._proved.add((phase, time))
        return phase + time[0], phase + time[1]

    def _require_bracket(self, phase: Fraction, time: Range) -> None:
        window, motion = self.window(phase), self.motion((phase, phase))
        if not within(time, window):
            raise Unproved("a bracket leaves the window of the first impact")
        signs = zip(time, window, (1, -1), strict=True)
        asked = [(end, sign) for end, known, sign in signs if end != known]
        if not any(
            all((gap_of((end, end), 0) * sign).lo > 0 for end, sign in asked)
            for gap_of in (motion.gap_of, motion.sharp_gap)
        ):
            raise Unproved("a bracket does not have the signs +, - at its ends")

    def direction(self, phases: Range, after: Fraction) -> tuple[Range, int]:
        """Return a window of the impacts after these launches, and the sign of f', the same on all.

        They come later than `after` if gap > 0 then. f' = (sin(eta t) / eta) A / gap' has one sign
        if sin(eta t) has from then on.
        """
        if not self.times[0] <= after < min(end for _, end in self.windows):
            raise Unproved("the window of the first impact begins later, or ends before")
        if after > self.times[0] and not self._up(phases, after, _HALVINGS):
            raise Unproved("an impact before the time given is not excluded")
        window = after, self.times[1]
        along = self.motion(phases).clock(window).mass_sin
        if along.has_zero:
            raise Unproved("f' is not proved to have one sign on a branch")
        return window, -1 if along.lo > 0 else 1

    def _up(self, phases: Range, time: Fraction, halvings: int) -> bool:
        """Whether gap > 0 at one time after all launches in some phases, which may be halved."""
        if level(self.motion(phases), time)[0] > 0:
            return True
        middle = (phases[0] + phases[1]) / 2
        halves = (phases[0], middle), (middle, phases[1])
        return halvings > 0 and all(self._up(half, time, halvings - 1) for half in halves)

    @property
    def sentence(self) -> str:
        return (
            f"f is C^1 on {show_range(self.phases)}, the first impact being transversal, after a "
            f"time in {show_range(self.times)}."
        )


def branch(context: Context, reader: Reader) -> Branch:
    """Rule `branch`: {cuts x_0 < ... < x_n, turn K}, or for long flights {cuts, turn, ends e_i}.

    Without ends, K is any whole number. Conclusion: `Branch`, the windows being those in which the
    first impacts after [x_(i-1), x_i] are found (see `FirstZero`). Proof. There they are
    transversal, so smooth in the phase; at a shared end they are the same.

    With ends e_1, ..., e_n, K >= 1 and -1 < nu < 0. Hypotheses: on phases [x_0, x_n] gap'' > 0
    on [0, t_1]; gap > 0 after t_1 in each of the windows of `Meetings` for the minima 0, ..., K - 1
    of the table; window K starts at s > t_1. On [x_(i-1), x_i]: gap' < 0 on [s, e_i] and
    gap(e_i) < 0. Conclusion: `Branch`, with the windows [s, e_i].

    Proof. gap = gap' = 0 at launch, so gap > 0 on (0, t_1]. No impact lies outside the windows,
    none in the first K; and none at s, which is outside window K or its strict boundary: gap > 0
    on (0, s]. Then the gap falls to a negative value: one zero, transversal, so f is C^1 on each
    piece, and on the union since at a shared end the first impact is the same.
    """
    is_long = ("ends",) if reader.has("ends") else ()
    cuts_of, turn_of, *ends_of = reader.fields("cuts", "turn", *is_long)
    cuts, turn = cuts_of.numbers(2, 200), integer(turn_of, len(ends_of), MOST_TURNS)
    if not ends_of:
        return short_branch(context.place, cuts, turn)
    at, phases = context.place, Phases(cuts[0], cuts[-1])
    if not -1 < at.point[1] < 0:
        raise Unproved("windows are known for -1 < nu < 0 only")
    whole = Motion(at, phases, BITS)
    meetings, launched = Meetings.of(whole), leaves(whole)
    for low, high in meetings.before(turn):
        if high > launched:
            clear(whole, (max(low, launched), high))
    begin = meetings.window(turn)[0]
    if begin <= launched:
        raise Unproved("the last window starts at launch")
    ends = ends_of[0].numbers(len(cuts) - 1, len(cuts) - 1)
    found = Branch(at, cuts, turn, tuple((begin, end) for end in ends))
    for piece, end in zip(pairwise(cuts), ends, strict=True):
        if not falls(found.motion(piece).gap_of, (begin, end), DEEPEST):
            raise Unproved("the gap is not proved to fall to the impact")
        if level(found.motion(piece), end)[1] >= 0:
            raise Unproved("the gap is not proved negative at an end")
    return found


def short_branch(at: Place, cuts: Sequence[Fraction], turn: int) -> Branch:
    """Return a branch with the windows in which its impacts are found."""
    function = PlasticMap(at)
    windows = (function.window(enclosed((piece,), BITS)) for piece in pieces_of(cuts))
    return Branch(at, tuple(cuts), turn, tuple(windows))


def pieces_of(cuts: Sequence[Fraction]) -> list[Range]:
    """Return the intervals between phases that increase; else Unproved."""
    Phases(cuts[0], cuts[-1])  # raises where this is no interval of them
    if not increasing(cuts):
        raise Unproved("the cuts of a branch must increase")
    return list(pairwise(cuts))
