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
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from intervals import IntervalArray, Jet, Undecided
from intervals.bilinear import bilinear
from intervals.rounding import outward, outward_sum
from proofs.motion.candidate import next_impact
from proofs.motion.many import float_clock, float_launch
from proofs.motion.system import System
from proofs.motion.witness import HORIZON
from proofs.trusted.equations import Clock, Launch, clock, gap, launch, slope

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]

CHUNK = 1 << 19  # forms x boxes at once, a byte each: longer rows cost less
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

    def speeds(self, times: IntervalArray, now: Clock | None = None) -> IntervalArray:
        """Enclose gap' over box i and the times in times[i], as `Flight.fall` does.

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

    def slopes_and_curvatures(self, times: IntervalArray) -> tuple[IntervalArray, IntervalArray]:
        """Enclose f' and f'' likewise, as `Flight.slope_and_curvature` does."""
        now = self.clock(times)
        fall = self.speeds(times, now)
        first: IntervalArray = slope(self.start, now, fall)
        faster = first - 1
        change = gap(self._tangent, now, 1).derivative() + gap(self.start, now, 2) * faster
        along = self.clock(Jet(times, faster))
        return first, slope(self._tangent, along, Jet(fall, change)).derivative()


# -- the grid: no impact before ------------------------------------------------------------------


def exclude_impacts(launches: Launches, times: Sequence[float]) -> None:
    """Prove that gap > 0 on (0, t_n] after every launch, where 0 < t_1 < ... < t_n are `times`.

    On [0, t_1] by the double zero: gap(0) = gap'(0) = 0, so gap'' > 0 there gives gap > 0. On
    [t_j, t_{j+1}] by the chord: gap >= min(gap(t_j), gap(t_{j+1})) - w^2/8 max(0, gap''), so that
    all is proved if both gaps, and both less v gap'' for some v >= w^2/8, are > 0.
    Raises Undecided with the first box on which one of these fails.
    """
    grid = np.array([0.0, *times])
    if not (grid.size > 1 and np.isfinite(grid).all() and (np.diff(grid) > 0.0).all()):
        raise ValueError("the times must be finite, positive and increasing, and at least one")
    by_lift, by_rate, rest = _forms(launches.system, grid)
    start = launches.start
    size = max(1, CHUNK // len(rest))
    for begin in range(0, len(launches.phases), size):
        part = slice(begin, begin + size)
        positive = bilinear((by_lift, by_rate), (start.lift[part], start.rate[part]), rest)
        _require(launches, positive[:1], begin, _STICKS)
        _require(launches, positive, begin, _NOT_EXCLUDED)


def _forms(system: System, grid: Floats) -> IntervalArray:
    """Return what must be > 0: forms (A, B, D), shape (3, 3 n - 1), each for lift A + rate B + D.

    With h_j = gap(t_j), and b_j = v gap'' on piece j, from t_{j-1} to t_j, where v >= w^2/8, they
    are b_1, then h_1, ..., h_n, then h_j - b_j for j = 2, ..., n, then h_{j-1} - b_j for these.
    """
    n = grid.size - 1
    times = IntervalArray.from_floats(  # the ends of the pieces, then the pieces
        np.concatenate((grid[1:], grid[:-1])), np.concatenate((grid[1:], grid[1:]))
    )
    # both frequencies at once: sines and cosines of so few numbers cost as much as of twice as many
    waves = IntervalArray.concatenate([system.eta * times, times]).sincos()
    one = IntervalArray.from_floats(np.ones(2 * n))
    functions = IntervalArray.concatenate([*waves, one]).reshape(5, 2, n)
    forms = (_coefficients(system) * functions).sum(axis=1)
    widths = outward_sum(np.diff(grid))
    bends = forms[:, 1] * IntervalArray.from_floats(outward(0.125 * widths * widths))
    heights, later = forms[:, 0], bends[:, 1:]
    return IntervalArray.concatenate(
        [bends[:, :1], heights, heights[:, 1:] - later, heights[:, :-1] - later], axis=1
    )


_LAUNCH = ("lift",), ("rate",), ()
_FUNCTIONS = ("mass_sin",), ("table_sin",), ("mass_cos",), ("table_cos",), ()


@lru_cache(maxsize=64)
def _coefficients(system: System) -> IntervalArray:
    """Return c, shape (3, 5, 2, 1), of gap and gap'', the sums over i, k of c_ik x_i f_k.

    x is lift, rate, 1, and f is sin(eta t), sin(t), cos(eta t), cos(t), 1.
    """
    names = "lift", "rate", *Clock._fields
    lift, rate, *functions = (_Polynomial({(name,): Fraction(1)}) for name in names)
    start, now = Launch(system.side, system.eta, lift, rate), Clock(*functions)
    found = [gap(start, now, order).terms for order in (0, 2)]
    table = [[tuple(sorted((*x, *f))) for f in _FUNCTIONS] for x in _LAUNCH]
    if not set().union(*found) <= set().union(*table):
        raise ValueError("the gap is not a form in the launch and the functions of time")
    return IntervalArray([[[[terms.get(x, 0)] for terms in found] for x in row] for row in table])


@dataclass(frozen=True)
class _Polynomial:
    """The sum of coefficients times monomials, by the sorted names of a monomial's variables."""

    terms: dict[tuple[str, ...], Fraction]

    def __mul__(self, factor: _Polynomial | Fraction | int) -> _Polynomial:
        product: dict[tuple[str, ...], Fraction] = {}
        for x, a in self.terms.items():
            for y, b in _polynomial(factor).terms.items():
                name = tuple(sorted((*x, *y)))
                product[name] = product.get(name, Fraction(0)) + a * b
        return _Polynomial(product)

    __rmul__ = __mul__

    def __truediv__(self, divisor: Fraction) -> _Polynomial:
        return self * (1 / divisor)

    def __add__(self, other: _Polynomial | int) -> _Polynomial:
        added = _polynomial(other).terms
        known = {**self.terms, **added}
        return _Polynomial({x: self.terms.get(x, Fraction(0)) + added.get(x, 0) for x in known})

    def __sub__(self, other: _Polynomial | int) -> _Polynomial:
        return self + -other

    def __neg__(self) -> _Polynomial:
        return self * -1


def _polynomial(value: _Polynomial | Fraction | int) -> _Polynomial:
    return value if isinstance(value, _Polynomial) else _Polynomial({(): Fraction(value)})


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
        f"phases [{float(box.inf):.12g}, {float(box.sup):.12g}]"
    )


_STICKS = "a phase sticks, or the first time is too late for gap'' > 0"
_NOT_EXCLUDED = "an impact before the last time of the grid is not excluded"
