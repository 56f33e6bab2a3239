"""IntervalArray against exact rationals: containment, ulps, isotonicity, refusals, indexing."""

import math
import operator
import random
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import strategies as st

from intervals import DomainError, Interval, TightArray
from intervals.array import IntervalArray
from tests.intervals import oracle
from tests.intervals.boxes import for_all

ETA, MAX = 2.0**-1074, math.nextafter(math.inf, 0.0)
STATED = Fraction(5, 2)  # ulps: CONFORMANCE.md
BINARY = {"+": operator.add, "-": operator.sub, "*": operator.mul, "/": operator.truediv}


def magnitudes(rng):
    """A positive number, often on an edge of binary64."""
    kind = rng.randrange(6)
    if kind == 0:
        return rng.choice([ETA, 3 * ETA, 2.0**-1022, 2.0**-1022 - ETA, 1.0, 2.0**52, 1e300, 1e-300])
    if kind == 1:
        return math.ldexp(rng.random(), rng.randrange(-1074, -960))
    if kind == 2:
        return math.ldexp(0.5 + rng.random(), rng.randrange(-300, 300))
    return rng.uniform(0, 10)


def endpoints(rng):
    """An interval: a point, one ulp wide, narrow, wide, around 0, or touching it."""
    x = rng.choice([-1, 1]) * magnitudes(rng)
    kind = rng.randrange(6)
    if kind == 0:
        return x, x
    if kind == 1:
        return x, math.nextafter(x, math.inf)
    if kind == 2:
        return x, x + abs(x) * 2.0 ** -rng.randrange(1, 50)
    if kind == 3:
        return -magnitudes(rng), magnitudes(rng)
    if kind == 4:
        return (0.0, abs(x)) if x > 0 else (x, 0.0)
    y = rng.choice([-1, 1]) * magnitudes(rng)
    return min(x, y), max(x, y)


def sample(seed, count, keep=lambda lower, upper: True):
    rng = random.Random(seed)
    pairs = [pair for pair in (endpoints(rng) for _ in range(count)) if keep(*pair)]
    lower, upper = zip(*pairs, strict=True)
    return IntervalArray.from_floats(list(lower), list(upper))


def moderate(lower, upper):
    return -1e60 < lower <= upper < 1e60


def members(x, seed):
    """A few exact numbers in each interval: the ends, the middle, somewhere."""
    rng = random.Random(seed)
    for low, high in zip(x.inf.tolist(), x.sup.tolist(), strict=True):
        a, b = Fraction(low), Fraction(high)
        yield [a, b, (a + b) / 2, a + (b - a) * Fraction(rng.random())]


def fits(x, y, op):
    """Keep pairs whose results stay in range."""
    a, b = (np.log2(np.maximum(v.mag, ETA)) for v in (x, y))
    if op == "*":
        return a + b < 1000
    if op == "/":
        apart = y.certainly_positive() | y.certainly_negative()
        return apart & (a - np.log2(np.maximum(y.mig, ETA)) < 1000)
    return np.full(x.shape, True)


def near(bound, true):
    """Whether they are 2.5 ulps of the larger apart, or near underflow two eta more."""
    ulp = math.ulp(max(abs(bound), abs(float(true))))
    return abs(Fraction(bound) - true) <= STATED * Fraction(ulp) + 2 * Fraction(ETA)


def check_bounds(z, true):
    """The bounds contain the true results, and are near the least and the largest of them."""
    for low, high, results in zip(z.inf.tolist(), z.sup.tolist(), true, strict=True):
        least, most = min(results), max(results)
        assert Fraction(low) <= least and most <= Fraction(high)
        assert near(low, least) and near(high, most)


@pytest.mark.parametrize("op", BINARY)
@pytest.mark.parametrize("thin", ["neither", "left", "right", "both"])
def test_binary_operations_contain_every_exact_result(op, thin):
    x, y = sample(op + thin, 1500), sample(thin + op, 1500)
    if thin in ("left", "both"):
        x = IntervalArray.from_floats(x.inf)
    if thin in ("right", "both"):
        y = IntervalArray.from_floats(y.sup)
    keep = fits(x, y, op)
    x, y = x[keep], y[keep]
    pairs = zip(members(x, 1), members(y, 2), strict=True)
    check_bounds(BINARY[op](x, y), ([BINARY[op](p, q) for p in xs for q in ys] for xs, ys in pairs))


