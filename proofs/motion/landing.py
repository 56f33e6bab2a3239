"""Where flights land: candidates for the rules of `s34_circle`."""

from __future__ import annotations

import math
from fractions import Fraction

from intervals import Undecided
from proofs.motion.digits import around, middle
from proofs.motion.system import System
from proofs.motion.witness import HORIZON, NoImpact
from proofs.trusted.certificate import texts
from proofs.trusted.equations import launch_acceleration
from proofs.trusted.flights import Motion
from proofs.trusted.kernel.arithmetic import Unproved, rational
from proofs.trusted.kernel.enclose import enclosed
from proofs.trusted.kernel.firstzero import NoFirstZero
from proofs.trusted.numbers import Range, bits_for
from proofs.trusted.oscillator import SEPARATES, PlasticMap

NEWTON = 6  # steps
_ROOM = 40  # bits


def separation_phase(system: System, bits: int) -> Range:
    """Bracket the phase phi_s at which a sticking mass leaves, in [0, 2 pi), to 2^(1 - bits).

    It is the zero of the launch acceleration at which that increases: the sine is the paper's
    eta^2 / (nu (1 - eta^2)), the cosine has the sign of 1 - eta^2. Raises NoImpact if the mass
    never leaves, Undecided too close to the parameters where that begins.
    """
    sine = system.separation_sine
    if system.sticking_arc == "all" or sine is None:
        raise NoImpact("the mass sticks to the table forever")
    guess = math.asin(max(-1.0, min(1.0, float(sine))))
    phase = Fraction((guess if system.eta < 1 else math.pi - guess) % math.tau)
    places, at = bits + _ROOM, system.place
    for _ in range(places.bit_length()):
        sin, cos = map(middle, rational(phase, places).sincos())
        phase = round((phase - (sin - sine) / cos) * 2**places) / Fraction(2**places)
    ends = around(phase, bits)
    low, high = (launch_acceleration(Motion(at, (x, x), 2 * places).start) for x in ends)
    if not low.hi < 0 < high.lo or ends[0] < 0:
        raise Undecided("the separation phase is not isolated: sin(phi_s) is too close to 1 or -1")
    return ends


def separation(system: System, bits: int, horizon: Fraction = HORIZON) -> dict[str, object]:
    """Bracket the end of the sticking arc, from which the flight is proved to end."""
    if system.sticking_arc == "none":
        raise Undecided("the mass sticks nowhere: there is no separation phase")
    phase, f = separation_phase(system, bits), PlasticMap(system.place, horizon, SEPARATES)
    try:
        f.impact(enclosed((phase,), bits_for(phase)))
    except NoFirstZero as failure:
        raise NoImpact(str(failure)) from None
    except Unproved as failure:
        raise Undecided(str(failure)) from None
    return {"phase": texts(phase)}


def zero(motion: Motion, time: Fraction, order: int) -> Fraction:
    """Return about where a derivative of the gap is 0, near a time, by Newton's method."""
    gap_of, unit = motion.gap_of, 2**motion.bits
    for _ in range(NEWTON):
        value, rate = (middle(gap_of((time, time), k)) for k in (order, order + 1))
        before, time = time, Fraction(round((time - value / rate) * unit), unit)
        if abs(time - before) * 2 ** (motion.bits // 2) < 1:  # the error is about its square
            break
    return time


def short(value: Fraction, places: int) -> Fraction:
    """Round down to so many binary places."""
    return Fraction(value * 2**places // 1, 2**places)
