"""Rectangles, horseshoes, words, stable cycles of maps with known answers: no oscillator."""

import random
from dataclasses import replace
from fractions import Fraction

import pytest

from proofs.trusted.certificate import Malformed, Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.composition import read_map
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.differential import Differential, differential_on
from proofs.trusted.kernel.horseshoe import Horseshoe
from proofs.trusted.kernel.rates import Cone, Rates, rates
from proofs.trusted.kernel.rectangles import overlap
from proofs.trusted.kernel.words import BarredWord
from proofs.trusted.rules import find_rule

HEIGHT = ("-1", "1")
LEFT, RIGHT = ("1", "5/4"), ("7/4", "2")
FULL = [["1", "2"], ["1", "2"]]


def linear(slope=5, shift="0", skew="0", shrink="0", tilt="1/10", **more):
    """F(x, y) = (1 + slope (x - 1) + shift + skew y, tilt (x - 1) + shrink y)."""
    first = f"1 + ({slope})*(x - 1) + ({shift}) + ({skew})*y"
    values = [first, f"({tilt})*(x - 1) + ({shrink})*y"]
    return read_map("F", Reader({"variables": ["x", "y"], "values": values, **more}), {})


class Proof:
    """Steps about maps, by name."""

    def __init__(self, **maps):
        self.context = Context(None, maps)

    def __call__(self, rule, name="", **witness):
        found = find_rule(rule)(self.context, Reader(witness))
        name = name or f"{rule}-{len(self.context.known)}"
        self.context.known[name] = found
        return name, found

    def rectangle(self, phases, name="", height=HEIGHT, cuts=(), function="F", **more):
        box = [list(phases), list(height)]
        return self("rectangle", name, function=function, box=box, cuts=list(cuts), **more)


# LEFT and RIGHT go to [7/8, 17/8]
def pair(left="-1/8", right="-31/8", sets=(LEFT, RIGHT), **more):
    """Two maps cannot be one: each rectangle is proved for the map whose line it is on."""
    proof = Proof(F=linear(shift=left, **more), G=linear(shift=right, **more))
    names = [proof.rectangle(ends, function=f)[0] for ends, f in zip(sets, "FG", strict=True)]
    for name in names:  # as of one map, which is linear on each of them
        known = proof.context.known[name]
        proof.context.known[name] = replace(known, function=proof.context.functions["F"])
    return proof, names


def horseshoe(proof, names, arrows=FULL, cone=("0", "2")):
    return proof("horseshoe", rectangles=names, arrows=arrows, cone=list(cone))[1]


def test_a_linear_horseshoe():
    found = horseshoe(*pair())
    assert isinstance(found, Horseshoe) and found.is_rising and found.is_complete
    assert found.margin == pytest.approx(Fraction(1, 8), abs=1e-15) and found.margin <= Fraction(
        1, 8
    )
    assert found.rates.expansion <= 5 < found.rates.expansion + Fraction(1, 10**15)
    assert found.arrows == ((0, 1), (0, 1))
    assert "V1 = [1, 1.25] x [-1, 1]" in found.sentence and "`x` x `y`" in found.sentence
    assert found.sentence.startswith("for `F(x, y) = ") and "V2 => V1, V2 => V2" in found.sentence


def test_skew_costs_margin_and_rates():
    found = horseshoe(*pair(skew="1/16", shrink="1/50"))
    assert float(found.margin) == pytest.approx(1 / 16)
    assert float(found.rates.expansion) == pytest.approx(5 - 2 / 16)
    assert 0 < found.rates.contraction < Fraction(3, 100)


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"left": "0"}, "not mapped beyond"),  # the left edge stays
        ({"left": "-1/4"}, "not mapped beyond"),  # the right one falls short
        ({"right": "-4"}, "not mapped beyond"),
        ({"sets": (LEFT, ("5/4", "2"))}, "overlap"),
        ({"slope": "0"}, "monotone"),
        ({"slope": "-5"}, "not mapped beyond"),
        ({"tilt": "6"}, "lower and the upper edge"),
        ({"tilt": "10", "shrink": "1"}, "lower and the upper edge"),
        ({"skew": "9"}, "not mapped beyond"),
        ({"shrink": "2"}, "lower and the upper edge"),
    ],
)
def test_hypotheses_of_a_horseshoe(change, reason):
    with pytest.raises(Unproved, match=reason):
        horseshoe(*pair(**change))


