"""The families of hard cases: what each one aims at, and how its cases are drawn."""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from proofs.stress import functions, operations
from proofs.stress.cases import Case
from proofs.stress.grazing import graze, separation_point
from proofs.stress.kernels import Kernel
from proofs.stress.motions import CoverCase, ImageCase, ReboundCase

ETA, NU = Fraction("0.2121"), Fraction("-0.2")
Generator = random.Random
Draw = Callable[[Generator, Kernel], Case]
_CIRCLE = Fraction(62831, 10000)


@dataclass(frozen=True)
class Family:
    """share: how many of 100 cases belong to it."""

    name: str
    about: str
    share: float
    draw: Draw


def decimal(generator: Generator, low: float, high: float, places: int = 6) -> Fraction:
    """Return a random decimal between two numbers."""
    return Fraction(generator.randint(int(low * 10**places), int(high * 10**places)), 10**places)


def tiny(generator: Generator, first: int, last: int) -> Fraction:
    """Return a random number of the size 10^-first to 10^-last."""
    return decimal(generator, 1, 9.999, 3) / Fraction(10) ** generator.randint(first, last)


def system(generator: Generator) -> tuple[Fraction, Fraction]:
    """Return (eta, nu): the paper's, or others with a sticking arc."""
    while True:
        if generator.random() < 0.3:
            return ETA, NU
        eta = decimal(generator, 0.05, 2.5, 4)
        nu = generator.choice((-1, 1)) * decimal(generator, 0.05, 3, 4)
        if eta != 1 and abs(eta**2 / (nu * (1 - eta**2))) < Fraction(9, 10):
            return eta, nu


def _phase(generator: Generator) -> Fraction:
    return decimal(generator, 0, 6.28)


def _around(
    generator: Generator,
    family: str,
    of: tuple[Fraction, Fraction],
    phase: Fraction,
    room: Fraction,
) -> ImageCase:
    """Return the point, or half of the time an interval within `room` above it."""
    width = room / 10 ** generator.randint(1, 12) if generator.random() < 0.5 else Fraction(0)
    return ImageCase(family, *of, phase, phase + width)


def _short(generator: Generator, kernel: Kernel) -> Case:
    """Launches just before sticking begins: the flight lasts 3 times the distance."""
    of = system(generator)
    distance = tiny(generator, 2, 40)
    point = separation_point(kernel, *of, beginning=True) - distance
    return _around(generator, "short flights", of, point, distance / 2)


def _separation(generator: Generator, kernel: Kernel) -> Case:
    """Launches at both sides of the phase where the gap has a triple zero."""
    of = system(generator)
    distance = tiny(generator, 2, 60) * generator.choice((-1, 1))
    point = separation_point(kernel, *of) + distance
    case = _around(generator, "separation", of, point, abs(distance) / 2)
    return replace(case, digits=generator.choice((10, 20, 30)))


def _grazing(generator: Generator, kernel: Kernel) -> Case:
    """Launches at both sides of a grazing one: an impact of speed 0, or none until much later."""
    eta, nu, phase = graze(generator.randrange(100))
    distance = tiny(generator, 3, 30) * generator.choice((-1, 1))
    return ImageCase("grazing", eta, nu, phase + distance, phase + distance)


def _tangent(generator: Generator, kernel: Kernel) -> Case:
    """Intervals of launches next to a grazing one: f' is large, and its formula cancels."""
    eta, nu, phase = graze(generator.randrange(100))
    distance = tiny(generator, 2, 14) * generator.choice((-1, 1))
    return _around(generator, "tangent", (eta, nu), phase + distance, abs(distance) / 2)


def _long(generator: Generator, kernel: Kernel) -> Case:
    """Flights of 10^3 to 10^6: a soft spring, or the paper's launches next to pi/2."""
    horizon = Fraction(10**6)
    if generator.random() < 0.25:
        phase = Fraction(math.pi / 2) + tiny(generator, 3, 4) * generator.choice((-1, 1))
        return ImageCase("long flights", ETA, NU, phase, phase, 15, Fraction(3000))
    eta, nu = tiny(generator, 3, 5), -decimal(generator, 0.1, 0.9, 4)
    phase = decimal(generator, 0.1, 1.5)
    return ImageCase("long flights", eta, nu, phase, phase, 15, horizon)


