"""`python -m proofs bifurcation`: what it prints and writes, and what it refuses."""

import json

import pytest
import sympy

from proofs.commands import bifurcation
from proofs.commands.bifurcation import main
from proofs.methods.bifurcation import closed
from proofs.trusted.verify import Rejected, check

LOGISTIC = "x1 = r*x*(1 - x)"
HENON = ("x1 = 1 - a*x^2 + y", "y1 = b*x")


def answer(capsys, *arguments):
    assert main([*arguments, "--json", "-"]) == 0
    return json.loads(capsys.readouterr().out)


@pytest.mark.slow
def test_formulas_with_latex(capsys):
    found = answer(capsys, *HENON, "--kind", "flip")
    assert found["jacobian"][0][0] == {"formula": "-2*a*x", "latex": r"- 2 a x"}
    (flip,) = found["bifurcations"]["flip"]["closed"]
    assert flip["values"]["a"] == {
        "formula": "3*(b - 1)**2/4",
        "latex": r"\frac{3 \left(b - 1\right)^{2}}{4}",
    }
    assert flip["values"]["critical"]["formula"] == "-9*(b - 1)**3/(16*(b + 1))"
    assert len(found["checked"]) == 5


@pytest.mark.slow
def test_enclosures_hold_the_digits_asked_for(capsys):
    near = ["--set", "b=0.3", "--near", "x=1,y=0.3,a=0.4", "--digits", "25"]
    found = answer(capsys, *HENON, "--kind", "flip", *near)["bifurcations"]["flip"]["enclosed"]
    low, high = found["a"]["lower"], found["a"]["upper"]
    assert float(low) <= 0.3675 <= float(high) and low.startswith("0.36749999999999999999999")
    assert found["says"].startswith("supercritical")
    assert found["critical"]["lower"].startswith("0.148413461538461538461538")


@pytest.mark.slow
def test_the_lemma_file_is_accepted_and_a_changed_one_is_not(tmp_path, capsys):
    assert main([LOGISTIC, "--out", str(tmp_path)]) == 0
    source = (tmp_path / "bifurcation.json").read_text()
    assert f"{len(check(source).sentences)} lemmas" in capsys.readouterr().out
    with pytest.raises(Rejected):
        check(source.replace('"r": "3"', '"r": "5/2"'))


@pytest.mark.slow
def test_equations_from_a_file(tmp_path, capsys):
    (tmp_path / "map").write_text("\n".join(HENON))
    found = answer(capsys, f"@{tmp_path / 'map'}", "--kind", "fold")
    assert found["variables"] == ["x", "y"]


def test_what_is_not_found_is_said(capsys):
    assert main([*HENON, "--kind", "neimark_sacker"]) == 1
    assert "no closed form of x, y, a" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("equation", "said"),
    [
        ("x1 = r*x*exp(log(x))", "the Jacobian"),  # for sympy r*x^2
        ("x1 = x*exp(r*(1 - x))", "flip"),  # whose factors are no polynomials
    ],
)
def test_what_sympy_alone_knows_is_undecided(equation, said, capsys):
    assert main([equation, "--kind", "flip"]) == 1
    assert f"undecided: {said}: " in capsys.readouterr().err


@pytest.mark.slow
def test_what_is_found_and_what_is_dropped_are_told(capsys):
    """A resonance 1:4 at the origin; at (2, 2), b = 3 the multipliers are real."""
    circle = ["x1 = y", "y1 = -b*x + y^2 + x*y", "--kind", "neimark_sacker"]
    assert main(circle) == 0
    said = capsys.readouterr().out
    assert "resonance 1:4 at y = 0, x = 0, b = 1" in said
    assert "dropped: y = 2, x = 2, b = 3: none: the multipliers are real" in said
    found = answer(capsys, *circle)["bifurcations"]["neimark_sacker"]
    assert [each["kind"] for each in found["closed"]] == ["resonance 1:4"]
    assert [each["kind"] for each in found["dropped"]] == ["none"]


def test_signs_are_explained_where_they_stand(capsys):
    assert main([LOGISTIC, "--kind", "flip"]) == 0
    said = capsys.readouterr().out
    assert "critical = 9: the second iterate is h - 2 critical h^3 + ...: a stable cycle" in said
    assert (
        "speed = -1: the multiplier is -1 + speed (r - ...) + ...: the cycle is there for" in said
    )


def test_a_bifurcation_that_is_none_is_status_1(capsys):
    assert main(["x1 = x + a + x^3", "--kind", "fold"]) == 1
    assert "fold: degenerate: critical = 0" in capsys.readouterr().err
    assert main(["x1 = 2*x + a", "--kind", "fold"]) == 1
    assert "met nowhere" in capsys.readouterr().err


def test_a_closed_form_that_is_false_is_not_taken(monkeypatch):
    """r = 3 + 1/1000 in place of 3."""
    true = closed.coefficients

    def false(*about):
        return {**true(*about), "r": sympy.Rational(3001, 1000)}

    monkeypatch.setattr(closed, "coefficients", false)
    assert main([LOGISTIC, "--kind", "flip"]) == 1


def test_no_bifurcation_near_a_guess(capsys, tmp_path):
    """x1 = x + r has the multiplier 1 everywhere: no flip."""
    arguments = ["x1 = x + r", "--kind", "flip", "--near", "x=0,r=1"]
    assert main([*arguments, "--out", str(tmp_path)]) == 1
    assert "undecided: flip" in capsys.readouterr().err


def test_a_checker_that_disagrees_is_said_loudly(monkeypatch, capsys):
    def disagree(source):
        raise Rejected("$.steps")

    monkeypatch.setattr(bifurcation, "check", disagree)
    assert main([LOGISTIC]) == 3
    assert "the checker disagrees" in capsys.readouterr().err
