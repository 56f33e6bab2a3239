"""The oscillator as a library: exact in, enclosures out, theorems with certificates."""

import doctest
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mpmath import mpf

from intervals import Undecided
from proofs import Oscillator, oscillator
from proofs.motion.system import System
from proofs.motion.witness import NoImpact
from proofs.search.rebound import rebound
from proofs.trusted.certificate import Malformed
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.verify import Rejected, check
from tests.proofs.trusted.paper import reference

PLASTIC = Oscillator("0.2121", "-0.2")
RESTITUTING = Oscillator("0.2121", "-0.2", "0.01")
LEFT, RIGHT = ["1.1", "1.15"], ["1.27", "1.32"]


def test_the_docstring_runs():
    assert doctest.testmod(oscillator).failed == 0 < doctest.testmod(oscillator).attempted


@given(st.integers(111, 114))
@settings(max_examples=4)
def test_the_image_of_an_interval_holds_that_of_a_phase(hundredths):
    whole = PLASTIC.image(LEFT, digits=8)
    phase = Fraction(hundredths, 100)
    time, image = reference.first_impact(mpf("0.2121"), mpf("-0.2"), mpf(hundredths) / 100)
    point = PLASTIC.image(phase, digits=12)
    for name, true in (("flight", time), ("phase", image)):
        assert abs(float(point[name].lower) - float(true)) < 1e-9
        assert whole[name].lower <= point[name].lower <= point[name].upper <= whole[name].upper
    assert point["slope"].lower in PLASTIC.slope(LEFT)
    assert point["flight"] == PLASTIC.first_impact(phase, digits=12)


def test_answers_show_themselves():
    found = RESTITUTING.image("1.12", "-0.2", digits=8)
    time, velocity = reference.rebound(
        mpf("0.2121"), mpf("-0.2"), mpf("0.01"), mpf("1.12"), mpf("-0.2")
    )
    assert abs(float(found["flight"].lower) - float(time)) < 1e-7
    assert abs(float(found["velocity"].lower) - float(velocity)) < 1e-7
    assert [line.split()[0] for line in str(found).splitlines()][:3] == [
        "flight",
        "phase",
        "velocity",
    ]
    html = found._repr_html_()
    assert html.startswith("<table>") and html.count("<tr>") == 7
    assert r"\gamma_1" in found._repr_latex_()
    assert PLASTIC.image("4", digits=8).sticks and "dwell" in str(PLASTIC.image("4", digits=8))
    with pytest.raises(KeyError, match="flight, phase, velocity"):
        found["slope"]


@pytest.mark.parametrize(
    ("theorem", "verdicts"),
    [
        (lambda: PLASTIC.horseshoe(LEFT, RIGHT), {"H5": "VERIFIED", "H8": "VERIFIED"}),
        (
            lambda: RESTITUTING.horseshoe(["1.11", "1.16"], ["1.27", "1.33"], ["-0.45", "0"]),
            {"N1": "VERIFIED"},
        ),
    ],
)
def test_a_horseshoe_comes_with_a_certificate(theorem, verdicts):
    proved = theorem()
    report = check(proved.certificate)
    assert {claim.id: claim.verdict.value for claim in report.claims} == verdicts
    assert str(proved).startswith("At ") and proved.conclusion.sentence in str(proved)
    told = proved._repr_html_()
    assert "&lt;=" in told or "f&#x27; in" in told
    assert "<=" not in told and "f' in" not in told
    forged = proved.certificate.replace('"33/25"', '"4/3"').replace('"133/100"', '"4/3"')
    assert forged != proved.certificate
    with pytest.raises((Rejected, Malformed)):
        check(forged)


@pytest.mark.slow
def test_what_is_not_proved_is_undecided():
    with pytest.raises(Undecided, match="neither covered nor missed"):
        PLASTIC.horseshoe(["1.11", "1.15"], RIGHT)
    with pytest.raises(Undecided, match="fall short"):
        RESTITUTING.horseshoe(["1.11", "1.15"], RIGHT, ["-0.45", "0"])
    with pytest.raises(Undecided, match="2 images are possible"):
        PLASTIC.image(["1.1", "1.3"])
    with pytest.raises(NoImpact):
        PLASTIC.image("1.5707", horizon="100")


