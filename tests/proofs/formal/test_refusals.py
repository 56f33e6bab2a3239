"""False theorems: coqc refuses each, at the lemma where it is false, for the reason expected."""

import pytest

from tests.proofs.formal.coq import edited, in_lemma, needs_coqc, paper_case, stops_at

LO, HI = "(43 / 10)", "(619 / 100)"
NUMERICAL, LINEAR = "Numerical evaluation failed", "No applicable tactic"
WITNESS = "Cannot find witness"


def everywhere(*edits):
    """Change numbers in the whole file, hypotheses and theorems alike."""
    return lambda text: edited(text, *edits)


def only_in(name, *edits):
    """Change one lemma alone."""
    return lambda text: in_lemma(text, name, *edits)


# what is false, how it is made, where coqc stops, and what it says there
FALSE = {
    "f' <= 6.18": (everywhere((HI, "(618 / 100)")), "piece0_", NUMERICAL),
    "f' >= 4.31": (everywhere((LO, "(431 / 100)")), "piece1_", NUMERICAL),
    "f' <= 5.25 at 1.13": (
        only_in("H2_refuted", ("(21 / 4) < d", "(53 / 10) < d")),
        "H2_refuted",
        "",
    ),
    "f' >= 4.2 as f' >= 4.8": (
        only_in("H1_verified", ("(21 / 5) <= d", "(24 / 5) <= d")),
        "H1_",
        "",
    ),
    "I0 from 1.11": (everywhere(("(11 / 10)", "(111 / 100)")), "covers_horseshoe0", ""),
    "I0 up to 1.14": (everywhere(("(23 / 20)", "(57 / 50)")), "", ""),
    "I1 from 1.28": (everywhere(("(127 / 100)", "(128 / 100)")), "", ""),
    "I1 up to 1.30": (everywhere(("(33 / 25)", "(130 / 100)")), "", ""),
    "eta = 0.2131": (everywhere(("2121 / 10000", "2131 / 10000")), "", NUMERICAL),
    "eta = 0.21": (everywhere(("2121 / 10000", "2100 / 10000")), "", NUMERICAL),
    "nu = -0.21": (everywhere(("nu := (- 1 / 5)", "nu := (- 21 / 100)")), "", NUMERICAL),
    "nu = 0.2": (everywhere(("nu := (- 1 / 5)", "nu := (1 / 5)")), "launch0_0", NUMERICAL),
    "the mass below the table": (everywhere(("side := -1", "side := 1")), "launch0_0", NUMERICAL),
    "branches swapped": (
        only_in(
            "corrected_theorem",
            (
                "(11 / 10) (23 / 20) (127 / 100) (33 / 25)",
                "(127 / 100) (33 / 25) (11 / 10) (23 / 20)",
            ),
        ),
        "corrected_theorem",
        "",
    ),
    "f decreases on I0": (
        only_in("corrected_theorem", ("(33 / 25) (1) (1)", "(33 / 25) (-1) (1)")),
        "corrected_theorem",
        "",
    ),
    "f increases on I0 by its sign alone": (
        everywhere(("(23 / 20) (1) (43 / 10)", "(23 / 20) (-1) (43 / 10)")),
        "monotone_horseshoe0",
        "",
    ),
    "H3 for a decreasing lift": (
        only_in("H3_verified", ("F x < F y", "F y < F x")),
        "H3_verified",
        WITNESS,
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
    "images one lap later": (only_in("lap0", ("4.", "5.")), "lap0", ""),
    "s_0 = 0.448": (
        only_in("H11_verified", ("(44899 / 100000)", "(448 / 1000)")),
        "H11_verified",
        "",
    ),
    "H16 where the ratios fill the line": (
        only_in("H16_verified", ("(2381 / 10000)", "(9 / 10)")),
        "H16_verified",
        "",
    ),
    "no word 111": (
        only_in("no_word_000", ("fun _ => false", "fun _ => true")),
        "no_word_000",
        "",
    ),
    "a flight without its end": (
        everywhere(("Lemma end0_0", "Lemma end0_1")),
        "branch0_0",
        "end0_0",
    ),
}
QUICK = ("the mass below the table", "nu = -0.21")


@needs_coqc
@pytest.mark.slow
@pytest.mark.parametrize("false", QUICK)
def test_a_false_theorem_is_refused(tmp_path, theory, false):
    refuses(tmp_path, theory, false)


@needs_coqc
@pytest.mark.long
@pytest.mark.parametrize("false", [each for each in FALSE if each not in QUICK])
def test_every_false_theorem_is_refused(tmp_path, theory, false):
    refuses(tmp_path, theory, false)


def refuses(folder, theory, false):
    """coqc stops at the lemma that is false, for the reason expected."""
    change, expected, reason = FALSE[false]
    lemma, message = stops_at(theory, folder, change(paper_case().text))
    print(f"{false}: {message}")
    assert lemma.startswith(expected) and reason in message, message
