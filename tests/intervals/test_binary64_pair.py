"""The rules of pairs against exact rationals, and the constants of the kernels against Arb."""

import math
from fractions import Fraction

import flint
import numpy as np
import pytest

from intervals.elementary.binary64 import arctangent, exponential, logarithm, pair, realpower
from intervals.elementary.binary64.pair import EPSILON, Pair
from tests.intervals.binary64_oracle import plane_points
from tests.intervals.oracle import evaluate

U = Fraction(1, 2**53)
COUNT = 600


def numbers(seed, positive=True):
    """Numbers of all moderate sizes, with short and with long mantissas."""
    rng = np.random.default_rng(seed)
    x = np.ldexp(rng.uniform(1, 2, COUNT), rng.integers(-200, 200, COUNT))
    x[::3] = np.ldexp(rng.integers(1, 64, COUNT), rng.integers(-200, 200, COUNT))[::3]
    x[1::9] = np.ldexp(2 - 2.0**-52, rng.integers(-9, 9, COUNT))[1::9]
    return x if positive else x * rng.choice([-1, 1], COUNT)


def pairs(seed, positive=True, widest=1.0):
    """Pairs with |lo| <= widest u |hi|, often as large as that."""
    rng = np.random.default_rng(seed + 100)
    hi = numbers(seed, positive)
    return Pair(hi, hi * rng.choice([-1, 1, 0.1, 0, -1e-3], COUNT) * widest * 2.0**-53)


def exact(y):
    los = np.broadcast_to(y.lo, y.hi.shape).tolist()
    return [Fraction(h) + Fraction(low) for h, low in zip(y.hi.tolist(), los, strict=True)]


def assert_near(result, expected):
    """|hi + lo - Y| <= k u |Y| for every element, and lo is a rest."""
    for value, hi, true in zip(exact(result), result.hi.tolist(), expected, strict=True):
        assert abs(value - true) <= Fraction(result.k) * U * abs(true)
        assert abs(value - Fraction(hi)) <= 2**8 * U * abs(Fraction(hi))


@pytest.mark.parametrize("widest", [1.0, 100.0])
def test_rules_of_arithmetic(widest):
    x, y = pairs(1, widest=widest), pairs(2, widest=widest)
    close = Pair(x.hi * (1 + np.arange(COUNT) * 2.0**-50), x.lo)
    for b in (y, close):
        both = list(zip(exact(x), exact(b), strict=True))
        assert_near(x + b, [p + q for p, q in both])
        assert_near(x * b, [p * q for p, q in both])
        assert_near(x / b, [p / q for p, q in both])
    assert (x + y).k == (x * y).k == (x / y).k == EPSILON
    assert_near(-x, [-p for p in exact(x)])
    assert_near(x.scaled(0.25), [p / 4 for p in exact(x)])
    root = x.sqrt()
    for value, true in zip(exact(root), exact(x), strict=True):
        # |value - sqrt| <= k u sqrt
        error = abs(value * value - true) / (2 * true)
        assert error <= Fraction(root.k) * U * Fraction(1001, 1000)
    assert (Pair(np.zeros(1)).sqrt().hi == 0).all()
    assert (Pair(np.zeros(1)).sqrt().lo == 0).all()


def test_errors_add_up():
    x, y = Pair(numbers(3), 0.0, 2.0), Pair(numbers(4), 0.0, 3.0)
    assert (x + y).k == 3 + EPSILON
    assert (x * y).k == (x / y).k == 5 + EPSILON
    assert x.sqrt().k == 1 + EPSILON
    assert x.where(x.hi > 1, y).k == 3


