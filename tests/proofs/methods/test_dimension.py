"""Dimensions of sets with known ones: linear Cantor sets, continued fractions with digits 1, 2."""

from fractions import Fraction

import pytest
from mpmath import findroot, mp, mpf

from intervals import DomainError, Interval, Jet, Undecided
from proofs.methods.dimension import Trial, candidate, dimension, operator_excess

# Hensley 1996; Jenkinson, Pollicott 2001; Pollicott, Vytnova 2022
E2 = Fraction("0.53128050627720514162446864736847178549305910901839")
E2_HULL = (Fraction("0.36"), Fraction("0.74"))
UNIT = (Fraction(0), Fraction(1))


def e2(x):
    return [1 / (1 + x), 1 / (2 + x)]


def lines(*pairs):
    """The maps x -> r x + t."""
    return lambda x: [r * x + t for r, t in pairs]


def moran(ratios, digits=40):
    with mp.workdps(digits):
        root = findroot(
            lambda s: sum(mpf(r.numerator) ** s / mpf(r.denominator) ** s for r in ratios) - 1, 0.5
        )
        return Fraction(mp.nstr(root, digits))


@pytest.mark.slow
@pytest.mark.parametrize("digits", [3, 10, pytest.param(20, marks=pytest.mark.slow)])
def test_continued_fractions(digits):
    found = dimension(e2, E2_HULL, digits)
    low, high = found.bounds
    assert low < E2 < high < low + Fraction(3, 10 ** (digits + 1))
    # 1 / |g'| is (1 + x)^2 and (2 + x)^2
    for (least, most), shift in zip(found.slopes, (1, 2), strict=True):
        assert least <= (E2_HULL[0] + shift) ** 2 and (E2_HULL[1] + shift) ** 2 <= most


@pytest.mark.parametrize(
    "maps",
    [
        [(Fraction(1, 3), 0), (Fraction(1, 3), Fraction(2, 3))],
        [(Fraction("0.1905"), 0), (Fraction("0.2381"), Fraction("0.7"))],
        [
            (Fraction(-1, 5), Fraction(1, 4)),
            (Fraction(1, 3), Fraction(1, 2)),
            (Fraction(1, 9), Fraction(8, 9)),
        ],
    ],
)
def test_linear_sets_by_moran(maps):
    low, high = dimension(lines(*maps), UNIT, 12).bounds
    assert low < moran([abs(r) for r, _ in maps]) < high


@pytest.mark.slow
def test_a_wrong_exponent_is_seen():
    """L_s h / h is at least exp(-shift log|g'|) from 1 when s is shifted."""
    found = candidate(e2, E2_HULL, 8)
    right, slopes = operator_excess(e2, found, 2, 16, 80)
    assert right < Fraction(1, 10**9)
    for shift in (Fraction(1, 10**4), Fraction(-1, 10**4)):
        moved = Trial(found.hull, found.s + shift, found.coefficients)
        wrong, _ = operator_excess(e2, moved, 2, 16, 80)
        assert wrong > abs(shift) * Interval(slopes[0][0]).log().inf / 2


@pytest.mark.parametrize("order", [1, 3])
def test_the_remainder_counts(order):
    """With too few terms the bound is large; it is never smaller than what more terms show."""
    found = candidate(e2, E2_HULL, 8)
    rough, _ = operator_excess(e2, found, 2, order, 100)
    assert rough > Fraction(1, 10**6)


def test_a_function_with_a_zero_is_refused():
    signed = Trial(E2_HULL, Fraction("0.53"), (Fraction(0), Fraction(1)))
    with pytest.raises(Undecided, match="not proved positive"):
        operator_excess(e2, signed, 4, 8, 64)


@pytest.mark.slow
def test_without_contraction_nothing_is_said():
    """On [0, 1] the derivative of 1 / (1 + x) is -1 at 0."""
    with pytest.raises(Undecided, match="contract"):
        dimension(e2, UNIT, 2)


def test_a_pole_is_no_dimension():
    with pytest.raises((Undecided, DomainError, ZeroDivisionError)):
        dimension(lambda x: [1 / (2 * x - 1), 1 / (3 + x)], UNIT, 4)


def test_the_trial_function_is_its_polynomial():
    coefficients = tuple(Fraction(k * k - 7, k + 2) for k in range(23))
    trial = Trial((Fraction(2), Fraction(5)), Fraction(1, 2), coefficients)
    x = Fraction(31, 10)
    u = (x - Fraction(7, 2)) / Fraction(3, 2)
    value, slope = trial.h(Jet.variable(Interval(x, precision=200), 1)).coefficients
    assert value.contains(sum(c * u**k for k, c in enumerate(coefficients)))
    exact = sum(k * c * u ** (k - 1) for k, c in enumerate(coefficients) if k) / Fraction(3, 2)
    assert slope.contains(exact) and slope.wid < Fraction(1, 2**150)
