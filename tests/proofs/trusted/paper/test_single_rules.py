"""The rules and the claims of section 4: nothing may be talked into.

Certificates are made by the prover; what is edited in them is refused. The identities are compared
with (10) and (18) typed by hand.
"""

import json
import random
from dataclasses import replace
from fractions import Fraction

import pytest
from mpmath import mp, mpf

from proofs.motion.single_orbits import solutions
from proofs.motion.system import System
from proofs.search import s4_single
from proofs.trusted.certificate import Malformed, Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.context import Context
from proofs.trusted.paper import find
from proofs.trusted.paper.s4_single import single
from proofs.trusted.paper.s4_single.orbits import Solution
from proofs.trusted.paper.s4_single.windows import EtaWindows, NuWindows
from proofs.trusted.parameters import PAPER, Place
from proofs.trusted.rules import find_rule
from proofs.trusted.verdicts import Verdict
from proofs.trusted.verify import Rejected
from tests.once import REPORTS
from tests.proofs.trusted.paper import reference
from tests.proofs.trusted.paper.steps import evidence
from tests.proofs.trusted.paper.test_single import slope_18

REFUSED = (Malformed, Rejected, Unproved)


@pytest.fixture(scope="module")
def document():
    return json.loads((REPORTS / "single.json").read_text())


def steps_of(document, rule):
    return [step["witness"] for step in document["steps"].values() if step["rule"] == rule]


def windows(document, shape):
    """The witness of the windows in eta for nu > 0, for nu < 0 (below), or in nu."""
    shapes = ("eta", "below", "nu")
    return steps_of(document, "single-windows")[shapes.index(shape)]


def derived(rule, witness, known=None):
    return find_rule(rule)(Context(PAPER, {}, known or {}), Reader(witness))


def refused(rule, witness, known=None):
    with pytest.raises(REFUSED):
        found = derived(rule, witness, known)
        pytest.fail(f"accepted: {found}")


# -- the equations -------------------------------------------------------------------------------


def value(formula, **point):
    """Evaluate a formula of the transcription with mpmath."""
    names = {"sin": mp.sin, "cos": mp.cos, "pi": mp.pi}
    return eval(formula, {"__builtins__": {}}, {**names, **point})


def test_the_transcription_agrees_with_the_one_typed_by_hand():
    rng = random.Random(1)
    for _ in range(20):
        eta, nu, phi = (mpf(rng.uniform(0.1, 2)) for _ in range(3))
        n = rng.randint(1, 5)
        delta = 2 * mp.pi * n
        point = {"eta": eta, "nu": nu, "phi": phi, "n": n}
        expected = reference.left_side_10(eta, nu, phi, delta)
        assert mp.almosteq(value(single.E16, **point), expected, 1e-40, 1e-40)
        found = value(single.E10, eta=eta, nu=nu, a=phi, b=phi + mpf("0.3"), delta=mpf("0.3"))
        assert mp.almosteq(found, reference.left_side_10(eta, nu, phi, mpf("0.3")), 1e-40, 1e-40)
        slope = value(single.TOP18, **point) / value(single.BOTTOM18, **point)
        assert mp.almosteq(slope, slope_18(eta, nu, n, phi), 1e-35, 1e-35)
        alpha, beta = eta * (1 - mp.cos(delta * eta)), mp.sin(delta * eta)
        assert mp.almosteq(value(single.ALPHA, **point), alpha)
        assert mp.almosteq(value(single.BETA, **point), beta)
        theta = mp.atan(beta / alpha)
        left = value(single.E17, phi=phi, theta=theta, nu=nu)
        assert mp.almosteq(-nu / eta * mp.hypot(alpha, beta) * left, expected, 1e-35, 1e-35)


@pytest.mark.parametrize("index", range(len(single.LEMMAS)))
def test_identities_are_proved_and_misprints_are_not(index):
    lemma = single.LEMMAS[index]
    witness = {"left": str(lemma.left), "right": str(lemma.right)}
    assert derived("formula-equal", witness) == lemma
    for before, after in (("sin(", "cos("), ("eta*", "eta**2*"), (" + ", " - "), ("2*", "3*")):
        wrong = witness["right"].replace(before, after, 1)
        if wrong != witness["right"]:
            refused("formula-equal", {**witness, "right": wrong})


