"""Periodic points of maps whose periodic points are known: affine pieces, the logistic map."""

from dataclasses import dataclass
from fractions import Fraction
from math import gcd

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mpmath import mp, mpf

from intervals import Interval, IntervalArray, Undecided
from proofs.methods.horseshoes import full_horseshoe
from proofs.methods.orbits import corrections, find_points, isolate, periodic_points, refine
from proofs.methods.words import Words


@dataclass
class Pieces:
    """A map given by a formula and its derivative on each domain, for every number type."""

    domains: tuple
    expansion: Fraction
    formulas: list
    derivatives: list

    def all(self, functions, symbols, x):
        value = functions[0](x)
        for j, function in enumerate(functions[1:], start=1):
            value = np.where(symbols == j, function(x), value)
        return value

    def approximate(self, symbols, x):
        slopes = self.all([lambda x, d=d: d(x) + 0.0 * x for d in self.derivatives], symbols, x)
        return self.all(self.formulas, symbols, x), slopes

    def defects(self, symbols, x, y):
        at, to = IntervalArray.from_floats(x), IntervalArray.from_floats(y)
        return self.all(self.formulas, symbols, at) - to

    def germs(self, symbols, boxes):
        return PieceGerms(self, symbols, boxes)


@dataclass
class PieceGerms:
    of: Pieces
    symbols: np.ndarray
    boxes: IntervalArray

    @property
    def slopes(self):
        return self.slopes_at(self.boxes, None)

    def defect(self, index, x, y):
        return self.of.formulas[self.symbols[index]](x) - y

    def slope(self, index, x, y):
        return self.of.derivatives[self.symbols[index]](x) + 0 * x

    def defects(self, x, y):
        return self.of.all(self.of.formulas, self.symbols, x) - y

    def slopes_at(self, x, y):
        return self.of.all(self.of.derivatives, self.symbols, x) + 0 * x


