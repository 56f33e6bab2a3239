"""Periodic points of maps whose periodic points are known: affine pieces, the logistic map."""

from dataclasses import dataclass
from fractions import Fraction
from math import gcd

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mpmath import mp, mpf

from intervals import Interval, Undecided
from proofs.methods.orbits import corrections, find_points, periodic_points
from proofs.methods.words import Words
from tests.proofs.trusted.paper.reference import as_mpf


@dataclass
class Pieces:
    """A map given by a formula and its derivative on each domain, for floats and intervals."""

    domains: tuple
    expansion: Fraction
    formulas: list
    derivatives: list

    def approximate(self, symbols, x):
        pairs = list(zip(symbols.tolist(), x.tolist(), strict=True))
        values, slopes = ([fs[j](u) for j, u in pairs] for fs in (self.formulas, self.derivatives))
        return np.array(values, float), np.array(slopes, float)

    def defect(self, symbol, x, y):
        return self.formulas[symbol](x) - y

    def slope(self, symbol, x, y):
        return self.derivatives[symbol](x) + 0 * x


def affine(pieces, domains):
    """Pieces a x + b, exact."""

    def formula(a, b):
        return lambda x: x * a + b if isinstance(x, Interval) else float(a) * x + float(b)

    return Pieces(
        tuple(domains),
        min(abs(a) for a, _ in pieces),
        [formula(a, b) for a, b in pieces],
        [lambda x, a=a: 0 * x + a if isinstance(x, Interval) else float(a) for a, _ in pieces],
    )


def exact(pieces, word):
    """The fixed point and the slope of a composition of affine maps, in fractions."""
    a, b = Fraction(1), Fraction(0)
    for letter in word:
        slope, shift = pieces[int(letter)]
        a, b = slope * a, slope * b + shift
    return b / (1 - a), a


CANTOR = [(Fraction(3), Fraction(0)), (Fraction(3), Fraction(-2))]
TENT = [(Fraction(3), Fraction(0)), (Fraction(-3), Fraction(3))]
THIRDS = [(Fraction(0), Fraction(1, 3)), (Fraction(2, 3), Fraction(1))]


@pytest.mark.parametrize("pieces", [CANTOR, TENT], ids=["cantor", "tent"])
@pytest.mark.parametrize("digits", [1, 30])
def test_affine_maps_have_rational_periodic_points(pieces, digits):
    for length in range(1, 8):
        found = periodic_points(affine(pieces, THIRDS), Words.of_length(length), digits)
        assert [row.word for row in found] == [f"{i:0{length}b}" for i in range(2**length)]
        for row in found:
            point, slope = exact(pieces, row.word)
            assert row.point[0] <= point <= row.point[1]
            assert row.multiplier[0] <= slope <= row.multiplier[1]
            allowed = Fraction(1, 10**digits)
            assert row.point[1] - row.point[0] <= allowed
            assert row.multiplier[1] - row.multiplier[0] <= abs(slope) * 10 * allowed


@st.composite
def covering_maps(draw):
    """Affine pieces that map 2 or 3 disjoint intervals over [0, 1], a little or much beyond."""
    count = draw(st.integers(2, 3))
    cuts = draw(
        st.lists(st.integers(1, 999), min_size=2 * count - 2, max_size=2 * count - 2, unique=True)
    )
    ends = [Fraction(x, 1000) for x in [0, *sorted(cuts), 1000]]
    domains = list(zip(ends[::2], ends[1::2], strict=True))
    pieces = []
    for low, high in domains:
        below, above = (Fraction(draw(st.integers(0, 20)), 10) for _ in range(2))
        image = (-below, 1 + above) if draw(st.booleans()) else (1 + above, -below)
        a = (image[1] - image[0]) / (high - low)
        pieces.append((a, image[0] - a * low))
    return pieces, domains


@pytest.mark.slow
@settings(max_examples=60)
@given(covering_maps(), st.integers(1, 4), st.sampled_from([5, 40]))
def test_any_affine_pieces_that_cover(drawn, length, digits):
    pieces, domains = drawn
    of = affine(pieces, domains)
    if of.expansion <= Fraction(11, 10):
        return
    alphabet = "012"[: len(domains)]
    for row in periodic_points(of, Words.of_length(length, alphabet), digits):
        point, slope = exact(pieces, row.word)
        assert row.point[0] <= point <= row.point[1]
        assert row.multiplier[0] <= slope <= row.multiplier[1]
        low, high = domains[int(row.word[0])]
        assert row.point[0] >= low - Fraction(1, 10**12)
        assert row.point[1] <= high + Fraction(1, 10**12)


LOGISTIC = Pieces(
    ((Fraction(0), Fraction("0.2764")), (Fraction("0.7236"), Fraction(1))),
    Fraction("2.23"),
    [lambda x: 5 * x * (1 - x)] * 2,
    [lambda x: 5 - 10 * x] * 2,
)


