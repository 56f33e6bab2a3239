"""The families of hard cases: each is a function that draws one, with its share and its aim."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from random import Random

from proofs.stress import functions, operations
from proofs.stress.cases import Case
from proofs.stress.grazing import graze, separation_point
from proofs.stress.kernels import Kernel
from proofs.stress.motions import CoverCase, ImageCase, ReboundCase

ETA, NU = Fraction("0.2121"), Fraction("-0.2")
System = tuple[Fraction, Fraction]  # eta, nu
_CIRCLE = Fraction(62831, 10000)


class Draw(Random):
    """Random numbers for the cases of one family; the same for a seed."""

    def __init__(self, seed: int, family: str) -> None:
        super().__init__(f"{seed} {family}")
        self.family = family

    def decimal(self, low: float, high: float, places: int = 6) -> Fraction:
        """Return a decimal between two numbers."""
        return Fraction(self.randint(int(low * 10**places), int(high * 10**places)), 10**places)

    def tiny(self, first: int, last: int) -> Fraction:
        """Return a number of the size 10^-first to 10^-last."""
        return self.decimal(1, 9.999, 3) / Fraction(10) ** self.randint(first, last)

    def sign(self) -> int:
        """Return -1 or 1."""
        return self.choice((-1, 1))

    def phase(self) -> Fraction:
        """Return a phase."""
        return self.decimal(0, 6.28)

    def system(self) -> System:
        """Return the paper's parameters, or others with a sticking arc."""
        while True:
            if self.random() < 0.3:
                return ETA, NU
            eta = self.decimal(0.05, 2.5, 4)
            nu = self.sign() * self.decimal(0.05, 3, 4)
            if eta != 1 and abs(eta**2 / (nu * (1 - eta**2))) < Fraction(9, 10):
                return eta, nu

    def point(
        self, eta: Fraction, nu: Fraction, phase: Fraction, digits: int, horizon: int
    ) -> ImageCase:
        """Return the launch at a phase."""
        far = Fraction(horizon)
        return ImageCase(self.family, eta, nu, phase, phase, digits=digits, horizon=far)

    def around(self, of: System, phase: Fraction, room: Fraction) -> ImageCase:
        """Return the launch at a phase, or half of the time an interval within `room` above it."""
        width = room / 10 ** self.randint(1, 12) if self.random() < 0.5 else Fraction(0)
        return ImageCase(self.family, *of, phase, phase + width)


@dataclass(frozen=True)
class Family:
    """share: how many of 100 cases belong to it."""

    name: str
    share: int
    about: str
    draw: Callable[[Draw, Kernel], Case]


FAMILIES: list[Family] = []


def _family(
    name: str, share: int, about: str
) -> Callable[[Callable[[Draw, Kernel], Case]], Callable[[Draw, Kernel], Case]]:
    """Enter what draws a case into the table of families."""

    def enter(draw: Callable[[Draw, Kernel], Case]) -> Callable[[Draw, Kernel], Case]:
        FAMILIES.append(Family(name, share, about, draw))
        return draw

    return enter


def cases(families: Sequence[Family], count: int, seed: int, kernel: Kernel) -> Iterator[Case]:
    """Draw about `count` cases, by share, at least one of each family; the same for a seed."""
    whole = sum(family.share for family in families)
    for family in families:
        draw = Draw(seed, family.name)
        for _ in range(max(1, round(count * family.share / whole))):
            yield family.draw(draw, kernel)


@_family("operations", 20, "+ - * / next to cancellation, 0, overflow, underflow")
def _operations(draw: Draw, kernel: Kernel) -> Case:
    return operations.draw(draw)


@_family("functions", 25, "elementary functions at hard arguments, 24 to 333 bits")
def _functions(draw: Draw, kernel: Kernel) -> Case:
    return functions.draw(draw, kernel, draw.family)


_family("arrays", 25, "the same in binary64 arrays")(_functions)


@_family("short flights", 2, "launches 1e-2 to 1e-40 before sticking begins")
def _short(draw: Draw, kernel: Kernel) -> Case:
    """The flight lasts 3 times the distance."""
    of = draw.system()
    distance = draw.tiny(2, 40)
    phase = separation_point(kernel, *of, beginning=True) - distance
    return draw.around(of, phase, distance / 2)


@_family("separation", 2, "launches 1e-2 to 1e-60 from the separation phase")
def _separation(draw: Draw, kernel: Kernel) -> Case:
    """Launches at both sides of the phase where the gap has a triple zero."""
    of = draw.system()
    distance = draw.tiny(2, 60) * draw.sign()
    case = draw.around(of, separation_point(kernel, *of) + distance, abs(distance) / 2)
    return replace(case, digits=draw.choice((10, 20, 30)))


@_family("grazing", 3, "launches 1e-3 to 1e-30 from a grazing one")
def _grazing(draw: Draw, kernel: Kernel) -> Case:
    """At both sides of it: an impact of speed 0, or none until much later."""
    eta, nu, phase = graze(draw.randrange(100))
    phase += draw.tiny(3, 30) * draw.sign()
    return ImageCase(draw.family, eta, nu, phase, phase)


@_family("tangent", 2, "intervals of launches next to grazing ones: f' is large")
def _tangent(draw: Draw, kernel: Kernel) -> Case:
    eta, nu, phase = graze(draw.randrange(100))
    distance = draw.tiny(2, 14) * draw.sign()
    return draw.around((eta, nu), phase + distance, abs(distance) / 2)


@_family("long flights", 1, "flights of 10^3 to 10^6")
def _long(draw: Draw, kernel: Kernel) -> Case:
    """A soft spring, or the paper's launches next to pi/2."""
    if draw.random() < 0.25:
        phase = Fraction(math.pi / 2) + draw.tiny(3, 4) * draw.sign()
        return draw.point(ETA, NU, phase, 15, 3000)
    eta, nu = draw.tiny(3, 5), -draw.decimal(0.1, 0.9, 4)
    return draw.point(eta, nu, draw.decimal(0.1, 1.5), 15, 10**6)


