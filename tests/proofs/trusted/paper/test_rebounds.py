"""Joining conclusions about rectangles, on maps with known answers: no oscillator here."""

import random
from dataclasses import replace
from fractions import Fraction
from itertools import product

import pytest

from proofs.trusted.paper.s33_restitution.rebound_facts import FULL, NO_REPEATED_ONE, never_twice
from proofs.trusted.paper.s33_restitution.rebound_texts import merged
from proofs.trusted.paper.s33_restitution.rebounds import (
    Rebound,
    Unjoined,
    barred,
    growth,
    horseshoe,
    in_cones,
    rectangle,
    stable_slope,
)

HERE = ((Fraction(1), Fraction(1)),) * 3
GAMMA = (Fraction(-1), Fraction(1))
LEFT, RIGHT = (Fraction(0), Fraction(1, 4)), (Fraction(3, 4), Fraction(1))


def pair_of(low, high):
    return Fraction(low), Fraction(high)


def linear(phases, slope=5, shift=0, velocities=GAMMA, turns=0, box=HERE, skew=0, shrink=0):
    """F(phi, gamma) = (slope phi + shift + skew gamma, phi/10 + shrink gamma), exactly."""
    images = [slope * phi + shift + skew * gamma for phi, gamma in product(phases, velocities)]
    arrivals = [phi / 10 + shrink * gamma for phi, gamma in product(phases, velocities)]
    entries = tuple(
        tuple((Fraction(x), Fraction(x)) for x in row)
        for row in ((slope, skew), (Fraction(1, 10), shrink))
    )
    return Rebound(
        box,
        phases,
        velocities,
        turns,
        (min(images), max(images)),
        (min(arrivals), max(arrivals)),
        entries,
    )


def joined(phases, shift=0, **more):
    """The rectangle from two halves and the edges."""
    middle = sum(phases) / 2
    parts = [
        linear(side, shift=shift, **more)
        for side in ((phases[0], middle), (middle, phases[1]), phases[:1] * 2, phases[1:] * 2)
    ]
    return rectangle(parts, HERE, phases, GAMMA)


# The images of LEFT and RIGHT are [-1/8, 9/8], of length 5/4.
TRUE = {"left": Fraction(-1, 8), "right": Fraction(-31, 8)}


def test_linear_horseshoe():
    found = horseshoe((joined(LEFT, TRUE["left"]), joined(RIGHT, TRUE["right"])), FULL)
    assert found.margin == Fraction(1, 8)
    assert found.expansion == 5
    assert found.contraction == 0


def test_skew_costs_margin_and_rates():
    skew = Fraction(1, 16)
    rectangles = [
        joined(phases, shift, skew=skew, shrink=Fraction(1, 50))
        for phases, shift in ((LEFT, TRUE["left"]), (RIGHT, TRUE["right"]))
    ]
    found = horseshoe(tuple(rectangles), FULL)
    assert found.margin == Fraction(1, 16)
    assert found.expansion == 5 - 2 * skew
    assert 0 < found.contraction < Fraction(3, 100)


@pytest.mark.parametrize(
    ("shifts", "reason"),
    [
        ((Fraction(0), TRUE["right"]), "not mapped beyond"),  # the left edge stays
        ((Fraction(-1, 4), TRUE["right"]), "not mapped beyond"),  # the right one falls short
        ((TRUE["left"], Fraction(-4)), "not mapped beyond"),
        ((TRUE["left"] + 3, TRUE["right"]), "not mapped beyond"),
    ],
)
def test_an_edge_that_is_not_beyond(shifts, reason):
    with pytest.raises(Unjoined, match=reason):
        horseshoe((joined(LEFT, shifts[0]), joined(RIGHT, shifts[1])), FULL)


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"velocity": pair_of(-1, 0)}, "interior"),
        ({"velocity": pair_of(0, 1)}, "interior"),
        ({"velocities": pair_of(-2, 1)}, "different"),
        ({"box": ((Fraction(1), Fraction(2)), *HERE[1:])}, "different"),
        ({"phases": pair_of("-1/2", "1/4")}, None),
        ({"phases": pair_of(0, "7/8")}, "overlap"),
        ({"derivative": ((pair_of(-1, 5), pair_of(0, 0)), (pair_of(0, 0),) * 2)}, "increase"),
        ({"derivative": ((pair_of("1/2", 5), pair_of(0, 0)), (pair_of(0, 0),) * 2)}, "cone"),
        ({"derivative": ((pair_of(5, 5), pair_of(-9, 9)), (pair_of(-1, 1),) * 2)}, "cone"),
        (
            {"derivative": ((pair_of(5, 5), pair_of(0, 0)), (pair_of(10, 10), pair_of(0, 0)))},
            "cone",
        ),
        ({"derivative": ((pair_of(5, 5), pair_of(0, 0)), (pair_of(0, 0), pair_of(1, 1)))}, "cone"),
        (
            {"derivative": ((pair_of("6/5", 5), pair_of(0, 0)), (pair_of(2, 2), pair_of(0, 0)))},
            "cone",
        ),
        ({"right": pair_of("9/8", 8)}, "around the circle"),
        ({"left": pair_of(-8, "-1/8")}, "around the circle"),
    ],
)
def test_hypotheses_of_a_horseshoe(change, reason):
    left, right = joined(LEFT, TRUE["left"]), joined(RIGHT, TRUE["right"])
    with pytest.raises(Unjoined, match=reason):
        horseshoe((replace(left, **change), right), FULL)


