"""Flights after plastic impacts, in the checker's arithmetic; turns of the table."""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property, partial

from proofs.trusted.equations import Clock, Launch, clock, gap, launch
from proofs.trusted.kernel.arithmetic import Dual, Enclosure, pi, rational
from proofs.trusted.kernel.gaps import Gap
from proofs.trusted.numbers import COVER_BITS, Range
from proofs.trusted.parameters import Place


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
    def start(self) -> Launch:
        """The launch states."""
        return self.launch(Enclosure.of(*self.phases, self.bits))

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
        along: Dual = gap(self.start._replace(eta=moving), clock(moving, t), order)
        reach = Enclosure.of(low - middle, high - middle, self.bits)
        return centre.gap_of(time, order) + along.derivative * reach

    @property
    def gap_of(self) -> Gap:
        """The gap as a function of time and order."""
        return partial(self.gap, self.start)


# -- phases ----------------------------------------------------------------------------------------


def whole_turns(count: int, bits: int) -> Range:
    """Enclose count 2 pi."""
    return (pi(bits) * (2 * count)).range


def lifted(phases: Range, turns: int, bits: int) -> Range:
    """Enclose phases + 2 pi turns."""
    low, high = whole_turns(turns, bits)
    return phases[0] + low, phases[1] + high
