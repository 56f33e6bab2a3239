"""The families of hard cases: how one of each is drawn, and the table of all."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from typing import NamedTuple

import mpmath

from proofs.benchmark.peers import Arithmetic
from proofs.stress.arithmetic import function, operation
from proofs.stress.cases import ETA, NU, Case, Draw, Numbers, flight
from proofs.stress.truth import graze, separation_point

_CIRCLE = Fraction(62831, 10000)


def _around(
    draw: Draw, oscillator: Numbers, phase: Fraction, room: Fraction, digits: Sequence[int] = (30,)
) -> Case:
    """Return the launch at a phase, or half of the time an interval within `room` above it."""
    width = room / 10 ** draw.randint(1, 12) if draw.random() < 0.5 else Fraction(0)
    asked = draw.choice(digits) if len(digits) > 1 else digits[0]
    return flight(draw.family, oscillator, (phase, phase + width), asked)


def _short(draw: Draw, kernel: Arithmetic) -> Case:
    """The flight lasts 3 times the distance."""
    oscillator, distance = draw.system(), draw.tiny(2, 40)
    phase = separation_point(kernel, *oscillator, beginning=True) - distance
    return _around(draw, oscillator, phase, distance / 2)


def _separation(draw: Draw, kernel: Arithmetic) -> Case:
    """Launches at both sides of the phase where the gap has a triple zero."""
    oscillator, distance = draw.system(), draw.tiny(2, 60) * draw.sign()
    phase = separation_point(kernel, *oscillator) + distance
    return _around(draw, oscillator, phase, abs(distance) / 2, (10, 20, 30))


def _grazing(draw: Draw, kernel: Arithmetic) -> Case:
    """At both sides of it: an impact of speed 0, or none until much later."""
    eta, nu, phase = graze(kernel, draw.randrange(100))
    phase += draw.tiny(3, 30) * draw.sign()
    return flight(draw.family, (eta, nu), (phase, phase))


def _tangent(draw: Draw, kernel: Arithmetic) -> Case:
    eta, nu, phase = graze(kernel, draw.randrange(100))
    distance = draw.tiny(2, 14) * draw.sign()
    return _around(draw, (eta, nu), phase + distance, abs(distance) / 2)


def _long(draw: Draw, _: Arithmetic) -> Case:
    """A soft spring, or the paper's launches next to pi/2."""
    if draw.random() < 0.25:
        phase = Fraction(math.pi / 2) + draw.tiny(3, 4) * draw.sign()
        return flight(draw.family, (ETA, NU), (phase, phase), 15, 3000)
    oscillator = draw.tiny(3, 5), -draw.decimal(0.1, 0.9, 4)
    phase = draw.decimal(0.1, 1.5)
    return flight(draw.family, oscillator, (phase, phase), 15, 10**6)


def _soft(draw: Draw, _: Arithmetic) -> Case:
    """The table catches up with a mass that hardly feels its spring."""
    oscillator = draw.tiny(2, 40), draw.decimal(0.01, 3, 4) * draw.sign()
    return _around(draw, oscillator, draw.decimal(1.6, 3.1), Fraction(1, 1000))


def _at_phase(
    oscillator: Callable[[Draw], Numbers], horizon: int = 200
) -> Callable[[Draw, Arithmetic], Case]:
    """Return what draws a launch at any phase, after the oscillator."""

    def draw_case(draw: Draw, _: Arithmetic) -> Case:
        numbers, phase = oscillator(draw), draw.phase()
        return flight(draw.family, numbers, (phase, phase), 20, horizon)

    return draw_case


def _resonant(draw: Draw) -> Numbers:
    return 1 + draw.tiny(1, 40) * draw.choice((-1, 0, 1, -1, 1)), -draw.decimal(0.05, 3, 4)


def _rational(draw: Draw) -> Numbers:
    """All returns to the launch after as many turns of the table as the denominator says."""
    eta = Fraction(draw.randint(1, 9), draw.randint(1, 9))
    return eta, draw.decimal(0.05, 2, 4) * draw.sign()


def _small_nu(draw: Draw) -> Numbers:
    """Eta is small with it, or not."""
    nu, eta = draw.tiny(1, 30) * draw.sign(), draw.decimal(0.1, 2, 3)
    if draw.random() < 0.5:
        eta = Fraction(math.sqrt(abs(nu))) * draw.decimal(0.1, 0.9, 3)
    return eta, nu


def _large_nu(draw: Draw, _: Arithmetic) -> Case:
    nu = 1 + draw.tiny(1, 30) * draw.choice((-1, 0, 1))
    if draw.random() < 0.5:
        nu = draw.decimal(1, 9) * 10 ** draw.randint(0, 20)
    phase = draw.phase()
    nu *= draw.sign()
    return flight(draw.family, (draw.decimal(0.05, 2, 4), nu), (phase, phase), 20, 200)


