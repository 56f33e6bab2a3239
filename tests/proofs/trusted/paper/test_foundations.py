"""Section 2 and the appendix: the printed relations; what is said of motions without an end.

Expected values come from `reference` (the equations typed by hand), and from the motion of the mass
by complex exponentials.
"""

import json
import random
from dataclasses import replace
from fractions import Fraction

import pytest
from mpmath import mp, mpf

from proofs.search.s2_foundations import prove
from proofs.trusted.files import render
from proofs.trusted.kernel.solutions import Expressions
from proofs.trusted.kernel.trees import Variable, formula, is_name
from proofs.trusted.numbers import Phases
from proofs.trusted.paper import find
from proofs.trusted.paper import s2_foundations as eq
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
from proofs.trusted.paper.s2_foundations import unending
from proofs.trusted.paper.s5_soft import stability
from proofs.trusted.paper.s6_resonance.resonance import ROWS as RESONANCE
from proofs.trusted.paper.s34_circle.landing import NeverImpacts
from proofs.trusted.parameters import PAPER
from proofs.trusted.verdicts import Found, Verdict
from proofs.trusted.verify import Rejected, check
from tests.once import REPORTS
from tests.proofs.trusted.paper import reference


def value(text, **point):
    """Evaluate a formula without substitutions by Python itself."""
    return eval(text, {"sin": mp.sin, "cos": mp.cos, "pi": mp.pi}, point)


# -- the equations -----------------------------------------------------------------------------


def test_the_relations_as_typed_are_those_of_the_paper():
    rng = random.Random(1)
    for _ in range(20):
        eta, nu, epsilon, psi, gamma, delta = (mpf(rng.uniform(-2, 3)) for _ in range(6))
        given = {"eta": eta, "nu": nu, "epsilon": epsilon, "psi": psi, "gamma": gamma}
        given["psi1"] = psi + delta
        pairs = (
            (eq.S10, reference.left_side_10(eta, nu, psi, delta)),
            (eq.S14, reference.left_side_14(eta, nu, epsilon, psi, gamma, delta)),
            (eq.S15, reference.right_side_15(eta, nu, epsilon, psi, gamma, delta)),
        )
        for text, other in pairs:
            assert abs(value(text, **given) - other) < mpf(10) ** -45


def test_the_dimensional_relations_follow_the_motion():
    """The mass is at Re(c exp(i omega_n t)); its launch is found from the rule of restitution."""
    rng = random.Random(2)
    for _ in range(20):
        p, beta, omega, omega_n, epsilon, v, start, tau = (
            mpf(rng.uniform(0.1, 2)) for _ in range(8)
        )

        def table(t, p=p, beta=beta, omega=omega):
            return -p + beta * mp.sin(omega * t)

        moved = mp.diff(table, start)
        after = moved - epsilon * (v - moved)
        c = table(start) - 1j * after / omega_n
        now = c * mp.expj(omega_n * tau)
        given = {"p": p, "beta": beta, "omega": omega, "omega_n": omega_n, "epsilon": epsilon}
        given |= {"v": v, "tau": tau, "a": omega * start, "b": omega * (start + tau)}
        assert abs(value(eq.S8, **given) - (now.real - table(start + tau))) < mpf(10) ** -30
        assert abs(value(eq.S9, **given) - (1j * omega_n * now).real) < mpf(10) ** -30


# -- the whole ---------------------------------------------------------------------------------


def test_only_what_is_asked_for_is_proved():
    evidence = prove(PAPER, ["M4"], digits=10)
    assert list(evidence.proofs) == ["M4"] and len(evidence.steps) == 5


def test_phases_without_an_end_are_named_at_the_parameters_given():
    document = json.loads((REPORTS / "foundations.json").read_text())
    (entry,) = (one for one in document["claims"] if one["id"] == "A1")
    assert "[1.570570441202, 1.571022212388]" in entry["corrected"]
    document["parameters"]["nu"] = "-3/10"
    with pytest.raises(Rejected):
        check(render(document))


def test_the_sentence_about_irrational_frequencies_needs_its_lemma():
    lemma, of = unending.needs[0], replace(PAPER, nu=Fraction("-0.3"))
    never = NeverImpacts(of.place, Phases(Fraction("1.57"), Fraction("1.571")))
    told = [find("M6").decide(of, known).theorem for known in ([never, lemma], [never])]
    assert "every irrational eta > 0 there is no impact" in told[0]
    assert "For -1 < nu < 0 and" in told[0] and "irrational" not in told[1]


# -- rows that follow from formulas ----------------------------------------------------------------


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
