"""What a command's claims are about: its options, and what its page says of it."""

from dataclasses import replace
from fractions import Fraction

import pytest

from proofs.__main__ import main
from proofs.report import page
from proofs.shell.groups import row_of
from proofs.trusted.paper import GROUPS
from proofs.trusted.parameters import PAPER

ELSEWHERE = replace(PAPER, eta=Fraction(1, 2), nu=Fraction(-1, 3))


def text(group, of=ELSEWHERE):
    return page.page(group, of, {"claims": []}, [])


@pytest.mark.parametrize("group", GROUPS)
def test_a_page_speaks_of_parameters_only_where_its_statements_do(group):
    named = any("{" in row_of(claim).reading for claim in GROUPS[group])
    assert ("At parameters of your own." in text(group)) is named
    assert ("At the paper's parameters." in text(group, PAPER)) is named
    assert "by exact algebra and interval arithmetic" in text(group)


@pytest.mark.parametrize("group", ["single", "foundations"])
def test_what_is_about_the_parameters_given_names_them(group):
    assert "at (eta, nu) = (0.5, -1/3)." in text(group)


@pytest.mark.slow
@pytest.mark.parametrize("command", ["horseshoe", "sets", "dimension"])
def test_the_paper_s_sets_are_not_taken_elsewhere(command, tmp_path, capsys):
    options = ["--eta", "0.25", "--nu", "-0.3", "--out", str(tmp_path / "runs")]
    assert main([command, *options]) == 1
    said = capsys.readouterr()
    assert "UNDECIDED: no sets" in said.err and said.err.count("\n") == 1
    assert not said.out and not (tmp_path / "runs").exists()
