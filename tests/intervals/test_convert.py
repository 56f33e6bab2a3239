"""Numbers of other libraries against their own exact values."""

from decimal import Decimal
from fractions import Fraction

import flint
import mpmath
import pytest
from hypothesis import strategies as st

from intervals import Interval, convert
from tests.intervals import oracle
from tests.intervals.boxes import for_all

mantissas, exponents = st.integers(-(2**200), 2**200), st.integers(-300, 300)


@for_all(mantissas, exponents, st.integers(0, 2**40), st.sampled_from([None, 20, 53, 400]))
def test_binary_numbers_enter_exactly_and_leave_enclosed(mantissa, exponent, width, precision):
    low, high = (Fraction(m) * Fraction(2) ** exponent for m in (mantissa, mantissa + width))
    ball = flint.arb((mantissa, exponent), (width, exponent))
    around = oracle.ends(ball)  # the ball's radius is rounded up to 30 bits
    with mpmath.workprec(500):
        point = mpmath.mpf(mantissa) * mpmath.mpf(2) ** exponent
    for x, (bottom, top) in (
        (convert.interval(point, precision=precision), (low, low)),
        (convert.interval(ball, precision=precision), around),
        (
            convert.unproved_mpi(
                convert.mpi(Interval(low, high, precision=500)), precision=precision
            ),
            (low, high),
        ),
    ):
        assert x.inf <= bottom and top <= x.sup
        assert x == Interval(bottom, top, precision=x.precision)
        assert x.precision == (precision or max(53, x.precision))
    if precision is None:
        assert convert.interval(point).is_singleton()
    x = Interval(low, high, precision=300)
    bottom, top = oracle.ends(convert.arb(x))
    assert bottom <= low and high <= top and (width or bottom == top)
    assert top - bottom <= (high - low) * (1 + Fraction(1, 2**20))


@for_all(st.decimals(-(10**9), 10**9, allow_nan=False, allow_infinity=False), st.integers(1, 40))
def test_decimals_are_what_they_say(value, digits):
    x = convert.interval(value)
    assert x == Interval(Fraction(value))
    low, high = convert.decimals(x, digits)
    unit = Decimal(10) ** (max(abs(low), abs(high)).adjusted() + 1 - digits) if high else 0
    assert Fraction(low) <= x.inf and x.sup <= Fraction(high)
    assert Fraction(low) + Fraction(unit) > x.inf or not x.inf
    assert Fraction(high) - Fraction(unit) < x.sup or not x.sup


def test_what_is_no_bounded_number():
    for value in (
        Decimal("nan"),
        Decimal("-Infinity"),
        Decimal("1e1000000"),
        mpmath.mpf("inf"),
        mpmath.mpf("nan"),
        flint.arb("nan"),
        1 / flint.arb(0, 1),
    ):
        with pytest.raises(ValueError):
            convert.interval(value)
    with pytest.raises(ValueError):
        convert.unproved_mpi(mpmath.iv.mpf([1, "inf"]))
    for value in (0.5, 1, Fraction(1, 2), "0.5", Interval(1), None, mpmath.mpc(1, 2), flint.acb(1)):
        with pytest.raises(TypeError):
            convert.interval(value)


@pytest.mark.parametrize("name", ["pi", "e", "ln2", "euler"])
def test_a_constant_of_mpmath_is_not_the_float_near_it(name):
    with pytest.raises(TypeError, match="stands for"):
        convert.interval(getattr(mpmath.mp, name))
    near = convert.interval(+getattr(mpmath.mp, name))
    assert near.inf == near.sup


def test_pi_of_mpmath_s_intervals_holds_pi():
    assert Interval.pi(precision=200).subset(convert.unproved_mpi(mpmath.iv.pi))
