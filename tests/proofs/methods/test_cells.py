"""Cells that contain all full orbits: maps whose full orbits are known, and brute force."""

from fractions import Fraction
from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from intervals import Interval, IntervalArray
from proofs.methods.cells import Region, function_of, invariant_cover
from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.head import read_function

LINE = Region((Interval(-1, 1),))
PLANE = Region((Interval(-1, 1), Interval(-1, 1)))


def cells(cover):
    """The cells as exact boxes."""
    pairs = [zip(x.inf.tolist(), x.sup.tolist(), strict=True) for x in cover.cells]
    return [
        tuple((Fraction(low), Fraction(high)) for low, high in box)
        for box in zip(*pairs, strict=True)
    ]


def holds(cover, *point):
    """Whether some cell contains a point."""
    return any(
        all(low <= x <= high for (low, high), x in zip(box, point, strict=True))
        for box in cells(cover)
    )


@pytest.mark.parametrize("f", [lambda x: x / 2, lambda x: 2 * x, lambda x: -3 * x])
def test_zero_is_the_only_full_orbit_of_a_linear_map(f):
    found = cells(invariant_cover(f, LINE, depth=12))
    assert 0 < len(found) <= 4
    assert all(max(abs(low), abs(high)) <= Fraction(1, 2**10) for ((low, high),) in found)


def test_where_the_map_is_not_defined_nothing_is_lost():
    """x -> sqrt(x) takes [0, 1] onto itself; its jets have no enclosure next to 0."""
    cover = invariant_cover(lambda x: x.sqrt(), LINE, depth=8)
    for k in range(0, 101, 5):
        assert holds(cover, Fraction(k, 100))


def test_cantor_set():
    """x -> 5 x (1 - x): all bounded orbits are in [0, 1]; 1 -> 0, 1/5 -> 4/5, 1/2 leaves."""
    cover = invariant_cover(lambda x: 5 * x * (1 - x), Region((Interval(-1, 2),)), depth=14)
    for point in (Fraction(0), Fraction(1), Fraction(4, 5), Fraction(1, 5)):
        assert holds(cover, point)
    assert not holds(cover, Fraction(1, 2))
    assert not holds(cover, Fraction(-1, 1000))
    assert len(cover.cells[0]) < 3000


def brute_force(matrix, shift, depth):
    """The algorithm in exact arithmetic, every image compared with every cell."""
    side = Fraction(2, 2**depth)
    corners = [(-1 + i * side, -1 + j * side) for i, j in product(range(2**depth), range(2**depth))]
    boxes = [((x, x + side), (y, y + side)) for x, y in corners]
    images = {}
    for box in boxes:
        image = []
        for row, b in zip(matrix, shift, strict=True):
            ends = [
                [a * end for end in ends] if a >= 0 else [a * end for end in reversed(ends)]
                for a, ends in zip(row, box, strict=True)
            ]
            image.append((sum(e[0] for e in ends) + b, sum(e[1] for e in ends) + b))
        images[box] = image
    kept = set(boxes)
    while True:
        arrows = [
            (a, b)
            for a in kept
            for b in kept
            if all(x[0] <= y[1] and y[0] <= x[1] for x, y in zip(images[a], b, strict=True))
        ]
        stays = {a for a, _ in arrows} & {b for _, b in arrows}
        if stays == kept:
            return kept
        kept = stays


@pytest.mark.slow
@settings(max_examples=10)
@given(st.lists(st.integers(-24, 24), min_size=6, max_size=6))
def test_affine_maps_against_brute_force(numbers):
    a, b, c, d, e, f = (Fraction(n, 8) for n in numbers)
    expected = brute_force([(a, b), (c, d)], (e, f), 3)
    found = set(
        cells(invariant_cover(lambda x, y: [a * x + b * y + e, c * x + d * y + f], PLANE, depth=3))
    )
    assert found == expected


def test_a_polygon():
    triangle = Region.convex([("0", "0"), ("1", "0"), ("0", "1/3")])
    points = [("1/4", "1/12", True), ("1/2", "1/4", False), ("-1/8", "1/8", False)]
    for x, y, inside in points:
        box = IntervalArray([x]), IntervalArray([y])
        assert triangle.misses(box)[0] != inside
        assert triangle.contains(box)[0] == inside
    assert not triangle.misses((IntervalArray([0]), IntervalArray(["1/3"])))[0]
    whole = tuple(IntervalArray([side]) for side in triangle.box)
    assert not triangle.misses(whole)[0] and not triangle.contains(whole)[0]
    beyond = IntervalArray([("1/4", "2")]), IntervalArray([("1/100", "1/50")])
    assert not triangle.contains(beyond)[0]


def test_formulas_of_the_checker():
    function = {"variables": ["x"], "values": ["2*sin(x) + x**2/3"]}
    f = function_of(read_function("F", Reader(function)))
    (value,) = f(IntervalArray.from_floats(np.array([0.0, 1.0])))
    assert value[0].item().contains(0)
    assert value[1].item().contains("2.0162753029") is False
    assert value[1].item().hull(Interval("2.0162753")).wid < Fraction(1, 10**6)
