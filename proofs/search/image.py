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
from proofs.motion.landing import separation
from proofs.motion.system import System
from proofs.motion.witness import HORIZON, Flights, NoImpact
from proofs.search.evidence import FAILED, Proved
from proofs.search.steps import Prover
from proofs.trusted.equations import launch_acceleration
from proofs.trusted.flights import Motion, whole_turns
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.enclose import enclosed
from proofs.trusted.kernel.firstzero import NoFirstZero
from proofs.trusted.numbers import COVER_BITS, Range, hull
from proofs.trusted.oscillator import PlasticMap

_NOT_CUT = (
    "the interval seems to contain a grazing phase, or to reach too near to where sticking begins"
)
_PIECES = 32  # twelve digits take a dozen, but next to the onset of sticking any number
_ROOM = 30  # bits beyond those that are asked for
_PRECISIONS = tuple(COVER_BITS << k for k in range(4))
_LITTLE = Fraction(1, 1000)  # before a touch


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
    def prove() -> Proved:
        return prover.claimed(prover.point(phases[0])[0])

    def at_precision(bits: int) -> Image:
        try:
            time, slope = _flight(prover, phases, bits + _ROOM)
        except Unproved:
            if touch := _touch(prover, phases):  # which more bits do not mend
                raise _Touches(touch) from None
            raise
        arrival = phase_after(phases[0], time, bits + _ROOM)
        return Image(time, arrival, slope, sticking=False, prove=prove)

    final = (NoImpact, _Touches)
    return to_digits(prover.digits, at_precision, lambda x: (x.flight, x.phase, x.slope), final)


class _Touches(Undecided):
    """A flight touches the table, if there was no impact just before."""


def _flight(prover: Prover, phases: Range, bits: int) -> tuple[Range, Range]:
    """Enclose the time of the impact, and f'."""
    x, f = enclosed((phases,), bits), prover.impact_map
    try:
        return f.impact(x).range, f.jacobian(x)[0][0].range
    except NoFirstZero:
        raise _none(prover) from None


def _none(prover: Prover) -> NoImpact:
    return NoImpact(f"there is no impact up to time {float(prover.horizon):g} (the horizon)")


def _touch(prover: Prover, phases: Range) -> str:
    """Say that a flight without an earlier impact touches the table; "" where none is proved.

    eta = p/q: after q turns of the table mass and table are where they were, as fast.
    """
    turns = prover.system.eta.denominator
    latest = whole_turns(turns, COVER_BITS)[0] - _LITTLE
    if latest > prover.horizon:
        return ""
    try:
        PlasticMap(prover.at, latest).impact(enclosed((phases,), COVER_BITS))
    except NoFirstZero:
        return (
            f"at time 2 pi {turns} mass and table are where they were at the launch, and touch "
            "without relative velocity if there was no impact just before"
        )
    except Unproved:
        pass
    return ""


def _after_sticking(prover: Prover, phases: Range) -> Image:
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

    return to_digits(prover.digits, at_precision, bounds, final=(NoImpact,))


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
        return _flight(prover, (x, x), bits)

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
    images: list[tuple[Range, Range]] = []
    fates = [(part, _sticks(prover, part)) for part in parts]
    if any(sticks is not False for _, sticks in fates):
        _, rest = prover.derive("separation", separation(prover.system, 2 * COVER_BITS))
        images.append((rest.time, phase_after(Fraction(0), rest.arrival, COVER_BITS)))
    for part, sticks in fates:
        if sticks:
            continue
        first = part if sticks is False else _leaving(prover, rest.phase, part)
        if first[0] > first[1]:
            continue
        for low, high in _windows(prover, first):
            arrival = phase_after(Fraction(0), (first[0] + low, first[1] + high), COVER_BITS)
            images.append(((low, high), arrival))
    return PossibleImages(_merged(images), reason)


def _leaving(prover: Prover, leave: Range, part: Range) -> Range:
    """Return the phases of a part beyond a bracket of the separation, all before it sticking.

    From the bracket itself the flights are those of the separation.
    """
    before = part[0], min(part[1], leave[0])
    if leave[1] < part[0] or (before[0] < leave[0] and not _sticks(prover, before)):
        raise Undecided(
            "the interval contains the phase at which sticking begins: flights there are as "
            "short as one likes, and f jumps; take an interval on one side of it"
        )
    return leave[1], part[1]


def _windows(prover: Prover, phases: Range) -> list[Range]:
    """Prove windows of the first impacts, at the least precision that has an answer."""
    reason = ""
    for bits in _PRECISIONS:
        try:
            search = Flights.plastic(Motion(prover.at, phases, bits)).search(2)
            return [*search.windows(prover.horizon)]
        except NoFirstZero:
            raise _none(prover) from None
        except Unproved as failure:
            reason = str(failure)
    raise Undecided(reason)


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
