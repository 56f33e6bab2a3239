"""IntervalArray against exact rationals and Arb: containment, isotonicity, refusals, indexing."""

import copy
import math
import operator
import pickle
import random
from fractions import Fraction

import flint
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from intervals import DomainError, Interval
from intervals.array import IntervalArray
from intervals.elementary.binary64 import ERRORS

ETA, MAX = 2.0**-1074, math.nextafter(math.inf, 0.0)
BINARY = {
    "+": lambda x, y: x + y,
    "-": lambda x, y: x - y,
    "*": lambda x, y: x * y,
    "/": lambda x, y: x / y,
}


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


def members(x, seed):
    """A few exact numbers in each interval: the ends, the middle, somewhere."""
    rng = random.Random(seed)
    for low, high in zip(x.inf.tolist(), x.sup.tolist(), strict=True):
        a, b = Fraction(low), Fraction(high)
        yield [a, b, (a + b) / 2, a + (b - a) * Fraction(rng.random())]


def fits(x, y, op):
    """Keep pairs whose results stay in range."""
    sizes = (np.maximum(abs(v.inf), abs(v.sup)) for v in (x, y))
    a, b = (np.log2(np.maximum(size, 2.0**-1074)) for size in sizes)
    if op == "*":
        return a + b < 1000
    if op == "/":
        least = np.minimum(abs(y.inf), abs(y.sup))
        apart = (y.certainly_positive() | y.certainly_negative()) & (least > 0)
        return apart & (a - np.log2(np.maximum(least, ETA)) < 1000)
    return np.full(x.shape, True)


@pytest.mark.parametrize("op", BINARY)
@pytest.mark.parametrize(
    "thin",
    [
        "neither",
        *(pytest.param(name, marks=pytest.mark.slow) for name in ("left", "right", "both")),
    ],
)
def test_binary_operations_contain_every_exact_result(op, thin):
    x, y = sample(op + thin, 1500), sample(thin + op, 1500)
    if thin in ("left", "both"):
        x = IntervalArray.from_floats(x.inf)
    if thin in ("right", "both"):
        y = IntervalArray.from_floats(y.sup)
    keep = fits(x, y, op)
    x, y = x[keep], y[keep]
    z = BINARY[op](x, y)
    bounds = zip(z.inf.tolist(), z.sup.tolist(), strict=True)
    for low, high in bounds:
        assert low <= high
    rows = zip(members(x, 1), members(y, 2), z.inf.tolist(), z.sup.tolist(), strict=True)
    for xs, ys, *ends in rows:
        low, high = map(Fraction, ends)
        results = [BINARY[op](p, q) for p in xs for q in ys]
        assert low <= min(results)
        assert max(results) <= high
        slack = max(map(abs, results)) * Fraction(1, 2**51) + Fraction(2 * ETA)
        assert min(results) - low <= slack  # tight: the ends are among the members
        assert high - max(results) <= slack


@pytest.mark.parametrize("name", ["sqr", "cube", "fifth", "abs", "neg", "inverse"])
def test_unary_operations_contain_every_exact_result(name):
    function = {
        "sqr": lambda x: x**2,
        "cube": lambda x: x**3,
        "fifth": lambda x: x**5,
        "abs": abs,
        "neg": lambda x: -x,
        "inverse": lambda x: x**-2,
    }[name]
    x = sample(name, 3000, lambda a, b: -1e60 < a <= b < 1e60)
    if name == "inverse":
        least = np.minimum(abs(x.inf), abs(x.sup))
        x = x[(x.certainly_positive() | x.certainly_negative()) & (least > 1e-100)]
    y = function(x)
    for xs, low, high in zip(members(x, 3), y.inf.tolist(), y.sup.tolist(), strict=True):
        results = [function(p) for p in xs]
        assert Fraction(low) <= min(results)
        assert max(results) <= Fraction(high)
    if name in ("sqr", "abs"):
        assert (y.inf >= 0).all()
        touches = ~(x.certainly_positive() | x.certainly_negative())
        assert touches.any()
        assert (y.inf[touches] == 0).all()


def test_sqrt_contains_every_root():
    x = sample("sqrt", 3000, lambda a, b: a >= 0)
    y = x.sqrt()
    assert (y.inf >= 0).all()
    for xs, low, high in zip(members(x, 4), y.inf.tolist(), y.sup.tolist(), strict=True):
        assert Fraction(low) ** 2 <= min(xs)
        assert max(xs) <= Fraction(high) ** 2
    with pytest.raises(DomainError):
        IntervalArray([4, (-1, 1)]).sqrt()


