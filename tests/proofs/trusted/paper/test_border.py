"""Claim G15: where the stable motion ends, by the printed equation; certificates forged."""

import random
from dataclasses import replace
from fractions import Fraction

import pytest

from proofs.trusted.certificate import Malformed
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.paper import find
from proofs.trusted.paper.s34_circle.border import Border
from proofs.trusted.paper.s34_circle.persistence import Cell, Passes, SuperstableMotion, passes
from proofs.trusted.parameters import PAPER
from tests.oracles.judge import oracle
from tests.proofs.trusted.paper.steps import apply, evidence, known_of

RESTS, PASSES = "superstable-motion-2", "superstable-motion-3"


def known():
    return known_of("persistence")


@pytest.mark.slow
def test_what_is_said():
    decision = find("G15").decide(PAPER, [x for _, x in evidence("persistence").proofs["G15"]])
    assert find("G15").own and decision.verdict.value == "VERIFIED"
    low, high = decision.quantities["epsilon_border"]
    assert low < Fraction("0.3611125") < high < low + Fraction(11, 10**7)
    assert "boundary point in [0.361112, 0.361113]" in decision.theorem
    assert known()[PASSES].arc.turns > 1  # in flight it passes phi_s first, more than once
    assert "before the first phi_s after it lands" in decision.theorem
    for found in (known()[RESTS], known()[PASSES]):
        assert oracle(found, random.Random(1)) == []


def test_a_border_needs_all_in_order():
    motion = known()["superstable-motion-1"]
    rests, passes = known()[RESTS], known()[PASSES]
    assert isinstance(passes, Passes) and isinstance(rests, SuperstableMotion)
    assert Border(motion, rests, passes)
    arc = replace(rests.arc, at=replace(rests.arc.at, nu=(Fraction(-1, 4),) * 2))
    for change in (
        (motion, motion, passes),
        (replace(motion, boxes=motion.boxes * 2), rests, passes),
        (motion, replace(rests, boxes=rests.boxes * 2), passes),
        (motion, replace(rests, epsilons=(Fraction("0.3"),) * 2), passes),
        (motion, replace(rests, epsilons=(Fraction("0.36"), rests.largest)), passes),
        (motion, replace(rests, epsilons=(passes.epsilon,) * 2), passes),
        (motion, rests, replace(passes, arc=arc)),
        (replace(motion, epsilons=(Fraction(0), Fraction("0.3612"))), rests, passes),
        (replace(motion, epsilons=(Fraction("0.01"), motion.largest)), rests, passes),
    ):
        with pytest.raises(Unproved):
            Border(*change)


def test_a_mass_that_passes_has_landed_on_the_arc():
    passes = known()[PASSES]
    for wrong in (
        replace(passes.arc, speed=(Fraction(0), passes.arc.speed[1])),
        replace(passes.arc, arrival=(passes.arc.start[0], passes.arc.arrival[1])),
    ):
        with pytest.raises(Unproved, match="followed by a bounce"):
            replace(passes, arc=wrong)
    for epsilon in (0, 1, -1):
        with pytest.raises(Unproved, match="followed by a bounce"):
            replace(passes, epsilon=Fraction(epsilon))


def thrown(**changes):
    """A witness that the mass flies beyond phi_s at once, edited, and what it begins with."""
    witness = evidence("persistence").steps[RESTS]["witness"]
    cell = {"epsilon": ["9/10", "9/10"], "bounces": []}
    return {**witness, "separation": "arc", "cells": [cell], **changes}


@pytest.mark.every
@pytest.mark.parametrize(
    ("change", "reason"),
    [
        (lambda arc: {"phase": arc.arrival}, "where the mass sticks"),
        (lambda arc: {"speed": (Fraction(1, 10**9), arc.speed[1])}, "in the first box"),
        (lambda arc: {"at": replace(arc.at, eta=(Fraction("0.2121"), Fraction(5)))}, "first box"),
    ],
)
def test_what_flies_beyond_phi_s_has_landed_on_the_arc(change, reason):
    """From a speed of 0.1352 at 4.64, with epsilon = 0.9, the first rebound goes beyond."""
    arc = known()["separation-1"]
    assert apply("superstable-motion", thrown(), {"arc": arc}).bounces == 0
    with pytest.raises(Unproved, match=reason):
        apply("superstable-motion", thrown(), {"arc": replace(arc, **change(arc))})


@pytest.mark.every
@pytest.mark.parametrize(
    ("epsilons", "reason"),
    [
        ([["2/5", "2/5"]], "in flight"),  # the third bounce passes
        ([["9/10", "10/11"]], "to end before"),
        ([["0", "0"]], "no coefficients"),
        ([["9/10", "9/10"], ["9/10", "91/100"]], "to end before"),
    ],
)
def test_all_that_has_landed_must_fly_beyond_phi_s(epsilons, reason):
    cells = [{"epsilon": each, "bounces": []} for each in epsilons]
    with pytest.raises((Unproved, Malformed), match=reason):
        apply("superstable-motion", thrown(cells=cells), {"arc": known()["separation-1"]})


def test_all_are_in_flight_at_phi_s():
    """Launched 1/2 before it as fast as the table moves at most; or ever more slowly, or later."""
    arc, cell, one = known()["separation-1"], Cell((Fraction("0.9"),) * 2, ()), Fraction(1)
    before = arc.phase[0] - Fraction(1, 2)
    assert passes(arc, ((before, before), (one, one)), cell, 64).bounces == 0
    for phases, slowest, reason in (
        ((before, before), one / 1000, "in flight"),
        ((before, arc.phase[1] + 1), one, "begins after"),
    ):
        with pytest.raises(Unproved, match=reason):
            passes(arc, (phases, (slowest, one)), cell, 64)