def test_maps_that_are_not_one():
    proof = Proof(F=linear(shift="-1/8"), G=linear(shift="-31/8"))
    names = [proof.rectangle(ends, function=f)[0] for ends, f in ((LEFT, "F"), (RIGHT, "G"))]
    with pytest.raises(Unproved, match="different maps"):
        horseshoe(proof, names)


def test_images_around_a_circle():
    """The same horseshoe where x is an angle of period 2; one of 1 is too short for the images."""
    for period, reason in (("2", None), ("1", "around the circle")):
        values = ["5*x - 17/4", "0*y"]
        data = {"variables": ["x", "y"], "values": values, "periods": {"x": period}}
        proof = Proof(F=read_map("F", Reader(data), {}))
        name, _ = proof.rectangle(("1", "5/4"), turns=["0"])
        if reason is None:
            assert horseshoe(proof, [name], [["1"]]).margin > 0
        else:
            with pytest.raises(Unproved, match=reason):
                horseshoe(proof, [name], [["1"]])


def test_arrows_ask_for_less():
    """Images of the second rectangle that reach only 15/8: it is not crossed by itself."""
    proof, names = pair(right="-33/8")
    with pytest.raises(Unproved, match="beyond"):
        horseshoe(proof, names)
    found = horseshoe(proof, names, [["1", "2"], ["1"]])
    assert found.arrows == ((0, 1), (0,)) and not found.is_complete
    assert "follow the arrows" not in found.sentence


@pytest.mark.parametrize(
    "arrows",
    [
        [["1"]],
        [["1", "3"], ["1"]],
        [[], ["1"]],
        [["0"], ["1"]],
        [["1"], ["2", "2"]],  # more paths than orbits
        [["2", "1"], ["1", "2"]],
    ],
)
def test_arrows_to_nowhere_or_twice(arrows):
    with pytest.raises(Malformed):
        horseshoe(*pair(), arrows)


# -- rectangles ------------------------------------------------------------------------------------


def test_a_rectangle_is_its_parts():
    _, found = Proof(F=linear()).rectangle(LEFT, cuts=["9/8", "6/5"])
    assert [part.box[0] for part in found.parts] == [
        (1, Fraction(9, 8)),
        (Fraction(9, 8), Fraction(6, 5)),
        (Fraction(6, 5), Fraction(5, 4)),
    ]
    assert [round(float(side), 9) for image in found.edges for side in image[0]] == [
        1,
        1,
        2.25,
        2.25,
    ]
    assert float(found.image[1][1]) == pytest.approx(1 / 40)
    assert found.sign == 1 and found.reach == (found.edges[0][0], found.edges[1][0])
    _, falls = Proof(F=linear(slope=-5)).rectangle(LEFT)
    assert falls.sign == -1 and falls.reach == (falls.edges[1][0], falls.edges[0][0])


@pytest.mark.parametrize(
    ("phases", "height", "cuts", "data"),
    [
        (("1", "1"), HEIGHT, [], {}),
        (LEFT, ("1", "1"), [], {}),
        (LEFT, HEIGHT, ["1"], {}),
        (LEFT, HEIGHT, ["5/4"], {}),
        (LEFT, HEIGHT, ["6/5", "9/8"], {}),
        (LEFT, HEIGHT, ["9/8", "9/8"], {}),
        (LEFT, HEIGHT, [], {"periods": {"y": "1"}}),
    ],
)
def test_what_is_no_rectangle(phases, height, cuts, data):
    values = ["x", "y"] if data else ["5*x", "y/10"]
    map_ = read_map("F", Reader({"variables": ["x", "y"], "values": values, **data}), {})
    turns = {"turns": ["0"]} if data else {}
    with pytest.raises(Malformed):
        Proof(F=map_).rectangle(phases, height=height, cuts=cuts, **turns)


