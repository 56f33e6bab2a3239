"""The plastic impact map on the two sets of a horseshoe, as `proofs.methods.orbits` wants it."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cache, cached_property
from typing import NamedTuple

import numpy as np

from intervals import Interval, IntervalArray, Undecided
from intervals.rounding import float_down, float_up
from proofs.methods.orbits import Floats
from proofs.methods.words import Symbols
from proofs.motion.kernel import Launches, enclose_times
from proofs.motion.many import float_clock, float_launch, next_impacts
from proofs.motion.system import System
from proofs.motion.witness import HORIZON
from proofs.trusted.equations import Clock, Launch, gap, launch, slope
from proofs.trusted.flights import FirstImpact
from proofs.trusted.numbers import Range
from proofs.trusted.parameters import Parameters

_STEPS = 5  # of Newton's method, from between two phases of the grid
_GRID = 17  # phases of a part whose flights are seen first


def turn(precision: int) -> Interval:
    """Enclose 2 pi."""
    return Interval.pi(precision=precision) * 2


@dataclass(frozen=True)
class ImpactMap:
    """f on I0 and I1 for `proofs.methods.orbits`: the horseshoe `of`, proved elsewhere.

    On I_j, f(phi) is phi + t - 2 pi turns[j], t the time of the first impact, and covers I.
    parts: transversal first impacts on all of I0 and I1, rounded outward to binary64, in order.
    """

    of: Parameters
    expansion: Fraction
    parts: tuple[FirstImpact, ...]
    turns: tuple[int, int]

    @property
    def domains(self) -> tuple[Range, ...]:
        """I0 and I1."""
        return self.of.left, self.of.right

    @cached_property
    def system(self) -> System:
        """The oscillator."""
        return System(self.of.eta, self.of.nu)

    @cached_property
    def _table(self) -> tuple[Floats, Floats, Floats]:
        """Of the parts: both ends, and times up to which no impact follows."""
        phases = [part.motion.phases for part in self.parts]
        lower = np.array([float_up(low) for low, _ in phases])
        upper = np.array([float_down(high) for _, high in phases])
        return lower, upper, np.array([float_down(part.windows[0][0]) for part in self.parts])

    @cached_property
    def _seen(self) -> tuple[Floats, Floats]:
        """Increasing phases, and about the times of their first impacts."""
        lower, upper, _ = self._table
        phases = np.linspace(lower, upper, _GRID, axis=1).ravel()
        times = next_impacts(
            self.system.side, float(self.of.eta), float(self.of.nu), phases, float(HORIZON)
        ).times
        if np.isnan(times).any():
            raise Undecided("in floating point a phase sticks, or never impacts")
        return phases, times

    def _last(self, x: Floats) -> Floats:
        """Return times up to which no impact follows launches at x: each in the last part that does
        not begin after it.
        """
        lower, upper, last = self._table
        index = np.searchsorted(lower, x, side="right") - 1
        if not ((lower[index] <= x) & (x <= upper[index])).all():
            raise ValueError("a phase outside I0 and I1")
        return last[index]

    def _flights(self, x: Floats) -> tuple[Floats, Floats]:
        """Return about the time of flight after x and f', by Newton's method from what is seen."""
        t = np.interp(x, *self._seen)
        start = float_launch(self.system, x)
        for _ in range(_STEPS):
            now = float_clock(self.system, t)
            t = t - gap(start, now) / gap(start, now, 1)
        return t, np.asarray(slope(start, now))

    def approximate(self, symbols: Symbols, x: Floats) -> tuple[Floats, Floats]:
        """Return about f and f'."""
        t, slopes = self._flights(x)
        return x + t - 2.0 * np.pi * np.array(self.turns)[symbols], slopes

    def defects(self, symbols: Symbols, x: Floats, y: Floats) -> IntervalArray:
        """Enclose f(x) - y."""
        t, phases = self._flights(x)[0], IntervalArray.from_floats(x)
        times = enclose_times(Launches(self.system, phases), self._last(x), (t, t))
        whole = IntervalArray([turn(100) * count for count in self.turns])[symbols]
        return times - whole + phases - IntervalArray.from_floats(y)

    def germs(self, symbols: Symbols, boxes: IntervalArray) -> ImpactGerms:
        """Return f near the boxes; a box over two parts has no impact before either's last time."""
        (t, slopes), launches = self._flights(boxes.mid), Launches(self.system, boxes)
        last = np.minimum(self._last(boxes.inf), self._last(boxes.sup))
        times = enclose_times(launches, last, (t, t), 2.0 * np.abs(slopes - 1.0) * boxes.rad)
        return ImpactGerms(self.system, launches, times, self.turns, symbols)


