"""Interval Newton on functions whose zeros are known: it may fail to decide, never lie."""

from fractions import Fraction
from functools import reduce

import flint
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from intervals import Interval
from intervals.newton import Roots, derivative, newton
from tests.effort import examples
from tests.intervals import oracle
from tests.intervals.oracle import pi_bounds, sqrt_down, sqrt_up, ulp


def square_minus_two(x):
    return x.sqr() - 2


def twice(x):
    return 2 * x


def cosine_slope(x):
    return -x.sin()


# -- single functions ------------------------------------------------------------------------------


@pytest.mark.parametrize("precision", [10, 53, 200, 1000])
def test_the_square_root_of_two(precision):
    result = newton(square_minus_two, twice, Interval(1, 2, precision=precision))
    assert result.outcome is Roots.UNIQUE
    assert result.box.inf <= sqrt_down(Fraction(2), precision)
    assert sqrt_up(Fraction(2), precision) <= result.box.sup
    assert result.box.wid <= 4 * ulp(Fraction(1), precision)


@pytest.mark.parametrize("precision", [53, 300])
def test_the_zero_of_the_cosine(precision):
    result = newton(Interval.cos, cosine_slope, Interval(1, 2, precision=precision))
    low, high = pi_bounds(precision + 50)
    assert result.outcome is Roots.UNIQUE
    assert result.box.inf <= low / 2 and high / 2 <= result.box.sup
    assert result.box.wid <= 4 * ulp(Fraction(1), precision)


@pytest.mark.parametrize(
    "ends", [("1.42", 2), ("1.415", "1.416"), (3, 4), ("-1.41", "-1.3"), (1, "1.414")]
)
def test_no_zero_in_the_box(ends):
    assert newton(square_minus_two, twice, Interval(*ends)) == (
        Roots.NONE,
        None,
        "the Newton image is disjoint from the box",
    )


def test_a_zero_just_outside_the_box():
    for precision in (53, 200):
        below, above = (f(Fraction(2), precision) for f in (sqrt_down, sqrt_up))
        for box in (
            Interval(above, 2, precision=precision),
            Interval(1, below, precision=precision),
        ):
            result = newton(square_minus_two, twice, box)
            assert result.outcome is not Roots.UNIQUE
            near = Interval(above, above + Fraction(1, 100), precision=precision)
            assert newton(square_minus_two, twice, near).outcome is not Roots.UNIQUE


def test_an_image_that_overlaps_the_box_proves_nothing():
    """After one step from [1.42, 2] the image [1.38, 1.48] overlaps the box, without a zero."""
    result = newton(square_minus_two, twice, Interval("1.42", 2), steps=1)
    assert result.outcome is Roots.UNDECIDED
    assert result.box.inf == Interval("1.42").inf and result.box.sup < Fraction("1.49")


def test_a_double_zero_is_not_decided():
    box = Interval("-0.3", "0.5")
    result = newton(Interval.sqr, twice, box)
    assert result == (Roots.UNDECIDED, box, "the derivative's enclosure contains 0")
    assert newton(Interval.sqr, twice, Interval(0, 1)).outcome is Roots.AT_LEAST_ONE
    assert newton(Interval.sqr, twice, Interval(-1, "-0.01")).outcome is Roots.NONE


def test_two_zeros_are_not_decided():
    assert newton(square_minus_two, twice, Interval(-2, 2)).outcome is Roots.UNDECIDED


def cube(x):
    return x * x * x


def test_opposite_signs_at_the_ends_prove_a_zero():
    slope = derivative(cube)
    for ends in ((-1, 2), (-2, 1), (0, 1), (-1, 0), (0, 0)):
        box = Interval(*ends)
        result = newton(cube, slope, box)
        assert (result.outcome, result.box) == (Roots.AT_LEAST_ONE, box)
        assert "changes its sign" in result.reason
        assert newton(lambda x: -cube(x), lambda x: -slope(x), box).outcome is Roots.AT_LEAST_ONE
    three = newton(lambda x: cube(x) - x, derivative(lambda x: cube(x) - x), Interval(-2, 2))
    assert three.outcome is Roots.AT_LEAST_ONE


def test_signs_that_are_not_strictly_known_prove_nothing():
    """The enclosure of f(0) is [-2^-40, 2^-40]: the sign at this end is open."""
    noise = Interval(Fraction(-1, 2**40), Fraction(1, 2**40))
    result = newton(lambda x: cube(x) + noise, derivative(cube), Interval(0, 1))
    assert result.outcome is Roots.UNDECIDED


def test_the_enclosure_of_f_excludes_a_zero_where_the_slope_is_not_known():
    result = newton(lambda x: x.sqr() + 1, twice, Interval(-1, 1))
    assert result == (Roots.NONE, None, "the enclosure of f over the box excludes 0")


@pytest.mark.parametrize("precision", [53, 500])
def test_the_derivative_comes_from_a_jet(precision):
    def f(x):
        return x * x.exp() - 1

    result = newton(f, derivative(f), Interval(0, 1, precision=precision))
    with flint.ctx.workprec(precision + 60):
        low, high = oracle.ends(flint.arb(1).lambertw())
    assert result.outcome is Roots.UNIQUE
    assert result.box.inf <= low and high <= result.box.sup
    assert result.box.wid < 8 * ulp(Fraction(1, 2), precision)
    assert derivative(lambda x: x * 0 + 3)(Interval(1, 2)) == Interval(0)
    assert derivative(lambda x: 3 * x)(Interval(1, 2)) == Interval(3)


