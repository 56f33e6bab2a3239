"""IntervalArray among numpy's own functions."""

import copy
import math
import operator
import pickle
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from intervals import Interval, IntervalArray

X = IntervalArray([[(1, 2), (3, 5), ("1/3", "1/2")], [(2, 2), (1, 4), (7, 8)]])
Y = IntervalArray([[(2, 3), (1, 1), (4, 5)], [(5, 6), (2, 3), (1, 2)]])


def same(x, y):
    return x.shape == y.shape and bool((x == y).all())


UNARY = {
    np.negative: lambda x: -x,
    np.positive: lambda x: x,
    np.absolute: abs,
    np.square: lambda x: x.sqr(),
    np.reciprocal: lambda x: 1 / x,
    np.sqrt: lambda x: x.sqrt(),
    np.cbrt: lambda x: x.cbrt(),
    np.exp: lambda x: x.exp(),
    np.exp2: lambda x: x.exp2(),
    np.expm1: lambda x: x.expm1(),
    np.log: lambda x: x.log(),
    np.log2: lambda x: x.log2(),
    np.log10: lambda x: x.log10(),
    np.log1p: lambda x: x.log1p(),
    np.sin: lambda x: x.sin(),
    np.cos: lambda x: x.cos(),
    np.sinh: lambda x: x.sinh(),
    np.cosh: lambda x: x.cosh(),
    np.tanh: lambda x: x.tanh(),
    np.arctan: lambda x: x.atan(),
    np.arcsinh: lambda x: x.asinh(),
    np.floor: lambda x: x.floor(),
    np.ceil: lambda x: x.ceil(),
    np.trunc: lambda x: x.trunc(),
    np.rint: lambda x: x.round_ties_to_even(),
    np.sign: lambda x: x.sign(),
}


@pytest.mark.parametrize("ufunc", UNARY, ids=lambda f: f.__name__)
def test_unary_ufuncs(ufunc):
    assert same(ufunc(X), UNARY[ufunc](X))


def test_ufuncs_with_narrower_domains():
    x = IntervalArray([("1/4", "1/2"), ("1/8", "3/4")])
    assert same(np.arcsin(x), x.asin())
    assert same(np.arccos(x), x.acos())
    assert same(np.arctanh(x), x.atanh())
    assert same(np.tan(x), x.tan())
    assert same(np.arccosh(x + 1), (x + 1).acosh())


BINARY = {
    np.add: operator.add,
    np.subtract: operator.sub,
    np.multiply: operator.mul,
    np.divide: operator.truediv,
    np.hypot: lambda x, y: x.hypot(y),
    np.arctan2: lambda x, y: x.atan2(y),
    np.minimum: lambda x, y: x.minimum(y),
    np.maximum: lambda x, y: x.maximum(y),
    np.equal: operator.eq,
    np.not_equal: operator.ne,
}


@pytest.mark.parametrize("ufunc", BINARY, ids=lambda f: f.__name__)
def test_binary_ufuncs(ufunc):
    result, expected = ufunc(X, Y), BINARY[ufunc](X, Y)
    assert np.array_equal(result, expected) if result is expected else (result == expected).all()


def test_operators_with_exact_numbers_on_either_side():
    ones = np.array([1, 2, 3])
    columns = IntervalArray([1, 2, 3])
    for number, same_number in ((2, 2), (np.int64(2), 2), (ones, columns), (Fraction(1, 3),) * 2):
        for op in (operator.add, operator.sub, operator.mul, operator.truediv):
            assert same(op(X, number), op(X, same_number))
            assert same(op(number, X), op(same_number, X))
    assert same(X * Interval("1/3"), X * IntervalArray(Interval("1/3")))
    assert same(np.power(X, 2), X.sqr())


@pytest.mark.parametrize("bad", [0.5, np.float64(2), np.float32(1), np.ones(3), np.ones((2, 3))])
def test_bare_floats_are_refused_with_a_hint(bad):
    for operation in (
        lambda: X + bad,
        lambda: bad + X,
        lambda: np.multiply(X, bad),
        lambda: np.subtract(bad, X),
        lambda: np.where([[True], [False]], X, bad),
        lambda: np.maximum(bad, X),
    ):
        with pytest.raises(TypeError, match="from_floats"):
            operation()
    with pytest.raises(TypeError, match="from_floats"):
        np.concatenate((X[0], np.ones(3)))


