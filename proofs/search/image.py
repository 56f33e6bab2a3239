"""The image of a phase, or of an interval of phases, under the plastic impact map.

All is concluded by the checker's rules and lemmas on flights.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from fractions import Fraction

from intervals import Undecided
from intervals.cover import halves
from proofs.methods.extremes import extremes
from proofs.motion.digits import phase_after, to_digits
from proofs.motion.landing import separation, separation_phase
from proofs.motion.system import System
from proofs.motion.witness import (
    HORIZON,
    MOST_BITS,
    FlightBox,
    NoImpact,
    Unsettled,
    locate,
    march,
)
from proofs.search.evidence import FAILED, Proved
from proofs.search.steps import Prover
from proofs.trusted.equations import launch_acceleration
from proofs.trusted.flights import Motion
from proofs.trusted.kernel.enclose import enclosed
from proofs.trusted.kernel.firstzero import NoFirstZero
from proofs.trusted.numbers import COVER_BITS, Range, hull

_NOT_CUT = (
    "the interval seems to contain a grazing phase, or to reach too near to where sticking begins"
)
_PIECES = 32  # twelve digits take a dozen, but next to the onset of sticking any number
_ROOM = 30  # bits beyond those that are asked for
_PRECISIONS = (COVER_BITS, 2 * COVER_BITS, 4 * COVER_BITS, MOST_BITS)
_COARSE = Fraction(1, 2**12)  # the finest time step where only a set of images is wanted


@dataclass(frozen=True)
class Image:
    """The next impact of all given phases: bounds on its time of flight, its phase, f'.

    If `sticking`, all of them stick first: they dwell on the table until the separation phase,
    the flight starts there, and f is constant. Phases are mod 2 pi, the lower end in [0, 2 pi).
    prove: makes steps that say so.
    """

    flight: Range
    phase: Range
    slope: Range
    sticking: bool
    dwell: Range | None = None
    prove: Callable[[], Proved] = field(kw_only=True, compare=False, repr=False)


@dataclass(frozen=True)
class PossibleImages:
    """Where f is not continuous on the interval: every image is in one of these pairs."""

    images: tuple[tuple[Range, Range], ...]
    reason: str


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
    try:
        return _image(Prover(system, digits, horizon), phases)
    except (NoImpact, Undecided):
        raise
    except FAILED as failure:
        raise Undecided(str(failure)) from None


def _image(prover: Prover, phases: Range) -> Image | PossibleImages:
    sticks = _sticks(prover, phases)
    if sticks:
        return _after_sticking(prover, phases)
    if phases[0] == phases[1]:
        return _at_point(prover, phases)
    if sticks is None:
        return _possible(prover, phases, "some phases of the interval stick, some do not")
    try:
        return _over_interval(prover, phases)
    except NoImpact:
        raise
    except FAILED:
        return _possible(prover, phases, _NOT_CUT)


def _sticks(prover: Prover, phases: Range) -> bool | None:
    """Whether all phases stick (True), none does (False), or neither is shown (None)."""
    if prover.system.sticking_arc != "some":
        return prover.system.sticking_arc == "all"
    for bits in _PRECISIONS:
        low, high = launch_acceleration(Motion(prover.at, phases, bits).start).range
        if low > 0 or high < 0:
            return bool(high < 0)
    return None


def _at_point(prover: Prover, phases: Range) -> Image:
    locate(prover.flights(phases), horizon=prover.horizon)  # or it says why there is none

    def prove() -> Proved:
        return prover.claimed(prover.point(phases[0])[0])

    def at_precision(bits: int) -> Image:
        x = enclosed((phases,), bits + _ROOM)
        time, slope = prover.impact_map.impact(x).range, prover.impact_map.jacobian(x)[0][0].range
        arrival = phase_after(phases[0], time, bits + _ROOM)
        return Image(time, arrival, slope, sticking=False, prove=prove)

    return to_digits(prover.digits, at_precision, lambda x: (x.flight, x.phase, x.slope))


def _after_sticking(prover: Prover, phases: Range, digits: int | None = None) -> Image:
    zero = (Fraction(0), Fraction(0))

    def at_precision(bits: int) -> Image:
        witness = separation(prover.system, bits + 20, prover.horizon)
        name, separated = prover.derive("separation", witness)
        arrival = phase_after(Fraction(0), separated.arrival, bits)
        dwell = _dwell(phases, separated.phase, bits)
        return Image(separated.time, arrival, zero, True, dwell, prove=lambda: prover.claimed(name))

    def bounds(image: Image) -> Iterable[Range]:
        yield from (image.flight, image.phase)
        if phases[0] == phases[1] and image.dwell is not None:  # else the dwell times differ
            yield image.dwell

    return to_digits(digits or prover.digits, at_precision, bounds, final=(NoImpact,))


def _dwell(phases: Range, leave: Range, bits: int) -> Range:
    """Enclose the times in [0, 2 pi) from the phases to the next one that is in `leave`."""
    low, high = leave[0] - phases[1], leave[1] - phases[0]
    if low < 0 <= high:
        raise Undecided("whether the mass leaves at once, or after a turn, is lost to rounding")
    return phase_after(Fraction(0), (low, high), bits)


def _over_interval(prover: Prover, phases: Range) -> Image:
    """Enclose the ranges of t, phi + t and f' by `extremes`; derivatives f' - 1, f' and f''."""
    f = prover.impact_map

    def bounds_at(x: Fraction, bits: int) -> tuple[Range, Range]:
        point = enclosed(((x, x),), bits)
        try:
            return f.impact(point).range, f.jacobian(point)[0][0].range
        except NoFirstZero as error:
            raise NoImpact(str(error)) from None

    def at_ends(bits: int) -> tuple[int, list[Range]]:
        more = bits + _ROOM
        return more, [each for end in phases for each in bounds_at(end, more)]

    bits, _ = to_digits(prover.digits, at_ends, lambda answer: answer[1], final=(NoImpact,))

    def image_at(x: Fraction) -> Range:
        low, high = bounds_at(x, bits)[0]
        return x + low, x + high

    def slope(low: Fraction, high: Fraction) -> Range:
        return f.jacobian(enclosed(((low, high),), bits))[0][0].range

    def bend(low: Fraction, high: Fraction) -> Range:
        return f.bend(enclosed(((low, high),), bits)).range

    def faster(low: Fraction, high: Fraction) -> Range:
        least, most = slope(low, high)
        return least - 1, most - 1

    ends = prover.parts(phases, lambda part: bool(slope(*part)), "grazing")
    slopes = extremes(lambda x: bounds_at(x, bits)[1], bend, ends, most=_PIECES)
    flights = extremes(lambda x: bounds_at(x, bits)[0], faster, ends, most=_PIECES)
    images = extremes(image_at, slope, ends, most=_PIECES)
    arrival = (images.minimum[0], images.maximum[1])

    def prove() -> Proved:
        return prover.claimed(prover.slopes([*phases])[0])

    return Image(
        (flights.minimum[0], flights.maximum[1]),
        phase_after(Fraction(0), arrival, bits),
        (slopes.minimum[0], slopes.maximum[1]),
        sticking=False,
        prove=prove,
    )


