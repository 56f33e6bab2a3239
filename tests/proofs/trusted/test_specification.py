"""CERTIFICATE.md says what every rule takes and infers, in the rules' own words."""

from pathlib import Path

from proofs.check import main
from proofs.report.specification import specification
from proofs.trusted.rules import RULES

PAGE = Path(__file__).parents[3] / "proofs/trusted/CERTIFICATE.md"


def test_the_page_is_made_from_the_docstrings(capsys):
    assert PAGE.read_text() == specification(), "python -m proofs.report.specification"
    assert main(["--rules"]) == 0
    assert capsys.readouterr().out == specification()


def test_every_rule_is_there_with_its_theorem():
    page = specification()
    for name in RULES:
        section = page.partition(f"### `{name}`\n")[2].partition("\n### ")[0]
        assert "onclu" in section, name
