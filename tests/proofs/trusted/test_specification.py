"""CERTIFICATE.md says what every rule takes and infers, in the rules' own words."""

import re
from functools import cache
from pathlib import Path

import pytest

from proofs.check import main
from proofs.report.specification import specification, theorems
from proofs.trusted.rules import RULES

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
    assert {"`superstable_motion`", "`bounce`", "`settle`"} <= {x.split(":")[0] for x in bounces}
