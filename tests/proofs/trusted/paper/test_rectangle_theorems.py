"""The theorems of section 3.3 on what is invented about F: each hypothesis is asked for."""

from dataclasses import replace
from fractions import Fraction

import pytest

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.differential import Differential
from proofs.trusted.kernel.horseshoe import Horseshoe
from proofs.trusted.kernel.rates import Cone, Rates, rates
from proofs.trusted.kernel.rectangles import Rectangle
from proofs.trusted.kernel.words import BarredWord, never_ends
from proofs.trusted.numbers import Phases
from proofs.trusted.oscillator import Oscillator, PlasticMap
from proofs.trusted.paper import find
from proofs.trusted.paper.s33_restitution.horseshoes import (
    HorseshoeFamily,
    RectangleHorseshoe,
    hyperbolic,
    restituting,
    shoes,
)
from proofs.trusted.paper.s33_restitution.rectangles import ALL, BY_LAST, Blocks, Strips
from proofs.trusted.paper.s33_restitution.words import GoldenMean, golden_mean
from proofs.trusted.parameters import PAPER, Place
from proofs.trusted.rules import find_rule
from proofs.trusted.verdicts import Verdict

HERE = Place(*((Fraction(1, 2),) * 2,) * 3)
GAMMA = (Fraction(-1), Fraction(1))
LEFT, RIGHT = (Fraction(1), Fraction(5, 4)), (Fraction(7, 4), Fraction(2))


def pair_of(low, high):
    return Fraction(low), Fraction(high)


def prove(rule, known, **witness):
    """What a rule concludes from conclusions by name."""
    return find_rule(rule)(Context(PAPER, {}, dict(known)), Reader(witness))


def moved(conclusion, place):
    """The same about other oscillators."""
    if isinstance(conclusion, Horseshoe | BarredWord | Rectangle | Differential):
        return replace(conclusion, function=Oscillator(place.sides))
    return replace(conclusion, at=place)


# -- what a horseshoe of a map means for F ---------------------------------------------------------

BOXES = (LEFT, GAMMA), (RIGHT, GAMMA)
COMING = {1: pair_of("-1/50", "1/20"), 2: pair_of("3/50", "3/25")}
FOUR = tuple((phases, COMING[band]) for band in (1, 2) for phases in (LEFT, RIGHT))
RATES = Rates(Fraction(5), Fraction(1, 10))


def general(boxes=BOXES, arrows=ALL, place=HERE, is_rising=True, is_complete=True, cone=None):
    known = RATES if cone is None else RATES._replace(cone=cone)
    return Horseshoe(
        Oscillator(place.sides), boxes, arrows, Fraction(1, 8), known, is_rising, is_complete
    )


def test_two_rectangles():
    strips = Strips(Phases(*LEFT), Phases(*RIGHT), GAMMA)
    assert restituting(general()) == RectangleHorseshoe(HERE, strips, Fraction(1, 8), RATES)
    assert restituting(general(is_rising=False, is_complete=False)).strips == strips


def test_four_rectangles():
    found = restituting(general(FOUR, BY_LAST, cone=Cone(Fraction(1, 50), Fraction(1))))
    boxes = [(Phases(*phases), velocities) for phases, velocities in FOUR]
    assert found.strips == Blocks(tuple(boxes[:2]), tuple(boxes[2:]))
    assert "V1 = [1, 1.25] x [-0.02, 0.05] union [1, 1.25] x [0.06, 0.12]" in found.sentence
    assert "|dgamma - 0.02 dphi| <= 1 |dphi|" in found.sentence
    assert "both rectangles of V1 across the first ones" in found.sentence
    assert "each across both" not in found.sentence  # no image of V1 has states of the second ones


PLASTIC = replace(HERE, epsilon=pair_of(0, "1/2"))


@pytest.mark.parametrize(
    ("shoe", "reason"),
    [
        (general(BOXES[:1], ((0,),)), "one height"),
        (general(arrows=((0, 1), (0,))), "one height"),
        (general((BOXES[0], (RIGHT, COMING[1]))), "one height"),
        (general(BOXES[::-1]), "overlap"),
        (general(((pair_of(-1, 0), GAMMA), BOXES[1])), "no interval of phases"),
        (general(FOUR, BY_LAST, is_complete=False), "first and a second"),
        (general(FOUR, BY_LAST[::-1]), "first and a second"),
        (general(FOUR[2:] + FOUR[2:], BY_LAST), "apart"),
        (general((FOUR[1], FOUR[0], *FOUR[2:]), BY_LAST), "overlap"),
        (general(FOUR, BY_LAST, PLASTIC), "two rectangles are needed"),
        (general(place=PLASTIC, is_rising=False), "increase"),
    ],
)
def test_what_means_nothing_for_f(shoe, reason):
    with pytest.raises(Unproved, match=reason):
        restituting(shoe)
    assert shoes([shoe]) == []


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


