"""IntervalArray among numpy's own functions."""

import operator
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import strategies as st

from intervals import Interval, IntervalArray
from intervals.jet import Jet
from intervals.zero_finder import zeros
from tests.intervals.boxes import for_all

X = IntervalArray([[(1, 2), (3, 5), ("1/3", "1/2")], [(2, 2), (1, 4), (7, 8)]])
Y = IntervalArray([[(2, 3), (1, 1), (4, 5)], [(5, 6), (2, 3), (1, 2)]])


def same(x, y):
    return x.shape == y.shape and bool((x == y).all())


SAME_NAME = (
    "sqrt cbrt exp exp2 expm1 log log2 log10 log1p sin cos tan sinh cosh tanh floor ceil trunc"
)
UNARY = {name: name for name in (*SAME_NAME.split(), "sign")} | {
    "negative": "__neg__",
    "positive": "__pos__",
    "absolute": "__abs__",
    "fabs": "__abs__",
    "square": "sqr",
    "reciprocal": "recip",
    "arcsin": "asin",
    "arccos": "acos",
    "arctan": "atan",
    "arcsinh": "asinh",
    "arccosh": "acosh",
    "arctanh": "atanh",
    "rint": "round_ties_to_even",
}


@pytest.mark.parametrize("name", UNARY)
def test_unary_ufuncs(name):
    x = X + 1 if name == "arccosh" else X / 9
    assert same(getattr(np, name)(x), getattr(x, UNARY[name])())


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
    for op in (operator.add, operator.sub, operator.mul, operator.truediv):
        for pair in ((X, bad), (bad, X)):
            with pytest.raises(TypeError, match="from_floats"):
                op(*pair)
    for operation in (
        *(lambda: np.where([[True], [False]], X, bad), lambda: np.maximum(bad, X)),
        lambda: np.concatenate((X[0], np.ones(3))),
    ):
        with pytest.raises(TypeError, match="from_floats"):
            operation()


def test_what_has_no_meaning_raises():
    for operation in (
        *(lambda: np.less(X, Y), lambda: np.isnan(X), lambda: np.add(X, Y, where=True)),
        *(lambda: np.add(X, Y, out=np.empty((2, 3))), lambda: np.add.accumulate(X)),
        *(lambda: np.subtract.reduce(X), lambda: np.median(X), lambda: np.linalg.qr(X)),
        *(lambda: np.sort(X), lambda: np.asarray(X), lambda: np.array(X, dtype=float)),
        *(lambda: np.concatenate(([1.0], X)), lambda: np.take(np.arange(3), X)),
        lambda: float(X[0, 0]),
    ):
        with pytest.raises(TypeError):
            operation()


MOVING = {
    "reshape": lambda a: np.reshape(a, (3, 2)),
    "ravel": np.ravel,
    "transpose": np.transpose,
    "swapaxes": lambda a: np.swapaxes(a, 0, 1),
    "moveaxis": lambda a: np.moveaxis(a, 0, -1),
    "flip": lambda a: np.flip(a, axis=1),
    "roll": lambda a: np.roll(a, 1, axis=1),
    "expand": lambda a: np.expand_dims(a, 1),
    "squeeze": lambda a: np.squeeze(a[:1]),
    "broadcast": lambda a: np.broadcast_to(a[0], (4, 3)),
    "tile": lambda a: np.tile(a, (2, 1)),
    "repeat": lambda a: np.repeat(a, 2, axis=1),
    "take": lambda a: np.take(a, [2, 0], axis=1),
    "concatenate": lambda a: np.concatenate((a, a[:1]), axis=0),
    "columns": lambda a: np.concatenate([a, a], axis=-1),
    "stack": lambda a: np.stack((a, a), axis=-1),
    "vstack": lambda a: np.vstack((a, a)),
    "hstack": lambda a: np.hstack((a, a)),
    "diag": lambda a: np.diag(a[0]),
    "triu": np.triu,
    "where": lambda a: np.where(np.array([True, False, True]), a, a[::-1]),
    "split": lambda a: np.split(a, 3, axis=1)[1],
}


@pytest.mark.parametrize("move", MOVING.values(), ids=MOVING)
def test_functions_that_move_elements(move):
    moved = move(X)
    assert np.array_equal(moved.inf, move(X.inf)) and np.array_equal(moved.sup, move(X.sup))


def test_moving_exact_numbers_beside_intervals():
    joined = np.concatenate((X[0], np.array([-7, 8])))
    assert joined.inf.tolist()[3:] == joined.sup.tolist()[3:] == [-7, 8]
    chosen = np.where([True, False, True], X[0], Fraction(-1, 2))
    assert (chosen.inf[1], chosen.sup[1]) == (-0.5, -0.5)
    assert np.array_equal(X.T.sup, X.sup.T)
    assert (np.shape(X), np.ndim(X), np.size(X), len(X)) == ((2, 3), 2, 6, 2)
    assert np.array_equal(X, X)
    assert not np.array_equal(X, Y)