# -- the rules -----------------------------------------------------------------------------------


@pytest.mark.slow
def test_solutions_are_not_talked_into(document):
    for given in steps_of(document, "single-solution"):
        witness = {**given, "latest": None}
        found = derived("single-solution", witness)
        assert isinstance(found, Solution) and found.contracts == (abs(found.multiplier[0]) < 1)
        low, high = map(Fraction, witness["phase"])
        for changed in (
            {"phase": [str(low - 3), str(high + 3)]},
            {"nu": "0"},
            {"eta": "-1/3"},
            {"early": "0"},
            {"early": "1/100" if found.acceleration[0] > 0 else "10000"},
        ):
            refused("single-solution", {**witness, **changed})


def test_a_bracket_of_three_solutions_is_refused():
    """And one at resonance, where K changes its sign once while all phases solve (16)."""
    one = {"eta": "237/1000", "nu": "3/10", "n": "1", "phase": ["14/25", "57/100"]}
    one |= {"early": None, "latest": None}
    assert derived("single-solution", one).contracts
    refused("single-solution", {**one, "phase": ["-29/5", "57/100"]})
    resonant = {"eta": "1", "phase": ["3/2", "8/5"]}
    refused("single-solution", {**one, **resonant})


@pytest.mark.slow
def test_orbits_are_not_talked_into(document):
    flown = [each for each in steps_of(document, "single-solution") if each["latest"]]
    assert [each["n"] for each in flown] == ["4", "9"]
    one, other = flown
    first = derived("single-solution", one)
    assert first.first and "is a fixed point of f" in first.sentence
    assert not derived("single-solution", {**one, "latest": None}).first
    assert abs(first.phase[0] - Fraction("1.1047758291275508478")) < 1e-18
    for latest in ("25", "0", "-1"):  # 8 pi is 25.13
        refused("single-solution", {**one, "latest": latest})
    refused("single-solution", {**other, "latest": "56"})  # 18 pi is 56.55


@pytest.mark.parametrize("n", ["5", "13"])
def test_a_solution_whose_flight_ends_earlier_is_no_orbit(n):
    """Of n = 4 or 9 alone the first impact is after n periods."""
    for orbit in solutions(System(PAPER.eta, PAPER.nu), int(n), 60):
        phase = [str(end) for end in orbit.phase]
        witness = {"eta": "2121/10000", "nu": "-1/5", "n": n, "phase": phase, "early": None}
        assert not derived("single-solution", {**witness, "latest": None}).first
        refused("single-solution", {**witness, "latest": "400"})


@pytest.mark.parametrize(
    ("rule", "field", "change"),
    [
        ("eta", "ends", lambda ends: ends[:-1]),  # n = 48 is missing
        ("eta", "ends", lambda ends: [[*ends[0][2:], *ends[0][:2]], *ends[1:]]),
        ("eta", "ends", lambda ends: [[*ends[0][:3], "3/4"], *ends[1:]]),  # beyond 1/2
        ("eta", "ends", lambda ends: [["1/5", "41/200", *ends[0][2:]], *ends[1:]]),  # too wide
        ("eta", "low", lambda low: "1/50"),
        ("eta", "nu", lambda nu: "1"),
        ("below", "ends", lambda ends: ends[:-1]),  # n = 51 is missing
        ("below", "ends", lambda ends: [[*ends[0], "99/100", "999/1000"], *ends[1:]]),
        ("below", "ends", lambda ends: [*ends[:2], ends[2][:2], *ends[3:]]),  # it sticks before 1/3
        ("below", "late", lambda late: late[:2] + late[:2]),
        ("below", "low", lambda low: "1/50"),
        ("below", "nu", lambda nu: "-31/100"),
    ],
)
def test_windows_are_not_talked_into(document, rule, field, change):
    witness = windows(document, rule)
    refused("single-windows", {**witness, field: change(witness[field])})


def first_of(entry, *numbers):
    """An edit of the first window, from an entry on."""
    return lambda ends: [[*ends[0][:entry], *numbers, *ends[0][entry + 2 :]], *ends[1:]]


