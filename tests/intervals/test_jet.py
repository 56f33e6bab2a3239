"""Jets against sympy's derivatives and Arb's power series, over several number types."""

import operator
from fractions import Fraction
from math import factorial

import flint
import numpy as np
import pytest
from hypothesis import assume
from hypothesis import strategies as st

import intervals
from intervals import DomainError, Interval, Jet
from intervals.array import IntervalArray
from tests.intervals import oracle
from tests.intervals.boxes import for_all, inside

ORDER = 6


def variable(x, order=ORDER):
    """The jet of the variable itself, at x, in the number type of x."""
    return Jet(x, x * 0 + 1, *(x * 0 for _ in range(order - 1)))


def test_the_variable():
    assert Jet.variable(Fraction(3), 3).coefficients == (3, 1, 0, 0)
    assert Jet.variable(Fraction(3), 0).coefficients == (3,)
    for x in (Interval(3), Interval(2, 3)):
        assert Jet.variable(x).coefficients == (x, Interval(1))


def test_whole_coefficients_never_become_floats():
    x = Jet(5, 1, 0)
    assert (x / 3).coefficients == (Fraction(5, 3), Fraction(1, 3), 0)
    for jet in (1 / x, x / x, x / (x + 1)):
        assert not any(isinstance(c, float) for c in jet.coefficients)


# -- over Fractions: exact -------------------------------------------------------------------------


coefficients = st.lists(st.fractions(-3, 3, max_denominator=20), min_size=1, max_size=ORDER + 1)


@for_all(coefficients, coefficients)
def test_operations_truncate_to_the_shorter_order(a, b):
    x, y, n = Jet(*a), Jet(*b), min(len(a), len(b))
    assert (x + y).coefficients == tuple(s + t for s, t in zip(a, b, strict=False))
    assert (x - y).coefficients == tuple(s - t for s, t in zip(a, b, strict=False))
    assert (x * y).coefficients == tuple(
        sum(a[j] * b[k - j] for j in range(k + 1)) for k in range(n)
    )
    assert (-x).coefficients == tuple(-s for s in a)
    assert (x + y).order == (x * y).order == n - 1
    assume(b[0])
    assert ((x / y) * y).coefficients == tuple(a[:n])
    assert (1 / y).order == y.order
    assert (1 / y * y).coefficients == (1, *(0 for _ in b[1:]))


@for_all(coefficients, st.fractions(-3, 3, max_denominator=20) | st.integers(-5, 5))
def test_constants_are_jets_without_slope(a, c):
    x, constant = Jet(*a), Jet(Fraction(c), *(Fraction(0) for _ in a[1:]))
    for op in (operator.add, operator.sub, operator.mul, operator.truediv):
        if op is not operator.truediv or c:
            assert op(x, c).coefficients == op(x, constant).coefficients
        if op is not operator.truediv or a[0]:
            assert op(c, x).coefficients == op(constant, x).coefficients


def test_the_text_names_the_coefficients():
    assert repr(Jet(1, Fraction(1, 2))) == "Jet(1, Fraction(1, 2))"


# -- over Intervals: containment of Arb's series at points inside ----------------------------------

FUNCTIONS = {
    "sin": lambda x: x.sin(),
    "cos": lambda x: x.cos(),
    "exp": lambda x: x.exp(),
    "log": lambda x: (x * x + 1).log(),
    "sqrt": lambda x: (x * x + 2).sqrt(),
    "quotient": lambda x: x / (x * x + 1),
    "reciprocal": lambda x: 1 / (x * x + 3),
    "chain": lambda x: (x.sin() * 2 + x * x).cos(),
    "mixture": lambda x: (x.exp() + 1).log() * (x.cos() + 2).sqrt() / (2 + (x * 3).sin()) - 5 * x,
    "growth": lambda x: ((x.sin() + 2).log() * x).exp(),
    "tan": lambda x: (x / 4).tan(),
    "atan": lambda x: (x - 1).atan(),
    "asin": lambda x: (x / 5).asin(),
    "acos": lambda x: (x / 5).acos(),
    "power": lambda x: (x * x + 2) ** 3,
    "square": lambda x: (x + 1) ** 2,
}


def half(x, sign):
    """(exp(x) + sign exp(-x)) / 2 for Arb's series, which lack the hyperbolic functions."""
    return (x.exp() + sign * (-x).exp()) / 2


def raised(x, exponent):
    """x to the power, for x > 0."""
    return (x.log() * exponent).exp()


