"""The next impact after one with restitution, to as many digits as are asked for: F and DF."""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction

from intervals import DomainError, Undecided
from intervals.cover import PartsExhausted, cover
from proofs.motion.covering import halves
from proofs.motion.digits import to_digits
from proofs.motion.flight import Flight
from proofs.motion.image import Image, image, separation_phase
from proofs.motion.impact import HORIZON, NoImpact, Unsettled
from proofs.motion.phase import lifted
from proofs.motion.restitution import Arrival, Rebounds, next_impact
from proofs.motion.system import System
from proofs.trusted.equations import arrival
from proofs.trusted.numbers import Range, ceil_text, floor_text, hull

_PARTS = 128
_ZERO = (Fraction(0), Fraction(0))
Jacobian = tuple[tuple[Range, Range], tuple[Range, Range]]


class Impossible(ValueError):
    """No mass above the table can have this velocity before an impact at this phase."""


@dataclass(frozen=True)
class Rebound:
    """The next impact of all states given: bounds on flight, phase, velocity gamma, and DF.

    jacobian: rows (phase, velocity), columns (phi, gamma). If `sticking`, which takes epsilon = 0,
    all of them dwell on the table until the separation phase and fly from there: DF = 0.
    """

    flight: Range
    phase: Range
    velocity: Range
    jacobian: Jacobian
    sticking: bool = False
    dwell: Range | None = None


def rebound(
    system: System,
    phases: Range,
    velocities: Range,
    epsilon: Fraction,
    *,
    digits: int = 30,
    horizon: Fraction = HORIZON,
) -> Rebound:
    """Enclose F and DF over a box of states before an impact, a point or an interval each.

    A point: every bound agrees with its partner to `digits` significant digits. A box: cut into
    parts on which the first impact is one smooth function. Raises Impossible where a state may
    not exist, NoImpact where none follows up to the horizon, Undecided where nothing can be said.
    """
    states = Rebounds(system, phases, velocities=velocities, epsilon=(epsilon, epsilon))
    _require_possible(states)
    if epsilon == 0:
        plastic = image(system, phases, digits=digits, horizon=horizon)
        if isinstance(plastic, Image) and plastic.sticking:
            return _after_sticking(system, plastic, digits)
    if states.single:
        return _at_point(states, digits, horizon)
    return _over_box(states, horizon)


def _require_possible(states: Rebounds) -> None:
    """Raise Impossible unless gap' <= 0 before each impact: the mass comes from above.

    One state is looked at ever more closely; where its closing speed may be 0, Undecided says so.
    """
    for precision in (64, 256, 1024):
        speed = replace(states, precision=precision).closing_speed
        if speed.inf >= 0:
            return
        if speed.sup < 0:
            break
    else:
        if states.single:
            raise Undecided("the closing speed is 0, or too close to it to tell its sign")
    limit = -states.start.rate / states.eta
    if states.system.side < 0:
        bound = f"gamma is at most {floor_text(limit.inf)}"
    else:
        bound = f"gamma is at least {ceil_text(limit.sup)}"
    raise Impossible(
        f"physically impossible: the mass would come from inside the table; {bound} before an "
        "impact at every phase given"
    )


def _at_point(states: Rebounds, digits: int, horizon: Fraction) -> Rebound:
    found = to_digits(
        digits,
        lambda bits: next_impact(states, bits=bits, horizon=horizon),
        lambda x: (x.flight, x.phase, x.velocity, *sum(x.derivative, ())),
        final=(Undecided,),
    )
    return Rebound(found.flight, found.phase, found.velocity, found.derivative)


def _after_sticking(system: System, plastic: Image, digits: int) -> Rebound:
    """Add to the plastic image of sticking phases the velocity at the end of their one flight."""
    bits = digits * 10 // 3 + 50
    flight = Flight(system, separation_phase(system, bits), bits, separating=True)
    velocity = arrival(flight.start, flight.clock(*plastic.flight))[1]
    bounds = velocity.inf, velocity.sup
    none = (_ZERO, _ZERO)
    return Rebound(plastic.flight, plastic.phase, bounds, (none, none), True, plastic.dwell)


def _over_box(states: Rebounds, horizon: Fraction) -> Rebound:
    def decide(part: Rebounds) -> Arrival | None:
        try:
            return next_impact(part, horizon=horizon)
        except (NoImpact, Unsettled):
            raise
        except (Undecided, DomainError):
            return None

    try:
        found = [one for _, one in cover([states], decide, _split, limit=_PARTS)]
    except PartsExhausted:
        raise Undecided(
            f"{_PARTS} parts of the box do not suffice: some of its flights graze or stick, "
            "so that F jumps"
        ) from None
    rows = zip(*(one.derivative for one in found), strict=True)
    (p, q), (r, s) = ([hull(entry) for entry in zip(*row, strict=True)] for row in rows)
    return Rebound(
        hull([one.flight for one in found]),
        hull([lifted(one.phase, one.turns - found[0].turns, 64) for one in found]),
        hull([one.velocity for one in found]),
        ((p, q), (r, s)),
    )


def _split(part: Rebounds) -> tuple[Rebounds, Rebounds]:
    """Halve the longer side of a box of states."""
    by_phase, by_velocity = (ends[1] - ends[0] for ends in (part.phases, part.velocities))
    if by_phase >= by_velocity:
        low, high = halves(part.phases)
        return replace(part, phases=low), replace(part, phases=high)
    low, high = halves(part.velocities)
    return replace(part, velocities=low), replace(part, velocities=high)
