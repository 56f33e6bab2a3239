"""What an audit beside other libraries found: false, lost, or stopped for no reason."""

import operator
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import strategies as st

from intervals import Decorated, DomainError, Interval, IntervalArray, Jet, rootn
from intervals import pow as power
from intervals.taylor import taylor
from tests.intervals.boxes import for_all
from tests.intervals.test_numpy import same

ROOT = Decorated(Interval(-1, 4)).sqrt()  # [0, 2]_trv
X = IntervalArray([[1, 2, 3], [4, 5, 6]])


@pytest.mark.parametrize("n", [2, 4, 6])
@pytest.mark.parametrize("order", [0, 1, 2])
def test_even_roots_of_negative_numbers(n, order):
    for kind in (Interval, lambda *ends: IntervalArray([ends])):
        with pytest.raises(DomainError):
            taylor(lambda x: rootn(x, n), kind(-5, -3), order)
        with pytest.raises(DomainError):
            rootn(Jet.variable(kind(-5, -3), order), n)
        assert rootn(Jet.variable(kind(3, 5), order), n).order == order


@pytest.mark.parametrize("n", [3, 5])
def test_odd_roots_of_negative_numbers(n):
    jet = rootn(Jet.variable(Interval(-5, -3), 2), n)
    below = rootn(Jet.variable(Interval(3, 5), 2), n)
    assert jet.value == Interval(-5, -3).rootn(n)
    tenth = Fraction(1, 10)
    assert jet.derivative().contains(tenth) == below.derivative().contains(tenth)


LOSSES = {
    "sum": lambda: IntervalArray([0]) + ROOT,
    "sum from the left": lambda: ROOT + IntervalArray([0]),
    "constructor": lambda: IntervalArray([ROOT]),
    "pair": lambda: IntervalArray([(0, ROOT)]),
    "contains": lambda: IntervalArray([0]).contains(ROOT),
    "hull": lambda: IntervalArray([0]).hull(ROOT),
    "minimum": lambda: np.minimum(X, ROOT),
    "concatenate": lambda: np.concatenate((IntervalArray([0]), [ROOT])),
    "Interval": lambda: Interval(ROOT),
    "intersection": lambda: Interval(0, 1).intersection(ROOT),
}


@pytest.mark.parametrize("operation", LOSSES)
def test_a_decoration_is_not_lost(operation):
    with pytest.raises(TypeError):
        LOSSES[operation]()


def test_decorated_and_bare_intervals_meet():
    assert (Interval(0) + ROOT).decoration == (ROOT * Interval(1)).decoration == ROOT.decoration


@pytest.mark.parametrize("subscripts", ["ij->k", "ij->iij", "...j->j", "ij->i1", "ij,jk->ik"])
def test_sums_that_einsum_has_not(subscripts):
    with pytest.raises(ValueError, match=r"einsum|zip"):
        np.einsum(subscripts, X)


@pytest.mark.parametrize("subscripts", ["ij->ji", "ij->", "ij->j", "ij", "ji"])
def test_sums_of_einsum(subscripts):
    for optimize in (False, True, "greedy"):
        found = np.einsum(subscripts, X, optimize=optimize)
        assert np.all(found.contains(IntervalArray(np.einsum(subscripts, X.sup.astype(int)))))


CRASHES = {
    "longdouble": lambda: np.longdouble(1) + Interval(1),
    "longdouble array": lambda: np.ones(2, np.longdouble) + Interval(1),
    "power of a fraction": lambda: Fraction(1, 2) ** Interval(-1, 1),
    "power of a fraction, array": lambda: Fraction(1, 2) ** X,
    "precision": lambda: Interval(1, precision=53.0),
    "precision of a float": lambda: Interval.from_float(1.0, precision=53.0),
    "another precision": lambda: Interval(1).with_precision(53.0),
}


@pytest.mark.parametrize("operation", CRASHES)
def test_one_line_says_what_is_wrong(operation):
    with pytest.raises(TypeError, match=r"float|integer"):
        CRASHES[operation]()


def test_what_to_write_instead():
    assert power(Fraction(1, 2), Interval(-1, 1)) == Interval(Fraction(1, 2), 2)
    x = Interval(1, precision=np.int64(53))
    assert type(x.precision) is int and str(x) == str(Interval(1))


@pytest.mark.parametrize("function", [np.arctan2, np.maximum, np.minimum, np.hypot])
def test_functions_of_two_intervals(function):
    x, y = Interval(1, 2), Interval(3, 4)
    (expected,) = function(IntervalArray([x]), IntervalArray([y])).tolist()
    for found in (function(x, y), function(np.array([x]), y)[0]):
        assert isinstance(found, Interval) and expected.contains(found)
    assert isinstance(function(1, y), Interval) and isinstance(np.arcsin(Interval(1)), Interval)
    assert np.maximum(Interval(0, 2), Interval(1, 3)) == Interval(1, 3)  # not decided by an order


REDUCTIONS = {"sum": np.sum, "prod": np.prod, "max": np.max, "min": np.min, "mean": np.mean}
axes = st.sampled_from([None, 0, 1, 2, -1, (0, 1), (2, 0), (-1, 1), (0, 1, 2), ()])


@for_all(st.sampled_from(sorted(REDUCTIONS)), axes, st.booleans(), st.booleans())
def test_reductions_over_any_axes(name, axis, keepdims, method):
    numbers = np.arange(-7, 17).reshape(2, 3, 4)
    options = {"axis": axis, "keepdims": keepdims}
    expected = REDUCTIONS[name](numbers, **options)
    found = REDUCTIONS[name](IntervalArray(numbers), **options)
    assert found.shape == expected.shape
    exact = IntervalArray.from_floats(expected)
    assert np.all(found.contains(exact)) and np.all(found.wid <= 1e-9 * (1 + np.abs(expected)))


def test_reductions_from_a_number():
    assert X.sum(initial=1).contains(22) and not X.sum(initial=1).contains(21)
    assert np.prod(X, axis=1, initial=2).contains(IntervalArray([12, 240])).all()
    assert np.add.reduce(X, keepdims=True).shape == (1, 3)
    for axis in (2, -3, (0, 2), (0, 0)):
        with pytest.raises(ValueError):  # AxisError is one
            X.sum(axis=axis)


@pytest.mark.parametrize("axis", [None, 0, 1])
def test_cumulated_sums_of_nothing(axis):
    nothing = np.zeros((0, 3), dtype=int)
    assert np.cumsum(IntervalArray(nothing), axis=axis).shape == np.cumsum(nothing, axis=axis).shape
    assert IntervalArray(nothing).shape == (0, 3)


def test_products_with_numbers():
    for a, b in ((2, X), (X, 2), (Interval(2), X)):
        assert np.dot(a, b).contains(X * 2).all()
    assert same(np.dot(X, np.array([1, 0, 0])), X @ IntervalArray([1, 0, 0]))


def test_an_operator_of_fractions_is_told():
    for operation in (operator.add, operator.mul):
        with pytest.raises(TypeError, match=r"Fraction\(5, 2\)"):
            operation(X, 2.5)