def logistic_point(word):
    """By the two inverse branches in closed form, many times, at 60 digits."""
    with mp.workdps(60):
        x = mpf(1) / 2
        for letter in reversed(word * (300 // len(word))):
            root = mp.sqrt(1 - 4 * x / 5)
            x = (1 + root) / 2 if letter == "1" else (1 - root) / 2
        return x


@pytest.mark.parametrize("digits", [25, 45])
def test_the_logistic_map_by_inverse_branches(digits):
    for row in periodic_points(LOGISTIC, Words.of_length(6), digits):
        with mp.workdps(60):
            point, multiplier = logistic_point(row.word), mpf(1)
            x, error = point, mpf(10) ** -50
            assert as_mpf(row.point[0]) - error <= point <= as_mpf(row.point[1]) + error
            for _ in row.word:
                multiplier, x = multiplier * (5 - 10 * x), 5 * x * (1 - x)
            low, high = map(as_mpf, row.multiplier)
            assert low - error <= multiplier <= high + error
            assert high - low <= abs(multiplier) * mpf(10) ** -digits


def test_corrections_are_those_of_exact_arithmetic():
    slopes = [Fraction(7, 2), Fraction(-5, 2), Fraction(3)]
    defects = [Fraction((7 * i) % 5 - 2, 10**6) for i in range(3)]
    enclosed = corrections(
        *([Interval(x, precision=100) for x in each] for each in (defects, slopes))
    )
    for i in range(3):
        a, b = Fraction(1), Fraction(0)  # d(i) = a d(i + k) + b
        for k in (i, i + 1, i + 2):
            a, b = a / slopes[k % 3], b - a / slopes[k % 3] * defects[k % 3]
        assert enclosed[i].contains(b / (1 - a)) and enclosed[i].wid <= Fraction(1, 10**20)


def test_without_expansion_nothing_is_proved():
    for slopes in ([Interval(1, 2), Interval(3)], [Interval(-2, 2), Interval(3)]):
        with pytest.raises(Undecided, match="expand"):
            corrections([Interval(0)] * 2, slopes)


def test_a_map_that_is_known_roughly_is_undecided():
    noise = Interval(Fraction(-1, 10**18), Fraction(1, 10**18))
    rough = Pieces(
        LOGISTIC.domains,
        LOGISTIC.expansion,
        [lambda x: 5 * x * (1 - x) + (noise if isinstance(x, Interval) else 0)] * 2,
        LOGISTIC.derivatives,
    )
    with pytest.raises(Undecided, match="known to"):
        periodic_points(rough, Words.of_length(2), 30)


def test_multipliers_that_are_known_roughly_are_undecided():
    about = Interval(1 - Fraction(1, 10**18), 1 + Fraction(1, 10**18))
    rough = Pieces(
        LOGISTIC.domains,
        LOGISTIC.expansion,
        LOGISTIC.formulas,
        [lambda x: (5 - 10 * x) * (about if isinstance(x, Interval) else 1)] * 2,
    )
    assert periodic_points(rough, Words.of_length(2), 15)
    with pytest.raises(Undecided, match="a multiplier is known to"):
        periodic_points(rough, Words.of_length(2), 20)


def test_poor_candidates_lie_in_the_domains_and_the_points_are_found_from_them():
    pieces = [(Fraction(3, 2), Fraction(-1, 20)), (Fraction(3), Fraction(-2))]
    domains = [(Fraction(1, 10), Fraction(7, 10)), (Fraction(7, 10), Fraction(1))]
    of = affine(pieces, domains)
    approximate = of.approximate
    of.approximate = lambda symbols, x: (
        approximate(symbols, x)[0] + 1e-6,
        approximate(symbols, x)[1],
    )
    words = Words.of_length(3)
    x, rows = find_points(of, words), periodic_points(of, words, 30)
    for start, row in zip(x.tolist(), rows, strict=True):
        low, high = domains[int(row.word[0])]
        assert low <= Fraction(start) <= high
        assert row.point[0] <= exact(pieces, row.word)[0] <= row.point[1]


@pytest.mark.parametrize(("length", "alphabet"), [(1, "01"), (6, "01"), (12, "01"), (4, "012")])
def test_words_and_their_orbits(length, alphabet):
    words = Words.of_length(length, alphabet)
    k = len(alphabet)
    assert len(words.texts) == k**length == len(set(words.texts))
    assert list(words.texts) == sorted(words.texts)
    for text, symbol, following in zip(words.texts, words.symbols, words.following, strict=True):
        assert int(text[0]) == symbol
        assert words.texts[following] == text[1:] + text[:1]
    necklaces = sum(k ** gcd(i, length) for i in range(length)) // length  # Burnside
    assert len(words.cycles) == necklaces
    assert sorted(i for cycle in words.cycles for i in cycle) == list(range(k**length))
