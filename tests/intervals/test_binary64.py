"""The functions in binary64: constants, the error bound, containment, stated ulps, refusals."""

import math
from fractions import Fraction
from math import factorial

import flint
import numpy as np
import pytest

from intervals.array import IntervalArray
from intervals.elementary import binary64
from intervals.elementary.binary64 import CHUNK, ERRORS, LIMIT, primitives, trigonometric
from intervals.elementary.binary64.monotone import FUNCTIONS
from tests.intervals.binary64_oracle import ETA, MAX, distances, points, rows
from tests.intervals.measure_errors import errors, proved
from tests.intervals.oracle import pi_bounds
from tests.once import examples

U = Fraction(1, 2**53)
BOUND = Fraction(1, 32)  # in units of u times the result: the theorem of the module
BITS = 2000
HALF_PI = pi_bounds(BITS)[0] / 2  # below pi/2, by less than 2^-BITS
NEAREST = float.fromhex("0x1.6c6cbc45dc8dep+5")  # next to 29 pi/2


# -- the constants and the facts that the proof names ----------------------------------------------


def test_parts_of_the_step():
    p1, p2, p3 = map(Fraction, (trigonometric._P1, trigonometric._P2, trigonometric._P3))
    assert (p1 * 2**42).denominator == (p2 * 2**81).denominator == 1
    assert abs(p2) < Fraction(1, 2**43)
    assert abs(p3) < Fraction(1, 2**83)
    assert abs(HALF_PI / 32 - p1 - p2 - p3) < Fraction(1, 2**136)
    assert abs(Fraction(trigonometric._PER_STEP) * HALF_PI / 32 - 1) < U
    assert np.array([primitives.SHIFT]).view(np.int64)[0] == primitives.SHIFT_BITS


