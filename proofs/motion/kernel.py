"""f' and impact times after thousands of boxes of phases, in binary64, all boxes at once.

Search (`find_...`) uses floats; what it returns is then proved, or Undecided is raised.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from intervals import IntervalArray, Jet, Undecided
from proofs.motion.system import System
from proofs.trusted.equations import Clock, Launch, clock, gap, launch, slope

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]

_TIGHT = 2.0**-48  # the first attempt at half the relative width of a time bracket
_ATTEMPTS = 12


@dataclass(frozen=True)
class Launches:
    """All launches from the boxes of phases, shape (n,): `FlightBox` for many sets of phases."""

    system: System
    phases: IntervalArray

    @cached_property
    def start(self) -> Launch:
        """The launch states, shape (n,)."""
        return self._launch(self.phases)

    @cached_property
    def centre(self) -> Launches:
        """The launches from one binary64 phase in every box."""
        return Launches(self.system, IntervalArray.from_floats(self.phases.mid))

    @cached_property
    def offset(self) -> IntervalArray:
        """The boxes minus their centres."""
        return self.phases - self.centre.phases

    @cached_property
    def _tangent(self) -> Launch:
        return self._launch(Jet(self.phases, 1))

    def _launch(self, phases: IntervalArray | Jet) -> Launch:
        return launch(self.system.side, self.system.eta, self.system.nu, phases)

    def clock(self, times: IntervalArray | Jet) -> Clock:
        """Return the time functions."""
        return clock(self.system.eta, times)

    def heights(self, times: Floats) -> IntervalArray:
        """Enclose the gap over box i at times[..., i]: mean-value form, centre + slope x offset."""
        now = self.clock(IntervalArray.from_floats(times))
        at_centre: IntervalArray = gap(self.centre.start, now)
        along: IntervalArray = gap(self._tangent, now).derivative()
        return at_centre + along * self.offset

    def speeds(self, times: IntervalArray, now: Clock | None = None) -> IntervalArray:
        """Enclose gap' over box i and the times in times[i], as `flights.fall` does.

        now: the clock at these times, if it is there already.
        """
        if now is None:
            now = self.clock(times)
        direct: IntervalArray = gap(self.start, now, 1)
        if direct.certainly_negative().all():
            return direct
        low, high = (IntervalArray.from_floats(each) for each in (times.inf, times.sup))
        reach = gap(self.start, now, 2) * IntervalArray.from_floats(0.0, (high - low).sup)
        before, after = (gap(self.start, self.clock(each), 1) for each in (low, high))
        common = (before + reach).intersection(after - reach)
        narrower = None if common is None else direct.intersection(common)
        if narrower is None:
            raise ArithmeticError("two enclosures of the same velocities are disjoint")
        return narrower

    def slopes(self, times: IntervalArray) -> IntervalArray:
        """Enclose f' over box i, impact times in times[i], on which gap' < 0."""
        now = self.clock(times)
        first: IntervalArray = slope(self.start, now, self.speeds(times, now))
        return first


# -- the brackets: an impact here ----------------------------------------------------------------


def prove_brackets(launches: Launches, last: Floats, low: Floats, high: Floats) -> None:
    """Prove that after box i the gap has one zero in [last_i, high_i]; it is > low_i.

    By gap(low) > 0 > gap(high) and gap' < 0 on [last, high], where last <= low < high, all of
    shape (n,). Raises Undecided with the first box on which this fails.
    """
    ordered = np.asarray((last <= low) & (low < high) & (high < np.inf))
    _require(launches, ordered, 0, "the time bracket is not one")
    speeds = launches.speeds(IntervalArray.from_floats(last, high))
    _require(launches, speeds.certainly_negative(), 0, "gap' < 0 is not proved up to the impact")
    signs = _signs(launches, low, high)
    _require(launches, signs, 0, "the gap's signs at the ends of its time bracket are not proved")


def _signs(launches: Launches, low: Floats, high: Floats) -> Mask:
    """Return masks, shape (2, n): on which boxes gap(low) > 0, and on which gap(high) < 0."""
    heights = launches.heights(np.stack((low, high)))
    return np.stack((heights[0].certainly_positive(), heights[1].certainly_negative()))


def enclose_times(
    launches: Launches, last: Floats, about: tuple[Floats, Floats], spread: Floats | float = 0.0
) -> IntervalArray:
    """Find time brackets near the candidates [about[0], about[1]] and prove them.

    They are opened by `spread` and some rounding, and more where a sign is not proved then.
    """
    low, high = about
    opening = _TIGHT * high + spread
    bracket = np.maximum(low - opening, last), high + opening
    try:
        prove_brackets(launches, last, *bracket)
    except Undecided:
        bracket = find_brackets(launches, last, about, opening)
        prove_brackets(launches, last, *bracket)
    return IntervalArray.from_floats(*bracket)


def find_brackets(
    launches: Launches, last: Floats, about: tuple[Floats, Floats], opening: Floats
) -> tuple[Floats, Floats]:
    """Return brackets around [about[0], about[1]] that seem to pass `prove_brackets`.

    Each end moves out by `opening`, twice as far again where its sign is not proved.
    """
    openings = np.stack((opening, opening))
    for _ in range(_ATTEMPTS):
        bracket = np.maximum(about[0] - openings[0], last), about[1] + openings[1]
        signs = _signs(launches, *bracket)
        if signs.all():
            break
        openings = np.where(signs, openings, 2.0 * openings)
    return bracket


def _require(launches: Launches, holds: Mask, begin: int, reason: str) -> None:
    """Raise Undecided unless all holds; the last axis of `holds` is boxes, counted from `begin`."""
    if holds.all():
        return
    index = begin + int(np.argmin(np.atleast_2d(holds).all(axis=0)))
    box = launches.phases[index]
    raise Undecided(
        f"{reason}: box {index} of {len(launches.phases)}, "
        f"phases [{float(box.inf):.12g}, {float(box.sup):.12g}]"
    )
