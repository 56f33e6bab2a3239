"""The Coq files: what is stated for which certificate, and what coqc makes of it."""

import random
import re
from fractions import Fraction

import pytest

from proofs.formal import coqc
from proofs.formal.cases import case
from proofs.formal.hints import NoHint
from proofs.formal.plan import plan
from proofs.formal.written import rational
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.verdicts import Verdict
from tests.proofs.formal.coq import (
    ROOT,
    accepts,
    certificate,
    edited,
    needs_coqc,
    paper_case,
    stops_at,
)
from tests.proofs.trusted import corpus

DECREASING = ["--eta", "47/500", "--nu", "77/100", "--left", "1.011", "1.0585"]
DECREASING += ["--right", "1.3055", "1.3276"]
THROUGH_PHASE_0 = ["--left", "0.74", "0.76", "--right", "2.24", "2.26"]
THIN = ["--left", "1.1", "1.15", "--slopes", "4.307803", "6.18487"]


def statements(made):
    """Return the statement of each theorem of a case."""
    written = coqc.statements(made.text, [theorem.name for theorem in made.theorems])
    return {theorem.name: written(theorem.name) for theorem in made.theorems}


def test_the_statement_to_trust_is_short_and_nothing_is_assumed_in_the_theory():
    impact = (coqc.THEORY / "Impact.v").read_text()
    assert impact.count("\n") <= 80
    assumed = r"\b(Axiom|Axioms|Parameter|Parameters|Conjecture|Admitted|admit|Unset)\b"
    for path in coqc.THEORY.glob("*.v"):
        assert not re.search(assumed, path.read_text()), path


@pytest.mark.slow
def test_the_paper_s_numbers_stand_in_the_statements():
    said = statements(paper_case())
    assert said["corrected_theorem"].endswith(
        "horseshoe next (11 / 10) (23 / 20) (127 / 100) (33 / 25) (1) (1) (43 / 10) (619 / 100)."
    )
    assert "(21 / 5) <= d" in said["H1_verified"]
    assert "(21 / 4) < d" in said["H2_refuted"] and "slope_at (113 / 100) d" in said["H2_refuted"]
    assert "~ (111 / 100) <= psi <= (33 / 25)" in said["H4_verified"]
    assert "y - x < (d - c) / (21 / 5)" in said["H6_verified"]
    assert "moran (381 / 2000) (2381 / 10000) t = 1 <-> t = s" in said["H11_conditional"]
    head = paper_case().text.partition("Lemma")[0]
    assert "Definition eta := (2121 / 10000)." in head and "Definition nu := (-1 / 5)." in head
    assert "Definition side := -1." in head


def test_every_theorem_stands_in_the_list_whose_axioms_are_printed():
    made = paper_case()
    listed = re.search(r"Definition all := \((.*)\)\.\nPrint Assumptions all\.\n$", made.text)[1]
    stated = re.findall(r"^Theorem (\w+)", made.text, re.MULTILINE)
    assert listed.split(", ") == stated == [theorem.name for theorem in made.theorems]


@pytest.mark.slow
def test_a_branch_that_decreases_is_stated_as_such(tmp_path):
    asked = plan(certificate(tmp_path, *DECREASING))
    assert asked.headline.signs == (-1, -1) and not asked.headline.is_corrected
    said = statements(case(asked, "x"))
    assert "(-1) (-1)" in said["horseshoe_theorem"] and "H5_verified" in said
    assert "d < (21 / 5)" in said["H1_refuted"] and "d < 0" in said["H3_refuted"]


def test_where_nothing_is_refuted_the_given_sets_have_the_theorem(tmp_path):
    asked = plan(certificate(tmp_path, "--left", "1.1", "1.15", "--slopes", "4.3", "6.2"))
    assert all(verdict is Verdict.VERIFIED for verdict in asked.verdicts.values())
    assert asked.headline.slopes == (Fraction("4.3"), Fraction("6.2"))
    said = statements(case(asked, "x"))
    assert {"horseshoe_theorem", "H2_verified", "H5_verified"} <= set(said)


