"""The theorems of section 3.3 on maps with known answers: no oscillator here."""

import random
from dataclasses import replace
from fractions import Fraction
from itertools import product

import pytest

from proofs.trusted.certificate import Malformed, Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.context import Context
from proofs.trusted.numbers import Phases
from proofs.trusted.paper.s33_restitution.cones import Cone, Rates, rates
from proofs.trusted.paper.s33_restitution.horseshoes import (
    HorseshoeFamily,
    RectangleHorseshoe,
    hyperbolic,
)
from proofs.trusted.paper.s33_restitution.rebounds import Rebound, RectangleMap
from proofs.trusted.paper.s33_restitution.rectangles import Blocks, Strips, crossing
from proofs.trusted.paper.s33_restitution.words import BarredWord, GoldenMean, never_twice
from proofs.trusted.parameters import PAPER, Place
from proofs.trusted.rules import find_rule

HERE = Place(*((Fraction(1, 2),) * 2,) * 3)
GAMMA = (Fraction(-1), Fraction(1))
LEFT, RIGHT = (Fraction(1), Fraction(5, 4)), (Fraction(7, 4), Fraction(2))


def pair_of(low, high):
    return Fraction(low), Fraction(high)


def prove(rule, known, **witness):
    """What a rule concludes from conclusions by name."""
    return find_rule(rule)(Context(PAPER, {}, dict(known)), Reader(witness))


def linear(phases, slope=5, shift=0, velocities=GAMMA, turns=0, at=HERE, skew=0, shrink=0):
    """F(1 + x, gamma) = (1 + slope x + shift + skew gamma, x/10 + shrink gamma), exactly."""
    offsets = [phi - 1 for phi in phases]
    images = [1 + slope * x + shift + skew * gamma for x, gamma in product(offsets, velocities)]
    arrivals = [x / 10 + shrink * gamma for x, gamma in product(offsets, velocities)]
    (p, q), (r, s) = (
        [(Fraction(x), Fraction(x)) for x in row]
        for row in ((slope, skew), (Fraction(1, 10), shrink))
    )
    value = (min(images), max(images)), (min(arrivals), max(arrivals))
    return Rebound(at, phases, velocities, turns, *value, ((p, q), (r, s)))


def rectangle(parts, edges):
    known = {f"part-{n}": part for n, part in enumerate(parts)}
    known |= {f"edge-{n}": edge for n, edge in enumerate(edges)}
    names = sorted(known)
    return prove(
        "rectangle",
        known,
        parts=[name for name in names if "part" in name],
        edges=[name for name in names if "edge" in name],
    )


def joined(phases, shift=0, **more):
    """The rectangle from two halves and the edges."""
    middle = sum(phases) / 2
    parts = [
        linear(side, shift=shift, **more) for side in ((phases[0], middle), (middle, phases[1]))
    ]
    return rectangle(parts, [linear((end, end), shift=shift, **more) for end in phases])


# The images of LEFT and RIGHT are [7/8, 17/8], of length 5/4.
ELSEWHERE = replace(HERE, eta=pair_of(2, 2))
TRUE = {"left": Fraction(-1, 8), "right": Fraction(-31, 8)}


def horseshoe(*maps, cone=("0", "2")):
    known = {f"map-{n}": each for n, each in enumerate(maps)}
    return prove("rectangle-horseshoe", known, rectangles=list(known), cone=list(cone))


def known_as(rectangle, **change):
    """A rectangle of which other things are known, as of one part."""
    found = replace(rectangle, **change)
    names = ("at", "phases", "velocities", "turns", "phase", "velocity", "derivative")
    return replace(found, parts=(Rebound(*(getattr(found, name) for name in names)),))


def test_linear_horseshoe():
    found = horseshoe(joined(LEFT, TRUE["left"]), joined(RIGHT, TRUE["right"]))
    expected = Strips(Phases(*LEFT), Phases(*RIGHT), GAMMA)
    assert found == RectangleHorseshoe(
        HERE, expected, Fraction(1, 8), Rates(Fraction(5), Fraction(0))
    )


