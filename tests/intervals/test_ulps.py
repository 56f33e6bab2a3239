"""How far the bounds of IntervalArray's arithmetic are from the exact ones, in ulps."""

import math
import operator
from fractions import Fraction

import numpy as np
import pytest

from intervals import IntervalArray
from tests.intervals import oracle

STATED = 2.5  # CONFORMANCE.md
OPERATIONS = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
}


def points(seed, size=4000):
    rng = np.random.default_rng(seed)
    mantissas = rng.uniform(1, 2, size) * rng.choice([-1, 1], size)
    return np.ldexp(mantissas, rng.integers(-300, 300, size))


def distance(bound, true):
    """|bound - true| in ulps of the bound."""
    return abs(Fraction(bound) - true) / Fraction(math.ulp(bound))


@pytest.mark.parametrize("name", OPERATIONS)
def test_arithmetic(name):
    a, b = points(1), points(2)
    z = OPERATIONS[name](IntervalArray.from_floats(a), IntervalArray.from_floats(b))
    for x, y, low, high in zip(a, b, z.inf, z.sup, strict=True):
        true = OPERATIONS[name](Fraction(x), Fraction(y))
        assert low <= true <= high
        assert max(distance(low, true), distance(high, true)) <= STATED


def test_squares_and_roots():
    a = points(3)
    squares = IntervalArray.from_floats(a).sqr()
    for x, low, high in zip(a, squares.inf, squares.sup, strict=True):
        true = Fraction(x) ** 2
        assert low <= true <= high
        assert max(distance(low, true), distance(high, true)) <= STATED
    roots = IntervalArray.from_floats(abs(a)).sqrt()
    for x, low, high in zip(abs(a), roots.inf, roots.sup, strict=True):
        below, above = oracle.sqrt_down(Fraction(x), 200), oracle.sqrt_up(Fraction(x), 200)
        assert low <= above and below <= high
        assert max(distance(low, below), distance(high, above)) <= STATED