@pytest.mark.parametrize("name", ["exp", "log"])
def test_exp_and_log_contain_arb(name):
    if name == "exp":
        x = sample("exp", 300, lambda a, b: -500 < a <= b < 500)
    else:
        x = sample("log", 300, lambda a, b: a > 0)
    y = getattr(x, name)()
    with flint.ctx.workprec(200):
        for xs, low, high in zip(members(x, 5), y.inf.tolist(), y.sup.tolist(), strict=True):
            for p in xs:
                value = getattr(flint.arb(flint.fmpq(p.numerator, p.denominator)), name)()
                assert not value < flint.arb(low)
                assert not value > flint.arb(high)
        narrow = y.wid <= 2 * ERRORS[name] * 2.0**-52 * y.mag
        assert narrow[x.wid == 0].all()
    with pytest.raises(DomainError):
        IntervalArray([(0, 1)]).log()
    with pytest.raises(OverflowError):
        IntervalArray([1000]).exp()


def shrunk(x, seed):
    """A random subset of each interval."""
    rng = np.random.default_rng(seed)
    t, s = (rng.choice([0.0, 0.25, 0.5, 1.0], x.shape) for _ in range(2))
    lower, upper = x.mid * t + x.inf * (1 - t), x.mid * s + x.sup * (1 - s)
    lower, upper = np.clip(lower, x.inf, x.mid), np.clip(upper, x.mid, x.sup)
    return IntervalArray.from_floats(lower, upper)


@pytest.mark.parametrize("op", BINARY)
def test_inclusion_isotonicity_of_binary_operations(op):
    x, y = sample("iso" + op, 4000), sample(op + "iso", 4000)
    keep = fits(x, y, op)
    x, y = x[keep], y[keep]
    small = BINARY[op](shrunk(x, 1), shrunk(y, 2))
    assert small.subset(BINARY[op](x, y)).all()


def test_inclusion_isotonicity_of_unary_operations():
    x = sample("unary", 4000, lambda a, b: -1e60 < a <= b < 1e60)
    for function in (lambda x: x.sqr(), abs, lambda x: x**3, lambda x: abs(x).sqrt(), lambda x: -x):
        assert function(shrunk(x, 3)).subset(function(x)).all()


@given(st.lists(st.fractions(), min_size=1, max_size=5))
def test_exact_numbers_are_enclosed_tightly(values):
    x = IntervalArray(values)
    assert x.contains(x).all()
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
    assert x[1, 1].inf == 1
    assert x[1, 1].sup == 2
    assert IntervalArray([2**53, -5, np.int64(7)]).wid.tolist() == [0, 0, 0]
    assert IntervalArray(np.arange(4)).sup.tolist() == [0, 1, 2, 3]
    assert IntervalArray(range(3)).shape == (3,)
    assert IntervalArray("0.1").shape == ()
    assert IntervalArray([]).shape == (0,)
    assert (IntervalArray([]) * IntervalArray([])).sin().shape == (0,)
    assert (IntervalArray.from_exact(["1/3"]) == IntervalArray([Fraction(1, 3)])).all()


@pytest.mark.parametrize(
    ("values", "error"),
    [
        ([0.1], TypeError),
        (0.1, TypeError),
        ([np.float64(1)], TypeError),
        (np.ones(3), TypeError),
        ([("0", 1.0)], TypeError),
        ([("1", "0")], ValueError),
        ([("1", "2", "3")], ValueError),
        ([["1", "2"], ["3"]], ValueError),
        (["one"], ValueError),
        ([10**400], OverflowError),
    ],
)
def test_exact_constructor_refuses(values, error):
    with pytest.raises(error):
        IntervalArray(values)


