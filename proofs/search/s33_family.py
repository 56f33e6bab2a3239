"""Proof steps of the horseshoes for one interval of epsilon after the other, from 0 on."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from fractions import Fraction
from functools import partial

from proofs.motion.system import System
from proofs.search.s33_moving import Moving, first_guess, settled
from proofs.search.s33_steps import Box, ReboundProver
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.differential import Differential
from proofs.trusted.kernel.rates import Cone, rates
from proofs.trusted.kernel.rectangles import overlap
from proofs.trusted.numbers import Range
from proofs.trusted.parameters import Place

_FAR = Fraction("0.2")  # as far as epsilon is followed, or just beyond that of the statement
_STEP, _LEAST = Fraction("0.04"), Fraction("0.002")
_MARGIN = 0.015  # by which edges should overshoot
_GRID = 10**4  # rectangles are written to so many places
_WIDTH = Fraction(1)  # of the cones


def along_epsilon(prover: ReboundProver) -> tuple[list[str], str]:
    """Return horseshoes for intervals of epsilon, each from the end of the one before; and what
    ends them, where they do not reach as far as they should.
    """
    statement, system = prover.of, System(prover.of.eta, prover.of.nu)
    at = Place.restituting(statement.eta, statement.nu, Fraction(0))
    far = max(_FAR, (statement.epsilon or Fraction(0)) + _LEAST)
    left, right = ((float(low), float(high)) for low, high in (statement.left, statement.right))
    guess = first_guess(system, (left, right))
    guess = guess and settled(system, guess, _MARGIN)
    if guess is None:
        return [], "no rectangles are found for plastic impacts"
    names: list[str] = []
    reached, step, failure = Fraction(0), _STEP, ""
    while reached < far and step >= _LEAST:
        until = min(far, reached + step)
        with suppress(Unproved):
            now = settled(system, replace(guess, epsilon=(float(reached), float(until))), _MARGIN)
            if now is None:
                raise Unproved("no rectangles are found")
            names.append(proved(prover, replace(at, epsilon=(reached, until)), now))
            reached, guess = until, now if len(names) > 1 else now.split()
            continue
        step = Fraction(int(step * 4 / 5 * 1000), 1000)
        failure = f"no horseshoe is found beyond epsilon = {float(reached)}"
    return names, failure if reached < far else ""


def proved(prover: ReboundProver, at: Place, candidate: Moving) -> str:
    """Prove the horseshoe on candidate rectangles; or Unproved."""
    boxes: list[Box] = [
        (_rounded(phases), _rounded(velocities))
        for phases, velocities in zip(candidate.phases, candidate.velocities, strict=True)
    ]
    cone = Cone(Fraction(round(candidate.axis * 100), 100), _WIDTH)
    arrows = [candidate.following(k) for k in range(len(boxes))]
    with prover.attempt():
        names = []
        for k, box in enumerate(boxes):
            cuts = [Fraction(round(cut * _GRID), _GRID) for cut in candidate.cuts(k)]
            fits = partial(_fits, boxes=boxes, following=arrows[k], cone=cone)
            names.append(prover.cut_rectangle(at, box, cuts, fits))
        return prover.across(names, arrows, cone)


def _rounded(values: tuple[float, float]) -> Range:
    low, high = (Fraction(round(value * _GRID), _GRID) for value in values)
    return low, high


def _fits(part: Differential, boxes: list[Box], following: tuple[int, int], cone: Cone) -> bool:
    """Whether what F does on a part of a rectangle is as the rule `horseshoe` asks."""
    for k, (phases, (low, high)) in enumerate(boxes):
        phase, velocity = part.values
        if not overlap((phase,), (phases,)):
            continue
        if k in following and not low < velocity[0] <= velocity[1] < high:
            return False
        if k not in following and overlap((velocity,), ((low, high),)):
            return False
    with suppress(Unproved):
        return rates([part], cone).expansion > 1
    return False
