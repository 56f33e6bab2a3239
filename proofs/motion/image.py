"""The image of a phase, or of an interval of phases, under the plastic impact map."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from fractions import Fraction

from intervals import DomainError, Interval, Undecided
from intervals.newton import Roots, newton
from proofs.methods.extremes import extremes
from proofs.motion.branch import Branch
from proofs.motion.covering import cover_by_impacts, halves, precision_for, steps_for
from proofs.motion.digits import bits_for, to_digits
from proofs.motion.flight import Flight
from proofs.motion.impact import (
    HORIZON,
    LEAST,
    MOST,
    FirstImpact,
    NoImpact,
    Unsettled,
    first_impact,
    impact_time,
    locate,
)
from proofs.motion.phase import on_circle, phase_after
from proofs.motion.system import System
from proofs.trusted.equations import launch_acceleration
from proofs.trusted.numbers import Range, hull

_NOT_CUT = (
    "the interval seems to contain a grazing phase, or to reach too near to where sticking begins"
)
_PIECES = 32  # twelve digits take a dozen, but next to the onset of sticking any number
_COARSE = Fraction(1, 2**12)  # the finest time step where only a set of images is wanted


@dataclass(frozen=True)
class Image:
    """The next impact of all given phases: bounds on its time of flight, its phase, f'.

    If `sticking`, all of them stick first: they dwell on the table until the separation phase,
    the flight starts there, and f is constant. Phases are mod 2 pi, the lower end in [0, 2 pi).
    """

    flight: Range
    phase: Range
    slope: Range
    sticking: bool
    dwell: Range | None = None


@dataclass(frozen=True)
class PossibleImages:
    """Where f is not continuous on the interval: every image is in one of these pairs."""

    images: tuple[tuple[Range, Range], ...]
    reason: str


def separation_phase(system: System, precision: int) -> Range:
    """Enclose the phase phi_s at which a sticking mass leaves, in [0, 2 pi).

    It is the zero of the launch acceleration at which that increases: the sine is the paper's
    eta^2 / (nu (1 - eta^2)), the cosine has the sign of 1 - eta^2. Raises NoImpact if the mass
    never leaves, Undecided too close to the parameters where that begins.
    """
    sine = system.separation_sine
    if system.sticking_arc == "all" or sine is None:
        raise NoImpact("the mass sticks to the table forever")
    guess = math.asin(float(sine))
    centre = Fraction(guess if system.eta < 1 else math.pi - guess)
    for exponent in (30, 40, 20, 10):
        reach = Fraction(1, 2**exponent)
        box = Interval(centre - reach, centre + reach, precision=precision + 10)
        found = newton(lambda x: x.sin() - sine, lambda x: x.cos(), box)
        if found.outcome is Roots.UNIQUE and found.box is not None:
            return on_circle((found.box.inf, found.box.sup), precision + 30)
    raise Undecided("the separation phase is not isolated: sin(phi_s) is too close to 1 or -1")


def _sticks(system: System, phases: Range) -> bool | None:
    """Whether all phases stick (True), none does (False), or neither is shown (None)."""
    if system.sticking_arc != "some":
        return system.sticking_arc == "all"
    for bits in (LEAST, 2 * LEAST, 4 * LEAST, MOST):
        acceleration: Interval = launch_acceleration(Flight(system, phases, bits).start)
        if acceleration.certainly_positive():
            return False
        if acceleration.certainly_negative():
            return True
    return None


def image(
    system: System, phases: Range, *, digits: int = 30, horizon: Fraction = HORIZON
) -> Image | PossibleImages:
    """Enclose the image of all phases in [phases[0], phases[1]], a point or an interval.

    A point: every bound agrees with its partner to `digits` significant digits. An interval:
    the ends of the true range to that many digits where flight time, phase and slope are
    monotone, else to 12 digits if so many pieces suffice for that; where f is not shown to be
    continuous, the possible images.
    Raises NoImpact where none is found up to the horizon, Undecided where nothing can be said.
    """
    sticks = _sticks(system, phases)
    if sticks:
        return _after_sticking(system, phases, digits, horizon)
    if phases[0] == phases[1]:
        return _at_point(system, phases, digits, horizon)
    if sticks is None:
        return _possible(system, phases, horizon, "some phases of the interval stick, some do not")
    try:
        parts = cover_by_impacts(system, phases, horizon=horizon)
        return _over_interval(parts, digits)
    except NoImpact:
        raise
    except (Undecided, DomainError) as error:
        if isinstance(error, Unsettled) and error.hopeless:
            raise
        return _possible(system, phases, horizon, _NOT_CUT)


def _at_point(system: System, phases: Range, digits: int, horizon: Fraction) -> Image:
    found = locate(system, phases, horizon=horizon)

    def at_precision(bits: int) -> Image:
        time = impact_time(found, phases, bits)
        slope = found.thin(phases, bits).slope(time)
        arrival = phase_after(phases[0], time, bits + 30)
        return Image(time, arrival, (slope.inf, slope.sup), sticking=False)

    return to_digits(digits, at_precision, lambda x: (x.flight, x.phase, x.slope))


def _after_sticking(system: System, phases: Range, digits: int, horizon: Fraction) -> Image:
    zero = (Fraction(0), Fraction(0))

    def at_precision(bits: int) -> Image:
        leave = separation_phase(system, bits + 20)
        found = locate(system, leave, horizon=horizon, separating=True)
        time, dwell = impact_time(found, leave, bits), _dwell(phases, leave, bits)
        arrival = on_circle((leave[0] + time[0], leave[1] + time[1]), bits + 30)
        return Image(time, arrival, zero, True, dwell)

    def bounds(found: Image) -> Iterable[Range]:
        yield from (found.flight, found.phase)
        if phases[0] == phases[1] and found.dwell is not None:  # else the dwell times differ
            yield found.dwell

    return to_digits(digits, at_precision, bounds, final=(NoImpact,))


def _dwell(phases: Range, leave: Range, bits: int) -> Range:
    """Enclose the times in [0, 2 pi) from the phases to the next one that is in `leave`."""
    low, high = leave[0] - phases[1], leave[1] - phases[0]
    if low < 0 <= high:
        raise Undecided("whether the mass leaves at once, or after a turn, is lost to rounding")
    return on_circle((low, high), bits + 30)


def _over_interval(parts: Iterable[FirstImpact], digits: int) -> Image:
    """Enclose the ranges of t, phi + t and f' by `extremes`; derivatives f' - 1, f' and f''."""
    impacts = tuple(parts)
    branch = Branch(impacts, bits_for(digits) + max(part.places for part in impacts))
    precision = branch.bits + 30

    def time_at(x: Fraction) -> Interval:
        return Interval(*branch.time(x, x), precision=precision)

    slopes = extremes(lambda x: branch.slope(x, x), branch.curvature, branch.ends, most=_PIECES)
    flights = extremes(time_at, lambda a, b: branch.slope(a, b) - 1, branch.ends, most=_PIECES)
    images = extremes(lambda x: time_at(x) + x, branch.slope, branch.ends, most=_PIECES)
    arrival = (images.minimum[0], images.maximum[1])
    return Image(
        (flights.minimum[0], flights.maximum[1]),
        on_circle(arrival, precision),
        (slopes.minimum[0], slopes.maximum[1]),
        sticking=False,
    )


