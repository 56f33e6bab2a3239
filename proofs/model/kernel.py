"""The subdivision kernel: f' and the first impact over thousands of boxes of phases, in binary64.

A phase interval is cut into N boxes, an IntervalArray. One grid of times serves all of them, on
which phase and time separate: the gap is lift A(t) + rate B(t) + D(t), so that sine and cosine
are taken of N phases and of the times alone, and the boxes x times are one `bilinear` form.

Search (`find_...`) uses floats; what it returns is then proved, or Undecided is raised.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from intervals import IntervalArray, Jet, Undecided
from intervals.bilinear import bilinear
from intervals.rounding import float_down, float_up
from proofs.model.candidate import next_impact
from proofs.model.equations import Clock, Launch, clock, gap, launch, slope
from proofs.model.impact import HORIZON, FirstImpact, Range, cover_by_impacts
from proofs.model.system import System

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]

CHUNK = 16384  # boxes x times at once: the temporaries stay in the cache
_TIGHT = 2.0**-48  # the first attempt at half the relative width of a time bracket
_ATTEMPTS = 12


@dataclass(frozen=True)
class Launches:
    """All launches from the boxes of phases, shape (n,): `Flight` for many sets of phases."""

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

    def clock(self, times: IntervalArray) -> Clock:
        """Return the time functions."""
        return clock(self.system.eta, times)

    def heights(self, times: Floats) -> IntervalArray:
        """Enclose the gap over box i at times[i]: mean-value form, centre + slope x offset."""
        now = self.clock(IntervalArray.from_floats(times))
        at_centre: IntervalArray = gap(self.centre.start, now)
        along: Jet = gap(self._tangent, now)
        return at_centre + along.derivative() * self.offset

    def speeds(self, low: Floats, high: Floats) -> IntervalArray:
        """Enclose gap' over box i and the times from low[i] to high[i]."""
        now = self.clock(IntervalArray.from_floats(low, high))
        return gap(self.start, now, 1)  # type: ignore[no-any-return]

    def slopes(self, times: IntervalArray) -> IntervalArray:
        """Enclose f' over box i, impact times in times[i]."""
        return slope(self.start, self.clock(times))  # type: ignore[no-any-return]

    def curvatures(self, times: IntervalArray) -> IntervalArray:
        """Enclose f'' likewise: the slope formula along phi + s, t + (f' - 1) s + ..."""
        along = self.clock(Jet(times, self.slopes(times) - 1))  # type: ignore[arg-type]
        return slope(self._tangent, along).derivative()  # type: ignore[no-any-return]


# -- the grid: no impact before ------------------------------------------------------------------


