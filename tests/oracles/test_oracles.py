"""The oracles accept what is proved, and complain about what is made false; none is missing."""

import random
import re
from copy import deepcopy
from fractions import Fraction
from functools import cache

import pytest

from tests.oracles.adapter import CLASSES, name_of, view
from tests.oracles.judge import JUDGES, judge
from tests.oracles.sources import (
    certificates,
    classes,
    committed_conclusions,
    joined,
    lemmas,
    reported,
)
from tests.oracles.verdicts import SENTENCES, TRUTHS, sentence_faults, verdict_oracle

F = Fraction
UNBASED = {"StablePair"}  # a conclusion without the common base, as yet


@cache
def true_views():
    """One record of every conclusion that is proved in the tree: (class, where, record)."""
    found = []
    for name in certificates():
        of, known = committed_conclusions(name)
        found += [(f"{name} {step}", one, of) for step, one in known.items()]
        found += [(f"{name} joined", one, of) for one in joined(name)]
    found += [(where, one, None) for where, one in lemmas()]
    found += [("by hand", one, None) for one in by_hand()]
    return [(name_of(one), where, view(one, of)) for where, one, of in found]


def test_every_class_of_conclusions_has_an_oracle():
    named = {"Horseshoe" if name == "RectangleHorseshoe" else name for name in CLASSES}
    assert classes() | UNBASED == named
    assert {kind for kind, _ in CLASSES.values()} == set(JUDGES)


def test_every_class_is_among_what_is_proved_and_among_what_is_made_false():
    assert {name for name, _, _ in true_views()} == set(CLASSES)
    assert set(FALSE) == {kind for kind, _ in CLASSES.values()}


@pytest.mark.parametrize("name", CLASSES)
def test_what_is_proved_is_accepted(name):
    told = {}
    for own, where, record in true_views():
        if own == name:
            told[where] = judge(deepcopy(record), random.Random(where))
    assert told
    assert not any(told.values()), {where: one for where, one in told.items() if one}


def by_hand():
    """Conclusions that none of the committed certificates needs."""
    from proofs.trusted.paper.formulas import Theorem
    from proofs.trusted.paper.s32_sets.moran import NoGap, Unlike

    return NoGap((F(1, 2), F(3, 5))), Unlike(F(21, 5), F("0.25")), Theorem("1 = 1.", "", "")


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
    from tests.oracles.plastic import between, lifted

    phase = lifted(record, between(record.phases, F(1, 2))) % (2 * 3.141592653589793)
    record.target = F(phase) - F(1, 100), F(phase) + F(1, 100)


def _swap(field):
    return put(field, lambda old: (old[1], old[0], *old[2:]))


def _cell(field, value):
    def change(record):
        setattr(record.cells[0], field, value(getattr(record.cells[0], field)))

    return change


def _much_growth(record):
    from tests.oracles.motion import ball

    record.growth = F(5000)
    middle = F(float(ball(record.growth).log()))
    record.entropy = middle - F(1, 10**9), middle + F(1, 10**9)


def _derivative(record):
    (p, q), rows = record.derivative
    record.derivative = (off(p), q), rows


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


def _zero_inside(record):
    """x - m, m a point inside of the box."""
    middle = [a + (b - a) * F(2, 5) for a, b in record.box]
    names = zip(record.formula.variables, middle, strict=True)
    record.formula.texts = tuple(f"{name} - ({x})" for name, x in names)


