"""Rows that follow from formulas: decided once all that their theorems need is proved."""

from fractions import Fraction

import pytest

from proofs.trusted.kernel.solutions import Expressions
from proofs.trusted.kernel.trees import Variable, formula, is_name
from proofs.trusted.paper.formulas import (
    Equal,
    Passage,
    Unknowns,
    Value,
    at,
    corollary,
    derived_row,
    differ,
    unknowns,
)
from proofs.trusted.paper.s5_soft import stability
from proofs.trusted.paper.s6_resonance.resonance import ROWS as RESONANCE
from proofs.trusted.parameters import PAPER
from proofs.trusted.verdicts import Found, Verdict


class TestDecisions:
    ASKED = (at("x - 1", 1, x="2"), differ("x", "2*x", x="3"))
    LEMMA = corollary("It begins.", Equal.read("x", "x"))
    THEOREM = corollary("It is in {0}. So {1} is not.", LEMMA, values=ASKED, reports=("first",))
    ROW = derived_row(Passage("S1", "1", "words"), "It is so.", Verdict.REFUTED, THEOREM)

    def found(self, **changes):
        one = {"function": "x - 1", "x": "2", "bounds": ("1/2", "3/2")} | changes
        box = ((Variable("x"), (Fraction(one["x"]),) * 2),)
        bounds = tuple(map(Fraction, one["bounds"]))
        three = ((Variable("x"), (Fraction(3),) * 2),)
        other = Value(formula("(x) - (2*x)"), three, (Fraction(-3), Fraction(-3)))
        return [Equal.read("x", "x"), Value(formula(one["function"]), box, bounds), other]

    def test_decides_by_the_tightest_bounds(self):
        wide = self.found(bounds=("1/3", "2"))
        decided = self.ROW.decide(PAPER, [*wide, *self.found()])
        assert decided.verdict is Verdict.REFUTED
        assert decided.why == "It is in [0.5, 1.5]"
        assert decided.witness == "It is in [0.5, 1.5]. So -3 is not."
        assert decided.quantities == {"first": (Fraction(1, 2), Fraction(3, 2))}

    @pytest.mark.parametrize(
        "changes",
        [
            {"function": "x - 2"},
            {"x": "5/2"},
            {"bounds": ("0", "3/2")},
            {"bounds": ("-3/2", "-1")},
        ],
    )
    def test_another_value_decides_nothing(self, changes):
        decided = self.ROW.decide(PAPER, self.found(**changes))
        assert decided.verdict is Verdict.UNDECIDED and decided.witness is decided.theorem is None

    def test_every_part_is_needed_of_what_is_nearby_too(self):
        beside = derived_row(
            Passage("S1", "1", "words"), "", Verdict.VERIFIED, self.LEMMA, corrected=(self.THEOREM,)
        )
        assert beside.needs == self.ROW.needs == (Equal.read("x", "x"), *self.ASKED)
        assert beside.decide(PAPER, self.found()).theorem.startswith("It is in")
        for index in range(3):
            found = self.found()
            del found[index]
            assert self.ROW.decide(PAPER, found).verdict is Verdict.UNDECIDED
            assert beside.decide(PAPER, found).verdict is Verdict.UNDECIDED


class TestUnknowns:
    ASKED = unknowns("a", "x", Equal.read("a - 2*x", "0"), given="2*x")
    THEOREM = corollary("The root is {a}, in {0}.", ASKED, values=(at("x", x="1"),))
    ONE = Value(
        formula("x"), ((Variable("x"), (Fraction(1), Fraction(1))),), (Fraction(1), Fraction(1))
    )

    def proved(self, text, *more):
        solved = Expressions((("a", formula(text)),), self.ASKED.lemmas)
        return self.THEOREM.prove(Found(PAPER, [solved, *more]))

    def test_a_theorem_says_what_is_solved_for(self):
        assert self.proved("2*x", self.ONE).sentence == "The root is 2*x, in 1."

    def test_nothing_follows_without_it_or_with_other_variables(self):
        assert self.THEOREM.prove(Found(PAPER, [self.ONE])) is None
        assert self.proved("2*y", self.ONE) is None
        assert self.proved("-2*-x", self.ONE) is None
        assert self.proved("2*x") is None


@pytest.mark.parametrize("row", [*stability.ROWS, *RESONANCE], ids=lambda row: row.id)
def test_no_two_unknowns_of_a_theorem_have_one_name(row):
    asked = [need for need in row.needs if isinstance(need, Unknowns)]
    for each in asked:
        assert len(set(each.names)) == len(each.names)
        assert not {"h", *each.names} & each.variables
        assert all(map(is_name, each.names))