@pytest.mark.parametrize(
    ("ask", "error", "hint"),
    [
        (lambda: Oscillator(0.2121, "-0.2"), TypeError, 'write it as "0.2121"'),
        (lambda: PLASTIC.image([1.1, "1.15"]), TypeError, 'write it as "1.1"'),
        (lambda: PLASTIC.slope("1.1x"), ValueError, "1.1x"),
        (lambda: PLASTIC.image(["1.15", "1.1"]), ValueError, "reversed: 1.15 > 1.1"),
        (lambda: PLASTIC.image(["1.1"]), ValueError, "not 1 numbers"),
        (lambda: PLASTIC.image("6.5"), ValueError, "6.5"),
        (lambda: PLASTIC.image("1.1", "0"), TypeError, "go together"),
        (lambda: RESTITUTING.image("1.1"), TypeError, "go together"),
        (lambda: RESTITUTING.slope("1.1"), TypeError, "plastic"),
        (lambda: Oscillator("0.2121", "-0.2", "1"), ValueError, "epsilon"),
        (lambda: Oscillator("0", "-0.2"), ValueError, "eta"),
        (lambda: PLASTIC.horseshoe(RIGHT, LEFT), ValueError, "wrong order"),
        (lambda: Oscillator(np.float64(0.2), "-0.2"), TypeError, 'write it as "0.2"'),
        (lambda: PLASTIC.image({"1.1", "1.15"}), TypeError, "not an int"),  # which is the first?
        (lambda: PLASTIC.slope("1.13", digits=10**6), ValueError, "from 1 to 1000"),
        (lambda: PLASTIC.slope("1.13", digits="30"), ValueError, "not '30'"),
        (lambda: PLASTIC.horseshoe(LEFT, RIGHT, digits=0), ValueError, "not 0"),
        (lambda: PLASTIC.first_impact("1.13", horizon=0), ValueError, "positive"),
        (lambda: PLASTIC.first_impact("1.13", horizon="1e7"), ValueError, "up to 1000000"),
    ],
)
def test_bad_input_says_what_to_write(ask, error, hint):
    with pytest.raises(error, match=hint):
        ask()


@pytest.mark.parametrize(
    ("ask", "rule", "forge"),
    [
        (lambda: PLASTIC.image("1.13"), "differential", ('"113/100"', '"6"')),
        (lambda: PLASTIC.image(LEFT), "slopes", ('"points": [', '"points": ["0",')),
        (lambda: PLASTIC.image("4"), "separation", ('"eta": [', '"eta": ["1/7",')),
        (lambda: RESTITUTING.image("1.12", "-0.3"), "differential", ('"-3/10"', '"1/2"')),
        (
            lambda: RESTITUTING.image(["1.11", "1.12"], ["-0.3", "-0.25"]),
            "differential",
            ('"-1/4"', '"1/2"'),
        ),
    ],
)
def test_an_answer_comes_with_a_certificate(ask, rule, forge):
    certificate = ask().certificate
    assert f'"rule": "{rule}"' in certificate
    assert check(certificate).sentences
    forged = certificate.replace(*forge)
    assert forged != certificate
    with pytest.raises((Rejected, Malformed)):
        check(forged)


def test_the_certificate_is_about_what_is_answered():
    for answer in (PLASTIC.image("1.13", digits=40), RESTITUTING.image("1.12", "-0.2", digits=40)):
        (found,) = check(answer.certificate).conclusions
        phase = found.image if hasattr(found, "image") else found.values[0]
        ends = answer["phase"].lower, answer["phase"].upper
        assert phase[0] <= ends[1] and ends[0] <= phase[1] < phase[0] + Fraction(1, 10**12)


def test_what_no_rule_says_has_no_certificate():
    elastic = rebound(
        System(Fraction(1, 5), Fraction(-1, 5)), (Fraction(1),) * 2, (Fraction(0),) * 2, Fraction(1)
    )
    with pytest.raises(Unproved, match="epsilon"):
        elastic.prove()
