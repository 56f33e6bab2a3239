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


def test_a_derivative_that_is_never_defined_is_undecided():
    def nowhere(a, b):
        raise DomainError("division by an interval that contains 0")

    with pytest.raises(Undecided, match="on one of 8 pieces: division by"):
        extremes(lambda x: (x, x), nowhere, [Fraction(0), Fraction(1)], most=8)
