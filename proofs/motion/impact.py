"""Rigorous enclosures of the plastic impact map: the first impact after every launch in a set."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING, Any

from intervals.errors import Undecided
from proofs.motion.digits import around
from proofs.motion.flight import Flight, Numbers, fixed, interval, sketch
from proofs.motion.system import System
from proofs.trusted.equations import launch_acceleration
from proofs.trusted.numbers import Range

if TYPE_CHECKING:
    from intervals import Interval

HORIZON = Fraction(1000)
_NOW = Fraction(0)
_TINIEST = Fraction(1, 2**200)
LEAST = 64  # bits: multiprecision costs no more than at fewer
_ATTEMPTS = 8
_STEPS, _FLOAT_BITS = 30, 40  # of Newton's method in floats, and what it is good for
MOST = _ATTEMPTS * LEAST  # bits that a launch is given until it counts as grazing or sticking
_LIKELY = Fraction(3, 8)  # of bend w^2: up to 1/2 a step of 2 w may not be closed; few of them are
_PATIENCE = 4  # steps after one that was too long, until a longer one is tried whatever the bend
_CLOSE = Fraction(1, 1000)  # of times to that of a touch
_TOUCHES = 64  # where mass and table touch more often, finer steps will show no more


def up_to(last: Fraction, times: Sequence[Fraction]) -> list[Fraction]:
    """Return the times that are not after the last."""
    return [time for time in times if time <= last]


class NoImpact(Undecided):
    """No impact was found up to the horizon (or the mass never separates from the table)."""


class Unsettled(Undecided):
    """In some windows of time impacts are possible, and none is certain up to where one looked.

    known: times up to the first window, gap > 0 between them. hopeless: there are so many windows
    that mass and table seem to touch, as at resonance.
    """

    def __init__(self, windows: list[Range], times: list[Fraction], flight: Flight) -> None:
        begin, reason = windows[0][0], touch_near(flight, windows[0])
        near = f"an impact near time {float(begin):.9g} is neither proved nor excluded"
        super().__init__(f"{near}{reason and f': {reason}'}")
        self.known = up_to(begin, times)
        self.hopeless = len(windows) > _TOUCHES


def touch_near(flight: Flight, times: Range) -> str:
    """Say that a plastic flight without an earlier impact touches the table here; "" elsewhere.

    eta = p/q: after q turns of the table mass and table are where they were, with their velocities.
    """
    turns = flight.system.eta.denominator
    time = math.tau * turns
    if flight.start.kick is not None or not times[0] - _CLOSE <= time <= times[1] + _CLOSE:
        return ""
    return (
        f"at time 2 pi {turns} = {time:.9g} mass and table are where they were at the launch, and "
        "touch without relative velocity if there was no impact before"
    )


class Sticks(Undecided):
    """All phases of a set stick to the table first: their flights start elsewhere."""


@dataclass(frozen=True)
class FirstImpact:
    """What `first_impact` proved for all launches of one flight.

    times: 0 = t_0 < ... < t_n with gap < 0 at t_n; windows: the runs of pieces on which a zero
    of the gap was not excluded, so every first impact lies in one of them, the last ends at t_n.
    transversal: there is one window, and gap' < 0 on it. Then the impact is unique there, is
    the first one, and depends smoothly on the phase.
    """

    flight: Flight
    times: tuple[Fraction, ...]
    windows: tuple[Range, ...]
    transversal: bool

    @property
    def known(self) -> list[Fraction]:
        """The times up to the first window: gap > 0 between them."""
        return up_to(self.windows[0][0], self.times)

    @property
    def window(self) -> Range:
        """The last window, the only one if `transversal`."""
        return self.windows[-1]

    @cached_property
    def loss(self) -> int:
        """Bits that a slow impact costs: time is known to rounding / |gap'|."""
        slowest = self.flight.velocity(*self.window).mig
        return 0 if slowest == 0 else (1 / slowest).__ceil__().bit_length()

    def thin(self, phases: Range, bits: int) -> Flight:
        """Return (nearly) one of the launches, at the precision that times to 2^-bits need."""
        precision = max(self.flight.precision, bits + 30 + self.loss)
        return replace(self.flight, phases=phases, precision=precision)

    @cached_property
    def places(self) -> int:
        """Binary places before the first digit of a short flight's time, 0 if that is 1 or more."""
        return (1 / self.windows[0][0]).__ceil__().bit_length() - 1

    def part(self, phases: Range) -> Flight:
        """Return some of the launches, at a precision that leaves times 18 bits and gap' 48."""
        return self.thin(phases, self.places + 18)


