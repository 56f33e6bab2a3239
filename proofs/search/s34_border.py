"""Section 3.4 with restitution: where the stable motion ends, claim G15.

Bounces after the flight from phi_s, one by one, in high precision, at single epsilons.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from fractions import Fraction
from typing import Any

from proofs.motion.chatter import BITS, Pushing, around
from proofs.search.evidence import FAILED, Proof
from proofs.search.steps import Prover
from proofs.trusted.certificate import texts
from proofs.trusted.numbers import bits_for
from proofs.trusted.paper.s34_circle.bounces import Box, landed
from proofs.trusted.paper.s34_circle.persistence import Cell, SuperstableMotion

_SPARE = 20  # bits of enclosures beyond those of brackets
_UNITS = 10**6


def witness(
    separation: str, box: Box, cells: Sequence[Cell], impacts: Sequence[str] = ()
) -> dict[str, Any]:
    """Write what the rule superstable-motion reads."""
    return {
        "separation": separation,
        "box": [texts(side) for side in box],
        "impacts": list(impacts),
        "cells": [
            {"epsilon": texts(each.epsilons), "bounces": [texts(time) for time in each.bounces]}
            for each in cells
        ],
    }


def border(prover: Prover, motion: tuple[str, SuperstableMotion]) -> Proof:
    """Prove that the motion rests at one epsilon and passes at another, the closest that are found.

    From those on at which it is known to rest; epsilons are multiples of 1 / _UNITS.
    """
    name, resting = motion
    separation, arc = prover.steps[name]["witness"]["separation"], resting.arc
    box = around(arc, 2 * max(high - low for low, high in (arc.arrival, arc.speed)))
    bits, states = bits_for(box[0]), landed(arc, box, BITS)
    pushing = Pushing(arc.at, arc.phase[0], bits, 2 ** (bits - _SPARE))
    ends = dict[bool, Cell]()  # by whether the mass passes
    low, high = int(resting.largest * _UNITS), _UNITS
    while high - low > 1:
        middle = (low + high) // 2
        try:
            epsilon = Fraction(middle, _UNITS)
            end, rest = pushing.settle((epsilon, epsilon), *states, arc.phase)
        except FAILED:
            break
        ends[rest is None] = end
        low, high = (low, middle) if rest is None else (middle, high)
    proof: Proof = []
    for _, end in sorted(ends.items()):
        with suppress(*FAILED):
            proof.append(prover.derive("superstable-motion", witness(separation, box, [end])))
    return proof