@pytest.mark.parametrize(
    ("bounds", "error"),
    [
        ((math.nan,), ValueError),
        (([1.0, math.inf],), ValueError),
        ((1.0, math.nan), ValueError),
        (([0.0, 2.0], [1.0, 1.0]), ValueError),
        (([2**53 + 1, 0.5],), ValueError),
        (([2**2000],), (ValueError, OverflowError)),
        (("0.1",), TypeError),
        (([None],), TypeError),
        (([Fraction(1, 3)],), TypeError),
        (([1.0, 2.0], [3.0, 4.0, 5.0]), ValueError),
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


@pytest.mark.parametrize("op", BINARY)
@pytest.mark.parametrize("bad", [0.5, np.float64(0.5), np.array([0.5]), np.float32(1)])
def test_floats_do_not_mix(op, bad):
    x = IntervalArray([1, 2])
    for left, right in ((x, bad), (bad, x)):
        with pytest.raises(TypeError, match="from_floats"):
            BINARY[op](left, right)


def exact_value(number):
    return number if isinstance(number, Fraction) else Fraction(int(number))


@pytest.mark.parametrize("op", BINARY)
def test_scalars_on_either_side(op):
    x = sample("scalar", 40, lambda a, b: (a > 1e-9 or b < -1e-9) and max(-a, b) < 1e9)
    for scalar in (0, 1, -8, 3, 2**60 + 1, Fraction(-1, 3), Interval("-0.2", "-0.1"), np.int64(5)):
        is_range = isinstance(scalar, Interval)
        low, high = (scalar.inf, scalar.sup) if is_range else (exact_value(scalar),) * 2
        for left in (True, False):
            if op == "/" and left is False and low == 0:
                with pytest.raises(DomainError):
                    x / scalar
                continue
            z = BINARY[op](scalar, x) if left else BINARY[op](x, scalar)
            for i, xs in enumerate(members(x, 6)):
                for p in xs:
                    for q in (low, high):
                        exact = BINARY[op](q, p) if left else BINARY[op](p, q)
                        assert z[i].contains(exact)


def test_multiples_by_powers_of_two_are_exact():
    x = IntervalArray.from_floats([ETA, -3.5, 0.0], [1.0, 2.25, 0.0])
    assert ((2 * x).inf.tolist(), (2 * x).sup.tolist()) == ([2 * ETA, -7.0, 0.0], [2.0, 4.5, 0.0])
    assert ((-4 * x).inf.tolist(), (-4 * x).sup.tolist()) == ([-4.0, -9.0, 0], [-4 * ETA, 14.0, 0])
    assert (0 * x).wid.tolist() == [0, 0, 0]
    assert (x - x)[2].wid == 0
    with pytest.raises(OverflowError):
        x * 2**1100


def test_results_out_of_range_are_refused():
    big = IntervalArray.from_floats([1.0, -1e300])
    for operation in (
        lambda: big * big,
        lambda: big * 10**10,
        lambda: big / IntervalArray(["1e-20"]),
        lambda: big * 2**60,
        big.sqr,
        lambda: big + IntervalArray.from_floats(-MAX),
        lambda: IntervalArray.from_floats(-MAX, MAX).wid,
        lambda: IntervalArray.from_floats(MAX) + 1,
        lambda: big + 10**400,
    ):
        with pytest.raises(OverflowError):
            operation()


def test_division_by_zero_is_refused():
    for bounds in ((0.0, 0.0), (-1.0, 1.0), (0.0, 1.0), (-1.0, 0.0)):
        x = IntervalArray.from_floats([1.0, bounds[0]], [1.0, bounds[1]])
        for operation in (lambda x=x: 1 / x, lambda x=x: x / x, lambda x=x: x**-1):
            with pytest.raises(DomainError):
                operation()
    with pytest.raises(DomainError):
        IntervalArray([1]) / 0


def test_masks():
    x = IntervalArray([(-2, -1), (-1, 0), (0, 1), (1, 2)])
    assert x.certainly_positive().tolist() == [False, False, False, True]
    assert x.certainly_negative().tolist() == [True, False, False, False]
    assert x.certainly_less(1).tolist() == [True, True, False, False]
    assert x.certainly_less(x[2]).tolist() == [True, False, False, False]
    assert x.contains(0).tolist() == [False, True, True, False]
    assert x.contains(Fraction(1, 3)).tolist() == [False, False, True, False]
    assert x.contains(IntervalArray([(0, "0.5")])).tolist() == [False, False, True, False]
    assert x.subset(IntervalArray([(-1, 1)])).tolist() == [False, True, True, False]
    assert (x == x.hull(x)).all()
    tenth = IntervalArray.from_floats(0.1)
    assert not tenth.contains(Fraction(1, 10))
    assert tenth.contains(Fraction(0.1))


def test_nan_decides_nothing():
    x = IntervalArray([(1, 2)])
    x._rows = np.full((2, 1), math.nan)
    y = IntervalArray([(0, 3)])
    masks = (x.certainly_positive(), x.certainly_negative(), x.certainly_less(y), x == y)
    more = (y.certainly_less(x), x.subset(y), y.subset(x), x.contains(y), y.contains(x))
    assert not any(mask.any() for mask in masks + more)
    for operation in (
        lambda: x + y,
        lambda: x * y,
        lambda: y * x,
        lambda: 2 * x,
        x.sin,
        x.sqr,
        lambda: x.intersection(y),
        x.sqrt,
        lambda: 1 / x,
    ):
        with pytest.raises((ArithmeticError, ValueError)):
            operation()
    with pytest.raises(DomainError):
        y / x


def test_undefined_questions_are_refused():
    x = IntervalArray([1, 2])
    for operation in (
        lambda: x < IntervalArray([3]),
        lambda: x <= 1,
        lambda: operator.gt(1, x),
        lambda: x >= Fraction(1, 2),
        lambda: bool(x),
        lambda: x == 1,
        lambda: hash(x),
        lambda: x.contains(1.0),
        lambda: x + "1",
        lambda: x + None,
    ):
        with pytest.raises(TypeError):
            operation()


def test_hull_and_intersection():
    x, y = IntervalArray([(0, 2), (1, 3)]), IntervalArray([(1, 5), (3, 4)])
    hull, common = x.hull(y), x.intersection(y)
    assert (hull.inf.tolist(), hull.sup.tolist()) == ([0, 1], [5, 4])
    assert (common.inf.tolist(), common.sup.tolist()) == ([1, 3], [2, 3])
    assert x.intersection(IntervalArray([(0, 1), (4, 5)])) is None


def test_mid_and_wid():
    x = sample("mid", 3000)
    assert (x.inf <= x.mid).all()
    assert (x.mid <= x.sup).all()
    wid = x[(x.sup < 1e300) & (x.inf > -1e300)].wid
    assert (wid >= 0).all()
    for low, high, bound in zip(x.inf.tolist(), x.sup.tolist(), x.wid.tolist(), strict=True):
        assert Fraction(high) - Fraction(low) <= Fraction(bound)
        assert (low == high) == (bound == 0)


def test_shapes_broadcast_and_index_as_numpy():
    a = np.arange(24.0).reshape(2, 3, 4)
    x, row = IntervalArray.from_floats(a, a + 1), IntervalArray.from_floats(np.arange(4.0))
    assert (x.shape, x.ndim, x.size, len(x)) == ((2, 3, 4), 3, 24, 2)
    total = x + row
    assert total.contains(IntervalArray.from_floats(a + np.arange(4.0))).all()
    assert (row + x == total).all()
    assert (x * row[:, None, None, None]).shape == (4, 2, 3, 4)
    assert (row - x).shape == (row / (x + 1)).shape == (2, 3, 4)
    for index in (
        0,
        -1,
        (1, 2, 3),
        slice(None, 1),
        (..., 0),
        (slice(None), [0, 2]),
        ([0, 1], slice(None), [0, 3]),
        a > 5,
        None,
        (slice(None), a[0] > 5),
    ):
        assert np.array_equal(x[index].inf, a[index])
        assert np.array_equal(x[index].sup, a[index] + 1)
    assert np.array_equal(x.reshape(4, -1).inf, a.reshape(4, -1))
    assert [float(v.inf) for v in row] == [0, 1, 2, 3]
    joined = np.concatenate([x, x], axis=1)
    assert np.array_equal(joined.inf, np.concatenate([a, a], axis=1))
    assert np.concatenate([x, x], axis=-1).shape == (2, 3, 8)
    with pytest.raises(ValueError, match="broadcast"):
        x + IntervalArray([1, 2, 3])
    with pytest.raises(TypeError):
        len(IntervalArray(1))


def test_elementary_functions_of_any_shape():
    a = np.linspace(-5, 5, 12).reshape(3, 4)
    x = IntervalArray.from_floats(a)
    for y in (x.sin(), x.cos(), x.exp(), x.sqr(), abs(x).sqrt()):
        assert y.shape == (3, 4)
    assert IntervalArray("0.5").sin().shape == ()


def test_text_and_copies():
    x = IntervalArray([("0.1", "0.2")])
    assert "0.09999999999999999" in repr(x)
    assert (pickle.loads(pickle.dumps(x)) == x).all()
    assert (copy.copy(x) == x).all()
    upper = x.sup
    upper[0] = 9
    assert x.sup[0] < 1
