"""The plastic impact map on the two sets of a horseshoe, as `proofs.methods.orbits` wants it."""

from __future__ import annotations

from bisect import bisect
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

import numpy as np

from intervals import Interval, Undecided
from proofs.methods.orbits import Floats
from proofs.methods.words import Symbols
from proofs.motion.many import next_impacts
from proofs.motion.system import System
from proofs.motion.witness import HORIZON
from proofs.trusted.equations import Clock, Launch, clock, gap, launch, slope
from proofs.trusted.numbers import Range
from proofs.trusted.parameters import Parameters

_STEPS = 5  # of Newton's method, from between two phases of the grid
_GRID = 17  # phases of a part whose flights are seen first
_FAR = "a candidate is too far from the orbit"
_ROUNDING = 12  # bits of a time that may be lost


def turn(precision: int) -> Interval:
    """Enclose 2 pi."""
    return Interval.pi(precision=precision) * 2


@dataclass(frozen=True)
class ImpactMap:
    """f on I0 and I1 for `proofs.methods.orbits`: the horseshoe `of`, proved elsewhere.

    On I_j, f(phi) is phi + t - 2 pi turns[j], t the time of the first impact, and covers I.
    windows: of the transversal first impacts on the parts, in order, of I0 and I1, rounded outward
    to binary64.

    Below t is the time from a phase x to y, next to f(x), and t* that of the first impact after x.
    The gap falls all over the window of the part of x, and t* is its one zero there. Between times
    with gap > 0 and gap < 0 around t, by the mean value theorem, f(x) - y = t* - t =
    -gap(t) / gap'(s) with s between them. The table's sine and cosine do not see whole turns, and
    are taken of y - x: of a smaller number, with less rounding.
    """

    of: Parameters
    expansion: Fraction
    windows: Mapping[Range, Range]
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
    def _ends(self) -> list[Range]:
        """The phases of the parts."""
        return list(self.windows)

    @cached_property
    def _seen(self) -> tuple[Floats, Floats]:
        """Increasing phases, and about the times of their first impacts."""
        lower, upper = np.array(self._ends, float).T
        phases = np.linspace(lower, upper, _GRID, axis=1).ravel()
        times = next_impacts(
            self.system.side, float(self.of.eta), float(self.of.nu), phases, float(HORIZON)
        ).times
        if np.isnan(times).any():
            raise Undecided("in floating point a phase sticks, or never impacts")
        return phases, times

    def approximate(self, symbols: Symbols, x: Floats) -> tuple[Floats, Floats]:
        """Return about f and f', by Newton's method from the flights that are seen."""
        t = np.interp(x, *self._seen)
        start = self.system.launched(x)
        for _ in range(_STEPS):
            now = clock(float(self.system.eta), t)
            t = t - gap(start, now) / gap(start, now, 1)
        return x + t - 2.0 * np.pi * np.array(self.turns)[symbols], np.asarray(slope(start, now))

    def _window(self, x: Interval) -> Interval:
        """Return times in which the gap falls for all launches of the part of x."""
        index = bisect(self._ends, x.inf, key=lambda ends: ends[0]) - 1
        if index < 0 or x.sup > self._ends[index][1]:
            raise ValueError("a phase outside I0 and I1")
        return Interval(*self.windows[self._ends[index]], precision=x.precision)

    def _launch(self, x: Interval) -> Launch:
        """Return the launches at x."""
        eta, nu = (Interval(each, precision=x.precision) for each in (self.of.eta, self.of.nu))
        return launch(self.system.side, eta, nu, x)

    def _clock(self, symbol: int, x: Interval, y: Interval) -> Clock:
        """Return the clock at t."""
        ahead, eta = y - x, self.of.eta
        return Clock(
            *((ahead + turn(x.precision) * self.turns[symbol]) * eta).sincos(), *ahead.sincos()
        )

    def defect(self, symbol: int, x: Interval, y: Interval) -> Interval:
        """Enclose f(x) - y; Undecided where that is not small."""
        start, now = self._launch(x), self._clock(symbol, x, y)
        time = y - x + turn(x.precision) * self.turns[symbol]
        height, speed = gap(start, now), gap(start, now, 1)
        if speed.contains_zero():
            raise Undecided(_FAR)
        reach = 2 * (height / speed).mag + time.mag / 2 ** (x.precision - _ROUNDING)
        times = time.widen(reach)
        above, below = (
            gap(start, clock(start.eta, Interval(end, precision=x.precision)))
            for end in (times.inf, times.sup)
        )
        if not (times.subset(self._window(x)) and above.inf > 0 > below.sup):
            raise Undecided(_FAR)
        distance: Interval = -height / gap(start, clock(start.eta, times), 1)
        return distance

    def slope(self, symbol: int, x: Interval, y: Interval) -> Interval:
        """Enclose f' at the points of x with images in y."""
        steepness: Interval = slope(self._launch(x), self._clock(symbol, x, y))
        return steepness