OTHERS = {  # and the same from functions that Arb's series have
    "sinh": (lambda x: x.sinh(), lambda x: half(x, -1)),
    "cosh": (lambda x: x.cosh(), lambda x: half(x, 1)),
    "tanh": (lambda x: x.tanh(), lambda x: half(x, -1) / half(x, 1)),
    "expm1": (lambda x: x.expm1(), lambda x: x.exp() - 1),
    "log1p": (lambda x: (x * x).log1p(), lambda x: (1 + x * x).log()),
    "asinh": (lambda x: x.asinh(), lambda x: (x + (x * x + 1).sqrt()).log()),
    "acosh": (
        lambda x: (x * x + 2).acosh(),
        lambda x: (x * x + 2 + ((x * x + 2) ** 2 - 1).sqrt()).log(),
    ),
    "atanh": (lambda x: (x / 5).atanh(), lambda x: ((5 + x) / (5 - x)).log() / 2),
    "quotient of powers": (lambda x: (x + 5) ** -2, lambda x: 1 / ((x + 5) * (x + 5))),
    "cube": (lambda x: (x + 1) ** 3, lambda x: (x + 1) * (x + 1) * (x + 1)),
    "seventh power": (lambda x: (x / 2) ** 7, lambda x: x * x * x * x * x * x * x / 128),
    "cbrt": (lambda x: (x * x + 1).cbrt(), lambda x: raised(x * x + 1, flint.fmpq(1, 3))),
    "cbrt below 0": (lambda x: (-1 - x * x).cbrt(), lambda x: -raised(x * x + 1, flint.fmpq(1, 3))),
    "exp2": (lambda x: x.exp2(), lambda x: (x * flint.arb(2).log()).exp()),
    "exp10": (lambda x: x.exp10(), lambda x: (x * flint.arb(10).log()).exp()),
    "log2": (lambda x: (x * x + 1).log2(), lambda x: (x * x + 1).log() / flint.arb(2).log()),
    "log10": (lambda x: (x * x + 1).log10(), lambda x: (x * x + 1).log() / flint.arb(10).log()),
    "rational power": (
        lambda x: (x * x + 2) ** Fraction(-3, 2),
        lambda x: raised(x * x + 2, flint.fmpq(-3, 2)),
    ),
    "real power": (lambda x: (x * x + 2).pow(x), lambda x: raised(x * x + 2, x)),
    "exponential": (lambda x: 3**x, lambda x: (x * flint.arb(3).log()).exp()),
    "hypot": (lambda x: np.hypot(3, x), lambda x: (x * x + 9).sqrt()),
    "atan2": (lambda x: x.atan2(x * x + 1), lambda x: (x / (x * x + 1)).atan()),
    "atan2 of y > 0": (
        lambda x: np.arctan2(x + 5, x),
        lambda x: flint.arb.pi() / 2 - (x / (x + 5)).atan(),
    ),
    "atan2 of y < 0": (
        lambda x: intervals.atan2(-5, x),
        lambda x: -flint.arb.pi() / 2 + (x / 5).atan(),
    ),
    "abs": (lambda x: abs(x + 5) + np.abs(x - 5), lambda x: 0 * x + 10),
    "maximum": (lambda x: x.maximum(x - 1).maximum(-9), lambda x: x),
    "minimum": (lambda x: np.minimum(7, intervals.minimum(x, x + 1)), lambda x: x),
    "steps": (
        lambda x: (x / 100 + Fraction(1, 4)).floor() + np.rint(x / 100) + np.sign(x - 9),
        lambda x: 0 * x - 1,
    ),
}
THEIRS = FUNCTIONS | {name: theirs for name, (_, theirs) in OTHERS.items()}
FUNCTIONS |= {name: ours for name, (ours, _) in OTHERS.items()}


def series(name, point, bits):
    """The ends of the Taylor coefficients at a point, from Arb's power series."""
    with flint.ctx.workprec(bits):
        x = flint.arb_series([oracle.arb(point), 1], prec=ORDER + 1)
        cap, flint.ctx.cap = flint.ctx.cap, ORDER + 1
        try:
            y = THEIRS[name](x)
        finally:
            flint.ctx.cap = cap
        return [oracle.ends(y[k]) for k in range(ORDER + 1)]


def check_jet(jet, name, point, bits):
    assert jet.order == ORDER
    for k, (low, high) in enumerate(series(name, point, 2 * bits + 100)):
        assert jet.coefficients[k].inf <= high and low <= jet.coefficients[k].sup
        derivative = jet.derivative(k)
        assert derivative.inf <= high * factorial(k) and low * factorial(k) <= derivative.sup


@for_all(
    st.data(),
    st.sampled_from(sorted(FUNCTIONS)),
    st.fractions(-3, 3, max_denominator=100),
    st.sampled_from([Fraction(0), Fraction(1, 10**6), Fraction(1, 100), Fraction(1, 4)]),
    st.sampled_from([20, 53, 113, 300]),
)
def test_jets_of_intervals_contain_the_series_at_every_point(data, name, low, width, precision):
    box = Interval(low, low + width, precision=precision)
    jet = FUNCTIONS[name](variable(box))
    check_jet(jet, name, data.draw(inside(low, low + width)), precision)


every_function = pytest.mark.parametrize("name", sorted(FUNCTIONS))


