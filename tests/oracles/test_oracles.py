"""The oracles accept what is proved, and complain about what is made false; none is missing."""

import json
import random
from copy import deepcopy
from fractions import Fraction
from types import SimpleNamespace

import pytest

from tests.once import once
from tests.oracles.judge import judge, judge_of, parameters, view
from tests.oracles.motion import TURN, ball
from tests.oracles.planar import is_of_a_file
from tests.oracles.plastic import between, lifted
from tests.oracles.sources import (
    about_curves,
    boxes,
    certificates,
    classes,
    committed_conclusions,
    committed_rows,
    conclusions,
    lemmas,
    proved,
    rows,
)
from tests.oracles.verdicts import TRUTHS, verdict_oracle

F = Fraction
pytestmark = pytest.mark.slow  # all certificates are derived


OWN = (  # beyond the paper
    *(("explore", *at) for at in (("0.112", "-0.336"), ("0.237", "0.3"), ("0.5", "0.2"))),
    ("explore", "2", "-0.2"),
    ("explore", "1/3", "-0.23"),
    ("rebounding", "0.5", "0.2"),
    ("rebounding", "1.8959", "-1.8502"),
)


@once
def true_views():
    """One record of every conclusion that is proved in the tree: (where, record)."""
    found = []
    for name in certificates():
        of, known = committed_conclusions(name)
        found += [(f"{name} {step}", one, of) for step, one in known.items()]
        for claim, _, shown in committed_rows(name)[1]:
            found += [(f"{name} {claim}", one, of) for one in shown]
    for group, eta, nu in OWN:
        made = proved(group, eta, nu)
        of, known = conclusions(made)
        found += [(f"{group} {eta} {step}", one, of) for step, one in known.items()]
        for claim, _, shown in rows(made, made["proofs"], of, known):
            found += [(f"{group} {eta} {claim}", one, of) for one in shown]
    found += [(where, one, None) for where, one in (*lemmas(), *boxes())]
    found += [("by hand", one, None) for one in by_hand()]
    return [(where, view(one, of)) for where, one, of in found]


def by_hand():
    """Conclusions that none of the committed certificates needs."""
    from proofs.trusted.paper.beyond.attractors import OnlyTouches
    from proofs.trusted.paper.s32_sets.moran import NoGap
    from proofs.trusted.parameters import Place

    return NoGap((F(1, 2), F(3, 5))), OnlyTouches(Place.plastic(F(1), F(-2))), *about_curves()


def test_every_class_of_conclusions_has_an_oracle_and_is_proved_and_made_false():
    assert all(map(judge_of, classes()))
    assert classes() == set(FALSE) == {one.kind for _, one in true_views()}


# -- lies ------------------------------------------------------------------------------------------


def off(bounds):
    """Bounds that miss what lay in these; several of them are moved alike."""
    if not bounds or isinstance(bounds[0], tuple):
        return tuple(map(off, bounds))
    width = bounds[1] - bounds[0] + F(1, 100)
    return bounds[0] + width, bounds[1] + width


def stated(words):
    """Numbers, a tuple of several; what JSON writes, with numbers as texts; else a text."""
    if words[:1] == "[" or words in ("null", "true"):
        return _exact(json.loads(words))
    try:
        numbers = tuple(map(_exact, words.split()))
    except ValueError:
        return words
    return numbers[0] if len(numbers) == 1 else numbers


def _exact(value):
    if isinstance(value, list):
        return tuple(map(_exact, value))
    number = F(value) if isinstance(value, str) else None
    return value if number is None else int(number) if number.denominator == 1 else number


CHANGES = {  # of what is there, by the words behind
    "=": lambda old, words: stated(words),
    "+": lambda old, words: old + _exact(words),
    "*": lambda old, words: old * _exact(words),
    "1-": lambda old, words: 1 - old,
    "not": lambda old, words: not old,
    "text": lambda old, words: words.replace("...", old),
    # of bounds
    "off": lambda old, words: off(old),
    "away": lambda old, words: (old[1] + 10, old[1] + 11),
    "wide": lambda old, words: (old[0] - 1, old[1] + 1),
    "half": lambda old, words: (old[0], (old[0] + old[1]) / 2),
    "short": lambda old, words: (old[0], old[0] + F(1, 10**4)),
    "point": lambda old, words: (old[0], old[0]),
    # of several things
    "reverse": lambda old, words: old[::-1],
    "swap": lambda old, words: (old[1], old[0], *old[2:]),
    "drop": lambda old, words: tuple(x for i, x in enumerate(old) if i != int(words) % len(old)),
    "keep": lambda old, words: old[: int(words)],
    "from": lambda old, words: old[int(words) :],
    "odd": lambda old, words: old[::2] if len(old) > 2 else (),
    "twice": lambda old, words: (*old, old[0]),
    "alike": lambda old, words: old[:1] * len(old),
    "more": lambda old, words: (*old, int(words)),
    "later": lambda old, words: (old[0], *map(off, old[1:])),  # all but the first are elsewhere
    "beside": lambda old, words: (old[0], *((b, b + (b - a)) for a, b in old[1:])),
}