def test_skew_costs_margin_and_rates():
    skew = Fraction(1, 16)
    found = horseshoe(
        *(
            joined(phases, shift, skew=skew, shrink=Fraction(1, 50))
            for phases, shift in ((LEFT, TRUE["left"]), (RIGHT, TRUE["right"]))
        )
    )
    assert found.margin == Fraction(1, 16)
    assert found.rates.expansion == 5 - 2 * skew
    assert 0 < found.rates.contraction < Fraction(3, 100)


@pytest.mark.parametrize(
    "shifts",
    [
        (Fraction(0), TRUE["right"]),  # the left edge stays
        (Fraction(-1, 4), TRUE["right"]),  # the right one falls short
        (TRUE["left"], Fraction(-4)),
        (TRUE["left"] + 3, TRUE["right"]),
    ],
)
def test_an_edge_that_is_not_beyond(shifts):
    with pytest.raises(Unproved, match="not mapped beyond"):
        horseshoe(joined(LEFT, shifts[0]), joined(RIGHT, shifts[1]))


NONE = (Fraction(0), Fraction(0))


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"velocity": pair_of(-1, 0)}, "interior"),
        ({"velocity": pair_of(0, 1)}, "interior"),
        ({"velocities": pair_of(-2, 1)}, "different"),
        ({"at": replace(HERE, eta=pair_of("1/2", 2))}, "different"),
        ({"phases": Phases(*pair_of("1/2", "5/4"))}, None),
        ({"phases": Phases(*pair_of(1, "15/8"))}, "overlap"),
        ({"derivative": ((pair_of(-1, 5), NONE), (NONE, NONE))}, "monotone"),
        ({"derivative": ((pair_of("1/2", 5), NONE), (NONE, NONE))}, "hyperbolic"),
        ({"derivative": ((pair_of(5, 5), pair_of(-9, 9)), (pair_of(-1, 1),) * 2)}, "cone"),
        ({"derivative": ((pair_of(5, 5), NONE), (pair_of(10, 10), NONE))}, "cone"),
        ({"derivative": ((pair_of(5, 5), NONE), (NONE, pair_of(1, 1)))}, "hyperbolic"),
        ({"derivative": ((pair_of("6/5", 5), NONE), (pair_of(3, 3), NONE))}, "cone"),
        ({"right": pair_of("17/8", 9)}, "around the circle"),
        ({"left": pair_of(-8, "7/8")}, "around the circle"),
    ],
)
def test_hypotheses_of_a_horseshoe(change, reason):
    left, right = joined(LEFT, TRUE["left"]), joined(RIGHT, TRUE["right"])
    with pytest.raises(Unproved, match=reason):
        horseshoe(known_as(left, **change), right)


FALLING = {"left": Fraction(9, 8), "right": Fraction(39, 8)}


@pytest.mark.parametrize("both", [True, False])
def test_where_the_next_phase_decreases(both):
    """The same horseshoe, by the edges in the other order; for epsilon > 0, and not for words."""
    rising = joined(LEFT, TRUE["left"]), joined(RIGHT, TRUE["right"])
    falls = joined(LEFT, FALLING["left"], slope=-5), joined(RIGHT, FALLING["right"], slope=-5)
    maps = falls if both else (rising[0], falls[1])
    assert horseshoe(*maps) == horseshoe(*rising)
    with pytest.raises(Unproved, match="beyond"):  # its edges are where they would be if not
        horseshoe(maps[0], known_as(maps[1], left=maps[1].right, right=maps[1].left))
    with pytest.raises(Unproved, match="beyond"):
        horseshoe(maps[0], joined(RIGHT, FALLING["right"] - Fraction(1, 4), slope=-5))
    plastic = replace(HERE, epsilon=pair_of(0, "1/2"))
    with pytest.raises(Unproved, match="increase"):
        horseshoe(*(replace(each, at=plastic) for each in maps))


def test_rectangles_in_the_other_order():
    with pytest.raises(Unproved, match="overlap"):
        horseshoe(joined(RIGHT, TRUE["right"]), joined(LEFT, TRUE["left"]))


def test_arrows_ask_for_less():
    """Images that reach only 7/4: the second rectangle is reached by the first alone."""
    maps = joined(LEFT, TRUE["left"]), joined(RIGHT, TRUE["right"] - Fraction(1, 4))
    with pytest.raises(Unproved):
        crossing(maps, ((0, 1), (0, 1)))
    assert crossing(maps, ((0, 1), (0,))) == Fraction(1, 8)


