"""Text in and out, and numbers of other libraries: decimals that enclose, exact values."""

import copy
import json
import pickle
import re
from decimal import Decimal
from fractions import Fraction

import flint
import mpmath
import numpy as np
import pytest
from hypothesis import strategies as st

from intervals import Interval, IntervalArray, convert
from tests.intervals import oracle
from tests.intervals.boxes import boxes, for_all, precisions

NAMES = {"Interval": Interval, "IntervalArray": IntervalArray, "Fraction": Fraction}


def copies(x):
    """What text, pickle and copy make of it."""
    yield eval(repr(x), NAMES)
    yield from (pickle.loads(pickle.dumps(x, protocol)) for protocol in (2, 5))
    yield from (copy.copy(x), copy.deepcopy(x))


def ends_in(text):
    low, high = re.fullmatch(
        r"\[(-?[0-9.]+(?:e-?[0-9]+)?), (-?[0-9.]+(?:e-?[0-9]+)?)\]", text
    ).groups()
    return Fraction(low), Fraction(high)


@for_all(st.data(), precisions, st.integers(1, 60))
def test_printed_decimals_enclose_and_are_read_back(data, precision, digits):
    low, high = data.draw(boxes(precision, ("grid", "power", "near one")))
    x = Interval(low, high, precision=precision)
    worth = max(3, precision * 3 // 10)
    for text, count in ((str(x), worth), (f"{x}", worth), (f"{x:{digits}}", digits)):
        printed = ends_in(text)
        assert printed[0] <= low and high <= printed[1]
        for decimal, exact in zip(printed, (low, high), strict=True):
            error = abs(decimal - exact)
            assert error == 0 or error < abs(exact) * Fraction(10) ** (1 - count)
        assert Interval(text, precision=precision + 300).contains(x)


def test_text():
    assert str(Interval("0.5", 2)) == "[0.500000000000000, 2.00000000000000]"
    assert str(Interval(-1, 0)) == "[-1.00000000000000, 0]"
    assert repr(Interval("0.5", 2)) == "Interval('1/2', '2', precision=53)"
    assert str(Interval("0.1", precision=10)) == "[0.0999, 0.101]"


@pytest.mark.parametrize(
    "text", ["[1", "1]", "[1, 2, 3]", "[]", "[1,", "[a, b]", "[2, 1]", "[nan]", "[0.5f]"]
)
def test_texts_that_are_no_intervals(text):
    with pytest.raises(ValueError, match=r"interval|number"):
        Interval(text)


@for_all(boxes(53, ("grid", "power", "near one")), st.integers(0, 30))
def test_formats_with_a_point_or_an_exponent_enclose(ends, digits):
    x = Interval(*ends)
    for kind, worth in (
        ("f", lambda _: Fraction(10) ** -digits),
        ("e", lambda e: abs(e) * Fraction(10) ** -digits),
        ("g", lambda e: abs(e) * Fraction(10) ** (1 - digits)),
    ):
        if kind == "g" and not digits:
            continue
        low, high = (Fraction(end) for end in f"{x:.{digits}{kind}}".strip("[]").split(", "))
        assert low <= x.inf and x.sup <= high
        assert x.inf - low < worth(x.inf) or low == x.inf
        assert high - x.sup < worth(x.sup) or high == x.sup


@pytest.mark.parametrize("digits", ["x", "-3", ".5", "3f", ".f", ".3d", "10.3f", ".0g"])
def test_formats_that_are_no_digits(digits):
    with pytest.raises(ValueError, match="digit"):
        format(Interval(1), digits)


def test_texts_that_are_intervals():
    assert Interval("[1, 2]") == Interval(" [ 1 ,2 ] ") == Interval(1, 2)
    assert Interval("[7/5]") == Interval("7/5")
    assert Interval("[-1e-3, 2]").inf <= Fraction(-1, 1000)


@for_all(st.lists(st.floats(-1.7e308, 1.7e308), min_size=1, max_size=20))
def test_printed_arrays_enclose_and_are_read_back(values):
    x = IntervalArray.from_floats(sorted(values)[:1] * len(values), sorted(values))
    for shown in (x, x.reshape(-1, 1), x[0]):
        printed = np.array(json.loads(str(shown), parse_float=Fraction, parse_int=Fraction))
        assert printed.shape == (*shown.shape, 2)
        assert (printed[..., 0] <= shown.inf).all() and (printed[..., 1] >= shown.sup).all()
        assert shown.subset(IntervalArray(str(shown))).all()


@pytest.mark.parametrize(
    "text", ["[1, 2", "[[1, 2], ...]", "[1, 2, 3]]", "[[1, 2], [3, NaN]]", "[[2, 1]]", "[[1], 2]"]
)
def test_texts_that_are_no_arrays(text):
    with pytest.raises(ValueError, match=r"interval|number"):
        IntervalArray(text)


@for_all(st.data(), precisions)
def test_copies_are_equal_and_keep_the_precision(data, precision):
    x = Interval(*data.draw(boxes(precision)), precision=precision)
    for again in copies(x):
        assert again == x and hash(again) == hash(x) and again.precision == x.precision
        assert (again * 3) == x * 3


@pytest.mark.parametrize(
    "x",
    [Interval(3, precision=20) ** 9999, Interval(Fraction(-1, 3**9999)), Interval(1) / 2**20000],
)
def test_very_large_and_small_numbers(x):
    assert all(again == x for again in copies(x))
    assert re.fullmatch(r"\[-?\d\.\d+e-?\d+, -?\d\.\d+e-?\d+\]", str(x)) and len(str(x)) < 60


X = IntervalArray([[("1/3", "1/2"), (1, 2)], [(2, 2), (-7, 8)]])


@pytest.mark.parametrize("x", [X, X[0, 0], X[:, ::-1], IntervalArray([]), X[:, :0]])
def test_copies_of_arrays_are_exact(x):
    for again in copies(x):
        assert again.shape == x.shape and (again == x).all()


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
    x = IntervalArray.from_floats(np.ones(2000))
    assert repr(x) == "<IntervalArray of shape (2000,)>"
    assert len(str(x)) < 2000


# -- numbers of other libraries against their own exact values -------------------------------------


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
