"""Unions of intervals and division by intervals that contain 0, against exact points."""

from fractions import Fraction
from itertools import pairwise

from hypothesis import strategies as st

from intervals import Interval
from intervals.unions import quotients, union
from tests.intervals.boxes import for_all

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
