"""Exact numbers in, outward decimals out, against the standard library's decimal arithmetic."""

import time
from decimal import ROUND_CEILING, ROUND_FLOOR, Context, Decimal
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import example
from hypothesis import strategies as st

from intervals.exact import decimal_bounds, decimal_down, decimal_up, fraction
from tests.intervals.boxes import for_all

digit_counts = st.integers(1, 40)


@st.composite
def values(draw):
    """A rational that is no zero: any, near a power of ten, short decimals, tiny, huge."""
    kind = draw(st.sampled_from(["any", "power", "short", "scaled"]))
    if kind == "any":
        x = draw(st.fractions().filter(bool))
    elif kind == "power":
        gap = draw(st.sampled_from([0, 1, -1])) * Fraction(1, 10 ** draw(st.integers(1, 45)))
        x = Fraction(10) ** draw(st.integers(-30, 30)) * (1 + gap)
    elif kind == "short":
        x = draw(st.integers(1, 10**6)) * Fraction(10) ** draw(st.integers(-30, 30))
    else:
        power = draw(st.integers(-2000, 2000))
        x = draw(st.fractions(min_value=1, max_value=2)) * Fraction(2) ** power
    return x or Fraction(1), draw(st.sampled_from([-1, 1]))


def nearest(x, digits, rounding):
    """The decimal of `digits` digits next to x, by division in the decimal module."""
    context = Context(prec=digits, rounding=rounding, Emin=-9999, Emax=9999)
    return Fraction(context.divide(Decimal(x.numerator), Decimal(x.denominator)))


def check_decimals(x, digits):
    for written_by, rounding in ((decimal_down, ROUND_FLOOR), (decimal_up, ROUND_CEILING)):
        text = written_by(x, digits)
        assert Fraction(text) == nearest(x, digits, rounding)
        assert set(text) <= set("-.0123456789e")
        assert len(text) <= 2 * digits + 66
        text = text.partition("e")[0]
        written = text.lstrip("-0.").replace(".", "")
        assert written[digits:].strip("0") == ""
        assert len(written) == digits or (len(written) > digits and "." not in text)
        assert not text.endswith(".") and text.lstrip("-")[0].isdigit()


@for_all(values(), digit_counts, tries=100)
def test_decimals_are_the_nearest_on_their_side(value, digits):
    x, sign = value
    check_decimals(sign * x, digits)


@pytest.mark.parametrize("power", range(-25, 26))
def test_powers_of_ten_are_exact(power):
    for digits in (1, 2, 17):
        for x in (Fraction(10) ** power, -(Fraction(10) ** power)):
            assert Fraction(decimal_down(x, digits)) == Fraction(decimal_up(x, digits)) == x
            check_decimals(x, digits)


@pytest.mark.parametrize(
    "x", [Fraction(1, 2**20_000), Fraction(3**20_000), Fraction(1, 7) + 10**5000]
)
def test_decimals_of_numbers_longer_than_python_prints(x):
    for value, digits in ((x, 5), (-x, 5), (x, 6000), (-x, 6000)):
        down, up = decimal_down(value, digits), decimal_up(value, digits)
        assert Fraction(Decimal(down)) == nearest(value, digits, ROUND_FLOOR)
        assert Fraction(Decimal(up)) == nearest(value, digits, ROUND_CEILING)
    lower, upper = decimal_bounds(-x, x, 5)
    assert Fraction(Decimal(lower)) <= -x < x <= Fraction(Decimal(upper))


@pytest.mark.parametrize("digits", [0, -1])
def test_a_decimal_has_digits(digits):
    for function in (decimal_down, decimal_up):
        with pytest.raises(ValueError, match="digit"):
            function(Fraction(1, 3), digits)


@for_all(values(), values(), digit_counts)
def test_decimal_bounds_enclose_and_are_tight(first, second, digits):
    low, high = sorted(sign * x for x, sign in (first, second))
    lower, upper = map(Fraction, decimal_bounds(low, high, digits))
    assert lower <= low <= high <= upper
    assert (upper - lower) - (high - low) <= max(abs(low), abs(high)) / Fraction(10) ** digits


