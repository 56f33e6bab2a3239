import math
from fractions import Fraction

import numpy as np
import pytest

from intervals import IntervalArray
from intervals.bilinear import bilinear
from intervals.rounding import float_down


def random_intervals(rng, size, scale=1.0, thin=False):
    low = rng.standard_normal(size) * scale
    high = low if thin else low + np.abs(rng.standard_normal(size)) * scale
    return IntervalArray.from_floats(low, high)


def product_sums(left, right):
    """The exact least sums of products, shape (n, T): at ends, as each product is bilinear."""
    total = 0
    for x, y in zip(left, right, strict=True):
        ends = [(a, b) for a in (x.inf, x.sup) for b in (y.inf, y.sup)]
        corners = [np.multiply.outer(exact(a), exact(b)) for a, b in ends]
        total = total + np.minimum.reduce(corners)
    return total


def exact(floats):
    return np.array([Fraction(x) for x in floats.tolist()], dtype=object)


@pytest.mark.parametrize("thin", [True, False])
@pytest.mark.parametrize("scale", [1.0, 1e-3, 1e150, 1e-160, 5e-324])
@pytest.mark.parametrize("terms", [1, 2, 5])
def test_what_may_be_0_or_less_is_never_called_positive(terms, scale, thin):
    rng = np.random.default_rng(terms)
    left = [random_intervals(rng, 4, scale, thin) for _ in range(terms)]
    right = [random_intervals(rng, 5, 1.0, thin) for _ in range(terms)]
    least = product_sums(left, right)
    for column in range(5):
        sums = least[:, column]
        for nearness in (0, 2**-60, 2**-50, 1e-3, 10):
            parts = Fraction(nearness) * sum(abs(exact(x.sup)) for x in left)
            constant = IntervalArray.from_floats(
                [float_down(value) for value in parts - sums], np.full(4, 1e300)
            )
            found = bilinear(left, right, constant)
            assert found.shape == (4, 5)
            truth = (exact(constant.inf)[:, np.newaxis] + least) > 0
            assert not (found & ~truth.astype(bool)).any()


def test_cancellation_is_not_called_positive():
    one, big = IntervalArray([1]), IntervalArray.from_floats([1e16])
    tiny = IntervalArray.from_floats([0.1])
    # 1e16 + 0.01 - 1e16 - 0.02 < 0, and binary64 loses all of it
    for constant in (["-0.02"], ["-0.011"]):
        assert not bilinear([big, -big, tiny], [one, one, tiny], IntervalArray(constant)).any()
    assert bilinear([big, -big, tiny], [one, one, tiny], IntervalArray([100])).all()


def test_underflow_is_not_called_positive():
    # each of five products, 0.6 of the least number, is rounded up to it; they sum to less than 3
    tiny, part = 2.0**-1073, IntervalArray.from_floats([0.3])
    three = IntervalArray.from_floats([-1.5 * tiny])
    assert not bilinear([IntervalArray.from_floats([tiny])] * 5, [part] * 5, three).any()
    large = IntervalArray.from_floats([tiny * 2.0**200])
    assert bilinear([large] * 5, [part] * 5, -large).all()


@pytest.mark.parametrize("width", [0.0, 1e-3])
def test_a_margin_of_the_size_of_the_sets_is_seen(width):
    rng = np.random.default_rng(3)
    left, right = ([random_intervals(rng, 9, thin=True) for _ in range(2)] for _ in range(2))
    wide = [IntervalArray.from_floats(x.inf, x.inf + width) for x in left]
    least = product_sums(wide, right)
    spare = Fraction(width * sum(np.max(np.abs(y.inf)) for y in right))
    sums = least.min(axis=1)
    small = Fraction(1, 10**13)
    just, short, enough = (
        IntervalArray([value + more for value in -sums]) for more in (small, -small, spare + small)
    )
    assert bilinear(wide, right, enough).all()
    assert not bilinear(wide, right, short).all(axis=1).any()
    if width == 0.0:
        assert bilinear(wide, right, just).all()


def test_overflow_is_refused():
    big = IntervalArray.from_floats([1e308, 1.0])
    wide = IntervalArray.from_floats([-1e308, 1.0], [1e308, 1.0])
    one = IntervalArray([1, 1])
    for left, right, constant in (
        ([big], [big], big),
        ([big, big], [big, -big], big),
    ):
        with pytest.raises(OverflowError):
            bilinear(left, right, constant)
    unbounded = IntervalArray.from_floats([-math.inf, 1.0], [math.inf, 1.0])
    for left, right, constant in (
        ([one], [one], unbounded),
        ([wide], [wide], wide),
    ):
        assert bilinear(left, right, constant).tolist()[0] == [False, False]
    with pytest.raises(OverflowError):
        bilinear([unbounded], [one], one)


def test_bad_shapes_are_refused():
    x = IntervalArray([1, 2])
    square, short = x.reshape(2, 1), x[:1]
    for left, right, constant in (
        *(([], [], x), ([x], [x, x], x), ([square], [x], x), ([x], [square], x)),
        *(([square], [x], square), ([short], [x], x), ([x], [x], short)),
    ):
        with pytest.raises(ValueError, match="factors"):
            bilinear(left, right, constant)


def test_another_rounding_mode_is_refused(monkeypatch):
    def refuse():
        raise FloatingPointError("this thread does not round to nearest")

    monkeypatch.setattr("intervals.bilinear.require_nearest", refuse)
    x = IntervalArray([1, 2])
    with pytest.raises(FloatingPointError):
        bilinear([x], [x], x)


@pytest.mark.parametrize("block", [1, 7, 12])
def test_blocks_do_not_change_the_result(monkeypatch, block):
    rng = np.random.default_rng(8)
    left, right = (
        [random_intervals(rng, 11) for _ in "ab"],
        [random_intervals(rng, 5) for _ in "ab"],
    )
    constant = random_intervals(rng, 11, 10.0)
    whole = bilinear(left, right, constant)
    assert 0 < whole.sum() < whole.size
    monkeypatch.setattr("intervals.bilinear._BLOCK", block)
    assert (bilinear(left, right, constant) == whole).all()