# -- four rectangles: where a state comes from -----------------------------------------------------

# images of LEFT have velocities in [0, 1/40], those of RIGHT in [3/40, 1/10]
COMING = {1: pair_of("-1/50", "1/20"), 2: pair_of("3/50", "3/25")}


def four(sets=((LEFT, 1), (RIGHT, 1), (LEFT, 2), (RIGHT, 2)), **more):
    shifts = {LEFT: TRUE["left"], RIGHT: TRUE["right"]}
    return [
        joined(phases, shifts[phases], velocities=COMING[band], **more) for phases, band in sets
    ]


def test_four_rectangles():
    found = horseshoe(*four(), cone=("1/50", "1"))
    boxes = [(Phases(*LEFT), COMING[1]), (Phases(*RIGHT), COMING[1])]
    after_second = [(phases, COMING[2]) for phases, _ in boxes]
    assert found.strips == Blocks(tuple(boxes), tuple(after_second))
    assert found.margin == Fraction(1, 8)
    assert found.rates[:2] == (5, 0) and found.rates.cone == Cone(Fraction(1, 50), Fraction(1))
    assert "V1 = [1, 1.25] x [-0.02, 0.05] union [1, 1.25] x [0.06, 0.12]" in found.sentence
    assert "|dgamma - 0.02 dphi| <= 1 |dphi|" in found.sentence
    assert "both rectangles of V1 across the first ones" in found.sentence
    assert "each across both" not in found.sentence  # no image of V1 has states of the second ones


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        (lambda x: x[2:] + x[:2], "not next"),  # images have the other velocities
        (lambda x: [x[1], x[0], x[3], x[2]], "overlap"),
        (lambda x: [x[0], x[1], x[0], x[1]], "apart"),
        (lambda x: [x[0], x[1], x[2], replace(x[3], at=ELSEWHERE)], "oscillators"),
        (lambda x: [*x[:3], known_as(x[3], velocity=pair_of("-1/100", "1/10"))], "not next"),
        (lambda x: [known_as(x[0], velocity=pair_of(0, "1/10")), *x[1:]], "not next"),
        (lambda x: [known_as(x[0], velocity=pair_of(0, "1/20")), *x[1:]], "interior"),
        (lambda x: [*x[:2], replace(x[2], left=pair_of(1, 1)), x[3]], "not mapped beyond"),
        (lambda x: [x[0], replace(x[1], right=pair_of(2, 2)), *x[2:]], "not mapped beyond"),
        (lambda x: [*x[:3], known_as(x[3], derivative=((pair_of(-1, 5), NONE),) * 2)], "monotone"),
        (
            lambda x: [
                *x[:3],
                known_as(x[3], derivative=((pair_of(5, 5), NONE), (pair_of(11, 11), NONE))),
            ],
            "cone",
        ),
        (
            lambda x: [replace(y, at=replace(HERE, epsilon=pair_of(0, "1/2"))) for y in x],
            "restitution",
        ),
    ],
)
def test_hypotheses_of_four_rectangles(change, reason):
    maps = four()
    horseshoe(*maps)
    with pytest.raises(Unproved, match=reason):
        horseshoe(*change(maps))


def test_three_rectangles_are_none():
    with pytest.raises(Malformed, match="two or four"):
        horseshoe(*four()[:3])


UNIT = pair_of("1/10", "2/10")


def shoe(eta=UNIT, nu=UNIT, epsilon=UNIT, margin="1/8", expansion=5, contraction=0, left=LEFT):
    sets = Strips(Phases(*left), Phases(*RIGHT), GAMMA)
    both = Rates(Fraction(expansion), Fraction(contraction))
    return RectangleHorseshoe(Place(eta, nu, epsilon), sets, Fraction(margin), both)


# -- as epsilon grows ------------------------------------------------------------------------------

POINT = pair_of("1/10", "1/10")


def at_epsilon(low, high, **more):
    return shoe(POINT, POINT, pair_of(low, high), **more)


