"""What users of other libraries asked for, in threads that were open: each has its test here.

The table is in intervals/CONFORMANCE.md; the names of the tests are in its last column.
"""

import re
from concurrent.futures import ThreadPoolExecutor
from fractions import Fraction
from pathlib import Path

import mpmath
import numpy as np
import pytest

import intervals
from intervals import ComplexInterval, Decorated, DomainError, Interval, IntervalArray, linalg
from intervals.decorations import COM, TRV
from intervals.functions import DOMAINS
from intervals.unions import quotients
from tests.intervals.test_numpy import same

PAGE = (Path(intervals.__file__).parent / "CONFORMANCE.md").read_text(encoding="utf-8")


def truth(name, x, digits=120):
    """The binary value of a function of mpmath's, far more exact than what is tested."""
    with mpmath.workdps(digits):
        value = getattr(mpmath, name)(mpmath.mpf(x.numerator) / x.denominator)
        return Fraction(int(mpmath.floor(value * 2**300)), 2**300)


EXPONENTIALS = ((3893924827815215, 2**50, 53), (1381846513289487, 2**46, 113))


@pytest.mark.parametrize("top, bottom, bits", EXPONENTIALS)
def test_exponentials_just_above_a_number(top, bottom, bits):
    x = Fraction(top, bottom)
    assert Interval(x, precision=bits).exp().contains(truth("exp", x))


FUNCTIONS = "asin acos atan sinh cosh tanh asinh atanh cbrt expm1 log1p"


@pytest.mark.parametrize("name", FUNCTIONS.split())
def test_functions_that_were_missing(name):
    x = Fraction(3, 8)
    value = getattr(Interval(x, precision=200), name)()
    assert value.wid < Fraction(1, 2**190) and value.contains(truth(name, x))


def test_division_into_a_union():
    assert len(quotients(Interval(1), Interval(-1, 1), Interval(-100, 100))) == 2


def test_eigenvalues_of_a_matrix_of_intervals():
    found = linalg.eigenvalues(IntervalArray([[1, 2], [3, 4]]))
    assert pytest.approx([x.real.mid for x in found]) == [(5 - 33**0.5) / 2, (5 + 33**0.5) / 2]
    for value in found:  # of lambda^2 - 5 lambda - 2
        assert (value.real.sqr() - 5 * value.real - 2).contains(0) and value.multiplicity == 1


def test_precision_without_a_global():
    with ThreadPoolExecutor(4) as pool:
        roots = list(pool.map(lambda bits: Interval(2, precision=bits).sqrt(), range(20, 420)))
    for bits, root in zip(range(20, 420), roots, strict=True):
        assert root.sqr().contains(2) and root.wid <= Fraction(4, 2**bits)


def test_products_entry_by_entry():
    x, y = IntervalArray([[(1, 2), 3]]), IntervalArray([[-1, (0, 5)]])
    assert (x * y).contains(IntervalArray([[(-2, -1), (0, 15)]])).all()


def test_integer_powers_across_zero():
    ball = Interval(-1, 1)
    assert (ball**1, ball**2, ball**3) == (ball, Interval(0, 1), ball)


def test_matrices_of_numpy():
    matrix = np.array([[0.1, 2.0], [3.0, 4.5]])
    assert np.array_equal(IntervalArray.from_floats(matrix).sup, matrix)


def test_text_shows_that_an_interval_is_wide():
    x = Interval.from_float(0.1).sin()
    low, high = map(Fraction, re.findall(r"[\d.]+", f"{x:6}"))
    assert low < high and low <= x.inf and x.sup <= high


def test_products_and_inverses_of_matrices():
    a = IntervalArray([[(2, 4), (-2, 1)], [(-1, 2), (2, 4)]])
    square = IntervalArray([[(0, 18), (-16, 8)], [(-8, 16), (0, 18)]])
    assert (a @ a).contains(square).all() and (a @ a).wid.max() < 24.0001
    b = IntervalArray([[4, (1, 2)], [0, 2]])
    assert (b @ linalg.inverse(b)).contains(IntervalArray([[1, 0], [0, 1]])).all()


def test_decimals_are_enclosed():
    tenth = IntervalArray("0.1")
    assert tenth.contains(Fraction(1, 10)) and tenth.sup == np.nextafter(tenth.inf, 1)


def test_sums_of_products_by_subscripts():
    x = IntervalArray([[(1, 2), 3], [4, (-1, 5)]])
    assert same(np.einsum("ij->ji", x), x.T) and same(np.einsum("ii->i", x), np.diagonal(x))
    assert np.einsum("ij,jk->ik", x, x).contains(x @ x).all()


def test_the_power_zero():
    assert Interval(0) ** 0 == Interval(-1, 1) ** 0 == Interval(1)


def test_division_of_complex_boxes():
    """Around 3 + 4i: the least box, where the formula by the conjugate has twice the width."""
    w = ComplexInterval(Interval(2, 4), Interval(3, 5))
    corners = [Fraction(x, x * x + y * y) for x in (2, 4) for y in (3, 5)]
    found = (1 / w).real
    assert (found.inf, found.sup) == (Interval(min(corners)).inf, Interval(Fraction(1, 6)).sup)
    plain = w.real / (w.real.sqr() + w.imag.sqr())
    assert plain.wid > 2 * found.wid


def test_complex_boxes_as_sets():
    outer = ComplexInterval(Interval(1, 2), Interval(3, 4))
    inner = ComplexInterval("1.5", Interval("3.25", "3.5"))
    assert inner.interior(outer) and inner.subset(outer) and not outer.interior(outer)
    assert outer.mid == (Fraction(3, 2), Fraction(7, 2))
    size = abs(outer)
    assert size.sqr().contains(10) and size.sqr().contains(20) and not size.contains("4.4722")


def test_roots_across_the_cut():
    point = Fraction(-242, 100)
    with pytest.raises(DomainError, match="cut"):
        ComplexInterval(Interval(point), Interval("-1e-30", "1e-30")).sqrt()
    root = ComplexInterval(Interval(point), Interval(0, "1e-30")).sqrt()
    assert root.wid < Fraction(1, 10**15) and root.imag.contains(Interval("2.42").sqrt())


def test_the_domain_of_a_function():
    assert DOMAINS["sqrt"][:2] == (0, None) and str(DOMAINS["log"]) == "(0, oo)"
    inside, partly = (Decorated(Interval(low, 4)).sqrt() for low in (1, -1))
    assert inside.decoration is COM and partly.decoration is TRV
    assert partly.interval == Interval(0, 2)


def test_each_row_names_a_test():
    rows = [line for line in PAGE.splitlines() if re.search(r"#\d+", line)]
    named = {name for row in rows for name in re.findall(r"`(test_\w+)`", row)}
    assert len(rows) >= 10 and all(re.search("`test_", row) for row in rows)
    assert named <= {name for name in globals() if name.startswith("test_")}