def test_what_has_no_meaning_raises():
    for operation in (
        lambda: np.less(X, Y),
        lambda: np.isnan(X),
        lambda: np.add(X, Y, out=np.empty((2, 3))),
        lambda: np.add(X, Y, where=True),
        lambda: np.add.accumulate(X),
        lambda: np.subtract.reduce(X),
        lambda: np.mean(X),
        lambda: np.linalg.inv(X),
        lambda: np.sort(X),
        lambda: np.asarray(X),
        lambda: np.array(X, dtype=float),
        lambda: np.concatenate(([1.0], X)),
        lambda: np.take(np.arange(3), X),
        lambda: float(X[0, 0]),
    ):
        with pytest.raises(TypeError):
            operation()


MOVING = {
    "reshape": lambda np_, a: np_.reshape(a, (3, 2)),
    "ravel": lambda np_, a: np_.ravel(a),
    "transpose": lambda np_, a: np_.transpose(a),
    "swapaxes": lambda np_, a: np_.swapaxes(a, 0, 1),
    "moveaxis": lambda np_, a: np_.moveaxis(a, 0, -1),
    "flip": lambda np_, a: np_.flip(a, axis=1),
    "roll": lambda np_, a: np_.roll(a, 1, axis=1),
    "expand": lambda np_, a: np_.expand_dims(a, 1),
    "squeeze": lambda np_, a: np_.squeeze(a[:1]),
    "broadcast": lambda np_, a: np_.broadcast_to(a[0], (4, 3)),
    "tile": lambda np_, a: np_.tile(a, (2, 1)),
    "repeat": lambda np_, a: np_.repeat(a, 2, axis=1),
    "take": lambda np_, a: np_.take(a, [2, 0], axis=1),
    "concatenate": lambda np_, a: np_.concatenate((a, a[:1]), axis=0),
    "stack": lambda np_, a: np_.stack((a, a), axis=-1),
    "vstack": lambda np_, a: np_.vstack((a, a)),
    "hstack": lambda np_, a: np_.hstack((a, a)),
    "diag": lambda np_, a: np_.diag(a[0]),
    "triu": lambda np_, a: np_.triu(a),
    "where": lambda np_, a: np_.where(np.array([True, False, True]), a, a[::-1]),
    "split": lambda np_, a: np_.split(a, 3, axis=1)[1],
    "index": lambda np_, a: a[:, [0, 2]],
    "mask": lambda np_, a: a[np.array([True, False])],
    "ellipsis": lambda np_, a: a[..., 1],
    "new axis": lambda np_, a: a[:, None, 1:],
}


@pytest.mark.parametrize("name", MOVING)
def test_functions_that_move_elements(name):
    moved = MOVING[name](np, X)
    assert np.array_equal(moved.inf, MOVING[name](np, X.inf))
    assert np.array_equal(moved.sup, MOVING[name](np, X.sup))


def test_moving_exact_numbers_beside_intervals():
    joined = np.concatenate((X[0], np.array([-7, 8])))
    assert joined.inf.tolist()[3:] == joined.sup.tolist()[3:] == [-7, 8]
    chosen = np.where([True, False, True], X[0], Fraction(-1, 2))
    assert (chosen.inf[1], chosen.sup[1]) == (-0.5, -0.5)
    assert np.array_equal(X.T.sup, X.sup.T)
    assert (np.shape(X), np.ndim(X), np.size(X), len(X)) == ((2, 3), 2, 6, 2)
    assert np.array_equal(X, X)
    assert not np.array_equal(X, Y)


floats = st.floats(-1e30, 1e30, allow_subnormal=True)
shapes = st.tuples(st.integers(0, 5), st.integers(0, 7))


def exact(values, axis, combine, start):
    """Brute force over Fractions."""
    table = np.array([[Fraction(v) for v in row] for row in values], dtype=object)
    table = table.reshape(values.shape)
    moved = np.moveaxis(table, axis, 0)
    total = np.full(moved.shape[1:], start, dtype=object)
    for part in moved:
        total = combine(total, part)
    return total


