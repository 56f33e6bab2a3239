"""Extremes of functions whose extremes are known in closed form."""

from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from intervals import DomainError, Interval, Undecided
from proofs.methods.extremes import extremes


def polynomial(coefficients):
    def value(x):
        total = Interval(0, precision=80)
        for c in reversed(coefficients):
            total = total * x + c
        return total.inf, total.sup

    slopes = [k * c for k, c in enumerate(coefficients)][1:] or [0]

    def slope(x):
        total = Interval(0, precision=80)
        for c in reversed(slopes):
            total = total * x + c
        return total.inf, total.sup

    return (
        lambda x: value(Interval(x, precision=80)),
        lambda a, b: slope(Interval(a, b, precision=80)),
    )


def test_monotone_functions_need_one_piece_and_lose_nothing():
    g, dg = polynomial([0, 1, 0, 1])
    found = extremes(g, dg, [Fraction(1), Fraction(2)])
    assert found.points == (1, 2)
    assert found.minimum == (2, 2) and found.maximum == (10, 10)


def test_an_interior_extremum_is_found_to_the_tolerance():
    g, dg = polynomial([0, 0, 1])  # x^2 on [-1/3, 1]: minimum 0 inside
    found = extremes(g, dg, [Fraction(-1, 3), Fraction(1)])
    low, high = found.minimum
    assert low <= 0 <= high and high - low < Fraction(1, 10**11)
    assert found.maximum[0] <= 1 <= found.maximum[1]


@pytest.mark.slow
@settings(max_examples=60)
@given(st.lists(st.integers(-9, 9), min_size=2, max_size=5), st.integers(0, 40))
def test_every_value_lies_between_the_outer_bounds(coefficients, k):
    g, dg = polynomial(coefficients)
    low, high = Fraction(-3, 2), Fraction(5, 4)
    found = extremes(g, dg, [low, high])
    x = low + (high - low) * Fraction(k, 40)
    value = sum(c * x**n for n, c in enumerate(coefficients))
    assert found.minimum[0] <= value <= found.maximum[1]
    samples = [
        sum(c * y**n for n, c in enumerate(coefficients))
        for y in (low + (high - low) * Fraction(j, 400) for j in range(401))
    ]
    assert found.minimum[1] <= min(samples) + Fraction(1, 100)
    assert found.maximum[0] >= max(samples) - Fraction(1, 100)


@pytest.mark.parametrize("most", [1, 7, 100])
def test_a_hopeless_derivative_gives_wide_bounds_that_hold(most):
    found = extremes(
        lambda x: (x, x),
        lambda a, b: (Fraction(-(10**9)), Fraction(10**9)),
        [Fraction(0), Fraction(1)],
        most=most,
    )
    assert len(found.pieces) == most
    assert found.points[0] == 0 and found.points[-1] == 1
    assert list(found.points) == sorted(set(found.points))
    for low, high, piece in zip(found.points, found.points[1:], found.pieces, strict=False):
        assert piece[0] <= low < high <= piece[1] and piece[1] - piece[0] > 1
    assert found.minimum[0] < -1 < 0 <= found.minimum[1]
    assert found.maximum[0] == 1
    assert found.maximum[1] > 2


def test_more_pieces_are_never_worse():
    g, dg = polynomial([0, 3, -5, 0, 2])
    ends = [Fraction(-2), Fraction(2)]
    widths = []
    for most in (2, 8, 32, 128):
        found = extremes(g, dg, ends, Fraction(1, 10**30), most)
        assert found.minimum[0] <= -6 and found.maximum[1] >= 18  # g(-1) and g(2)
        widths.append(found.maximum[1] - found.minimum[0])
    assert widths == sorted(widths, reverse=True) and widths[-1] < widths[0]


def test_a_derivative_that_is_never_defined_is_undecided():
    def nowhere(a, b):
        raise DomainError("division by an interval that contains 0")

    with pytest.raises(Undecided, match="on one of 8 pieces: division by"):
        extremes(lambda x: (x, x), nowhere, [Fraction(0), Fraction(1)], most=8)