def test_exact_sums_and_products():
    a, b = numbers(5, positive=False), numbers(6, positive=False)
    s, e = pair.two_sum(a, b)
    larger, smaller = np.where(abs(a) >= abs(b), a, b), np.where(abs(a) >= abs(b), b, a)
    t, f = pair.fast_two_sum(larger, smaller)
    p, g = pair.two_product(a, b)
    h, tail = pair.split(a)
    columns = (c.tolist() for c in (a, b, s, e, t, f, p, g, h, tail))
    for row in zip(*columns, strict=True):
        x, y, s, e, t, f, p, g, h, tail = map(Fraction, row)
        assert s + e == t + f == x + y
        assert abs(p + g - x * y) <= Fraction(1, 2**22) * U * abs(x * y)
        assert h + tail == x
        assert abs(tail) <= Fraction(1, 2**25) * abs(x)
        head = abs(h.numerator)
        assert (head // (head & -head)).bit_length() <= 26


@pytest.mark.parametrize("k", [0.0, 0.36, 1.0, 2.4])
def test_bounds_hold_for_all_errors_that_k_allows(k):
    x = pairs(7, positive=False)
    y = Pair(x.hi, x.lo, k)
    (minus_lower, upper), above = y.rows(), y.upper()
    assert (upper == above).all()
    ends = zip(exact(y), (-minus_lower).tolist(), upper.tolist(), strict=True)
    for value, low, high in ends:
        worst = Fraction(k) * U * abs(value) * (1 + 4 * U)  # k u |Y|, Y the farthest one
        assert Fraction(low) <= value - worst
        assert value + worst <= Fraction(high)
        ulp = Fraction(math.ulp(max(abs(low), abs(high))))
        reach = max(value + worst - Fraction(low), Fraction(high) - value + worst)
        assert reach <= Fraction(pair.ulps(k)) * ulp


# -- the constants ---------------------------------------------------------------------------------


def true(function, *arguments):
    low, high = evaluate(function, 400, *arguments)
    return (low + high) / 2


def log_of(x):
    return true(flint.arb.log, x)


def total(parts):
    return sum(map(Fraction, parts))


def test_parts_of_the_logarithms():
    for both, c in ((exponential.LOG_2, log_of(2)), (exponential.LOG10_2, log_of(2) / log_of(10))):
        parts = tuple(map(float, both))
        assert (Fraction(parts[0]) * 2**43).denominator == 1
        assert (Fraction(parts[0]) * 2**43).numerator.bit_length() <= 43
        assert Fraction(parts[0]) * 1023 == Fraction(parts[0] * 1023)
        assert abs(total(parts) - c) < Fraction(1, 2**97)
    assert (Fraction(exponential.LOG_2[0].item()) * 2**42).denominator == 1
    for constant, c in (
        (exponential.LN_2, log_of(2)),
        (exponential.LN_10, log_of(10)),
        (logarithm._PER_LN_2, 1 / log_of(2)),
        (logarithm._PER_LN_10, 1 / log_of(10)),
    ):
        assert abs(total((float(constant.hi), float(constant.lo))) - c) < Fraction(1, 2**100)
    for rough, c in (
        (exponential._LOG2_E, 1 / log_of(2)),
        (exponential._LOG2_10, log_of(10) / log_of(2)),
    ):
        assert abs(Fraction(rough.item()) - c) < 2 * U


def test_coefficients_are_correctly_rounded():
    tables = (
        (exponential._TAYLOR, [Fraction(1, math.factorial(k)) for k in range(13, 2, -1)]),
        (logarithm._SERIES, [Fraction(2, k) for k in range(21, 1, -2)]),
        (arctangent._SERIES, [Fraction((-1) ** (k // 2 + 1), k) for k in range(15, 2, -2)]),
        (realpower._SERIES, [Fraction((-1) ** (k + 1), k) for k in range(10, 2, -1)]),
    )
    for table, expected in tables:
        assert table == tuple(map(float, expected))


def test_mantissas_are_between_the_square_roots():
    x = np.concatenate([numbers(9), np.sqrt(2.0) * 2.0 ** np.arange(-9, 9)])
    x = np.concatenate([x, np.nextafter(x, np.inf), np.nextafter(x, 0)])
    k, m = logarithm.mantissa(x)
    assert (np.ldexp(m, k) == x).all()
    assert (np.nextafter(np.sqrt(0.5), 0) <= m).all()
    assert (m <= np.nextafter(np.sqrt(2.0), 2)).all()
    _, m = logarithm.mantissa(np.array([math.sqrt(2) * 1.0001, math.sqrt(2) / 1.0001]))
    assert (m < [1, 2]).tolist() == [True, True]
    assert m[1] > 1


def test_an_error_of_the_exponent_enters_the_power():
    for k in (0.0, 2.0**-11):
        assert exponential.exp(Pair(np.ones(1), 0.0, k)).k == 0.36 + 710 * k


def test_table_of_angles():
    pi = true(flint.arb.pi)
    for start, base, sign in ((0, 0, 1), (17, pi / 2, -1), (34, pi, -1), (51, pi / 2, 1)):
        for j in range(17):
            c = 0 if j == 1 else Fraction(j, 16)
            assert arctangent._NODES[j] == c
            assert arctangent._SIGNS[start + j] == sign
            angle = base + sign * true(flint.arb.atan, c)
            parts = arctangent._HIGH[start + j], arctangent._LOW[start + j]
            assert abs(total(map(float, parts)) - angle) < Fraction(1, 2**104)


def test_table_of_logarithms():
    inverses, high, low = realpower._tables()
    assert len(inverses) == 182 - 90 + 1
    for j, columns in enumerate(zip(inverses, high, low, strict=True), 90):
        inverse, *parts = map(float, columns)
        assert (Fraction(inverse) * 2**8).denominator == 1
        assert abs(inverse * j / 128 - 1) <= 2.0**-9 * j / 128
        assert abs(total(parts) + log_of(Fraction(inverse))) < Fraction(1, 2**105)
    assert inverses[128 - 90] == 1
    assert high[128 - 90] == low[128 - 90] == 0


def test_the_logarithm_of_powers_is_as_accurate_as_stated():
    x, _ = plane_points("power", 10_000, 8)
    y = realpower._log(x)
    with flint.ctx.workprec(250):
        for point, hi, lo in zip(x.tolist(), y.hi.tolist(), y.lo.tolist(), strict=True):
            error = float(abs(flint.arb(point).log() - hi - lo).upper())
            assert error <= y.k * 2.0**-53 * abs(hi), point.hex()
