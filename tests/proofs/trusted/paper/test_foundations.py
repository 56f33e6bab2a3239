"""Section 2 and the appendix: the printed relations, Method I, the certificate.

Expected values come from `reference` (the equations typed by hand), from the motion of the mass by
complex exponentials, and from covers tried one by one.
"""

import copy
import json
import math
import random
from fractions import Fraction
from itertools import combinations

import pytest
from mpmath import mp, mpf

from proofs.methods import derive
from proofs.search.s2_foundations import prove
from proofs.shell.groups import settle
from proofs.trusted.certificate import Malformed, Reader, render
from proofs.trusted.paper import GROUPS, find
from proofs.trusted.paper.s2_foundations import displayed as eq
from proofs.trusted.paper.s2_foundations.relations import DERIVATIONS
from proofs.trusted.paper.s7_appendix.appendix import MethodOne
from proofs.trusted.paper.s7_appendix.rules import RULES
from proofs.trusted.paper.s34_circle.landing import NeverImpacts
from proofs.trusted.parameters import PAPER
from proofs.trusted.verdicts import Verdict
from proofs.trusted.verify import Rejected, check
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
    "M9": "REFUTED",
    "A1": "REFUTED",
    "A2": "CONDITIONAL",
}


@pytest.fixture(scope="module")
def document():
    return settle("foundations", PAPER, digits=20, tell=lambda stage: None)[1]


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
    false = [each for each in changed if not derive.equal(each["left"], each["right"])]
    assert false
    for each in false:
        with pytest.raises(ArithmeticError):
            RULES["formula-equal"](PAPER, {}, Reader(each))


# -- A2 ----------------------------------------------------------------------------------------


def method_one(points, sets, values):
    witness = {
        "points": str(points),
        "sets": [[str(point) for point in each] for each in sets],
        "values": [str(each) for each in values],
    }
    return RULES["method-one"](PAPER, {}, Reader(witness))


def test_infima_over_covers_against_all_families_of_sets():
    rng = random.Random(7)
    for _ in range(20):
        points = rng.randint(2, 4)
        masks = [0, *rng.sample(range(1, 2**points), rng.randint(3, min(6, 2**points - 1)))]
        values = [Fraction(0), *(Fraction(rng.randint(0, 12), 4) for _ in masks[1:])]
        sets = [[i for i in range(points) if mask >> i & 1] for mask in masks]
        found = method_one(points, sets, values)
        families = [
            each for n in range(len(masks) + 1) for each in combinations(range(len(masks)), n)
        ]
        for wanted in range(2**points):
            sums = [math.inf]
            for family in families:
                union = 0
                for i in family:
                    union |= masks[i]
                if wanted & ~union == 0:
                    sums.append(sum((values[i] for i in family), Fraction(0)))
            assert found.outer[wanted] == min(sums)


def test_a_negative_value_leaves_no_outer_measure():
    assert method_one(1, [[], [0]], [0, -1]).outer == (-math.inf, -math.inf)
    assert method_one(2, [[], [0]], [0, -1]).outer == (-math.inf, -math.inf, math.inf, math.inf)
    assert method_one(1, [[], [0]], [0, 1]).outer == (0, 1)


@pytest.mark.parametrize(
    ("points", "sets", "values"),
    [
        (1, [[0]], [1]),
        (1, [[], [0]], [1, -1]),
        (1, [[], [1]], [0, 1]),
        (2, [[], [1, 0]], [0, 1]),
        (2, [[], [0, 0]], [0, 1]),
        (2, [[], [0], [0]], [0, 1, 2]),
        (1, [[], [0]], [0]),
        (0, [[]], [0]),
        (7, [[]], [0]),
        ("1/2", [[]], [0]),
        (1, [[], ["1/2"]], [0, 1]),
    ],
)
def test_what_is_no_premeasure_on_a_finite_set(points, sets, values):
    with pytest.raises(Malformed):
        method_one(points, sets, values)


def test_only_the_counterexample_decides_the_definitions():
    decide = find("A2").decide
    given = method_one(1, [[], [0]], [0, -1])
    assert decide(PAPER, [given]).verdict is Verdict.CONDITIONAL
    others = [
        method_one(1, [[], [0]], [0, 1]),
        method_one(2, [[], [0]], [0, -1]),
        MethodOne(given.points, given.sets, given.values, (Fraction(0), Fraction(1))),
    ]
    assert decide(PAPER, others).verdict is Verdict.UNDECIDED


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
            assert decided.witness is decided.corrected is None


def test_values_with_the_wrong_sign_are_refused(document):
    steps = [one["witness"] for one in document["steps"].values() if one["rule"] == "formula-value"]
    assert len(steps) == 11
    for witness in steps:
        low, high = map(Fraction, witness["bounds"])
        with pytest.raises(ArithmeticError):
            RULES["formula-value"](PAPER, {}, Reader(witness | {"bounds": [str(-high), str(-low)]}))


def test_another_claim_s_proof_is_refused(document):
    changed = copy.deepcopy(document)
    changed["claims"][7]["proof"] = document["claims"][6]["proof"]  # M9 by what proves M8
    rejected(changed)


def test_only_what_is_asked_for_is_proved():
    evidence = prove(PAPER, ["M4"], digits=10)
    assert list(evidence.proofs) == ["M4"] and len(evidence.steps) == 3


def test_phases_without_an_end_are_named_at_the_parameters_given(document):
    (entry,) = (one for one in document["claims"] if one["id"] == "A1")
    assert "(0.2121, -0.2)" in entry["witness"] and "20000 pi" in entry["corrected"]
    changed = json.loads(render(document))
    changed["parameters"]["nu"] = "-3/10"
    rejected(changed)


def test_every_derivation_is_a_claim():
    assert {each.id for each in DERIVATIONS} == set(CLAIMS) - {"A2"}