def _possible(
    system: System, phases: Range, horizon: Fraction, reason: str, cuts: int = 5
) -> PossibleImages:
    """Collect windows of possible impacts over 2^cuts parts of the interval."""
    parts = [phases]
    for _ in range(cuts):
        parts = [half for part in parts for half in halves(part)]
    found: list[tuple[Range, Range]] = []
    for part in parts:
        sticks = _sticks(system, part)
        if sticks:
            rest = _after_sticking(system, part, 12, horizon)
            found.append((rest.flight, rest.phase))
            continue
        launches = part if sticks is False else _leaving(system, part)
        impact = _any_impact(system, launches, horizon, separating=sticks is None)
        for low, high in impact.windows:
            arrival = on_circle((launches[0] + low, launches[1] + high), 64)
            found.append(((low, high), arrival))
    return PossibleImages(_merged(found), reason)


def _any_impact(
    system: System, launches: Range, horizon: Fraction, *, separating: bool
) -> FirstImpact:
    """Find windows of the first impacts, at the least precision that has an answer."""
    finest = max(steps_for(launches), _COARSE)
    flight = Flight(system, launches, LEAST, separating)
    try:
        return first_impact(flight, horizon, finest)
    except (NoImpact, Unsettled):
        raise
    except Undecided:
        finer = replace(flight, precision=precision_for(system, launches, horizon))
        return first_impact(finer, horizon, finest)


def _leaving(system: System, part: Range) -> Range:
    """Return the launch phases of a part that contains the separation phase: [phi_s, part[1]]."""
    leave = separation_phase(system, MOST)
    if leave[1] < part[0] or part[1] < leave[0]:
        raise Undecided(
            "the interval contains the phase at which sticking begins: flights there are as "
            "short as one likes, and f jumps; take an interval on one side of it"
        )
    return leave[0], max(part[1], leave[1])


def _merged(images: list[tuple[Range, Range]]) -> tuple[tuple[Range, Range], ...]:
    """Join images whose flight times and phases both overlap."""
    merged: list[tuple[Range, Range]] = []
    for time, phase in sorted(images):
        if merged:
            last_time, last_phase = merged[-1]
            near = time[0] <= last_time[1] and phase[0] <= last_phase[1]
            if near and last_phase[0] <= phase[1]:
                merged[-1] = (hull((last_time, time)), hull((last_phase, phase)))
                continue
        merged.append((time, phase))
    return tuple(merged)
