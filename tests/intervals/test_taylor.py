"""Taylor forms: they contain the range, and converge with the order that they should have."""

import random
from fractions import Fraction

import flint
import numpy as np
import pytest
from hypothesis import strategies as st

from intervals import DomainError, Interval
from intervals.array import IntervalArray
from intervals.taylor import polynomial_range, taylor
from tests.intervals import oracle
from tests.intervals.boxes import for_all, horner

FUNCTIONS = {
    "wave": lambda x: x.sin() * x + 1 / (x * x + 2),
    "growth": lambda x: (x * x + 1).log() * x.exp() - 3 * x,
    "square": lambda x: (3 * x - 1) * (3 * x + 2),
    "root": lambda x: (x * x + x + 1).sqrt() * x.cos(),
}


def sharp_range(name, low, high):
    """Bounds of the range over [low, high] by Arb: values at the ends and at zeros of f'."""
    with flint.ctx.workprec(200):
        candidates = [low, high]
        count = 64
        grid = [low + (high - low) * Fraction(k, count) for k in range(count + 1)]
        slopes = [slope(name, t) for t in grid]
        for a, b, p, q in zip(grid, grid[1:], slopes, slopes[1:], strict=False):
            if (p < 0) != (q < 0):
                candidates.append(bisected(name, a, b, p < 0))
        values = [oracle.ends(FUNCTIONS[name](oracle.arb(t))) for t in candidates]
    return min(v[0] for v in values), max(v[1] for v in values)


def slope(name, t):
    x = flint.arb_series([oracle.arb(t), 1], prec=2)
    return FUNCTIONS[name](x)[1]


def bisected(name, a, b, rising):
    for _ in range(50):
        middle = (a + b) / 2
        a, b = (middle, b) if (slope(name, middle) < 0) == rising else (a, middle)
    return a


def excess(name, order, pieces, low=-2, high=3):
    """The largest excess width over N pieces of [low, high]."""
    cuts = np.linspace(low, high, pieces + 1)
    enclosure = taylor(FUNCTIONS[name], IntervalArray.from_floats(cuts[:-1], cuts[1:]), order)
    largest = Fraction(0)
    ends = zip(cuts, cuts[1:], enclosure.inf, enclosure.sup, strict=False)
    for a, b, bottom, top in ends:
        sharp = sharp_range(name, Fraction(a), Fraction(b))
        largest = max(largest, Fraction(top) - Fraction(bottom) - (sharp[1] - sharp[0]))
    return float(largest)


@pytest.mark.parametrize("order", range(5))
def test_the_excess_width_falls_with_the_order_plus_one(order):
    """Slope of log(excess) over log(N), N = 16, 32, 64, 128, by least squares."""
    pieces = [16, 32, 64, 128]
    widths = [excess("wave", order, n) for n in pieces]
    fitted = np.polyfit(np.log(pieces), np.log(widths), 1)[0]
    assert abs(fitted + order + 1) < 0.2


@pytest.mark.parametrize("name", FUNCTIONS)
@pytest.mark.parametrize("order", [0, 1, 2, 3, 5, 9])
def test_forms_contain_the_values_inside(name, order):
    rng = random.Random(f"{name} {order}")
    low = [rng.uniform(-2, 2) for _ in range(40)]
    high = [x + rng.choice([0, 2.0**-40, 0.01, 0.3]) for x in low]
    many = taylor(FUNCTIONS[name], IntervalArray.from_floats(low, high), order)
    for a, b, bottom, top in zip(low, high, many.inf, many.sup, strict=True):
        ends = Fraction(a), Fraction(b)
        one = taylor(FUNCTIONS[name], Interval(*ends, precision=120), order)
        for k in (0, 1, 3, 8, 15, 16):
            t = ends[0] + (ends[1] - ends[0]) * Fraction(k, 16)
            assert oracle.encloses(Fraction(bottom), Fraction(top), FUNCTIONS[name], t, bits=300)
            assert oracle.encloses(one.inf, one.sup, FUNCTIONS[name], t, bits=300)


def test_an_extremum_inside_is_enclosed_sharply():
    """x (1 - x) on [0.4, 0.7] has the maximum 1/4 and, at 0.7, the minimum 0.21."""
    x = Interval("0.4", "0.7")
    for f, low, high in (
        (lambda t: t * (1 - t), Fraction(21, 100), Fraction(1, 4)),
        (lambda t: t * (t - 1), Fraction(-1, 4), Fraction(-21, 100)),
    ):
        y = taylor(f, x, 2)
        assert y.inf <= low and high <= y.sup
        assert low - y.inf < Fraction(1, 2**48) and y.sup - high < Fraction(1, 2**48)
    assert taylor(lambda t: t * (1 - t), x, 0).wid > Fraction(1, 4)


def test_hypotheses_are_checked():
    with pytest.raises(ValueError, match="order"):
        taylor(FUNCTIONS["wave"], Interval(0, 1), -1)
    with pytest.raises(DomainError):
        taylor(lambda t: t.sqrt(), Interval(0, 1), 1)
    assert taylor(lambda t: t.sqrt(), Interval(0, 1), 0) == Interval(0, 1)


# -- polynomials with interval coefficients --------------------------------------------------------

rationals = st.fractions(-3, 3, max_denominator=12)


@st.composite
def families(draw):
    """Coefficients with widths, and an interval of any place and width."""
    pairs = st.tuples(rationals, st.sampled_from([0, 0, 1, 4]))
    drawn = draw(st.lists(pairs, min_size=1, max_size=6))
    low, width = draw(rationals), draw(st.sampled_from([Fraction(k, 50) for k in (0, 1, 50, 150)]))
    return [(c, c + Fraction(w, 16)) for c, w in drawn], low, low + width


@for_all(families(), st.integers(0, 99), tries=40, at_length=100)
def test_ranges_of_families_of_polynomials(family, seed):
    ends, low, high = family
    rng = random.Random(seed)
    one = polynomial_range([Interval(*pair) for pair in ends], Interval(low, high))
    shift = Fraction(1, 7)
    sides = [(low, high), (low - shift, high - shift), (-high, -low)]
    many = polynomial_range([IntervalArray([pair] * 3) for pair in ends], IntervalArray(sides))
    for _ in range(3):
        coefficients = [a + (b - a) * rng.choice([0, 1, Fraction(1, 2)]) for a, b in ends]
        for k in range(9):
            part = Fraction(k, 8)
            assert one.contains(horner(coefficients, low + (high - low) * part))
            for i, (a, b) in enumerate(sides):
                assert many[i].contains(horner(coefficients, a + (b - a) * part))