def _possible(prover: Prover, phases: Range, reason: str, cuts: int = 5) -> PossibleImages:
    """Collect windows of possible impacts over 2^cuts parts of the interval."""
    parts = [phases]
    for _ in range(cuts):
        parts = [half for part in parts for half in halves(part)]
    pairs: list[tuple[Range, Range]] = []
    for part in parts:
        sticks = _sticks(prover, part)
        if sticks:
            rest = _after_sticking(prover, part, 12)
            pairs.append((rest.flight, rest.phase))
            continue
        first = part if sticks is False else _leaving(prover.system, part)
        flights = FlightBox.plastic(prover.at, first, separating=sticks is None)
        for low, high in _windows(flights, prover.horizon):
            arrival = phase_after(Fraction(0), (first[0] + low, first[1] + high), COVER_BITS)
            pairs.append(((low, high), arrival))
    return PossibleImages(_merged(pairs), reason)


def _windows(flights: FlightBox, horizon: Fraction) -> tuple[Range, ...]:
    """Prove windows of the first impacts, at the least precision that has an answer.

    At a distance w from a grazing phase the gap dips below 0 for a time of the order sqrt(w).
    """
    width = flights.phases[1] - flights.phases[0]
    finest = max(Fraction(1, 8 << (1 / width).__ceil__().bit_length() // 2), _COARSE)
    for bits in _PRECISIONS[:-1]:
        try:
            return march(flights, bits, horizon, finest).proved_windows()
        except (NoImpact, Unsettled):
            raise
        except FAILED:
            continue
    return march(flights, MOST_BITS, horizon, finest).proved_windows()


def _leaving(system: System, part: Range) -> Range:
    """Return the launch phases of a part that contains the separation phase: [phi_s, part[1]]."""
    leave = separation_phase(system, MOST_BITS)
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
