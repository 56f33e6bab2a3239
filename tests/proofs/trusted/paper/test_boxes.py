"""What is said of all oscillators of a box: only what holds at each of them."""

import copy
import json
import random
from dataclasses import replace
from fractions import Fraction
from functools import cache, partial
from itertools import product

import numpy as np
import pytest
from mpmath import diff, mpf

from proofs.motion.many import next_impacts
from proofs.plane.horseshoe import propose
from proofs.plane.settling import settles, stays_stable, sticks
from proofs.trusted.certificate import Malformed, Reader
from proofs.trusted.flights import Motion
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.coverings import EntropyBound
from proofs.trusted.kernel.enclose import enclosed
from proofs.trusted.numbers import COVER_BITS
from proofs.trusted.oscillator import SEPARATES, PlasticMap
from proofs.trusted.paper.beyond.attractors import AllStick, AtRest, Leaves, NeverSticks
from proofs.trusted.paper.beyond.returning import ReturningMotion, StickingMotion
from proofs.trusted.parameters import PAPER, Place
from proofs.trusted.rules import find_rule
from proofs.trusted.verify import Rejected, check, premises
from tests.oracles.judge import oracle
from tests.proofs.trusted.paper import reference
from tests.proofs.trusted.paper.steps import exact

F = Fraction
BOX = Place((F("0.2119"), F("0.2122")), (F("-0.2004"), F("-0.1996")))
SHORT = Place((F("0.3"), F("0.302")), (F("0.19"), F("0.192")))  # the flight ends within a turn


THREE = Place((F("0.2121"), F("0.21214")), (F("-0.2"), F("-0.19994")))


@cache
def text(box=BOX, count=2):
    return next(propose(box, [], count))[0].certificate()


def document():
    return json.loads(text())


def rejected(document, match=None, error=Rejected):
    with pytest.raises(error, match=match):
        check(json.dumps(document))


# -- enclosures ------------------------------------------------------------------------------------


@pytest.mark.parametrize("order", [0, 1])
@pytest.mark.parametrize("time", ["3", "25.5", "56.25"])
def test_the_gap_over_a_box_contains_that_of_each_of_its_oscillators(time, order):
    """By equation (10), in mpmath; at the corners and inside."""
    whole = Motion(BOX, (F("1.1"), F("1.1")))
    times = F(time), F(time)
    found = [each(times, order).range for each in (whole.gap_of, whole.sharp_gap)]
    assert found[1][1] - found[1][0] < found[0][1] - found[0][0] + F(1, 10**9)
    shares = [F(k, 4) for k in range(5)]
    for eta, nu in product(*([low + (high - low) * x for x in shares] for low, high in sides())):
        heights = partial(reference.left_side_10, mpf(float(eta)), mpf(float(nu)), mpf("1.1"))
        true = exact(diff(heights, mpf(time), order))
        for low, high in found:  # nu < 0: the gap is the negative
            assert low - F(1, 10**12) < -true < high + F(1, 10**12)


def sides():
    return BOX.eta, BOX.nu


# -- a full shift ----------------------------------------------------------------------------------


def test_a_full_shift_for_all_oscillators_of_a_box():
    report = check(text())
    (found,) = report.conclusions
    assert isinstance(found, EntropyBound) and report.parameters == found.at == BOX
    (sentence,) = report.sentences
    assert sentence.startswith("At eta in [0.2119, 0.2122], nu in [-0.2004, -0.1996], epsilon = 0:")
    assert str(found.cells[1][0])[0] == "1" and "full shift on 2 symbols" in sentence
    assert found.entropy[0] < F("0.69314718056") < found.entropy[1] + F(1, 10**9)


