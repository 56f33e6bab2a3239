"""The checker's arithmetic and Arb's agree on every leaf of a certificate."""

import json
import subprocess
import sys
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest

from proofs.search.s31_horseshoe import prove
from proofs.trusted import flights as rules
from proofs.trusted.certificate import render
from proofs.trusted.parameters import PAPER
from tests.proofs.trusted import second_kernels
from tests.proofs.trusted.second_opinion import opinions, summary, table

ROOT = Path(__file__).parents[3]
ACCEPTED = ROOT / "tests/certificates/accepted/horseshoe.json"


@pytest.fixture(scope="module")
def found():
    return list(opinions(ACCEPTED.read_text()))


def witnesses(rule):
    steps = json.loads(ACCEPTED.read_text())["steps"].values()
    return [step["witness"] for step in steps if step["rule"] == rule]


def test_every_inequality_is_a_leaf(found):
    """So many leaves as the certificate's data ask for, counted by hand."""
    count = dict.fromkeys(rules.RULES, 0)
    for opinion in found:
        count[opinion.leaf.rule] += 1
    flights = witnesses("first-impact")
    falling = sum(opinion.leaf.what.startswith("gap' < 0") for opinion in found)
    assert count["first-impact"] == sum(len(w["times"]) + 1 for w in flights) + falling
    slopes = witnesses("slope-range")
    assert count["slope-range"] == sum(4 * len(w["points"]) + 3 * len(w["pieces"]) for w in slopes)
    assert count["point"] == 4 * len(witnesses("point"))
    assert count["moran-root"] == 2 * len(witnesses("moran-root"))
    assert count["avoids"] >= sum(len(w["flights"]) for w in witnesses("avoids"))
    assert falling >= 3


def test_no_contradictions(found):
    assert [opinion.leaf for opinion in found if opinion.contradicted()] == []


def test_the_checker_decides_what_its_rules_need_and_leaves_open_what_it_must(found):
    for opinion in found:
        assert opinion.own is not None
        if opinion.leaf.needed:
            assert opinion.own[0] > 0, opinion.leaf
        elif opinion.leaf.what.startswith("closed"):
            assert opinion.own[0] <= 0, opinion.leaf


@pytest.mark.parametrize("bits", [128, 256])
def test_arb_decides_the_same_leaves(found, bits):
    assert [opinion.leaf for opinion in found if bits in opinion.differs()] == []


def test_at_53_bits_arb_decides_all_but_the_narrow_brackets(found):
    """Brackets of some 2^-115 are beyond binary64, and nothing else is."""
    for opinion in found:
        narrow = 0 < opinion.own[1] < Fraction(1, 2**100)
        assert (53 in opinion.differs()) == narrow, opinion.leaf


@pytest.mark.slow
@pytest.mark.parametrize(
    "changes",
    [
        {"eta": Fraction("0.23")},
        pytest.param({"nu": Fraction("-0.25")}, marks=pytest.mark.slow),
        pytest.param(
            {"interval": (Fraction(1), Fraction("1.32"))}, marks=pytest.mark.slow
        ),
        {"left": (Fraction("0.5"), Fraction("0.51")), "right": (Fraction("0.52"), Fraction("0.53")),
         "interval": (Fraction("0.5"), Fraction("0.53"))},
    ],
)  # fmt: skip
def test_no_contradictions_at_other_parameters(changes):
    text = render(prove(replace(PAPER, **changes)).certificate)
    for opinion in opinions(text, (256,)):
        assert not opinion.contradicted() and not opinion.differs(), opinion.leaf


@pytest.mark.parametrize("name", ["gap", "slope", "curvature", "image", "power"])
def test_a_wrong_kernel_is_noticed(monkeypatch, name):
    """A quantity of the checker's shifted by three widths contradicts Arb on some leaf."""
    right = getattr(second_kernels.Checker, name)

    def wrong(*arguments):
        low, high = right(*arguments)
        shift = 3 * (high - low) + Fraction(1, 2**20)
        return low + shift, high + shift

    monkeypatch.setattr(second_kernels.Checker, name, wrong)
    assert any(opinion.contradicted() for opinion in opinions(ACCEPTED.read_text(), (128,)))


def test_the_table_has_every_leaf(found):
    rows = table(found).splitlines()
    assert len(rows) == len(found) + 2 and rows[2].startswith("| first-impact | first-impact-1 |")
    told = summary(ACCEPTED.read_text(), found)
    assert f"{len(found)} leaves, 0 contradictions" in told
    assert all(f"\n{rule}: " in told for rule in rules.RULES)


@pytest.mark.slow
def test_the_command():
    done = subprocess.run(
        [sys.executable, "-m", "tests.proofs.trusted.second_opinion", str(ACCEPTED)],
        capture_output=True, text=True, cwd=ROOT, check=True,
    )  # fmt: skip
    assert "0 contradictions" in done.stdout and "| moran-root |" in done.stdout