def test_a_zero_at_the_end_of_the_box():
    for ends in ((0, 1), (-1, 0), (0, 0)):
        for slope in (1, 3):
            box, constant = Interval(*ends), Interval(slope)
            result = newton(constant.__mul__, lambda x, constant=constant: constant, box)
            assert (result.outcome, result.box) == (Roots.UNIQUE, Interval(0))
    low, high = sqrt_down(Fraction(2), 53), sqrt_up(Fraction(2), 53)
    for ends in ((low, 2), (1, high), (low, high)):
        result = newton(square_minus_two, twice, Interval(*ends))
        assert result.outcome is not Roots.NONE
        assert result.box.inf <= low and high <= result.box.sup


def test_a_point_is_decided_at_once():
    calls = []

    def f(x):
        calls.append(x)
        return x - 1

    assert newton(f, lambda x: Interval(1), Interval(1)).outcome is Roots.UNIQUE
    assert newton(f, lambda x: Interval(1), Interval(2)).outcome is Roots.NONE
    assert len(calls) < 5


def test_no_step_proves_nothing():
    box = Interval(1, 2)
    assert newton(square_minus_two, twice, box, steps=0)[:2] == (Roots.UNDECIDED, box)


def test_the_outcome_has_a_reason():
    for ends in ((1, 2), (3, 4), (-1, 1)):
        assert newton(square_minus_two, twice, Interval(*ends)).reason


# -- polynomials with known rational zeros ---------------------------------------------------------


def product(a, b):
    """The coefficients of the product of two polynomials, lowest first."""
    result = [Fraction(0)] * (len(a) + len(b) - 1)
    for i, x in enumerate(a):
        for j, y in enumerate(b):
            result[i + j] += x * y
    return result


def polynomial(coefficients):
    def value(x):
        return reduce(lambda total, c: total * x + c, reversed(coefficients), x * 0)

    return value


rationals = st.fractions(-2, 2, max_denominator=12)


@st.composite
def problems(draw):
    """A polynomial as its zeros, a factor without any, and a box, often ending at a zero."""
    roots = draw(st.lists(rationals, max_size=4))
    shift, lift = draw(rationals), draw(st.fractions(Fraction(1, 20), 3, max_denominator=20))
    coefficients = [Fraction(draw(st.sampled_from([-2, 1, 3])))]
    for root in roots:
        coefficients = product(coefficients, [-root, Fraction(1)])
    if draw(st.booleans()):
        coefficients = product(coefficients, [shift * shift + lift, -2 * shift, Fraction(1)])
    around = [*roots, *(r + d for r in roots for d in (Fraction(1, 10**4), Fraction(-1, 10**6)))]
    ends = st.sampled_from(around) | rationals if roots else rationals
    low, high = sorted([draw(ends), draw(ends)])
    if draw(st.booleans()):
        high = low + (high - low) / draw(st.sampled_from([3, 40, 10**5]))
    return (
        coefficients,
        set(roots),
        Interval(low, high, precision=draw(st.sampled_from([8, 24, 53, 120]))),
    )


def check_newton(coefficients, roots, box):
    slopes = [k * c for k, c in enumerate(coefficients)][1:] or [Fraction(0)]
    result = newton(polynomial(coefficients), polynomial(slopes), box)
    inside = [root for root in roots if box.inf <= root <= box.sup]
    if result.outcome is Roots.NONE:
        assert result.box is None
        assert inside == []
    else:
        assert box.contains(result.box)
        assert all(result.box.contains(root) for root in inside)
    if result.outcome is Roots.UNIQUE:
        assert len(inside) == 1
    if result.outcome is Roots.AT_LEAST_ONE:
        assert inside
    return result


@settings(deadline=None, max_examples=examples(60))
@given(problems())
@example(([Fraction(-1), Fraction(0), Fraction(1)], {Fraction(1), Fraction(-1)}, Interval(-1, 1)))
@example(([Fraction(1), Fraction(-2), Fraction(1)], {Fraction(1)}, Interval(1, 2)))
@example(([Fraction(-2), Fraction(1)], {Fraction(2)}, Interval(1, 2)))
def test_what_is_claimed_of_a_polynomial_is_true(problem):
    check_newton(*problem)


@pytest.mark.slow
@settings(deadline=None, max_examples=600)
@given(problems())
def test_what_is_claimed_of_a_polynomial_is_true_at_length(problem):
    check_newton(*problem)


@settings(deadline=None, max_examples=examples(50))
@given(
    st.lists(st.integers(-20, 20), min_size=1, max_size=4, unique=True),
    st.fractions(Fraction(1, 10), 1, max_denominator=100),
    st.fractions(Fraction(1, 10), 1, max_denominator=100),
)
def test_an_isolated_simple_zero_is_found(roots, left, right):
    coefficients = reduce(product, ([Fraction(-r), Fraction(1)] for r in roots))
    centre, reach = roots[0], Fraction(1, 2 * 25 * len(roots) * 20 ** len(roots))
    box = Interval(centre - left * reach, centre + right * reach, precision=120)
    assert check_newton(coefficients, roots, box).outcome is Roots.UNIQUE
