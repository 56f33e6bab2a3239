"""Maps of the line and of a circle, with known dynamics: no oscillator."""

import copy
import json
import math
from fractions import Fraction

import pytest

from proofs.trusted.certificate import Malformed, Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.composition import read_map
from proofs.trusted.kernel.conclusion import AboutMap
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.itineraries import Itinerary
from proofs.trusted.kernel.moran import MoranRoot
from proofs.trusted.paper import find
from proofs.trusted.parameters import PAPER
from proofs.trusted.rules import find_rule
from proofs.trusted.verdicts import Found, Verdict
from proofs.trusted.verify import premises
from tests.proofs.trusted.edits import at
from tests.proofs.trusted.kernel.lemma_examples import text
from tests.proofs.trusted.kernel.lines import CLAIMS, FUNCTIONS, SHOE, STEPS, slopes, staying
from tests.proofs.trusted.kernel.test_flight import BARRED, barred


def derived(steps, context=None):
    context = context or Context()
    for name, data in FUNCTIONS.items():
        context.functions[name] = read_map(name, Reader(data), context.functions)
    for name, step in steps.items():
        context.known[name] = find_rule(step["rule"])(context, Reader(step["witness"]))
    return context.known


def test_what_stays_under_a_parabola_is_a_cantor_set():
    found = derived(STEPS)["set"]
    assert found.place is None and found.whole and found.full and found.is_null
    assert found.signs == (1, -1) and found.growth == (2, 2)
    assert float(found.expansion) == pytest.approx(11 / 5)  # |5 - 10 x| at x = 7/25
    assert found.fixed_points == [2**n for n in range(1, 9)]
    assert found.sentence.startswith("for `F(x) = ") and "phase" not in found.sentence
    assert "The points whose orbits stay in [0, 1] are a Cantor set of Lebesgue" in found.sentence


def test_a_covering_graph_of_a_parabola():
    found = derived(STEPS)["covering"]
    assert found.growth == 2 and len(found.cells) == 2
    assert "`F` has the full shift on 2 symbols as a factor" in found.sentence


def test_an_orbit_of_period_2_attracts():
    """Its multiplier is 4 + 2 r - r^2 = 4/25, r = 16/5."""
    found = derived(STEPS)["orbit"]
    assert (
        len(found.cells) == 2
        and found.contraction[0] <= Fraction(4, 25) <= found.contraction[1] < 1
    )
    assert "modulo" not in found.sentence and "mass" not in found.sentence


def test_a_horseshoe_on_a_circle_and_an_orbit_through_it():
    """H(3/2) = 5/2 + sin(1)/5 = 2.668: between both sets."""
    known = derived(STEPS)
    assert known["shoe"].is_horseshoe and known["shoe"].signs == (1, 1)
    assert known["followed"].cut == "01" and known["followed"].place is None
    (low, high) = known["followed"].orbit[1]
    assert high - low < Fraction(1, 10**9)
    assert float(low) == pytest.approx(2.5 + math.sin(1) / 5, abs=1e-15)


def test_a_root_for_three_ratios():
    """3 (1/4)^s = 1 for s = log 3 / log 4 = 0.79248..."""
    assert "(0.25)^s + (0.25)^s + (0.25)^s = 1" in derived(STEPS)["thirds"].sentence