@pytest.mark.parametrize(("box", "count"), [(BOX, 2), (THREE, 3)])
def test_the_images_are_beyond_the_sets_at_oscillators_of_the_box(box, count):
    """By simulation in floating point, at random oscillators and at the corners."""
    (found,) = check(text(box, count)).conclusions
    assert len(found.cells) == count and oracle(found, random.Random(1)) == []
    rng = np.random.default_rng(1)
    etas = np.concatenate([np.array(box.eta, float).repeat(2), rng.uniform(*box.eta, 30)])
    nus = np.concatenate([np.tile(np.array(box.nu, float), 2), rng.uniform(*box.nu, 30)])
    for cell in found.cells:
        phases = np.linspace(float(cell[0]), float(cell[1]), 60)
        images = next_impacts(-1, etas, nus, phases[:, None], 200.0).images
        assert np.isfinite(images).all() and np.abs(np.diff(images, axis=0)).max() < 0.05
        assert (np.ptp(np.floor(images[30] / (2 * np.pi))) == 0).all()
        images = np.sort((images - 2 * np.pi * np.floor(images[30] / (2 * np.pi)))[[0, -1]], axis=0)
        assert (images[0] < float(found.cells[0][0])).all()
        assert (images[1] > float(found.cells[-1][1])).all()


@pytest.mark.parametrize(
    ("side", "ends", "match"),
    [
        ("eta", ["2119/10000", "2130/10000"], None),  # f is known of fewer oscillators
        ("eta", ["2/10", "2001/10000"], None),  # of others
        ("nu", ["-3/10", "-499/2500"], None),
        ("nu", ["-501/2500", "-19/100"], None),
    ],
)
def test_a_larger_box_or_another_one_is_rejected(side, ends, match):
    made = document()
    made["parameters"][side] = [str(F(end)) for end in ends]
    rejected(made, match)


@pytest.mark.parametrize("epsilon", [["0", "0"], ["0", "1/10"], ["1/10", "1/10"]])
def test_what_is_proved_for_plastic_impacts_is_not_said_of_others(epsilon):
    for made in (document(), json.loads(settles(SHORT).certificate())):
        rejected(made | {"parameters": made["parameters"] | {"epsilon": epsilon}}, "plastic")


@pytest.mark.parametrize(
    "parameters",
    [
        {"eta": ["1/5", "1/4"], "nu": ["-1/5", "1/5"]},
        {"eta": ["1/5", "1/4"], "nu": ["-1/5", "0"]},
        {"eta": ["0", "1/4"], "nu": ["-1/5", "-1/6"]},
        {"eta": ["1/4", "1/5"], "nu": ["-1/5", "-1/6"]},
        {"eta": ["1/5", "1/4"]},
        {"eta": ["1/5", "1/4"], "nu": "-1/5"},
        {"eta": ["1/5", "1/4"], "nu": ["-1/5", "-1/6"], "epsilon": ["1/2", "1/3"]},
        {"eta": ["1/5", "1/4"], "nu": ["-1/5", "-1/6"], "epsilon": ["0", "1"]},
        {"eta": ["1/5", "1/4"], "nu": ["-1/5", "-1/6"], "epsilon": "0"},
        {"eta": ["1/5", "1/4"], "epsilon": ["0", "1/2"]},
        {"eta": ["1/5", "1/" + "9" * 500], "nu": ["-1/5", "-1/6"]},
        {},
    ],
)
def test_what_is_no_box_is_malformed(parameters):
    rejected(document() | {"parameters": parameters}, r"^\$\.parameters", Malformed)


def test_a_box_says_nothing_of_claims_nor_of_rules_for_one_oscillator():
    made = document()
    made["claims"] = [{"id": "X2"}]
    rejected(made, "string", Malformed)
    known = copy.deepcopy(premises(text()).known)
    with pytest.raises(Unproved, match="one eta and one nu"):
        from proofs.trusted.paper.branches import branch

        witness = {"cuts": ["11/10", "23/20"], "turn": "4", "ends": ["26"]}
        branch(Context(BOX, {}, known), Reader(witness))


def test_an_earlier_impact_is_the_one_that_counts():
    """Between both sets launches graze: with these the impacts after the second are no windows."""
    made = document()
    graph_of(made)[1][-1]["cuts"][0] = "119/100"
    rejected(made, "graze|transversal")