def test_arrows_ask_for_less():
    """Images that reach only 3/4: the second rectangle is reached by the first alone."""
    right = joined(RIGHT, TRUE["right"] - Fraction(1, 4))
    with pytest.raises(Unjoined):
        horseshoe((joined(LEFT, TRUE["left"]), right), FULL)
    found = horseshoe((joined(LEFT, TRUE["left"]), right), NO_REPEATED_ONE)
    assert found.margin == Fraction(1, 8)


# -- rectangles ------------------------------------------------------------------------------------

PARTS = [linear(pair_of(0, "1/8")), linear(pair_of("1/8", "1/4"))]
ENDS = [linear(pair_of(0, 0)), linear(pair_of("1/4", "1/4"))]


def test_rectangle_joins():
    found = rectangle([*PARTS, *ENDS], HERE, LEFT, GAMMA)
    assert found.left == (0, 0)
    assert found.right == (Fraction(5, 4), Fraction(5, 4))
    assert found.velocity == (0, Fraction(1, 40))


@pytest.mark.parametrize(
    "parts",
    [
        [],
        [PARTS[0], *ENDS],
        [PARTS[1], *ENDS],
        [linear(pair_of(0, "31/250")), PARTS[1], *ENDS],
        [linear(pair_of(0, "1/8"), velocities=pair_of(-1, "1/2")), PARTS[1], *ENDS],
        [linear(pair_of(0, "1/8"), turns=1), PARTS[1], *ENDS],
        [*PARTS, ENDS[0], linear(pair_of("1/4", "1/4"), turns=1)],
        [linear(pair_of(0, "1/8"), box=(pair_of(2, 2), *HERE[1:])), PARTS[1], *ENDS],
    ],
)
def test_parts_that_do_not_join(parts):
    with pytest.raises(Unjoined):
        rectangle(parts, HERE, LEFT, GAMMA)


def test_a_rectangle_has_width():
    with pytest.raises(Unjoined, match="width"):
        rectangle(ENDS, HERE, pair_of(0, 0), GAMMA)


# -- words -----------------------------------------------------------------------------------------

# slope 5 on RIGHT, image [-5/4, 0] + 1 - 1/100 * ...: its fixed point is right of 1
SHORT = Fraction(-5) + 1 - Fraction(1, 50)


def short_pair():
    return joined(LEFT, TRUE["left"]), joined(RIGHT, SHORT)


def at(phase, shift=SHORT):
    return linear(pair_of(phase, phase), shift=shift)


def test_constant_word():
    """phi <= 1 goes to at most 0.98, that to 0.88, that to 0.38 < 3/4."""
    bounds = [Fraction(1), Fraction("0.98"), Fraction("0.88")]
    parts = [at(bound) for bound in bounds]
    found = barred(parts, short_pair(), (1, 1, 1, 1), bounds, 1)
    assert found.short == Fraction("0.37")
    for count in (1, 2):
        with pytest.raises(Unjoined, match="not excluded"):
            barred(parts, short_pair(), (1,) * (count + 1), bounds[:count], 1)


@pytest.mark.parametrize(
    ("word", "bounds", "sign"),
    [
        ((1, 1, 1, 1), ["1", "0.97", "0.88"], 1),  # 0.98 is possible
        ((1, 1, 1, 1), ["1", "0.98", "0.87"], 1),
        ((1, 1, 1, 1), ["0.98", "0.98", "0.88"], 1),
        ((1, 1, 1, 1), ["1.1", "0.98", "0.88"], 1),  # outside the rectangle
        ((1, 1, 1, 0), ["1", "0.98", "0.88"], 1),  # 0.38 does not exclude the left one
        ((1, 1, 1), ["1", "0.98", "0.88"], 1),
        ((1,), [], 1),
        ((1, 1, 1, 1), ["3/4", "3/4", "3/4"], -1),  # nothing is excluded from below
        ((2, 2), ["1"], 1),
        ((-1, -1), ["1"], 1),
    ],
)
def test_words_that_are_not_barred(word, bounds, sign):
    values = [Fraction(x) for x in bounds]
    with pytest.raises(Unjoined):
        barred([at(x) for x in values], short_pair(), word, values, sign)