class _Window(NamedTuple):
    """The times around an impact, gap' over them, and the turns of the table up to there."""

    times: Interval
    speed: Interval
    turns: int


class _Constants(NamedTuple):
    """eta, nu, and the phase of the mass after a turn of the table, 2 pi eta."""

    eta: Interval
    nu: Interval
    mass_turn: Interval


@dataclass(frozen=True)
class ImpactGerms:
    """f over boxes of launches: `times` holds exactly one zero of the gap, the first impact.

    x and y below are phases in a box and next to its image, so that t = y - x + 2 pi turns is
    the time from x to y. Let t* be that of the impact after x. Where t is in the window `times`,

        f(x) - y = t* - t = -gap(t) / gap'(s), with s between t and t*, in the window too,

    by the mean value theorem, as gap(t*) = 0. If f(x) = y, then t = t*. The table's sine and
    cosine do not see the turns, and are taken of y - x: of a smaller number, with less rounding.
    """

    system: System
    launches: Launches
    times: IntervalArray
    turns: tuple[int, int]
    symbols: Symbols

    @cached_property
    def slopes(self) -> IntervalArray:
        """Enclosures of f'."""
        return self.launches.slopes(self.times)

    @cached_property
    def _speeds(self) -> IntervalArray:
        """Enclosures of gap' over boxes and windows."""
        return self.launches.speeds(self.times)

    @cached_property
    def _windows(self) -> list[_Window]:
        """The windows, one by one."""
        turns = [self.turns[symbol] for symbol in self.symbols.tolist()]
        return list(map(_Window, self.times.tolist(), self._speeds.tolist(), turns))

    def _flight(self, index: int, x: Interval, y: Interval) -> tuple[Launch, Clock]:
        """Return the launches at x, and the clock at t."""
        at, ahead, turns = _constants(self.system, x.precision), y - x, self._windows[index].turns
        now = Clock(*(at.eta * ahead + at.mass_turn * turns).sincos(), *ahead.sincos())
        return launch(self.system.side, at.eta, at.nu, x), now

    def defect(self, index: int, x: Interval, y: Interval) -> Interval:
        """Enclose f(x) - y."""
        window = self._windows[index]
        time = y - x + turn(x.precision) * window.turns
        if not time.subset(window.times):
            raise Undecided(_FAR)
        height: Interval = gap(*self._flight(index, x, y))
        return -height / window.speed

    def slope(self, index: int, x: Interval, y: Interval) -> Interval:
        """Enclose f' at the points of x with images in y."""
        found: Interval = slope(*self._flight(index, x, y))
        return found

    def _all_turns(self, each: Interval) -> IntervalArray:
        """Return the turns of each box, times a constant, as tight as binary64 can."""
        return IntervalArray([each * count for count in self.turns])[self.symbols]

    def _flights(self, x: IntervalArray, y: IntervalArray) -> tuple[Launch, Clock]:
        """Do `_flight` for all boxes at once."""
        ahead = y - x
        mass = ahead * self.system.eta + self._all_turns(_constants(self.system, 100).mass_turn)
        return Launches(self.system, x).start, Clock(*mass.sincos(), *ahead.sincos())

    def defects(self, x: IntervalArray, y: IntervalArray) -> IntervalArray:
        """Enclose f(x) - y for all boxes at once."""
        if not (y - x + self._all_turns(turn(100))).subset(self.times).all():
            raise Undecided(_FAR)
        height: IntervalArray = gap(*self._flights(x, y))
        return -height / self._speeds

    def slopes_at(self, x: IntervalArray, y: IntervalArray) -> IntervalArray:
        """Enclose f' for all boxes at once."""
        found: IntervalArray = slope(*self._flights(x, y))
        return found


@cache
def _constants(system: System, precision: int) -> _Constants:
    """Return the constants at a precision."""
    eta, nu = (Interval(x, precision=precision) for x in (system.eta, system.nu))
    return _Constants(eta, nu, turn(precision) * eta)


_FAR = "a candidate is too far from the orbit"