def test_coefficients_are_taylors_correctly_rounded():
    for table, last in ((trigonometric._SIN, 3), (trigonometric._COS, 4)):
        assert len(table) == 3
        for k, coefficient in zip(range(last, last + 6, 2), reversed(table), strict=True):
            exact = Fraction((-1) ** (k // 2), factorial(k))
            assert abs(Fraction(coefficient) - exact) <= Fraction(math.ulp(coefficient)) / 2


def test_tables_of_sines_and_cosines():
    for shift, both in zip((0, 32), trigonometric._sines_and_cosines(), strict=True):
        high, low = (list(map(Fraction, part.numbers)) for part in both)
        assert len(high) == len(low) == 128
        with flint.ctx.workprec(300):
            for n in range(128):
                assert (high[n] * 2**26).denominator == 1 and abs(low[n]) <= Fraction(1, 2**27)
                error = flint.arb(flint.fmpq(n + shift, 64)).sin_pi() - flint.fmpq(
                    (high[n] + low[n]).numerator, (high[n] + low[n]).denominator
                )
                assert abs(error) < flint.arb(2) ** -80
                assert high[n] == 0 or abs(high[n]) >= Fraction(49, 1000)


def neighbours():
    """The binary64 numbers around each n pi/2 in the range, n >= 1."""
    for n in range(1, 653):
        x = float(n * HALF_PI)
        for y in (math.nextafter(x, 0), x, math.nextafter(x, math.inf)):
            yield n, y


def test_no_argument_is_nearer_to_a_multiple_than_the_proof_says():
    distance, n, x = min((abs(Fraction(x) - n * HALF_PI), n, x) for n, x in neighbours())
    assert distance > Fraction(1, 2**61)
    assert (n, x) == (29, NEAREST)
    assert Fraction(LIMIT) < Fraction(1305, 2) * HALF_PI  # so n <= 652


def test_the_last_part_of_the_step_is_small_beside_the_distance():
    p3 = abs(Fraction(trigonometric._P3))
    for n, x in neighbours():
        assert 32 * n * p3 * 2**9 <= abs(Fraction(x) - n * HALF_PI)


def test_error_budget():
    """Add up the proof's list of errors, in units of u, with upper bounds of all sizes."""
    s = HALF_PI / 64 + Fraction(1, 2**40)
    z = s * s * (1 + U)
    cosine, g = z / 2, s * z / 6 + Fraction(1, 2**59)
    least = Fraction(math.floor(math.sin(math.pi / 128) * 10**6), 10**6)
    of_a = (Fraction(13, 2) * cosine + s * Fraction(1, 2**59) / U) * Fraction(201, 100)
    of_b = 4 * g + s**9 / factorial(9) / U + Fraction(3, 2**26)
    assert of_a + of_b / least < Fraction(2, 100)
    near = Fraction(1, 2**8) + 5 * (Fraction(1, 2**9) + z / 6 + Fraction(1, 2**26) + U)
    assert Fraction(1, 100) < near < Fraction(15, 1000)
    assert z**5 / factorial(10) < Fraction(1, 2**75)
    assert trigonometric._ERROR == BOUND


# -- containment -----------------------------------------------------------------------------------


def intervals(seed, count):
    """Points, intervals an ulp wide, narrow, of some quarter turns, and of any size."""
    rng = np.random.default_rng(seed)
    x, other = points("sin", count, seed), points("sin", count, seed + 1)
    narrow, some = x + 2.0 ** rng.uniform(-50, 0, count), x + rng.uniform(0, 10, count)
    y = np.choose(rng.integers(0, 5, count), [x, np.nextafter(x, np.inf), some, narrow, other])
    return IntervalArray.from_floats(np.minimum(x, y), np.minimum(np.maximum(x, y), LIMIT))


def members(x):
    """The ends, points between them, and a multiple of pi/2 where there is one."""
    rng = np.random.default_rng(0)
    yield from (x.inf, x.sup, np.clip(x.inf + (x.sup - x.inf) * rng.random(x.shape), x.inf, x.sup))
    n = np.ceil(x.inf / (math.pi / 2)) + rng.integers(0, 4, x.shape)
    yield np.clip(n * (math.pi / 2), x.inf, x.sup)


def assert_contains(x, sin, cos):
    for name, y in (("sin", sin), ("cos", cos)):
        assert (y.inf >= -1).all() and (y.sup <= 1).all()
        for points_inside in members(x):
            distances(name, [points_inside], rows(y.inf, y.sup))


def test_bounds_at_points_are_within_the_stated_ulps():
    x = np.concatenate([points("sin", 20_000, 1), random_points(examples(12_000, 100_000), 13)])
    sin, cos = IntervalArray.from_floats(x).sincos()
    for name, y in (("sin", sin), ("cos", cos)):
        assert distances(name, [x], rows(y.inf, y.sup)).max() <= ERRORS[name]
        assert (y.inf >= -1).all() and (y.sup <= 1).all()
    # |sin x| < |x| and cos x < 1, however small x is
    assert (np.where(x > 0, sin.inf, -sin.sup) < np.abs(x))[x != 0].all()
    assert (cos.inf < 1)[x != 0].all()


@pytest.mark.slow
def test_intervals_are_enclosed():
    x = intervals(2, 20000)
    assert_contains(x, *x.sincos())


def test_multiples_of_half_pi_are_enclosed():
    near = [x for _, x in neighbours() if x <= LIMIT]
    x = IntervalArray.from_floats(near + [-v for v in near])
    assert_contains(x, *x.sincos())
    # [a, b] around n pi/2, two ulps wide, must hold the extremum exactly
    y = np.array([float(n * HALF_PI) for n in range(-651, 652)])
    x = IntervalArray.from_floats(np.nextafter(y, -np.inf), np.nextafter(y, np.inf))
    sin, cos = x.sincos()
    n = np.arange(-651, 652) % 4
    assert (sin.sup[n == 1] == 1).all()
    assert (sin.inf[n == 3] == -1).all()
    assert (cos.sup[n == 0] == 1).all()
    assert (cos.inf[n == 2] == -1).all()
    # and zeros of the other function inside
    assert sin.contains(0)[n % 2 == 0].all()
    assert cos.contains(0)[n % 2 == 1].all()


def sup_is_one(low, high, quarter):
    """Whether quarter pi/2 + 2 pi k is in [low, high] for some k, exactly."""
    k = math.ceil((Fraction(low) / HALF_PI - quarter) / 4)
    return (4 * k + quarter) * HALF_PI <= Fraction(high)


@pytest.mark.slow
def test_wide_results_are_tight():
    """The bounds are those at the ends, or +-1: never much more."""
    x = intervals(4, 5000)
    tiny = (np.abs([x.inf, x.sup]) < 2.0**-400) & (np.array([x.inf, x.sup]) != 0)
    x = x[~tiny.any(axis=0)]  # which multiprecision has, both ends at once
    ends = [IntervalArray.from_floats(e).sincos() for e in (x.inf, x.sup)]
    for name, quarters in ((0, (1, 3)), (1, (0, 2))):
        y, hull = x.sincos()[name], ends[0][name].hull(ends[1][name])
        for i, (low, high) in enumerate(zip(x.inf.tolist(), x.sup.tolist(), strict=True)):
            assert y.sup[i] == (1 if sup_is_one(low, high, quarters[0]) else hull.sup[i])
            assert y.inf[i] == (-1 if sup_is_one(low, high, quarters[1]) else hull.inf[i])


# -- the measured error ----------------------------------------------------------------------------


def largest_error(name, x):
    return errors(name, x)[1].max()


def random_points(count, seed):
    rng = np.random.default_rng(seed)
    spread = rng.uniform(-LIMIT, LIMIT, count // 2)
    edges = (rng.integers(-650, 650, count // 2) + 0.5) * (math.pi / 2)  # |r| near pi/4: the worst
    return np.concatenate([spread, edges + rng.uniform(-0.02, 0.02, count // 2)])


def test_measured_error_is_within_the_proved_bound():
    x = random_points(examples(60_000, 300_000), 8)
    assert max(largest_error(name, x) for name in ("sin", "cos")) <= BOUND
    # what this scheme of evaluation is known to reach: a term left out would show
    central = np.random.default_rng(9).uniform(-math.pi / 4, math.pi / 4, 20_000)
    assert 0.001 < largest_error("sin", central) < 0.01
    assert 0.001 < largest_error("cos", central) < 0.01


def test_the_reduction_is_exact_to_twice_the_precision():
    x = np.array([v for _, v in neighbours() if v <= LIMIT])
    assert max(largest_error(name, x) for name in ("sin", "cos")) <= BOUND


# -- beyond the limit, and how arrays are split ----------------------------------------------------


def test_beyond_the_limit():
    above = math.nextafter(LIMIT, math.inf)
    lower = [LIMIT, above, -above, 1000.0, -5e4, 1e300, -1e22, 0.5, -2e3, LIMIT]
    upper = [LIMIT, above, -above, 1025.0, -5e4 + 1e-3, 1e300, -1e22, 0.75, 2e3, above]
    x = IntervalArray.from_floats(lower, upper)
    sin, cos = x.sincos()
    assert_contains(x, sin, cos)
    assert (sin.wid[[0, 1, 2, 5, 6, 9]] < 1e-12).all()
    assert (sin[7] == IntervalArray.from_floats(0.5, 0.75).sin()).all()
    assert (sin.inf[8], sin.sup[8], cos.inf[8], cos.sup[8]) == (-1, 1, -1, 1)
    rng = np.random.default_rng(10)
    lower = rng.choice([-1, 1], 300) * (LIMIT + rng.exponential(3, 300))
    x = IntervalArray.from_floats(lower, lower + rng.uniform(0, 6, 300))
    assert_contains(x, *x.sincos())


def test_chunks_do_not_show():
    rng = np.random.default_rng(11)
    lower = rng.uniform(-20, 20, 2 * CHUNK + 17)
    for upper in (lower, lower + 0.5):
        x = IntervalArray.from_floats(lower, upper)
        sin, cos = x.sincos()
        parts = zip(*(x[i : i + 1000].sincos() for i in range(0, len(x), 1000)), strict=True)
        assert all((np.concatenate(p) == y).all() for p, y in zip(parts, (sin, cos), strict=True))
        assert (x.reshape(1, -1).sin() == sin).all()
        for i in range(0, len(x), 300):  # by Python's floats
            assert all((a == b[i]).all() for a, b in zip(x[i].sincos(), (sin, cos), strict=True))
    mixed = IntervalArray.from_floats(lower, np.where(np.arange(len(lower)) % 2, lower, lower + 1))
    points_alone = IntervalArray.from_floats(lower).sin()
    assert (mixed.sin() == points_alone)[1::2].all()


# -- the monotone functions in binary64 against Arb ------------------------------------------------


QUICK = 1200
every_function = pytest.mark.parametrize("name", FUNCTIONS)


def enclosed(name, lower, upper=None):
    """The bounds (lower, upper) of monotone(name) as arrays."""
    low, high = binary64.monotone(name, rows(np.asarray(lower), upper))
    return -low, high


@every_function
def test_points(name):
    count = examples(3 * QUICK, 200_000)
    x = points(name, count, seed=1)
    within = proved(name, x)
    assert within.sum() > 0.5 * count
    for part, stated in (
        (x[within][:100_000], binary64.ERRORS[name]),
        (x[~within][: 300 + count // 300], 1.0),  # multiprecision, rounded outward
    ):
        assert distances(name, [part], binary64.monotone(name, rows(part))).max(initial=0) <= stated


@every_function
def test_errors_are_within_the_proved_bounds(name):
    _, error, k = errors(name, points(name, 5 * QUICK, seed=3))
    assert error.max() <= k <= FUNCTIONS[name].k
    assert binary64.ERRORS[name] <= 2 * FUNCTIONS[name].k + 1.54


@every_function
def test_wide_intervals_contain_images_and_are_those_of_the_ends(name):
    a, b = points(name, QUICK, seed=4), points(name, QUICK, seed=5)
    both = proved(name, a) & proved(name, b)
    keep = both | (np.arange(len(a)) < 60)  # some for multiprecision
    lower, upper, both = np.minimum(a, b)[keep], np.maximum(a, b)[keep], both[keep]
    low, high = enclosed(name, lower, upper)
    ends = [enclosed(name, lower), enclosed(name, upper)]
    first, last = ends[::-1] if FUNCTIONS[name].decreasing else ends
    assert (low == first[0])[both].all()
    assert (high == last[1])[both].all()
    t = np.random.default_rng(6).random(len(lower))
    inner = np.clip(lower * (1 - t) + upper * t, lower, upper)
    distances(name, [inner], rows(low, high))


@every_function
def test_blocks_and_shapes_do_not_show(name):
    low, high = FUNCTIONS[name].low, FUNCTIONS[name].high
    low, high = max(low, 0.01 if name.startswith("log") else -0.9), min(high, 0.9)
    x = np.linspace(low, max(high, low + 0.9), binary64.CHUNK + 6)
    whole = binary64.monotone(name, rows(x))
    parts = [binary64.monotone(name, rows(x[i : i + 7000])) for i in range(0, len(x), 7000)]
    assert (np.concatenate(parts, axis=1) == whole).all()
    assert (binary64.monotone(name, rows(x).reshape(2, 5, -1)).reshape(2, -1) == whole).all()
    ones = [binary64.monotone(name, rows(x[i : i + 1])) for i in range(0, len(x), 400)]
    assert (np.concatenate(ones, axis=1) == whole[:, ::400]).all()  # by Python's floats
    wide = binary64.monotone(name, rows(x, x + 0.01 * (x < 0.5)))
    assert (wide[0] == whole[0]).all() or name == "acos"
    assert binary64.monotone(name, np.empty((2, 0))).shape == (2, 0)


def test_ranges_are_respected():
    x = np.array([1.0, 18.0, 19.0, 20.0, 400.0, 1e200, MAX])
    low, high = enclosed("tanh", x)
    assert (high <= 1).all()
    assert (low[3:] >= 1 - 2.0**-50).all()
    assert enclosed("expm1", np.array([-650.0, -5000.0, -MAX]))[0].tolist() == [-1.0] * 3
    for name in ("exp", "exp2", "exp10"):
        low, high = enclosed(name, np.array([-5000.0, -1e300]))
        assert low.tolist() == [0.0, 0.0]
        assert high.tolist() == [ETA, ETA]
    assert enclosed("cosh", np.array([0.0]))[0] == 1.0
    assert enclosed("acos", np.array([1.0]))[0] == 0.0
    half_pi = float(flint.arb.pi()) / 2
    for name, x in (("asin", 1.0), ("atan", MAX), ("atan", 1e30)):
        low, high = enclosed(name, np.array([x]))
        assert half_pi - 1e-15 < low[0] <= half_pi < high[0] <= math.nextafter(half_pi, 2)


@pytest.mark.parametrize("name", ["exp", "exp2", "exp10", "expm1", "sinh", "cosh"])
def test_what_is_beyond_binary64_is_unbounded(name):
    for x in (1100.0, 1e9, MAX, math.inf):
        low, high = enclosed(name, np.array([0.5, x]))
        assert (low[1] == MAX or x == math.inf) and high[1] == math.inf and high[0] < 4
    low, high = enclosed("sinh", np.array([-1e5]))
    assert (low[0], high[0]) == (-math.inf, -MAX)


def test_a_bad_candidate_for_the_cube_root_is_not_believed(monkeypatch):
    x = np.array([8.0, -2.0, 1e9, 0.0])
    cbrt = np.cbrt
    monkeypatch.setattr(np, "cbrt", lambda v: cbrt(v) * np.array([1 + 2.0**-8, 2, np.nan, 1]))
    low, high = enclosed("cbrt", x)
    assert distances("cbrt", [x[:3]], rows(low[:3], high[:3])).max() <= 1
    assert (low[3], high[3]) == (0, 0)