OPTIONS = (  # of functions that only move elements, and what must not pass with them
    *(lambda: np.concatenate([X, Y], dtype=np.float32), lambda: np.hstack([X, Y], dtype="f4")),
    *(lambda: np.stack([X, Y], casting="unsafe"), lambda: np.vstack([X, Y], dtype=np.float32)),
    *(lambda: np.concatenate([X, Y], 0, np.empty((4, 3))), lambda: np.stack([X], 0, np.empty(6))),
    *(lambda: np.take(X, [0], 0, np.empty((1, 3))), lambda: np.take(X, [0], mode="wrap")),
    *(lambda: np.sum(X, dtype=np.float32), lambda: np.add.reduce(X, dtype=np.float32)),
    *(lambda: np.compress([1, 0], X), lambda: np.where(X), lambda: np.copy(X, "K")),
    *(lambda: np.mean(X, dtype=np.float32), lambda: np.cumsum(X, 0, np.float32)),
)


@pytest.mark.parametrize("call", OPTIONS)
def test_options_that_would_round_or_write_are_refused(call):
    with pytest.raises(TypeError):
        call()


POINTS = IntervalArray([[1, 2], [-3, 0]])
INTEGERS = [np.dtype(code).type for code in "bhilqBHILQ"]


@pytest.mark.parametrize("kind", INTEGERS, ids=lambda kind: kind.__name__)
def test_numpy_integers_are_integers_to_their_last_one(kind):
    ends = np.iinfo(kind)
    for number in {int(ends.min), int(ends.max), 0, 1, 64, -int(ends.min) // 2}:
        typed = kind(number)
        for product in (POINTS * typed, typed * POINTS, np.multiply(POINTS, typed)):
            assert contains(product, exact(POINTS.sup) * number)
        assert same(X * typed, X * number) and same(typed * X, X * number)
        assert same(X - typed, X - number) and same(typed - X, number - X)
        assert Interval(1, 2) * typed == Interval(1, 2) * number
    assert same((-X) ** kind(2), X.sqr()) and same(np.power(-X, kind(3)), -(X**3))


def test_a_zero_is_not_lost_to_the_smallest_integer():
    with_numpy, with_int = (zeros(lambda x, k=k: x * k + 64, Interval(0, 1)) for k in SMALLEST)
    assert [each.outcome for each in with_numpy] == [each.outcome for each in with_int]
    assert with_int and with_int[0].box[0].contains(Fraction(1, 2))


SMALLEST = (np.int8(-128), -128)


@pytest.mark.parametrize("bad", [np.True_, np.complex128(1), np.str_("1"), np.datetime64("2026")])
def test_scalars_that_are_no_exact_numbers_are_refused_at_once(bad):
    for op in (operator.add, operator.sub, operator.mul, operator.truediv, operator.pow):
        for pair in ((X, bad), (bad, X)):
            with pytest.raises(TypeError):
                op(*pair)


TIMES = [np.timedelta64(3, "ns"), np.timedelta64("NaT", "ns"), np.timedelta64(2, "s")]


@pytest.mark.parametrize("time", [*TIMES, *(np.array([t, t, t]) for t in TIMES)])
def test_spans_of_time_are_no_integers_though_numpy_counts_them_so(time):
    kinds = X, Jet(X, X * 0 + 1), Interval(1, 2)
    operations = [
        *(lambda op=op, y=y: op(y, time) for op in OPERATORS for y in kinds),
        *(lambda op=op, y=y: op(time, y) for op in OPERATORS for y in kinds),
        *(lambda: X.contains(time), lambda: X.certainly_less(time), lambda: X.maximum(time)),
        *(lambda: np.where(True, X, time), lambda: IntervalArray(time), lambda: X.atan2(time)),
        *(lambda: np.maximum(X, time), lambda: np.concatenate([X[0], time])),
    ]
    if not time.ndim:
        operations.append(lambda: Interval(time))
    for operation in operations:
        with pytest.raises((TypeError, ValueError)):
            operation()


OPERATORS = (operator.add, operator.sub, operator.mul, operator.truediv, operator.pow)


def test_integers_that_binary64_does_not_hold_are_enclosed():
    big = np.array([2**53 + 1, 2**62 + 1, 3])
    for total in (X[0] + big, big + X[0], np.add(X[0], big), X[0] - (-big)):
        assert contains(total, exact(X[0].sup) + np.array([int(n) for n in big], dtype=object))
    assert contains(X[0] * np.uint64(2**64 - 1), exact(X[0].inf) * (2**64 - 1))


def test_an_int_of_a_subclass_is_its_value():
    class Odd(int):
        def __abs__(self):
            return 1

    assert same(X * Odd(5), X * 5) and same(X ** Odd(2), X**2)


def test_odd_arguments_have_their_errors():
    with pytest.raises(ValueError, match="order -1"):
        np.diff(X, -1)
    with pytest.raises(TypeError):
        np.array_equal(X, np.ones((2, 3)))


def test_masked_arrays_are_refused():
    masked = np.ma.array([1, 2, 3], mask=[False, True, False])
    for operation in (
        *(lambda: X + masked, lambda: masked + X, lambda: IntervalArray(masked)),
        *(lambda: IntervalArray.from_floats(masked), lambda: np.where(True, X, masked)),
        lambda: IntervalArray.from_floats(np.ma.array([1.0], mask=[True])),
    ):
        with pytest.raises(TypeError):
            operation()


COMPUTED = {  # of intervals, and of the same exact numbers as objects
    "mean": lambda a: np.mean(a, axis=0),
    "mean of all": np.mean,
    "diff": np.diff,
    "second diff": lambda a: np.diff(a, 2, axis=0),
    "cumsum": np.cumsum,
    "cumsum of rows": lambda a: np.cumsum(a, axis=1),
    "trace": lambda a: np.trace(a, 1),
    "inner": lambda a: np.inner(a, a),
    "inner of vectors": lambda a: np.inner(a[0], a[1]),
    "outer": lambda a: np.outer(a[0], a[1]),
    "vdot": lambda a: np.vdot(a, a),
    "product of three": lambda a: np.einsum("ij,kj,il->kl", a, a, a),
    "trace by subscripts": lambda a: np.einsum("ii", a[:, :3]),
    "with ints": lambda a: np.einsum("ij,j->i", a, np.arange(4)),
    "max": lambda a: np.max(a, axis=1),
    "min": np.min,
    "clip": lambda a: np.clip(a, -1, 2),
    "zeros": np.zeros_like,
    "ones": np.ones_like,
}


@pytest.mark.parametrize("name", COMPUTED)
@for_all(st.data(), tries=20)
def test_functions_that_compute_against_fractions(name, data):
    values = data.draw(matrices(3, 4))
    found = COMPUTED[name](IntervalArray.from_floats(values))
    assert contains(found, np.array(COMPUTED[name](exact(values)), dtype=object))


def test_largest_of_wide_intervals():
    low = np.max(IntervalArray([(1, 5), (2, 3)]))
    assert (low.inf, low.sup) == (2, 5)
    assert (np.min(IntervalArray([(1, 5), (2, 3)])).sup) == 3


def test_dot_of_many_axes_is_no_matrix_product():
    cube = X.reshape(1, 2, 3)
    with pytest.raises(TypeError, match="two axes"):
        np.dot(cube, cube)


floats = st.floats(-1e30, 1e30, allow_subnormal=True)


def exact(values):
    table = np.array([Fraction(v) for v in values.flat], dtype=object)
    return table.reshape(values.shape)


def contains(result, true):
    """Whether the intervals contain numbers in an array of the same shape."""
    columns = zip(result.inf.flat, result.sup.flat, true.flat, strict=True)
    assert result.shape == true.shape
    return all(Fraction(low) <= value <= Fraction(high) for low, high, value in columns)


@st.composite
def matrices(draw, rows, columns):
    size = rows * columns
    return np.array(draw(st.lists(floats, min_size=size, max_size=size))).reshape(rows, columns)


@for_all(st.data(), st.integers(0, 5), st.integers(0, 7), st.sampled_from([0, 1, -1]), tries=60)
def test_sums_and_products_against_fractions(data, rows, columns, axis):
    values = data.draw(matrices(rows, columns))
    x = IntervalArray.from_floats(values)
    assert contains(np.sum(x, axis=axis), exact(values).sum(axis=axis))
    assert contains(np.prod(x, axis=axis), exact(values).prod(axis=axis))
    assert same(np.add.reduce(x), x.sum(axis=0))
    assert x.sum().shape == ()


@for_all(st.data(), *[st.integers(0, 4)] * 3, tries=40)
def test_matrix_products_against_fractions(data, n, k, m):
    a, b = data.draw(matrices(n, k)), data.draw(matrices(k, m))
    true = exact(a) @ exact(b) if k else np.zeros((n, m))
    assert contains(IntervalArray.from_floats(a) @ IntervalArray.from_floats(b), true)


def test_matrix_products_follow_numpy_in_their_shapes():
    for left, right in (
        *(((3,), (3,)), ((2, 3), (3,)), ((2,), (2, 3))),
        *(((5, 2, 3), (3, 4)), ((2, 3), (5, 3, 1))),
    ):
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
