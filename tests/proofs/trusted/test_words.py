"""What the ledger says carries its hypotheses: a phrase that is dropped makes a sentence false.

Each has a counterexample, named in the comment or in the tests of its section.
"""

import json
from pathlib import Path

import pytest

from proofs.shell.groups import row_of
from proofs.shell.ledger import CLAIMS

LEDGER = Path(__file__).parents[3] / "reports" / "ledger.json"
ROWS = {row["id"]: row for row in json.loads(LEDGER.read_text(encoding="utf-8"))["claims"]}
AT_ONCE = "leaves the table at once"
HYPOTHESES = [
    ("M9", "statement", "beta > 0"),
    ("M9", "witness", "beta > 0"),
    ("P1", "statement", AT_ONCE),  # the motion of G1 does not satisfy (16)
    ("P1", "corrected", AT_ONCE),
    ("P3", "statement", AT_ONCE),  # at (0.23, 0.2) f' = 0 and (18) is 0.463
    ("P3", "corrected", "transversal"),
    ("P5", "statement", AT_ONCE),  # at (0.237, 0.2) and (0.25, 0.2) stable orbits stick
    ("P5", "corrected", "launch acceleration > 0"),
    ("P6", "statement", AT_ONCE),
    ("P6", "corrected", "launch acceleration > 0"),
    ("H3", "statement", "lifted"),
    ("H11", "statement", "0.449...., rounded"),
    ("H11", "why", "is not if truncated"),
    ("G3", "statement", "(4.64, 6.05) to the places printed"),
    ("G4", "statement", "more than half of the circle"),
    ("G7", "witness", "one landing with all that follows until it rests"),
    ("G8", "why", "no theorem and no certificate"),
    ("R2", "witness", "a touch without relative velocity"),
    ("R6", "witness", "beta > 0"),
    ("R6", "witness", "where cos(phi_o) is not 0"),
    ("R6", "witness", "a touch without relative velocity"),
    ("R12", "corrected", "The converse is false"),
]


@pytest.mark.parametrize(("claim", "part", "words"), HYPOTHESES)
def test_a_hypothesis_is_told(claim, part, words):
    assert words in ROWS[claim][part]


def test_readings_are_no_stronger_than_the_words():
    """What the paper does not write is asked by rows of our own."""
    assert "almost every" not in ROWS["G4"]["statement"] + ROWS["G7"]["statement"]
    assert "full shift" not in ROWS["G5"]["statement"]
    assert "exactly" not in ROWS["R12"]["statement"]
    own = {claim for claim in CLAIMS if not row_of(claim).words}
    assert {"G10", "G11", "G12"} <= own
    assert "almost every" in ROWS["G10"]["statement"] and "full shift" in ROWS["G11"]["statement"]
    assert "almost every" in ROWS["G12"]["statement"]


def test_a_theorem_is_no_observation():
    for row in ROWS.values():
        assert "observation" not in (row["corrected"] or "")


def test_the_constants_of_entropies_are_named():
    assert "is log 2." in ROWS["H13"]["corrected"]
    assert "number in 2" not in json.dumps(list(ROWS.values()))
