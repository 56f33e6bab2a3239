"""All flights that start in a set of phases: the equations, enclosed in any precision."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING, Any

from proofs.methods.extremes import piece_range
from proofs.motion.sketch import Sketch
from proofs.motion.system import System
from proofs.trusted.equations import Clock, Launch, clock, gap, launch, launch_acceleration, slope
from proofs.trusted.kernel.arithmetic import Dual, Enclosure
from proofs.trusted.numbers import Range

if TYPE_CHECKING:
    from intervals import Interval

_NOW = Fraction(0)
Numbers = Callable[[Fraction, Fraction, int], Any]  # what makes one of its ends, at a precision


def interval(low: Fraction, high: Fraction, precision: int) -> Interval:
    """Return the numbers that prove: the class is imported where it is used, with mpmath."""
    from intervals.interval import Interval

    return Interval(low, high, precision=precision)


def sketch(low: Fraction, high: Fraction, precision: int) -> Sketch:
    """Return floats, for what the checker's rules are to conclude from: they prove nothing."""
    return Sketch(low, high)


fixed = Enclosure.of  # the checker's numbers


@dataclass(frozen=True)
class Flight:
    """All flights that start at a phase of `phases`, evaluated at `precision` bits.

    `separating` asserts that every launch acceleration is known to be >= 0 from elsewhere, as
    it is at the separation phase, where it vanishes. `numbers`: by what it is evaluated.
    """

    system: System
    phases: Range
    precision: int = 64
    separating: bool = False
    numbers: Numbers = interval

    def number(self, low: Fraction, high: Fraction | None = None) -> Any:
        """Enclose a range at this precision."""
        return self.numbers(low, low if high is None else high, self.precision)

    @property
    def etas(self) -> Range:
        """The range of the frequency ratio."""
        return self.system.eta, self.system.eta

    @cached_property
    def eta(self) -> Interval:
        """The frequency ratios at this precision."""
        value: Interval = self.number(*self.etas)
        return value

    @cached_property
    def phi(self) -> Interval:
        """The launch phases at this precision."""
        value: Interval = self.number(*self.phases)
        return value

    @cached_property
    def start(self) -> Launch:
        """The launch states."""
        return self._launch(self.phi)

    def _launch(self, phi: Interval | Dual) -> Launch:
        return launch(self.system.side, self.eta, self.number(self.system.nu), phi)

    def clock(self, low: Fraction, high: Fraction | None = None) -> Clock:
        """Return the time functions over [low, high] (at `low` alone if there is no `high`)."""
        if self.numbers is interval:
            return _clock(self.etas, low, high, self.precision)
        return clock(self.eta, self.number(low, high))  # sooner computed than looked up

    def gap(self, low: Fraction, high: Fraction | None = None, order: int = 0) -> Interval:
        """Enclose a time derivative of the gap over all launches and the times given."""
        value: Interval = gap(self.start, self.clock(low, high), order)
        return value

    @cached_property
    def bend(self) -> Interval:
        """An enclosure of gap'' at all times, coarse and made once."""
        unit = self.number(Fraction(-1), Fraction(1))
        value: Interval = gap(self.start, Clock(unit, unit, unit, unit), 2)
        return value

    def velocity(self, low: Fraction, high: Fraction) -> Interval:
        """Enclose gap' over [low, high] from its ends and gap'' (mean value theorem).

        Over a short time this is much narrower than gap' evaluated on the interval, which
        cancels where the launch is close to sticking or the impact close to grazing.
        """
        bend = self.gap(low, high, order=2)
        return piece_range(self.gap(low, order=1), self.gap(high, order=1), bend, high - low)

    def fall(self, time: Range) -> Interval:
        """Enclose gap' over all launches and the times from time[0] to time[1].

        Where that is wide, by the mean value theorem as well: after a short flight gap' is of the
        order of the time squared, and evaluated on an interval it cancels.
        """
        direct = self.gap(*time, order=1)
        if direct.wid * 2**40 < direct.mig:
            return direct
        common = direct.intersection(self.velocity(*time))
        if common is None:
            raise ArithmeticError("two enclosures of the same velocities are disjoint")
        return common

    def slope(self, time: Range) -> Interval:
        """Enclose f' over all launches, impact times in `time`."""
        value: Interval = slope(self.start, self.clock(*time), self.fall(time))
        return value

    def slope_and_curvature(self, time: Range) -> tuple[Interval, Interval]:
        """Enclose f' and f'': the slope formula along phi + s, t + (f' - 1) s + ...

        gap' changes by gap'' (f' - 1) with t: gap'' first, because it is small where gap' is.
        """
        fall: Any = self.fall(time)
        now = self.clock(*time)
        first: Any = slope(self.start, now, fall)
        one = self.number(Fraction(1))
        start = self._launch(Dual(self.number(*self.phases), one))
        change = gap(start, now, 1).derivative + self.gap(*time, order=2) * (first - one)
        along = clock(self.eta, Dual(self.number(*time), first - one))
        return first, slope(start, along, Dual(fall, change)).derivative

    @property
    def leaves(self) -> bool:
        """Whether every launch leaves the table: launch acceleration > 0 (or known >= 0)."""
        return self.separating or launch_acceleration(self.start).certainly_positive()

    def rises(self, until: Fraction) -> bool:
        """Whether gap > 0 on (0, until]: as gap(0) = gap'(0) = 0, gap'' > 0 there gives that.

        At the separation phase, where gap''(0) = 0 too, gap''' > 0 does.
        """
        orders = (2, 3) if self.separating else (2,)
        return any(self.gap(_NOW, until, order).certainly_positive() for order in orders)


@lru_cache(maxsize=1024)
def _clock(etas: Range, low: Fraction, high: Fraction | None, precision: int) -> Clock:
    """Return the time functions: the same for all launches, whose steps meet at the same times."""
    time = interval(low, low if high is None else high, precision)
    return clock(interval(*etas, precision), time)