@pytest.mark.every
@pytest.mark.parametrize(
    ("rule", "field", "change", "reason"),
    [
        ("eta", "ends", first_of(0, "1/2", "50001/100000"), "where its lemma looks"),
        ("eta", "ends", lambda x: [x[0][:2], *x[1:]], "to end at 1/n"),
        ("eta", "nu", lambda x: "-1/5", "where its lemma looks"),
        ("below", "nu", lambda x: "1/5", "where its lemma looks"),
        ("nu", "above", lambda x: [[x[0][0], ["1", "11/10"]], *x[1:]], "in .0, 1. is expected"),
        ("nu", "above", lambda x: [[None, x[0][1]], *x[1:]], "proved to be at .nu. >= 1"),
        ("nu", "early", lambda x: [f"1/{10**45}", *x[1:]], "an earlier impact is not proved"),
        ("eta", "low", lambda x: "1/40", "beyond the least eta"),
        ("below", "ends", first_of(0, "93/100", "1"), "where its lemma looks"),
        ("below", "ends", lambda x: [["93/100", "47/50"], *x[1:]], "nine places"),  # true
        ("below", "late", lambda x: [*x[:2], "3/2", "8/5"], "outside .3/2, 2."),
        ("below", "touch", lambda x: "5", "within 5/7 of pi"),
    ],
)
def test_windows_are_refused_for_their_reason(document, rule, field, change, reason):
    witness = windows(document, rule)
    with pytest.raises(REFUSED, match=reason):
        derived("single-windows", {**witness, field: change(witness[field])})


def test_a_window_has_a_length(document):
    witness = windows(document, "nu")
    found = derived("single-windows", witness)
    overlap = (1, (ONE / 2, ONE * 3 / 4), (ONE * 5 / 8, ONE * 7 / 8))
    with pytest.raises(Unproved, match="to have a length"):
        replace(found, above=(overlap,))


def test_windows_are_apart_and_told_of(document):
    witness = windows(document, "eta")
    refused("single-windows", {**witness, "low": "9/20", "ends": []})
    found = derived("single-windows", witness)
    assert "n = 1, ..., 48" in found.sentence
    (flip, stick), *others = found.ends
    witness = windows(document, "below")
    below = derived("single-windows", witness)
    assert "n = 1, ..., 51" in below.sentence and "(to 1/n for n = 1, 2)" in below.sentence
    saddle, last = below.ends[2]
    for known, bad in (
        (found, {"ends": ((stick, flip), *others)}),
        (found, {"ends": (*others, (flip, stick))}),
        (below, {"ends": (*below.ends[:2], (last, saddle), *below.ends[3:])}),
        (below, {"ends": below.ends[::-1]}),
        (below, {"late": below.late[::-1]}),
        (below, {"late": below.ends[0]}),
    ):
        with pytest.raises(Unproved, match="apart"):
            replace(known, **bad)
    for known, bad in ((found, {"late": below.late}), (below, {"late": None})):
        with pytest.raises(Unproved, match="those for nu < 0"):
            replace(known, **bad)


def test_windows_at_an_amplitude_beyond_the_lemmas_are_not_proved():
    """At nu = -0.09 some are, and n = 2 sticks before 1/2; at -0.31 nothing is said."""
    steps = s4_single.Single(s4_single.Prover(s4_single.System(PAPER.eta, PAPER.nu), 20, 100))
    name = steps.below_windows(Fraction("-0.09"), Fraction("0.2"))
    own = steps.prover.known[name]
    assert derived("single-windows", steps.prover.steps[name]["witness"]) == own
    assert 1.98 < own.late[0][0] < own.late[1][1] < 2
    with pytest.raises(Unproved, match="-3/10"):
        derived("single-windows", {**steps.prover.steps[name]["witness"], "nu": "-31/100"})


# -- the claims ----------------------------------------------------------------------------------


def verdict(claim, conclusions):
    return find(claim).decide(PAPER, conclusions).verdict


ONE, OFF = Fraction(1), Fraction(1, 1000)


def moved(**place):
    """A solution at other parameters."""

    def change(found):
        at = Place.plastic(place.get("eta", found.at.eta[0]), place.get("nu", found.at.nu[0]))
        return replace(found, at=at)

    return change


