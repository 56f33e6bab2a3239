"""Interval Newton on functions whose zeros are known: it may fail to decide, never lie."""

from fractions import Fraction
from functools import partial, reduce

import flint
import pytest
from hypothesis import example
from hypothesis import strategies as st

from intervals import Interval
from intervals.newton import Roots, derivative, newton
from tests.intervals import oracle
from tests.intervals.boxes import check_claim, for_all, horner
from tests.intervals.oracle import pi_bounds, sqrt_down, sqrt_up, ulp


def square_minus_two(x):
    return x.sqr() - 2


def twice(x):
    return 2 * x


ONE, TWO = Fraction(1), Fraction(2)


# -- single functions ------------------------------------------------------------------------------


def equation(x):
    return x * x.exp() - 1


def omega(precision):
    """The zero of x e^x - 1."""
    with flint.ctx.workprec(precision + 60):
        return oracle.ends(flint.arb(1).lambertw())


@pytest.mark.parametrize("precision", [10, 53, 200, 1000])
@pytest.mark.parametrize(
    ("f", "df", "ends", "zero"),
    [
        (square_minus_two, twice, (1, 2), lambda p: (sqrt_down(TWO, p), sqrt_up(TWO, p))),
        (Interval.cos, lambda x: -x.sin(), (1, 2), lambda p: [x / 2 for x in pi_bounds(p + 50)]),
        (equation, derivative(equation), (0, 1), omega),
    ],
)
def test_a_zero_to_every_precision(f, df, ends, zero, precision):
    result = newton(f, df, Interval(*ends, precision=precision))
    low, high = zero(precision)
    assert result.outcome is Roots.UNIQUE
    assert result.box.inf <= low and high <= result.box.sup
    assert result.box.wid <= 4 * ulp(Fraction(1), precision)


def cube(x):
    return x * x * x


NOISE = Interval(Fraction(-1, 2**40), Fraction(1, 2**40))
DISJOINT, UNKNOWN, SIGNS = "disjoint from the box", "enclosure contains 0", "changes its sign"
CASES = [  # f, f', a box, the outcome and its reason
    *(
        (square_minus_two, twice, ends, Roots.NONE, DISJOINT)
        for ends in (("1.42", 2), ("1.415", "1.416"), (3, 4), ("-1.41", "-1.3"), (1, "1.414"))
    ),
    (square_minus_two, twice, (-2, 2), Roots.UNDECIDED, UNKNOWN),
    (Interval.sqr, twice, ("-0.3", "0.5"), Roots.UNDECIDED, UNKNOWN),
    (Interval.sqr, twice, (0, 1), Roots.AT_LEAST_ONE, SIGNS),
    (Interval.sqr, twice, (-1, "-0.01"), Roots.NONE, DISJOINT),
    *(
        (f, derivative(f), ends, Roots.AT_LEAST_ONE, SIGNS)
        for f in (cube, lambda x: -cube(x))
        for ends in ((-1, 2), (-2, 1), (0, 1), (-1, 0), (0, 0))
    ),
    (lambda x: cube(x) - x, derivative(lambda x: cube(x) - x), (-2, 2), Roots.AT_LEAST_ONE, SIGNS),
    # the enclosure of f(0) is [-2^-40, 2^-40]: the sign at this end is open
    (lambda x: cube(x) + NOISE, derivative(cube), (0, 1), Roots.UNDECIDED, UNKNOWN),
    (lambda x: x.sqr() + 1, twice, (-1, 1), Roots.NONE, "f over the box excludes 0"),
]


@pytest.mark.parametrize(("f", "df", "ends", "outcome", "reason"), CASES)
def test_outcomes(f, df, ends, outcome, reason):
    box = Interval(*ends)
    result = newton(f, df, box)
    assert result[:2] == (outcome, None if outcome is Roots.NONE else box)
    assert reason in result.reason


def test_an_image_that_overlaps_the_box_proves_nothing():
    """After one step from [1.42, 2] the image [1.38, 1.48] overlaps the box, without a zero."""
    result = newton(square_minus_two, twice, Interval("1.42", 2), steps=1)
    assert result.outcome is Roots.UNDECIDED
    assert result.box.inf == Interval("1.42").inf and result.box.sup < Fraction("1.49")


def test_a_zero_at_the_end_of_the_box():
    for ends in ((0, 1), (-1, 0), (0, 0)):
        for slope in (1, 3):
            box, constant = Interval(*ends), Interval(slope)
            result = newton(constant.__mul__, lambda x, constant=constant: constant, box)
            assert (result.outcome, result.box) == (Roots.UNIQUE, Interval(0))
    low, high = sqrt_down(TWO, 53), sqrt_up(TWO, 53)
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


# -- polynomials with known rational zeros ---------------------------------------------------------


def product(a, b):
    """The coefficients of the product of two polynomials, lowest first."""
    result = [Fraction(0)] * (len(a) + len(b) - 1)
    for i, x in enumerate(a):
        for j, y in enumerate(b):
            result[i + j] += x * y
    return result


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
    precision = draw(st.sampled_from([8, 24, 53, 120]))
    return coefficients, set(roots), Interval(low, high, precision=precision)


def check_newton(coefficients, roots, box):
    slopes = [k * c for k, c in enumerate(coefficients)][1:] or [Fraction(0)]
    result = newton(partial(horner, coefficients), partial(horner, slopes), box)
    assert result.reason
    assert (result.box is None) == (result.outcome is Roots.NONE)
    check_claim(result.outcome, [box], [result.box], {(root,) for root in roots})
    return result


@for_all(problems(), tries=60, at_length=250)
@example(([-ONE, 0 * ONE, ONE], {ONE, -ONE}, Interval(-1, 1)))
@example(([ONE, -TWO, ONE], {ONE}, Interval(1, 2)))
@example(([-TWO, ONE], {TWO}, Interval(1, 2)))
def test_what_is_claimed_of_a_polynomial_is_true(problem):
    check_newton(*problem)


@for_all(
    st.lists(st.integers(-20, 20), min_size=1, max_size=4, unique=True),
    st.fractions(Fraction(1, 10), 1, max_denominator=100),
    st.fractions(Fraction(1, 10), 1, max_denominator=100),
)
def test_an_isolated_simple_zero_is_found(roots, left, right):
    coefficients = reduce(product, ([Fraction(-r), Fraction(1)] for r in roots))
    centre, reach = roots[0], Fraction(1, 2 * 25 * len(roots) * 20 ** len(roots))
    box = Interval(centre - left * reach, centre + right * reach, precision=120)
    assert check_newton(coefficients, roots, box).outcome is Roots.UNIQUE