def test_a_family_has_the_worst_bounds():
    family = HorseshoeFamily(
        (at_epsilon(0, "1/10", expansion=4), at_epsilon("1/10", "1/5", margin="1/9"))
    )
    assert family.at == Place(POINT, POINT, pair_of(0, "1/5"))
    assert "edges overshoot by at least 0.111111" in family.sentence
    assert "from 0 to 0.2; edges overshoot by at least 0.111111" in family.brief
    assert "stretched at least 4 times" in family.sentence and "f' >= 4;" in family.sentence


def test_a_family_names_all_its_sets():
    one, two = at_epsilon(0, "1/10"), at_epsilon("1/8", "1/5", left=(Fraction(9, 10), LEFT[1]))
    sentence = HorseshoeFamily((one, at_epsilon("1/10", "1/8"), two)).sentence
    assert f"epsilon in [0, 0.1]: {one.strips.named}, e = 0; epsilon in [0.1, 0.125]: " in sentence
    assert f"epsilon in [0.125, 0.2]: {two.strips.named}, e = 0. All" in sentence
    assert HorseshoeFamily((one,)).sentence.count(one.strips.named) == 1


@pytest.mark.parametrize(
    "shoes",
    [
        (),
        (at_epsilon("1/100", "1/10"),),
        (at_epsilon(0, "1/10"), at_epsilon("1/9", "1/5")),
        (at_epsilon(0, "1/10"), at_epsilon("1/11", "1/5")),
        (at_epsilon("1/10", "1/5"), at_epsilon(0, "1/10")),
        (at_epsilon(0, 0),),
        (at_epsilon(0, "1/10"), shoe(POINT, pair_of("1/5", "1/5"), pair_of("1/10", "1/5"))),
        (shoe(POINT, UNIT, pair_of(0, "1/10")),),
    ],
)
def test_what_is_no_family(shoes):
    with pytest.raises(Unproved):
        HorseshoeFamily(shoes)


# -- rectangles ------------------------------------------------------------------------------------

PARTS = [linear(pair_of(1, "9/8")), linear(pair_of("9/8", "5/4"))]
ENDS = [linear(pair_of(1, 1)), linear(pair_of("5/4", "5/4"))]


def test_rectangle_joins():
    found = rectangle(PARTS, ENDS)
    assert (found.phases, found.velocities) == (LEFT, GAMMA)
    assert (found.left, found.right) == ((1, 1), (Fraction(9, 4), Fraction(9, 4)))
    assert found.velocity == (0, Fraction(1, 40))
    wide = rectangle([linear(pair_of("9/10", "3/2"))], ENDS)  # a part may be larger
    assert wide.phases == LEFT and wide.velocity[1] > found.velocity[1]


@pytest.mark.parametrize(
    ("parts", "edges"),
    [
        (PARTS[:1], ENDS),
        (PARTS[1:], ENDS),
        (PARTS[::-1], ENDS),
        (PARTS, ENDS[::-1]),
        (PARTS, PARTS),
        ([PARTS[0], linear(pair_of("126/100", 2))], ENDS),
        ([linear(pair_of(1, "112/100")), PARTS[1]], ENDS),
        ([linear(pair_of(1, "9/8"), velocities=pair_of(-1, "1/2")), PARTS[1]], ENDS),
        ([linear(pair_of(1, "9/8"), turns=1), PARTS[1]], ENDS),
        ([linear(pair_of(1, "9/8"), at=ELSEWHERE), PARTS[1]], ENDS),
        (PARTS, [ENDS[0], linear(pair_of("5/4", "5/4"), turns=1)]),
        (PARTS, [linear(pair_of(1, 1), at=ELSEWHERE), ENDS[1]]),
        (PARTS, [ENDS[0], linear(pair_of("5/4", "5/4"), velocities=pair_of(0, 1))]),
        (PARTS, ENDS[:1] * 2),  # no width
    ],
)
def test_parts_that_do_not_join(parts, edges):
    with pytest.raises(Unproved):
        rectangle(parts, edges)


# -- boxes of oscillators --------------------------------------------------------------------------


def union(*parts):
    known = {f"part-{n}": part for n, part in enumerate(parts)}
    return prove("horseshoe-union", known, parts=list(known))


NEXT, AFTER, HOLE = pair_of("2/10", "3/10"), pair_of("1/4", "1/2"), pair_of("21/100", "3/10")


