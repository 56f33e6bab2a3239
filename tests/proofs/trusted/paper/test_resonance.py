"""Section 6: the verdicts, their lemmas against 50 digits of the printed (14), (15), bent ones."""

import copy
import json
import random
from fractions import Fraction as F

import pytest
from mpmath import mp, mpf

from proofs.search.s6_resonance import prove
from proofs.shell import groups
from proofs.trusted.certificate import Malformed, Reader
from proofs.trusted.files import render
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.solutions import Expressions
from proofs.trusted.kernel.trees import formula
from proofs.trusted.kernel.values import equal as rule_equal
from proofs.trusted.paper import GROUPS
from proofs.trusted.paper.formulas import Asked, Equal, Unknowns, Value
from proofs.trusted.paper.s6_resonance import displayed as eq
from proofs.trusted.paper.s6_resonance.resonance import ROWS
from proofs.trusted.parameters import PAPER
from proofs.trusted.verify import Rejected, check
from tests.oracles.algebra import agrees
from tests.proofs.trusted.paper import reference

VERDICTS = {
    "VERIFIED": "R10 R12",
    "REFUTED": "R3 R4 R7 R8 R9 R11 R13",
    "CONDITIONAL": "R1 R2 R5 R6",
    "SIMULATED": "E1",
}
CLAIMS = GROUPS["resonance"]
LEMMAS = tuple(dict.fromkeys(need for row in ROWS for need in row.needs if isinstance(need, Equal)))
WRITTEN_OUT = tuple(lemma for lemma in LEMMAS if not lemma.right.bound)


def certificate(*claims):
    made = groups.produce({"resonance": claims or CLAIMS}, PAPER, digits=20)
    return json.loads(made.certificate)


def equal(left, right):
    return rule_equal(Context(PAPER), Reader({"left": str(left), "right": str(right)}))


@pytest.mark.slow
def test_every_claim_and_its_verdict():
    document = certificate()
    assert (*(f"R{n}" for n in range(1, 14)), "E1") == CLAIMS
    found = {claim.id: claim.verdict.value for claim in check(render(document)).claims}
    assert found == {name: word for word, names in VERDICTS.items() for name in names.split()}
    for entry in document["claims"]:
        assert entry["corrected"] or entry["verdict"] == "VERIFIED"
        assert entry["witness"] or entry["verdict"] not in ("REFUTED", "CONDITIONAL")
    assert len(render(document)) < 100_000


@pytest.mark.slow
def test_sympy_proves_every_lemma():
    assert all(agrees(x) for row in ROWS for x in row.needs if isinstance(x, Equal))
    evidence = prove(PAPER, CLAIMS, digits=20)
    for row in ROWS:
        assert len(evidence.proofs[row.id]) == len(row.needs), row.id


# -- bent certificates -----------------------------------------------------------------------------


def solved(wanted):
    return Expressions(wanted.given, wanted.lemmas)


@pytest.mark.slow
def test_every_lemma_is_needed():
    for row in ROWS:
        whole = [need for need in row.needs if isinstance(need, Equal)]
        whole += [Value(x.function, x.box, (F(1), F(2))) for x in row.needs if isinstance(x, Asked)]
        whole += [solved(x) for x in row.needs if isinstance(x, Unknowns)]
        assert row.decide(PAPER, whole).verdict.value != "UNDECIDED"
        for index in range(len(whole)):
            found = row.decide(PAPER, whole[:index] + whole[index + 1 :])
            assert found.verdict.value == "UNDECIDED", row.id


def _bent(text, chance):
    """Return a formula with a sign, a digit, a function or a variable changed."""
    swaps = [(" + ", " - "), (" - ", " + "), ("sin(", "cos("), ("cos(", "sin("), ("2", "3")]
    swaps += [("epsilon", "nu"), ("gamma", "phi"), ("alpha", "theta"), ("t)", "2*t)")]
    old, new = chance.choice([(old, new) for old, new in swaps if old in text] or [(text, "7")])
    place = chance.choice([i for i in range(len(text)) if text.startswith(old, i)])
    return text[:place] + new + text[place + len(old) :]


def _agree_at_random(left, right, chance):
    """Whether two formulas agree at a random point: in Python's own notation, at 50 digits."""
    values = {
        name: mpf(chance.randrange(1, 10**6)) / 10**6
        for name in ("phi", "phi1", "gamma", "nu", "epsilon", "theta", "alpha", *"dthwabxyuv")
    }
    known = {"sin": mp.sin, "cos": mp.cos, "pi": mp.pi}
    left, right = (eval(side, known, values) for side in (left, right))
    return abs(left - right) < mpf(10) ** -30


