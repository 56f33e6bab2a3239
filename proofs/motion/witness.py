"""Times that say where flights have their first impact, found with the checker's own search.

Nothing here is evidence: what a rule concludes from the times is.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import cache
from typing import NamedTuple

from intervals.errors import Undecided
from proofs.trusted.flights import Motion, whole_turns
from proofs.trusted.kernel import firstzero
from proofs.trusted.kernel.arithmetic import Enclosure
from proofs.trusted.kernel.firstzero import FirstZero
from proofs.trusted.kernel.gaps import Gap, falls, stays_up
from proofs.trusted.numbers import COVER_BITS, Range

HORIZON = Fraction(1000)
_NOW = Fraction(0)
_ORDERS = (0, 1, 2, 3, 4)
_TINIEST = Fraction(1, 2**200)
_FINEST = Fraction(1, 2**60)  # step of time
_WIDEST, _NARROWEST = Fraction(1), Fraction(1, 1000)  # interval around a touch
_SHRINK, _UNIT = Fraction(3, 4), Fraction(1, 1024)


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
        """Return times as `first_windows` takes them, the window of the impact at the end.

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


def touching_once(gap_of: Gap, order: int, touch: Range, n: int) -> list[Fraction]:
    """Return times by which flights touch the table at `touch` alone before 2 pi n.

    They are those of the rule `grazing-curve`; order: that of the first derivative of the gap that
    is > 0 at launch. Undecided where that does not succeed.
    """
    begin, end = _widest(touch, lambda times: gap_of(times, 2).lo > 0)
    last = _widest(whole_turns(n, COVER_BITS), lambda times: falls(gap_of, times))
    if gap_of((last[1], last[1]), 0).hi >= 0:
        raise Undecided("the impact is not proved to be over")
    before = closed(gap_of, [first_step(gap_of, (order,))[0], begin])
    return [*before, *closed(gap_of, [end, last[0]]), last[1]]


def _widest(inside: Range, holds: Callable[[Range], bool]) -> Range:
    """Return an interval around another one, as wide as one may be, on which something holds."""
    reach = _WIDEST
    while reach > _NARROWEST:
        low, high = (inside[0] - reach) // _UNIT * _UNIT, -(-(inside[1] + reach) // _UNIT) * _UNIT
        if low > 0 and holds((low, high)):
            return low, high
        reach *= _SHRINK
    raise Undecided("no room around a touch or an impact")