def make_false(record, lie):
    """As a line says: a path, where a number is an entry and * each, what is done there, with what;
    or by the function that it names.
    """
    path, _, words = lie.partition(" ")
    if not words:
        OTHERS[path](record)
        return
    name, _, words = words.partition(" ")
    _edit(record, path.split("."), lambda old: CHANGES[name](old, words))


def _edit(value, path, change):
    """What is there after a change at a path: records change, of tuples there are others."""
    if not path:
        return change(value)
    if not isinstance(value, tuple):
        if not hasattr(value, path[0]):  # as the end of a motion of another kind
            return value
        setattr(value, path[0], _edit(getattr(value, path[0]), path[1:], change))
        return value
    places = range(len(value)) if path[0] == "*" else [int(path[0]) % max(1, len(value))]
    return tuple(_edit(x, path[1:], change) if i in places else x for i, x in enumerate(value))


def hit(record):
    """Of the paper's map."""
    if not hasattr(record, "eta"):
        return
    phase = lifted(record, between(record.source, F(1, 2))) % TURN
    record.target = F(phase) - F(1, 100), F(phase) + F(1, 100)


def leaves_elsewhere(record):
    record.cut = record.cut[:-1] + "012"[int(record.cut[-1]) - 1]


def more_fixed_points(record):
    record.sentence = record.sentence.replace("f^n has ", "f^n has 9")


def other_words(record):
    record.words = ("0", "00", "1")[: len(record.words)]


def much_growth(record):
    record.growth = F(5000)
    middle = F(float(ball(record.growth).log()))
    record.entropy = middle - F(1, 10**9), middle + F(1, 10**9)


def jumps_or_not(record):
    record.landing = None if record.landing else (F(9), F(10))


def other_orbit(record):
    record.orbit = record.orbit[1:] or ((F("1.1"), F("1.18")),)


def narrow(record):
    """Cut velocities of rectangles, so that images leave them."""
    for shoe in getattr(record, "shoes", [record]):
        sets = shoe.strips
        if hasattr(sets, "velocities"):
            sets.velocities = F(-9, 20), F(-2, 5)
        else:
            (phases, (low, high)), second = sets.after_first
            sets.after_first = (phases, (low, low + (high - low) / 8)), second


def across_off(record):
    _edit(record, ["box", record.axis], off)


def sets_meet(record):
    graph = getattr(record, "graph", record)
    if len(graph.nodes) > 1:
        graph.nodes = (graph.nodes[0], deepcopy(graph.nodes[0]))
        graph.nodes[1].centre = tuple(x + F(1, 10**6) for x in graph.nodes[1].centre)


def stable_or_not(record):
    record.stable = () if record.stable else (1,)


