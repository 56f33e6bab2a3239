"""Tight arrays against fractions: the least bounds there are; exact results of all arrays."""

import operator
from fractions import Fraction
from itertools import product
from math import inf, nextafter

import numpy as np
import pytest
from hypothesis import strategies as st

from intervals import IntervalArray, TightArray
from intervals.elementary.binary64 import ERRORS
from intervals.rounding import MAX, float_down, float_up
from tests.intervals.binary64_oracle import DOMAIN, distances, plane_points, points
from tests.intervals.boxes import for_all
from tests.intervals.foreign_states import STATES, foreign, x86_linux
from tests.intervals.test_array import BINARY

mantissas = st.integers(-(2**53) + 1, 2**53 - 1) | st.integers(-9, 9)
# mantissas that differ in the last bits only have ties, and products next to midpoints
near = st.integers(2**52, 2**52 + 9) | st.integers(2**53 - 9, 2**53 - 1)
floats = st.builds(
    lambda m, e: float(m) * 2.0**e, mantissas | near | near.map(operator.neg), st.integers(-90, 40)
)
sides = st.tuples(floats, floats).map(sorted) | floats.map(lambda x: [x, x])


def exact(name, x, y):
    """The range at the corners, in fractions; None where 0 is in a divisor."""
    if name == "/" and y[0] <= 0 <= y[1]:
        return None
    values = [BINARY[name](Fraction(a), Fraction(b)) for a, b in product(x, y)]
    return min(values), max(values)


@for_all(
    st.sampled_from(sorted(BINARY)), st.lists(st.tuples(sides, sides), min_size=1, max_size=14)
)
def test_bounds_are_the_least(name, pairs):
    pairs = [(x, y) for x, y in pairs if exact(name, x, y)]
    if not pairs:
        return
    for kind in (TightArray, IntervalArray):
        X, Y = (kind.from_floats(*np.array(ends).T) for ends in zip(*pairs, strict=True))
        found = BINARY[name](X, Y)
        assert type(found) is kind
        for low, high, (x, y) in zip(found.inf.tolist(), found.sup.tolist(), pairs, strict=True):
            least, most = exact(name, x, y)
            assert Fraction(low) <= least and most <= Fraction(high)
            if kind is TightArray:
                assert (low, high) == (float_down(least), float_up(most))


@for_all(st.lists(sides, min_size=1, max_size=14))
def test_squares_and_roots_are_the_least(ends):
    X = TightArray.from_floats(*np.array(ends).T)
    squares, roots = X.sqr(), abs(X).sqrt()
    for i, (low, high) in enumerate(ends):
        corners = sorted((Fraction(low) ** 2, Fraction(high) ** 2))
        corners[0] = Fraction(0) if low <= 0 <= high else corners[0]
        found = squares[i]
        assert (found.inf, found.sup) == (float_down(corners[0]), float_up(corners[1]))
        size, root = abs(X)[i], roots[i]
        for end, bound, step in ((size.inf, root.inf, inf), (size.sup, root.sup, -inf)):
            x, y = Fraction(float(end)), Fraction(float(bound))
            beyond = Fraction(nextafter(float(bound), step))
            assert (
                y * y <= x < beyond * beyond if step > 0 else beyond * beyond < x <= y * y or x == 0
            )


# -- elementary functions, against Arb -------------------------------------------------------------


@pytest.mark.parametrize("name", sorted(DOMAIN))
@pytest.mark.parametrize("count", [12, 1200])
def test_elementary_functions_are_within_one_ulp_and_a_half(name, count):
    """Few of them one by one, many by numpy."""
    x = points(name, count, seed=14)
    x = x[(np.abs(x) > 2.0**-300) | (x == 0)]
    found = getattr(TightArray.from_floats(x), name)()
    assert type(found) is TightArray
    assert distances(name, [x], found._rows).max() <= 1.5


def test_bounds_that_are_proved():
    """What the theorems say: 2 k ulps and one, for every function of arrays."""
    assert max(ERRORS.values()) - 0.5 <= 1.5