def test_boxes_join_along_a_side_with_the_worst_bounds():
    found = union(
        shoe(), shoe(nu=NEXT, margin="1/9", contraction="1/3"), shoe(nu=AFTER, expansion=4)
    )
    assert found == shoe(nu=pair_of("1/10", "1/2"), margin="1/9", contraction="1/3", expansion=4)
    assert union(shoe(), shoe()) == shoe()


def test_quarters_join_by_halves():
    halves = [union(shoe(eta, UNIT), shoe(eta, NEXT)) for eta in (UNIT, NEXT)]
    assert union(*halves).at == Place(*[pair_of("1/10", "3/10")] * 2, UNIT)


@pytest.mark.parametrize(
    "parts",
    [
        [shoe(), shoe(nu=HOLE)],
        [shoe(), shoe(eta=HOLE)],
        [shoe(), shoe(epsilon=HOLE)],
        [shoe(), shoe(eta=NEXT, nu=NEXT)],
        [shoe(), shoe(eta=NEXT), shoe(nu=NEXT)],  # an L is no box
        [shoe(), shoe(nu=NEXT, left=pair_of("9/8", "5/4"))],
    ],
)
def test_boxes_that_do_not_join(parts):
    with pytest.raises(Unproved):
        union(*parts)


# -- words -----------------------------------------------------------------------------------------

# slope 5 on RIGHT: 2 goes to 1.98, that to 1.88, that to 1.38
SHORT = Fraction(-5) + 1 - Fraction(1, 50)
BOUNDS = ["2", "1.98", "1.88"]


def short_pair():
    return joined(LEFT, TRUE["left"]), joined(RIGHT, SHORT)


def at(phase, shift=SHORT):
    return linear(pair_of(phase, phase), shift=shift)


def barred(images, maps, word, above=True):
    known = {"a": maps[0], "b": maps[1]} | {f"image-{n}": each for n, each in enumerate(images)}
    return prove(
        "barred-word",
        known,
        rectangles=["a", "b"],
        word=word,
        images=[f"image-{n}" for n in range(len(images))],
        **{"from": "above" if above else "below"},
    )


def test_constant_word():
    """phi <= 2 goes to at most 1.98, that to 1.88, that to 1.38 < 7/4."""
    found = barred([*map(at, BOUNDS)], short_pair(), "1111")
    assert (found.short, found.word) == (Fraction("0.37"), (1, 1, 1, 1))
    for count in (1, 2):
        with pytest.raises(Unproved, match="not excluded"):
            barred([*map(at, BOUNDS[:count])], short_pair(), "1" * (count + 1))


@pytest.mark.parametrize(
    ("word", "bounds", "above"),
    [
        ("1111", ["2", "1.97", "1.88"], True),  # 1.98 is possible
        ("1111", ["2", "1.98", "1.87"], True),
        ("1111", ["1.98", "1.98", "1.88"], True),
        ("1111", ["2.1", "1.98", "1.88"], True),  # outside the rectangle
        ("1110", BOUNDS, True),  # 1.38 does not exclude the left one
        ("111", BOUNDS, True),
        ("1", [], True),
        ("1111", ["7/4", "7/4", "7/4"], False),  # nothing is excluded from below
        ("22", ["2"], True),
        ("1" * 11, ["2"] * 10, True),
    ],
)
def test_words_that_are_not_barred(word, bounds, above):
    with pytest.raises((Unproved, Malformed)):
        barred([*map(at, bounds)], short_pair(), word, above)


def test_word_barred_from_below():
    """The left edge of LEFT goes right of it: 1 -> 11/10 -> 16/10."""
    maps = joined(LEFT, Fraction(1, 10)), joined(RIGHT, TRUE["right"])
    images = [at(x, Fraction(1, 10)) for x in ("1", "1.1")]
    assert barred(images, maps, "000", above=False).short == Fraction(7, 20)
    with pytest.raises(Unproved):
        barred(images, maps, "000", above=True)


def changed(index, **change):
    images = [*map(at, BOUNDS)]
    images[index] = replace(images[index], **change)
    return images


