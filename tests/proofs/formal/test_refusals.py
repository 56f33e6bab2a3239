"""False theorems: coqc refuses each, at the lemma where it is false, for the reason expected."""

import re
from dataclasses import replace
from fractions import Fraction

import pytest

from proofs.formal.cases import case
from proofs.formal.plan import plan
from tests.proofs.formal.coq import PAPER, edited, in_lemma, needs_coqc, paper_case, stops_at

LO, HI = "(43 / 10)", "(619 / 100)"
NUMERICAL, LINEAR = "Numerical evaluation failed", "No applicable tactic"
UNIFY, COMPUTED = "Unable to", "while it is expected to have type"


def everywhere(*edits):
    """Change numbers in the whole file, hypotheses and theorems alike."""
    return lambda text: edited(text, *edits)


def only_in(name, *edits):
    """Change one lemma alone."""
    return lambda text: in_lemma(text, name, *edits)


def with_parameters(**numbers):
    """Change parameters as they are stated, and in the data on flights that Coq computes with."""
    parameters = {"side": -1, "eta": Fraction("0.2121"), "nu": Fraction("-0.2"), **numbers}

    def data(found):
        eta, nu = (int(parameters[name] * int(found[2])) for name in ("eta", "nu"))
        return f"computed_branch {found[1]} {found[2]} ({parameters['side']}) {eta} ({nu})"

    def change(text):
        for name, value in parameters.items():
            text = re.sub(rf"Definition {name} := .*", f"Definition {name} := {value}.", text)
        return re.sub(r"computed_branch (\d+) (\d+) \(-1\) \d+ \(-?\d+\)", data, text)

    return change


def without_fall(text):
    """Leave out the last steps of the first flight."""
    runs = r"\[[^]]*\]"
    edited, count = re.subn(rf"(Cut \(\d+\) \(\d+\) {runs} {runs}) {runs}", r"\1 []", text, count=1)
    assert count == 1
    return edited


def with_sets(**sets):
    """Write the file anew for other sets of the horseshoe."""

    def change(text):
        asked = plan(PAPER.read_text())
        false = replace(asked, headline=replace(asked.headline, **sets))
        return case(false, "0").text

    return change


def in_escape(*edits):
    """Change the phases that are said to leave I."""

    def change(text):
        for name in ("escape0_launch", "escape0_below", "escape0"):
            text = in_lemma(text, name, *edits)
        return text

    return change


SETS = "(11 / 10) (23 / 20) (127 / 100) (33 / 25)"
SWAPPED = "(127 / 100) (33 / 25) (11 / 10) (23 / 20)"

# what is false: how it is made, where coqc stops, and what it says there
FALSE = {
    "f' <= 6.18": (everywhere((HI, "(618 / 100)")), "piece0_4", NUMERICAL),
    "f' >= 4.31": (everywhere((LO, "(431 / 100)")), "piece1_0", NUMERICAL),
    "f'(1.13) > 5.3": (
        only_in("H2_refuted", ("(21 / 4) < d", "(53 / 10) < d")),
        "H2_refuted",
        LINEAR,
    ),
    "f' >= 4.8 on the printed sets": (
        only_in("H1_verified", ("(21 / 5) <= d", "(24 / 5) <= d")),
        "H1_verified",
        LINEAR,
    ),
    "I0 from 1.11": (
        with_sets(left=(Fraction("1.11"), Fraction("1.15"))),
        "covers_horseshoe0",
        LINEAR,
    ),
    "I1 up to 1.3": (
        with_sets(right=(Fraction("1.27"), Fraction("1.3"))),
        "covers_horseshoe1",
        LINEAR,
    ),
    "the gap from 1.14 on leaves I": (in_escape(("(23 / 20)", "(57 / 50)")), "escape0", NUMERICAL),
    "the gap up to 1.28 leaves I": (
        in_escape(("(127 / 100)", "(128 / 100)")),
        "escape0_below",
        NUMERICAL,
    ),
    "eta = 0.2131": (with_parameters(eta=Fraction("0.2131")), "piece0_0", NUMERICAL),
    "eta = 0.21": (with_parameters(eta=Fraction("0.21")), "piece0_0", NUMERICAL),
    "nu = -0.21": (with_parameters(nu=Fraction("-0.21")), "piece0_0", NUMERICAL),
    "nu = -0.21, as stated alone": (
        everywhere(("nu := (-1 / 5)", "nu := (-21 / 100)")),
        "branch0_0",
        "not a valid field equation",
    ),
    "nu = 0.2": (with_parameters(side=1, nu=Fraction("0.2")), "branch0_0", COMPUTED),
    "the mass below the table": (everywhere(("side := -1", "side := 1")), "model", "No applicable"),
    "branches swapped": (only_in("corrected_theorem", (SETS, SWAPPED)), "corrected_theorem", UNIFY),
    "f decreases on I0": (
        only_in("corrected_theorem", ("(33 / 25) (1) (1)", "(33 / 25) (-1) (1)")),
        "corrected_theorem",
        UNIFY,
    ),
    "f decreases on I0, by its bounds": (
        everywhere(("(23 / 20) (1) (43 / 10)", "(23 / 20) (-1) (43 / 10)")),
        "monotone_horseshoe0",
        LINEAR,
    ),
    "H3 for a lift that decreases": (
        only_in("H3_verified", ("F x < F y", "F y < F x")),
        "H3_verified",
        LINEAR,
    ),
    "the gap leaves [1, 1.32]": (
        only_in("H4_verified", ("~ (111 / 100) <= psi", "~ 1 <= psi")),
        "H4_verified",
        "",
    ),
    "[1.11, 1.13] has no preimage in I0": (
        only_in("H5_refuted", ("28 / 25", "113 / 100")),
        "H5_refuted",
        "",
    ),
    "preimages shorter by 4.8": (
        only_in("H6_verified", ("(d - c) / (21 / 5)", "(d - c) / (24 / 5)")),
        "H6_verified",
        "",
    ),
    "images one lap later": (only_in("lap0", (" 4.", " 5.")), "lap0", LINEAR),
    "s_0 < 0.4489895": (
        only_in("H11_conditional", ("(44899 / 100000)", "(4489895 / 10000000)")),
        "H11_conditional",
        NUMERICAL,
    ),
    "H16 where the ratios fill the line": (
        only_in("H16_verified", ("(2381 / 10000)", "(9 / 10)")),
        "H16_verified",
        "",
    ),
    "no word 111": (
        only_in("no_word_000", ("fun _ => false", "fun _ => true")),
        "no_word_000",
        UNIFY,
    ),
    "a flight whose end is not shown": (without_fall, "branch0_0", COMPUTED),
}
QUICK = ("the mass below the table", "nu = -0.21")


@needs_coqc
@pytest.mark.slow
@pytest.mark.parametrize("false", QUICK)
def test_a_false_theorem_is_refused(tmp_path, proved, false):
    refuses(tmp_path, proved, false)


@needs_coqc
@pytest.mark.long
@pytest.mark.parametrize("false", [each for each in FALSE if each not in QUICK])
def test_every_false_theorem_is_refused(tmp_path, proved, false):
    refuses(tmp_path, proved, false)


def refuses(folder, proved, false):
    """coqc stops at the lemma that is false, for the reason expected."""
    change, expected, reason = FALSE[false]
    lemma, message = stops_at(proved, folder, change(paper_case().text))
    print(f"{false}: {message}")
    assert lemma.startswith(expected) and reason in message, message