def test_word_barred_from_below():
    """The left edge of LEFT goes right of it: 0 -> 1/10 -> 6/10."""
    pair = joined(LEFT, Fraction(1, 10)), joined(RIGHT, TRUE["right"])
    bounds = [Fraction(0), Fraction(1, 10)]
    parts = [at(x, Fraction(1, 10)) for x in bounds]
    assert barred(parts, pair, (0, 0, 0), bounds, -1).short == Fraction(7, 20)
    with pytest.raises(Unjoined):
        barred(parts, pair, (0, 0, 0), bounds, 1)


def test_bound_beyond_the_rectangle_is_not_taken():
    """Right of the rectangle the map may be another one: its images there bound nothing."""
    bounds = [Fraction("1.1"), Fraction("0.98"), Fraction("0.88")]
    parts = [replace(at(bounds[0]), phase=pair_of("0.98", "0.98")), *map(at, bounds[1:])]
    with pytest.raises(Unjoined, match="beyond the bound"):
        barred(parts, short_pair(), (1, 1, 1, 1), bounds, 1)


def test_velocities_that_leave_the_rectangle_are_not_followed():
    bounds = [Fraction(1), Fraction("0.98"), Fraction("0.88")]
    wide = pair_of(-2, 2)
    parts = [linear(pair_of(x, x), shift=SHORT, velocities=wide) for x in bounds]
    left, right = short_pair()
    assert barred(parts, (left, right), (1, 1, 1, 1), bounds, 1).short > 0
    with pytest.raises(Unjoined, match="velocity"):
        barred(parts, (left, replace(right, velocity=wide)), (1, 1, 1, 1), bounds, 1)


def test_bound_of_another_branch_is_not_taken():
    bounds = [Fraction(1), Fraction("0.98"), Fraction("0.88")]
    parts = [at(bounds[0]), at(bounds[1]), replace(at(bounds[2]), turns=1)]
    with pytest.raises(Unjoined, match="turns"):
        barred(parts, short_pair(), (1, 1, 1, 1), bounds, 1)


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        ([(1, 1)], True),
        ([(0, 1, 1), (1, 1, 1)], True),
        ([(0, 1, 1)], False),
        ([(1, 1, 1)], False),
        ([(0, 0, 1, 1), (1, 0, 1, 1), (0, 1, 1, 1), (1, 1, 1, 1, 1)], True),
        ([(0, 0, 1, 1), (1, 0, 1, 1), (1, 1, 1, 1, 1)], False),
        ([(0, 0, 1, 1), (0, 1, 1, 1), (1, 1, 1, 1, 1)], False),
        ([], False),
        ([(0, 0)], False),
    ],
)
def test_never_twice(words, expected):
    assert never_twice(words) is expected


# -- cones and boxes -------------------------------------------------------------------------------


@pytest.mark.slow
def test_cones_against_random_vectors():
    """Where the cone condition is accepted, Q grows for all vectors, and the rates hold."""
    random.seed(7)
    accepted = 0
    for _ in range(300):
        middle = [random.uniform(-1, 8), *(random.uniform(-1, 1) for _ in range(3))]
        reach = [random.uniform(0, 0.3) for _ in range(4)]
        p, q, r, s = (pair_of(m - w, m + w) for m, w in zip(middle, reach, strict=True))
        entries = ((p, q), (r, s))
        if not in_cones(entries) or p[0] <= max(abs(x) for x in r):
            continue
        accepted += 1
        expansion, contraction = growth(entries)
        slope = stable_slope(entries)
        for _ in range(50):
            a, b, c, d = (random.choice((x[0], x[1])) for x in (p, q, r, s))
            x, y = Fraction(random.uniform(-1, 1)), Fraction(random.uniform(-1, 1))
            u, v = a * x + b * (2 * y), (c * x + d * (2 * y)) / 2  # velocities in units of 2
            assert u * u - v * v > x * x - y * y
            if abs(y) <= abs(x):
                assert abs(u) >= expansion * abs(x)
            if abs(u) <= abs(v):
                assert abs(x) <= slope * abs(y)
                assert abs(v) <= contraction * abs(y)
    assert accepted > 30


def test_reversing_maps_are_not_taken():
    rest = pair_of(0, 0)
    assert in_cones(((pair_of(5, 6), rest), (rest, rest)))
    assert not in_cones(((pair_of(-6, -5), rest), (rest, rest)))


def test_boxes_merge_only_along_one_side():
    a, b, c = pair_of(0, 1), pair_of(1, 2), pair_of(3, 4)
    assert merged([(a, a, a), (b, a, a), (a, b, a)]) in (
        [((Fraction(0), Fraction(2)), a, a), (a, b, a)],
        [(a, b, a), ((Fraction(0), Fraction(2)), a, a)],
        [(a, (Fraction(0), Fraction(2)), a), (b, a, a)],
        [(b, a, a), (a, (Fraction(0), Fraction(2)), a)],
    )
    assert merged([(a, a, a), (c, a, a)]) == [(a, a, a), (c, a, a)]
    assert merged([(a, a, a), (b, b, a)]) == [(a, a, a), (b, b, a)]
    assert merged([(a, a, a), (a, a, a)]) == [(a, a, a)]
