"""Interval against exact rationals and Arb: tightness, monotone inclusion, refusals."""

import itertools
import math
import operator
from decimal import Decimal
from fractions import Fraction

import flint
import mpmath
import numpy as np
import pytest
from hypothesis import assume, example
from hypothesis import strategies as st

import intervals
from intervals import ComplexInterval, Decorated, DomainError, Interval, IntervalError, Undecided
from tests.intervals import oracle
from tests.intervals.boxes import MODERATE, boxes, for_all, inside, numbers, precisions
from tests.intervals.oracle import outward, range_of, round_down, sqrt_down, sqrt_up
from tests.intervals.test_array import BINARY

COMPARISONS = {"<": operator.lt, "<=": operator.le, ">": operator.gt, ">=": operator.ge}
FUNCTIONS = ("sin", "cos", "exp", "log")
ZERO, ONE = Fraction(0), Fraction(1)
INEXACT = [0.5, math.nan, np.float64(0.5), np.float32(0.5), "0.5", None, 1j]


def interval(ends, precision):
    return Interval(*ends, precision=precision)


def bounds(x):
    return x.inf, x.sup


def boxes_for(name, precision):
    """Boxes in the domain of a function, of sizes at which its values have a sensible length."""
    if name in ("log", "sqrt"):
        return boxes(precision, positive=True)
    if name == "exp":
        return boxes(precision, MODERATE, largest=600)
    return boxes(precision)


# -- construction and the set ----------------------------------------------------------------------


@for_all(st.fractions(), st.fractions(min_value=0), precisions)
@example(ZERO, ZERO, 2)
@example(Fraction(1, 3), ZERO, 2)
def test_the_constructor_is_the_tightest_enclosure(low, width, precision):
    x = Interval(low, low + width, precision=precision)
    assert bounds(x) == outward(low, low + width, precision)
    assert x.precision == precision
    assert Interval(low, precision=precision) == Interval(low, low, precision=precision)


@pytest.mark.parametrize("value", [0.2121, 1.0, math.nan, np.float32(0.5), None, 1j, [1]])
def test_inexact_inputs_are_type_errors(value):
    for operation in (Interval, Interval(1).contains, lambda v: Interval(0, v if v else 1j)):
        with pytest.raises(TypeError):
            operation(value)


def test_construction_errors():
    for ends in ((2, 1), ("0.3", Fraction(3, 10) - Fraction(1, 10**40))):
        with pytest.raises(ValueError, match="reversed"):
            Interval(*ends)
    makers = [
        lambda p: Interval(1, precision=p),
        lambda p: Interval.from_float(1.0, precision=p),
        lambda p: Interval.pi(precision=p),
        lambda p: Interval(1).with_precision(p),
    ]
    for make, precision in itertools.product(makers, (1, 0, -53)):
        with pytest.raises(ValueError, match="precision"):
            make(precision)


@for_all(st.floats(allow_nan=False, allow_infinity=False), precisions)
@example(5e-324, 53)
@example(math.nextafter(math.inf, 0), 2)
@example(np.float32(0.1), 53)
def test_from_float_takes_the_binary_number(value, precision):
    exact = Fraction(float(value))
    assert bounds(Interval.from_float(value, precision=precision)) == outward(
        exact, exact, precision
    )


@pytest.mark.parametrize(
    "value", [math.nan, math.inf, -math.inf, 2**53 + 1, Fraction(1, 3), np.float32("nan")]
)
def test_from_float_refuses_what_no_float_equals(value):
    with pytest.raises(ValueError, match="binary64"):
        Interval.from_float(value)


