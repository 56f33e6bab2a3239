"""Section 3.4 with restitution: where the stable motion ends, claim G15.

Bounces after the flight from phi_s, one by one, in high precision, at single epsilons.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import NamedTuple

from intervals import DomainError, Interval, Undecided
from proofs.motion.chatter import Pushing
from proofs.motion.system import System
from proofs.search.evidence import FAILED, Proof
from proofs.search.steps import Prover
from proofs.trusted.certificate import texts
from proofs.trusted.equations import Launch, clock, gap, launch
from proofs.trusted.numbers import Range
from proofs.trusted.paper.s34_circle.border import BouncesEnd
from proofs.trusted.paper.s34_circle.landing import Separation
from proofs.trusted.paper.s34_circle.persistence import SuperstableMotion

_PRECISION = 256
_GRID = 2**200  # times are multiples of 1 / _GRID
_LEAST = Fraction(1, 2**190)  # half the width of a bracket
_OPENINGS = 40
_MOST = 60  # bounces
_UNITS = 10**6


class Bounces(NamedTuple):
    """Brackets of bounces, and (ratio, rest) if the mass comes to rest after them."""

    times: list[Range]
    rest: tuple[Fraction, ...]


def border(prover: Prover, motion: tuple[str, SuperstableMotion]) -> Proof:
    """Prove that the motion rests at one epsilon and passes at another, the closest that are found.

    From those on at which it is known to rest; epsilons are multiples of 1 / _UNITS.
    """
    name, found = motion
    separation = prover.steps[name]["witness"]["separation"]
    ends: dict[int, Bounces] = {}
    low, high = int(found.largest * _UNITS), _UNITS
    while high - low > 1:
        middle = (low + high) // 2
        try:
            ends[middle] = followed(prover.system, found.arc, Fraction(middle, _UNITS))
        except (*FAILED, DomainError):
            break
        low, high = (middle, high) if ends[middle].rest else (low, middle)
    proof: Proof = []
    for end, (times, rest) in ((end, ends[end]) for end in (low, high) if end in ends):
        epsilon = Fraction(end, _UNITS)
        witness = {
            "separation": separation,
            "epsilon": str(epsilon),
            "bounces": [texts(each) for each in times],
            "rest": texts(rest),
        }
        conclusion = BouncesEnd(found.arc, epsilon, len(times), bool(rest))
        proof.append((prover.add("bounces-end", witness), conclusion))
    return proof


def followed(system: System, arc: Separation, epsilon: Fraction) -> Bounces:
    """Follow the bounces at one epsilon until they end; or Undecided."""
    pushing, bounces = Pushing(system, arc.phase[0]), list[Range]()
    eta, nu = _interval(system.eta), _interval(system.nu)
    phase, speed = (_interval(*ends) for ends in (arc.arrival, arc.speed))
    left = _interval(*arc.phase)
    for _ in range(_MOST):
        kick = speed * epsilon
        start = launch(system.side, eta, nu, phase)._replace(kick=kick * system.side)
        ending = pushing.ending(epsilon, (phase.inf, phase.sup), kick.sup)
        if ending is not None:
            return Bounces(bounces, ending)
        if gap(start, clock(start.eta, left - phase)).certainly_positive():
            return Bounces(bounces, ())
        time = _bracket(start, Fraction(pushing.candidate(float(phase.mid), float(kick.mid))))
        fall = -gap(start, clock(start.eta, _interval(*time)), 1)
        bounces.append(time)
        phase, speed = phase + _interval(*time), fall
    raise Undecided(f"{_MOST} bounces and no end")


def _interval(low: Fraction, high: Fraction | None = None) -> Interval:
    return Interval(low, low if high is None else high, precision=_PRECISION)


def _bracket(start: Launch, about: Fraction) -> Range:
    """Bracket the impact of all flights, by Newton's method and the signs of the gap."""
    for _ in range(5):
        now = clock(start.eta, _interval(about))
        about -= (gap(start, now) / gap(start, now, 1)).mid
        about = Fraction(round(about * _GRID), _GRID)
    for half in _openings():
        low, high = about - half, about + half
        above, below = (gap(start, clock(start.eta, _interval(end))) for end in (low, high))
        if low > 0 and above.certainly_positive() and below.certainly_negative():
            return low, high
    raise Undecided("the end of a bounce is not bracketed")


def _openings() -> Iterator[Fraction]:
    return (_LEAST * 16**k for k in range(_OPENINGS))