# -- boxes of oscillators --------------------------------------------------------------------------


def test_a_union_is_of_horseshoes_of_either_kind():
    half = replace(HERE, nu=pair_of("1/2", "3/4"))
    (found,) = shoes([word("0011"), general(), restituting(general(place=half))])
    assert found.at == half


NEXT, AFTER, HOLE = pair_of("2/10", "3/10"), pair_of("1/4", "1/2"), pair_of("21/100", "3/10")


def test_boxes_join_along_a_side_with_the_worst_bounds():
    parts = [shoe(), shoe(nu=NEXT, margin="1/9", contraction="1/3"), shoe(nu=AFTER, expansion=4)]
    (found,) = shoes(parts)
    assert shoes(parts[::-1]) == [found] == shoes([parts[0], parts[2], parts[1]])
    assert found == shoe(nu=pair_of("1/10", "1/2"), margin="1/9", contraction="1/3", expansion=4)
    assert shoes([shoe(), shoe()]) == [shoe()]


def test_quarters_join_by_halves():
    (found,) = shoes(shoe(eta, nu) for eta in (UNIT, NEXT) for nu in (UNIT, NEXT))
    assert found.at == Place(*[pair_of("1/10", "3/10")] * 2, UNIT)


@pytest.mark.parametrize(
    "parts",
    [
        [shoe(), shoe(nu=HOLE)],
        [shoe(), shoe(eta=HOLE)],
        [shoe(), shoe(epsilon=HOLE)],
        [shoe(), shoe(eta=NEXT, nu=NEXT)],
        [shoe(), shoe(eta=NEXT), shoe(nu=NEXT)],  # an L is no box
        [shoe(), shoe(nu=NEXT, left=pair_of("9/8", "5/4"))],
        [
            shoe(),
            replace(shoe(nu=NEXT), rates=Rates(Fraction(5), Fraction(0), Cone(*pair_of(1, 2)))),
        ],
    ],
)
def test_boxes_that_do_not_join(parts):
    assert len(shoes(parts)) > 1


# -- the golden mean -------------------------------------------------------------------------------


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
    assert never_ends([tuple(map(int, word)) for word in words], (1, 1), 2) is expected


STEEP = ((pair_of(5, 6), pair_of("1/50", "1/20")), (pair_of("-1/2", "1/2"), pair_of(0, "1/200")))
EXACT = Place((PAPER.eta,) * 2, (PAPER.nu,) * 2, (PAPER.epsilon,) * 2)
PRINTED = Strips(Phases(*PAPER.left), Phases(*PAPER.right), PAPER.velocities)


def printed(phases, left="1.10", right="1.33", place=EXACT, derivative=STEEP):
    """What could be known about F on a rectangle: on the printed ones, a horseshoe."""
    velocity, map_ = pair_of("-0.43", "-0.23"), Oscillator(place.sides)
    edges = tuple((pair_of(end, end), velocity) for end in (left, right))
    box, image = (pair_of(*phases), PAPER.velocities), (pair_of(*sorted((left, right))), velocity)
    return Rectangle(map_, box, (0,), (Differential(map_, box, (0,), image, derivative),), edges)


def word(symbols, place=EXACT, sets=PRINTED):
    symbols = tuple(map(int, symbols))
    return BarredWord(Oscillator(place.sides), sets.boxes, symbols, Fraction(1, 100))


V1 = printed(PAPER.left, "1.10", "1.30")
V2 = printed(PAPER.right, "1.06", "1.30")
PART = printed(("1.27", "1.293"), "1.06", "1.17")
WORDS = [word(symbols) for symbols in ("0011", "1011", "0111", "1111")]
FALLS = ((pair_of(-6, -5), STEEP[0][1]), STEEP[1])
OTHER = replace(EXACT, eta=pair_of("0.2", "0.2"))


def test_what_is_proved_of_the_plastic_map_is_no_image_of_an_edge():
    """In an oscillator with epsilon = 0, where f is meant as well."""
    of = replace(PAPER, epsilon=Fraction(0), reach=None)
    phase = of.left[0]
    known = Differential(PlasticMap(of.place), ((phase,) * 2,), (4,), (pair_of("1.2", "1.3"),), ())
    assert known.place.holds(of)
    for claim in ("N1", "N4"):
        decision = find(claim).decide(of, [known])
        assert decision.verdict is Verdict.UNDECIDED and "no proof about F" in decision.why


LEFT_CORNER = ("1.11", "0", ("1.2", "1.21"), 4)