def graph_of(made):
    (graph,) = [x["witness"] for x in made["steps"].values() if x["rule"] == "covering-graph"]
    return graph, [x["witness"] for x in made["steps"].values() if x["rule"] == "branch"]


def halved(made):
    """f maps the lower half of a set over the lower half of them all, at most."""
    cuts = graph_of(made)[1][0]["cuts"]
    cuts[:] = [cuts[0], str((F(cuts[0]) + F(cuts[-1])) / 2)]


def twice(made):
    branch = graph_of(made)[1][0]
    branch["cuts"] *= 2


def backwards(made):
    graph_of(made)[1][0]["cuts"].reverse()


def beyond_a_turn(made):
    graph_of(made)[1][0]["cuts"] = ["6", "13/2"]


def later(made, turns):
    graph_of(made)[1][0]["turn"] = turns


SHIFT_LIES = {
    "a set twice": twice,
    "backwards": backwards,
    "a set past 2 pi": beyond_a_turn,
    "half a set": halved,
    "images after 3 turns": partial(later, turns="3"),
    "images after 5 turns": partial(later, turns="5"),
}


@pytest.mark.parametrize("lie", SHIFT_LIES)
def test_a_forged_full_shift_is_refused(lie):
    made = document()
    SHIFT_LIES[lie](made)
    rejected(made, error=(Rejected, Malformed))


def test_two_sets_and_fewer_symbols_are_no_shift():
    """The graph is the same, and so is what it proves: an entropy, of no full shift."""
    made = document()
    graph_of(made)[0]["growth"] = "3/2"
    (found,) = check(json.dumps(made)).conclusions
    assert found.cells == () and found.growth == F(3, 2) and "factor" not in found.sentence
    for cells in (found.branches[0].phases,) * 2, (found.branches[0].phases,):
        with pytest.raises(Unproved, match="one in each"):
            replace(found, growth=F(2), cells=cells)


# -- rest, and motions that all stick --------------------------------------------------------------


@pytest.mark.parametrize(
    ("eta", "nu", "holds"),
    [
        (("1/2", "3/5"), ("1/9", "1/3"), {AtRest}),  # 1/3 * 3/4 = 1/4 at one corner
        (("1/2", "3/5"), ("1/9", "0.334"), set()),  # at that corner the mass leaves
        (("1/5", "1/2"), ("1/3", "1/2"), set()),
        (("1/5", "2/5"), ("1/3", "1/2"), {Leaves}),
        (("1/2", "2"), ("1/9", "1/4"), {AtRest}),  # eta = 1 is inside
        (("4/5", "3"), ("1/9", "2"), set()),
        (("1/2", "2"), ("-1/4", "-1/9"), {Leaves, NeverSticks}),
        (("2/5", "2"), ("-1/4", "-1/9"), {Leaves}),
    ],
)
def test_rest_in_boxes(eta, nu, holds):
    """A box is inside, outside, or across the curve |nu| |1 - eta^2| = eta^2."""
    at = Place(tuple(map(F, eta)), tuple(map(F, nu)))
    for kind in (AtRest, Leaves, NeverSticks):
        if kind in holds:
            assert oracle(kind(at), random.Random(2)) == []
        else:
            with pytest.raises(Unproved):
                kind(at)


def test_all_motions_stick():
    (found,) = check(settles(SHORT).certificate()).conclusions
    assert isinstance(found, AllStick) and found.arc.turns == 1
    assert oracle(found, random.Random(1)) == []
    assert oracle(replace(found, arc=replace(found.arc, at=PAPER.place)), random.Random(1))


