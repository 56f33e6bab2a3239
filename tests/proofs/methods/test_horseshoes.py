"""Full horseshoes of the line: the logistic map above 4, and what is not proved to be one."""

from fractions import Fraction
from itertools import pairwise
from math import gcd

import pytest
from mpmath import mp, mpf

from intervals import DomainError, Undecided, sin
from proofs.methods.horseshoes import full_horseshoe
from proofs.methods.orbits import periodic_points
from proofs.methods.words import Words

DOMAINS = {
    Fraction(5): [("0", "0.2764"), ("0.7236", "1")],
    Fraction(9, 2): [("0", "0.33334"), ("0.66666", "1")],
}


def logistic(mu):
    return full_horseshoe(lambda x: mu * x * (1 - x), DOMAINS[mu])


@pytest.mark.parametrize("mu", DOMAINS)
def test_fixed_points_and_the_cycle_of_period_two(mu):
    """0 and 1 - 1/mu, multipliers mu and 2 - mu; x + x' = 1 + 1/mu, x x' = (1 + 1/mu)/mu."""
    of = logistic(mu)
    zero, one = periodic_points(of, Words.of_length(1), 30)
    assert zero.point[0] <= 0 <= zero.point[1] and one.point[0] <= 1 - 1 / mu <= one.point[1]
    assert zero.multiplier[0] <= mu <= zero.multiplier[1]
    assert one.multiplier[0] <= 2 - mu <= one.multiplier[1]
    _, low, high, _ = periodic_points(of, Words.of_length(2), 30)
    total, product = 1 + 1 / mu, (1 + 1 / mu) / mu
    assert low.point[0] + high.point[0] <= total <= low.point[1] + high.point[1]
    assert low.point[0] * high.point[0] <= product <= low.point[1] * high.point[1]
    multiplier = mu**2 * (1 - 2 * total + 4 * product)
    assert low.multiplier[0] <= multiplier <= low.multiplier[1]
    assert multiplier == 4 + 2 * mu - mu**2


@pytest.mark.parametrize("mu", DOMAINS)
def test_all_points_up_to_period_ten(mu):
    """2^n points, as far apart as their words; and the polynomial f^n(x) - x changes sign there."""
    of = logistic(mu)
    for length in (1, 2, 3, 5, 8, 10):
        words = Words.of_length(length)
        found = periodic_points(of, words)
        assert len(found) == 2**length
        necklaces = sum(2 ** gcd(i, length) for i in range(length)) // length
        assert len(words.cycles) == necklaces
        ends = sorted(row.point for row in found)
        assert all(a[1] < b[0] for a, b in pairwise(ends))
        for row in found[:: 1 + 4 * length]:
            assert returns(mu, row.point[0], length) * returns(mu, row.point[1], length) <= 0


def returns(mu, x, length):
    """f^n(x) - x with 60 digits."""
    with mp.workdps(60):
        start = value = mpf(x.numerator) / x.denominator
        for _ in range(length):
            value = mpf(mu.numerator) / mu.denominator * value * (1 - value)
        return value - start


def test_the_expansion_is_that_at_the_inner_ends():
    assert Fraction("2.2") < logistic(Fraction(5)).expansion <= Fraction("2.236")
    assert Fraction("1.49") < logistic(Fraction(9, 2)).expansion <= Fraction("1.49994")


def test_one_formula_for_each_domain():
    """x -> 4x on [0, 0.3], 4x - 3 on [0.7, 1]: the words are the digits 0, 3 in base 4."""
    of = full_horseshoe([lambda x: 4 * x, lambda x: 4 * x - 3], [("0", "0.3"), ("0.7", "1")])
    for row in periodic_points(of, Words.of_length(5), 20):
        value = sum(3 * int(d) * 4**i for i, d in enumerate(reversed(row.word)))
        assert row.point[0] <= Fraction(value, 4**5 - 1) <= row.point[1]
        assert row.multiplier == (4**5, 4**5)