def test_decimal_bounds_of_zero_and_of_exact_decimals():
    eighth = Fraction(-1, 8)
    assert decimal_bounds(Fraction(0), Fraction(0), 5) == ("0", "0")
    assert tuple(map(Fraction, decimal_bounds(eighth, Fraction(0), 3))) == (eighth, 0)


def test_decimal_bounds_reads_back_what_it_printed(monkeypatch):
    for name, wrong in (("decimal_down", "0.34"), ("decimal_up", "0.33")):
        with monkeypatch.context() as patch:
            patch.setattr(f"intervals.exact.{name}", lambda value, digits, wrong=wrong: wrong)
            with pytest.raises(ArithmeticError, match="enclose"):
                decimal_bounds(Fraction(1, 3), Fraction(1, 3), 5)


# -- fraction --------------------------------------------------------------------------------------


@for_all(st.integers(-(10**30), 10**30), st.integers(0, 40), st.integers(-400, 400))
def test_decimal_strings_are_rationals(integer, places, exponent):
    sign, figures = "-" if integer < 0 else "", str(abs(integer)).rjust(places + 1, "0")
    text = f"{sign}{figures[: len(figures) - places]}.{figures[len(figures) - places :]}e{exponent}"
    assert fraction(text) == integer * Fraction(10) ** (exponent - places)
    assert fraction(text.upper()) == fraction(f"  {text}\n") == fraction(text)


def test_accepted_forms():
    assert fraction("+.5") == Fraction(1, 2)
    assert fraction("-2e-3") == Fraction(-1, 500)
    assert fraction("7/5") == Fraction(7, 5)
    assert fraction("1_000") == fraction(1000) == 1000
    assert fraction(True) == 1
    assert fraction("1e4000") == 10**4000
    assert fraction("1E-4000") == Fraction(1, 10**4000)


def test_integers_of_numpy_do_not_wrap():
    x = fraction(np.int64(2**62))
    assert x * 4 == 2**64
    assert type(x.numerator) is type(x.denominator) is int


@pytest.mark.parametrize(
    "value",
    [0.5, 1e300, float("nan"), np.float64(1), np.float32(1), None, 1j, b"1", [1]],
)
def test_other_types_are_refused(value):
    with pytest.raises(TypeError, match="from_float" if isinstance(value, float) else "Fraction"):
        fraction(value)


def test_the_refusal_of_a_float_says_what_to_write():
    for value, meant in (
        (2.5, r"Fraction\(5, 2\)"),
        (3.0, "write 3,"),
        (0.1, r"Fraction\('0.1'\)"),
    ):
        with pytest.raises(TypeError, match=meant):
            fraction(value)
    with pytest.raises(TypeError, match="no number"):
        fraction(float("inf"))


NO_NUMBERS = "| |x|nan|inf|-Infinity|1/0|1//2|1/2/3|1.5/2|0x1|1e|e5|1e5e5|--1|1e½|²"
UNREASONABLE = [
    *("1e4001", "1e-4001", "1E+99999999999", " 1e99999999999 ", "1e9_999_999_999"),
    *("1e00000000009999999999", "1e٩٩٩٩٩٩٩٩٩٩", "0" * 5000, "1/" + "9" * 5000, "1e" + "9" * 3000),
]


@pytest.mark.parametrize("text", NO_NUMBERS.split("|"))
def test_what_is_no_number_is_refused(text):
    with pytest.raises(ValueError, match="not a number"):
        fraction(text)


@pytest.mark.parametrize("text", UNREASONABLE)
def test_unreasonable_sizes_are_refused_at_once(text):
    start = time.perf_counter()
    with pytest.raises(ValueError, match="unreasonable"):
        fraction(text)
    assert time.perf_counter() - start < 0.1


@for_all(st.text(alphabet="0123456789+-./eE_ x", max_size=12))
@example("1e+_5")
def test_any_text_is_a_number_or_a_value_error(text):
    try:
        value = fraction(text)
    except ValueError:
        return
    assert value == Fraction(text)
