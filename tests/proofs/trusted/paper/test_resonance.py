"""Section 6: its lemmas against sympy and 50 digits of the printed (14), (15), and misprints."""

import copy
import json

import pytest
from mpmath import mp, mpf

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.trees import formula
from proofs.trusted.kernel.values import equal as rule_equal
from proofs.trusted.paper.formulas import Equal
from proofs.trusted.paper.s6_resonance import displayed as eq
from proofs.trusted.paper.s6_resonance.resonance import ROWS
from proofs.trusted.parameters import PAPER
from proofs.trusted.verify import _check_claim
from tests.once import REPORTS, report
from tests.oracles.algebra import agrees
from tests.proofs.trusted.paper import reference
from tests.proofs.trusted.renewing import REFUSED, rederived

DOCUMENT = json.loads((REPORTS / "resonance.json").read_text())


def equal(left, right):
    return rule_equal(Context(PAPER), Reader({"left": str(left), "right": str(right)}))


@pytest.mark.slow
def test_sympy_proves_every_lemma():
    assert all(agrees(x) for row in ROWS for x in row.needs if isinstance(x, Equal))


# -- misprints -------------------------------------------------------------------------------------


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
    (name,) = (
        name
        for name, each in DOCUMENT["steps"].items()
        if "f11" in each["witness"].get("expressions", ())
    )
    (entry,) = (each for each in DOCUMENT["claims"] if each["id"] == "R3")
    steps = copy.deepcopy(DOCUMENT["steps"])
    given = steps[name]["witness"]["expressions"]

    def judged():
        again = rederived(report("resonance").context, steps, name)
        return _check_claim(again, Reader(entry), set())

    for unknown, text in zip(given, (*eq.PRINTED_JACOBIAN[:3], "2*epsilon"), strict=True):
        kept = given[unknown]
        given[unknown] = text
        with pytest.raises(REFUSED):
            judged()
        given[unknown] = kept
    assert judged().verdict.value == "REFUTED"


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
    (entry,) = (each for each in DOCUMENT["claims"] if each["id"] == "R11")
    assert mp.nstr(difference, 12)[:8] in entry["witness"]


def test_the_printed_two_impact_points_leave_30():
    nu, phi = mpf(-5) / 3, mp.asin(mpf(3) / 5)
    for epsilon in (mpf(0), mpf("0.3"), mpf("0.9")):
        for first, second in eq.VECTORS:
            gammas = [value(text, epsilon=epsilon) * nu * mp.cos(phi) for text in (first, second)]
            left = reference.left_side_14(1, nu, epsilon, phi, gammas[0], mp.pi - 2 * phi)
            assert abs(abs(left) - abs(gammas[1] * mp.sin(2 * phi))) < 1e-40
            assert abs(left) > 0.05
