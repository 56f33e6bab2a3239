"""The oracles accept what is proved, and complain about what is made false; none is missing."""

import random
from copy import deepcopy
from fractions import Fraction
from types import SimpleNamespace

import pytest

from tests.once import once
from tests.oracles.adapter import parameters, view
from tests.oracles.judge import judge, judge_of
from tests.oracles.motion import TURN, ball
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


def off(bounds):
    """Bounds that miss what lay in these."""
    width = bounds[1] - bounds[0] + F(1, 100)
    return bounds[0] + width, bounds[1] + width


def offs(field, place=None):
    """Move one pair of bounds, or one of several, or all of them."""

    def change(record):
        old = getattr(record, field)
        if isinstance(old[0], tuple):
            new = tuple(off(x) if place in (None, i) else x for i, x in enumerate(old))
        else:
            new = off(old)
        setattr(record, field, new)

    return change


def put(field, value):
    """Replace a field; value may be a function of the old one."""

    def change(record):
        setattr(record, field, value(getattr(record, field)) if callable(value) else value)

    return change


def _target_hit(record):
    phase = lifted(record, between(record.source, F(1, 2))) % TURN
    record.target = F(phase) - F(1, 100), F(phase) + F(1, 100)


def moved(box):
    """A box beside another one, in all but its first variable."""
    return box[0], *((b, b + (b - a)) for a, b in box[1:])


def _swap(field):
    return put(field, lambda old: (old[1], old[0], *old[2:]))


def _of(field, change):
    """Change a record inside of a record."""
    return lambda record: change(getattr(record, field))


def _first_box_off(record):
    (phases, velocities), *others = record.boxes
    record.boxes = (off(phases), velocities), *others


def _narrow(record):
    """Cut velocities of rectangles, so that images leave them."""
    sets = record.strips
    if hasattr(sets, "velocities"):
        sets.velocities = F(-9, 20), F(-2, 5)
    else:
        (phases, (low, high)), second = sets.after_first
        sets.after_first = (phases, (low, low + (high - low) / 8)), second


def _much_growth(record):
    record.growth = F(5000)
    middle = F(float(ball(record.growth).log()))
    record.entropy = middle - F(1, 10**9), middle + F(1, 10**9)


def _cells(change):
    """Change the cells of a full shift, where there are some."""
    return put("cells", lambda old: old and change(old))


def _derivative(record):
    (p, q), rows = record.matrix
    record.matrix = (off(p), q), rows


def _image(record):
    record.values = off(record.values[0]), record.values[1]


def _speed(record):
    record.values = record.values[0], off(record.values[1])


def _edge(record):
    (phase, velocity), right = record.edges
    record.edges = (off(phase), velocity), right


def _window(record):
    n, first, last = record.above[0]
    record.above = ((n, off(first), off(last)), *record.above[1:])


def _local(record):
    record.local.target.inverse = tuple(
        tuple(x / 50 for x in row) for row in record.local.target.inverse
    )


def _never_disjoint(record):
    graph = getattr(record, "graph", record)
    if len(graph.nodes) > 1:
        graph.nodes = (graph.nodes[0], deepcopy(graph.nodes[0]))
        graph.nodes[1].centre = tuple(x + F(1, 10**6) for x in graph.nodes[1].centre)