LIES = [
    ("middle", ["witness", "target"], ["0", "99/100"], "avoid the region"),
    ("middle", ["witness", "target"], ["0", "101/100"], "miss the target"),
    ("middle", ["witness", "target"], ["1", "1"], "no interval"),
    ("middle", ["witness", "points"], ["7/25", "18/25"], "miss the target"),
    ("middle", ["witness", "points"], ["18/25", "7/25"], "increase"),
    ("middle", ["witness", "points"], ["7/25"], "entries"),
    ("middle", ["witness", "function"], "G", "miss the target"),
    ("set", ["witness", "gaps"], [], "cover"),
    ("set", ["witness", "gaps"], ["between"], "different maps"),
    ("set", ["witness", "cells", 0, "slopes"], "low", "not two points"),
    ("set", ["witness", "region"], [["-1/100", "1"]], "avoid the region"),
    ("set", ["witness", "region"], [["1", "1"]], "no interval"),
    ("left", ["witness", "function"], "G", "different maps"),
    ("left", ["witness", "points"], ["0", "7/25", "1/4"], "increase"),
    ("left", ["witness", "points"], ["0", "1/4", "9/20"], "not two points"),
    ("covering", ["witness", "growth"], "3", "growth"),
    ("covering", ["witness", "images", 1, "phase"], "1/4", "growth"),
    ("covering", ["witness", "images", 1, "phase"], "1/5", "not a point"),
    ("covering", ["witness", "images", 1, "phase"], "1/2", "no branch"),
    ("covering", ["witness", "images", 1], {"time": "1/2"}, "phase"),
    ("covering", ["witness", "branches"], ["right", "left"], "in order"),
    ("covering", ["witness", "branches"], ["left", "high"], "different|no branch"),
    ("covering", ["witness", "branches"], ["left", "left"], "no branch"),
    ("covering", ["witness", "branches"], ["first", "last"], "no branch"),
    ("orbit", ["witness", "cells"], [{"slopes": "low", "domain": ["1/2", "53/100"]}], "inside"),
    ("orbit", ["witness", "cells", 0, "slopes"], "left", "not two points"),
    ("high", ["witness", "function"], "F", "different maps"),
    ("low", ["witness", "points"], ["1/5", "53/100"], "not two points"),
    ("between", ["witness", "target"], ["1", "2071/500"], "avoid the region"),
    ("between", ["witness", "target"], ["39/50", "2071/500"], "miss"),  # H(77/25) - 2 pi is 0.787
    ("between", ["witness", "target"], ["999/1000", "433/100"], "miss"),  # H(41/20) is 4.323
    ("between", ["witness", "target"], [SHOE[0], "63/10"], "straddles"),
    ("between", ["witness", "points"], ["41/20", "63/10"], "straddles"),
    ("first", ["witness", "points"], ["-1/2", "3/2", "41/20"], "one turn"),
    ("first", ["witness", "points"], [SHOE[0], "3/2", "8"], "one turn"),
    ("shoe", ["witness", "region"], [["-1/10", "2071/500"]], "straddles"),
    ("shoe", ["witness", "region"], [[SHOE[0], "7"]], "straddles"),
    ("followed", ["witness", "horseshoe"], "set", "increases"),
    ("followed", ["witness", "slopes"], ["left"], "not known"),
    ("thirds", ["witness", "root"], ["793/1000", "4/5"], "signs"),
    ("thirds", ["witness", "ratios"], ["1/4", "1/4", "1"], "ratios"),
    ("thirds", ["witness", "ratios"], ["1/4"], "1 entries"),
]


@pytest.mark.every
@pytest.mark.parametrize(("name", "path", "value", "reason"), LIES)
def test_lies_are_refused(name, path, value, reason):
    steps = copy.deepcopy(STEPS)
    at(steps[name], path[:-1])[path[-1]] = value
    with pytest.raises((Unproved, Malformed), match=reason):
        derived(steps)


@pytest.mark.parametrize("formula", ["8*x", "8*x - (sqrt(2)**2 - 2)**2"])
def test_a_point_that_may_be_a_whole_turn_is_not_the_last_one_of_the_circle(formula):
    """x -> 8 x takes 3/8, an end of D, to 3, which is 0, in A: D meets A in it, and misses it not.

    The second formula is the same map, its values enclosed from below: 3 in [3 - u, 3].
    """
    sets = [("A", ["0", "3/32"]), ("D", ["9/32", "3/8"]), ("E", ["19/32", "11/16"])]
    data = {"variables": ["x"], "values": [formula], "parameters": {}, "periods": {"x": "1"}}
    context = Context()
    context.functions["K"] = read_map("K", Reader(data), {})
    steps = {name: slopes("K", *ends) for name, ends in sets}
    steps["set"] = staying([ends for _, ends in sets], sets, [])
    with pytest.raises(Unproved, match=r"straddles|neither covered nor missed"):
        derived(steps, context)


def test_what_is_about_another_map_decides_no_claim():
    """In a file with the paper's numbers and a function of its own."""
    known = [each for each in derived(STEPS).values() if not isinstance(each, MoranRoot)]
    asked = Found(PAPER, known)
    assert known and not asked.here and not asked.everywhere
    foreign = [each for each in known if isinstance(each, AboutMap | Itinerary)]
    assert len(foreign) == len(known)
    for each in foreign:
        assert each.place is None and each.is_foreign
        with pytest.raises(Unproved, match="not the oscillator's"):
            _ = each.at


def test_a_stable_cycle_of_another_map_is_no_motion_with_impacts():
    known = premises(text("rectangles")).known.values()
    assert {"StableCycle", "Horseshoe", "Rectangle"} <= {each.kind for each in known}
    for claim in ("X6", "X7", "G7"):
        assert find(claim).decide(PAPER, [*known]).verdict is Verdict.UNDECIDED


@pytest.mark.slow
def test_nothing_of_the_paper_is_needed():
    made = barred(BARRED, json.dumps({"functions": FUNCTIONS, "steps": STEPS, "claims": CLAIMS}))
    assert not made.stderr and len(made.stdout.splitlines()) == len(CLAIMS)