@pytest.mark.slow
def test_slopes_through_phase_0_need_no_lap(tmp_path):
    asked = plan(certificate(tmp_path, *THROUGH_PHASE_0))
    assert asked.headline is None
    said = statements(case(asked, "x"))
    assert set(said) == {"model", "H1_refuted", "H2_verified", "H3_refuted"} | {
        f"{name}_{verdict.value.lower()}" for name, verdict in asked.verdicts.items()
    }


@pytest.mark.slow
def test_thin_margins_take_more_pieces_not_more_digits_of_the_bound(tmp_path):
    made = case(plan(certificate(tmp_path, *THIN)), "x")
    thick = case(plan(certificate(tmp_path, *THIN[:3])), "x")
    count = made.text.count("Lemma piece")
    assert thick.text.count("Lemma piece") < count < 40
    assert rational(Fraction("4.307803")) in statements(made)["H1_verified"]


def test_claims_that_need_no_sets_are_stated_alone():
    path = corpus.path_of("accepted/h11_alone")
    made = case(plan(path.read_text()), path.name)
    assert {theorem.name for theorem in made.theorems} == {
        "model",
        "H11_conditional",
        "H11_conditional_1",
    }


def near_the_paper(folder, number, seed):
    """Yield certificates with a theorem at random parameters near the paper's."""
    draw = random.Random(seed)
    while number:
        eta, nu = (
            Fraction(2121 + draw.randint(-40, 40), 10000),
            Fraction(-2000 + draw.randint(-60, 60), 10000),
        )
        left, right = (Fraction(draw.randint(-2, 2), 100) for _ in range(2))
        ends = [Fraction("1.10") + left, Fraction("1.15") + left]
        ends += [Fraction("1.27") + right, Fraction("1.32") + right]
        a, b, c, d = map(str, ends)
        options = ["--eta", str(eta), "--nu", str(nu), "--left", a, b, "--right", c, d]
        text = certificate(folder, *options)
        try:
            asked = plan(text)
        except Unproved:
            continue
        if asked.headline is not None:
            number -= 1
            yield asked


@pytest.mark.slow
def test_cuts_are_found_near_the_paper_s_parameters(tmp_path):
    for asked in near_the_paper(tmp_path, 1, seed=5):
        try:
            made = case(asked, "x")
        except NoHint as failure:
            pytest.fail(f"{asked.of}: {failure}")
        assert made.theorems[1].name in ("corrected_theorem", "horseshoe_theorem")


@needs_coqc
@pytest.mark.long
def test_coqc_accepts_twenty_of_them_and_refuses_what_is_false(tmp_path, proved):
    for number, asked in enumerate(near_the_paper(tmp_path, 20, seed=8)):
        true, false = tmp_path / f"true{number}", tmp_path / f"false{number}"
        true.mkdir()
        false.mkdir()
        made = case(asked, "x")
        accepts(proved, true, made.text)
        most = asked.headline.slopes[1]  # f' rounded up to hundredths: one less is below f'
        edit = rational(most), rational(most - Fraction(1, 100))
        assert stops_at(proved, false, edited(made.text, edit))[0].startswith("piece")


@needs_coqc
@pytest.mark.long
@pytest.mark.parametrize("options", [DECREASING, THROUGH_PHASE_0, THIN], ids=str)
def test_coqc_accepts_what_is_special(tmp_path, proved, options):
    accepts(proved, tmp_path, case(plan(certificate(tmp_path, *options)), "x").text)


@pytest.mark.slow
def test_a_horseshoe_of_another_claim_is_stated():
    """G5: on [1.31, 1.49]."""
    asked = plan((ROOT / "reports" / "chaos.json").read_text())
    assert not asked.headline.is_corrected and not asked.verdicts
    said = statements(case(asked, "0"))
    numbers = "(131 / 100) (27 / 20) (29 / 20) (149 / 100) (1) (1) (371 / 100) (291 / 25)"
    assert said["horseshoe_theorem"].endswith(f"horseshoe next {numbers}.")
    theorems = {"model", "horseshoe_theorem", "theorem_3", "theorem_4", "measure_zero"}
    assert set(said) == theorems | {"graph1", "graph2", "entropy2"}  # of a cycle, of three sets