def _digits(draw: Draw, _: Arithmetic) -> Case:
    eta, nu = (value + Fraction(draw.randrange(10**49), 10**53) for value in draw.system())
    return _around(draw, (eta, nu), draw.phase(), Fraction(1, 100))


def _restitution(draw: Draw, _: Arithmetic) -> Case:
    """Also 0 and 1 themselves; launches of all kinds."""
    oscillator = draw.system()
    near = draw.tiny(1, 30), 1 - draw.tiny(1, 30)
    epsilon = draw.choice((Fraction(0), Fraction(1), *near))
    phase = draw.phase()
    gamma = _velocity(oscillator, phase, draw.decimal(0.01, 2))
    high = phase + Fraction(1, 10 ** draw.randint(4, 14)) * draw.choice((0, 1))
    return flight(draw.family, oscillator, (phase, high), 20, before=(epsilon, gamma))


def _chatter(draw: Draw, _: Arithmetic) -> Case:
    """Many where the table pushes: flights about as short as the impacts are weak."""
    oscillator = draw.system()
    epsilon = draw.decimal(0.01, 0.99, 2)
    phase = draw.phase()
    gamma = _velocity(oscillator, phase, draw.tiny(2, 30))
    return flight(draw.family, oscillator, (phase, phase), 20, before=(epsilon, gamma))


def _velocity(oscillator: Numbers, phase: Fraction, speed: Fraction) -> Fraction:
    """Return the velocity gamma of a mass that meets the table with about this speed."""
    eta, nu = oscillator
    with mpmath.workdps(60):
        cosine = mpmath.nstr(mpmath.cos(mpmath.mpf(phase.numerator) / phase.denominator), 55)
    side = 1 if nu > 0 else -1
    return (side * speed - nu * Fraction(cosine)) / eta


def _intervals(draw: Draw, _: Arithmetic) -> Case:
    oscillator = draw.system()
    low = Fraction(math.ldexp(round(draw.uniform(0.3, 6) * 2**50), -50))
    width = Fraction(1, 2**50)
    if draw.random() < 0.8:
        width = min(draw.tiny(1, 15), _CIRCLE - low)
    elif draw.random() < 0.1:
        low, width = Fraction(0), _CIRCLE
    return flight(draw.family, oscillator, (low, low + width), 12, 100)


class Family(NamedTuple):
    """share: how many of 100 cases belong to it."""

    name: str
    share: int
    about: str
    draw: Callable[[Draw, Arithmetic], Case]


FAMILIES = [
    Family("operations", 20, "+ - * / next to cancellation, 0, overflow, underflow", operation),
    Family("functions", 25, "elementary functions at hard arguments, 24 to 333 bits", function),
    Family("arrays", 25, "the same in binary64 arrays", function),
    Family("short flights", 2, "launches 1e-2 to 1e-40 before sticking begins", _short),
    Family("separation", 2, "launches 1e-2 to 1e-60 from the separation phase", _separation),
    Family("grazing", 3, "launches 1e-3 to 1e-30 from a grazing one", _grazing),
    Family("tangent", 2, "intervals of launches next to grazing ones: f' is large", _tangent),
    Family("long flights", 1, "flights of 10^3 to 10^6", _long),
    Family("soft spring", 3, "eta from 1e-2 to 1e-40", _soft),
    Family("resonance", 2, "eta next to 1, and 1", _at_phase(_resonant)),
    Family("rational", 2, "eta a ratio of digits: exact returns", _at_phase(_rational)),
    Family("small nu", 2, "|nu| from 0.1 to 1e-30", _at_phase(_small_nu, 1000)),
    Family("large nu", 2, "|nu| next to 1, and up to 1e21", _large_nu),
    Family("50 digits", 2, "parameters with 50 digits", _digits),
    Family("restitution", 2, "epsilon next to 0 and to 1", _restitution),
    Family("chatter", 2, "impacts of speed 1e-2 to 1e-30", _chatter),
    Family("intervals", 2, "launch phases from one ulp to the whole circle", _intervals),
]


def cases(families: Sequence[Family], count: int, seed: int, kernel: Arithmetic) -> Iterator[Case]:
    """Draw about `count` cases, by share, at least one of each family; the same for a seed."""
    total = sum(family.share for family in families)
    for family in families:
        draw = Draw(seed, family.name)
        for _ in range(max(1, round(count * family.share / total))):
            yield family.draw(draw, kernel)
