"""Branches of fixed points, folds and flips: against closed forms of maps, and of a ball."""

import math
from fractions import Fraction

import pytest

from intervals import Undecided
from proofs import Map, System
from proofs.commands.system import main
from proofs.trusted.verify import check


def points(arc, count=5):
    """Boxes of an arc at values of its axis; the axis' value first."""
    arc = getattr(arc, "arc", arc)  # of flights
    low, high = arc.ends
    for k in range(count):
        x = low + (high - low) * k / (count - 1)
        piece = next(p for p in arc.pieces if p.box[arc.axis][0] <= x <= p.box[arc.axis][1])
        yield float(x), [tuple(map(float, side)) for side in piece.cut(arc.axis, x)]


def logistic():
    made = Map("r*x*(1 - x)", r="3")
    made.box = {"x": ("0", "1")}
    return made


def test_branches_of_the_logistic_map():
    theorem = logistic().branches(r=("2", "4"))
    assert len(theorem) == 2 and check(theorem.certificate).conclusions
    for arc, root in zip(theorem, (lambda r: 0, lambda r: 1 - 1 / r), strict=True):
        assert arc.ends == (2, 4)
        for r, ((low, high), _) in points(arc):
            assert low < root(r) < high < low + 0.1


@pytest.mark.parametrize(
    ("kind", "closed", "sides"),
    [
        ("folds", lambda b: -((1 - b) ** 2) / 4, ("-0.5", "0.5")),
        ("flips", lambda b: 3 * (1 - b) ** 2 / 4, ("0.1", "1")),
    ],
)
def test_folds_and_flips_of_henon(kind, closed, sides):
    henon = Map("1 - a*x^2 + y", "b*x", a="1", b="0.3")
    (arc,) = getattr(henon, kind)(a=sides, b=("0.1", "0.4"))
    assert arc.ends == (Fraction("0.1"), Fraction("0.4"))
    for b, (_, _, (low, high), _) in points(arc):
        assert low < closed(b) < high < low + 0.05


@pytest.mark.slow
def test_a_branch_and_its_fold_of_a_flight():
    """cos(phi) = pi g (1 - e)/(1 + e) at an impact a period: none where that is above 1."""
    ball = System.example("bouncing-ball", g="0.8", e="0.5")
    for arc in ball.branches(g=("0.7", "0.72")):
        for g, ((low, high), *_) in points(arc, 3):
            assert math.cos(low) > math.pi * g / 3 > math.cos(high) or (
                math.cos(low) < math.pi * g / 3 < math.cos(high)
            )
    (arc,) = ball.folds(g=("0.8", "1"), e=("0.45", "0.46"))
    assert arc.function.variables == ("phi", "v", "g", "ee")  # no variable is named e
    for e, (_, _, (low, high), *_) in points(arc, 3):
        assert low < (1 + e) / (math.pi * (1 - e)) < high < low + 0.01


@pytest.mark.parametrize(
    ("ask", "reason"),
    [
        (lambda: logistic().branches(q=("1", "2")), "none of the parameters"),
        (lambda: logistic().folds(r=("1", "2")), "2 parameters"),
        (lambda: logistic().branches(), "1 parameters"),
        (lambda: logistic().branches(r=("2", "1")), "reversed"),
        (lambda: System.example("two-walls").branches(k=("0.4", "0.5")), "one wall"),
        (lambda: Map("x + p", p="1").branches(p=("1", "2")), "no curve is followed"),
    ],
)
def test_what_is_not_followed_is_a_sentence(ask, reason):
    with pytest.raises((ValueError, Undecided), match=reason):
        ask()


def test_the_command(tmp_path, capsys):
    own = ["--map", "r*x*(1 - x)", "--set", "r=3", "--box", "x=0:1", "--out", str(tmp_path)]
    assert main([*own, "--ask", "branches:r=2:4"]) == 0
    assert "the graph of a smooth function of `r` in [2, 4]" in capsys.readouterr().out
    assert check((tmp_path / "branches-r-2-4.json").read_text()).conclusions