OTHERS = {
    each.__name__: each
    for each in (
        *(hit, leaves_elsewhere, more_fixed_points, other_words, much_growth, jumps_or_not),
        *(other_orbit, narrow, across_off, sets_meet, stable_or_not),
    )
}
LIES = """
Impact: slope off; image off
SlopeRange: pieces off; images off; slopes off; points swap
Avoids: hit
ImageArc: low off; high off; domain = 1.11 1.3
Itinerary: orbit off; leaves_elsewhere
InvariantSet: interval = 1.11 1.3; shift.factors text 01; more_fixed_points
Repeller: dimension off; slopes off; growth off; other_words
StayingDimension: repeller.dimension off; staying.shift.factors text 11
ThinShift: rate off; repeller.dimension off; escape.growth off; escape.exponent = 9/10
ThinShift: shift.region = [["1.3", "1.5"]]
MoranRoot: root off; ratios = 1/9 1/8
NoGap: ratios = 1/4 1/3
Digits: readings = [false, true]; printed text 0.46; value off
ExactMeasure: ratios = 7/10 4/5; ratios = 1/3 1/4
LinearDimension: ratios = 7/10 4/5; ratios = 1/3 1/4; measure off; root off
Excess: ratios = 7/10 4/5; ratios = 1/3 1/4; root off; level = 0; interval = 0 99
ShortGap: ratios = 7/10 4/5; ratios = 1/3 1/4; ratios = 1/4 1/4
Uncovered: ratios = 7/10 4/5; ratios = 1/3 1/4
Branch: windows.*.* + 60; windows.* half
EntropyBound: entropy off; much_growth; branches swap
EntropyBound: cells.*.* + 1/10; cells.1 half; cells reverse
Grazing: phases off; time off; root off; turn + 2; below not; jumps_or_not
Pieces: arcs drop 2; arcs from 2; region.0 + 1/4
EntropyRange: entropy off; growth + -1; lower.growth + 1; pieces.arcs drop 2
Between: full + 1; images off; grazes reverse
Cycles: counts.0.* + 1; words twice; words.*.0 + 50; expansion.rate = 2
Cycles: expansion.rate = 1; expansion.scales.* = 1; expansion.scales from 1
Coding: expansion.rate = 2; entropy.growth + -1; expansion.pieces.arcs from 2
StayingSet: cells reverse; slopes off; cells off; cells drop -1; region = [["1.11", "1.32"]]
StayingSet: onward.0 drop -1; expansion = 1; growth = 3 4; whole not; other_orbit
StayingSet: fixed_points = 2 4 8 16 32 64 128 250
Separation: start off; phase off; time off; arrival off; speed off; turns = 1
Lands: phases = 1.0 1.5
NeverImpacts: phases = 1.2 1.25; phases = 1.5708 1.5708
Absorption: rest.* * 1/100; rest keep 1; within = [[["1.57", "1.58"], 3]]
Absorption: sink.measure = 2; sink.ends.0.0 + 1/100000; sink.ends.1.1 + -1/100000
Sink: measure = 2; never.phases = 1.2 1.25
LongTransients: inside = 1.3 1.34; inside = 1 1.1; steps = 0; shift.slopes off
TouchingFamily: phases = 1.2 1.25
SuperstableMotion: arc.phase off; arc.time off; arc.arrival off; arc.speed off; rest + -1/2
SuperstableMotion: boxes.0.* wide; boxes twice; boxes keep 1; epsilons.1 = 9/10; boxes.0.0 off
Passes: bounces + 1; epsilon 1-; arc.speed off
Border: rests.epsilons = 2/5 2/5; passes.epsilon = 9/25; passes.bounces + 1
Border: motion.epsilons = 0 9/10
StableCycle: boxes.0.0 off; boxes alike; boxes keep 1; epsilon = 1/2
TwoAttractors: cycles drop 2; cycles drop -1; motion.epsilons = 0 29/100; cycles.*.boxes.0.0 off
Solution: multiplier off; acceleration off; phase off; early = 1/1000000; n + 1; first = true
EtaWindows: ends.0.0 off; ends keep 2; late.1 off; late.0 off
NuWindows: above.0 later; below = []
Differential: values.0 off; values.1 off; matrix.0.0 off; matrix reverse; turns.* + 1
Rectangle: edges.0.0 off; edges reverse; parts from 1; parts.*.matrix.0.0 off; parts.*.values.1 off
Horseshoe: margin + 1/10; margin = 1/2; rates.0 = 99; boxes.*.1 = -9/20 -2/5
BarredWord: word keep 1; word = 0 0; short + 1
RectangleHorseshoe: margin = 1/2; rates.0 = 99; rates.1 = 1/1000000000; rates.2 = 3 1; narrow
HorseshoeFamily: shoes from 1; shoes drop 1; box.2 = 0 1/2; shoes.*.margin = 1/2; narrow
GoldenMean: rates.0 = 9; strips.right = 1.2 1.22
Hyperbolic: grow = 9; shrink = 1/999; rates.0 = 9
EdgeImage: image off; phase = 1.2
Equal: right text (...) + 1/1000000; left text 2*(...) + 1
Series: coefficients.-1 text (...) + 1/1000
Expressions: expressions.0.1 text (...) + 1/1000; expressions.-1.1 text 2*(...) + 1
Value: bounds off
UniqueZero: box.* away
Image: bounds.* away
Trapped: boxes.*.0 away
NoImpact: box.-1 = -2 -2
Pressed: box.-1 = 2 2
Graze: rises not; time off; across_off
PeriodicOrbit: box.* away; period * 2; turns.* + 1
PeriodicOrbit: stability = attracting; stability = a saddle; stability = repelling
PeriodicOrbits: counts.-1.1 + 1; counts from 1; box.* half
HSet: inverse.*.* * 2
Covers: orientation * -1; local.target.inverse.*.* * 1/50
Graph: sets_meet
Entropy: growth * 100
Conjugacy: sets_meet
Theorem: text = []
StableSingles: stable_or_not; stable more 3; epsilon = 9/10; nu = -1/100
AllStick: arc.arrival off; arc.nu = 1
AtRest: nu = 1; nu = -0.2
Leaves: nu = 0.01
NeverSticks: nu = 1; eta = 0.01
OnlyTouches: nu = 1; eta = 0.9
FlightsEnd: nu = -0.2
ComesToRest: nu = 1; nu = -0.2; epsilon = 0.999
ReturningMotion: cells off; cells drop -1; contraction = 1; contraction = 1/1000000
ReturningMotion: beyond.points short; arc.phase off
SticksOnce: cells off; end.cells off; arc.phase off
StickingMotion: landing = null; cells off; cells drop -1; arc.phase off
Arc: pieces odd; pieces.*.0 beside; points.* later
FlightArc: arc.pieces.*.0 beside
GrazingCurve: n = 1; epsilon = 1/1000; side = 1; amplitudes.0 off; arc.pieces.*.0 beside
Meeting: other = flip; rising not; box.0 off; amplitude off
StableOrbit: cells off; contraction = 1/3 1/2; contraction = 1 2
"""
FALSE = {}
for line in LIES.strip().splitlines():
    kind, _, told = line.partition(": ")
    FALSE.setdefault(kind, []).extend(told.split("; "))
