"""Values for all parameters of a box: those at single parameters, of maps read anew, are inside."""

from fractions import Fraction
from random import Random

import pytest

from proofs import Map, System
from proofs.trusted.kernel.enclose import enclosed, point_box
from proofs.trusted.kernel.parametric import moved, ranges_of
from proofs.trusted.kernel.periodic import Closing

BITS = 128


def henon(**parameters):
    return Map("1 - a*x^2 + y", "b*x", **parameters)


def ball(**parameters):
    return System.example("bouncing-ball", **parameters)


def walls(**parameters):
    return System.example("two-walls", **parameters)


CASES = {
    "formula": (henon, {"a": ("1.3", "1.4"), "b": ("0.2", "0.3")}, ("0.6", "0.2"), 0),
    "flight": (ball, {"g": ("0.099", "0.101"), "e": ("0.45", "0.5")}, ("0.34", "2.8"), 0),
    "walls": (walls, {"k": ("0.499", "0.501"), "e": ("0.898", "0.9")}, ("0.3", "-0.83"), 0),
    "orbit": (henon, {"a": ("1.39", "1.4"), "b": ("0.29", "0.3")}, ("0.6", "0.2"), 3),
    "orbit of flights": (ball, {"g": ("0.0999", "0.1001")}, ("0.34", "2.8"), 2),
    "orbit of walls": (walls, {"k": ("0.49999", "0.50001")}, ("0.3", "-0.83"), 2),
}


def subject(made, power):
    map_ = made._kernel
    return Closing(map_, power, (0,) * len(map_.circles)) if power else map_


@pytest.mark.parametrize(
    "name", [pytest.param(x, marks=[pytest.mark.long] * (x == "orbit of walls")) for x in CASES]
)
def test_values_at_each_parameter_are_inside(name):
    made, ranges, state, power = CASES[name]
    rng = Random(name)
    x = enclosed(point_box(list(map(Fraction, state))), BITS)
    wide = subject(made(**ranges), power)
    assert ranges_of(wide)
    row = enclosed(point_box([Fraction(rng.randint(-9, 9), 7) for _ in state]), BITS)
    low, high = moved(wide, x).combined(row).range
    plain = sum((a * b for a, b in zip(row, wide.values(x), strict=True)), row[0] * 0).range
    assert high - low < 2 * (plain[1] - plain[0])  # no nonsense
    for share in (0, 1, Fraction(rng.randint(1, 99), 100)):
        at = {
            each: Fraction(a) + share * (Fraction(b) - Fraction(a))
            for each, (a, b) in ranges.items()
        }
        values = subject(made(**at), power).values(x)
        one, two = sum((a * b for a, b in zip(row, values, strict=True)), row[0] * 0).range
        assert low <= one and two <= high


def test_correlations_survive():
    """x' = x + p, y' = y + p: of the difference of both nothing moves, p in [0, 1]."""
    made = Map("x + p", "y + p", variables=["x", "y"], p=("0", "1"))._kernel
    x = enclosed(((Fraction(1),) * 2, (Fraction(2),) * 2), BITS)
    row = enclosed(point_box((Fraction(1), Fraction(-1))), BITS)
    assert moved(made, x).combined(row).range == (-1, -1)


def test_an_orbit_for_all_parameters_of_a_box():
    """The stable impact of period 1 of the ball: cos(phi) = pi g (1 - e) / (1 + e)."""
    sides = {"g": ("0.798", "0.802"), "e": ("0.498", "0.502")}
    (orbit,) = ball(**sides).stable(1)
    assert orbit.stability == "attracting"
    low, high = map(float, orbit.box[0])
    assert 0.55 < low < 0.57763 < high < 0.61


def test_a_horseshoe_for_all_parameters_of_a_box():
    pytest.importorskip("numpy")
    theorem = henon(a=("5", "5.02"), b=("0.29", "0.3")).horseshoe(
        {"x": ("-2", "2"), "y": ("-1", "1")}
    )
    assert "for all `a` in [5, 5.02], for all `b` in [0.29, 0.3]" in theorem.conclusion.sentence