def _soft(generator: Generator, kernel: Kernel) -> Case:
    """eta -> 0: the table catches up with a mass that hardly feels its spring."""
    eta, nu = tiny(generator, 2, 40), decimal(generator, 0.01, 3, 4) * generator.choice((-1, 1))
    phase = decimal(generator, 1.6, 3.1)
    return _around(generator, "soft spring", (eta, nu), phase, Fraction(1, 1000))


def _resonance(generator: Generator, kernel: Kernel) -> Case:
    """eta next to 1, and 1."""
    eta = 1 + tiny(generator, 1, 40) * generator.choice((-1, 0, 1, -1, 1))
    nu = -decimal(generator, 0.05, 3, 4)
    point = _phase(generator)
    return ImageCase("resonance", eta, nu, point, point, 20, Fraction(200))


def _rational(generator: Generator, kernel: Kernel) -> Case:
    """eta = p/q: all returns to the launch after q turns of the table."""
    eta = Fraction(generator.randint(1, 9), generator.randint(1, 9))
    nu = decimal(generator, 0.05, 2, 4) * generator.choice((-1, 1))
    point = _phase(generator)
    return ImageCase("rational", eta, nu, point, point, 20, Fraction(200))


def _small_nu(generator: Generator, kernel: Kernel) -> Case:
    """nu -> 0, eta with it or not."""
    nu = tiny(generator, 1, 30) * generator.choice((-1, 1))
    eta = decimal(generator, 0.1, 2, 3)
    if generator.random() < 0.5:
        eta = Fraction(math.sqrt(abs(nu))) * decimal(generator, 0.1, 0.9, 3)
    point = _phase(generator)
    return ImageCase("small nu", eta, nu, point, point, 20, Fraction(1000))


def _large_nu(generator: Generator, kernel: Kernel) -> Case:
    """|nu| next to 1 and far above it."""
    nu = 1 + tiny(generator, 1, 30) * generator.choice((-1, 0, 1))
    if generator.random() < 0.5:
        nu = decimal(generator, 1, 9) * 10 ** generator.randint(0, 20)
    point = _phase(generator)
    sign = generator.choice((-1, 1))
    eta = decimal(generator, 0.05, 2, 4)
    return ImageCase("large nu", eta, sign * nu, point, point, 20, Fraction(200))


def _digits(generator: Generator, kernel: Kernel) -> Case:
    """Parameters with 50 digits."""
    eta, nu = (value + Fraction(generator.randrange(10**49), 10**53) for value in system(generator))
    return _around(generator, "50 digits", (eta, nu), _phase(generator), Fraction(1, 100))


def _restitution(generator: Generator, kernel: Kernel) -> Case:
    """epsilon next to 0 and to 1, and both; launches of all kinds."""
    eta, nu = system(generator)
    epsilon = generator.choice(
        (Fraction(0), Fraction(1), tiny(generator, 1, 30), 1 - tiny(generator, 1, 30))
    )
    point = _phase(generator)
    gamma = _velocity(eta, nu, point, decimal(generator, 0.01, 2))
    width = Fraction(1, 10 ** generator.randint(4, 14)) * generator.choice((0, 1))
    return ReboundCase("restitution", eta, nu, point, point + width, epsilon, gamma, 20)


def _chatter(generator: Generator, kernel: Kernel) -> Case:
    """Weak impacts, many where the table pushes: flights about as short as they are weak."""
    eta, nu = system(generator)
    epsilon = decimal(generator, 0.01, 0.99, 2)
    point = _phase(generator)
    gamma = _velocity(eta, nu, point, tiny(generator, 2, 30))
    return ReboundCase("chatter", eta, nu, point, point, epsilon, gamma, 20)


