"""What the ledger says carries its hypotheses: a phrase that is dropped makes a sentence false.

Each has a counterexample, named in the comment or in the tests of its section.
"""

import json
import re
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
    ("H11", "witness", "s_0 for the ratios 0.1905 and 0.2381"),
    ("H11", "witness", "is 0.449 if rounded, and is not if truncated"),
    ("G3", "statement", "(4.64, 6.05) to the places printed"),
    ("G4", "statement", "more than half of the circle"),
    ("G7", "witness", "one landing with all that follows until it rests"),
    ("G8", "why", "no theorem and no certificate"),
    ("R2", "witness", "a touch without relative velocity"),
    ("R4", "witness", "the orbit is not asymptotically stable"),
    ("E1", "corrected", "every motion with an impact tends to one of a family"),  # R9.1: not to one
    ("R4", "corrected", "attracts every motion with an impact"),  # one of (1 + nu)/2 sin t has none
    ("R8", "witness", "For nu < 0 the states of the first one"),
    ("R9", "corrected", "For nu < 0 every motion with an impact tends"),
    ("A1", "witness", "off by more than 3, on the line"),  # 4 pi: less than delta, mod 2 pi
    ("G7", "witness", "none after 6.010073 (an upper bound)"),
    ("G5", "statement", "a periodic orbit is one"),
    ("G18", "corrected", "If a touch without relative velocity counts as an impact, there is one"),
    ("G18", "corrected", "|(f^n)'| >= 1.25^n/7 "),  # 0.142857 is below 1/7
    ("G4", "corrected", "Between 99.96302 and 99.96394 percent"),
    ("G4", "corrected", "[6.045424, 2 pi) and [0, 0.65236] within 1"),
    ("H18", "corrected", "with a limit at phi_g in [0.819753745, 0.819753746]"),
    ("S8", "witness", "read as psi_o of S11 is"),
    ("S11", "witness", "as the last expression of S8 is read"),
    ("S18", "corrected", "/(B*(1 + t**2))"),
    ("N5", "corrected", "epsilon in [0.197, 0.2]: V1 = "),
    ("N5", "corrected", "epsilon in [0.141, 0.157]: V1 = "),
    ("R6", "witness", "beta > 0"),
    ("R6", "witness", "where cos(phi_o) is not 0"),
    ("R6", "witness", "a touch without relative velocity"),
    ("R12", "corrected", "The converse is false"),
    ("S8", "corrected", "beta, omega, g > 0, m >= 1, 0 <= epsilon < 1"),  # with beta < 0, X < 1
    ("S10", "corrected", "beta, omega, g > 0, m >= 1, 0 <= epsilon < 1"),
    ("S10", "why", "True if X < 1"),
    ("S15", "corrected", "m >= 1, 0 <= epsilon < 1, rho > 0"),
    ("S15", "corrected", "If epsilon > epsilon_m, the first is an orbit for all rho >= rho_SN"),
    ("S15", "corrected", "the first exactly for rho > rho_G, the second for no rho"),
    ("S15", "corrected", "If epsilon = 0, the first exactly for rho >= sqrt(4 + c^2)"),
    ("S15", "corrected", "epsilon_1 = 0.0204576..."),
    ("S16", "corrected", "0 < epsilon < 1"),
    ("S16", "corrected", "an orbit, too, exactly if epsilon > epsilon_m and rho < rho_G"),
    ("S17", "corrected", "0 < epsilon < 1"),
    ("S17", "corrected", "rho > rho_F; it is an orbit then"),
    ("S18", "corrected", "the saddle-node is one of orbits exactly if epsilon > epsilon_m"),
    ("S18", "corrected", "2 sqrt(1 + u_(m-1)^2) <= rho < sqrt(4 + (2 pi m)^2)"),
    ("S22", "why", "five of the six fail, all but d^2(f^2)/dpsi^2 = 0"),
    ("S23", "why", "m >= 1, 0 <= epsilon < 1 and springs of any stiffness 0 < k"),
    ("S23", "why", "k^2 q < 2"),
    ("S23", "why", "with lambda < 0, an orbit or not"),
]


@pytest.mark.parametrize(("claim", "part", "words"), HYPOTHESES)
def test_a_hypothesis_is_told(claim, part, words):
    assert words in ROWS[claim][part]


NOT_SAID = [
    ("E1", "corrected", "the motion that all others tend to"),
    ("G7", "witness", "phi_s, up to 6.010073"),
    ("H18", "corrected", "the limit "),
    ("N5", "corrected", "a full shift on two symbols for every epsilon"),  # no part of a sentence
    ("P4", "witness", "sticks"),  # the claim excludes it
    ("S18", "corrected", "big"),
]


@pytest.mark.parametrize(("claim", "part", "words"), NOT_SAID)
def test_what_is_not_proved_or_not_meant_is_not_said(claim, part, words):
    assert words not in ROWS[claim][part]


def test_orbits_stay_in_a_union():
    """A full orbit that stays in V1 and in V2, which are disjoint, does not exist."""
    for row in ROWS.values():
        text = " ".join(row[part] or "" for part in ("statement", "witness", "corrected"))
        assert not re.search(r"(?<!union of )V1 and V2(?= are| have| stay|;|\.| with F\(K\))", text)
        assert not re.search(r"(in|on) V1 and V2", text)


def test_readings_are_no_stronger_than_the_words():
    """What the paper does not write is asked by rows of our own."""
    assert "almost every" not in ROWS["G4"]["statement"] + ROWS["G7"]["statement"]
    assert "full shift" not in ROWS["G5"]["statement"]
    assert "exactly" not in ROWS["R12"]["statement"]
    own = {claim for claim in CLAIMS if not row_of(claim).words}
    assert {"G10", "G11", "G12"} <= own
    assert "almost every" in ROWS["G10"]["statement"] and "full shift" in ROWS["G11"]["statement"]
    assert "almost every" in ROWS["G12"]["statement"]