@every_function
@pytest.mark.parametrize("precision", [53, 400])
def test_jets_at_a_point_are_nearly_exact(name, precision):
    for point in (Fraction(-5, 4), Fraction(0), Fraction(3, 8)):
        jet = FUNCTIONS[name](variable(Interval(point, precision=precision)))
        check_jet(jet, name, point, precision)
        assert all(c.wid <= Fraction(1, 2 ** (precision - 16)) for c in jet.coefficients)


def test_slopes_over_wide_intervals_are_those_of_the_formulas():
    u = Interval(1, 2)
    x = variable(u, 2)
    for jet, slope in (
        (x.sqrt(), 1 / (2 * u.sqrt())),
        (x.log(), 1 / u),
        (x.exp(), u.exp()),
        (x.sin(), u.cos()),
        (x.cos(), -u.sin()),
        (1 / x, -(1 / u) / u),
        (3 - x, Interval(-1)),
    ):
        assert jet.derivative() == slope
    assert x.log().coefficients[2].inf >= -1


KINKS = {
    "abs": (abs, 0),
    "floor": (Jet.floor, 3),
    "ceil": (np.ceil, -2),
    "trunc": (np.trunc, 1),
    "round_ties_to_even": (np.rint, Fraction(5, 2)),
    "round_ties_to_away": (Jet.round_ties_to_away, Fraction(-1, 2)),
    "sign": (np.sign, 0),
    "maximum": (lambda x: x.maximum(2 - x), 1),
    "minimum": (lambda x: x.minimum(1), 1),
    "atan2": (lambda x: x.atan2(-1), 0),
    "sqrt": (Jet.sqrt, 0),
    "cbrt": (Jet.cbrt, 0),
    "pow": (lambda x: x.pow(Fraction(1, 2)), 0),
    "hypot": (lambda x: x.hypot(0), 0),
}


@pytest.mark.parametrize("name", KINKS)
@pytest.mark.parametrize("kind", [Interval, lambda low, high: IntervalArray(["5.25", (low, high)])])
def test_no_derivative_where_the_function_has_none(name, kind):
    """Nor at a point at the end of the interval: a derivative is one from both sides."""
    function, kink = KINKS[name]
    far = Fraction(1, 10**6)
    for low, high in ((kink, kink), (kink, kink + far), (kink, kink + Fraction(1, 4))):
        assert function(Jet(kind(low, high))).order == 0
        with pytest.raises(DomainError):
            function(variable(kind(low, high), 1))
        function(variable(kind(low + far, high + far), 1))


def test_roots_of_what_crosses_0_have_no_value():
    for function in (
        Jet.sqrt,
        Jet.log,
        lambda x: x.pow(Fraction(1, 2)),
        lambda x: x ** Interval(3),
    ):
        with pytest.raises(DomainError):
            function(Jet(Interval(-1, 1)))


def test_what_numpy_asks_of_jets():
    x = variable(IntervalArray([1, 2]), 2)
    for jet in (np.array([3, 4]) * x, np.multiply(np.array([3, 4]), x)):
        assert jet.order == 2 and jet.value.contains(IntervalArray([3, 8])).all()
    for wrong in (
        lambda: np.array([0.5, 1.5]) + x,
        lambda: np.add.reduce(x),
        lambda: np.less(x, 1),
        lambda: np.matmul(x, x),
        lambda: np.add(x, x, out=np.zeros(2)),
        lambda: np.isnan(x),
        lambda: x.maximum("1"),
    ):
        with pytest.raises(TypeError):
            wrong()


# -- over IntervalArrays ---------------------------------------------------------------------------


@every_function
def test_jets_of_interval_arrays_contain_the_series(name):
    lower = [-2.5, -1.0, -0.125, 0.0, 0.75, 3.0]
    upper = [-2.5, -0.9375, 0.125, 0.0, 0.8125, 3.25]
    jet = FUNCTIONS[name](variable(IntervalArray.from_floats(lower, upper)))
    for index, (low, high) in enumerate(zip(lower, upper, strict=True)):
        part = Jet(*(c[index].item() for c in jet.coefficients))
        for point in {Fraction(low), Fraction(high), (Fraction(low) + Fraction(high)) / 2}:
            check_jet(part, name, point, 53)


def test_jets_take_interval_arrays_and_intervals_as_constants():
    array = IntervalArray.from_floats([1.0, 2.0])
    x = variable(array)
    for op in (operator.add, operator.sub, operator.mul, operator.truediv):
        for jet in (op(x, array), op(array, x)):
            assert isinstance(jet, Jet) and jet.coefficients[0].shape == (2,)
    assert (array - x).coefficients[0].contains(0).all()
    assert (array / x).coefficients[0].contains(1).all()
    assert (array * x).coefficients[0].contains(IntervalArray([1, 4])).all()
    third = Interval(Fraction(1, 3))
    y = variable(Interval(3))
    for jet in (third * y, y * third):
        assert isinstance(jet, Jet)
        assert jet.value.contains(1) and jet.derivative().contains(third)
    assert (third - y).value.contains(Fraction(-8, 3))
    assert (third / y).value.contains(Fraction(1, 9))
