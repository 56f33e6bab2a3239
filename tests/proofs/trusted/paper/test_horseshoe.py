"""The main job: verdicts and numbers against independent computations, and its command line."""

import json
import subprocess
import sys
from dataclasses import replace
from fractions import Fraction
from functools import cache
from pathlib import Path

import pytest

from proofs import horseshoe
from proofs.shell import runner
from proofs.shell.groups import produce
from proofs.trusted.kernel.staying import StayingSet
from proofs.trusted.paper import GROUPS
from proofs.trusted.parameters import PAPER
from proofs.trusted.verdicts import Verdict
from proofs.trusted.verify import check, premises
from tests.proofs.trusted.paper import reference

ETA, NU = reference.mpf("0.2121"), reference.mpf("-0.2")
ROOT = Path(__file__).parents[4]
SLOPES = ["H1", "H2", "H3", "H4", "H5", "H6"]
VERDICTS = {
    **dict.fromkeys(GROUPS["horseshoe"], "VERIFIED"),
    "H2": "REFUTED",
    "H5": "REFUTED",
    "H11": "CONDITIONAL",
}


def made(of=PAPER, claims=GROUPS["horseshoe"], **options):
    return produce({"horseshoe": claims}, of, digits=options.pop("digits", 30), **options)


@pytest.fixture(scope="module")
def outcome():
    return made()


@cache
def corrected(text):
    """The horseshoe of a certificate."""
    known = premises(text).known.values()
    return next((each for each in known if isinstance(each, StayingSet)), None)


def quantities(outcome):
    return {name: pair for line in outcome.lines for name, pair in line.quantities.items()}


def test_verdicts_at_the_paper_s_parameters(outcome):
    assert {line.id: line.verdict.value for line in outcome.lines} == VERDICTS
    assert {x.id: x.verdict.value for x in check(outcome.certificate).claims} == VERDICTS


def near(pair, value, digits):
    low, high = pair
    exact = reference.mpf(low.numerator) / low.denominator
    return abs(value - exact) < reference.mpf(10) ** -digits and high - low < Fraction(1, 10**30)


def brute(phi):
    flight, phase = reference.first_impact(ETA, NU, reference.mpf(phi))
    return phase, reference.slope(ETA, NU, reference.mpf(phi), flight)


def test_numbers_against_brute_force(outcome):
    """f' increases on I0 and I1 (certified separately): inside it is between its extremes."""
    found = quantities(outcome)
    for which, ends in (("I0", ("1.11", "1.15")), ("I1", ("1.27", "1.32"))):
        for phi, side, least in zip(ends, ("low", "high"), ("min", "max"), strict=True):
            image, slope = brute(phi)
            assert near(found[f"image_{side}_{which}"], image, 30)
            assert near(found[f"slope_{least}_{which}"], slope, 13)
    for which, ends in (("I0", (1110, 1150)), ("I1", (1270, 1320))):
        for k in range(1, 6):
            phi = Fraction(ends[0] + (ends[1] - ends[0]) * k // 6, 1000)
            _, slope = brute(reference.mpf(phi.numerator) / phi.denominator)
            least, most = (found[f"slope_{name}_{which}"] for name in ("min", "max"))
            assert float(least[0]) < slope < float(most[1])


def test_the_corrected_theorem_is_about_the_nearest_printed_sets(outcome):
    found = corrected(outcome.certificate)
    assert found.cells == ((Fraction("1.1"), Fraction("1.15")), PAPER.right)
    assert found.is_horseshoe and found.interval == (Fraction("1.1"), Fraction("1.32"))
    assert Fraction("4.30") < found.steepness[0] < found.steepness[1] < Fraction("6.19")
    told = {line.id: line.truth for line in outcome.lines}
    assert told["H1"] is None and told["H2"] == told["H5"]
    assert told["H2"] == f"At {PAPER.place}: {found.sentence}"


def test_the_corrected_sets_verify_as_they_are(outcome):
    found = corrected(outcome.certificate)
    again = made(
        replace(PAPER, left=found.cells[0], right=found.cells[1], interval=found.interval,
                slopes=(Fraction("4.30"), Fraction("6.19")), ratios=None), SLOPES
    )  # fmt: skip
    assert all(line.verdict is Verdict.VERIFIED for line in again.lines)
    assert corrected(again.certificate) is None


@pytest.mark.parametrize(
    ("claim", "rules"),
    [
        ("H16", set()),
        ("H11", {"moran-root"}),
        ("H4", {"avoids"}),
        ("H1", {"slopes"}),
    ],
)
def test_only_what_is_asked_for_is_proved(claim, rules):
    steps = json.loads(made(claims=[claim]).certificate)["steps"]
    assert {step["rule"] for step in steps.values()} == rules


@pytest.mark.parametrize("digits", [1, 10, 60])
def test_digits_asked_for_are_certified_and_checked(digits):
    outcome = made(claims=["H1", "H2", "H5", "H11"], digits=digits)
    for low, high in quantities(outcome).values():
        assert (high - low) * 10**digits < abs(low)
    assert len(check(outcome.certificate).claims) == 4


@pytest.mark.parametrize(
    "changes",
    [
        {"slopes": (Fraction(5), Fraction(6)), "ratios": None, "printed_s0": None},
        {"eta": Fraction("0.2125")},
        pytest.param({"eta": Fraction("0.212")}, marks=pytest.mark.slow),
        {"nu": Fraction("0.2")},
        pytest.param(
            {"left": (Fraction("1.16"), Fraction("1.2")),
             "interval": (Fraction("1.16"), Fraction("1.32"))},
            marks=pytest.mark.slow,
        ),
        {"left": (Fraction(4), Fraction("4.5")), "right": (Fraction(5), Fraction("5.5")),
         "interval": (Fraction(4), Fraction("5.5"))},
        {"slopes": (Fraction("1.5"), Fraction("1.7")), "ratios": None, "printed_s0": None},
    ],
)  # fmt: skip
def test_at_other_parameters_prover_and_checker_agree(changes):
    outcome = made(replace(PAPER, **changes))
    report = check(outcome.certificate)
    assert {c.id: c.verdict for c in report.claims} == {x.id: x.verdict for x in outcome.lines}
    assert not report.is_paper


# -- the command line --------------------------------------------------------------------------


def run(*arguments):
    return subprocess.run(
        [sys.executable, *arguments], capture_output=True, text=True, cwd=ROOT, check=True
    )


def test_a_checker_that_disagrees_is_loud(monkeypatch, capsys, tmp_path):
    from proofs.trusted.verify import Rejected

    def refuse(*_):
        raise Rejected("on purpose")

    monkeypatch.setattr(runner, "check", refuse)
    assert horseshoe.main(["--only", "H16", "--out", str(tmp_path)]) == 3
    assert "DISAGREES" in capsys.readouterr().err
