"""The next impact after one with restitution, to as many digits as are asked for: F and DF."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import partial
from typing import Any, NamedTuple

from intervals import Undecided
from intervals.cover import PartsExhausted, cover
from proofs.motion.brackets import transversal_impact
from proofs.motion.covering import halves
from proofs.motion.digits import to_digits
from proofs.motion.landing import separation_phase
from proofs.motion.system import System
from proofs.motion.witness import HORIZON, FlightBox, Impossible, NoImpact, Unsettled
from proofs.search.evidence import FAILED, Proved, concluded, floats_first
from proofs.search.image import Image, image
from proofs.trusted.certificate import texts
from proofs.trusted.equations import arrival
from proofs.trusted.flights import COVER_BITS, Motion, bits_for, lifted
from proofs.trusted.kernel.context import Context
from proofs.trusted.numbers import Range, ceil_text, floor_text, hull
from proofs.trusted.paper.s33_restitution.rebounds import Entries, next_states
from proofs.trusted.parameters import Place

_PARTS = 128
_ZERO = (Fraction(0), Fraction(0))


@dataclass(frozen=True)
class Rebound:
    """The next impact of all states given: bounds on flight, phase, velocity gamma, and DF.

    jacobian: rows (phase, velocity), columns (phi, gamma). If `sticking`, which takes epsilon = 0,
    all of them dwell on the table until the separation phase and fly from there: DF = 0. prove:
    makes steps that say so, of the flight alone if `sticking`.
    """

    flight: Range
    phase: Range
    velocity: Range
    jacobian: Entries
    sticking: bool = False
    dwell: Range | None = None
    prove: Callable[[], Proved] = field(kw_only=True, compare=False, repr=False)


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
    eta, nu, epsilons = ((x, x) for x in (system.eta, system.nu, epsilon))
    states = FlightBox((eta, nu, epsilons), phases, velocities)
    _require_possible(states)
    if epsilon == 0:
        plastic = image(system, phases, digits=digits, horizon=horizon)
        if isinstance(plastic, Image) and plastic.sticking:
            return _after_sticking(system, plastic)
    if not states.widths:
        return _at_point(states, digits, horizon)
    return _over_box(states, horizon)


def _require_possible(states: FlightBox) -> None:
    """Raise Impossible unless gap' <= 0 before each impact: the mass comes from above.

    One state is looked at ever more closely; where its closing speed may be 0, Undecided says so.
    """
    for bits in (COVER_BITS, 4 * COVER_BITS, 16 * COVER_BITS):
        start = states.start(bits)
        speed = states.closing_speed(start, bits)
        if speed.lo >= 0:
            return
        if speed.hi < 0:
            break
    else:
        if not states.widths:
            raise Undecided("the closing speed is 0, or too close to it to tell its sign")
    low, high = (-start.rate / start.eta).range
    if states.side < 0:
        bound = f"gamma is at most {floor_text(low)}"
    else:
        bound = f"gamma is at least {ceil_text(high)}"
    raise Impossible(
        f"physically impossible: the mass would come from inside the table; {bound} before an "
        "impact at every phase given"
    )


def witness(flights: FlightBox, times: tuple[Fraction, ...], impact: Range) -> dict[str, list[str]]:
    """Return what rule `rebound` takes."""
    names = "eta", "nu", "epsilon"
    sides = {name: texts(side) for name, side in zip(names, flights.sides, strict=True)}
    states = {"phases": texts(flights.phases), "velocities": texts(flights.velocities or _ZERO)}
    return {**sides, **states, "times": texts(times), "impact": texts(impact)}


class NextState(NamedTuple):
    """What rule `rebound` takes, and what `next_states` returns: phases are less turns."""

    witness: dict[str, list[str]]
    flight: Range
    turns: int
    phase: Range
    velocity: Range
    derivative: Entries


def next_state(states: FlightBox, bits: int, horizon: Fraction) -> NextState:
    """Enclose F and DF over a box of states."""

    def make(floats: bool) -> NextState:
        found, time = transversal_impact(states, bits, horizon=horizon, floats=floats)
        box = states.phases, states.velocities or _ZERO
        taken = witness(states, found.times, time)
        return NextState(taken, time, *next_states(states.sides, box, found.times, time))

    return floats_first(make)


def _at_point(states: FlightBox, digits: int, horizon: Fraction) -> Rebound:
    found = to_digits(
        digits,
        lambda bits: next_state(states, bits, horizon),
        lambda x: (x.flight, x.phase, x.velocity, *sum(x.derivative, ())),
        final=(Undecided,),
    )
    prove = partial(_proved, states, [found])
    return Rebound(found.flight, found.phase, found.velocity, found.derivative, prove=prove)


def _proved(states: FlightBox, parts: Sequence[NextState]) -> Proved:
    """Prove what F does on each part (rule rebound)."""
    at, steps = Place(*states.sides), dict[str, dict[str, Any]]()
    for number, part in enumerate(parts, 1):
        concluded("rebound", part.witness, Context(at))
        steps[f"rebound-{number}"] = {"rule": "rebound", "witness": part.witness}
    return at, steps, [*steps]


def _after_sticking(system: System, plastic: Image) -> Rebound:
    """Add to the plastic image of sticking phases the velocity at the end of their one flight."""
    bits = bits_for(plastic.flight)
    motion = Motion(system.place, separation_phase(system, bits), bits)
    velocity = arrival(motion.start(), motion.clock(plastic.flight))[1].range
    still = (_ZERO, _ZERO), (_ZERO, _ZERO)
    arrived, dwell, prove = (plastic.flight, plastic.phase, velocity), plastic.dwell, plastic.prove
    return Rebound(*arrived, still, sticking=True, dwell=dwell, prove=prove)


def _over_box(states: FlightBox, horizon: Fraction) -> Rebound:
    def decide(part: FlightBox) -> NextState | None:
        try:
            return next_state(part, COVER_BITS, horizon)
        except (NoImpact, Unsettled):
            raise
        except FAILED:
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
        prove=partial(_proved, states, found),
    )


def _split(part: FlightBox) -> tuple[FlightBox, FlightBox]:
    """Halve the longer side of a box of states."""
    by_phase, by_velocity = (ends[1] - ends[0] for ends in (part.phases, part.velocities or _ZERO))
    if by_phase >= by_velocity:
        low, high = halves(part.phases)
        return replace(part, phases=low), replace(part, phases=high)
    low, high = halves(part.velocities or _ZERO)
    return replace(part, velocities=low), replace(part, velocities=high)
