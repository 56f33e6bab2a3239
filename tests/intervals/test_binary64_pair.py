"""The rules of pairs against exact rationals, and the constants of the kernels against Arb."""

import math
from fractions import Fraction

import flint
import numpy as np
import pytest

from intervals.elementary.binary64 import arctangent, exponential, logarithm, pair
from intervals.elementary.binary64.pair import EPSILON, Pair
from intervals.elementary.binary64.primitives import split
from tests.intervals.binary64_oracle import plane_points
from tests.intervals.oracle import evaluate

U = Fraction(1, 2**53)
HALF = Fraction(1, 2)
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
    h, tail = split(a)
    columns = (c.tolist() for c in (a, b, s, e, t, f, p, g, h, tail))
    for row in zip(*columns, strict=True):
        x, y, s, e, t, f, p, g, h, tail = map(Fraction, row)
        assert s + e == t + f == x + y
        assert p + g == x * y
        assert h + tail == x
        for part in (abs(h.numerator), abs(tail.numerator)):
            assert part == 0 or (part // (part & -part)).bit_length() <= 26


@pytest.mark.parametrize("k", [0.0, 0.36, 1.0, 2.4])
@pytest.mark.parametrize("rounded", [pair.bounds, pair.least_bounds])
def test_bounds_hold_for_all_errors_that_k_allows(k, rounded):
    x = pairs(7, positive=False)
    x = Pair(x.hi, x.lo * np.where(np.arange(COUNT) % 5 == 0, 2.0**44, 1.0))  # up to 2^-9 |hi|
    below, above = rounded(Pair(x.hi, x.lo, k))
    for value, low, high in zip(exact(x), (-below).tolist(), above.tolist(), strict=True):
        worst = Fraction(k) * U * abs(value) * (1 + 4 * U)  # k u |Y|, Y the farthest one
        assert Fraction(low) <= value - worst
        assert value + worst <= Fraction(high)
        ulp = Fraction(math.ulp(max(abs(low), abs(high))))
        reach = max(value + worst - Fraction(low), Fraction(high) - value + worst)
        assert reach <= (Fraction(pair.ulps(k)) - (rounded is pair.least_bounds) * HALF) * ulp


def test_floats_and_arrays_have_the_same_bits():
    x, y = numbers(8), numbers(9)
    for rounded in (pair.bounds, pair.least_bounds):
        for compute in (
            lambda a, b: (Pair(a) + Pair(b)).sqrt(),
            lambda a, b: Pair(a) * Pair(b) / (Pair(b) + Pair(a)),
        ):
            arrays = rounded(compute(x, y))
            single = [rounded(compute(*z)) for z in zip(x.tolist(), y.tolist(), strict=True)]
            assert [*map(np.ndarray.tolist, arrays)] == [*map(list, zip(*single, strict=True))]


# -- the constants ---------------------------------------------------------------------------------


def true(function, *arguments):
    low, high = evaluate(function, 400, *arguments)
    return (low + high) / 2


def log_of(x):
    return true(flint.arb.log, x)


def total(parts):
    return sum(map(Fraction, parts))


def test_parts_of_the_logarithms():
    for parts, c, places in (
        (exponential.STEP_E, log_of(2) / 64, 42),
        (exponential.STEP_10, log_of(2) / log_of(10) / 64, 43),
        (logarithm.LOG_2, log_of(2), 42),
    ):
        assert (Fraction(parts[0]) * 2**places).denominator == 1
        bits = (Fraction(parts[0]) * 2**places).numerator.bit_length()
        assert bits <= (36 if places == 43 or c < Fraction(1, 2) else 43)
        assert abs(parts[1]) < 2.0**-43 and abs(total(parts) - c) < Fraction(1, 2**96)
    for constant, c in (
        (exponential.LN_2, log_of(2)),
        (exponential.LN_10, log_of(10)),
        (logarithm._PER_LN_2, 1 / log_of(2)),
        (logarithm._PER_LN_10, 1 / log_of(10)),
    ):
        assert abs(total((float(constant.hi), float(constant.lo))) - c) < Fraction(1, 2**100)
    for rough, c in (
        (exponential._STEPS_E, 64 / log_of(2)),
        (exponential._STEPS_10, 64 * log_of(10) / log_of(2)),
    ):
        assert abs(Fraction(rough) - c) < 128 * U


def test_coefficients_are_correctly_rounded():
    tables = (
        (exponential._TAYLOR, [Fraction(1, math.factorial(k)) for k in range(7, 2, -1)]),
        (arctangent._SERIES, [Fraction((-1) ** (k // 2 + 1), k) for k in range(15, 2, -2)]),
        (logarithm._SERIES, [Fraction((-1) ** (k + 1), k) for k in range(9, 2, -1)]),
    )
    for table, expected in tables:
        assert table == tuple(map(float, expected))


@pytest.mark.parametrize("places", [25, 52])
def test_table_of_powers(places):
    high, low = (part.numbers for part in exponential._powers(places))
    for j, parts in enumerate(zip(high, low, strict=True)):
        assert (Fraction(parts[0]) * 2**places).denominator == 1
        assert abs(parts[1]) <= 2.0 ** -(places + 1)
        assert abs(total(parts) ** 64 / 2**j - 1) < Fraction(1, 2**72)
    assert len(high) == 64 and (high[0], low[0]) == (1, 0)


def test_mantissas_and_their_cells():
    x = np.concatenate([numbers(9), 0.708 * 2.0 ** np.arange(-9, 9), 2.0 ** np.arange(-9, 9)])
    x = np.concatenate([x, np.nextafter(x, np.inf), np.nextafter(x, 0)])
    inverses = logarithm._cells()[0]
    k, m, cell = logarithm.mantissa(x)
    assert (np.ldexp(m, k.astype(int)) == x).all()
    assert (m >= 0.708).all() and (m < 1.4161).all()
    for y, inverse in zip(m.tolist(), inverses[cell].tolist(), strict=True):
        assert abs(Fraction(y) * Fraction(inverse) - 1) <= Fraction(29, 10000)
        if inverse == 1:
            assert 1 - Fraction(1, 2**10) <= y <= 1 + Fraction(1, 2**9)
    single = [logarithm.mantissa(y) for y in x.tolist()]
    assert single == [*zip(k.tolist(), m.tolist(), cell.tolist(), strict=True)]


def test_an_error_of_the_exponent_enters_the_power():
    for k in (0.0, 2.0**-11):
        assert exponential.exp(Pair(np.ones(1), 0.0, k)).k == 2.0**-6 + 710 * k


def test_table_of_angles():
    pi = true(flint.arb.pi)
    for start, base, sign in ((0, 0, 1), (17, pi / 2, -1), (34, pi, -1), (51, pi / 2, 1)):
        for j in range(17):
            c = 0 if j == 1 else Fraction(j, 16)
            assert arctangent._NODES.numbers[j] == c
            assert arctangent._SIGNS.numbers[start + j] == sign
            angle = base + sign * true(flint.arb.atan, c)
            parts = arctangent._HIGH.numbers[start + j], arctangent._LOW.numbers[start + j]
            assert abs(total(map(float, parts)) - angle) < Fraction(1, 2**104)


def test_table_of_logarithms():
    """Each is 0, or larger than r on its cell."""
    inverses, high, low = (part.numbers for part in logarithm._cells())
    assert len(inverses) == 256
    edges = [1 + (Fraction(c) - Fraction(299, 2)) / (512 if c < 149.5 else 256) for c in range(257)]
    for cell, (inverse, *parts) in enumerate(zip(inverses, high, low, strict=True)):
        assert (Fraction(inverse) * 2**9).denominator == 1
        assert (Fraction(parts[0]) * 2**42).denominator == 1
        log = -log_of(Fraction(inverse))
        assert abs(total(parts) - log) < Fraction(1, 2**95)
        most = max(abs(edge * Fraction(inverse) - 1) for edge in edges[cell : cell + 2])
        assert inverse == 1 or abs(parts[0]) > most
        assert most <= Fraction(29, 10000)
    assert (inverses[149], high[149], low[149]) == (1, 0, 0) and inverses.count(1) == 1


def test_the_sharp_logarithm_is_as_accurate_as_stated():
    x, _ = plane_points("power", 10_000, 8)
    y = logarithm.sharp_log(Pair(x))
    with flint.ctx.workprec(250):
        for point, hi, lo in zip(x.tolist(), y.hi.tolist(), y.lo.tolist(), strict=True):
            error = float(abs(flint.arb(point).log() - hi - lo).upper())
            assert error <= y.k * 2.0**-53 * abs(hi), point.hex()