LINEAR = [put("ratios", (F(7, 10), F(4, 5))), put("ratios", (F(1, 3), F(1, 4)))]
FALSE = {
    "Impact": [offs("slope"), offs("image")],
    "SlopeRange": [offs("pieces"), offs("images"), offs("slopes"), _swap("points")],
    "Avoids": [_target_hit],
    "ImageArc": [offs("low"), offs("high"), put("domain", (F("1.11"), F("1.3")))],
    "Itinerary": [offs("orbit"), put("cut", lambda old: old[:-1] + "012"[int(old[-1]) - 1])],
    "InvariantSet": [
        put("interval", (F("1.11"), F("1.3"))),
        _of("shift", put("factors", "01")),
        put("sentence", lambda old: old.replace("f^n has ", "f^n has 9")),
    ],
    "Repeller": [
        offs("dimension"),
        offs("slopes"),
        offs("growth"),
        put("words", lambda old: ("0", "00", "1")[: len(old)]),
    ],
    "StayingDimension": [
        _of("repeller", offs("dimension")),
        _of("staying", _of("shift", put("factors", "11"))),
    ],
    "ThinShift": [
        offs("rate"),
        _of("repeller", offs("dimension")),
        _of("escape", offs("growth")),
        _of("escape", put("exponent", F(9, 10))),
        _of("shift", put("region", ((F("1.3"), F("1.5")),))),
    ],
    "MoranRoot": [offs("root"), put("ratios", (F(1, 9), F(1, 8)))],
    "NoGap": [put("ratios", (F(1, 4), F(1, 3)))],
    "Digits": [put("readings", (False, True)), put("printed", "0.46"), offs("value")],
    "ExactMeasure": LINEAR,
    "LinearDimension": [*LINEAR, offs("measure"), offs("root")],
    "Excess": [*LINEAR, offs("root"), put("level", 0), put("interval", (F(0), F(99)))],
    "ShortGap": [*LINEAR, put("ratios", (F(1, 4), F(1, 4)))],
    "Uncovered": LINEAR,
    "Branch": [
        put("windows", lambda old: tuple((low + 60, high + 60) for low, high in old)),
        put("windows", lambda old: tuple((low, (low + high) / 2) for low, high in old)),
    ],
    "EntropyBound": [
        offs("entropy"),
        _much_growth,
        _swap("branches"),
        _cells(lambda old: tuple((low + F(1, 10), high + F(1, 10)) for low, high in old)),
        _cells(lambda old: (old[0], (old[1][0], sum(old[1]) / 2))),
        _cells(lambda old: old[::-1]),
    ],
    "Grazing": [
        *map(offs, ("phases", "time", "root")),
        put("turn", lambda old: old + 2),
        put("below", lambda old: not old),
        put("landing", lambda old: None if old else (F(9), F(10))),
    ],
    "Pieces": [
        put("arcs", lambda old: old[:2] + old[3:]),
        put("arcs", lambda old: old[2:]),
        put("region", lambda old: (old[0] + F(1, 4), old[1] - F(1, 4))),
    ],
    "EntropyRange": [
        offs("entropy"),
        put("growth", lambda old: old - 1),
        _of("lower", put("growth", lambda old: old + 1)),
        _of("pieces", put("arcs", lambda old: old[:2] + old[3:])),
    ],
    "Between": [
        put("full", lambda old: old + 1),
        put("images", lambda old: tuple((off(low), off(high)) for low, high in old)),
        put("grazes", lambda old: old[::-1]),
    ],
    "Cycles": [
        put("counts", lambda old: ((old[0][0] + 1, old[0][1] + 1), *old[1:])),
        put("words", lambda old: (*old, old[0])),
        put("words", lambda old: tuple((len(old[0]) + 50, *w[1:]) for w in old)),
        _of("expansion", put("rate", F(2))),
        _of("expansion", put("rate", F(1))),
        _of("expansion", put("scales", lambda old: (F(1),) * len(old))),
        _of("expansion", put("scales", lambda old: old[1:])),
    ],
    "Coding": [
        _of("expansion", put("rate", F(2))),
        _of("entropy", put("growth", lambda old: old - 1)),
        lambda record: put("arcs", lambda old: old[2:])(record.expansion.pieces),
    ],
    "StayingSet": [
        put("cells", lambda old: old[::-1]),
        offs("slopes"),
        offs("cells"),
        put("cells", lambda old: old[:-1]),
        put("region", ((F("1.11"), F("1.32")),)),
        put("onward", lambda old: (old[0][:-1], *old[1:])),
        put("expansion", F(1)),
        put("growth", (F(3), F(4))),
        put("fixed_points", (2, 4, 8, 16, 32, 64, 128, 250)),
        put("whole", lambda old: not old),
        put("orbit", lambda old: old[1:] or ((F("1.1"), F("1.18")),)),
    ],
    "Separation": [
        *map(offs, ("start", "phase", "time", "arrival", "speed")),
        put("turns", 1),
    ],
    "Lands": [put("phases", (F("1.0"), F("1.5")))],
    "NeverImpacts": [put("phases", (F("1.2"), F("1.25"))), put("phases", (F("1.5708"),) * 2)],
    "Absorption": [
        put("rest", lambda old: tuple(x / 100 for x in old)),
        put("rest", lambda old: old[:1]),  # of so few impacts too much is open
        put("within", (((F("1.57"), F("1.58")), 3),)),
        _of("sink", put("measure", F(2))),
        _of("sink", put("ends", lambda old: ((old[0][0] + F(1, 10**5), old[0][1]), old[1]))),
        _of("sink", put("ends", lambda old: (old[0], (old[1][0], old[1][1] - F(1, 10**5))))),
    ],
    "Sink": [put("measure", F(2)), _of("never", put("phases", (F("1.2"), F("1.25"))))],
    "LongTransients": [
        put("inside", (F("1.3"), F("1.34"))),
        put("inside", (F(1), F("1.1"))),
        put("steps", 0),
        _of("shift", offs("slopes")),
    ],
    "TouchingFamily": [put("phases", (F("1.2"), F("1.25")))],
    "SuperstableMotion": [
        *(_of("arc", offs(name)) for name in ("phase", "time", "arrival", "speed")),
        put("rest", lambda old: old - F(1, 2)),
        put("boxes", lambda old: (tuple((low - 1, high + 1) for low, high in old[0]), *old[1:])),
        put("boxes", lambda old: (*old, old[0])),
        put("boxes", lambda old: old[:1]),
        put("epsilons", lambda old: (old[0], F(9, 10))),
        _first_box_off,
    ],
    "Passes": [
        put("bounces", lambda old: old + 1),
        put("epsilon", lambda old: 1 - old),
        _of("arc", offs("speed")),
    ],
    "Border": [
        put("rests", lambda old: SimpleNamespace(**{**vars(old), "epsilons": (F(2, 5),) * 2})),
        put("passes", lambda old: SimpleNamespace(**{**vars(old), "epsilon": F(9, 25)})),
        put("passes", lambda old: SimpleNamespace(**{**vars(old), "bounces": old.bounces + 1})),
        _of("motion", put("epsilons", (F(0), F(9, 10)))),
    ],
    "StableCycle": [
        _first_box_off,
        put("boxes", lambda old: old[:1] * 2),
        put("epsilon", F(1, 2)),
    ],
    "TwoAttractors": [
        put("cycles", lambda old: (*old[:2], *old[3:])),
        put("cycles", lambda old: old[:-1]),
        _of("motion", put("epsilons", (F(0), F(29, 100)))),
        lambda record: [_first_box_off(each) for each in record.cycles],
    ],
    "Solution": [
        offs("multiplier"),
        offs("acceleration"),
        offs("phase"),
        put("early", F(1, 10**6)),
        put("n", lambda old: old + 1),
        put("first", lambda old: True),
    ],
    "EtaWindows": [
        put("ends", lambda old: ((off(old[0][0]), old[0][1]), *old[1:])),
        put("ends", lambda old: old[:2]),
        put("late", lambda old: old and (old[0], off(old[1]))),
        put("late", lambda old: old and (off(old[0]), off(old[1]))),
    ],
    "NuWindows": [_window, put("below", ())],
    "Differential": [
        _image,
        _speed,
        _derivative,
        put("turns", lambda old: tuple(count + 1 for count in old)),
    ],
    "Rectangle": [
        _edge,
        put("parts", lambda old: old[1:]),
        lambda record: [_derivative(part) for part in record.parts],
        lambda record: [_speed(part) for part in record.parts],
    ],
    "Horseshoe": [
        put("margin", F(1, 2)),
        put("rates", lambda old: (F(99), *old[1:])),
        put("boxes", lambda old: tuple((phases, (F(-9, 20), F(-2, 5))) for phases, _ in old)),
    ],
    "BarredWord": [put("word", (0, 0)), put("short", lambda old: old + 1)],
    "RectangleHorseshoe": [
        put("margin", F(1, 2)),
        put("rates", lambda old: (F(99), *old[1:])),
        put("rates", lambda old: (old[0], F(1, 10**9), old[2])),
        put("rates", lambda old: (*old[:2], (F(3), F(1)))),
        _narrow,
    ],
    "HorseshoeFamily": [
        put("shoes", lambda old: old[1:]),
        put("shoes", lambda old: (old[0], *old[2:])),
        put("box", lambda old: (*old[:2], (F(0), F(1, 2)))),
        lambda record: [put("margin", F(1, 2))(shoe) for shoe in record.shoes],
        lambda record: [_narrow(shoe) for shoe in record.shoes],
    ],
    "GoldenMean": [
        put("rates", lambda old: (F(9), F(1, 99), old[2])),
        _of("strips", put("right", (F("1.2"), F("1.22")))),
    ],
    "Hyperbolic": [
        put("grow", F(9)),
        put("shrink", F(1, 999)),
        put("rates", lambda old: (F(9), F(1, 99), old[2])),
    ],
    "EdgeImage": [offs("image"), put("phase", F("1.2"))],
    "Equal": [
        put("right", lambda old: f"({old}) + 1/1000000"),
        put("left", lambda old: f"2*({old}) + 1"),
    ],
    "Series": [put("coefficients", lambda old: (*old[:-1], f"({old[-1]}) + 1/1000"))],
    "Expressions": [
        put("expressions", lambda old: ((old[0][0], f"({old[0][1]}) + 1/1000"), *old[1:])),
        put("expressions", lambda old: (*old[:-1], (old[-1][0], f"2*({old[-1][1]}) + 1"))),
    ],
    "Value": [offs("bounds")],
    "UniqueZero": [put("box", lambda old: tuple((b + 10, b + 11) for _, b in old))],
    "Image": [put("bounds", lambda old: tuple((b + 10, b + 11) for _, b in old))],
    "Trapped": [
        put("boxes", lambda old: tuple(((b + 10, b + 11), *rest) for (_, b), *rest in old))
    ],
    "NoImpact": [put("box", lambda old: (*old[:-1], (F(-2), F(-2))))],
    "Pressed": [put("box", lambda old: (*old[:-1], (F(2), F(2))))],
    "Graze": [
        put("rises", lambda old: not old),
        offs("time"),
        lambda record: offs("box", record.axis)(record),
    ],
    "PeriodicOrbit": [
        put("box", lambda old: tuple((b + 10, b + 11) for _, b in old)),
        put("period", lambda old: 2 * old),
        put("turns", lambda old: tuple(x + 1 for x in old)),
        put("stability", lambda old: "attracting" if old == "a saddle" else "a saddle"),
        put("stability", "repelling"),
    ],
    "PeriodicOrbits": [
        put("counts", lambda old: (*old[:-1], (old[-1][0], old[-1][1] + 1))),
        put("counts", lambda old: old[1:]),
        put("box", lambda old: tuple((a, (a + b) / 2) for a, b in old)),
    ],
    "HSet": [put("inverse", lambda old: tuple(tuple(2 * x for x in row) for row in old))],
    "Covers": [put("orientation", lambda old: -old), _local],
    "Graph": [_never_disjoint],
    "Entropy": [put("growth", lambda old: 100 * old)],
    "Conjugacy": [_never_disjoint],
    "Theorem": [put("text", "")],
    "StableSingles": [
        put("stable", lambda old: () if old else (1,)),
        put("stable", lambda old: (*old, 3)),
        put("epsilon", F(9, 10)),
        put("nu", F(-1, 100)),
    ],
    "AllStick": [_of("arc", offs("arrival")), _of("arc", put("nu", F(1)))],
    "AtRest": [put("nu", F(1)), put("nu", F("-0.2"))],
    "Leaves": [put("nu", F("0.01"))],
    "NeverSticks": [put("nu", F(1)), put("eta", F("0.01"))],
    "OnlyTouches": [put("nu", F(1)), put("eta", F("0.9"))],
    "FlightsEnd": [put("nu", F("-0.2"))],
    "ComesToRest": [put("nu", F(1)), put("nu", F("-0.2")), put("epsilon", F("0.999"))],
    "ReturningMotion": [
        put("cells", lambda old: tuple(off(x) for x in old)),
        put("cells", lambda old: old[:-1]),
        put("contraction", F(1)),
        put("contraction", F(1, 10**6)),
        _of("beyond", put("points", lambda old: (old[0], old[0] + F(1, 10**4)))),
        _of("arc", offs("phase")),
    ],
    "SticksOnce": [
        put("cells", lambda old: tuple(off(x) for x in old) or (off((F(1), F(2))),)),
        _of("end", offs("cells")),
        _of("arc", offs("phase")),
    ],
    "StickingMotion": [
        put("landing", None),
        put("cells", lambda old: tuple(off(x) for x in old)),
        put("cells", lambda old: old[:-1]),
        _of("arc", offs("phase")),
    ],
    "Arc": [
        put("pieces", lambda old: old[::2] if len(old) > 2 else ()),
        put("pieces", lambda old: tuple((moved(box), slope) for box, slope in old)),
        put("points", lambda old: tuple((x, *map(off, rest)) for x, *rest in old)),
    ],
    "GrazingCurve": [
        put("n", 1),
        put("epsilon", F(1, 1000)),
        put("side", 1),
        offs("amplitudes", 0),
        _of("arc", put("pieces", lambda old: tuple((moved(box), slope) for box, slope in old))),
    ],
    "Meeting": [
        put("other", "flip"),
        put("rising", lambda old: not old),
        put("box", lambda old: (off(old[0]), *old[1:])),
        offs("amplitude"),
    ],
    "StableOrbit": [
        offs("cells"),
        put("contraction", (F(1, 3), F(1, 2))),
        put("contraction", (F(1), F(2))),
    ],
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
def test_what_is_made_false_is_found(kind):
    records = [record for _, record in true_views() if record.kind == kind]
    for index, change in enumerate(FALSE[kind]):
        sample = random.Random(kind).sample(records, min(len(records), 8))
        assert any(_found(record, change) for record in sample), f"change {index} is not found"


def _found(record, change):
    """Whether a record that is made false is complained about."""
    false = deepcopy(record)
    change(false)
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
