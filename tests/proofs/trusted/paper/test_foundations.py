"""Section 2 and the appendix: the printed relations, Method I, the certificate.

Expected values come from `reference` (the equations typed by hand), from the motion of the mass by
complex exponentials, and from covers tried one by one.
"""

import copy
import json
import random
from fractions import Fraction

import pytest
from mpmath import mp, mpf

from proofs.search.s2_foundations import prove
from proofs.shell.groups import produce
from proofs.trusted.certificate import Malformed, Reader
from proofs.trusted.files import render
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.values import equal
from proofs.trusted.kernel.values import value as bounds_of
from proofs.trusted.paper import GROUPS, find
from proofs.trusted.paper import s2_foundations as eq
from proofs.trusted.paper.s34_circle.landing import NeverImpacts
from proofs.trusted.parameters import PAPER
from proofs.trusted.verdicts import Verdict
from proofs.trusted.verify import Rejected, check
from tests.oracles import algebra
from tests.proofs.trusted.paper import reference

CLAIMS = GROUPS["foundations"]
VERDICTS = {
    "M1": "VERIFIED",
    "M2": "VERIFIED",
    "M3": "VERIFIED",
    "M4": "VERIFIED",
    "M5": "REFUTED",
    "M7": "REFUTED",
    "M8": "CONDITIONAL",
    "M9": "CONDITIONAL",
    "A1": "REFUTED",
    "A2": "CONDITIONAL",
}


@pytest.fixture(scope="module")
def document():
    return json.loads(produce({"foundations": CLAIMS}, PAPER, digits=20).certificate)


def value(text, **point):
    """Evaluate a formula without substitutions by Python itself."""
    return eval(text, {"sin": mp.sin, "cos": mp.cos, "pi": mp.pi}, point)


def rejected(changed):
    with pytest.raises((Rejected, Malformed)):
        check(render(changed))


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


MISPRINTS = [
    ("M1", "v0/omega_n*sin", "v0*omega_n*sin"),
    ("M1", "- omega_n*x0*sin", "+ omega_n*x0*sin"),
    ("M2", "-epsilon*v + (1 + epsilon)", "-epsilon*v + (1 - epsilon)"),
    ("M3", "epsilon*gamma + nu/eta*(1 + epsilon)", "-epsilon*gamma + nu/eta*(1 + epsilon)"),
    ("M3", "(omega_n*p - beta*omega_n*sin(a))", "(omega_n*p + beta*omega_n*sin(a))"),
    ("M4", "nu/eta*cos(psi)*sin", "nu*eta*cos(psi)*sin"),
    ("M5", "(1 - 3*nu*sin(psi))*cos(t/4)**2", "(1 - 2*nu*sin(psi))*cos(t/4)**2"),
    ("M7", "(nu*(1 - eta**2)*s - eta**2)", "(nu*(1 + eta**2)*s - eta**2)"),
    ("M8", "-nu/eta**2*s", "nu/eta**2*s"),
    ("M8", "eta**2/(nu*(1 - eta**2))", "eta**2/(nu*(1 + eta**2))"),
    ("M9", "56169/(943831*nu)", "56168/(943831*nu)"),
    ("A1", "-sin(psi)*(1 + sin(psi)/4)", "sin(psi)*(1 - sin(psi)/4)"),
]


@pytest.mark.slow
@pytest.mark.parametrize(("claim", "right", "wrong"), MISPRINTS)
def test_a_misprint_is_not_proved(document, claim, right, wrong):
    """Prover and checker refuse a step about formulas with one sign or factor changed."""
    (entry,) = (one for one in document["claims"] if one["id"] == claim)
    names = [name for name in entry["proof"] if name.startswith("equal")]
    witnesses = [document["steps"][name]["witness"] for name in names]
    changed = [
        each | {"right": each["right"].replace(right, wrong)}
        if right in each["right"]
        else each | {"left": each["left"].replace(right, wrong)}
        for each in witnesses
        if right in each["left"] + each["right"]
    ]
    false = [each for each in changed if not algebra.equal(each["left"], each["right"])]
    assert false
    for each in false:
        with pytest.raises(ArithmeticError):
            equal(Context(PAPER), Reader(each))


# -- the whole ---------------------------------------------------------------------------------


def test_verdicts_and_an_accepted_certificate(document):
    assert {entry["id"]: entry["verdict"] for entry in document["claims"]} == VERDICTS
    report = check(render(document))
    assert {each.id: each.verdict.value for each in report.claims} == VERDICTS


@pytest.mark.slow
def test_without_any_one_step_a_claim_is_open():
    evidence = prove(PAPER, CLAIMS, digits=10)
    for claim in CLAIMS:
        found = [conclusion for _, conclusion in evidence.proofs[claim]]
        decide = find(claim).decide
        assert decide(PAPER, found).verdict.value == VERDICTS[claim]
        for left_out in found:
            if isinstance(left_out, NeverImpacts):
                continue
            rest = [one for one in found if one is not left_out]
            decided = decide(PAPER, rest)
            assert decided.verdict is Verdict.UNDECIDED, (claim, left_out)
            assert decided.witness is decided.theorem is None


def test_values_with_the_wrong_sign_are_refused(document):
    steps = [one["witness"] for one in document["steps"].values() if one["rule"] == "formula-value"]
    assert len(steps) == 10
    for witness in steps:
        low, high = map(Fraction, witness["bounds"])
        with pytest.raises(ArithmeticError):
            bounds_of(Context(PAPER), Reader(witness | {"bounds": [str(-high), str(-low)]}))


def test_another_claim_s_proof_is_refused(document):
    changed = copy.deepcopy(document)
    changed["claims"][7]["proof"] = document["claims"][6]["proof"]  # M9 by what proves M8
    rejected(changed)


def test_only_what_is_asked_for_is_proved():
    evidence = prove(PAPER, ["M4"], digits=10)
    assert list(evidence.proofs) == ["M4"] and len(evidence.steps) == 5


def test_phases_without_an_end_are_named_at_the_parameters_given(document):
    (entry,) = (one for one in document["claims"] if one["id"] == "A1")
    assert "[1.570570441202, 1.571022212388]" in entry["corrected"]
    changed = json.loads(render(document))
    changed["parameters"]["nu"] = "-3/10"
    rejected(changed)