@for_all(st.data(), precisions, precisions)
def test_the_set(data, p, q):
    (a, b), (c, d) = data.draw(boxes(p)), data.draw(boxes(q))
    x, y = interval((a, b), p), interval((c, d), q)
    assert bounds(x) == (a, b)
    assert (x.mid, x.wid, x.mag) == ((a + b) / 2, b - a, max(abs(a), abs(b)))
    assert x.mig == (0 if a <= 0 <= b else min(abs(a), abs(b)))
    assert bounds(x.hull(y)) == (min(a, c), max(b, d))
    low, high = max(a, c), min(b, d)
    common = x.intersection(y)
    if low > high:
        assert common is None
    else:
        assert (*bounds(common), common.precision) == (low, high, max(p, q))
    assert bounds(x.with_precision(q)) == outward(a, b, q)
    assert (x.hull(y).precision, x.with_precision(q).precision) == (max(p, q), q)


def test_contains_takes_exact_numbers_as_texts():
    assert Interval(0, 1).contains("1") and Interval(0, 1).contains("7/8")
    assert not Interval(0, 1).contains("1.0000000000000000000000001")


# -- arithmetic ------------------------------------------------------------------------------------


@pytest.mark.parametrize("symbol", sorted(BINARY))
@for_all(st.data(), precisions, precisions, at_length=300)
def test_arithmetic_is_the_tightest_enclosure_of_the_range(symbol, data, p, q):
    first, second = data.draw(boxes(p)), data.draw(boxes(q))
    assume(symbol != "/" or not second[0] <= 0 <= second[1])
    values = [BINARY[symbol](x, y) for x in first for y in second]
    result = BINARY[symbol](interval(first, p), interval(second, q))
    assert result.precision == max(p, q)
    assert bounds(result) == outward(min(values), max(values), max(p, q))


@for_all(st.data(), precisions)
def test_unary_operations(data, p):
    a, b = data.draw(boxes(p))
    x = interval((a, b), p)
    low, high = (0 if a <= 0 <= b else min(abs(a), abs(b))), max(abs(a), abs(b))
    assert bounds(-x) == (-b, -a)
    assert +x == x
    assert bounds(abs(x)) == (low, high)
    assert bounds(x.sqr()) == outward(low**2, high**2, p)
    if a >= 0:
        assert bounds(x.sqrt()) == (sqrt_down(a, p), sqrt_up(b, p))
    for n in range(6):
        least, most = (low**n, high**n) if n % 2 == 0 else (a**n, b**n)
        assert bounds(x**n) == outward(least, most, p)
    assert (x**0).precision == p


@for_all(st.data(), precisions, st.integers(1, 5))
def test_negative_powers(data, p, n):
    a, b = data.draw(boxes(p))
    assume(not a <= 0 <= b)
    ends = [ONE / a**n, ONE / b**n]
    low, high = bounds(interval((a, b), p) ** -n)
    assert low <= min(ends) and max(ends) <= high
    if p > 3:
        assert min(ends) - low <= 4 * oracle.ulp(min(ends), p)
        assert high - max(ends) <= 4 * oracle.ulp(max(ends), p)


exact_numbers = st.integers(-(2**70), 2**70) | st.fractions()


@for_all(st.data(), precisions, exact_numbers, st.sampled_from(sorted(BINARY)))
def test_mixed_operands(data, p, value, symbol):
    """Ints enter exactly, Fractions as the tightest interval at the precision of the other."""
    first, op = data.draw(boxes(p)), BINARY[symbol]
    second = (value, value) if isinstance(value, int) else outward(value, value, p)
    x = interval(first, p)
    for left, right, result in (
        (first, second, lambda: op(x, value)),
        (second, first, lambda: op(value, x)),
    ):
        if symbol == "/" and right[0] <= 0 <= right[1]:
            continue
        values = [op(Fraction(a), b) for a in left for b in right]
        assert bounds(result()) == outward(min(values), max(values), p)
        assert result().precision == p


@pytest.mark.parametrize("op", [*BINARY.values(), *COMPARISONS.values()])
@pytest.mark.parametrize("value", INEXACT)
def test_other_operands_are_type_errors(op, value):
    x = Interval(1, 2)
    for left, right in ((x, value), (value, x)):
        with pytest.raises(TypeError):
            op(left, right)


