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
from proofs.trusted.numbers import Phases
from proofs.trusted.paper import find
from proofs.trusted.paper import s2_foundations as eq
from proofs.trusted.paper.s2_foundations import unending
from proofs.trusted.paper.s34_circle.landing import NeverImpacts
from proofs.trusted.parameters import PAPER
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