def exclude_impacts(launches: Launches, times: Sequence[float]) -> None:
    """Prove that gap > 0 on (0, t_n] after every launch, where 0 < t_1 < ... < t_n are `times`.

    On [0, t_1] by the double zero: gap(0) = gap'(0) = 0, so gap'' > 0 there gives gap > 0. On
    [t_j, t_{j+1}] by the chord: gap >= min(gap(t_j), gap(t_{j+1})) - w^2/8 max(0, gap'').
    Raises Undecided with the first box on which one of these fails.
    """
    grid = np.array([0.0, *times])
    if not (grid.size > 1 and np.isfinite(grid).all() and (np.diff(grid) > 0.0).all()):
        raise ValueError("the times must be finite, positive and increasing, and at least one")
    ends = IntervalArray.from_floats(grid[1:])
    pieces = IntervalArray.from_floats(grid[:-1], grid[1:])
    widths = IntervalArray.from_floats(grid[1:]) - IntervalArray.from_floats(grid[:-1])
    at_ends = _separated(launches.system, ends, 0)
    bends = [part * widths**2 / 8 for part in _separated(launches.system, pieces, 2)]
    lift, rate = launches.start.lift, launches.start.rate
    size = max(1, CHUNK // ends.size)
    for begin in range(0, len(launches.phases), size):
        part = slice(begin, begin + size)
        left = lift[part], rate[part]
        low = bilinear(left, at_ends[:2], at_ends[2]).inf
        bend = bilinear(left, bends[:2], bends[2])
        _require(launches, bend[:, 0].certainly_positive(), begin, _STICKS)
        _require(launches, (low > 0.0).all(axis=1), begin, _NOT_EXCLUDED)
        chord = np.minimum(low[:, :-1], low[:, 1:]) > bend.sup[:, 1:]
        _require(launches, chord.all(axis=1), begin, _NOT_EXCLUDED)


def _separated(system: System, times: IntervalArray, order: int) -> list[IntervalArray]:
    """Return A, B, D of times such that the gap's derivative is lift A + rate B + D.

    The gap is affine in lift and rate: A and B are its derivatives with respect to these at 0.
    """
    now = clock(system.eta, times)
    by_lift: Jet = gap(Launch(system.side, system.eta, Jet(0, 1), 0), now, order)
    by_rate: Jet = gap(Launch(system.side, system.eta, 0, Jet(0, 1)), now, order)
    return [by_lift.derivative(), by_rate.derivative(), by_lift.value]


# -- the brackets: an impact here ----------------------------------------------------------------


def prove_brackets(launches: Launches, last: float, low: Floats, high: Floats) -> None:
    """Prove one zero of the gap on [last, high_i], in (low_i, high_i), gap' < 0, after box i.

    By gap(low) > 0 > gap(high) and gap' < 0 on [last, high], where last <= low < high: floats,
    low and high one for each box. Raises Undecided with the first box on which this fails.
    """
    ordered = np.asarray((last <= low) & (low < high) & (high < np.inf))
    _require(launches, ordered, 0, "the time bracket is not one")
    speeds = launches.speeds(np.full_like(high, last), high)
    _require(launches, speeds.certainly_negative(), 0, "gap' < 0 is not proved up to the impact")
    signs = _signs(launches, low, high)
    _require(launches, signs[0], 0, "gap > 0 is not proved where its time bracket begins")
    _require(launches, signs[1], 0, "gap < 0 is not proved where its time bracket ends")


def _signs(launches: Launches, low: Floats, high: Floats) -> tuple[Mask, Mask]:
    """Return on which boxes gap(low) > 0, and on which gap(high) < 0."""
    return (
        launches.heights(low).certainly_positive(),
        launches.heights(high).certainly_negative(),
    )


def find_times(system: System, phases: Floats) -> Floats:
    """Return about the time of the first impact after each of increasing phases: a candidate.

    Newton's method from the chord between the outermost two; Undecided if these have none.
    """
    eta, nu = float(system.eta), float(system.nu)
    outer = [next_impact(system, float(phase), float(HORIZON)) for phase in phases[[0, -1]]]
    if outer[0] is None or outer[1] is None:
        raise Undecided("in floating point an end of the phases sticks, or never impacts")
    start = Launch(system.side, eta, nu * np.sin(phases), nu * np.cos(phases))
    share = (phases - phases[0]) / max(float(phases[-1] - phases[0]), 1e-300)
    times = np.asarray(outer[0][0] + share * (outer[1][0] - outer[0][0]))
    for _ in range(_ATTEMPTS):
        mass, table = eta * times, times
        now = Clock(np.sin(mass), np.cos(mass), np.sin(table), np.cos(table))
        with np.errstate(all="ignore"):
            step = gap(start, now) / gap(start, now, 1)
        times = np.clip(times - np.nan_to_num(step), 0.0, float(HORIZON))
        if not np.max(np.abs(step)) > 1e-9:
            break
    return times


def find_brackets(
    launches: Launches, last: float, about: tuple[Floats, Floats], spread: Floats | float = 0.0
) -> tuple[Floats, Floats]:
    """Return brackets that seem to pass `prove_brackets`, around [about[0], about[1]].

    They are opened by `spread` and some rounding, and more where a sign is not yet proved.
    """
    low, high = about
    open_low = open_high = np.asarray(_TIGHT * high + spread)
    for _ in range(_ATTEMPTS):
        bracket = np.maximum(low - open_low, last), high + open_high
        above, below = _signs(launches, *bracket)
        if above.all() and below.all():
            break
        open_low, open_high = (
            np.where(above, open_low, 2 * open_low),
            np.where(below, open_high, 2 * open_high),
        )
    return bracket


# -- the theorem ---------------------------------------------------------------------------------


@dataclass(frozen=True)
class SlopeCover:
    """What `slope_cover` proved. All arrays have the shape (N,).

    boxes: binary64 boxes that cover `phases`, in order, neighbours touching. On each: f is the
    first-impact map, C^1; the impact time lies in `times`, f' in `slopes`, f'' in `curvatures`.
    evaluations: of the gap and gap'' over boxes x times of the grid, two a box and a time.
    """

    phases: Range
    boxes: IntervalArray
    times: IntervalArray
    slopes: IntervalArray
    curvatures: IntervalArray
    evaluations: int

    @property
    def bounds(self) -> tuple[float, float]:
        """A lower bound of min f' and an upper bound of max f' over `phases`."""
        return float(self.slopes.inf.min()), float(self.slopes.sup.max())


def slope_cover(
    system: System, phases: Range, boxes: int, grid: Sequence[float] | None = None
) -> SlopeCover:
    """Prove f C^1 on `phases` and enclose f' over each of `boxes` boxes.

    grid: times 0 < t_1 < ... < t_n before every first impact, common to all boxes. Without it a
    scalar proof finds them, where it must on several parts of `phases`; each part then has its
    share of the boxes, at least one. Raises Undecided with the first box that is not proved.
    """
    if boxes < 1 or not phases[0] < phases[1]:
        raise ValueError("at least one box, and phases low < high")
    if grid is not None:
        return _cover(system, phases, boxes, grid)
    parts = cover_by_impacts(system, phases)
    covers = [
        _cover(system, part.flight.phases, _share(part, phases, boxes), grid_of(part))
        for part in parts
    ]
    if len(covers) == 1:
        return covers[0]
    names = ("boxes", "times", "slopes", "curvatures")
    joined = (IntervalArray.concatenate([getattr(c, name) for c in covers]) for name in names)
    return SlopeCover(phases, *joined, sum(c.evaluations for c in covers))


def grid_of(impact: FirstImpact) -> list[float]:
    """Return the times before the window of a transversal first impact."""
    return [float(time) for time in impact.times[1:] if time <= impact.window[0]]


def _share(part: FirstImpact, phases: Range, boxes: int) -> int:
    low, high = part.flight.phases
    return max(1, round(boxes * (high - low) / (phases[1] - phases[0])))


def cut(phases: Range, boxes: int) -> Floats:
    """Return boxes + 1 increasing binary64 cuts, the first <= phases[0], the last >= phases[1]."""
    cuts = np.linspace(float(phases[0]), float(phases[1]), boxes + 1)
    cuts[0], cuts[-1] = float_down(phases[0]), float_up(phases[1])
    if not (np.diff(cuts) > 0.0).all():
        raise ValueError("more boxes than binary64 numbers in the phases")
    return cuts


def _cover(system: System, phases: Range, boxes: int, grid: Sequence[float]) -> SlopeCover:
    """Do `slope_cover` on one grid. The mean value theorem: f'(m) + f''(box) (box - m)."""
    cuts = cut(phases, boxes)
    launches = Launches(system, IntervalArray.from_floats(cuts[:-1], cuts[1:]))
    exclude_impacts(launches, grid)
    last = float(grid[-1])
    knots = np.sort(np.concatenate((cuts, launches.phases.mid)))
    ends, middle = np.split(find_times(system, knots).reshape(-1)[: 2 * boxes], 1)[0], None
    raise NotImplementedError


def _require(launches: Launches, holds: Mask, begin: int, reason: str) -> None:
    """Raise Undecided with the first box, counted from `begin`, on which it does not hold."""
    if holds.all():
        return
    index = begin + int(np.argmin(holds))
    box = launches.phases[index]
    raise Undecided(
        f"{reason}: box {index} of {len(launches.phases)}, "
        f"phases [{float(box.inf):.17g}, {float(box.sup):.17g}]"
    )


_STICKS = "a phase sticks, or the first time is too late for gap'' > 0"
_NOT_EXCLUDED = "an impact before the last time of the grid is not excluded"