@pytest.mark.parametrize("power", [2, 3, 5, -2])
def test_powers_contain_every_exact_result(power):
    x = sample(power, 3000, moderate)
    if power < 0:
        x = x[(x.certainly_positive() | x.certainly_negative()) & (x.mig > 1e-100)]
    y = x**power
    for xs, low, high in zip(members(x, 3), y.inf.tolist(), y.sup.tolist(), strict=True):
        results = [p**power for p in xs]
        assert Fraction(low) <= min(results) and max(results) <= Fraction(high)


def test_squares_and_absolute_values():
    x = sample("square", 3000, moderate)
    touches = ~(x.certainly_positive() | x.certainly_negative())
    for y, function in ((x.sqr(), lambda p: p * p), (abs(x), abs), (-x, operator.neg)):
        true = ([function(p) for p in xs] for xs in members(x[~touches], 4))
        check_bounds(y[~touches], true)
    for y in (x.sqr(), abs(x)):
        assert (y.inf >= 0).all() and touches.any() and (y.inf[touches] == 0).all()


def test_sqrt_contains_every_root():
    x = sample("sqrt", 3000, lambda a, b: a >= 0)
    y = x.sqrt()
    assert (y.inf >= 0).all()
    for xs, low, high in zip(members(x, 4), y.inf.tolist(), y.sup.tolist(), strict=True):
        assert Fraction(low) ** 2 <= min(xs) and max(xs) <= Fraction(high) ** 2
        assert near(low, oracle.sqrt_down(min(xs), 200)) and near(
            high, oracle.sqrt_up(max(xs), 200)
        )


# -- construction ----------------------------------------------------------------------------------


@for_all(st.lists(st.fractions(), min_size=1, max_size=5), tries=100)
def test_exact_numbers_are_enclosed_tightly(values):
    x = IntervalArray(values)
    for value, low, high in zip(values, x.inf.tolist(), x.sup.tolist(), strict=True):
        assert Fraction(low) <= value <= Fraction(high)
        assert low == high or math.nextafter(low, math.inf) == high


def test_exact_constructor():
    x = IntervalArray([["0.1", "7/5"], [("-1", Interval("0.3")), Interval("1", "2")]])
    assert x.shape == (2, 2)
    for index, value in (((0, 0), Fraction(1, 10)), ((0, 1), Fraction(7, 5))):
        assert x[index].contains(value)
        assert x[index].wid > 0
    assert x[1, 0].contains(IntervalArray(("-1", "0.3")))
    assert (x[1, 1].inf, x[1, 1].sup) == (1, 2)
    assert IntervalArray([2**53, -5, np.int64(7)]).wid.tolist() == [0, 0, 0]
    assert IntervalArray(np.arange(4)).sup.tolist() == [0, 1, 2, 3]
    shapes = [IntervalArray(v).shape for v in (range(3), "0.1", [])]
    assert shapes == [(3,), (), (0,)]
    assert (IntervalArray([]) * IntervalArray([])).sin().shape == (0,)
    assert (IntervalArray.from_exact(["1/3"]) == IntervalArray([Fraction(1, 3)])).all()


NO_NUMBERS = [[0.1], 0.1, [np.float64(1)], np.ones(3), [("0", 1.0)]]
NO_INTERVALS = [[("1", "0")], [("1", "2", "3")], [["1", "2"], ["3"]], ["one"]]


@pytest.mark.parametrize(
    ("values", "error"),
    [
        *((values, TypeError) for values in NO_NUMBERS),
        *((values, ValueError) for values in NO_INTERVALS),
    ],
)
def test_exact_constructor_refuses(values, error):
    with pytest.raises(error):
        IntervalArray(values)


