"""Times for rule `first-impact`, over boxes of oscillators: proposed from interval enclosures.

The gap is enclosed on a grid of times, by the checker's own formula and so about as widely; what
is proposed here is proved by the checker alone.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from intervals import Interval, IntervalArray, Jet, Undecided
from proofs.trusted.equations import Launch, clock, gap, launch, launch_acceleration
from proofs.trusted.numbers import Range
from proofs.trusted.parameters import Place

Floats = NDArray[np.floating[Any]]
_UNITS = Fraction(1, 4), Fraction(1, 16), Fraction(1, 64)
_SPANS = (1, 2, 3, 5, 8, 12, 16, 22, 32, 48, 64, 88)  # lengths of pieces, in units
_LONGEST = Fraction(11, 2)  # piece
_SPARE = 1.02  # by which a gap must be above what the checker asks for
_EARLIEST = 8  # halvings of the first time
_SHARE = 0.3  # of the height from which the gap falls, where the window of the impact begins
_PARTS = 512  # of the window of an impact
_BITS = 80


@dataclass(frozen=True)
class Flights:
    """The flights of all launches in `phases`, of all oscillators in `box`.

    unit: of the grid of times.
    """

    box: Place
    phases: Range
    separating: bool = False
    unit: Fraction = _UNITS[0]

    @cached_property
    def _eta(self) -> IntervalArray:
        return _array([self.box.eta])

    @cached_property
    def _start(self) -> Launch:
        return launch(self.box.side, self._eta, _array([self.box.nu]), _array([self.phases]))

    @property
    def _orders(self) -> list[int]:
        """The derivatives of the gap one of which has to be > 0 at first."""
        pushed = self.separating or bool(launch_acceleration(self._start).inf[0] >= 0)
        return [2, 3] if pushed else [2]

    def gap(self, low: Floats, high: Floats, order: int = 0) -> IntervalArray:
        """Enclose a derivative of the gap on intervals of times."""
        times = IntervalArray.from_floats(low, high)
        found: IntervalArray = gap(self._start, clock(self._eta, times), order)
        return found

    def sharp_heights(self, times: Floats) -> IntervalArray:
        """Enclose the gap at times, over a range of eta by the mean value theorem."""
        low, high = self.box.eta
        middle = (low + high) / 2
        centre = replace(self, box=replace(self.box, eta=(middle, middle)))
        moving = Jet.variable(self._eta)
        at = clock(moving, IntervalArray.from_floats(times, times))
        along: Jet = gap(self._start._replace(eta=moving), at)
        found: IntervalArray = along.derivative() * _array([(low - middle, high - middle)])
        return found + centre.gap(times, times)

    def times(self, latest: float) -> list[Fraction]:
        """Return times for the rule, for flights that end at about `latest` at most.

        Raises Undecided where none seem to prove a transversal first impact.
        """
        first = self._first()
        grid = np.arange(0.0, latest + float(_LONGEST) + 1, float(self.unit))
        heights = self.gap(grid, grid)
        begin = int(np.ceil(float(first / self.unit)))
        clear, below = heights.inf > 0, heights.sup < 0
        ends = np.flatnonzero(below & (np.arange(grid.size) > begin))
        if not ends.size or not clear[begin]:
            raise Undecided("no time is seen at which all flights have ended")
        end = int(ends[0])
        window = self._window(grid, heights.inf, begin, end)
        steps = [begin, *self._pieces(grid, heights.inf, begin, window)]
        early = [first] if first < begin * self.unit else []
        return [*early, *(k * self.unit for k in steps), end * self.unit]

    def bracket(self, times: list[Fraction]) -> Range:
        """Return a bracket of all first impacts, in the last of the pieces between `times`."""
        low, high = times[-2:]
        heights = self.sharp_heights(np.linspace(float(low), float(high), _PARTS + 1))
        up, down = np.flatnonzero(heights.inf > 0), np.flatnonzero(heights.sup < 0)
        if not up.size or not down.size or up[-1] > down[0]:
            raise Undecided("the first impacts are not bracketed")
        unit = (high - low) / _PARTS
        return low + int(up[-1]) * unit, low + int(down[0]) * unit

    def _first(self) -> Fraction:
        """Return a time up to which the launches leave the table."""
        times = np.array([0.5**k for k in range(_EARLIEST)])
        rates = [self.gap(np.zeros(_EARLIEST), times, order).inf for order in self._orders]
        leaving = np.flatnonzero(np.max(rates, axis=0) > 0)
        if not leaving.size:
            raise Undecided("some launches stick, or leave too slowly")
        return Fraction(1, 2 ** int(leaving[0]))

    def _window(self, grid: Floats, least: Floats, begin: int, end: int) -> int:
        """Return where the window of the impact begins: the gap falls from there to the end."""
        speeds = self.gap(grid[:end], grid[1 : end + 1], 1).sup
        rising = np.flatnonzero(speeds >= 0)
        first = max(begin, int(rising[-1]) + 1 if rising.size else begin)
        high = np.flatnonzero(least[first:end] >= max(_SHARE * least[first], 1e-9))
        if not high.size:
            raise Undecided("the gap is not seen to fall to the impact")
        return first + int(high[-1])

    def _pieces(self, grid: Floats, least: Floats, begin: int, last: int) -> Iterator[int]:
        """Yield the ends of pieces from `begin` to `last` on which the gap stays up."""
        unit, spans = float(self.unit), np.array([k for k in _SPANS if k * self.unit <= _LONGEST])
        low = np.broadcast_to(grid[begin:last], (spans.size, last - begin))
        bends = self.gap(low, low + unit * spans[:, None], 2).sup
        ahead = np.minimum(np.arange(begin, last) + spans[:, None], least.size - 1)
        sides = np.minimum(least[begin:last], least[ahead])
        need = np.maximum(bends, 0) * (unit * spans[:, None]) ** 2 / 8
        closed = (sides > _SPARE * need) & (ahead <= last)
        here = begin
        while here < last:
            fitting = np.flatnonzero(closed[:, here - begin])
            if not fitting.size:
                raise Undecided("an earlier impact is not excluded")
            here += int(spans[fitting[-1]])
            yield here


def times_for(flights: Flights, latest: float) -> list[Fraction]:
    """Return what `times` gives, on the coarsest grid that shows it."""
    for unit in _UNITS[:-1]:
        with suppress(Undecided):
            return replace(flights, unit=unit).times(latest)
    return replace(flights, unit=_UNITS[-1]).times(latest)


def _array(ranges: list[Range]) -> IntervalArray:
    return IntervalArray([Interval(low, high, precision=_BITS) for low, high in ranges])
