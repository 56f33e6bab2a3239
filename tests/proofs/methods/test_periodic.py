"""All periodic orbits in a region: closed forms, other algorithms, and what stays undecided."""

import math
from fractions import Fraction
from itertools import pairwise, product

import numpy as np
import pytest

from intervals import DomainError, Interval, IntervalArray, Undecided
from intervals.jet import Jet
from proofs.methods.cells import Region, invariant_cover
from proofs.methods.periodic import periodic_orbits


def logistic(x):
    return 5 * x * (1 - x)


def on_line(f, low, high, g=None, depth=10):
    return invariant_cover(f, Region((Interval(low, high),), g), depth=depth)


LOGISTIC = on_line(logistic, -1, 2)


@pytest.mark.parametrize("period", [1, 2, 3, 4, 6])
def test_all_points_of_the_logistic_map_by_its_inverse_branches(period):
    """The same points as those of the words, found without any subdivision."""
    points = []
    for signs in product((-1, 1), repeat=period):
        x = 0.5
        for sign in signs * (60 // period):
            x = (1 + sign * (1 - 0.8 * x) ** 0.5) / 2
        points.append(x)
    orbits = periodic_orbits(LOGISTIC, period)
    ends = sorted((x.inf, x.sup) for orbit in orbits for (x,) in orbit.points)
    for (low, high), point in zip(ends, sorted(points), strict=True):
        assert low - 1e-14 <= point <= high + 1e-14 and high - low < Fraction(1, 10**11)
    for orbit in orbits:  # 5 - 10 x is the slope at x
        assert period % orbit.period == 0
        slopes = math.prod(5 - 10 * x for (x,) in orbit.points)
        assert orbit.trace.intersection(slopes) is not None and orbit.trace.wid < 1e-6
        for (x,), (image,) in pairwise(orbit.points):
            assert (logistic(x) - image).contains(0)
    assert [o.period for o in orbits] == sorted(o.period for o in orbits)


def linear_horseshoe(x, y):
    """(3x - 2, y/4 + 1/2) for x > 0, (-3x - 2, y/4 - 1/2) for x < 0."""
    value = x.value if isinstance(x, Jet) else x
    if np.any(value.contains_zero()):
        raise DomainError("x = 0")
    if isinstance(value, Interval):
        sign = Interval(1 if value.inf > 0 else -1)
    else:
        sign = IntervalArray.from_floats(np.sign(value.mid))
    return [x * sign * 3 - 2, y / 4 + sign / 2]


def linear_point(signs):
    """The fixed point of a composition of the two affine maps, in fractions."""
    a, b, c, d = Fraction(1), Fraction(0), Fraction(1), Fraction(0)
    for sign in signs:
        a, b = 3 * sign * a, 3 * sign * b - 2
        c, d = c / 4, d / 4 + Fraction(sign, 2)
    return b / (1 - a), d / (1 - c)


@pytest.mark.parametrize("period", [1, 2, 3, 4])
def test_the_linear_horseshoe(period):
    square = Interval(-2, 2)
    strips = Region((square, square), lambda x, y: [x.sqr() - Fraction(1, 25)])
    orbits = periodic_orbits(invariant_cover(linear_horseshoe, strips), period)
    found = [p for orbit in orbits for p in orbit.points]
    expected = [linear_point(signs) for signs in product((1, -1), repeat=period)]
    assert len(found) == len(expected) == 2**period
    for point in expected:
        (box,) = [p for p in found if p[0].contains(point[0]) and p[1].contains(point[1])]
        assert max(side.wid for side in box) < Fraction(1, 10**10)
    for orbit in orbits:
        (a, b), (c, d) = orbit.derivative
        assert abs(a).contains(3**orbit.period) and d.contains(Fraction(1, 4**orbit.period))
        assert max(b.mag, c.mag) < Fraction(1, 10**300)


@pytest.mark.slow
def test_three_dimensions():
    """A product of x -> 5x(1-x), y -> y/2 + x, and z -> z^2 + 1/5: 2 2^n points."""

    def f(x, y, z):
        return [logistic(x), y / 2 + x, z.sqr() + Fraction(1, 5)]

    box = (Interval(-1, 2), Interval(-3, 4), Interval(-1, 1))
    cover = invariant_cover(f, Region(box), depth=4)
    for period in (1, 2):
        points = [p for orbit in periodic_orbits(cover, period) for p in orbit.points]
        assert len(points) == 2 * 2**period
        for x, _, z in points:
            assert (z.sqr() - z + Fraction(1, 5)).contains(0)
            after = x
            for _ in range(period):
                after = logistic(after)
            assert (after - x).contains(0)


def test_boxes_that_are_cut_beside_a_point():
    """z = z^2 + 1/5 is enclosed long before x: the boxes of uniqueness would be too narrow in z."""
    box = (Interval(-1, 2), Interval(-1, 1))
    cover = invariant_cover(
        lambda x, z: [logistic(x), z.sqr() + Fraction(1, 5)], Region(box), depth=4
    )
    assert sum(orbit.period for orbit in periodic_orbits(cover, 4)) == 2 * 2**4


def test_the_orbit_is_in_the_region_not_its_point_alone():
    """Without the surroundings of 4/5; without 0.946, the other point of the cycle of period 2."""
    without = on_line(logistic, -1, 2, lambda x: [(x - Fraction(4, 5)).sqr() - Fraction(1, 10**4)])
    (zero,) = periodic_orbits(without, 1)
    assert zero.points[0][0].contains(0)
    below = on_line(logistic, -1, "15/16")
    assert [o.period for o in periodic_orbits(below, 2)] == [1, 1]
    assert [o.period for o in periodic_orbits(LOGISTIC, 2)] == [1, 1, 2]


def test_images_beyond_the_domain():
    """5 x (1 - x) written so that it is not defined for x > 1: orbits in R stay below 0.98."""
    partial = on_line(lambda x: 5 * x * (1 - x).sqrt().sqr(), "0.1", "0.98", depth=3)
    for period in (1, 3):
        expected = [
            orbit
            for orbit in periodic_orbits(LOGISTIC, period)
            if all(x.inf > Fraction("0.1") and x.sup < Fraction("0.98") for (x,) in orbit.points)
        ]
        found = periodic_orbits(partial, period)
        assert [o.period for o in found] == [o.period for o in expected]
        for one, two in zip(found, expected, strict=True):
            assert one.points[0][0].intersection(two.points[0][0]) is not None


@pytest.mark.parametrize(
    ("f", "low", "high", "period", "reason"),
    [
        (logistic, 0, 1, 1, "boundary of the region"),
        (logistic, -1, "4/5", 1, "boundary of the region"),
        (lambda x: x.sqr() + Fraction(1, 4), -2, 2, 1, "whether there is a periodic point in"),
        (lambda x: -x, -1, 1, 2, "whether there is a periodic point in"),
        (lambda x: 1 * x, -1, 1, 1, "whether there is a periodic point in"),
    ],
)
def test_undecided(f, low, high, period, reason):
    """A point at an end; a double root at 1/2; fixed points that are not isolated."""
    with pytest.raises(Undecided, match=reason):
        periodic_orbits(on_line(f, low, high), period, limit=20_000)
