"""What a claim needs: calls, counted in prover and checker, and files; what its page speaks of."""

import sys
from collections import Counter
from contextlib import contextmanager
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest

from intervals.cover import cover
from proofs import check as checker
from proofs import horseshoe
from proofs.__main__ import main
from proofs.methods.basin import Mesh
from proofs.methods.derive import simplest
from proofs.report import page
from proofs.shell import groups
from proofs.shell.groups import row_of
from proofs.shell.trust import trusted_for
from proofs.trusted import rules
from proofs.trusted.equations import gap, return_map_derivative, slope
from proofs.trusted.kernel.expression import Tape
from proofs.trusted.kernel.meter import DEFAULT
from proofs.trusted.paper import GROUPS
from proofs.trusted.parameters import PAPER
from proofs.trusted.verify import check
from tests.proofs.trusted.corpus import path_of

WATCHED = gap, slope, return_map_derivative, cover, simplest, Mesh.grow, Tape.evaluate
STEPS = rules.find_rule
FLIGHTS = {gap: 2400, cover: 6, slope: 25}
SLOPES = {gap: 1200, slope: 40}
FLOWN = {gap: 2500, return_map_derivative: 8}
NEEDED = [  # group, claims, the most calls in a proof, steps of the certificate
    ("horseshoe", "H16", {}, 0),
    ("foundations", "A2", {}, 0),
    ("sets", "H15 H17", {}, 0),
    ("sets", "H12 H14", {}, 2),
    ("foundations", "M4", {Tape.evaluate: 5}, 5),
    ("horseshoe", "H4", FLIGHTS, 1),
    ("horseshoe", "H1", SLOPES, 2),
    ("horseshoe", "H1 H3 H6 H11 H16", SLOPES, 4),  # steps that several need are made once
    ("circle", "G1", {gap: 160}, 1),  # an orbit of period 2: no cells of the circle
    ("horseshoe", "N2", FLOWN, 2),  # no plastic map
]


@contextmanager
def calls(*functions):
    """Count the calls inside the `with`, by qualified name."""
    counts = Counter()
    names = {function.__code__: function.__qualname__ for function in functions}

    def observe(frame, event, _):
        if event == "call" and frame.f_code in names:
            counts[names[frame.f_code]] += 1

    before = sys.getprofile()
    sys.setprofile(observe)
    try:
        yield counts
    finally:
        sys.setprofile(before)


@pytest.mark.parametrize("group, claims, most, steps", NEEDED, ids=lambda x: str(x)[:16])
def test_only_what_is_needed_is_computed(group, claims, most, steps):
    with calls(*WATCHED, STEPS) as proving:
        asked = groups.wanted(group, PAPER, claims.split())
        made = groups.produce(asked, PAPER, digits=30)
    with calls(*WATCHED, STEPS) as checking:
        check(made.certificate)
    allowed = {function.__qualname__: number for function, number in most.items()}
    assert proving.pop("find_rule", 0) == checking.pop("find_rule", 0) == steps
    assert set(proving) == set(allowed) >= set(checking)
    assert all(0 < proving[name] <= most for name, most in allowed.items()), proving


# -- what a claim rests on -------------------------------------------------------------------------


REPORTS = Path(__file__).parents[3] / "reports"


def files(path):
    trust = trusted_for(path.read_text(), DEFAULT)
    return {each.claim: {name for name, _ in each.files} for each in trust}


@pytest.mark.slow
def test_a_claim_rests_on_what_its_steps_call():
    rests = files(REPORTS / "horseshoe.json")
    assert len(rests) == 10
    assert "slopes.py" in rests["H1"] and "slopes.py" not in rests["H16"]
    assert "kernel/rectangles.py" in rests["N1"] and "oscillator.py" in rests["N1"]
    assert not any("s33" in name for name in rests["H1"] | rests["H16"])


@pytest.mark.slow
def test_own_maps_rest_on_the_kernel_alone():
    for rests in files(path_of("lemmas/accepted/ball")).values():
        assert "kernel/flight.py" in rests
        assert not any(x.startswith("paper/s") or x == "equations.py" for x in rests)


def test_lines_are_counted_and_a_list_is_refused(tmp_path, capsys):
    assert checker.main([str(path_of("accepted/h11_alone")), "--trust"]) == 0
    said = capsys.readouterr().out
    assert said.startswith("H11: to believe this, ") and said.count("\n") == 1
    assert horseshoe.main(["--only", "H16", "--quiet", "--out", str(tmp_path)]) == 0
    assert checker.main([str(tmp_path / "MANIFEST.json"), "--trust"]) == 2
    assert checker.main(["nowhere.json", "--trust"]) == 2


# -- what a command's claims are about -------------------------------------------------------------


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
