"""Two rectangles of states with restitution in Coq: what is stated, accepted, and refused."""

import json
from functools import cache

import pytest

from proofs.formal import __main__ as formal
from proofs.formal import coqc, rebounds
from proofs.trusted.verify import check
from tests.proofs.formal.coq import ROOT, in_lemma, needs_coqc

NONPLASTIC = ROOT / "reports" / "nonplastic.json"
RECTANGLES = "(111 / 100) (29 / 25) (127 / 100) (133 / 100) (-9 / 20) (0) (2)"


@cache
def repaired():
    """The case of the paper's repaired rectangles, with machine floats."""
    source = NONPLASTIC.read_text()
    return rebounds.case(check(source), source, "0", floats=True)


@pytest.mark.slow
def test_what_is_stated_at_the_paper_s_parameters():
    made = repaired()
    said = coqc.statements(made.text, [theorem.name for theorem in made.theorems])
    assert f"two_sided_shift rebound {RECTANGLES}" in said("rectangles_horseshoe")
    assert "rebound ((33 / 25), (-9 / 20)) z -> fst z < (33 / 25)" in said(
        "printed_edge_falls_short"
    )
    assert "exists z" in said("printed_edge_falls_short")
    assert "Definition eps := (1 / 100)." in made.text and "side := -1." in made.text


@needs_coqc
@pytest.mark.long
def test_coqc_accepts_the_repaired_rectangles(capsys, tmp_path):
    assert formal.main([str(NONPLASTIC), "--out", str(tmp_path), "--json", "-"]) == 0
    answer = json.loads(capsys.readouterr().out)
    assert [each["name"] for each in answer["theorems"]] == [
        "model",
        "rectangles_horseshoe",
        "hyperbolic",
        "printed_edge_falls_short",
    ]
    assert set(answer["axioms"]) == coqc.REALS


# a lemma, and an edit of what it says that makes it false
FALSE = [
    ("rates0", ("(67 / 20) <= DP_p", "5 <= DP_p")),
    ("launch0", ("0 <= t <= (1)", "0 <= t <= 10")),
    ("end1", ("< 0", "> 0")),
    ("left0", ("<= (111 / 100).", "<= (11 / 10).")),
    ("rectangles_horseshoe", ("(0) (2) (17 / 20)", "(0) (2) (2 / 5)")),
    ("printed_edge_falls_short", ("fst z < (33 / 25)", "fst z < (13 / 10)")),
]


@needs_coqc
@pytest.mark.long
@pytest.mark.parametrize(("lemma", "edit"), FALSE)
def test_false_rectangles_are_refused(tmp_path, lemma, edit):
    made = repaired()
    modules = coqc.order(made.text)
    coqc.copy(coqc.theory(modules, print), tmp_path, modules, ".vo")
    (tmp_path / "Case.v").write_text(in_lemma(made.text, lemma, edit))
    with pytest.raises(coqc.Refused) as refused:
        coqc.run(tmp_path, "Case")
    assert refused.value.lemma == lemma