def test_a_differential_of_a_box_and_of_a_point():
    map_ = linear(skew="1/3")
    found = Proof(F=map_)("differential", function="F", box=[["1", "2"], ["0", "1"]], bits="64")[1]
    assert [tuple(round(float(x), 9) for x in side) for side in found.values] == [
        (1, round(6 + 1 / 3, 9)),
        (0, 0.1),
    ]
    assert [[round(float(low), 9) for low, _ in row] for row in found.matrix] == [
        [5, 0.333333333],
        [0.1, 0],
    ]
    assert "is continuously differentiable for `x` in [1, 2]" in found.sentence
    point = differential_on(map_, ((Fraction(1),) * 2, (Fraction(0),) * 2), (), 192)
    assert point.values[0][1] - point.values[0][0] < Fraction(1, 2**180)


# -- words -----------------------------------------------------------------------------------------

SHORT = "-101/50 - 2"  # slope 5 on RIGHT: 2 goes to 1.98, that to 1.88, that to 1.38


def barred(word, above=True, shift=SHORT, **change):
    proof = Proof(F=linear(shift=shift, **change))
    names = [proof.rectangle(ends)[0] for ends in (LEFT, RIGHT)]
    way = {"from": "above" if above else "below"}
    return proof("barred-word", rectangles=names, word=list(word), **way)[1]


def test_a_constant_word():
    found = barred("2222")
    assert found.word == (1, 1, 1, 1) and float(found.short) == pytest.approx(0.37)
    assert found.brief.startswith("no orbit of F follows V2 V2 V2 V2: the last image misses V2 by")
    assert "V1 = [1, 1.25] x [-1, 1]" in found.sentence


@pytest.mark.parametrize(
    ("word", "above", "change"),
    [
        ("222", True, {}),
        ("22", True, {}),
        ("2221", True, {}),  # 1.38 does not exclude the left one
        ("22222", True, {}),  # a shorter word is barred
        ("2222", False, {}),  # nothing is excluded from below
        ("2", True, {}),
        ("23", True, {}),
        ("2" * 11, True, {}),
        ("2222", True, {"skew": "1/2"}),  # an orbit may come from above
        ("2222", True, {"shrink": "2"}),  # images that leave the rectangles upwards
        ("2222", True, {"slope": "-5"}),
    ],
)
def test_words_that_are_not_barred(word, above, change):
    with pytest.raises((Unproved, Malformed)):
        barred(word, above, **change)


def test_a_word_barred_from_below():
    """The left edge of LEFT goes right of it: 1 -> 11/10 -> 16/10."""
    found = barred("111", above=False, shift="1/10")
    assert float(found.short) == pytest.approx(7 / 20)
    with pytest.raises(Unproved):
        barred("111", above=True, shift="1/10")


# -- rates -----------------------------------------------------------------------------------------


def box_of(p, q=("0", "0"), r=("0", "0"), s=("0", "0")):
    rows = [tuple(tuple(map(Fraction, ends)) for ends in row) for row in ((p, q), (r, s))]
    return Differential(linear(), (), (), (), tuple(rows))


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
            parts.append([(m - w, m + w) for m in middle for w in [random.uniform(0, 0.2)]])
        try:
            expansion, contraction, _ = rates([box_of(*each) for each in parts], cone)
        except Unproved:
            continue
        accepted += 1
        for _ in range(50):
            share = Fraction(random.random())
            ends = [[Fraction(random.choice(x)) for x in part] for part in parts]
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
    steep = box_of((5, 7), r=(6, 8))
    with pytest.raises(Unproved, match="cone"):
        rates([steep], Cone(Fraction(0), Fraction(1)))
    assert rates([steep], Cone(Fraction(1), Fraction(1))).expansion == 5
    for width in (0, -1):
        with pytest.raises(Unproved, match="width"):
            rates([steep], Cone(Fraction(1), Fraction(width)))


