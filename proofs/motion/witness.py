"""Times that say where flights have their first impact, found with the checker's own search.

Nothing here is evidence: what a rule concludes from the times is.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import cache
from typing import NamedTuple

from intervals.errors import Undecided
from proofs.trusted.flights import Motion
from proofs.trusted.kernel import firstzero
from proofs.trusted.kernel.arithmetic import Enclosure
from proofs.trusted.kernel.firstzero import FirstZero
from proofs.trusted.kernel.gaps import Gap, stays_up

HORIZON = Fraction(1000)
_NOW = Fraction(0)
_ORDERS = (0, 1, 2, 3, 4)
_TINIEST = Fraction(1, 2**200)
_FINEST = Fraction(1, 2**60)  # step of time


class NoImpact(Undecided):
    """No impact was found up to the horizon (or the mass never separates from the table)."""


class Impossible(ValueError):
    """No mass above the table can have this velocity before an impact at this phase."""


class Flights(NamedTuple):
    """Flights as the checker's search asks for them: the gap's derivatives, by their orders."""

    gap_of: Gap
    states: Sequence[Enclosure]

    @classmethod
    def plastic(cls, motion: Motion) -> Flights:
        """Return those after plastic impacts."""
        return cls(motion.gap_of, [Enclosure.of(*motion.phases, motion.bits)])

    def on(self, roots: Sequence[int], t: Enclosure) -> list[Enclosure]:
        """Enclose derivatives of the gap."""
        return [self.gap_of(t.range, order) for order in roots]

    def search(self, order: int) -> FirstZero:
        """Return the search for the first impacts; order: of the derivative > 0 at launch."""
        return FirstZero(self, firstzero.Gap(_ORDERS, order, order, is_constant=False))

    def times(self, orders: Sequence[int], horizon: Fraction = HORIZON) -> list[Fraction]:
        """Return times between which the gap is > 0, and the window of the impact at the end.

        orders: of which one derivative is > 0 at launch. Raises Unproved where no transversal first
        impact is proved, Undecided where the times are not found.
        """
        first, order = first_step(self.gap_of, orders)
        search = self.search(order)
        low, high = search.window(horizon)
        unit = 1 << search.bits
        taken = (Fraction(time, unit) for time in search.taken)
        between = [time for time in taken if first < time < low]
        return [*closed(self.gap_of, [first, *between, low]), high]


def first_step(gap_of: Gap, orders: Sequence[int]) -> tuple[Fraction, int]:
    """Return a time up to which a derivative of one of these orders is > 0, and which."""
    step = Fraction(1)
    while step > _TINIEST:
        for order in orders:
            if gap_of((_NOW, step), order).lo > 0:
                return step, order
        step /= 2
    raise Undecided("a phase sticks, or it is not decided whether it does")


def closed(gap_of: Gap, times: Sequence[Fraction]) -> list[Fraction]:
    """Return times, and others between where they are needed, between which the gap stays up."""
    height = cache(lambda time: gap_of((time, time), 0).lo)
    done, ahead = [times[0]], [*reversed(times[1:])]
    while ahead:
        piece = done[-1], ahead[-1]
        if stays_up(gap_of, piece, min(map(height, piece))):
            done.append(ahead.pop())
        elif piece[1] - piece[0] < _FINEST:
            raise Undecided("another touch on the way is not excluded")
        else:
            ahead.append((piece[0] + piece[1]) / 2)
    return done