FALSE = {
    "first_impact": [offs("windows"), put("windows", ())],
    "point": [offs("slope"), offs("image")],
    "slope_range": [offs("pieces"), offs("images"), offs("slopes"), _swap("points")],
    "avoids": [_target_hit],
    "moran_root": [offs("root"), put("ratios", (F(1, 9), F(1, 8)))],
    "linear_set": [put("ratios", (F(7, 10), F(4, 5))), offs("measure"), offs("root")],
    "excess": [offs("excess"), put("ratios", (F(1, 2), F(1, 2)))],
    "horseshoe": [
        put("slopes", (F(5), F(7))),
        put("slopes", (F(4), F(5))),
        put("right", (F("1.29"), F("1.32"))),
    ],
    "image_arc": [offs("low"), offs("high"), put("domain", (F("1.11"), F("1.3")))],
    "missed": [put("target", (F("1.2"), F("1.25")))],
    "no_gap": [put("ratios", (F(1, 4), F(1, 3)))],
    "gap_function": [put("ratios", (F(1, 2), F(3, 5)))],
    "unlike": [put("given", F("0.24"))],
    "digits": [put("readings", ((False, True),) * 2), put("printed", "0.46")],
    "theorem": [put("text", "")],
    "itinerary": [offs("orbit"), put("leaves", lambda old: (old + 1) % 3), put("phase", F("1.2"))],
    "repeller": [
        offs("dimension"),
        offs("slopes"),
        put("words", lambda old: ("0", "00", "1")[: len(old)]),
    ],
    "branch": [put("begin", lambda old: old + 60), put("turn", lambda old: old + 2)],
    "covering_graph": [offs("entropy"), _much_growth],
    "staying_set": [
        _swap("cells"),
        _cell("slopes", off),
        _cell("image", lambda old: (off(old[0]), old[1])),
        put("cells", lambda old: old[:1]),
    ],
    "separation": [offs("start"), offs("phase"), offs("time"), offs("arrival")],
    "lands": [put("phases", (F("1.0"), F("1.5")))],
    "never_impacts": [put("phases", (F("1.2"), F("1.25"))), put("phases", (F("1.5708"),) * 2)],
    "absorption": [
        put("rest", lambda old: tuple(x / 100 for x in old)),
        put("within", (((F("1.57"), F("1.58")), 3),)),
    ],
    "separation_flight": [
        offs("separation"),
        offs("flight"),
        offs("impact"),
        offs("speed"),
        put("turns", 1),
    ],
    "chatter": [put("rest", F(1)), put("spread", F(1)), put("epsilon", (F(0), F(9, 10)))],
    "stable_pair": [put("first", lambda old: (off(old[0]), old[1])), put("epsilon", F(1, 2))],
    "solution": [
        offs("multiplier"),
        offs("acceleration"),
        offs("phase"),
        put("early", F(1, 10**6)),
    ],
    "orbit": [put("n", lambda old: old + 1), offs("phase")],
    "eta_windows": [
        put("ends", lambda old: ((off(old[0][0]), old[0][1]), *old[1:])),
        put("ends", lambda old: old[:2]),
    ],
    "nu_windows": [_window, put("below", ())],
    "rebound": [offs("phase"), offs("velocity"), _derivative, put("turns", lambda old: old + 1)],
    "rectangle": [offs("left"), offs("right"), offs("velocity"), _derivative],
    "barred_word": [put("word", (0, 0)), put("short", lambda old: old + 1)],
    "crossings": [put("margin", F(1, 2)), put("expansion", F(9)), put("contraction", F(2))],
    "equal": [
        put("right", lambda old: f"({old}) + 1/1000000"),
        put("left", lambda old: f"2*({old}) + 1"),
    ],
    "series": [put("coefficients", lambda old: (*old[:-1], f"({old[-1]}) + 1/1000"))],
    "value": [offs("bounds")],
    "method_one": [put("outer", lambda old: (*old[:-1], F(7)))],
    "sign": [put("sign", lambda old: -old)],
    "monotone": [put("sign", lambda old: -old)],
    "within": [put("bounds", lambda old: (old[1] + 1, old[1] + 2))],
    "expands": [put("bound", lambda old: 100 * old)],
    "no_zero": [_zero_inside],
    "refuted": [put("point", lambda old: tuple(x + 1000 for x in old))],
    "zero": [put("interval", lambda old: (old[1] + 1, old[1] + F(11, 10)))],
    "root": [put("bracket", lambda old: (old[0], old[0]))],
    "unique_zero": [put("box", lambda old: tuple((b + 10, b + 11) for _, b in old))],
    "identity": [put("derivative", lambda old: (*old, 0))],
    "h_set": [put("inverse", lambda old: tuple(tuple(2 * x for x in row) for row in old))],
    "covers": [put("orientation", lambda old: -old), _local],
    "graph": [_never_disjoint],
    "entropy": [put("growth", lambda old: 100 * old)],
    "conjugacy": [_never_disjoint],
}


