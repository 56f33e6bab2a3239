"""Relations and unions, against their meaning in terms of the numbers inside."""

import itertools
import operator
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import strategies as st

from intervals import Interval, IntervalArray, Overlap
from intervals.unions import quotients, union
from tests.intervals.boxes import for_all

ENDS = range(4)
BOXES = [(a, b) for a in ENDS for b in ENDS if a <= b]
PAIRS = list(itertools.product(BOXES, BOXES))


def points(box):
    """The ends and quarters between them: enough for intervals with whole ends."""
    a, b = box
    return [Fraction(k, 4) for k in range(4 * a, 4 * b + 1)]


def every(x, y, relation):
    return all(relation(p, q) for p in x for q in y)


def some(x, y, relation):
    return any(relation(p, q) for p in x for q in y)


MEANING = {
    "equal": lambda x, y: set(x) == set(y),
    "subset": lambda x, y: set(x) <= set(y),
    "interior": lambda x, y: min(y) < min(x) and max(x) < max(y),
    "contains": lambda x, y: set(y) <= set(x),
    "disjoint": lambda x, y: not set(x) & set(y),
    "less": lambda x, y: (
        all(any(p <= q for q in y) for p in x) and all(any(p <= q for p in x) for q in y)
    ),
    "strictly_less": lambda x, y: (
        all(any(p < q for q in y) for p in x) and all(any(p < q for p in x) for q in y)
    ),
    "precedes": lambda x, y: every(x, y, operator.le),
    "strictly_precedes": lambda x, y: every(x, y, operator.lt),
    "certainly_less": lambda x, y: every(x, y, operator.lt),
    "certainly_less_equal": lambda x, y: every(x, y, operator.le),
    "possibly_less": lambda x, y: some(x, y, operator.lt),
    "possibly_less_equal": lambda x, y: some(x, y, operator.le),
}

# IEEE 1788-2015, table 10.7, for nonempty intervals [a, b] and [c, d]
STATES = {
    Overlap.BEFORE: lambda a, b, c, d: b < c,
    Overlap.MEETS: lambda a, b, c, d: a < b == c < d,
    Overlap.OVERLAPS: lambda a, b, c, d: a < c < b < d,
    Overlap.STARTS: lambda a, b, c, d: a == c and b < d,
    Overlap.CONTAINED_BY: lambda a, b, c, d: c < a and b < d,
    Overlap.FINISHES: lambda a, b, c, d: c < a and b == d,
    Overlap.EQUALS: lambda a, b, c, d: a == c and b == d,
    Overlap.FINISHED_BY: lambda a, b, c, d: a < c and b == d,
    Overlap.CONTAINS: lambda a, b, c, d: a < c and d < b,
    Overlap.STARTED_BY: lambda a, b, c, d: a == c and d < b,
    Overlap.OVERLAPPED_BY: lambda a, b, c, d: c < a < d < b,
    Overlap.MET_BY: lambda a, b, c, d: c < d == a < b,
    Overlap.AFTER: lambda a, b, c, d: d < a,
}


@pytest.mark.parametrize("name", MEANING)
def test_relations_mean_what_they_say(name):
    expected = [MEANING[name](points(x), points(y)) for x, y in PAIRS]
    assert {True, False} == set(expected)
    assert [getattr(Interval(*x), name)(Interval(*y)) for x, y in PAIRS] == expected
    first = IntervalArray([x for x, _ in PAIRS])
    second = IntervalArray([y for _, y in PAIRS])
    assert getattr(first, name)(second).tolist() == expected


def test_overlap_states():
    first, second = (IntervalArray([pair[i] for pair in PAIRS]) for i in (0, 1))
    states = first.overlap(second)
    for (x, y), state in zip(PAIRS, states, strict=True):
        (expected,) = [s for s, holds in STATES.items() if holds(*x, *y)]
        assert Interval(*x).overlap(Interval(*y)) is expected
        assert state is expected
    assert set(states) == set(Overlap)