def first_impact(
    flight: Flight, horizon: Fraction = HORIZON, finest: Fraction = Fraction(1, 8)
) -> FirstImpact:
    """Exclude impacts from time zero on until one is certain, for all launches at once.

    On [0, t_1] by `Flight.rises`. On [t_j, t_{j+1}] by the chord: gap >= min(gap(t_j),
    gap(t_{j+1})) - w^2/8 max(0, gap'') (interpolation error). Steps are doubled (for a while after
    one that was too long only where the bend at all times may allow it), and halved down to
    `finest`, or to an eighth of the time passed if that is less; what is then not excluded opens a
    window, in which they grow again, to 16 times that or an eighth of the window.

    Raises NoImpact or Unsettled at the horizon (Unsettled also after too many windows), Sticks
    where all phases do, Undecided where the launch itself is not decided.
    """
    _require_leaving(flight)
    return march(flight, [_NOW, first_step(flight)], horizon, finest)


def _require_leaving(flight: Flight) -> None:
    """Raise Sticks where all launches stick, Undecided where it is not shown that none does."""
    if flight.leaves:
        return
    if flight.start.kick is None and launch_acceleration(flight.start).certainly_negative():
        raise Sticks(f"{name_of(flight.phases)} sticks to the table after the impact")
    raise Undecided("a phase of the interval sticks, or it is not decided whether it does")


def march(
    flight: Flight,
    known: Sequence[Fraction],
    horizon: Fraction,
    finest: Fraction,
    *,
    single: bool = False,
) -> FirstImpact:
    """Exclude impacts as `first_impact` does, after the last of the known times.

    known: 0 = t_0 < t_1 < ..., gap > 0 from time 0 to the last. single: a window that is left
    behind raises Unsettled; nothing that comes after could make the impact transversal.
    """
    times = list(known)
    windows: list[Range] = []
    value = flight.gap(times[-1])
    step, allowed = times[-1] - times[-2], min(finest, times[-1] / 8)
    patience, certain = 0, False
    while not certain:
        now = times[-1]
        least = min(finest, now / 8)
        if len(windows) > (0 if now >= horizon else 4 * _TOUCHES):
            raise Unsettled(windows, times, flight)
        if now >= horizon:
            raise NoImpact(f"there is no impact up to time {float(horizon):g} (the horizon)")
        ahead = now + step
        next_value = flight.gap(ahead)
        if positive_between(flight, now, value, ahead, next_value):
            if single and windows:
                raise Unsettled(windows, times, flight)
            hopeless = patience > 0 and next_value.inf <= flight.bend.sup * (_LIKELY * step**2)
            step, allowed, patience = (step if hopeless else 2 * step), least, patience - 1
        elif step > allowed:
            step, patience = max(step / 2, allowed), _PATIENCE
            continue
        else:
            certain = next_value.certainly_negative()
            if windows and windows[-1][1] == now:
                begin, _ = windows.pop()
                times.pop()
            else:
                begin = now
            windows.append((begin, ahead))
            step = allowed = min(2 * allowed, max(16 * least, (ahead - begin) / 8))
        times.append(ahead)
        value = next_value
    transversal = len(windows) == 1 and flight.velocity(*windows[0]).certainly_negative()
    return FirstImpact(flight, tuple(times), tuple(windows), transversal)


def first_step(flight: Flight) -> Fraction:
    """Return a time up to which the gap is proved to open."""
    step = Fraction(1)
    while step > _TINIEST:
        if flight.rises(step):
            return step
        step /= 2
    raise Undecided("the launch acceleration is too close to 0 at this precision")


def positive_between(
    flight: Flight, low: Fraction, at_low: Interval, high: Fraction, at_high: Interval
) -> bool:
    """Whether gap > 0 between two times, by its values there and the greatest gap''."""
    if not (at_low.certainly_positive() and at_high.certainly_positive()):
        return False
    least, square = min(at_low.inf, at_high.inf), (high - low) ** 2 / 8
    return least > flight.bend.sup * square or least > flight.gap(low, high, order=2).sup * square


def locate(
    system: System,
    phases: Range,
    *,
    horizon: Fraction = HORIZON,
    separating: bool = False,
    numbers: Numbers = interval,
) -> FirstImpact:
    """Return the transversal first impact of (nearly) one launch, at the least precision it needs.

    Close to grazing or to the onset of sticking steps and rounding must be finer: what is
    excluded stays so, and the first window that is left open is looked at again. After eight
    attempts Undecided says that the launch is too close to one.
    """
    known: list[Fraction] = []
    for attempt in range(_ATTEMPTS):
        flight = Flight(system, phases, LEAST * (attempt + 1), separating, numbers)
        try:
            if not known:
                _require_leaving(flight)
                known = [_NOW, first_step(flight)]
            finest = Fraction(1, 2 ** (3 + 10 * attempt))
            found = march(flight, known, horizon, finest, single=True)
        except (NoImpact, Sticks):
            raise
        except Unsettled as failure:
            known = failure.known
            continue
        except Undecided:
            continue
        if found.transversal:
            return found
        known = found.known
    seen = touch_near(flight, (known[-1], known[-1])) if known else ""
    name = f"phase {float(phases[0]):.12g}"
    raise Undecided(
        f"{name}: {seen}"
        if seen
        else f"{name} grazes, or starts to stick, to within what was tried"
    )


