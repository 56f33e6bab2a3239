"""The next impact after one with restitution, to as many digits as are asked for: F and DF."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import partial
from typing import NamedTuple

from intervals import Undecided
from intervals.cover import PartsExhausted, cover
from proofs.methods.derivation import Derivation
from proofs.methods.divisions import halved
from proofs.motion.digits import to_digits
from proofs.motion.landing import separation_phase
from proofs.motion.system import System
from proofs.motion.witness import HORIZON, Impossible, NoImpact
from proofs.search.evidence import Proved
from proofs.search.image import Image, image
from proofs.search.s33_steps import function_of
from proofs.trusted.certificate import texts
from proofs.trusted.equations import arrival, closing, launch
from proofs.trusted.flights import Motion, lifted, whole_turns
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.differential import Differential, differential_on
from proofs.trusted.kernel.enclose import enclosed
from proofs.trusted.kernel.firstzero import NoFirstZero
from proofs.trusted.numbers import COVER_BITS, Range, bits_for, ceil_text, floor_text, hull
from proofs.trusted.oscillator import Oscillator

Box = tuple[Range, ...]  # phases x velocities
_PARTS = 128
_ROOM = 40  # bits beyond those that are asked for
_ZERO = (Fraction(0), Fraction(0))
_UNIT = ((Fraction(0), Fraction(1)),) * 2


@dataclass(frozen=True)
class Rebound:
    """The next impact of all states given: bounds on flight, phase, velocity gamma, and DF.

    jacobian: rows (phase, velocity) by (phi, gamma). If `sticking`, which takes epsilon = 0,
    all of them dwell on the table until the separation phase and fly from there: DF = 0. prove:
    makes steps that say so, of the flight alone if `sticking`.
    """

    flight: Range
    phase: Range
    velocity: Range
    jacobian: tuple[Range, ...]
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
    oscillator = Oscillator(((system.eta,) * 2, (system.nu,) * 2, (epsilon,) * 2), horizon)
    box = phases, velocities
    _require_possible(oscillator, box)
    if epsilon == 0:
        plastic = image(system, phases, digits=digits, horizon=horizon)
        if isinstance(plastic, Image) and plastic.sticking:
            return _after_sticking(system, plastic)
    if phases[0] == phases[1] and velocities[0] == velocities[1]:
        return _at_point(oscillator, box, digits)
    return _over_box(oscillator, box)


def _require_possible(oscillator: Oscillator, box: Box) -> None:
    """Raise Impossible unless gap' <= 0 before each impact: the mass comes from above.

    One state is looked at ever more closely; where its closing speed may be 0, Undecided says so.
    """
    for bits in (COVER_BITS, 4 * COVER_BITS, 16 * COVER_BITS):
        eta, nu, phi, gamma = (Enclosure.of(*side, bits) for side in (*oscillator.ranges[:2], *box))
        start = launch(oscillator.formulas.side, eta, nu, phi)
        speed = closing(start, gamma) * oscillator.formulas.side
        if speed.lo > 0:
            return
        if speed.hi < 0:
            break
    else:
        if all(low == high for low, high in box):
            raise Undecided("the closing speed is 0, or too close to it to tell its sign")
    low, high = (-start.rate / start.eta).range
    if oscillator.formulas.side < 0:
        bound = f"gamma is at most {floor_text(low)}"
    else:
        bound = f"gamma is at least {ceil_text(high)}"
    raise Impossible(
        f"physically impossible: the mass would come from inside the table; {bound} before an "
        "impact at every phase given"
    )


class NextState(NamedTuple):
    """What rule `differential` concludes, with so many bits; how long the flights take."""

    proved: Differential
    bits: int
    flight: Range


def next_state(oscillator: Oscillator, box: Box, bits: int) -> NextState:
    """Enclose F and DF over a box of states; NoImpact where none follows up to the horizon."""
    try:
        time = oscillator.impact(enclosed(box, bits)).range
        turns = (box[0][0] + time[0]) // whole_turns(1, bits)[0]
        return NextState(differential_on(oscillator, box, (turns,), bits), bits, time)
    except NoFirstZero as failure:
        raise NoImpact(str(failure)) from None


def _at_point(oscillator: Oscillator, box: Box, digits: int) -> Rebound:
    state = to_digits(
        digits,
        lambda bits: next_state(oscillator, box, bits + _ROOM),
        lambda x: (x.flight, *x.proved.values, *sum(x.proved.matrix, ())),
        final=(NoImpact,),
    )
    return _joined(oscillator, [state])


def _joined(oscillator: Oscillator, parts: Sequence[NextState]) -> Rebound:
    """Return what holds for all parts of a box; phases are less the turns of the first."""
    (turns, *_) = (each.proved.turns[0] for each in parts)
    return Rebound(
        hull([each.flight for each in parts]),
        hull([lifted(x.values[0], x.turns[0] - turns, 64) for x, *_ in parts])
        if len(parts) > 1
        else parts[0].proved.values[0],
        hull([each.proved.values[1] for each in parts]),
        tuple(map(hull, zip(*(sum(each.proved.matrix, ()) for each in parts), strict=True))),
        prove=partial(_proved, oscillator, parts),
    )


def _proved(oscillator: Oscillator, parts: Sequence[NextState]) -> Proved:
    """Prove what F does on each part (rule differential)."""
    proof = Derivation({}, context=Context(oscillator.at))
    for part, bits, _ in parts:
        witness = {
            "function": function_of(oscillator.at),
            "box": [texts(side) for side in part.box],
            "turns": [str(part.turns[0])],
            "bits": str(bits),
        }
        proof.add("differential", witness)
    return oscillator.at, proof.steps, [*proof.steps]


def _after_sticking(system: System, plastic: Image) -> Rebound:
    """Add to the plastic image of sticking phases the velocity at the end of their one flight."""
    bits = bits_for(plastic.flight)
    motion = Motion(system.place, separation_phase(system, bits), bits)
    velocity = arrival(motion.start, motion.clock(plastic.flight))[1].range
    still = (_ZERO,) * 4
    arrived, dwell, prove = (plastic.flight, plastic.phase, velocity), plastic.dwell, plastic.prove
    return Rebound(*arrived, still, sticking=True, dwell=dwell, prove=prove)


def _over_box(oscillator: Oscillator, box: Box) -> Rebound:
    def decide(part: Box) -> NextState | None:
        try:
            return next_state(oscillator, part, COVER_BITS)
        except Unproved:
            return None

    try:
        parts = cover([box], decide, lambda part: halved(part, _UNIT)[1:], limit=_PARTS)
        states = [state for _, state in parts]
    except PartsExhausted:
        raise Undecided(
            f"{_PARTS} parts of the box do not suffice: some of its flights graze or stick, "
            "so that F jumps"
        ) from None
    return _joined(oscillator, states)
