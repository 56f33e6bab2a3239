"""Flights: which impact is the first, and when it comes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property, partial
from itertools import pairwise

from proofs.trusted.certificate import Reader
from proofs.trusted.equations import Clock, Launch, clock, gap, launch, launch_acceleration
from proofs.trusted.kernel.arithmetic import Dual, Enclosure, Unproved, pi, rational
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.gaps import Gap, brackets, first_windows
from proofs.trusted.numbers import (
    COVER_BITS,
    MAX_BITS,
    TURN,
    Range,
    bits_for,
    increasing,
    rounded_bits,
    show_range,
    within,
)
from proofs.trusted.parameters import Place

LATEST = 10**6
_ZERO = Fraction(0)


@dataclass(frozen=True)
class Motion:
    """The gap of all launches in `phases`, of all oscillators, in the checker's arithmetic."""

    at: Place
    phases: Range
    bits: int = COVER_BITS

    @property
    def side(self) -> int:
        """The sign of nu."""
        return self.at.side

    @cached_property
    def eta(self) -> Enclosure:
        """An enclosure of eta."""
        return Enclosure.of(*self.at.eta, self.bits)

    @property
    def nu(self) -> Enclosure:
        """An enclosure of nu."""
        return Enclosure.of(*self.at.nu, self.bits)

    @cached_property
    def _start(self) -> Launch:
        return self.launch(Enclosure.of(*self.phases, self.bits))

    def start(self) -> Launch:
        """Return the launch states."""
        return self._start

    def launch(self, phi: Enclosure | Dual) -> Launch:
        """Return the state after a launch at a phase."""
        return launch(self.side, self.eta, self.nu, phi)

    @cached_property
    def moving(self) -> Launch:
        """The launch states, with their derivatives in the phase."""
        one = rational(Fraction(1), self.bits)
        return self.launch(Dual(Enclosure.of(*self.phases, self.bits), one))

    @cached_property
    def outer(self) -> tuple[Launch, Launch]:
        """The states after launches at the ends of the phases."""
        first, last = (self.launch(rational(end, self.bits)) for end in self.phases)
        return first, last

    def clock(self, time: Range | Dual) -> Clock:
        """Return the time functions over an interval of times."""
        t = time if isinstance(time, Dual) else Enclosure.of(*time, self.bits)
        return clock(self.eta, t)

    def gap(self, start: Launch, time: Range, order: int = 0) -> Enclosure:
        """Enclose a time derivative of the gap."""
        value: Enclosure = gap(start, self.clock(time), order)
        return value

    def sharp_gap(self, time: Range, order: int = 0) -> Enclosure:
        """Enclose what `gap_of` does, over a range of eta by the mean value theorem."""
        low, high = self.at.eta
        middle = (low + high) / 2
        centre = replace(self, at=replace(self.at, eta=(middle, middle)))
        moving = Dual(self.eta, rational(Fraction(1), self.bits))
        t = Enclosure.of(*time, self.bits)
        along: Dual = gap(self.start()._replace(eta=moving), clock(moving, t), order)
        reach = Enclosure.of(low - middle, high - middle, self.bits)
        return centre.gap_of(time, order) + along.derivative * reach

    @property
    def gap_of(self) -> Gap:
        """The gap as a function of time and order."""
        return partial(self.gap, self.start())


@dataclass(frozen=True)
class FirstImpact(Conclusion):
    """Every launch in motion.phases has its first impact, at a time in one of `windows`."""

    at: Place
    motion: Motion
    windows: tuple[Range, ...]
    transversal: bool

    @property
    def sentence(self) -> str:
        times = ", ".join(show_range(window) for window in self.windows)
        kind = "transversal first" if self.transversal else "first"
        return (
            f"every launch from a phase in {show_range(self.motion.phases)} has its {kind} impact "
            f"at a time in {times}."
        )


def read_phases(reader: Reader, turns: int = 1) -> Range:
    """Read an interval of phases from 0 to 2 pi, or some turns more; one phase as well."""
    low, high = reader.range()
    if low < 0 or high > turns * TURN:
        raise reader.fail(f"phases lie between 0 and {2 * turns} pi")
    return low, high


def read_times(reader: Reader) -> tuple[Fraction, ...]:
    """Read times 0 < t_1 < ... < t_n, n >= 2."""
    times = reader.numbers(least=2)
    if times[-1] > LATEST or not increasing((_ZERO, *times)):
        raise reader.fail(f"times must increase from 0, to at most {LATEST}")
    return times


def first_impact(context: Context, reader: Reader) -> FirstImpact:
    """Rule `first-impact`: {phases, times 0 < t_1 < ... < t_n}; phases from 0 to 4 pi.

    Hypotheses: on phases x [0, t_1] gap'' > 0, or gap''' > 0 with gap'' >= 0 at launch; gap < 0
    at t_n. A piece [t_j, t_(j+1)] of width
    w is closed if min(gap(t_j), gap(t_(j+1))) > w^2/8 max(0, sup gap'') on it, else open.
    Conclusion: each launch has a first impact, in an open piece. It is transversal (unique, smooth
    in the phase) if the open pieces are one interval that ends at t_n, with gap' < 0 on it.

    Proof. gap = gap' = 0 at launch, so gap > 0 on (0, t_1]. The error of linear interpolation over
    a width w is at most w^2/8 sup |gap''|, and below the chord at most w^2/8 max(0, sup gap''): so
    gap > 0 on closed pieces. gap < 0 at t_n: it has a first zero, in an open piece. Where gap' < 0
    there is no other, and it is smooth in the phase by the implicit function theorem.
    """
    phases_of, times_of = reader.fields("phases", "times")
    times, at = read_times(times_of), context.place
    motion = Motion(at, read_phases(phases_of, 2), bits_for_pieces(times))
    orders = (2, 3) if launch_acceleration(motion.start()).lo >= 0 else (2,)
    return FirstImpact(at, motion, *first_windows(motion.gap_of, times, *orders))


def bits_for_pieces(times: Sequence[Fraction]) -> int:
    """Return the precision for pieces of times: gaps are of the order w^2 in a piece of width w."""
    shortest = min(now - before for before, now in pairwise((_ZERO, *times)))
    return rounded_bits(COVER_BITS + 2 * (1 / shortest).__ceil__().bit_length())


def bracketed(step: FirstImpact, phases: Range, time: Range) -> Motion:
    """Return the motion, at the precision of a bracket in which all launches in `phases` impact.

    In the window of a transversal impact the gap falls through its only zero, so gap > 0 at the
    lower end and gap < 0 at the upper one bracket it.
    """
    if not within(time, step.windows[0]):
        raise Unproved("a bracket leaves the window of the first impact")
    bits = bits_for(time)
    for factor in (1, 2, 4):  # a slow impact needs more
        inner = replace(step.motion, phases=phases, bits=min(factor * bits, MAX_BITS))
        if any(brackets(gap_of, time) for gap_of in (inner.gap_of, inner.sharp_gap)):
            return inner
    raise Unproved("a bracket does not have the signs +, - at its ends")


# -- phases ----------------------------------------------------------------------------------------


def whole_turns(count: int, bits: int) -> Range:
    """Enclose count 2 pi."""
    return (pi(bits) * (2 * count)).range


def lifted(phases: Range, turns: int, bits: int) -> Range:
    """Enclose phases + 2 pi turns."""
    low, high = whole_turns(turns, bits)
    return phases[0] + low, phases[1] + high