@_family("soft spring", 3, "eta from 1e-2 to 1e-40")
def _soft(draw: Draw, kernel: Kernel) -> Case:
    """The table catches up with a mass that hardly feels its spring."""
    of = draw.tiny(2, 40), draw.decimal(0.01, 3, 4) * draw.sign()
    return draw.around(of, draw.decimal(1.6, 3.1), Fraction(1, 1000))


@_family("resonance", 2, "eta next to 1, and 1")
def _resonance(draw: Draw, kernel: Kernel) -> Case:
    eta = 1 + draw.tiny(1, 40) * draw.choice((-1, 0, 1, -1, 1))
    nu = -draw.decimal(0.05, 3, 4)
    return draw.point(eta, nu, draw.phase(), 20, 200)


@_family("rational", 2, "eta a ratio of digits: exact returns")
def _rational(draw: Draw, kernel: Kernel) -> Case:
    """All returns to the launch after as many turns of the table as the denominator says."""
    eta = Fraction(draw.randint(1, 9), draw.randint(1, 9))
    nu = draw.decimal(0.05, 2, 4) * draw.sign()
    return draw.point(eta, nu, draw.phase(), 20, 200)


@_family("small nu", 2, "|nu| from 0.1 to 1e-30")
def _small_nu(draw: Draw, kernel: Kernel) -> Case:
    """Eta is small with it, or not."""
    nu = draw.tiny(1, 30) * draw.sign()
    eta = draw.decimal(0.1, 2, 3)
    if draw.random() < 0.5:
        eta = Fraction(math.sqrt(abs(nu))) * draw.decimal(0.1, 0.9, 3)
    return draw.point(eta, nu, draw.phase(), 20, 1000)


@_family("large nu", 2, "|nu| next to 1, and up to 1e21")
def _large_nu(draw: Draw, kernel: Kernel) -> Case:
    nu = 1 + draw.tiny(1, 30) * draw.choice((-1, 0, 1))
    if draw.random() < 0.5:
        nu = draw.decimal(1, 9) * 10 ** draw.randint(0, 20)
    phase = draw.phase()
    nu *= draw.sign()
    return draw.point(draw.decimal(0.05, 2, 4), nu, phase, 20, 200)


@_family("50 digits", 2, "parameters with 50 digits")
def _digits(draw: Draw, kernel: Kernel) -> Case:
    eta, nu = (value + Fraction(draw.randrange(10**49), 10**53) for value in draw.system())
    return draw.around((eta, nu), draw.phase(), Fraction(1, 100))


@_family("restitution", 2, "epsilon next to 0 and to 1")
def _restitution(draw: Draw, kernel: Kernel) -> Case:
    """Also 0 and 1 themselves; launches of all kinds."""
    eta, nu = draw.system()
    near = draw.tiny(1, 30), 1 - draw.tiny(1, 30)
    epsilon = draw.choice((Fraction(0), Fraction(1), *near))
    phase = draw.phase()
    gamma = _velocity(eta, nu, phase, draw.decimal(0.01, 2))
    high = phase + Fraction(1, 10 ** draw.randint(4, 14)) * draw.choice((0, 1))
    return ReboundCase(draw.family, eta, nu, phase, high, epsilon, gamma, digits=20)


@_family("chatter", 2, "impacts of speed 1e-2 to 1e-30")
def _chatter(draw: Draw, kernel: Kernel) -> Case:
    """Many where the table pushes: flights about as short as the impacts are weak."""
    eta, nu = draw.system()
    epsilon = draw.decimal(0.01, 0.99, 2)
    phase = draw.phase()
    gamma = _velocity(eta, nu, phase, draw.tiny(2, 30))
    return ReboundCase(draw.family, eta, nu, phase, phase, epsilon, gamma, digits=20)


def _velocity(eta: Fraction, nu: Fraction, phase: Fraction, speed: Fraction) -> Fraction:
    """Return the velocity gamma of a mass that meets the table with about this speed."""
    import mpmath

    with mpmath.workdps(60):
        cosine = mpmath.nstr(mpmath.cos(mpmath.mpf(phase.numerator) / phase.denominator), 55)
    side = 1 if nu > 0 else -1
    return (side * speed - nu * Fraction(cosine)) / eta


@_family("intervals", 2, "launch phases from one ulp to the whole circle")
def _intervals(draw: Draw, kernel: Kernel) -> Case:
    of = draw.system()
    low = Fraction(math.ldexp(round(draw.uniform(0.3, 6) * 2**50), -50))
    width = Fraction(1, 2**50)
    if draw.random() < 0.8:
        width = min(draw.tiny(1, 15), _CIRCLE - low)
    elif draw.random() < 0.1:
        low, width = Fraction(0), _CIRCLE
    return ImageCase(draw.family, *of, low, low + width, digits=12, horizon=Fraction(100))


@_family("kernel", 1, "boxes in binary64, retried where it does not decide")
def _kernel(draw: Draw, kernel: Kernel) -> Case:
    """Boxes of all sizes, easy ones and next to grazing ones."""
    boxes = draw.choice((1, 4, 16, 64))
    if draw.random() < 0.5:
        eta, nu, phase = graze(draw.randrange(100))
        low = phase + draw.tiny(2, 9) * draw.sign()
        high = low + abs(low - phase) / draw.choice((3, 1000))
    else:
        eta, nu = draw.system()
        low = draw.phase()
        high = low + draw.tiny(2, 9)
    return CoverCase(draw.family, eta, nu, low, high, boxes)