def _velocity(eta: Fraction, nu: Fraction, phase: Fraction, speed: Fraction) -> Fraction:
    """Return the velocity gamma of a mass that meets the table with about this speed."""
    side = 1 if nu > 0 else -1
    return (side * speed - nu * _cosine(phase)) / eta


def _cosine(x: Fraction) -> Fraction:
    import mpmath

    with mpmath.workdps(60):
        return Fraction(mpmath.nstr(mpmath.cos(mpmath.mpf(x.numerator) / x.denominator), 55))


def _intervals(generator: Generator, kernel: Kernel) -> Case:
    """Launch phases from one ulp of binary64 to the whole circle."""
    of = system(generator)
    low = Fraction(math.ldexp(round(generator.uniform(0.3, 6) * 2**50), -50))
    width = Fraction(1, 2**50)
    if generator.random() < 0.8:
        width = min(tiny(generator, 1, 15), _CIRCLE - low)
    elif generator.random() < 0.1:
        low, width = Fraction(0), _CIRCLE
    return ImageCase("intervals", *of, low, low + width, 12, Fraction(100))


def _kernel(generator: Generator, kernel: Kernel) -> Case:
    """The binary64 kernel on boxes of all sizes, easy ones and next to grazing ones."""
    boxes = generator.choice((1, 4, 16, 64))
    if generator.random() < 0.5:
        eta, nu, phase = graze(generator.randrange(100))
        low = phase + tiny(generator, 2, 9) * generator.choice((-1, 1))
        high = low + abs(low - phase) / generator.choice((3, 1000))
    else:
        eta, nu = system(generator)
        low = _phase(generator)
        high = low + tiny(generator, 2, 9)
    return CoverCase("kernel", eta, nu, low, high, boxes)


def _functions(generator: Generator, kernel: Kernel) -> Case:
    return functions.draw(generator, kernel, "functions")


def _arrays(generator: Generator, kernel: Kernel) -> Case:
    return functions.draw(generator, kernel, "arrays")


FAMILIES = (
    Family(
        "operations", "+ - * / next to cancellation, 0, overflow, underflow", 20, operations.draw
    ),
    Family("functions", "elementary functions at hard arguments, 24 to 333 bits", 25, _functions),
    Family("arrays", "the same in binary64 arrays", 25, _arrays),
    Family("short flights", "launches 1e-2 to 1e-40 before sticking begins", 2, _short),
    Family("separation", "launches 1e-2 to 1e-60 from the separation phase", 2, _separation),
    Family("grazing", "launches 1e-3 to 1e-30 from a grazing one", 3, _grazing),
    Family("tangent", "intervals of launches next to grazing ones: f' is large", 2, _tangent),
    Family("long flights", "flights of 10^3 to 10^6", 1, _long),
    Family("soft spring", "eta from 1e-2 to 1e-40", 3, _soft),
    Family("resonance", "eta next to 1, and 1", 2, _resonance),
    Family("rational", "eta a ratio of digits: exact returns", 2, _rational),
    Family("small nu", "|nu| from 0.1 to 1e-30", 2, _small_nu),
    Family("large nu", "|nu| next to 1, and up to 1e21", 2, _large_nu),
    Family("50 digits", "parameters with 50 digits", 2, _digits),
    Family("restitution", "epsilon next to 0 and to 1", 2, _restitution),
    Family("chatter", "impacts of speed 1e-2 to 1e-30", 2, _chatter),
    Family("intervals", "launch phases from one ulp to the whole circle", 2, _intervals),
    Family("kernel", "boxes in binary64, retried where it does not decide", 1, _kernel),
)


def cases(families: Sequence[Family], count: int, seed: int, kernel: Kernel) -> Iterator[Case]:
    """Draw about `count` cases, by share, at least one of each family; the same for a seed."""
    whole = sum(family.share for family in families)
    for family in families:
        generator = random.Random(f"{seed} {family.name}")
        for _ in range(max(1, round(count * family.share / whole))):
            yield family.draw(generator, kernel)
