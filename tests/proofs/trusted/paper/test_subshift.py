"""Subshifts of finite type, against counting by hand and published constants."""

from fractions import Fraction
from itertools import product

import pytest

from proofs.trusted.kernel import shifts
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.shifts import closed_paths
from proofs.trusted.paper.s32_sets.subshift import Subshift, words


def without(*factors):
    """The subshift without these factors, which are written at one length."""
    length = max(2, *map(len, (*factors, "")))
    return Subshift(length, frozenset(w for w in words(length) if w.startswith(factors)))


def allowed(word, factors):
    return not any(factor in word for factor in factors)


def cyclic_words(period, factors):
    """How many periodic sequences of this period, not necessarily least, have no factor."""
    return sum(allowed("".join(letters) * 8, factors) for letters in product("01", repeat=period))


FACTORS = [(), ("000",), ("11",), ("1111",), ("00000", "1111"), ("010", "11"), ("01", "000")]


@pytest.mark.parametrize("factors", FACTORS)
def test_fixed_points_are_the_periodic_sequences(factors):
    """By hand, and as the closed paths of the graph."""
    shift = without(*factors)
    counts = closed_paths(shift.arrows)
    for period in range(1, 9):
        assert counts[period - 1] == cyclic_words(period, factors)
        paths = dict.fromkeys(((state, state) for state in shift.arrows), 1)
        for _ in range(period):
            longer: dict = {}
            for (start, end), count in paths.items():
                for then in shift.arrows[end]:
                    longer[start, then] = longer.get((start, then), 0) + count
            paths = longer
        assert counts[period - 1] == sum(n for (a, b), n in paths.items() if a == b)


@pytest.mark.parametrize("factors", FACTORS)
def test_states_begin_sequences(factors):
    """A word is a state if it can be continued for long."""
    shift = without(*factors)
    for word in words(shift.length - 1):
        goes_on = any(allowed(word + end, factors) for end in words(8))
        assert (word in shift.arrows) is goes_on


ENDS = ["0", "2", "01", "002", "001", "110", "111", "112", "1011", "12"]


@pytest.mark.parametrize(("low", "high"), list(product(ENDS, ENDS)))
def test_between_two_words(low, high):
    """Sequences that stay between: those that begin with a word, by looking at each shift."""
    shift = Subshift.between(low, high)
    for word in words(7):
        bounded = all(
            word[k : k + len(low)] >= low and word[k : k + len(high)] < high
            for k in range(8 - shift.length)
        )
        assert all(factor not in word for factor in shift.forbidden) is bounded


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
    low, high = without(*factors).growth
    assert high - low < Fraction(1, 10**25)

    def value(x):
        result = Fraction(0)
        for coefficient in polynomial:
            result = result * x + coefficient
        return result

    assert value(low) <= 0 <= value(high)


def test_tribonacci_constant_as_published():
    """OEIS A058265, cut after 32 places."""
    low, high = without("000").growth
    assert low - Fraction(1, 10**32) < Fraction("1.83928675521416113255185256465328") <= high


@pytest.mark.parametrize(
    ("factors", "chaotic"),
    [
        ((), True),
        (("000",), True),
        (("00", "11"), False),  # one periodic orbit
        (("01",), False),  # 1...1 0 0 ...: no way back
        (("10",), False),
        (("0",), False),  # one point
        (("0", "1"), False),  # none
        (("10", "11"), False),  # 1 begins no sequence
    ],
)
def test_chaotic(factors, chaotic):
    shift = without(*factors)
    assert shift.chaotic is chaotic
    if not chaotic:
        with pytest.raises(Unproved, match="irreducible"):
            _ = shift.growth


def test_growth_is_enclosed_however_rough_the_vector(monkeypatch):
    monkeypatch.setattr(shifts, "_ROUNDS", 2)
    low, high = without("000").growth
    assert low < Fraction("1.8392867") < high


def test_factors_are_named_by_the_shortest():
    assert without("000", "001", "1111").factors == "00 or 1111"
    assert without("0001", "0000").factors == "000"