NO_FLOATS = [("0.1",), ([None],), ([Fraction(1, 3)],)]
NO_BOUNDS = [
    *((math.nan,), ([1.0, math.inf],), (1.0, math.nan), ([0.0, 2.0], [1.0, 1.0])),
    *(([2**53 + 1, 0.5],), ([1.0, 2.0], [3.0, 4.0, 5.0])),
]


@pytest.mark.parametrize(
    ("bounds", "error"),
    [
        *((bounds, TypeError) for bounds in NO_FLOATS),
        *((bounds, ValueError) for bounds in NO_BOUNDS),
        (([2**2000],), (ValueError, OverflowError)),
    ],
)
def test_from_floats_refuses(bounds, error):
    with pytest.raises(error):
        IntervalArray.from_floats(*bounds)


def test_from_floats_takes_numbers_as_they_are():
    source = np.array([1.5, -0.0, MAX])
    x = IntervalArray.from_floats(source)
    source[:] = 0
    assert x.inf.tolist() == x.sup.tolist() == [1.5, 0.0, MAX]
    assert x.wid.tolist() == [0, 0, 0]
    assert IntervalArray.from_floats(0.1, [1, 2]).shape == (2,)
    assert IntervalArray.from_floats(np.float32(0.1)).sup == float(np.float32(0.1))


# -- operands, refusals ----------------------------------------------------------------------------


@pytest.mark.parametrize("op", BINARY)
def test_scalars_on_either_side(op):
    x = sample("scalar", 40, lambda a, b: (a > 1e-9 or b < -1e-9) and max(-a, b) < 1e9)
    for scalar in (0, 1, -8, 3, 2**60 + 1, Fraction(-1, 3), Interval("-0.2", "-0.1"), np.int64(5)):
        if isinstance(scalar, Interval):
            ends = (scalar.inf, scalar.sup)
        else:
            ends = (scalar if isinstance(scalar, Fraction) else Fraction(int(scalar)),)
        if op == "/" and ends == (0,):
            with pytest.raises(DomainError):
                x / scalar
        else:
            z = BINARY[op](x, scalar)
            for i, xs in enumerate(members(x, 6)):
                assert all(z[i].contains(BINARY[op](p, q)) for p in xs for q in ends)
        z = BINARY[op](scalar, x)
        for i, xs in enumerate(members(x, 6)):
            assert all(z[i].contains(BINARY[op](q, p)) for p in xs for q in ends)


def test_results_out_of_range_are_unbounded():
    big = IntervalArray.from_floats([1.0, -1e300])
    huge = IntervalArray.from_floats([MAX])
    for result, low, high in (
        ((big * big)[1], MAX, math.inf),
        ((big * 10**10)[1], -math.inf, -MAX),
        ((big / IntervalArray(["1e-20"]))[1], -math.inf, -MAX),
        ((big * 2**60)[1], -math.inf, -MAX),
        ((big * -(2**60))[1], MAX, math.inf),
        (big.sqr()[1], MAX, math.inf),
        (-(big[1] ** 3), MAX, math.inf),
        ((huge + huge)[0], MAX, math.inf),
        ((-huge - huge)[0], -math.inf, -MAX),
        ((big + 10**400)[0], MAX, math.inf),
        (IntervalArray([1000]).exp()[0], MAX, math.inf),
        (IntervalArray([-1000]).sinh()[0], -math.inf, -MAX),
    ):
        assert low - MAX * 2.0**-50 <= float(result.inf) <= low or low == -math.inf == result.inf
        assert high <= float(result.sup) <= high + MAX * 2.0**-50
    assert IntervalArray.from_floats(-MAX, MAX).wid == math.inf
    with pytest.raises(OverflowError, match="not bounded"):
        (big * big)[1].item()