def test_different_expansions_and_words_in_any_order():
    """3x on [0, 0.34], 10x - 9 on [0.89, 1]; the words of one orbit, as they follow each other."""
    of = full_horseshoe([lambda x: 3 * x, lambda x: 10 * x - 9], [("0", "0.34"), ("0.89", "1")])
    assert of.expansion <= 3
    for row in periodic_points(of, Words.rotations("0010111"), 20):
        a, b = Fraction(1), Fraction(0)
        for letter in row.word:
            slope, shift = ((3, 0), (10, -9))[int(letter)]
            a, b = slope * a, slope * b + shift
        assert row.point[0] <= b / (1 - a) <= row.point[1]
        assert row.multiplier == (a, a)


def test_domains_in_any_order():
    of = full_horseshoe(lambda x: 5 * x * (1 - x), [("0.72", "1"), ("0", "0.28")])
    one, zero = periodic_points(of, Words.of_length(1))
    assert one.point[0] < Fraction(4, 5) < one.point[1] and zero.point[1] < Fraction(1, 10)


def test_three_symbols_of_a_sine():
    """8 sin x maps three intervals over [-4, 4]; 0 is fixed, with the multiplier 8."""
    domains = [("-4", "-2.6"), ("-0.55", "0.55"), ("2.6", "4")]
    of = full_horseshoe(lambda x: 8 * sin(x), domains)
    rows = periodic_points(of, Words.of_length(2, "012"), 20)
    assert len(rows) == 9
    middle = next(row for row in rows if row.word == "11")
    assert middle.point[0] <= 0 <= middle.point[1]
    assert middle.multiplier[0] <= 64 <= middle.multiplier[1]


@pytest.mark.parametrize(
    ("f", "domains", "reason"),
    [
        (lambda x: 5 * x * (1 - x), [("0", "0.27"), ("0.73", "1")], "not proved to contain"),
        (lambda x: 5 * x * (1 - x), [("0.01", "0.28"), ("0.72", "1")], "not proved to contain"),
        pytest.param(
            lambda x: 5 * x * (1 - x),
            [("0", "0.41"), ("0.59", "1")],
            r"\|f'\| > 1 is not proved",
            marks=pytest.mark.slow,
        ),
        (lambda x: 5 * x * (1 - x), [("0", "1")], "not proved to contain"),
        (lambda x: 4 * x * (1 - x), [("0", "0.5"), ("0.51", "1")], "not proved to contain"),
        (lambda x: 1 * x, [("0", "1")], r"\|f'\| > 1 is not proved"),
        (
            [lambda x: (x - 1).sqrt() * 9, lambda x: 9 * x - 27],
            [("1", "2"), ("3", "4")],
            r"\|f'\| > 1 is not proved on \[1, 2\]",
        ),
    ],
)
def test_no_horseshoe(f, domains, reason):
    with pytest.raises(Undecided, match=reason):
        full_horseshoe(f, domains)


def test_no_formula_there():
    with pytest.raises(DomainError):
        full_horseshoe(lambda x: x.log(), [("-1", "0"), ("1", "2")])


@pytest.mark.parametrize(
    ("domains", "reason"),
    [
        ([("0", "0.6"), ("0.6", "1")], "disjoint"),
        ([("0.5", "1"), ("0", "0.6")], "disjoint"),
        ([("0.3", "0"), ("0.7", "1")], "positive length"),
        ([("0", "0"), ("0.7", "1")], "positive length"),
    ],
)
def test_no_domains(domains, reason):
    with pytest.raises(ValueError, match=reason):
        full_horseshoe(lambda x: 5 * x * (1 - x), domains)


def test_as_many_formulas_as_domains():
    with pytest.raises(ValueError, match="1 formulas on 2 domains"):
        full_horseshoe([lambda x: 5 * x], DOMAINS[Fraction(5)])