@pytest.mark.parametrize("kind", FALSE)
def test_what_is_made_false_is_found(kind):
    records = [record for _, _, record in true_views() if record.kind == kind]
    for index, change in enumerate(FALSE[kind]):
        told = []
        for record in random.Random(kind).sample(records, min(len(records), 8)):
            false = deepcopy(record)
            change(false)
            told += judge(false, random.Random(kind)) if vars(false) != vars(record) else []
        assert told, f"change {index} of {kind} is not found"


# -- rows ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", certificates())
def test_the_committed_rows_are_accepted(name):
    told = [x for of, *row in reported(name) for x in verdict_oracle(row[0], of, *row[1:])]
    assert not told


def paper(**others):
    from types import SimpleNamespace

    of = next(of for of, *_ in reported("sets"))
    fields = (
        "eta",
        "nu",
        "left",
        "right",
        "interval",
        "slopes",
        "ratios",
        "printed_s0",
        "epsilon",
        "velocities",
    )
    return SimpleNamespace(**{**{name: getattr(of, name) for name in fields}, **others})


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
    ("G5", {}, "VERIFIED"),
    ("N1", {}, "VERIFIED"),
    ("N2", {"left": (F(2), F("2.1")), "right": (F("2.2"), F("2.3"))}, "VERIFIED"),
    ("P4", {}, "VERIFIED"),
    ("P5", {}, "VERIFIED"),
    ("P6", {}, "VERIFIED"),
]


@pytest.mark.parametrize("claim, changed, verdict", WRONG)
def test_wrong_verdicts_are_found(claim, changed, verdict):
    assert verdict_oracle(claim, paper(**changed), verdict, [])


FALSE_SENTENCES = (
    "phi_s in [6.0, 6.01]",
    "3 pi - phi_s in [3.1, 3.2]",
    "phi_1 in [4.7, 4.8]",
    "fixed point p in [1.2, 1.21]",
    "no phase of [1.2, 1.3]",
    "Every phase of [1.57, 1.571] mod 2 pi reaches the arc within 2 impacts",
    "attracts at least 99.95 percent",
    "f'(1.12) <= 4",
    "f(1.2) is in I",
    "[1.13, 1.14] has no preimage in I0",
    "With the symbols 0 = [1.27, 1.3], 1 = [1.1, 1.2]: ",
    "those in [1.11, 1.5] are a full shift on 9 symbols",
    "points of period 2 lie in [1.2, 1.21], [1.3, 1.31]",
    "reaches phase [2, 3] from (phi, gamma) = (1.15, -0.45)",
    "let I = [1.11, 1.32], I0 = [1.11, 1.15], I1 = [1.27, 1.32]. The impact map f is continuously "
    "differentiable and increasing on I0 and on I1, with 4.3 <= f' <= 6.19",
    "(eta0, eta1) = (0.5, 0.6)",
    "linear Cantor set of the ratios 0.5 and 0.6",
    "log 2 >= 0.7",
    "interval of length 0",
)


@pytest.mark.parametrize(
    ("sentence", "pattern"), list(zip(FALSE_SENTENCES, SENTENCES, strict=True))
)
def test_false_sentences_are_found(sentence, pattern):
    """One for each pattern; few phases are attracted where the table hardly moves."""
    still = {"eta": F(9, 10), "nu": F(-1, 10)} if "attracts" in sentence else {}
    assert re.search(pattern[0], sentence)
    assert sentence_faults(paper(**still), sentence)


def test_every_truth_is_tried():
    assert {claim for claim, _, _ in WRONG} >= set(TRUTHS)
