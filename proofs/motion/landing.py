"""Where flights land: candidates for the rules of `s34_circle`."""

from __future__ import annotations

from fractions import Fraction

from intervals import Interval, Undecided
from proofs.motion.flight import Flight
from proofs.motion.image import separation_phase
from proofs.motion.impact import impact_time, locate
from proofs.motion.system import System
from proofs.trusted.certificate import texts
from proofs.trusted.flights import Motion
from proofs.trusted.kernel.arithmetic import Enclosure
from proofs.trusted.numbers import Phases, Range
from proofs.trusted.paper.s34_circle.landing import NeverImpacts, closest_approach
from proofs.trusted.parameters import Place
from proofs.trusted.windows import BITS

NEWTON = 6  # steps


def separation(system: System, bits: int) -> dict[str, object]:
    """Bracket the end of the sticking arc, and the flight from it, to about 2^-bits.

    The window of the impact is the last piece of the times.
    """
    if system.sticking_arc != "some":
        raise Undecided("the mass sticks nowhere, or everywhere: there is no separation phase")
    unit = Fraction(1, 2**bits)
    centre = round(separation_phase(system, bits + 20)[0] / unit) * unit
    phase = centre - unit, centre + unit
    found = locate(system, phase, separating=True)
    time = impact_time(found, phase, bits - 10)
    times = [*(each for each in found.times[1:] if each <= found.window[0]), found.window[1]]
    return {"phase": texts(phase), "times": texts(times), "time": texts(time)}


def prove_never(system: System, phases: Range) -> NeverImpacts:
    """Prove that no flight from some phases near pi/2 ends."""
    flight, half_turn = Flight(system, phases, BITS), Interval.pi(precision=BITS)
    nu = Interval(system.nu, precision=BITS)
    bounds = closest_approach(system.eta, nu, flight.start, flight.phi - half_turn / 2, half_turn)
    if not all(bound.certainly_positive() for bound in bounds):
        raise Undecided("an impact is not excluded")
    return NeverImpacts(Place.plastic(system.eta, system.nu), Phases(*phases))


def zero(motion: Motion, time: Fraction, order: int) -> Fraction:
    """Return about where a derivative of the gap is 0, near a time, by Newton's method."""
    gap_of, unit = motion.gap_of, 2**motion.bits
    for _ in range(NEWTON):
        value, rate = (middle(gap_of((time, time), k)) for k in (order, order + 1))
        before, time = time, Fraction(round((time - value / rate) * unit), unit)
        if abs(time - before) * 2 ** (motion.bits // 2) < 1:  # the error is about its square
            break
    return time


def middle(x: Enclosure) -> Fraction:
    """Return about the number that is enclosed."""
    return Fraction(x.lo + x.hi, 2 << x.bits)


def short(value: Fraction, places: int) -> Fraction:
    """Round down to so many binary places."""
    return Fraction(value * 2**places // 1, 2**places)