OF_THE_PAPER = {  # lies that are none, or are not looked for, about maps of a file
    "Avoids": "hit",
    "BarredWord": "word = 0 0; short + 1",
    "Differential": "turns.* + 1",
    "EntropyBound": "branches swap; cells reverse",
    "Horseshoe": "margin = 1/2; rates.0 = 99",
    "StableCycle": "epsilon = 1/2",
    "StayingSet": 'cells drop -1; region = [["1.11", "1.32"]]; whole not; other_orbit',
}


@pytest.mark.parametrize("name", FALSE)
def test_what_is_proved_is_accepted(name):
    told = {}
    for where, record in true_views():
        if record.kind == name:
            told[where] = judge(deepcopy(record), random.Random(where))
    assert told
    assert not any(told.values()), {where: one for where, one in told.items() if one}


@pytest.mark.parametrize("kind", FALSE)
@pytest.mark.parametrize("of_a_file", [False, True])
def test_what_is_made_false_is_found(kind, of_a_file):
    """By each of the judges: of what is about the paper's motion, and about maps of files."""
    records = [x for _, x in true_views() if x.kind == kind]
    asked = [x for x in records if is_of_a_file(getattr(x, "base", x)) is of_a_file]
    sample = random.Random(kind).sample(asked, min(len(asked), 8))
    sample.sort(key=lambda x: (getattr(x, "period", 0), len(str(x))))  # which are soon judged
    left_out = OF_THE_PAPER.get(kind, "").split("; ") if of_a_file else ()
    for lie in FALSE[kind] if sample else ():
        assert lie in left_out or any(_found(x, lie) for x in sample), f"{lie}: is not found"


def _found(record, lie):
    """Whether a record that is made false is complained about."""
    false = deepcopy(record)
    make_false(false, lie)
    return vars(false) != vars(record) and judge(false, random.Random(record.kind))


# -- rows ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", certificates())
def test_the_committed_rows_are_accepted(name):
    of, rows = committed_rows(name)
    assert not [x for claim, verdict, _ in rows for x in verdict_oracle(claim, of, verdict)]


def paper(**others):
    return SimpleNamespace(**{**vars(parameters(committed_rows("sets")[0])), **others})


WRONG = [
    ("H1", {"slopes": (F(5), F(7))}, "VERIFIED"),
    ("H2", {}, "VERIFIED"),
    ("H3", {"left": (F(2), F("2.1")), "right": (F("2.2"), F("2.3"))}, "VERIFIED"),
    ("H4", {"left": (F("1.11"), F("1.12"))}, "VERIFIED"),
    ("H5", {}, "VERIFIED"),
    ("H6", {"slopes": (F(5), F(7))}, "VERIFIED"),
    ("H11", {"printed_s0": "0.47"}, "VERIFIED"),
    ("H12", {"slopes": (F(4), F(5))}, "VERIFIED"),
    ("H14", {}, "VERIFIED"),
    ("H15", {}, "VERIFIED"),
    ("H16", {"ratios": (F(1, 2), F(3, 5))}, "VERIFIED"),
    ("H17", {"ratios": (F(1, 2), F(3, 5))}, "REFUTED"),
    ("G1", {"eta": F(1, 10), "nu": F(-1, 100)}, "VERIFIED"),
    ("G2", {"nu": F("-0.3")}, "CONDITIONAL"),
    ("G11", {}, "VERIFIED"),
    ("G20", {}, "VERIFIED"),
    ("N1", {}, "VERIFIED"),
    ("N2", {"left": (F(2), F("2.1")), "right": (F("2.2"), F("2.3"))}, "VERIFIED"),
    ("X1", {}, "VERIFIED"),
    ("P4", {}, "VERIFIED"),
    ("P5", {}, "VERIFIED"),
    ("P6", {}, "VERIFIED"),
]


@pytest.mark.parametrize("claim, changed, verdict", WRONG)
def test_wrong_verdicts_are_found(claim, changed, verdict):
    assert verdict_oracle(claim, paper(**changed), verdict)


def test_every_truth_is_tried():
    assert {claim for claim, _, _ in WRONG} >= set(TRUTHS)