ENDS = st.sampled_from([-math.inf, -MAX, -3.0, -1.0, 0.0, 0.5, 2.0, 1e200, MAX, math.inf])
UNBOUNDED = st.tuples(ENDS, ENDS).map(sorted).filter(lambda x: x[0] < math.inf and x[1] > -math.inf)
ONE = ["sqrt", "cbrt", "exp", "exp2", "exp10", "expm1", "log", "log2", "log10", "log1p", "asin"]
ONE += ["atan", "sinh", "cosh", "tanh", "asinh", "acosh", "atanh", "sin", "cos", "floor", "sign"]
INSIDE = st.sampled_from([-1e300, -1e5, -3.0, -1.0, 0.0, 0.25, 2.0, 1e5, 1e300])


POINTS = st.tuples(INSIDE, INSIDE)


@for_all(
    st.sampled_from(["pow", "hypot", "atan2", *ONE]), UNBOUNDED, UNBOUNDED, POINTS, at_length=300
)
def test_unbounded_arrays_contain_the_values_at_points(name, x, y, point):
    a, b = point
    sets = [IntervalArray.from_floats([low], [high]) for low, high in (x, y)]
    if not (x[0] <= a <= x[1] and y[0] <= b <= y[1]):
        return
    count = 2 if name in ("pow", "hypot", "atan2") else 1
    try:
        found = getattr(sets[0], name)(*sets[1:count])
        value = getattr(Interval.from_float(a), name)(*map(Interval.from_float, [b][: count - 1]))
    except (DomainError, OverflowError):
        return
    assert found.contains(value).all()


def test_division_by_zero_is_refused():
    for bounds in ((0.0, 0.0), (-1.0, 1.0), (0.0, 1.0), (-1.0, 0.0)):
        x = IntervalArray.from_floats([1.0, bounds[0]], [1.0, bounds[1]])
        for operation in (lambda x=x: 1 / x, lambda x=x: x / x, lambda x=x: x**-1):
            with pytest.raises(DomainError):
                operation()


def test_nan_decides_nothing():
    x = IntervalArray([(1, 2)])
    x._rows = np.full((2, 1), math.nan)
    y = IntervalArray([(0, 3)])
    masks = (x.certainly_positive(), x.certainly_negative(), x.certainly_less(y), x == y)
    more = (y.certainly_less(x), x.subset(y), y.subset(x), x.contains(y), y.contains(x))
    assert not any(mask.any() for mask in masks + more)
    for operation in (*(lambda: x + y, lambda: 2 * x, x.sqr, lambda: x.intersection(y)),):
        assert operation().sup == math.inf
    for operation in (lambda: x * y, lambda: y * x, lambda: 3 * x):
        with pytest.raises(FloatingPointError):
            operation()
    for refused in (lambda: y / x, lambda: 1 / x, x.sqrt, x.log):
        with pytest.raises(DomainError):
            refused()


def test_undefined_questions_are_refused():
    x = IntervalArray([1, 2])
    for operation in (
        *(lambda: x < IntervalArray([3]), lambda: x <= 1, lambda: operator.gt(1, x)),
        *(lambda: x >= Fraction(1, 2), lambda: bool(x), lambda: x == 1, lambda: hash(x)),
        *(lambda: x.contains(1.0), lambda: x + "1", lambda: x + None),
    ):
        with pytest.raises(TypeError):
            operation()


# -- the sets, their shape -------------------------------------------------------------------------


def test_hull_and_intersection():
    x, y = IntervalArray([(0, 2), (1, 3)]), IntervalArray([(1, 5), (3, 4)])
    hull, common = x.hull(y), x.intersection(y)
    assert (hull.inf.tolist(), hull.sup.tolist()) == ([0, 1], [5, 4])
    assert (common.inf.tolist(), common.sup.tolist()) == ([1, 3], [2, 3])
    assert x.intersection(IntervalArray([(0, 1), (4, 5)])) is None


def test_mid_wid_and_rad():
    x = sample("mid", 3000)
    assert (x.inf <= x.mid).all() and (x.mid <= x.sup).all()
    columns = (c.tolist() for c in (x.inf, x.sup, x.mid, x.wid, x.rad))
    for row in zip(*columns, strict=True):
        low, high, mid, wid, rad = map(Fraction, row)
        assert high - low <= wid and max(high - mid, mid - low) <= rad
        assert (low == high) == (wid == 0)


