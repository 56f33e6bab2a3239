from fractions import Fraction

import numpy as np
import pytest

from intervals import IntervalArray
from intervals.bilinear import bilinear


def random_intervals(rng, size, scale=1.0, thin=False):
    low = rng.standard_normal(size) * scale
    high = low if thin else low + np.abs(rng.standard_normal(size)) * scale
    return IntervalArray.from_floats(low, high)


def random_point(rng, x):
    """Exact points of the intervals: ends as often as inner ones."""
    points = []
    for low, high in zip(x.inf.tolist(), x.sup.tolist(), strict=True):
        share = Fraction(int(rng.integers(0, 5)), 4)
        points.append(Fraction(low) + share * (Fraction(high) - Fraction(low)))
    return points


@pytest.mark.parametrize("thin", [True, False])
@pytest.mark.parametrize("scale", [1.0, 1e-3, 1e150, 1e-160, 5e-324])
@pytest.mark.parametrize("terms", [1, 2, 5])
def test_contains_exact_values(terms, scale, thin):
    rng = np.random.default_rng(terms)
    n, count = 4, 5
    left = [random_intervals(rng, n, scale, thin) for _ in range(terms)]
    right = [random_intervals(rng, count, 1.0, thin) for _ in range(terms)]
    constant = random_intervals(rng, n, scale, thin)
    result = bilinear(left, right, constant)
    assert result.shape == (n, count)
    for _ in range(20):
        x, y, c = ([random_point(rng, a) for a in group] for group in (left, right, [constant]))
        for i in range(n):
            for j in range(count):
                exact = c[0][i] + sum(x[k][i] * y[k][j] for k in range(terms))
                assert Fraction(result.inf[i, j]) <= exact <= Fraction(result.sup[i, j])


def test_cancellation_is_enclosed():
    one, big = IntervalArray([1]), IntervalArray.from_floats([1e16])
    tiny = IntervalArray.from_floats([0.1])
    result = bilinear([big, -big, tiny], [one, one, tiny], one)
    exact = 1 + Fraction(0.1) ** 2
    assert Fraction(result.inf[0, 0]) <= exact <= Fraction(result.sup[0, 0])


def test_is_tight_on_points_and_as_wide_as_the_sets():
    rng = np.random.default_rng(3)
    left, right = ([random_intervals(rng, 9, thin=True) for _ in range(2)] for _ in range(2))
    constant = random_intervals(rng, 9, thin=True)
    assert bilinear(left, right, constant).wid.max() < 1e-13
    wide = [IntervalArray.from_floats(x.inf, x.inf + 1e-3) for x in left]
    got = bilinear(wide, right, constant).wid
    least = sum(1e-3 * np.abs(y.inf) for y in right)
    assert (got < least + 1e-13).all()
    assert (got > least - 1e-13).all()


def test_overflow_is_refused():
    big = IntervalArray.from_floats([1e308, 1.0])
    with pytest.raises(OverflowError):
        bilinear([big], [big], big)
    with pytest.raises(OverflowError):
        bilinear([big, big], [big, -big], big)


def test_bad_shapes_are_refused():
    x = IntervalArray([1, 2])
    for arguments in (([], [], x), ([x], [x, x], x), ([x.reshape(2, 1)], [x], x)):
        with pytest.raises(ValueError, match=r"factors"):
            bilinear(*arguments)


def test_another_rounding_mode_is_refused(monkeypatch):
    def refuse():
        raise FloatingPointError("this thread does not round to nearest")

    monkeypatch.setattr("intervals.bilinear.require_nearest", refuse)
    x = IntervalArray([1, 2])
    with pytest.raises(FloatingPointError):
        bilinear([x], [x], x)
