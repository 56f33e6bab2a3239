"""Text in and out: decimals that enclose, texts that are read back, what notebooks show."""

import copy
import pickle
import re
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from intervals import Interval, IntervalArray
from tests.intervals.boxes import boxes, precisions


def ends_in(text):
    low, high = re.fullmatch(r"\[(-?[0-9.]+), (-?[0-9.]+)\]", text).groups()
    return Fraction(low), Fraction(high)


@given(st.data(), precisions, st.integers(1, 60))
def test_printed_decimals_enclose_and_are_read_back(data, precision, digits):
    low, high = data.draw(boxes(precision, ("grid", "power", "near one")))
    x = Interval(low, high, precision=precision)
    for text in (str(x), f"{x}", f"{x:{digits}}"):
        below, above = ends_in(text)
        assert below <= low and high <= above
        assert Interval(text, precision=precision + 300).contains(x)
    below, above = ends_in(f"{x:{digits}}")
    assert low - below <= abs(low) / 10 ** (digits - 1)


@pytest.mark.parametrize(
    "text", ["[1", "1]", "[1, 2, 3]", "[]", "[1,", "[a, b]", "[2, 1]", "[nan]", "[0.5f]"]
)
def test_texts_that_are_no_intervals(text):
    with pytest.raises(ValueError, match=r"interval|number"):
        Interval(text)


@pytest.mark.parametrize("digits", ["x", "-3", ".5", "3f"])
def test_formats_that_are_no_digits(digits):
    with pytest.raises(ValueError, match="digits"):
        format(Interval(1), digits)


def test_texts_that_are_intervals():
    assert Interval("[1, 2]") == Interval(" [ 1 ,2 ] ") == Interval(1, 2)
    assert Interval("[7/5]") == Interval("7/5")
    assert Interval("[-1e-3, 2]").inf <= Fraction(-1, 1000)


@given(st.data(), precisions)
def test_copies_are_equal_and_keep_the_precision(data, precision):
    x = Interval(*data.draw(boxes(precision)), precision=precision)
    names = {"Interval": Interval, "Fraction": Fraction}
    for again in (
        eval(repr(x), names),
        pickle.loads(pickle.dumps(x)),
        copy.copy(x),
        copy.deepcopy(x),
    ):
        assert again == x and hash(again) == hash(x) and again.precision == x.precision


def test_what_notebooks_show():
    latex = Interval("1.1", "1.2", precision=20)._repr_latex_()
    below, above = re.fullmatch(r"\$\\left\[([0-9.]+),\\ ([0-9.]+)\\right\]\$", latex).groups()
    assert Fraction(below) <= Fraction("1.1") and Fraction("1.2") <= Fraction(above)
    page = IntervalArray([["1/3", (-1, 2)]] * 30)._repr_html_()
    assert page.startswith("<table>") and page.endswith("</table>")
    assert page.count("<tr>") == 1 + 20 + 1  # titles, elements, the rest
    assert "and 40 more" in page and "(30, 2)" in page
    low, high = re.search(r"<th>\(0, 0\)</th><td>([0-9.]+)</td><td>([0-9.]+)</td>", page).groups()
    assert Fraction(low) < Fraction(1, 3) < Fraction(high)


def test_large_arrays_are_summarised():
    x = IntervalArray([1] * 2000)
    assert repr(x) == "<IntervalArray of shape (2000,)>"
    assert len(str(x)) < 2000
