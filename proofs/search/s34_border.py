"""Section 3.4 with restitution: where the stable motion ends, claim G15.

Bounces after the flight from phi_s, one by one, in high precision, at single epsilons.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from fractions import Fraction
from typing import Any

from intervals import DomainError, Interval, Undecided
from proofs.motion.chatter import BITS, Pushing, around
from proofs.motion.system import System
from proofs.search.evidence import FAILED, Proof
from proofs.search.steps import Prover
from proofs.trusted.certificate import texts
from proofs.trusted.equations import Launch, clock, gap, launch
from proofs.trusted.numbers import Range
from proofs.trusted.paper.s34_circle.landing import Separation
from proofs.trusted.paper.s34_circle.persistence import (
    Box,
    Cell,
    SuperstableMotion,
    on_arc,
    speeds_before,
)

_GRID = 2**200  # times are multiples of 1 / _GRID
_LEAST = Fraction(1, 2**190)  # half the width of a bracket
_OPENINGS = 40
_MOST = 60  # bounces
_UNITS = 10**6
_PARTS = Fraction(1, 2), Fraction(1, 4), Fraction(3, 4)  # of an interval of epsilon, tried in turn


def witness(
    separation: str, box: Box, cells: Sequence[Cell], impacts: Sequence[str] = ()
) -> dict[str, Any]:
    """Write what the rule superstable-motion reads."""
    return {
        "separation": separation,
        "box": [texts(side) for side in box],
        "impacts": list(impacts),
        "cells": [
            {
                "epsilon": texts(cell.epsilons),
                "bounces": [texts(bounce) for bounce in cell.bounces],
                "ratio": str(cell.ratio),
                "rest": str(cell.rest),
            }
            for cell in cells
        ],
    }


def border(prover: Prover, motion: tuple[str, SuperstableMotion]) -> Proof:
    """Prove that the motion rests at one epsilon and passes at another, the closest that are found.

    From those on at which it is known to rest; epsilons are multiples of 1 / _UNITS.
    """
    name, found = motion
    separation, arc = prover.steps[name]["witness"]["separation"], found.arc
    box = around(arc, 2 * max(high - low for low, high in (arc.arrival, arc.speed)))
    rests, passes = None, None
    low, high = int(found.largest * _UNITS), _UNITS
    while high - low > 1:
        for part in _PARTS:  # where floating point does not see the way, it may see it beside
            middle = low + max(1, int((high - low) * part))
            with suppress(*FAILED, DomainError):
                end = followed(prover.system, arc, box, Fraction(middle, _UNITS))
                break
        else:
            break
        if isinstance(end, Cell):
            low, rests = middle, end
        else:
            high, passes = middle, end
    proof: Proof = []
    if rests is not None:
        proof.append(prover.derive("superstable-motion", witness(separation, box, [rests])))
    if passes is not None:
        made = {
            "separation": separation,
            "epsilon": str(Fraction(high, _UNITS)),
            "bounces": [texts(each) for each in passes],
        }
        proof.append(prover.derive("passes-separation", made))
    return proof


def followed(system: System, arc: Separation, box: Box, epsilon: Fraction) -> Cell | list[Range]:
    """Follow bounces at one epsilon until they end: how they rest, or those before the mass passes
    phi_s; or Undecided.
    """
    pushing, bounces = Pushing(system, arc.phase[0]), list[Range]()
    eta, nu = _interval(system.eta), _interval(system.nu)
    phases = on_arc(arc, box[0], BITS)
    phase, speed = _interval(*phases), _interval(*speeds_before(arc.at, phases, box[1], BITS))
    left = _interval(*arc.phase)
    for _ in range(_MOST):
        kick = speed * epsilon
        start = launch(system.side, eta, nu, phase)._replace(kick=kick * system.side)
        ending = pushing.ending(epsilon, (phase.inf, phase.sup), kick.sup)
        if ending is not None:
            return Cell((epsilon, epsilon), bounces, *ending)
        if gap(start, clock(start.eta, left - phase)).certainly_positive():
            return bounces
        time = _bracket(start, Fraction(pushing.candidate(float(phase.mid), float(kick.mid))))
        fall = -gap(start, clock(start.eta, _interval(*time)), 1)
        bounces.append(time)
        phase, speed = phase + _interval(*time), fall
    raise Undecided(f"{_MOST} bounces and no end")


def _interval(low: Fraction, high: Fraction | None = None) -> Interval:
    return Interval(low, low if high is None else high, precision=BITS)


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