@pytest.mark.parametrize(
    ("other", "verdict"),
    [
        (("1.15", "-0.45", ("1.3", "1.31"), 4), Verdict.REFUTED),
        (("1.15", "-0.45", ("7.6", "7.603"), 4), Verdict.REFUTED),  # 1.32 + 2 pi = 7.60318...
        (("1.15", "-0.45", ("7.603", "7.604"), 4), Verdict.UNDECIDED),  # across, a turn later
        (("1.15", "-0.45", ("-5.174", "-5.1"), 4), Verdict.UNDECIDED),  # across, turned over
        (("1.15", "-0.45", ("1.3", "1.31"), 5), Verdict.UNDECIDED),
        (("1.32", "-0.45", ("1.33", "1.34"), 4), Verdict.UNDECIDED),  # an edge of V2
        (("1.11", "-0.45", ("1.2", "1.21"), 4), Verdict.UNDECIDED),  # of the same edge
        (None, Verdict.UNDECIDED),
    ],
)
def test_an_edge_that_falls_short_is_not_beyond_in_another_turn(other, verdict):
    """By one corner of a rectangle the other edge may be any number of turns away."""
    at = Place.restituting(PAPER.eta, PAPER.nu, PAPER.epsilon)
    found = [
        Differential(
            Oscillator(at.sides),
            (pair_of(phase, phase), pair_of(gamma, gamma)),
            (turns,),
            (pair_of(*image), GAMMA),
            (),
        )
        for phase, gamma, image, turns in filter(None, (LEFT_CORNER, other))
    ]
    assert find("N1").decide(PAPER, found).verdict is verdict
    assert find("N1").decide(PAPER, found[::-1]).verdict is verdict


def golden(first=V1, second=V2, part=PART, words=WORDS, names=("a", "b")):
    known = {"a": first, "b": second, "n": part} | {f"w{n}": x for n, x in enumerate(words)}
    wider = {"rectangles": [*names], "words": [name for name in known if name[0] == "w"]}
    arrows, cone = [["1", "2"], ["1"]], ["0", "2"]
    witness = {"rectangles": ["a", "n"], "arrows": arrows, "cone": cone, "wider": wider}
    return golden_mean(prove("horseshoe", known, **witness))


def test_golden_mean():
    assert golden() == GoldenMean(EXACT, PRINTED, rates([*V1.parts, *PART.parts]))
    assert "without 22" in golden().sentence and str(PRINTED) in golden().sentence


@pytest.mark.every
@pytest.mark.parametrize(
    "change",
    [
        {"words": WORDS[1:]},
        {"words": WORDS[:-1]},
        {"words": [*WORDS[1:], moved(WORDS[0], OTHER)]},
        {"words": [replace(x, boxes=((LEFT, GAMMA), (RIGHT, GAMMA))) for x in WORDS]},
        {"words": [replace(x, boxes=(V1.box, PART.box)) for x in WORDS]},
        {"part": printed(("1.271", "1.293"), "1.06", "1.17")},
        {"part": printed(("1.27", "1.293"), "1.06", "1.14")},
        {"part": replace(PART, turns=(1,))},
        {"part": printed(("1.27", "1.31"), "1.06", "1.17")},  # V1 does not reach it
        {
            "first": printed(PAPER.left, "1.06", "1.34"),
            "part": printed(("1.27", "1.325"), "1.06", "1.17"),
        },
        {"part": replace(PART, box=(PART.box[0], GAMMA))},
        {"part": moved(PART, OTHER)},
        {"second": printed(PAPER.right, "1.06", "1.30", derivative=((pair_of(-1, 6),) * 2,) * 2)},
        {"first": printed(PAPER.left, "1.12", "1.30")},
        {"first": printed(PAPER.left, "1.30", "1.10", derivative=FALLS)},
        {
            "second": printed(PAPER.right, "1.30", "1.06", derivative=FALLS),
            "part": printed(("1.27", "1.293"), "1.17", "1.06", derivative=FALLS),
        },
    ],
)
def test_golden_mean_needs_all(change):
    with pytest.raises(Unproved):
        golden(**change)


@pytest.mark.parametrize("names", ["a", "aba"])
def test_golden_mean_needs_two_rectangles(names):
    with pytest.raises(Unproved, match=r"one for each|overlap"):
        golden(names=names)


def test_golden_mean_needs_restitution():
    place = replace(EXACT, epsilon=pair_of(0, "0.01"))
    with pytest.raises(Unproved, match="restitution"):
        golden(*(moved(x, place) for x in (V1, V2, PART)), [moved(x, place) for x in WORDS])


# -- distances -------------------------------------------------------------------------------------

NONE = pair_of(0, 0)


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
        hyperbolic((V1, printed(PAPER.right, "1.06", "1.30", derivative=derivative)))


def test_distances_are_of_two_rectangles_of_one_height():
    with pytest.raises(Unproved, match="velocities"):
        hyperbolic((V1, replace(V2, box=(V2.box[0], GAMMA))))
    with pytest.raises(Unproved, match="different maps"):
        hyperbolic((V1, moved(V2, OTHER)))