def affine(pieces, domains):
    """Pieces a x + b, exact."""

    def formula(a, b):
        def f(x):
            exact = not isinstance(x, np.ndarray)
            return x * a + b if exact else float(a) * x + float(b)

        return f

    def derivative(a):
        return lambda x: float(a) if isinstance(x, np.ndarray) else 0 * x + a

    return Pieces(
        tuple(domains),
        min(abs(a) for a, _ in pieces),
        [formula(a, b) for a, b in pieces],
        [derivative(a) for a, _ in pieces],
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
@pytest.mark.parametrize("digits", [None, 1, 30])
def test_affine_maps_have_rational_periodic_points(pieces, digits):
    for length in range(1, 8):
        found = periodic_points(affine(pieces, THIRDS), Words.of_length(length), digits)
        assert [row.word for row in found] == [f"{i:0{length}b}" for i in range(2**length)]
        for row in found:
            point, slope = exact(pieces, row.word)
            assert row.point[0] <= point <= row.point[1]
            assert row.multiplier[0] <= slope <= row.multiplier[1]
            allowed = Fraction(1, 10 ** (14 if digits is None else digits))
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
@settings(max_examples=60, deadline=None)
@given(covering_maps(), st.integers(1, 4), st.sampled_from([None, 5, 40]))
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


LOGISTIC = full_horseshoe(lambda x: 5 * x * (1 - x), [("0", "0.2764"), ("0.7236", "1")])
FIVE = Pieces(
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


def test_the_logistic_map_in_closed_form():
    rows = {
        row.word: row for n in (1, 2) for row in periodic_points(LOGISTIC, Words.of_length(n), 40)
    }
    with mp.workdps(60):
        root = mp.sqrt(12)
        known = {"0": (mpf(0), 5), "1": (mpf(4) / 5, -3)}
        known |= {"01": ((6 - root) / 10, -11), "10": ((6 + root) / 10, -11)}
        for word, (point, multiplier) in known.items():
            row, margin = rows[word], mpf(10) ** -55
            assert as_mpf(row.point[0]) <= point + margin and point - margin <= as_mpf(row.point[1])
            assert row.multiplier[0] <= multiplier <= row.multiplier[1]
    assert [rows[word].period for word in ("00", "01", "11")] == [1, 2, 1]


def as_mpf(x):
    return mpf(x.numerator) / x.denominator


@pytest.mark.parametrize("digits", [None, 25, 45])
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
            assert high - low <= abs(multiplier) * mpf(10) ** -(digits or 12)


def test_two_precisions_agree():
    words = Words.rotations("0010111")
    found = isolate(FIVE, words)
    rough, fine = (refine(FIVE, words, found, digits) for digits in (8, 60))
    for binary, coarse, narrow in zip(found.points.tolist(), rough, fine, strict=True):
        assert coarse.inf <= narrow.inf and narrow.sup <= coarse.sup
        assert binary.inf <= narrow.inf and narrow.sup <= binary.sup
        assert narrow.wid <= Fraction(1, 10**60)


def test_corrections_are_those_of_exact_arithmetic():
    words = Words.of_length(3)
    slopes = [Fraction(7, 2), Fraction(-5, 2)]
    by_word = [slopes[int(text[0])] for text in words.texts]
    defects = [Fraction((7 * i) % 5 - 2, 10**6) for i in range(8)]
    found = corrections(words, IntervalArray(defects), IntervalArray(by_word))
    for i in range(8):
        a, b, index = Fraction(1), Fraction(0), i  # d(i) = a d(index) + b
        for _ in range(3):
            a, b = a / by_word[index], b - a / by_word[index] * defects[index]
            index = int(words.following[index])
        d = b / (1 - a)
        assert found[i].item().inf <= d <= found[i].item().sup
        assert found[i].item().wid <= Fraction(1, 10**20)


def test_without_expansion_nothing_is_proved():
    words = Words.of_length(1)
    zero = IntervalArray([0, 0])
    with pytest.raises(Undecided, match="expand"):
        corrections(words, zero, IntervalArray([(1, 2), 3]))
    with pytest.raises(Undecided, match="expand"):
        corrections(words, zero, IntervalArray([(-2, 2), 3]))


def test_a_map_that_is_known_roughly_is_undecided():
    noise = Interval(Fraction(-1, 10**18), Fraction(1, 10**18))
    rough = Pieces(
        FIVE.domains,
        FIVE.expansion,
        [lambda x: 5 * x * (1 - x) + (noise if isinstance(x, Interval) else 0)] * 2,
        FIVE.derivatives,
    )
    with pytest.raises(Undecided, match="known to"):
        periodic_points(rough, Words.of_length(2), 30)


def test_multipliers_that_are_known_roughly_are_undecided():
    about = Interval(1 - Fraction(1, 10**18), 1 + Fraction(1, 10**18))
    rough = Pieces(
        FIVE.domains,
        FIVE.expansion,
        FIVE.formulas,
        [lambda x: (5 - 10 * x) * (about if isinstance(x, Interval) else 1)] * 2,
    )
    assert periodic_points(rough, Words.of_length(2), 15)
    with pytest.raises(Undecided, match="multipliers"):
        periodic_points(rough, Words.of_length(2), 20)


def test_poor_candidates_make_wide_boxes():
    """Candidates lie in the domains, exactly, and the boxes reach the true points from them."""
    pieces = [(Fraction(3, 2), Fraction(-1, 20)), (Fraction(3), Fraction(-2))]
    domains = [(Fraction(1, 10), Fraction(7, 10)), (Fraction(7, 10), Fraction(1))]
    of = affine(pieces, domains)
    approximate = of.approximate
    of.approximate = lambda symbols, x: (
        approximate(symbols, x)[0] + 1e-6,
        approximate(symbols, x)[1],
    )
    words = Words.of_length(3)
    x, boxes = find_points(of, words), isolate(of, words).boxes
    for i, word in enumerate(words.texts):
        low, high = domains[int(word[0])]
        assert low <= Fraction(float(x[i])) <= high
        assert boxes[i].item().inf <= exact(pieces, word)[0] <= boxes[i].item().sup


def test_no_candidates():
    lost = Pieces(FIVE.domains, FIVE.expansion, [lambda x: x * float("nan")] * 2, FIVE.derivatives)
    with pytest.raises(Undecided, match="no candidates"):
        periodic_points(lost, Words.of_length(2))


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


def test_rotations_begin_with_the_word():
    assert Words.rotations("0010").texts == ("0010", "0100", "1000", "0001")
    assert Words.rotations("0101").texts == ("0101", "1010")
    assert Words.rotations("111").texts == ("111",)
    assert [len(c) for c in Words.rotations("0101").cycles] == [2]