@pytest.mark.parametrize("exponent", [0.5, "2", None])
def test_powers_of_no_number(exponent):
    with pytest.raises(TypeError):
        Interval(1, 2) ** exponent


def test_numpy_integers_are_exact_operands():
    assert bounds(Interval(1, 2) * np.int64(3)) == bounds(np.int64(3) * Interval(1, 2)) == (3, 6)


@pytest.mark.parametrize(
    "operation",
    [
        lambda: Interval(0) / 0,
        lambda: 1 / Interval(-1, 0),
        lambda: Interval(-1, 1) ** -1,
        lambda: Interval(-1).sqrt(),
        lambda: Interval(Fraction(-1, 10**300), 1).sqrt(),
        lambda: Interval(0, 1).log(),
    ],
)
def test_outside_the_domain(operation):
    with pytest.raises(DomainError):
        operation()


def test_domain_errors_and_undecided_have_one_root():
    assert issubclass(DomainError, IntervalError) and issubclass(Undecided, IntervalError)
    assert issubclass(IntervalError, ArithmeticError)


# -- elementary functions --------------------------------------------------------------------------


def check_range(name, ends, precision):
    x = interval(ends, precision)
    result = getattr(x, name)()
    assert result == getattr(intervals, name)(x) and result.precision == precision
    assert name not in ("sin", "cos") or x.sincos()[name == "cos"] == result
    assert bounds(result) == range_of(name, *ends, precision)


@for_all(st.data(), precisions, st.sampled_from(FUNCTIONS), tries=100, at_length=500)
def test_functions_are_the_tightest_enclosure_of_the_range(data, p, name):
    check_range(name, data.draw(boxes_for(name, p)), p)


@pytest.mark.parametrize("precision", [2, 53])
def test_sin_and_cos_at_every_pair_of_quadrants(precision):
    quarter = oracle.pi_bounds(100)[0] / 2
    marks = [round_down(n * quarter / 2, 20) for n in range(-12, 13)]
    for low, high in itertools.combinations(marks, 2):
        for name in ("sin", "cos"):
            check_range(name, outward(low, high, precision), precision)


@pytest.mark.parametrize(
    ("constant", "true"), [(intervals.pi, flint.arb.pi), (intervals.e, flint.arb.const_e)]
)
@for_all(precisions)
@example(1000)
@example(3333)
@example(13_000)
def test_constants_are_the_tightest(constant, true, p):
    x = constant(precision=p)
    assert (*bounds(x), x.precision) == (*outward(*oracle.evaluate(true, p + 50), p), p)


def test_extrema_are_exact():
    for box in (Interval(0, 100), Interval(-(10**300), 10**300)):
        assert bounds(box.sin()) == bounds(box.cos()) == (-1, 1)


@pytest.mark.parametrize("precision", [2, 53, 400])
def test_exp_sin_and_cos_where_the_series_would_need_a_million_bits(precision):
    tiny, step = Fraction(1, 2**1_000_000), Fraction(1, 2**precision)
    x = Interval(tiny, precision=precision)
    assert bounds(x.exp()) == (1, 1 + 2 * step)
    assert bounds((-x).exp()) == (1 - step, 1)
    assert bounds(x.cos()) == bounds((-x).cos()) == (1 - step, 1)
    assert bounds(x.sin()) == (tiny - tiny * step, tiny)
    assert bounds((-x).sin()) == (-tiny, -tiny + tiny * step)
    assert bounds(x.hull(-x).sin()) == (-tiny, tiny)


def test_exp_of_what_no_memory_holds():
    for x in (Interval(2**31), Interval(0, 2**31)):
        with pytest.raises(OverflowError):
            x.exp()


# -- comparisons -----------------------------------------------------------------------------------