@pytest.mark.parametrize(
    ("images", "reason"),
    [
        (changed(0, phases=pair_of("2.1", "2.1")), "phase of the rectangle"),  # another map there
        (changed(0, phases=pair_of("1.9", "2")), "phase of the rectangle"),
        (changed(2, turns=1), "turns"),  # another branch
        (changed(1, at=ELSEWHERE), "another oscillator"),
        (changed(0, velocities=pair_of("-1", "1/2")), "all velocities"),
        (changed(1, velocities=pair_of("8/100", 1)), "all velocities"),
    ],
)
def test_images_that_bound_nothing(images, reason):
    with pytest.raises(Unproved, match=reason):
        barred(images, short_pair(), "1111")


def test_velocities_that_leave_the_rectangle_are_not_followed():
    wide = pair_of(-2, 2)
    images = [linear(pair_of(x, x), shift=SHORT, velocities=wide) for x in BOUNDS]
    left, right = short_pair()
    assert barred(images, (left, right), "1111").short > 0
    with pytest.raises(Unproved, match="velocity"):
        barred(images, (left, replace(right, velocity=wide)), "1111")


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (["11"], True),
        (["011", "111"], True),
        (["011"], False),
        (["111"], False),
        (["0011", "1011", "0111", "11111"], True),
        (["0011", "1011", "11111"], False),
        (["0011", "0111", "11111"], False),
        ([], False),
        (["00"], False),
    ],
)
def test_never_twice(words, expected):
    assert never_twice([tuple(map(int, word)) for word in words]) is expected


# -- the golden mean -------------------------------------------------------------------------------

STEEP = ((pair_of(5, 6), pair_of("1/50", "1/20")), (pair_of("-1/2", "1/2"), pair_of(0, "1/200")))
EXACT = Place((PAPER.eta,) * 2, (PAPER.nu,) * 2, (PAPER.epsilon,) * 2)
PRINTED = Strips(Phases(*PAPER.left), Phases(*PAPER.right), PAPER.velocities)


def printed(phases, left="1.10", right="1.33", place=EXACT):
    """What could be known about F on a rectangle: on the printed ones, a horseshoe."""
    ends = pair_of(left, left), pair_of(right, right)
    velocity = pair_of("-0.43", "-0.23")
    between = ends[0][0], ends[1][1]
    states = Phases(*phases), PAPER.velocities
    return known_as(RectangleMap(place, *states, 0, between, velocity, STEEP, *ends, ()))


def word(symbols, place=EXACT, sets=PRINTED):
    return BarredWord(place, sets, tuple(map(int, symbols)), Fraction(1, 100))


V1 = printed(PAPER.left, "1.10", "1.30")
V2 = printed(PAPER.right, "1.06", "1.30")
PART = printed(pair_of("1.27", "1.293"), "1.06", "1.17")
WORDS = [word(symbols) for symbols in ("0011", "1011", "0111", "1111")]


def falling(rectangle):
    """The same images of rectangle and edges, the next phase decreasing."""
    (p, q), rows = rectangle.derivative
    sides = {"left": rectangle.right, "right": rectangle.left}
    return known_as(rectangle, derivative=(((-p[1], -p[0]), q), rows), **sides)


def golden(first=V1, second=V2, part=PART, words=WORDS):
    known = {"a": first, "b": second, "n": part} | {f"w{n}": x for n, x in enumerate(words)}
    names = [name for name in known if name.startswith("w")]
    return prove("golden-mean", known, rectangles=["a", "b"], part="n", words=names)


def test_golden_mean():
    assert golden() == GoldenMean(EXACT, PRINTED, rates([*V1.parts, *PART.parts]))
    assert "without 22" in golden().sentence and str(PRINTED) in golden().sentence


@pytest.mark.parametrize(
    "change",
    [
        {"words": WORDS[1:]},
        {"words": WORDS[:-1]},
        {"words": [*WORDS[1:], replace(WORDS[0], at=replace(EXACT, eta=pair_of("0.2", "0.2")))]},
        {"words": [replace(x, strips=replace(PRINTED, velocities=GAMMA)) for x in WORDS]},
        {"words": [replace(x, strips=replace(PRINTED, right=PART.phases)) for x in WORDS]},
        {"part": replace(PART, phases=Phases(*pair_of("1.271", "1.293")))},
        {"part": replace(PART, right=pair_of("1.14", "1.15"))},
        {"part": replace(PART, turns=1)},
        {"part": replace(PART, phases=Phases(*pair_of("1.27", "1.31")))},  # V1 does not reach it
        {"part": replace(PART, phases=Phases(*pair_of("1.27", "1.325")))},
        {"part": replace(PART, at=replace(EXACT, eta=pair_of("0.2", "0.2")))},
        {"second": replace(V2, derivative=((pair_of(-1, 6), STEEP[0][1]), STEEP[1]))},
        {"first": replace(V1, left=pair_of("1.12", "1.12"))},
        {"first": falling(V1)},
        {"second": falling(V2), "part": falling(PART)},
    ],
)
def test_golden_mean_needs_all(change):
    with pytest.raises(Unproved):
        golden(**change)