def test_shapes_broadcast_and_index_as_numpy():
    a = np.arange(24.0).reshape(2, 3, 4)
    x, row = IntervalArray.from_floats(a, a + 1), IntervalArray.from_floats(np.arange(4.0))
    assert (x.shape, x.ndim, x.size, len(x)) == ((2, 3, 4), 3, 24, 2)
    total = x + row
    assert total.contains(IntervalArray.from_floats(a + np.arange(4.0))).all()
    assert (row + x == total).all()
    assert (x * row[:, None, None, None]).shape == (4, 2, 3, 4)
    assert (row - x).shape == (row / (x + 1)).shape == (2, 3, 4)
    every = slice(None)
    for index in (
        *(0, -1, (1, 2, 3), slice(None, 1), (..., 0), (every, [0, 2]), None),
        *(([0, 1], every, [0, 3]), a > 5, (every, a[0] > 5), (every, None, slice(1, None))),
    ):
        assert np.array_equal(x[index].inf, a[index])
        assert np.array_equal(x[index].sup, a[index] + 1)
    assert np.array_equal(x.reshape(4, -1).inf, a.reshape(4, -1))
    assert [float(v.inf) for v in row] == [0, 1, 2, 3]
    with pytest.raises(ValueError, match="broadcast"):
        x + IntervalArray([1, 2, 3])
    with pytest.raises(TypeError):
        len(IntervalArray(1))
    for y in (x.sin(), x.cos(), (-x).exp(), x.sqr(), x.sqrt()):
        assert y.shape == x.shape


def test_elements_as_intervals():
    x = IntervalArray([[(1, 2), (3, 5)], [(2, 2), (1, 4)]])
    (first, _), (_, last) = x.tolist()
    assert (first, last) == (Interval(1, 2), Interval(1, 4))
    assert IntervalArray(x.tolist()).equal(x).all()
    with pytest.raises(ValueError, match=r"size 1|one element|can only convert"):
        x.item()
    assert [row.shape for row in x] == [(2,), (2,)]
    with pytest.raises(TypeError):
        iter(x[0, 0]).__next__()


def same(x):
    return x


@pytest.mark.parametrize("op", ["*", "/"])
@pytest.mark.parametrize("few", [1, 2, 7, 10])
def test_few_intervals_have_the_bits_that_they_have_among_many(op, few):
    x, y = sample(op, 1200), sample(few, 1200)
    keep = fits(x, y, op)
    x, y = x[keep], y[keep]
    whole, among = BINARY[op](x, y), len(x) - len(x) % few
    for i in range(0, among, few):
        part = slice(i, i + few)
        for place in (part, i):
            found, tight = (
                BINARY[op](kind(x[place]), kind(y[place])) for kind in (same, TightArray)
            )
            assert ((found == whole[place]) | (found == tight)).all()  # or short, and so exact


@pytest.mark.parametrize("count", [1, 8, 9])
def test_few_intervals_are_refused_as_many_are(count):
    one, huge = IntervalArray([1] * count), IntervalArray.from_floats([1e200] * count)
    for divisor in ((-1, 1), (0, 1), (-1, 0), 0):
        with pytest.raises(DomainError, match="contains 0"):
            one / IntervalArray([1] * (count - 1) + [divisor])
    for beyond in (huge * huge, huge / (one / huge)):
        assert (beyond.sup == math.inf).all() and (beyond.inf >= MAX * (1 - 1e-15)).all()


def test_large_arrays_in_blocks_are_what_small_ones_are():
    rng = np.random.default_rng(3)
    a = rng.normal(size=(3, 20_000))
    x = IntervalArray.from_floats(a, a + 1e-3)
    y = IntervalArray.from_floats(rng.normal(size=20_000) + 9)
    for op in (operator.add, operator.mul, operator.truediv):
        whole = op(x, y)
        parts = [op(x[:, i : i + 1000], y[i : i + 1000]) for i in range(0, 20_000, 1000)]
        assert (whole == np.concatenate(parts, axis=1)).all()