def check_comparison(compare, x, y, ends_x, ends_y):
    """All pairs of numbers compare alike if and only if all pairs of ends do."""
    answers = {compare(a, b) for a in ends_x for b in ends_y}
    if len(answers) == 1:
        assert compare(x, y) is answers.pop()
    else:
        with pytest.raises(Undecided, match="overlap"):
            compare(x, y)


@for_all(st.data(), precisions, precisions, st.sampled_from(sorted(COMPARISONS)))
def test_comparisons(data, p, q, symbol):
    first, second = data.draw(boxes(p)), data.draw(boxes(q))
    compare, x = COMPARISONS[symbol], interval(first, p)
    check_comparison(compare, x, interval(second, q), first, second)
    value = data.draw(inside(*first) | st.fractions())
    check_comparison(compare, x, value, first, (value,))


def test_comparison_with_a_fraction_is_exact():
    assert 1 - Fraction(1, 2**100) < Interval(1) < 1 + Fraction(1, 2**100)


def test_undecided_names_both_sides_whatever_their_size():
    for value in (10**5000, Fraction(1, 10**5000)):
        with pytest.raises(Undecided, match="overlap"):
            operator.lt(Interval(0, 10**6000), value)


def test_an_interval_has_no_truth():
    with pytest.raises(TypeError):
        bool(Interval(1))


# -- equality, operands ----------------------------------------------------------------------------


def test_equality_is_that_of_sets():
    assert Interval(1, 2) == Interval(1, 2, precision=200)
    assert Interval(1, 2) != Interval(1, 3)
    assert Interval(0, 2) != Interval(1, 2)
    numbers = (1, Fraction(1), 1.0, "1", 1j, Decimal(1), np.int64(1), mpmath.mpf(1))
    sets = Interval(1), ComplexInterval(1), Decorated(1)
    for one in sets:
        assert one != None  # noqa: E711
        for value in (*numbers, mpmath.iv.mpf(1), flint.arb(1), flint.acb(1), flint.fmpq(1), *sets):
            if type(value) is not type(one):
                with pytest.raises(TypeError, match="no number"):
                    _ = one == value
                with pytest.raises(TypeError, match="no number"):
                    _ = one != value
    assert hash(Interval(1, 2)) == hash(Interval(1, 2, precision=200))
    assert len({Interval(1, 2), Interval(2, 4) / 2, Interval(-2, -1) * -1, Interval(1)}) == 2


@for_all(st.data(), precisions)
def test_the_ends_have_the_precision_of_the_interval(data, p):
    x, zero, one = (Interval(v, precision=p) for v in (data.draw(numbers(p)), 0, 1))
    for y in (x + 2**500, zero - 3**300, one * 3**300):
        assert bounds(y) == outward(*bounds(y), p)


def test_exact_numbers_as_operands_of_every_operation():
    x = Interval(1, 3)
    assert x.fma(2, Fraction(1, 2)) == Interval("2.5", "6.5")
    assert (x.hull(7), x.hull(0)) == (Interval(1, 7), Interval(0, 3))
    assert (x.intersection(2), x.intersection(4)) == (Interval(2), None)
    assert (x.cancel_minus(1), x.cancel_plus(1)) == (Interval(0, 2), Interval(2, 4))
    for operation in (x.hull, x.intersection, x.cancel_minus, x.cancel_plus, x.minimum):
        with pytest.raises(TypeError, match="exact number"):
            operation("2")


def test_results_have_no_more_bits_than_their_precision():
    wide = 2**60 + 1
    for result in (
        *(Interval(0, 2**61).minimum(wide), Interval(0).maximum(wide)),
        *(Interval(0).hull(wide), Interval(0, 2**61).intersection(wide)),
    ):
        assert result.contains(wide) and result.subset(Interval(0, 2**61))
        for end in map(int, (result.inf, result.sup)):
            assert end == 0 or (end // (end & -end)).bit_length() <= 53