def test_golden_mean_needs_restitution():
    place = replace(EXACT, epsilon=pair_of(0, "0.01"))
    maps = [replace(each, at=place) for each in (V1, V2, PART)]
    with pytest.raises(Unproved, match="restitution"):
        golden(*maps, [replace(each, at=place) for each in WORDS])


# -- cones -----------------------------------------------------------------------------------------


def box_of(derivative):
    return known_as(V1, derivative=derivative).parts[0]


@pytest.mark.slow
def test_cones_against_random_vectors():
    """Where the cone condition is accepted, means of derivatives obey it, with the rates."""
    random.seed(7)
    accepted = 0
    for _ in range(400):
        slope = Fraction(random.randint(-20, 20), 100)
        cone = Cone(slope, Fraction(random.randint(2, 20), 10))
        parts = []
        for _ in range(2):
            p, q = random.uniform(-1, 12), random.uniform(-1, 1)
            middle = p, q, p * float(slope) + random.uniform(-1, 1), random.uniform(-0.5, 0.5)
            bounds = [pair_of(m - w, m + w) for m in middle for w in [random.uniform(0, 0.2)]]
            parts.append(tuple(map(tuple, (bounds[:2], bounds[2:]))))
        try:
            expansion, contraction, _ = rates([box_of(each) for each in parts], cone)
        except Unproved:
            continue
        accepted += 1
        for _ in range(50):
            share = Fraction(random.random())
            ends = [[random.choice(x) for row in part for x in row] for part in parts]
            a, b, c, d = (share * x + (1 - share) * y for x, y in zip(*ends, strict=True))
            x, y = Fraction(random.uniform(-1, 1)), Fraction(random.uniform(-1, 1))
            gamma = slope * x + cone.width * y
            u = a * x + b * gamma
            v = (c * x + d * gamma - slope * u) / cone.width
            if abs(y) <= abs(x):
                assert abs(u) >= expansion * abs(x) and abs(v) < abs(u)
            if abs(u) <= abs(v):
                assert abs(v) <= contraction * abs(y)
    assert accepted > 30


def test_a_slope_helps_where_images_are_steep():
    steep = box_of(((pair_of(5, 7), NONE), (pair_of(6, 8), NONE)))
    with pytest.raises(Unproved, match="cone"):
        rates([steep], Cone(Fraction(0), Fraction(1)))
    assert rates([steep], Cone(Fraction(1), Fraction(1))).expansion == 5
    for width in (0, -1):
        with pytest.raises(Unproved, match="width"):
            rates([steep], Cone(Fraction(1), Fraction(width)))


def test_rates_are_those_of_the_reversed_map():
    rising = rates([box_of(((pair_of(5, 6), NONE), (NONE, NONE)))])
    assert rates([box_of(((pair_of(-6, -5), NONE), (NONE, NONE)))]) == rising
    for ends in ((-6, 5), (-6, "-1/2"), (-6, 0)):
        with pytest.raises(Unproved):
            rates([box_of(((pair_of(*ends), NONE), (NONE, NONE)))])


@pytest.mark.parametrize(
    "derivative",
    [
        ((pair_of(50, 60), pair_of("1.2", "1.2")), STEEP[1]),  # |q| >= 1
        ((pair_of("1", 6), NONE), STEEP[1]),
        ((pair_of("0.9", 6), NONE), (NONE, NONE)),
    ],
)
def test_distances_that_do_not_grow_or_shrink(derivative):
    assert hyperbolic((V1, V2)).grow == 5
    assert hyperbolic((V1, V2)).shrink == Fraction("0.055")
    with pytest.raises(Unproved):
        hyperbolic((V1, known_as(V2, derivative=derivative)))