@pytest.mark.slow
def test_bent_lemmas_are_refused():
    chance, refused = random.Random(6), 0
    for lemma in WRITTEN_OUT:
        for _ in range(4):
            right = _bent(str(lemma.right), chance)
            try:
                equal(lemma.left, right)
            except (Unproved, Malformed):
                refused += 1
            else:  # then it must be another way to write the same
                assert _agree_at_random(str(lemma.right), right, chance), right
    assert refused > 3 * len(WRITTEN_OUT) > 100


@pytest.mark.slow
def test_bent_steps_are_rejected():
    given, chance = certificate("R11", "R12", "R8"), random.Random(7)
    for name in given["steps"]:
        changed = copy.deepcopy(given)
        witness = changed["steps"][name]["witness"]
        witness = witness.get("expressions", witness)
        texts = [field for field, text in witness.items() if isinstance(text, str)]
        side = chance.choice(sorted(texts))
        witness[side] = _bent(witness[side], chance)
        with pytest.raises((Rejected, Malformed)):
            check(render(changed))


def test_a_false_value_is_rejected():
    given = certificate("R11")
    (step,) = (one for one in given["steps"].values() if one["rule"] == "formula-value")
    step["witness"]["bounds"] = ["-1", "-1/2"]
    with pytest.raises(Rejected):
        check(render(given))


def fixed_jacobian():
    return tuple(str(value) for _, value in eq.AT_REST.given)


def _printed(text):
    return str(formula(text))


def test_misprints_are_no_lemmas():
    fixed = tuple(f"({entry})" for entry in fixed_jacobian())
    for printed, derived in (
        (eq.A21, eq.TRUE_A21),
        *zip(eq.PRINTED_JACOBIAN[:3], fixed[:3], strict=True),
        (eq.trace(fixed), "1 - 2*epsilon*nu*sin(phi)"),
        (eq.determinant(fixed), "0"),
        (eq.STICKING, eq.CLOSING),
        *(
            (str(each.left).replace(*map(_printed, (eq.TRUE_A21, eq.A21))), "0")
            for each in eq.ENTRIES[2:3]
        ),
    ):
        with pytest.raises(Unproved):
            equal(printed, derived)
    assert all(equal(each.left, "0") == each for each in eq.ENTRIES)


@pytest.mark.slow
def test_only_the_true_jacobian_at_rest_is_taken():
    """Another matrix there solves nothing, whatever its form."""
    document = certificate("R3")
    (step,) = (
        each
        for each in document["steps"].values()
        if "f11" in each["witness"].get("expressions", ())
    )
    given = step["witness"]["expressions"]
    for name, text in zip(given, (*eq.PRINTED_JACOBIAN[:3], "2*epsilon"), strict=True):
        kept = given[name]
        given[name] = text
        with pytest.raises(Rejected):
            check(render(document))
        given[name] = kept
    check(render(document))


# -- the formulas against the printed (14), (15), typed elsewhere ----------------------------------


def value(text, **places):
    """Evaluate a formula without D or at, at 50 digits."""
    return eval(text, {"sin": mp.sin, "cos": mp.cos, "pi": mp.pi}, places)


def follow(nu, epsilon, phi, gamma):
    """The next state, by a scan of (14) for its first sign change, then (15)."""
    side = mp.sign(nu)

    def gap(t):
        return side * reference.left_side_14(1, nu, epsilon, phi, gamma, t)

    time = step = mpf("0.05")
    assert gap(time) > 0
    while gap(time + step) > 0:
        time += step
        assert time < 7
    low, high = time, time + step
    for _ in range(150):
        middle = (low + high) / 2
        low, high = (middle, high) if gap(middle) > 0 else (low, middle)
    return phi + low, reference.right_side_15(1, nu, epsilon, phi, gamma, low)


STATES = [("-0.2", "0.5", "1", "-1.3"), ("0.7", "0.9", "4", "2"), ("-5/3", "1", "2.5", "-2")]


