"""Subshifts of finite type, against counting by hand and published constants."""

from fractions import Fraction
from itertools import product

import pytest

from proofs.trusted.paper.s32_sets import subshift
from proofs.trusted.paper.s32_sets.subshift import Subshift, words


def allowed(word, factors):
    return not any(factor in word for factor in factors)


def cyclic_words(period, factors):
    """How many periodic sequences of this period, not necessarily least, have no factor."""
    return sum(allowed("".join(letters) * 8, factors) for letters in product("01", repeat=period))


FACTORS = [(), ("000",), ("11",), ("1111",), ("00000", "1111"), ("010", "11"), ("01", "000")]


@pytest.mark.parametrize("factors", FACTORS)
def test_fixed_points_are_the_periodic_sequences(factors):
    shift = Subshift.without(factors)
    for period in range(1, 9):
        assert shift.fixed_points(period) == cyclic_words(period, factors)


@pytest.mark.parametrize("factors", FACTORS)
def test_begins(factors):
    """A word begins a sequence if it can be continued for long."""
    shift = Subshift.without(factors)
    for length in range(1, 6):
        for word in words(length):
            goes_on = any(allowed(word + end, factors) for end in words(8))
            assert shift.begins(word) is goes_on


@pytest.mark.parametrize(
    ("factors", "polynomial"),
    [
        (("000",), (1, -1, -1, -1)),  # tribonacci
        (("11",), (1, -1, -1)),  # golden mean
        (("1111",), (1, -1, -1, -1, -1)),
        ((), (1, -2)),
    ],
)
def test_growth_is_the_root_of_its_polynomial(factors, polynomial):
    low, high = Subshift.without(factors).growth
    assert high - low < Fraction(1, 10**25)

    def value(x):
        result = Fraction(0)
        for coefficient in polynomial:
            result = result * x + coefficient
        return result

    assert value(low) <= 0 <= value(high)


def test_tribonacci_constant_as_published():
    """OEIS A058265."""
    low, high = Subshift.without(["000"]).growth
    assert low <= Fraction("1.83928675521416113255185256465328") <= high


@pytest.mark.parametrize(
    ("factors", "missing"),
    [(("000",), "000"), (("1111", "00000"), "1111"), ((), None), (("01",), "01"), (("0",), "0")],
)
def test_shortest_missing_word(factors, missing):
    assert Subshift.without(factors).missing == missing


@pytest.mark.parametrize(
    ("factors", "irreducible", "chaotic"),
    [
        ((), True, True),
        (("000",), True, True),
        (("00", "11"), True, False),  # one periodic orbit
        (("01",), False, False),  # 1...1 0 0 ...: no way back
        (("10",), False, False),
        (("0",), True, False),  # one point
        (("0", "1"), False, False),  # none
        (("10", "11"), True, False),  # 1 begins no sequence
    ],
)
def test_irreducible_and_chaotic(factors, irreducible, chaotic):
    shift = Subshift.without(factors)
    assert shift.irreducible is irreducible
    assert shift.chaotic is chaotic


def test_growth_is_enclosed_however_rough_the_vector(monkeypatch):
    monkeypatch.setattr(subshift, "_ROUNDS", 2)
    low, high = Subshift.without(["000"]).growth
    assert low < Fraction("1.8392867") < high


def test_growth_needs_an_irreducible_graph():
    with pytest.raises(ValueError, match="irreducible"):
        _ = Subshift.without(["01"]).growth


def test_factors_are_named_by_the_shortest():
    assert Subshift.without(["000", "001", "1111"]).factors == "00 or 1111"
    assert Subshift.without(["0001", "0000"]).factors == "000"