@pytest.mark.parametrize(
    ("box", "reason"),
    [
        (((-1, 5),), "cone"),
        (((Fraction(1, 2), 5),), "hyperbolic"),
        (((5, 5), (-9, 9), (-1, 1), (-1, 1)), "cone"),
        (((5, 5), (0, 0), (10, 10)), "cone"),
        (((5, 5), (0, 0), (0, 0), (1, 1)), "hyperbolic"),
        (((Fraction(6, 5), 5), (0, 0), (3, 3)), "cone"),
    ],
)
def test_derivatives_without_rates(box, reason):
    with pytest.raises(Unproved, match=reason):
        rates([box_of(*box)])


def test_rates_are_those_of_the_reversed_map():
    rising = rates([box_of((5, 6))])
    assert rates([box_of((-6, -5))]) == rising == Rates(Fraction(5), Fraction(0))
    assert rising.said("x", "y").startswith(
        "uniformly hyperbolic: unstable directions have |dy| <="
    )


def test_boxes_that_touch_overlap():
    one, two = ((0, 1), (0, 1)), ((1, 2), (1, 2))
    assert overlap(one, two) and not overlap(one, ((1, 2), (2, 3)))


# -- stable cycles ---------------------------------------------------------------------------------

TURN = {"variables": ["x", "y"], "values": ["-y/2 + 1", "x/2"]}  # a contraction that turns
LOGISTIC = {"variables": ["x"], "values": ["16/5*x*(1 - x)"]}
SWAP = {"variables": ["x"], "values": ["2 - x - x**2/10"]}


def cycle(data, box, period="1", rounds="1", matrix=None, **turns):
    proof = Proof(F=read_map("F", Reader(data), {}))
    matrix = matrix or [[str(-(i == j)) for j in range(len(box))] for i in range(len(box))]
    orbit = {"function": "F", "period": period, "box": box, "matrix": matrix, **turns}
    return proof("stable-cycle", orbit=orbit, rounds=rounds)[1]


def test_a_fixed_point_and_a_cycle_of_two():
    found = cycle(TURN, [["7/10", "9/10"], ["3/10", "1/2"]])
    assert len(found.boxes) == 1 and "F has a 1-periodic orbit" in found.sentence
    two = cycle(LOGISTIC, [["1/2", "53/100"]], "2")
    assert len(two.boxes) == 2 and "F^2 contracts the first box" in two.sentence
    low, high = two.boxes[1][0]
    assert low <= Fraction("0.7994554904673701") <= high


@pytest.mark.parametrize(
    ("data", "box", "period", "rounds"),
    [
        (TURN, [["7/10", "79/100"], ["3/10", "1/2"]], "1", "1"),  # the fixed point is outside
        (TURN, [["7/10", "9/10"], ["3/10", "1/2"]], "2", "1"),  # its period is 1
        ({**TURN, "values": ["-y + 1", "x"]}, [["0", "1"], ["0", "1"]], "1", "1"),  # no contraction
        ({**TURN, "values": ["2*x - 1", "y/2"]}, [["9/10", "11/10"], ["-1", "1"]], "1", "1"),
        (SWAP, [["1/2", "3/2"]], "1", "1"),
        ({"variables": ["x"], "values": ["0*x"]}, [["-1", "1"]], "2", "1"),
    ],
)
def test_what_is_no_stable_cycle(data, box, period, rounds):
    with pytest.raises(Unproved):
        cycle(data, box, period, rounds)


def test_rounds_help_where_a_box_turns():
    """x -> (x + 3 y/2, -y/4 ...): the first image leaves the box, a later one does not."""
    data = {"variables": ["x", "y"], "values": ["x/2 + 2*y", "y/2 - x/100"]}
    box = [["-1", "1"], ["-1", "1"]]
    matrix = [["-50/27", "-200/27"], ["1/27", "-50/27"]]
    for others in ({}, {"matrix": matrix}, {"rounds": "8"}):
        with pytest.raises(Unproved, match="strictly inside"):
            cycle(data, box, **others)
    assert cycle(data, box, matrix=matrix, rounds="8").rounds == 8
    with pytest.raises(Unproved, match="strictly inside"):  # its period is 2
        cycle(LOGISTIC, [["1/2", "53/100"]], rounds="2", matrix=[["-1/2"]])


