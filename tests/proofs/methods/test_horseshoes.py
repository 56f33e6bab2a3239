"""Full horseshoes of the line: the logistic map above 4, and what is not proved to be one."""

from fractions import Fraction

import pytest

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