@settings(max_examples=60)
@given(st.data())
def test_sums_and_products_against_fractions(data):
    shape = data.draw(shapes)
    numbers = st.lists(floats, min_size=math.prod(shape), max_size=math.prod(shape))
    values = np.array(data.draw(numbers)).reshape(shape)
    x = IntervalArray.from_floats(values)
    axis = data.draw(st.sampled_from([0, 1, -1]))
    for result, combine, start in (
        (np.sum(x, axis=axis), operator.add, Fraction(0)),
        (np.prod(x, axis=axis), operator.mul, Fraction(1)),
    ):
        true = exact(values, axis, combine, start)
        assert result.shape == true.shape
        for low, high, value in zip(result.inf.flat, result.sup.flat, true.flat, strict=True):
            assert Fraction(low) <= value <= Fraction(high)
    assert same(np.add.reduce(x), x.sum(axis=0))
    assert x.sum().shape == ()


def test_sums_lose_little():
    x = IntervalArray(["1/3"] * 1000).sum()
    assert x.contains(Fraction(1000, 3))
    assert x.wid < 1000 * 2.0**-54 + 12 * 2.0**-43
    with pytest.raises(np.exceptions.AxisError):
        X.sum(axis=2)


@settings(max_examples=40)
@given(st.data())
def test_matrix_products_against_fractions(data):
    n, k, m = (data.draw(st.integers(0, 4)) for _ in range(3))
    draw = lambda size: np.array(data.draw(st.lists(floats, min_size=size, max_size=size)))  # noqa: E731
    a, b = draw(n * k).reshape(n, k), draw(k * m).reshape(k, m)
    product = IntervalArray.from_floats(a) @ IntervalArray.from_floats(b)
    assert product.shape == (n, m)
    for i in range(n):
        for j in range(m):
            true = sum((Fraction(a[i, q]) * Fraction(b[q, j]) for q in range(k)), Fraction(0))
            assert product[i, j].contains(true)


def test_matrix_products_follow_numpy_in_their_shapes():
    shapes = [
        ((3,), (3,)),
        ((2, 3), (3,)),
        ((2,), (2, 3)),
        ((5, 2, 3), (3, 4)),
        ((2, 3), (5, 3, 1)),
    ]
    for left, right in shapes:
        a, b = np.ones(left), np.full(right, 2.0)
        x, y = IntervalArray.from_floats(a), IntervalArray.from_floats(b)
        for product in (x @ y, np.matmul(x, y)):
            assert product.shape == (a @ b).shape
            assert product.contains(2 * left[-1]).all()
    with pytest.raises(ValueError, match="do not fit"):
        X @ X
    with pytest.raises(ValueError, match="axis"):
        X[0, 0] @ X
    with pytest.raises(TypeError):
        X @ np.ones((3, 2))
    assert same(np.dot(X, Y.T), X @ Y.T)


@pytest.mark.parametrize("x", [X, X[0, 0], X[:, ::-1], IntervalArray([]), X[:, :0]])
def test_text_pickle_and_copies_are_exact(x):
    names = {"IntervalArray": IntervalArray}
    for again in (
        eval(repr(x), names),
        pickle.loads(pickle.dumps(x)),
        copy.copy(x),
        copy.deepcopy(x),
    ):
        assert same(again, x)


def test_elements_as_intervals():
    first, second = X.tolist()
    assert first[0] == Interval(1, 2)
    assert second[1] == Interval(1, 4)
    assert IntervalArray(X.tolist()).equal(X).all()
    with pytest.raises(ValueError, match=r"size 1|one element|can only convert"):
        X.item()
    assert [row.shape for row in X] == [(3,), (3,)]
    with pytest.raises(TypeError):
        iter(X[0, 0]).__next__()


def test_large_arrays_in_blocks_are_what_small_ones_are():
    rng = np.random.default_rng(3)
    a = rng.normal(size=(3, 20_000))
    x = IntervalArray.from_floats(a, a + 1e-3)
    y = IntervalArray.from_floats(rng.normal(size=20_000) + 9)
    for op in (operator.add, operator.mul, operator.truediv):
        whole = op(x, y)
        parts = [op(x[:, i : i + 1000], y[i : i + 1000]) for i in range(0, 20_000, 1000)]
        assert same(whole, np.concatenate(parts, axis=1))
