"""The subdivision kernel: f' and the first impact over thousands of boxes of phases, in binary64.

A phase interval is cut into N boxes, an IntervalArray. One grid of times serves all of them, on
which phase and time separate: the gap is lift A(t) + rate B(t) + D(t), so that sine and cosine
are taken of N phases and of the times alone, and the boxes x times are one `bilinear` form.

Search (`find_...`) uses floats; what it returns is then proved, or Undecided is raised.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from intervals import IntervalArray, Jet, Undecided
from intervals.bilinear import bilinear
from proofs.model.candidate import next_impact
from proofs.model.equations import Clock, Launch, clock, gap, launch, slope
from proofs.model.impact import HORIZON
from proofs.model.system import System

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]

CHUNK = 32768  # boxes x times at once: the temporaries (24 bytes each) stay in the cache
# glibc returns a freed block of this size to the system once, and from then on keeps smaller ones
# for reuse (mallopt(3), dynamic mmap threshold), so that temporaries cost no page faults.
_KEPT = 1 << 19
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

    def clock(self, times: IntervalArray | Jet) -> Clock:
        """Return the time functions."""
        return clock(self.system.eta, times)

    def heights(self, times: Floats) -> IntervalArray:
        """Enclose the gap over box i at times[..., i]: mean-value form, centre + slope x offset."""
        now = self.clock(IntervalArray.from_floats(times))
        at_centre: IntervalArray = gap(self.centre.start, now)
        along: IntervalArray = gap(self._tangent, now).derivative()
        return at_centre + along * self.offset

    def speeds(self, low: Floats, high: Floats) -> IntervalArray:
        """Enclose gap' over box i and the times from low[i] to high[i]."""
        now = self.clock(IntervalArray.from_floats(low, high))
        speed: IntervalArray = gap(self.start, now, 1)
        return speed

    def slopes(self, times: IntervalArray) -> IntervalArray:
        """Enclose f' over box i, impact times in times[i]."""
        first: IntervalArray = slope(self.start, self.clock(times))
        return first

    def curvatures(self, times: IntervalArray, slopes: IntervalArray) -> IntervalArray:
        """Enclose f'' likewise, given f': the slope formula along phi + s, t + (f' - 1) s + ..."""
        second: IntervalArray = slope(
            self._tangent, self.clock(Jet(times, slopes - 1))
        ).derivative()
        return second


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
    pieces = grid.size - 1
    by_lift, by_rate, rest = _forms(launches.system, grid)
    lift, rate = launches.start.lift, launches.start.rate
    size = max(1, CHUNK // (2 * pieces))
    np.empty(_KEPT)
    for begin in range(0, len(launches.phases), size):
        part = slice(begin, begin + size)
        values = bilinear((by_lift, by_rate), (lift[part], rate[part]), rest)
        low, bend = values[:pieces].inf, values[pieces:]
        _require(launches, bend[:1].certainly_positive(), begin, _STICKS)
        _require(launches, low > 0.0, begin, _NOT_EXCLUDED)
        _require(launches, np.minimum(low[:-1], low[1:]) > bend.sup[1:], begin, _NOT_EXCLUDED)


_Form = tuple[IntervalArray, IntervalArray, IntervalArray]


def _forms(system: System, grid: Floats) -> _Form:
    """Return the gap at the n times t_1, ..., then w^2/8 gap'' on the n pieces between, as forms.

    A form is A, B, D, shape (2 n,) each, that stand for lift A + rate B + D.
    """
    n, points = grid.size - 1, IntervalArray.from_floats(grid)
    ends_and_pieces = IntervalArray.from_floats(
        np.concatenate((grid[1:], grid[:-1])), np.concatenate((grid[1:], grid[1:]))
    )
    now = clock(system.eta, ends_and_pieces)
    weights = (points[1:] - points[:-1]) ** 2 / 8
    at_ends = _form(system, Clock(*(x[:n] for x in now)), 0)
    bends = _form(system, Clock(*(x[n:] for x in now)), 2)
    a, b, d = (
        IntervalArray.concatenate([end, bend * weights])
        for end, bend in zip(at_ends, bends, strict=True)
    )
    return a, b, d


def _form(system: System, now: Clock, order: int) -> _Form:
    """Return A, B, D such that the gap's derivative of this order is lift A + rate B + D."""
    lift, rate = _Affine((1, None, None)), _Affine((None, 1, None))
    form: _Affine = gap(Launch(system.side, system.eta, lift, rate), now, order)
    by_lift, by_rate, rest = form.terms
    return by_lift, by_rate, rest


@dataclass(frozen=True)
class _Affine:
    """a lift + b rate + d with terms (a, b, d), None for 0: the gap is of this kind."""

    terms: tuple[Any, Any, Any]

    def __mul__(self, factor: IntervalArray) -> _Affine:
        a, b, d = (x if x is None else x * factor for x in self.terms)
        return _Affine((a, b, d))

    def __add__(self, other: Any) -> _Affine:
        added = other.terms if isinstance(other, _Affine) else (None, None, other)
        a, b, d = (
            y if x is None else x if y is None else x + y
            for x, y in zip(self.terms, added, strict=True)
        )
        return _Affine((a, b, d))

    def __sub__(self, other: Any) -> _Affine:
        return self.__add__(-other)

    def __neg__(self) -> _Affine:
        a, b, d = (x if x is None else -x for x in self.terms)
        return _Affine((a, b, d))


# -- the brackets: an impact here ----------------------------------------------------------------


def prove_brackets(launches: Launches, last: Floats, low: Floats, high: Floats) -> None:
    """Prove that after box i the gap has one zero in [last_i, high_i]; it is > low_i.

    By gap(low) > 0 > gap(high) and gap' < 0 on [last, high], where last <= low < high, all of
    shape (n,). Raises Undecided with the first box on which this fails.
    """
    ordered = np.asarray((last <= low) & (low < high) & (high < np.inf))
    _require(launches, ordered, 0, "the time bracket is not one")
    speeds = launches.speeds(last, high)
    _require(launches, speeds.certainly_negative(), 0, "gap' < 0 is not proved up to the impact")
    signs = _signs(launches, low, high)
    _require(launches, signs, 0, "the gap's signs at the ends of its time bracket are not proved")


def _signs(launches: Launches, low: Floats, high: Floats) -> Mask:
    """Return masks, shape (2, n): on which boxes gap(low) > 0, and on which gap(high) < 0."""
    heights = launches.heights(np.stack((low, high)))
    return np.stack((heights[0].certainly_positive(), heights[1].certainly_negative()))


def float_launch(system: System, phases: Floats) -> Launch:
    """Return launches in floating point: for candidates, never evidence."""
    nu = float(system.nu)
    return Launch(system.side, float(system.eta), nu * np.sin(phases), nu * np.cos(phases))


def float_clock(system: System, times: Floats) -> Clock:
    """Return the functions of time in floating point, likewise."""
    mass = float(system.eta) * times
    return Clock(np.sin(mass), np.cos(mass), np.sin(times), np.cos(times))


def find_times(system: System, phases: Floats) -> Floats:
    """Return about the time of the first impact after each of increasing phases: a candidate.

    Newton's method from the chord between the outermost two; Undecided if these have none.
    """
    outer = [next_impact(system, float(phase), float(HORIZON)) for phase in phases[[0, -1]]]
    if outer[0] is None or outer[1] is None:
        raise Undecided("in floating point an end of the phases sticks, or never impacts")
    start = float_launch(system, phases)
    share = (phases - phases[0]) / max(float(phases[-1] - phases[0]), 1e-300)
    times = np.asarray(outer[0][0] + share * (outer[1][0] - outer[0][0]))
    for _ in range(_ATTEMPTS):
        now = float_clock(system, times)
        with np.errstate(all="ignore"):
            step = gap(start, now) / gap(start, now, 1)
        times = np.clip(times - np.nan_to_num(step), 0.0, float(HORIZON))
        if not np.max(np.abs(step)) > 1e-9:
            break
    return times


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
        f"phases [{float(box.inf):.17g}, {float(box.sup):.17g}]"
    )


_STICKS = "a phase sticks, or the first time is too late for gap'' > 0"
_NOT_EXCLUDED = "an impact before the last time of the grid is not excluded"