def test_the_points_of_a_cycle_are_different_modulo_periods():
    """0 and 1/2 are a cycle modulo 1, and one point modulo 1/2."""
    data = {"variables": ["x"], "values": ["x + 1/2 - sin(4*pi*x)/20"]}
    box = [["-1/50", "1/50"]]
    whole, half = ({**data, "periods": {"x": period}} for period in ("1", "1/2"))
    assert len(cycle(whole, box, "2", turns=["1"]).boxes) == 2
    with pytest.raises(Unproved, match="strictly inside"):
        cycle(whole, box, "2", turns=["0"])
    with pytest.raises(Unproved, match="not proved to be different"):
        cycle(half, box, "2", turns=["2"])


# -- wider rectangles ------------------------------------------------------------------------------


def around(ends=("7/4", "15/8"), word=(1, 1), turned=(), arrows=None, outer=None):
    """A horseshoe on the first rectangle and a part of the second one, which is not repeated."""
    proof, names = pair()
    known, whole = proof.context.known, proof.context.known[names[1]]
    name = proof.rectangle(ends, name="part", function="G")[0]
    known[name] = replace(known[name], function=whole.function, turns=turned)
    boxes = tuple(known[each].box for each in names)
    known["barred"] = BarredWord(whole.function, boxes, word, Fraction(1, 8))
    wider = {"rectangles": outer or names, "words": ["barred"]}
    arrows = arrows or [["1", "2"], ["1"]]
    witness = {"rectangles": [names[0], name], "arrows": arrows, "cone": ["0", "2"]}
    return proof("horseshoe", **witness, wider=wider)[1]


def test_full_orbits_that_never_repeat_a_rectangle():
    found = around()
    assert found.wider == tuple(
        tuple((Fraction(a), Fraction(b)) for a, b in (x, HEIGHT)) for x in (LEFT, RIGHT)
    )
    assert found.arrows == ((0, 1), (0,)) and "stay in them, and do so" in found.sentence
    assert horseshoe(*pair()).wider == ()


def test_an_edge_goes_beyond_the_wider_rectangle():
    """The part of the second one reaches beyond that of the first, and not beyond all of it."""
    proof, names = pair()
    known, map_ = proof.context.known, proof.context.functions["F"]
    boxes = tuple(known[each].box for each in names)
    for k, ends in enumerate((("1", "9/8"), ("7/4", "29/16"))):
        name = proof.rectangle(ends, name=f"part-{k}", function="FG"[k])[0]
        known[name] = replace(known[name], function=map_)
        known[f"barred-{k}"] = BarredWord(map_, boxes, (k, 1), Fraction(1, 8))
    wider = {"rectangles": names, "words": ["barred-0", "barred-1"]}
    witness = {"rectangles": ["part-0", "part-1"], "arrows": [["1"], ["1"]], "cone": ["0", "2"]}
    assert proof("horseshoe", **witness)[1].wider == ()
    with pytest.raises(Unproved, match="beyond the wider"):
        proof("horseshoe", **witness, wider=wider)


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"word": (0, 1)}, "from 2 to 2"),
        ({"word": (1, 1, 1)}, "from 2 to 2"),
        ({"arrows": [["1"], ["1"]]}, "from 1 to 2"),
        ({"ends": ("113/64", "15/8")}, "same left edge"),
        ({"ends": ("7/4", "33/16")}, "same left edge"),
        ({"turned": (1,)}, "same left edge"),
        ({"ends": ("7/4", "29/16")}, "short"),  # does not reach beyond the first rectangle
        ({"outer": ["rectangle-0"]}, "one for each"),
    ],
)
def test_what_does_not_keep_orbits_in_the_parts(change, reason):
    with pytest.raises(Unproved, match=reason):
        around(**change)
