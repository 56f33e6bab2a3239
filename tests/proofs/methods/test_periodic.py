"""The witnesses of all periodic orbits in a box: where none can be written down.

What is found is counted in `trusted/kernel/test_periodic`, beside published and closed numbers.
"""

import pytest

from intervals import Undecided
from proofs import Map

LINE = {"x": ("-1", "2")}
SQUARE = {"x": ("-1", "1"), "y": ("-1", "1")}


@pytest.mark.parametrize(
    ("formulas", "period", "box"),
    [
        (["x"], 1, LINE),
        (["-x"], 2, LINE),
        (["-y", "x"], 4, SQUARE),
        (["x + 1/10^6"], 1, LINE),  # there is none, which would take millions of parts
        pytest.param(["x^2 + 1/4"], 1, LINE, marks=pytest.mark.slow),  # a double root at 1/2
    ],
)
def test_orbits_that_are_not_isolated(formulas, period, box):
    with pytest.raises(Undecided, match=r"not isolated|another periodic orbit"):
        map_ = Map(*formulas, variables=[*box])
        map_.effort = 1
        map_.periodic_orbits(period, box)


@pytest.mark.parametrize("high", ["4/5", "5/6"])
def test_an_orbit_with_a_point_outside_is_left_out(high):
    """The fixed points of 5 x (1 - x) are 0 and 4/5; its 2-cycle is in 0.446..., 0.946..."""
    box = {"x": ("-1", high)}
    logistic = Map("5*x*(1 - x)")
    if high == "4/5":
        with pytest.raises(Undecided, match=r"on the edge x = 0\.8 of the box"):
            logistic.periodic_orbits(2, box)
    else:
        assert logistic.periodic_orbits(2, box).conclusion.counts == ((1, 2),)


def test_images_beyond_the_domain():
    """5 x (1 - x), not defined for x > 1: the orbits are those of the parabola."""
    box = {"x": ("1/10", "99/100")}
    counts = [
        Map(text).periodic_orbits(3, box).conclusion.counts
        for text in ("5*x*(1 - x)", "5*x*sqrt(1 - x)^2")
    ]
    assert counts[0] == counts[1] and counts[0]


def test_points_next_to_a_double_root():
    """x^2 + 1/4 - e^2 has the fixed points 1/2 - e and 1/2 + e; x^2 + 1/4 + e^2 none."""
    box = {"x": ("-2", "2")}
    for term, count in (("- 1/10^6", ((1, 2),)), ("+ 1/10^6", ())):
        assert Map(f"x^2 + 1/4 {term}").periodic_orbits(1, box).conclusion.counts == count


def test_a_period_is_positive():
    with pytest.raises(ValueError, match="from 1 on"):
        Map("5*x*(1 - x)").periodic_orbits(0, LINE)


def test_a_box_has_an_inside():
    with pytest.raises(ValueError, match="a side of the box is a point"):
        Map("5*x*(1 - x)").periodic_orbits(1, {"x": ("1", "1")})
