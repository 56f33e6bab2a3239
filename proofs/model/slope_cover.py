"""f' over thousands of boxes of phases, and its extremes, in binary64: theorems of the kernel."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from intervals import IntervalArray
from intervals.rounding import float_down, float_up
from proofs.facts import Range
from proofs.model.impact import FirstImpact, cover_by_impacts
from proofs.model.kernel import Floats, Launches, enclose_times, exclude_impacts, find_times
from proofs.model.system import System


@dataclass(frozen=True)
class SlopeCover:
    """What `slope_cover` proved. All arrays have the shape (N,).

    boxes: binary64 boxes that cover `phases`, in order, neighbours touching. On each: f is the
    first-impact map, C^1; the impact time lies in `times`, after `last`, the last time of its
    grid, up to which gap > 0; f' lies in `slopes`, f'' in `curvatures`.
    evaluations: of the gap and gap'' over boxes x times of the grid, two a box and a time.
    """

    phases: Range
    boxes: IntervalArray
    times: IntervalArray
    slopes: IntervalArray
    curvatures: IntervalArray
    last: Floats
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
    return SlopeCover(
        phases,
        IntervalArray.concatenate([one.boxes for one in covers]),
        IntervalArray.concatenate([one.times for one in covers]),
        IntervalArray.concatenate([one.slopes for one in covers]),
        IntervalArray.concatenate([one.curvatures for one in covers]),
        np.concatenate([one.last for one in covers]),
        sum(one.evaluations for one in covers),
    )


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
    last = np.full(boxes, float(grid[-1]))
    knots = np.empty(2 * boxes + 1)
    knots[::2], knots[1::2] = cuts, launches.phases.mid
    about = find_times(system, knots)
    before, middle, after = about[:-1:2], about[1::2], about[2::2]
    around = np.minimum(before, after), np.maximum(before, after)
    bow = 2.0 * np.abs(middle - 0.5 * (before + after))
    times = enclose_times(launches, last, around, bow)
    at_centre = launches.centre.slopes(enclose_times(launches.centre, last, (middle, middle)))
    slopes = launches.slopes(times)
    curvatures = launches.curvatures(times, slopes)
    narrower = slopes.intersection(at_centre + curvatures * launches.offset)
    if narrower is None:
        raise ArithmeticError("two enclosures of the same slopes are disjoint")
    slopes = narrower
    evaluations = 2 * boxes * len(grid)
    return SlopeCover(phases, launches.phases, times, slopes, curvatures, last, evaluations)


@dataclass(frozen=True)
class SlopeExtremes:
    """Bounds (lower, upper) on the minimum and on the maximum of f', and the cover behind them."""

    minimum: tuple[float, float]
    maximum: tuple[float, float]
    cover: SlopeCover


def slope_extremes(system: System, phases: Range, boxes: int = 8) -> SlopeExtremes:
    """Enclose the extremes of f' over `phases` in binary64, by monotonicity where f'' has a sign.

    On a box with f'' > 0 or f'' < 0, f' lies between its values at the two cuts; on others in
    the cover's enclosure. The values at cuts, of thin phases and tight times, are attained. So
    where f'' has one sign on all boxes, nothing is lost but the rounding of two evaluations.
    """
    cover = slope_cover(system, phases, boxes)
    lower = cover.boxes.inf
    ends = IntervalArray([phases[0], phases[1]])
    cuts = IntervalArray.from_floats(
        np.concatenate((ends.inf[:1], lower[1:], ends.inf[1:])),
        np.concatenate((ends.sup[:1], lower[1:], ends.sup[1:])),
    )
    thin, last = Launches(system, cuts), np.append(cover.last, cover.last[-1])
    about = find_times(system, cuts.mid)
    at_cuts = thin.slopes(enclose_times(thin, last, (about, about)))
    one_sign = cover.curvatures.certainly_positive() | cover.curvatures.certainly_negative()
    others = cover.slopes[~one_sign]
    low, high = at_cuts.inf, at_cuts.sup
    return SlopeExtremes(
        (float(np.concatenate((low, others.inf)).min()), float(high.min())),
        (float(low.max()), float(np.concatenate((high, others.sup)).max())),
        cover,
    )