def having(**fields):
    return lambda found: replace(found, **fields)


def of_sign(sign, **fields):
    return lambda found: replace(found, **fields) if sign * found.nu > 0 else found


def sticking(found):
    """Pretend that the launch which has an earlier impact sticks."""
    return replace(found, acceleration=(-ONE, -ONE)) if found.early is not None else found


@pytest.mark.slow
@pytest.mark.parametrize(
    ("claims", "kind", "change"),
    [
        (("P4", "P5", "P6"), Solution, having(early=None)),
        (("P4", "P5", "P6"), Solution, having(multiplier=(-ONE, ONE / 2))),
        (("P4", "P5", "P6"), Solution, having(multiplier=(ONE / 2, ONE))),
        (("P4", "P5", "P6"), Solution, having(acceleration=(-ONE, ONE))),
        (("P4", "P5", "P6"), Solution, sticking),
        (("P5",), Solution, moved(eta=Fraction("15.5"))),
        (("P5",), Solution, moved(eta=Fraction("0.01"))),
        (("P5",), Solution, moved(nu=Fraction("0.21"))),
        (("P6",), Solution, moved(eta=Fraction("0.238"))),
        (("P6",), Solution, moved(nu=Fraction("0.95"))),
        (("P5",), EtaWindows, of_sign(1, nu=Fraction("0.21"))),
        (("P5",), EtaWindows, of_sign(1, low=Fraction("0.02"))),
        (("P5",), EtaWindows, of_sign(-1, nu=Fraction("-0.21"))),
        (("P5",), EtaWindows, of_sign(-1, low=Fraction("0.02"))),
        (("P6",), NuWindows, having(eta=Fraction("0.238"))),
        (("P6",), NuWindows, having(above=((1, (OFF, OFF), (ONE, ONE)),))),
    ],
)
def test_conclusions_about_something_else_do_not_decide(claims, kind, change):
    for claim in claims:
        proof = [found for _, found in evidence("single").proofs[claim]]
        edited = [change(found) if isinstance(found, kind) else found for found in proof]
        assert edited != proof
        assert verdict(claim, edited) is Verdict.UNDECIDED


def test_sentences_have_all_their_hypotheses(document):
    """An orbit may stick and be stable, too: at (0.23, 0.2) f' = 0 and (18) is 0.463."""
    said = {entry["id"]: entry["corrected"] for entry in document["claims"]}
    assert all("leaves the table at once" in said[claim] for claim in ("P3", "P4", "P5", "P6"))
    assert "0 < |nu| < 1" in said["P4"] and "For nu = 0.2 (p < 0)" in said["P5"]
    assert "For nu = -0.2 (p > 0), plastic impacts and eta >= 0.01" in said["P5"]
    assert "For eta = 0.237, plastic impacts and 0 < |nu| < 1" in said["P6"]
    eta, nu = mpf("0.23"), mpf("0.2")
    separation = mp.asin(eta**2 / (nu * (1 - eta**2)))
    time, phi = reference.first_impact(eta, nu, separation + mpf(10) ** -20)
    assert abs(separation + time - phi - 2 * mp.pi) < 1e-9 and 0 < phi < separation
    assert reference.launch_acceleration(eta, nu, phi) < 0  # so it leaves at the separation phase
    assert abs(slope_18(eta, nu, 1, phi) - mpf("0.463")) < 1e-3


@pytest.mark.parametrize("eta", ["0.23", "0.237", "0.25"])
def test_stable_orbits_that_stick_are_in_no_window(document, eta):
    """One impact a turn: where the mass lands the table holds it until phi_s, so f' = 0."""
    witness = windows(document, "eta")
    found = derived("single-windows", witness)
    assert not any(flip[0] <= Fraction(eta) <= stick[1] for flip, stick in found.ends)
    eta, nu = mpf(eta), mpf("0.2")
    leave = mp.asin(eta**2 / (nu * (1 - eta**2)))
    time, _ = reference.first_impact(eta, nu, leave + mpf(10) ** -20)
    for share in range(11):  # from the landing on, up to phi_s a turn later
        phi = leave + time + (2 * mp.pi - time) * share / 11
        assert time < 2 * mp.pi and reference.launch_acceleration(eta, nu, phi) < 0