@pytest.mark.parametrize(
    "change",
    [
        lambda arc: replace(arc, turns=2),
        lambda arc: replace(arc, arrival=(arc.phase[0] - 1, arc.phase[0])),
        lambda arc: replace(arc, arrival=(arc.start[1], arc.phase[0] - 1)),
        lambda arc: replace(arc, at=Place((F("0.3"), F("0.43")), SHORT.nu)),
    ],
)
def test_no_hypothesis_of_all_sticking_is_dropped(change):
    (found,) = check(settles(SHORT).certificate()).conclusions
    with pytest.raises(Unproved):
        AllStick(change(found.arc))


def test_a_motion_that_sticks_for_all_oscillators_of_a_box():
    (found,) = check(sticks(BOX).certificate()).conclusions
    assert found.at == BOX and found.cells == ()
    assert oracle(found, random.Random(3)) == []


# -- motions that come back to the arc, or to just after it ----------------------------------------

BACK = Place((F("0.2378"), F("0.2382")), (F("-0.2059"), F("-0.2055")))  # to after the arc
LATE = Place((F("0.2213"), F("0.2217")), (F("-0.1843"), F("-0.1839")))  # sticks one impact later
ZERO = Place((F("0.2655"), F("0.2661")), (F("-0.1978"), F("-0.1972")))  # a cell passes phase 0
MADE = {BACK: sticks, LATE: sticks, ZERO: stays_stable}


@cache
def made_at(place):
    return MADE[place](place).certificate()


def at(place):
    made = json.loads(made_at(place))
    steps = list(made["steps"].values())
    return made, steps, steps[-1]["witness"]


def test_motions_that_come_back_for_all_oscillators_of_a_box():
    found = {place: check(made_at(place)).conclusions[0] for place in MADE}
    assert all(one.at == place for place, one in found.items())
    assert isinstance(found[BACK], ReturningMotion) and len(found[BACK].cells) == 1
    assert isinstance(found[LATE], StickingMotion) and found[LATE].landing is not None
    ((low, high),) = found[ZERO].cells
    assert low < F("6.283") and F("6.284") < high
    for one in found.values():
        assert oracle(one, random.Random(4)) == []


def test_launches_that_land_only_at_some_oscillators():
    made, steps, _ = at(LATE)
    (lands,) = [each["witness"] for each in steps if each["rule"] == "lands"]
    lands["cuts"][0] = "2"
    rejected(made, "negative at the end")
    made, _, last = at(LATE)
    last["landing"] = None
    del made["steps"]["lands-2"]
    rejected(made, "the last impact is not proved to be where the motion goes on from")
    made, _, last = at(LATE)
    last["landing"] = last["separation"]
    rejected(made, "names no step about where the last impact is", Malformed)


def test_a_cell_that_passes_phase_0_is_no_set_in_order():
    made, steps, _ = at(ZERO)
    points, function = (steps[0]["witness"][x] for x in ("points", "function"))
    with pytest.raises(Unproved, match="no interval of phases"):
        find_rule("branch")(Context(ZERO), Reader({"cuts": points, "turn": "3"}))
    with pytest.raises(Unproved, match="straddles"):
        witness = {"function": function, "points": points, "target": ["1", "2"]}
        find_rule("avoids")(Context(ZERO), Reader(witness))
    steps[0]["witness"]["points"][0] = "0"
    rejected(made, "right after launch")


@pytest.mark.parametrize(("low", "holds"), [("6.04543", True), ("6.0454", False)])
def test_flights_just_after_the_separation(low, holds):
    """phi_s is 6.0454239...: gap'' is 0 there at first, and no bound from below later on."""
    here = PAPER.place
    x = enclosed(((F(low), F("6.06")),), COVER_BITS)
    begin, end = PlasticMap(here, leaves=SEPARATES).window(x)
    for phase in (F("6.04543"), F("6.05"), F("6.06")):
        time = reference.first_impact(mpf("0.2121"), mpf("-0.2"), mpf(float(phase)))[0]
        assert begin < exact(time) < end
    if holds:
        assert PlasticMap(here).window(x)
    else:
        with pytest.raises(Unproved, match="right after launch"):
            PlasticMap(here).window(x)