@pytest.mark.parametrize("name", ["power", "atan2", "hypot"])
def test_functions_of_two_variables_are_as_tight(name):
    x, y = plane_points(name, 400, 3)
    method = {"power": TightArray.pow}.get(name) or getattr(TightArray, name)
    found = method(*map(TightArray.from_floats, (x, y)))
    assert distances(name, [x, y], found._rows).max() <= 1.5


def test_sums_products_and_matrices_are_sharper():
    rng = np.random.default_rng(4)
    numbers = rng.normal(size=(7, 7))
    for compute in (
        *(lambda x: x.sum(), lambda x: x.prod(), lambda x: x @ x, lambda x: x**5),
        lambda x: x.sum(axis=(0, 1), keepdims=True),
    ):
        tight, default = (
            compute(TightArray.from_floats(numbers)),
            compute(IntervalArray.from_floats(numbers)),
        )
        assert type(tight) is TightArray
        assert tight.subset(default).all() and tight.wid.sum() < 0.7 * default.wid.sum()


def test_very_small_and_large_results():
    tiny, huge = 2.0**-1070, 2.0**1000
    X = TightArray.from_floats([tiny, 1e-160, huge, -MAX, tiny], [3 * tiny, 1e-160, huge, MAX, 1.0])
    for kind in (X * X, X + X, X - X, X.sqr(), abs(X).sqrt(), X / 3):
        assert not np.isnan(kind._rows).any()
    for i, (low, high) in enumerate(zip(X.inf.tolist(), X.sup.tolist(), strict=True)):
        least, most = exact("*", [low, high], [low, high])
        found = (X * X)[i]
        assert found.inf == -inf or Fraction(float(found.inf)) <= least
        assert found.sup == inf or most <= Fraction(float(found.sup))
    zero = TightArray.from_floats([0.0], [inf]) * TightArray([0])
    assert (zero.inf, zero.sup) == (0, 0)


@x86_linux
def test_another_rounding_mode_is_refused_by_tight_arrays_alone():
    x = [0.1, 0.2, 0.25, 3.0] * 4
    with foreign(*STATES["upward"]):
        for operation in (lambda a: a + a, lambda a: a * a, lambda a: a / a, lambda a: a.sqrt()):
            operation(IntervalArray.from_floats(x))
            with pytest.raises(FloatingPointError):
                operation(TightArray.from_floats(x))


# -- exact results of all arrays -------------------------------------------------------------------

SHORT = st.integers(-(2**20), 2**20).map(lambda n: n / 64)


@pytest.mark.parametrize("count", [1, 5, 11, 40_000])
@pytest.mark.parametrize("mode", [*STATES][:4])
@x86_linux
def test_short_results_are_exact(count, mode):
    rng = np.random.default_rng(count)
    low = rng.integers(-(2**20), 2**20, count) / 64.0
    width = rng.integers(0, 3, count)
    a, b = low, 2.0 ** rng.integers(-9, 9, count)
    X, P, Y = map(IntervalArray.from_floats, (low, a, b), (low + width, a, b))
    with foreign(*STATES[mode]):
        results = P + Y, P * Y, P / Y, P - Y, (P * P).sqrt(), P + 1, P * 3
        wide = X + Y, X * Y, X / Y
    expected = a + b, a * b, a / b, a - b, np.abs(a), a + 1, a * 3
    for found, value in zip(results, expected, strict=True):
        assert (found.inf == value).all() and (found.sup == value).all()
    for found, ends in zip(wide, (lambda e: e + b, lambda e: e * b, lambda e: e / b), strict=True):
        assert (found.inf == ends(low)).all() and (found.sup == ends(low + width)).all()


@for_all(st.lists(st.tuples(SHORT, floats), min_size=1, max_size=13), st.sampled_from("+*/"))
def test_long_results_are_not_taken_for_exact(pairs, name):
    """Where the first and the last number are short, and those between them need not be."""
    numbers = [(0.5, 1.5), *pairs, (2.0, 4.0)]
    x, y = np.array([n for n in numbers if n[1]]).T
    found = BINARY[name](IntervalArray.from_floats(x), IntervalArray.from_floats(y))
    for low, high, a, b in zip(*(v.tolist() for v in (found.inf, found.sup, x, y)), strict=True):
        true = BINARY[name](Fraction(a), Fraction(b))
        assert Fraction(low) <= true <= Fraction(high)
