"""What the ledger says carries its hypotheses: a phrase that is dropped makes a sentence false.

Each has a counterexample, named in the comment or in the tests of its section.
"""

import json
import re
from dataclasses import dataclass, replace
from fractions import Fraction as F
from functools import cache
from pathlib import Path

import pytest

from proofs.check import main
from proofs.commands.ledger import CLAIMS
from proofs.report.specification import specification, theorems
from proofs.shell.groups import row_of
from proofs.trusted.kernel.conclusion import About, Conclusion
from proofs.trusted.numbers import covered
from proofs.trusted.parameters import PAPER, Place
from proofs.trusted.rules import RULES
from proofs.trusted.verdicts import Found, Row, Verdict, decided, told, undecided

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


# -- how decisions are told, and the small predicates on intervals ---------------------------------


@dataclass(frozen=True)
class Said(Conclusion):
    text: str
    at: Place | None = None

    @property
    def sentence(self):
        return self.text


def test_later_sentences_begin_with_a_capital_unless_with_a_symbol():
    here, other = PAPER.place, Place.plastic(F(1, 2), F(-1, 2))
    known = [Said("the mass sticks.", here), Said("f is C^1.", here), Said("let x = 1.", here)]
    assert told(known) == ("At (eta, nu) = (0.2121, -0.2): the mass sticks. f is C^1. Let x = 1.")
    known = [Said("every phase flies.", other), Said("since 1 < 2, so it is."), Said("phi_s = 1.")]
    assert told(known) == (
        "At (eta, nu) = (0.5, -0.5): every phase flies. Since 1 < 2, so it is. phi_s = 1."
    )
    assert told([Said("a."), Said("a.")]) == "a."
    assert told([]) == ""


def test_why_says_of_which_oscillator_a_witness_is_unless_it_is_the_claims():
    here, other = PAPER.place, Place.plastic(F(1, 2), F(-1, 2))
    because = Said("f'(1) is 2.", here), Said("f'(2) is 3.", other), Said("1 < 2.")
    assert decided(Verdict.REFUTED, *because)._replace(of=PAPER).why == (
        "f'(1) is 2; at (eta, nu) = (0.5, -0.5): f'(2) is 3; 1 < 2"
    )


@dataclass(frozen=True)
class Part(Conclusion):
    of: Conclusion
    at = About("of")


@dataclass(frozen=True)
class Misnamed(Conclusion):
    of: Conclusion
    at = About("off")


def test_a_conclusion_about_a_part_is_never_about_all_oscillators():
    """No place would mean: true of every oscillator."""
    here = Said("the mass sticks.", PAPER.place)
    assert Part(here).place == Part(Part(here)).place == PAPER.place
    for made in (Misnamed(here), Part(Misnamed(here)), Part(Conclusion())):
        with pytest.raises(TypeError, match="no oscillators"):
            Found(PAPER, [made])


def test_what_is_about_rebounds_says_nothing_where_no_restitution_is_given():
    eta, nu, epsilon = PAPER.box.sides
    plastic = replace(PAPER, epsilon=None, reach=None)
    assert PAPER.box.holds(PAPER) and not PAPER.box.holds(plastic)
    assert PAPER.place.holds(PAPER) and PAPER.place.holds(plastic)
    assert PAPER.place.inside(Place(eta, nu, (F(0), F(0)))) and not PAPER.place.inside(PAPER.box)
    for other in (Place(eta, nu, (epsilon[0], F("0.009"))), Place((eta[0],) * 2, nu, epsilon)):
        assert not other.holds(PAPER) and other.inside(PAPER.box)


@pytest.mark.every
@pytest.mark.parametrize(
    ("parts", "whether"),
    [
        ([(0, 3)], True),
        ([(0, 1), (1, 2)], True),
        ([(0, 1), (F("1.1"), 2)], False),
        ([(F("0.1"), 2)], False),
        ([(0, F("1.9"))], False),
        ([(0, 2), (0, 1)], True),
        ([], False),
    ],
)
def test_an_interval_is_covered_by_others_without_a_gap(parts, whether):
    assert covered((F(0), F(2)), parts) is whether


def test_printed_numbers_are_asked_about_at_their_oscillator_alone():
    row = Row("Z1", "", "", "", lambda of, found: undecided(""), printed_at=PAPER.place)
    assert row.is_asked(PAPER) and not row.is_asked(replace(PAPER, eta=F(1, 2)))
    assert replace(row, printed_at=None).is_asked(replace(PAPER, eta=F(1, 2)))


# -- CERTIFICATE.md says what every rule takes and infers ------------------------------------------


PAGE = Path(__file__).parents[3] / "proofs/trusted/CERTIFICATE.md"
page = cache(specification)


def test_the_page_is_made_from_the_docstrings(capsys):
    assert PAGE.read_text() == page(), "python -m proofs.report.specification"
    assert main(["--rules"]) == 0
    assert capsys.readouterr().out == page()


@pytest.mark.parametrize("name", RULES)
def test_every_rule_has_its_proof(name):
    """In its own section, or in that of a theorem that it names and that stands there."""
    section = "\n\n".join(theorems(name))
    assert re.search(r"\bProof\b", section) and "onclu" in section
    assert section in page().partition(f"### `{name}`\n")[2].partition("\n### ")[0]


def test_a_theorem_that_is_named_stands_below_the_rule():
    told = theorems("staying-set")
    assert len(told) == len(set(told)) and told[1].startswith("`staying_set`: Theorem. ")
    bounces = theorems("superstable-motion")  # names a theorem, whose hypotheses name others
    assert {"`superstable_motion`", "`bounce`", "`rest_phase`"} <= {
        x.split(":")[0] for x in bounces
    }