@pytest.mark.parametrize("name", MEANING)
@pytest.mark.parametrize("number", [Fraction(1, 3), Fraction(1, 3**50), 10**400, -(10**400), 2])
def test_relations_with_exact_numbers_are_exact(name, number):
    number = Fraction(number)
    tight = IntervalArray([number]) if abs(number) < 10**300 else IntervalArray([0])
    low, high = Fraction(tight.inf[0]), Fraction(tight.sup[0])
    boxes = [(low, high), (low, low), (high, high), (low - 1, low), (high, high + 1), (-5, 5)]
    boxes = [box for box in boxes if all(Fraction(float(end)) == end for end in box)]
    for a, b in boxes:
        inside = [x for x in (a, (a + b) / 2, number, b) if a <= x <= b]
        expected = MEANING[name](inside, [number])
        assert getattr(Interval(a, b, precision=2000), name)(number) is expected
        array = IntervalArray.from_floats([float(a)], [float(b)])
        assert getattr(array, name)(number).tolist() == [expected]


@pytest.mark.parametrize("box", [*BOXES, (-1, 1), (-2, -1), (-1, 0)])
def test_signs(box):
    inside = points(box)
    expected = {
        "certainly_positive": min(inside) > 0,
        "certainly_negative": max(inside) < 0,
        "possibly_positive": max(inside) > 0,
        "possibly_negative": min(inside) < 0,
        "contains_zero": 0 in inside,
        "is_singleton": len(inside) == 1,
    }
    for name, answer in expected.items():
        assert getattr(Interval(*box), name)() is answer
        assert getattr(IntervalArray([box]), name)().tolist() == [answer]


def test_huge_exponents_cost_nothing():
    big = Interval(2**30 - 1).exp()
    assert big.certainly_positive()
    assert not big.contains_zero()
    assert Interval(1).strictly_precedes(big)


def test_relations_refuse_floats_and_shapes_broadcast():
    with pytest.raises(TypeError):
        Interval(1, 2).subset(0.5)
    with pytest.raises(TypeError):
        IntervalArray([1]).subset(0.5)
    grid = IntervalArray([[1], [2]]).precedes(IntervalArray([0, 1, 2]))
    assert np.array_equal(grid, [[False, True, True], [False, False, True]])


# -- unions of intervals and division by intervals that contain 0, against exact points ------------


numbers = st.integers(-24, 24).map(lambda n: Fraction(n, 4))
pairs = st.tuples(numbers, numbers).map(sorted)


@for_all(pairs, pairs, pairs)
def test_quotients_hold_every_solution_and_little_else(z, v, u):
    parts = quotients(Interval(*z), Interval(*v), Interval(*u))
    assert len(parts) <= 2
    for k in range(65):
        x = u[0] + (u[1] - u[0]) * Fraction(k, 64)
        products = sorted((x * v[0], x * v[1]))
        solves = products[0] <= z[1] and z[0] <= products[1]
        held = [part.contains(x) for part in parts]
        assert sum(held) == solves or (not solves and _near(x, parts))


def _near(x, parts):
    """At an end that was rounded outward."""
    return any(abs(x - end) < Fraction(1, 10**12) for part in parts for end in (part.inf, part.sup))


def test_division_by_an_interval_with_zero_inside_gives_two_parts():
    left, right = quotients(Interval(1), Interval(-1, 2), Interval(-10, 10))
    assert (left.inf, left.sup, right.inf, right.sup) == (-10, -1, Fraction(1, 2), 10)
    assert quotients(Interval(1), Interval(0), Interval(-10, 10)) == []
    assert quotients(Interval(0), Interval(0), Interval(-10, 10)) == [Interval(-10, 10)]


@for_all(st.lists(pairs, max_size=8))
def test_unions_are_disjoint_and_the_same_set(parts):
    result = union(Interval(*ends) for ends in parts)
    assert all(a.sup < b.inf for a, b in pairwise(result))
    for n in range(-100, 101):
        x = Fraction(n, 16)
        assert any(low <= x <= high for low, high in parts) == any(p.contains(x) for p in result)