@pytest.mark.parametrize("state", STATES)
def test_the_entries_are_derivatives_of_the_map(state):
    nu, epsilon, phi, gamma = (mp.mpmathify(text) for text in state)
    phi1, gamma1 = follow(nu, epsilon, phi, gamma)
    here = {"nu": nu, "epsilon": epsilon, "phi": phi, "gamma": gamma, "phi1": phi1, "d": phi1 - phi}
    assert abs(value(eq.S14, **here)) < 1e-40
    assert abs(value(eq.S15, **here) - gamma1) < 1e-40
    entries = [value(text, **here) for text in eq.JACOBIAN]
    h = mpf(10) ** -15
    for column, (one, two) in enumerate(
        (
            (follow(nu, epsilon, phi + h, gamma), follow(nu, epsilon, phi - h, gamma)),
            (follow(nu, epsilon, phi, gamma + h), follow(nu, epsilon, phi, gamma - h)),
        )
    ):
        for row in (0, 1):
            difference = (one[row] - two[row]) / (2 * h)
            assert abs(difference - entries[2 * row + column]) < 1e-25
    assert abs(value(eq.A21, **here) - entries[2]) > 0.1  # as printed
    assert abs(entries[0] * entries[3] - entries[1] * entries[2] - epsilon) < 1e-40


def test_the_jacobian_near_grazing_is_not_the_printed_one():
    nu, epsilon, phi, c = mpf("-0.2"), mpf("0.5"), mpf(4), mpf(-10) ** -9
    here = {"nu": nu, "epsilon": epsilon, "phi": phi, "gamma": c - nu * mp.cos(phi)}
    here["phi1"] = phi + 2 * mp.atan(epsilon * c)
    entries = [value(text, **here) for text in eq.JACOBIAN]
    for entry, fixed in zip(entries, fixed_jacobian(), strict=True):
        assert abs(entry - value(fixed, **here)) < 1e-8
    gaps = [
        abs(entry - value(printed, **here))
        for entry, printed in zip(entries, eq.PRINTED_JACOBIAN, strict=True)
    ]
    assert min(gaps) > 0.05


def test_the_witness_against_a21():
    nu, epsilon, phi = mpf(-1) / 5, mpf(1) / 2, mpf(1)
    gamma = mp.cos(1) / 5 - 2 * mp.tan(mpf(1) / 4)
    phi1, _ = follow(nu, epsilon, phi, gamma)
    assert abs(phi1 - (phi - mpf(1) / 2 + 2 * mp.pi)) < 1e-40
    here = {"nu": nu, "epsilon": epsilon, "phi": phi, "gamma": gamma, "phi1": phi1}
    difference = value(eq.A21, **here) - value(eq.TRUE_A21, **here)
    assert mp.nstr(difference, 12)[:8] in certificate("R11")["claims"][0]["witness"]


def test_the_witness_against_the_test_for_sticking():
    nu, epsilon, gamma = mpf(-5) / 2, mpf(1) / 2, mpf(5) / 6
    phi = mp.asin(mpf(4) / 5)
    phi1, gamma1 = follow(nu, epsilon, phi, gamma)
    assert abs(phi1 - (phi + 2 * mp.pi - 2 * mp.atan(mpf(1) / 3))) < 1e-40
    assert abs(gamma1 + nu * mp.cos(phi) - mpf(17) / 30) < 1e-40


def test_the_printed_two_impact_points_leave_30():
    nu, phi = mpf(-5) / 3, mp.asin(mpf(3) / 5)
    for epsilon in (mpf(0), mpf("0.3"), mpf("0.9")):
        for first, second in eq.VECTORS:
            gammas = [value(text, epsilon=epsilon) * nu * mp.cos(phi) for text in (first, second)]
            left = reference.left_side_14(1, nu, epsilon, phi, gammas[0], mp.pi - 2 * phi)
            assert abs(abs(left) - abs(gammas[1] * mp.sin(2 * phi))) < 1e-40
            assert abs(left) > 0.05


@pytest.mark.parametrize("nu", ["-2", "0.3"])
def test_states_of_period_two_do_not_turn_up(nu):
    chance, nu, epsilon = random.Random(2), mpf(nu), mpf("0.8")
    for _ in range(4):
        phi = mpf(chance.uniform(0, 6))
        c = mp.sign(nu) * mpf(chance.uniform(0.5, 3))
        state = (phi, c - nu * mp.cos(phi))
        for n in range(1, 4):
            state = follow(nu, epsilon, *state)
            closing = state[1] + nu * mp.cos(state[0])
            assert abs(closing - epsilon**n * c) < 1e-35