def name_of(phases: Range) -> str:
    """Write a set of phases."""
    low, high = (f"{float(x):.9g}" for x in phases)
    return f"phase {low}" if low == high else f"every phase in [{low}, {high}]"


def time_range(impact: FirstImpact, phases: Range) -> Range:
    """Enclose the impact times of all launches in `phases`, a part of a transversal impact's."""
    low, high = impact.window
    # until what may still be gained is small beside the width of the phases
    steps = ((high - low) / (phases[1] - phases[0])).__ceil__().bit_length() + 5
    return narrowed(impact.part(phases), impact.window, steps)


def narrowed(flight: Flight, window: Range, steps: int) -> Range:
    """Narrow the window of a transversal impact of all flights, to multiples of 2^-steps of it.

    The gap decreases through its one zero there: where it is > 0 for all flights no zero lies
    before, where it is < 0 none lies after.
    """
    (low, high), count = window, 2**steps
    unit = (high - low) / count
    first = last_positive(lambda k: float(flight.gap(low + k * unit).inf), count)
    last = last_positive(lambda k: float(-flight.gap(high - k * unit).sup), count)
    return low + first * unit, high - last * unit


def last_positive(function: Callable[[int], float], most: int) -> int:
    """Return the last whole number below `most` at which a decreasing function is > 0; else 0.

    By the regula falsi, the value at an end that stays being halved (Illinois).
    """
    left, right = 0, most
    above, below, moved = function(left), function(right), 0
    while right - left > 1 and above > 0:
        share = above / (above - below) if below < 0 else 0.5
        k = min(max(left + round((right - left) * Fraction(share)), left + 1), right - 1)
        value = function(k)
        if value > 0:
            left, above, below = k, value, below / (1 + (moved > 0))
        else:
            right, below, above = k, value, above / (1 + (moved < 0))
        moved = 1 if value > 0 else -1
    return left


def impact_time(impact: FirstImpact, phases: Range, bits: int) -> Range:
    """Enclose the impact time of (nearly) one launch in an interval of width 2^(1 - bits).

    `phases` is a point or much narrower than 2^-bits. The ends are multiples of 2^-bits with
    gap > 0 at the lower and gap < 0 at the upper one for all its launches, found by interval
    Newton in the window of a transversal impact.
    """
    flight = impact.thin(phases, bits)
    if flight.numbers is sketch:
        return _within(around(_seen_time(flight, impact.window, bits), bits), impact.window)
    from intervals.newton import Roots, newton  # with mpmath

    window = flight.number(*impact.window)
    result = newton(
        lambda t: flight.gap(t.inf, t.sup), lambda t: flight.velocity(t.inf, t.sup), window
    )
    if result.outcome is not Roots.UNIQUE or result.box is None:
        raise Undecided(f"the impact time is not isolated: {result.reason}")
    low, high = _within(around(result.box.mid, bits), impact.window)
    if not (flight.gap(low).certainly_positive() and flight.gap(high).certainly_negative()):
        raise Undecided("the gap's sign is lost to rounding next to the impact")
    return low, high


def _within(bracket: Range, window: Range) -> Range:
    return max(bracket[0], window[0]), min(bracket[1], window[1])


def _seen_time(flight: Flight, window: Range, bits: int) -> Fraction:
    """Return about when one launch has its impact, to 2^-bits: a candidate.

    By Newton's method, in floats first, then in the checker's integers.
    """
    low, high = window
    time = (low + high) / 2
    for _ in range(_STEPS):
        step = flight.gap(time).mid / flight.gap(time, order=1).mid
        time = min(max(time - Fraction(step), low), high)
        if abs(step) < 2.0**-_FLOAT_BITS:
            break
    exact: Any = replace(flight, numbers=fixed)
    places, good = 2 ** (bits + 8), _FLOAT_BITS
    while good < bits + 8:
        height, speed = (sum(exact.gap(time, order=order).range) for order in (0, 1))
        time = Fraction(round((time - height / speed) * places), places)
        good = 2 * good - 8
    return time
