"""G19: dimensions of the full shifts near the horseshoe, and how fast orbits leave them."""

from dataclasses import replace
from fractions import Fraction
from functools import cache

import pytest

from proofs.search import s32_dimension as dimension
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.numbers import Phases, within
from proofs.trusted.paper import find
from proofs.trusted.paper.s32_sets.repeller import Repeller
from proofs.trusted.paper.s34_circle.thin import ThinShift
from proofs.trusted.parameters import PAPER
from proofs.trusted.verdicts import Verdict
from tests.proofs.trusted.paper.steps import evidence

DIGITS = 8
pytestmark = pytest.mark.slow  # proofs of both sets
# independent numerics: the determinant of periodic orbits, and collocation in floating point
DIMENSIONS = {2: Fraction("0.39532516076918945"), 3: Fraction("0.6752674894042916")}


def conclusions():
    return [found for _, found in evidence("dimension").proofs["G19"]]


def decide(found, of=PAPER):
    return find("G19").decide(of, found)


@cache
def shifts():
    return {len(each.shift.cells): each for each in decide(conclusions()).because}


def test_both_are_verified():
    decision = decide(conclusions())
    assert decision.verdict is Verdict.VERIFIED and set(shifts()) == {2, 3}
    for symbols, value in DIMENSIONS.items():
        low, high = decision.quantities[f"dimension_{symbols}_symbols"]
        assert low - Fraction(1, 10**15) < value < high + Fraction(1, 10**15)
        assert high - low < Fraction(1, 10**DIGITS)


def test_one_sentence_says_all_of_it():
    sentence = shifts()[3].sentence
    assert shifts()[3].shift.sentence in sentence
    for part in ("0.675267489", "0.5915470", "escape at a rate between 0.525014"):
        assert part in sentence


def test_one_growth_is_not_enough():
    for exponent_is_one in (True, False):
        found = [
            each
            for each in conclusions()
            if not isinstance(each, Repeller) or (each.exponent == 1) is exponent_is_one
        ]
        made = decide(found)
        wide = made.quantities.get("dimension_2_symbols", (0, 1))
        assert made.verdict is Verdict.UNDECIDED or wide[1] - wide[0] > Fraction(1, 10)


WIDE = Phases(Fraction("1.3"), Fraction("1.49"))
FALSE = {
    "another hull": ("repeller", {"hull": WIDE}),
    "another hull of lengths": ("escape", {"hull": WIDE}),
    "other words": ("repeller", {"words": ("0", "11")}),
    "words in another order": ("escape", {"words": ("1", "0")}),
    "another exponent": ("escape", {"exponent": Fraction("0.99")}),
    "a growth of 1": ("escape", {"growth": (Fraction("0.9"), Fraction(1))}),
    "a dimension of 1": ("repeller", {"dimension": (Fraction("0.9"), Fraction(1))}),
    "other cells": (
        "shift",
        {
            "cells": (
                Phases(Fraction("1.31"), Fraction("1.32")),
                Phases(*map(Fraction, ("1.45", "1.49"))),
            )
        },
    ),
    "another interval": ("shift", {"region": (WIDE,)}),
}


@pytest.mark.parametrize("name", FALSE)
def test_what_the_theorem_needs(name):
    field, change = FALSE[name]
    true = shifts()[2]
    with pytest.raises(Unproved):
        replace(true, **{field: replace(getattr(true, field), **change)})
    with pytest.raises(Unproved):
        replace(true, **{field: getattr(shifts()[3], field)})


def test_the_domains_lie_in_the_cells():
    for each in shifts().values():
        assert all(map(within, each.repeller.domains, each.shift.cells))
    true = shifts()[2]
    domains = Phases(Fraction("1.3"), Fraction("1.34")), true.repeller.domains[1]
    with pytest.raises(Unproved, match="cell"):
        ThinShift(true.shift, replace(true.repeller, domains=domains), true.escape)


def test_elsewhere_there_may_be_none():
    of = replace(PAPER, nu=Fraction("-0.05"))
    made = dimension.prove(of, ["G19"], digits=5)
    assert decide([each for _, each in made.proofs["G19"]], of).verdict is Verdict.UNDECIDED
