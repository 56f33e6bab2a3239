"""Each rule of the paper's sections on a true witness, edited in every way: refused, or true.

The edits are those of `mutations`. What is accepted says the same, or says what the oracles, which
know nothing of the checker, do not contradict.
"""

import json
import random
from collections import Counter
from dataclasses import replace
from fractions import Fraction
from functools import cache

import pytest

from proofs.motion.system import System
from proofs.motion.witness import HORIZON
from proofs.plane.settling import settles
from proofs.search import s34_circle, s34_whole
from proofs.search.curves import Curves, seen_curves
from proofs.search.s34_absorbing import Partition
from proofs.search.steps import Prover
from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.meter import metered
from proofs.trusted.parameters import PAPER, Parameters, Place
from proofs.trusted.rules import RULES
from proofs.trusted.verify import derive, premises
from tests.effort import EFFORT
from tests.once import REPORTS, once, report
from tests.oracles.judge import oracle
from tests.proofs.trusted.edits import edited
from tests.proofs.trusted.mutations import FORM, field, inside
from tests.proofs.trusted.renewing import REFUSED

TEN_PIECES = replace(PAPER, eta=Fraction("0.21"))  # of the circle: few, so that all is soon derived
ALL_STICK = Place(*(tuple(map(Fraction, side)) for side in (("0.3", "0.302"), ("0.19", "0.192"))))
WORK = 3_000_000


@once
def coarse():
    """The steps of a coarse partition of the circle: few branches, wide cells, 12 impacts."""
    prover = Prover(System(PAPER.eta, PAPER.nu), 30, HORIZON)
    ends = s34_circle.prove_arc(prover), s34_circle.prove_longest(prover)
    Partition(prover, *ends, goal=0.1, most=500, turns=25, impacts=12).prove()
    return prover.steps


@once
def few_pieces():
    """The steps of bounds of the entropy and of periodic orbits, where there are few pieces."""
    return s34_whole.prove(TEN_PIECES, ("G17", "G18")).steps


@once
def grazing_curve():
    """The steps of a part of a curve of grazing, with the point where it meets the folds."""
    made = Curves(Fraction(0), {})
    made.grazing(2, [x for x in seen_curves(2, Fraction(0))[-1] if 1.41 < x.eta < 1.45])
    return made.steps


@once
def settling():
    """The steps of a proof that all motions stick, for all oscillators of a box."""
    return json.loads(settles(ALL_STICK).certificate())["steps"]


@cache
def derived(parameters, make):
    """What such steps prove."""
    context = Context(parameters)
    derive(context, Reader(make()))
    return context


@cache
def shortest():
    """For each rule the shortest step of the committed files: its length, file, and name."""
    steps = {}
    for path in [*REPORTS.glob("*.json"), *REPORTS.glob("atlas/*/cell-*.json")]:
        for name, step in json.loads(path.read_text()).get("steps", {}).items():
            steps.setdefault(step["rule"], []).append((len(json.dumps(step)), path, name))
    return {rule: min(each) for rule, each in steps.items()}


SMALLER = dict.fromkeys(("branch", "lands", "absorption"), (PAPER, coarse))
SMALLER |= dict.fromkeys(
    ("pieces", "itinerary-graph", "expansion", "cycles", "grazing"), (TEN_PIECES, few_pieces)
)


SMALLER |= {"grazing-curve": (None, grazing_curve), "grazing-meets": (None, grazing_curve)}
SMALLER["settles"] = ALL_STICK, settling


def source(rule):
    """Steps, what they prove, and the name of one by this rule."""
    if rule in SMALLER:
        steps, context = SMALLER[rule][1](), derived(*SMALLER[rule])
        return steps, context, next(x for x, step in steps.items() if step["rule"] == rule)
    _, path, name = shortest()[rule]
    text = path.read_text()
    context = report(path.stem).context if path.parent == REPORTS else premises(text)
    return json.loads(text)["steps"], context, name


def edits(steps, name):
    """A file with the witness of a step, and its edits, by what is done to which field."""
    base = ("steps", name, "witness")
    around = {**{other: {} for other in steps}, name: steps[name]}
    document = {"parameters": {}, "functions": {}, "steps": around, "claims": []}
    kinds = {}
    for kind, path, edit in inside(document):
        if path[:3] == base:
            kinds.setdefault(f"{field(path[3:])} {kind}", []).append((path[3:], edit))
    return document, kinds


def again(context, name, rule, witness):
    """What a step concludes with another witness."""
    known = {x: each for x, each in context.known.items() if x != name}
    result = Context(context.parameters, context.functions, known)
    with metered(WORK):
        derive(result, Reader({name: {"rule": rule, "witness": witness}}))
    return result.known[name]


OWN = [rule for rule, place in RULES.items() if not place.startswith("kernel.")]


def verify(rule, most):
    """Assert that each edit is refused, or proves what is true; so many of each kind are made."""
    (steps, context, name), chance = source(rule), random.Random(rule)
    own, counts = context.known[name], Counter()
    of = context.parameters if isinstance(context.parameters, Parameters) else None
    document, kinds = edits(steps, name)
    for kind, each in kinds.items():
        for path, edit in chance.sample(each, min(most, len(each))):
            witness = json.loads(edited(document, edit))["steps"][name]["witness"]
            try:
                found = again(context, name, rule, witness)
            except REFUSED:
                counts["refused"] += 1
                continue
            counts["accepted"] += 1
            told = f"{kind} at {path}"
            assert kind.partition(" ")[2] not in FORM, told
            if found.sentence != own.sentence:
                assert not list(oracle(found, random.Random(1), of)), told
    assert counts["refused"] > counts["accepted"]


@pytest.mark.parametrize("rule", OWN)
def test_an_edited_witness_is_refused_or_true(rule):
    verify(rule, 1 if EFFORT.quick else 3)


@pytest.mark.long
@pytest.mark.parametrize("rule", OWN)
def test_all_edits_of_a_witness(rule):
    verify(rule, 200)
