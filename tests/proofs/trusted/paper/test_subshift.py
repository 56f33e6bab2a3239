"""Subshifts of finite type, against counting by hand and published constants."""

from fractions import Fraction
from fractions import Fraction as F
from itertools import pairwise, product
from math import log, sqrt

import numpy as np
import pytest

from proofs.methods.subshifts import (
    arc,
    between,
    common,
    largest_subshift,
    least_ceiling,
    outer_tower,
    tower,
)
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


# -- the largest subshift of piecewise monotone maps whose entropy is known in closed form ---------


def exact(*formulas):
    """Exact images: one formula a piece."""

    def image(index, x):
        value = formulas[index](x)
        return value, value

    return image


def entropy(pieces, image, depth):
    found = largest_subshift(pieces, image, tower(pieces, image, depth, 9))
    return log(found.growth)


def tent(slope):
    slope = F(slope)
    pieces = [(F(0), F(1, 2) - F(1, 10**8)), (F(1, 2), F(1))]
    return pieces, exact(lambda x: slope * x, lambda x: slope * (1 - x))


@pytest.mark.parametrize("slope", ["1.6", "1.75", "1.9"])
def test_tents_have_the_entropy_log_slope(slope):
    pieces, image = tent(slope)
    bounds = [entropy(pieces, image, depth) for depth in (0, 2, 5, 12)]
    assert bounds == sorted(bounds)
    assert log(F(slope)) - 0.003 < bounds[-1] <= log(F(slope))


def beta_map(beta):
    """x -> beta x mod 1 on its whole pieces and the last one (Renyi): the entropy is log beta."""
    count = int(beta)
    ends = [F(k) / beta for k in range(count + 1)] + [F(1)]
    pieces = [(low, high - F(1, 10**9)) for low, high in pairwise(ends)]
    return pieces, exact(*((lambda x, k=k: beta * x - k) for k in range(count + 1)))


@pytest.mark.parametrize("beta", ["1.7", "2.3", "3.14"])
def test_beta_transformations(beta):
    pieces, image = beta_map(F(beta))
    found = entropy(pieces, image, 12)
    assert log(F(beta)) - 0.003 < found <= log(F(beta))


def test_the_logistic_map_above_4_is_a_full_shift():
    def value(x):
        return F(9, 2) * x * (1 - x)

    pieces = [(F(0), F(1, 3)), (F(2, 3), F(1))]
    image = exact(value, value)
    found = largest_subshift(pieces, image, tower(pieces, image, 3, 9))
    assert found.growth == 2


def test_a_golden_mean_graph():
    # [0, 1] -> [0, 2] increasing, [1 + 1/100, 2] -> [0, 1]: A = ((1, 1), (1, 0))
    pieces = [(F(0), F(1)), (F("1.01"), F(2))]
    image = exact(lambda x: 2 * x, lambda x: (2 - x) / F("0.99"))
    found = largest_subshift(pieces, image, tower(pieces, image, 2, 9))
    assert len(found.states) == 2
    assert abs(float(found.growth) - (1 + sqrt(5)) / 2) < 1e-6
    assert found.growth**2 <= found.growth + 1


def test_the_growth_is_a_collatz_wielandt_bound():
    pieces, image = beta_map(F("3.14"))
    found = largest_subshift(pieces, image, tower(pieces, image, 6, 9))
    n = len(found.states)
    matrix = np.zeros((n, n))
    for i, state in enumerate(found.states):
        for b in range(len(pieces)):
            whole = arc(pieces, image, b, state)
            inside = [
                (found.vector[j], j)
                for j, (low, high) in enumerate(found.states)
                if whole and whole[0] <= low and high <= whole[1]
            ]
            if inside:
                matrix[i, max(inside)[1]] += 1
    radius = max(abs(np.linalg.eigvals(matrix)))
    assert float(found.growth) <= radius + 1e-9
    assert float(found.growth) > radius - 1e-4


def test_no_path_goes_on():
    pieces = [(F(0), F(1))]
    image = exact(lambda x: x + 5)
    assert largest_subshift(pieces, image, [(F(0), F(1))]) is None


def test_states_lie_inside_the_images():
    pieces, image = tent("1.7")
    for low, high in tower(pieces, image, 4, 3):
        assert any(
            whole[0] <= low and high <= whole[1]
            for state in [*pieces, *tower(pieces, image, 4, 3)]
            for b in (0, 1)
            if (whole := arc(pieces, image, b, state))
        )


def test_parts_and_bounds():
    assert common((F(0), F(1)), (F(1), F(2))) is None
    assert common((F(0), F(2)), (F(1), F(3))) == (1, 2)
    assert between((F(0), F(1)), (F(3), F(4))) == (1, 3)
    assert between((F(3), F(4)), (F(0), F(1))) == (1, 3)
    assert between((F(0), F(2)), (F(1), F(4))) is None


def ceiling(pieces, image, depth, places=9):
    """The bound from above for a map of [0, 1] into itself, on pieces that cover it."""

    def images(state):
        parts = [(i, common(piece, state)) for i, piece in enumerate(pieces)]
        ends = [[image(i, x)[0] for x in part] for i, part in parts if part]
        return [(max(F(0), min(pair)), min(F(1), max(pair))) for pair in ends]

    states = outer_tower((F(0), F(1)), images, depth, places)
    found = least_ceiling(states, images)
    value = dict(zip(found.states, found.vector, strict=True))
    for state in found.states:  # by the definition, whatever edges were chosen
        held = ((v for (a, b), v in value.items() if a <= x and y <= b) for x, y in images(state))
        assert sum(map(min, held)) <= found.growth * value[state]
    return found


@pytest.mark.parametrize("beta", ["1.7", "2.3", "3.14"])
def test_beta_transformations_from_above(beta):
    pieces, image = beta_map(F(beta))
    pieces = [(low, min(F(1), high + F(1, 10**9))) for low, high in pieces]
    bounds = [ceiling(pieces, image, depth).growth for depth in (0, 2, 5, 12)]
    assert bounds == sorted(bounds, reverse=True)
    assert F(beta) * (1 - F(1, 10**6)) <= bounds[-1] < F(beta) * F("1.003")


def test_states_from_above_hold_the_images():
    pieces, image = tent("1.7")
    states = outer_tower((F(0), F(1)), lambda state: [(F(1, 3), F(2, 3))], 2, 2)
    assert states == [(F(0), F(1)), (F("0.33"), F("0.67"))]
    assert ceiling(pieces, image, 8).growth >= F("1.7") - F(1, 10**6)
