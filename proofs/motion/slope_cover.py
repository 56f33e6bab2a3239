"""f' over thousands of boxes of phases, each box at the precision it needs.

Binary64 decides what it can, many boxes at once; the others are asked alone, in multiprecision.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from intervals import IntervalArray, Undecided
from intervals.cover import cover
from intervals.rounding import float_down, float_up
from proofs.motion.branch import Branch
from proofs.motion.covering import cover_by
from proofs.motion.kernel import Floats, Launches, enclose_times, exclude_impacts, find_times
from proofs.motion.system import System
from proofs.motion.witness import FlightBox, Seen
from proofs.trusted.flights import COVER_BITS
from proofs.trusted.numbers import Range, hull

BINARY64 = 53
_POINT = 80  # bits of the impact time of a single launch
_Answer = TypeVar("_Answer")


@dataclass(frozen=True)
class SlopeCover:
    """What `slope_cover` proved. All arrays have the shape (N,).

    boxes: binary64 boxes that cover the phases, in order; neighbours touch, or overlap by a
    rounding where two scalar proofs meet. On each: f is the first-impact map, C^1; the impact time
    lies in `times`, after `last`, up to which gap > 0; f' lies in `slopes`, f'' in `curvatures`.
    bits: the precision it took, 53 for binary64.
    """

    boxes: IntervalArray
    times: IntervalArray
    slopes: IntervalArray
    curvatures: IntervalArray
    last: Floats
    bits: NDArray[np.int_]

    @property
    def bounds(self) -> tuple[float, float]:
        """A lower bound of min f' and an upper bound of max f'."""
        return float(self.slopes.inf.min()), float(self.slopes.sup.max())


def slope_cover(
    system: System, phases: Range, boxes: int, grid: Sequence[float] | None = None
) -> SlopeCover:
    """Prove f C^1 on `phases` and enclose f' over each of `boxes` boxes.

    grid: times 0 < t_1 < ... < t_n before every first impact, common to all boxes, for a proof in
    binary64 alone. Without it a scalar proof finds them, where it must on several parts of
    `phases`; each part then has its share of the boxes, at least one, and boxes that binary64
    does not decide are asked alone. Raises Undecided with the first box that is not proved.
    """
    if boxes < 1 or not phases[0] < phases[1]:
        raise ValueError("at least one box, and phases low < high")
    if grid is not None:
        return _in_binary64(system, grid, cut(phases, boxes))
    return _joined(
        [
            _retried(system, part, cut(part.flights.phases, _share(part, phases, boxes)))
            for part in _impacts(system, phases)
        ]
    )


def _joined(covers: Sequence[SlopeCover]) -> SlopeCover:
    """Put covers next to each other."""
    if len(covers) == 1:
        return covers[0]
    return SlopeCover(
        IntervalArray.concatenate([one.boxes for one in covers]),
        IntervalArray.concatenate([one.times for one in covers]),
        IntervalArray.concatenate([one.slopes for one in covers]),
        IntervalArray.concatenate([one.curvatures for one in covers]),
        np.concatenate([one.last for one in covers]),
        np.concatenate([one.bits for one in covers]),
    )


def _retried(system: System, part: Seen, cuts: Floats) -> SlopeCover:
    """Enclose f' over the boxes between the cuts, all in one part, each as it needs."""
    grid, boxes = grid_of(part), cuts.size - 1

    def together(low: int, high: int) -> SlopeCover:
        return _in_binary64(system, grid, cuts[low : high + 1])

    def alone(k: int) -> SlopeCover:
        return _alone(system, cuts[k], cuts[k + 1])

    if part.bits > COVER_BITS:
        return _joined([alone(k) for k in range(boxes)])
    return _joined(_by_halves(boxes, together, alone))


def _by_halves(
    count: int, together: Callable[[int, int], _Answer], alone: Callable[[int], _Answer]
) -> list[_Answer]:
    """Ask for 0, ..., count - 1 together, for both halves where that fails, at last for one alone.

    Failing is to be Undecided, or to leave the range of binary64.
    """

    def decide(run: tuple[int, int]) -> _Answer | None:
        low, high = run
        try:
            return together(low, high)
        except (Undecided, OverflowError):
            return alone(low) if high == low + 1 else None

    def halves(run: tuple[int, int]) -> tuple[tuple[int, int], tuple[int, int]]:
        low, high = run
        middle = (low + high) // 2
        return (low, middle), (middle, high)

    return [answer for _, answer in cover([(0, count)], decide, halves, limit=2 * count)]


def _alone(system: System, low: float, high: float) -> SlopeCover:
    """Ask for the launches from low to high, one phase or more, in multiprecision."""
    parts = _impacts(system, (Fraction(low), Fraction(high)))
    found = []
    for part in parts:
        of = part.flights.phases
        places = (1 / part.windows[0][0]).__ceil__().bit_length() - 1
        branch = Branch([("", part.proved())], _POINT + places)
        found.append((branch.flight(*of)[1], branch.slope(*of), branch.curvature(*of)))
    times, slopes, curvatures = (IntervalArray([hull(x)]) for x in zip(*found, strict=True))
    last = float_down(min(part.windows[0][0] for part in parts))
    needed = max(COVER_BITS, *(part.bits for part in parts))
    boxes = IntervalArray.from_floats([low], [high])
    return SlopeCover(boxes, times, slopes, curvatures, np.array([last]), np.array([needed]))


def grid_of(impact: Seen) -> list[float]:
    """Return the times before the window of a transversal first impact."""
    return [float(time) for time in impact.excluded]


def _impacts(system: System, phases: Range) -> list[Seen]:
    """Return the transversal first impacts of phases, in parts."""
    flights = FlightBox.plastic(system.place, phases)
    return cover_by(flights, floats=False)


def _share(part: Seen, phases: Range, boxes: int) -> int:
    low, high = part.flights.phases
    return max(1, round(boxes * (high - low) / (phases[1] - phases[0])))


def cut(phases: Range, boxes: int) -> Floats:
    """Return boxes + 1 increasing binary64 cuts, the first <= phases[0], the last >= phases[1]."""
    cuts = np.linspace(float(phases[0]), float(phases[1]), boxes + 1)
    cuts[0], cuts[-1] = float_down(phases[0]), float_up(phases[1])
    if not (np.diff(cuts) > 0.0).all():
        raise ValueError("more boxes than binary64 numbers in the phases")
    return cuts


def _in_binary64(system: System, grid: Sequence[float], cuts: Floats) -> SlopeCover:
    """Do `slope_cover` on one grid. The mean value theorem: f'(m) + f''(box) (box - m)."""
    boxes = cuts.size - 1
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
    slopes, curvatures = launches.slopes_and_curvatures(times)
    narrower = slopes.intersection(at_centre + curvatures * launches.offset)
    if narrower is None:
        raise ArithmeticError("two enclosures of the same slopes are disjoint")
    bits = np.full(boxes, BINARY64)
    return SlopeCover(launches.phases, times, narrower, curvatures, last, bits)
