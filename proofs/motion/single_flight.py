"""Flights of single-impact orbits, eta and p in a piece; see `trusted.paper.beyond.grazing`."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

from intervals import Interval, Jet, Undecided
from proofs.motion.flight import Flight
from proofs.motion.impact import first_step, positive_between
from proofs.motion.phase import turn
from proofs.motion.system import System
from proofs.trusted.equations import Clock, Launch, clock, gap
from proofs.trusted.kernel.enclose import centre_of
from proofs.trusted.kernel.zeros import Piece
from proofs.trusted.numbers import Range
from proofs.trusted.paper.beyond.grazing import ETA, P, single_launch

_NOW = Fraction(0)
_LONGEST = Fraction(1, 4)
_SHORTEST = Fraction(1, 1000)
_SHRINK = Fraction(3, 4)
_UNIT = Fraction(1, 1024)


@dataclass(frozen=True, kw_only=True)
class SingleFlight(Flight):
    """The flights of the solutions with n table periods between impacts, eta and p in a piece.

    The gap is enclosed directly and by the mean value theorem in eta, along the slope of the piece.
    """

    n: int
    q: Fraction
    piece: Piece

    @classmethod
    def of(cls, n: int, q: Fraction, side: int, piece: Piece) -> SingleFlight:
        """Return the flights for (eta, p) in a piece."""
        system = System(centre_of(piece.box)[ETA], Fraction(side))
        return cls(system, (_NOW, _NOW), n=n, q=q, piece=piece)

    def _single(self, eta: Interval | Jet, p: Interval | Jet) -> Launch:
        pi = Interval.pi(precision=self.precision)
        return single_launch(self.n, self.q, self.system.side, (eta, p), pi)

    @cached_property
    def start(self) -> Launch:
        """The launch states at the middle of the piece."""
        share = Interval(*self.piece.box[P], precision=self.precision)
        return self._single(self.eta, share)

    @cached_property
    def _moving(self) -> tuple[Jet, Launch]:
        bits, sides = self.precision, self.piece.hull(ETA)
        one, slope = (Interval(x, precision=bits) for x in (1, self.piece.slope[P]))
        eta, p = (Interval(*sides[k], precision=bits) for k in (ETA, P))
        moving = Jet(eta, one)
        return moving, self._single(moving, Jet(p, slope))

    def gap(self, low: Fraction, high: Fraction | None = None, order: int = 0) -> Interval:
        """Enclose a time derivative of the gap over the piece and the times given."""
        time = Interval(low, high, precision=self.precision)
        eta, start = self._moving
        along = gap(start, clock(eta, time), order)
        reach = eta.value - self.eta
        there = super().gap(low, high, order) + along.derivative() * reach
        found: Interval | None = there.intersection(along.value)
        if found is None:
            raise ArithmeticError("two enclosures of the same gaps are disjoint")
        return found

    @cached_property
    def bend(self) -> Interval:
        """An enclosure of gap'' over the piece at all times."""
        unit = Interval(-1, 1, precision=self.precision)
        value: Interval = gap(self._moving[1], Clock(unit, unit, unit, unit), 2).value
        return value

    def rises(self, until: Fraction) -> bool:
        """Whether gap > 0 on (0, until]: by gap' after a rebound, by gap'' else."""
        order = 2 if self.start.kick is None else 1
        return self.gap(_NOW, until, order).certainly_positive()

    def touching_once(self, touch: Range) -> list[Fraction]:
        """Return times by which the flights touch the table at `touch` alone before 2 pi n.

        They are those of the rule `grazing-curve`; Undecided where that is not proved.
        """
        whole = turn(self.precision) * self.n
        begin, end = _widest(touch, lambda low, high: self.gap(low, high, 2).inf > 0)
        last = _widest((whole.inf, whole.sup), lambda low, high: self.velocity(low, high).sup < 0)
        if not self.gap(last[1]).certainly_negative():
            raise Undecided("the impact is not proved to be over")
        before = self._closed(first_step(self), begin)
        return [*before, begin, *self._closed(end, last[0]), last[0], last[1]]

    def _closed(self, low: Fraction, high: Fraction) -> list[Fraction]:
        """Return times from `low` on, `high` excluded, between which gap > 0 is proved."""
        times, now, step = [low], low, _LONGEST
        while now < high:
            ahead = min(now + step, high)
            if positive_between(self, now, self.gap(now), ahead, self.gap(ahead)):
                times.append(ahead)
                now, step = ahead, 2 * step
            elif step < _SHORTEST:
                raise Undecided("another touch on the way is not excluded")
            else:
                step /= 2
        return times[:-1]


def _widest(inside: Range, holds: Callable[[Fraction, Fraction], bool]) -> Range:
    """Return an interval around another one, as wide as one may be, on which something holds."""
    reach = Fraction(1)
    while reach > _SHORTEST:
        low, high = (inside[0] - reach) // _UNIT * _UNIT, -(-(inside[1] + reach) // _UNIT) * _UNIT
        if low > 0 and holds(low, high):
            return low, high
        reach *= _SHRINK
    raise Undecided("no room around a touch or an impact")
