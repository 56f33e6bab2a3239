"""Curves of grazes of the published wall: against closed forms, and simulated."""

import random

import pytest

from intervals import Undecided
from proofs import System
from proofs.commands.system import main
from proofs.trusted.verify import check
from tests.oracles.judge import oracle
from tests.proofs.methods.test_branches import points

WALL = System.example("wall")


def amplitude(w):
    """Of the oscillation that is forced."""
    return ((401 / 400 - w * w) ** 2 + w * w / 100) ** -0.5


@pytest.mark.parametrize(
    "ranges",
    [{"d": ("0.05", "0.4"), "w": ("2.5", "3")}, {"w": ("2.5", "3"), "d": ("0.13", "0.19")}],
)
def test_the_forced_oscillation_grazes_where_the_wall_is_at_its_amplitude(ranges):
    (curve,) = WALL.grazing(**ranges)
    names = curve.function.variables
    assert names[curve.arc.axis] == [*ranges][1]
    for _, sides in points(curve):
        place = dict(zip(names, sides, strict=False))
        (low, high), (first, last) = place["d"], place["w"]
        assert low < amplitude(first) + 1e-9 and amplitude(last) - 1e-9 < high
        assert high < low + 0.02 and last < first + 0.05
    assert oracle(curve, random.Random(0)) == []


def test_launches_before_a_graze():
    theorem = WALL.touching(v=("-1", "-0.05"), a="0.3", d=("0", "0.1"))
    assert check(theorem.certificate).conclusions
    ((low, high), _, _) = theorem.conclusion.arc.pieces[0].cut(1, 0)
    assert low < WALL.graze(a="0.3", v=("-0.3", "-0.1")).conclusion.box[1][0] < high
    assert oracle(theorem.conclusion, random.Random(0)) == []


@pytest.mark.parametrize(
    ("ask", "error", "reason"),
    [
        (lambda: WALL.touching(a="0.3", v="-1"), ValueError, "two ranges are expected"),
        (lambda: WALL.touching(a=("0", "1"), d=("0", "1")), ValueError, "each variable is expect"),
        (lambda: WALL.touching(a=("2", "3"), v=("-3", "-2")), Undecided, "no graze is seen"),
        (lambda: WALL.grazing(d=("3", "4"), w=("2", "3")), Undecided, "no graze is seen"),
        (lambda: WALL.grazing(d=("0", "1")), ValueError, "2 parameters"),
        (
            lambda: System.example("duffing-wall").touching(a="1", v=("-2", "-1"), d=("0", "1")),
            Undecided,
            "closed form",
        ),
    ],
)
def test_what_is_not_followed_is_a_sentence(ask, error, reason):
    with pytest.raises(error, match=reason):
        ask()


def test_the_command(tmp_path, capsys):
    ask = ["--ask", "grazing:d=0.1:0.2,w=2.5:2.6", "touching:a=0.3,v=-1:-0.1,d=0:0.05"]
    assert main(["--example", "wall", "--out", str(tmp_path), *ask]) == 0
    assert capsys.readouterr().out.count("This is its first impact, a graze") == 2
    assert len([*tmp_path.glob("*.json")]) == 2
