"""The escape rate from cycles: maps whose rate is known, and what is refused."""

from fractions import Fraction
from itertools import product
from math import prod

import pytest

from intervals import Interval, Undecided
from proofs.methods.traces import coefficients, escape_rate, traces
from proofs.methods.words import lyndon


def linear(slopes, longest):
    """The multipliers of the cycles of a full shift with constant slopes."""
    alphabet = "".join(map(str, range(len(slopes))))
    return [
        [
            Interval(prod(slopes[int(letter)] for letter in word), precision=200)
            for word in lyndon(n, alphabet)
        ]
        for n in range(1, longest + 1)
    ]


@pytest.mark.parametrize("slopes", [(5, 4), (5, -3), (Fraction(7, 2), 9, -6)])
def test_constant_slopes(slopes):
    """Lengths shrink by the sum of 1/|slope| in each step."""
    rate = escape_rate(linear(slopes, 8))
    known = -Interval(sum(1 / abs(Fraction(s)) for s in slopes), precision=200).log()
    assert (rate - known).mag < Fraction(1, 10**12) and rate.wid < Fraction(1, 10**50)


def test_traces_over_all_words():
    slopes = (5, -3)
    for n, trace in enumerate(traces(linear(slopes, 6)), 1):
        words = product(slopes, repeat=n)
        assert trace.contains(sum(1 / abs(Fraction(prod(word)) - 1) for word in words))


def test_the_determinant_of_a_matrix():
    """From tr A^n, A diagonal with 1/2 and 1/3: (1 - z/2) (1 - z/3), and no more terms."""
    of = [Interval(Fraction(1, 2**n) + Fraction(1, 3**n)) for n in range(1, 6)]
    expected = (1, Fraction(-5, 6), Fraction(1, 6), 0, 0, 0)
    for found, value in zip(coefficients(of), expected, strict=True):
        assert found.contains(value) and found.wid < Fraction(1, 10**14)


def test_no_change_of_sign():
    """One multiplier, known to lie between 2 and 1000 only."""
    with pytest.raises(Undecided, match="not enclosed"):
        escape_rate([[Interval(2, 1000)]])
