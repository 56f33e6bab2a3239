"""Flights of single-impact orbits that touch the table once; see `trusted.paper.beyond.grazing`."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from intervals import Undecided
from proofs.motion.witness import first_step
from proofs.trusted.flights import whole_turns
from proofs.trusted.kernel.gaps import Gap, falls, stays_up
from proofs.trusted.numbers import COVER_BITS, Range

_LONGEST = Fraction(1, 4)
_SHORTEST = Fraction(1, 1000)
_SHRINK = Fraction(3, 4)
_UNIT = Fraction(1, 1024)


def touching_once(gap_of: Gap, order: int, touch: Range, n: int) -> list[Fraction]:
    """Return times by which flights touch the table at `touch` alone before 2 pi n.

    They are those of the rule `grazing-curve`; order: that of the first derivative of the gap that
    is > 0 at launch. Undecided where that does not succeed.
    """
    begin, end = _widest(touch, lambda times: gap_of(times, 2).lo > 0)
    last = _widest(whole_turns(n, COVER_BITS), lambda times: falls(gap_of, times))
    if gap_of((last[1], last[1]), 0).hi >= 0:
        raise Undecided("the impact is not proved to be over")
    before = _closed(gap_of, first_step(gap_of, (order,)), begin)
    return [*before, begin, *_closed(gap_of, end, last[0]), last[0], last[1]]


def _closed(gap_of: Gap, low: Fraction, high: Fraction) -> list[Fraction]:
    """Return times from `low` on, `high` excluded, between which the gap stays up."""
    times, now, step = [low], low, _LONGEST
    while now < high:
        ahead = min(now + step, high)
        least = min(gap_of((time, time), 0).lo for time in (now, ahead))
        if stays_up(gap_of, (now, ahead), least):
            times.append(ahead)
            now, step = ahead, 2 * step
        elif step < _SHORTEST:
            raise Undecided("another touch on the way is not excluded")
        else:
            step /= 2
    return times[:-1]


def _widest(inside: Range, holds: Callable[[Range], bool]) -> Range:
    """Return an interval around another one, as wide as one may be, on which something holds."""
    reach = Fraction(1)
    while reach > _SHORTEST:
        low, high = (inside[0] - reach) // _UNIT * _UNIT, -(-(inside[1] + reach) // _UNIT) * _UNIT
        if low > 0 and holds((low, high)):
            return low, high
        reach *= _SHRINK
    raise Undecided("no room around a touch or an impact")
