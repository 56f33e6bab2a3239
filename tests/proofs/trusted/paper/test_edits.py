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
from proofs.plane.settling import settles, sticks
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
from tests.proofs.trusted.mutations import field, inside
from tests.proofs.trusted.renewing import REFUSED

TEN_PIECES = replace(PAPER, eta=Fraction("0.21"))  # of the circle: few, so that all is soon derived
ALL_STICK, AFTER_THE_ARC = (
    Place(*(tuple(map(Fraction, side)) for side in sides))
    for sides in (
        (("0.3", "0.302"), ("0.19", "0.192")),
        (("0.2378", "0.2382"), ("-0.2059", "-0.2055")),
    )
)
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


@once
def coming_back():
    """The steps of a motion that comes back to just after the arc, for all oscillators of a box."""
    return json.loads(sticks(AFTER_THE_ARC).certificate())["steps"]


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
SMALLER |= {"settles": (ALL_STICK, settling), "sticking-motion": (AFTER_THE_ARC, coming_back)}


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


ACCEPTED = {  # what may be done to which field, in some places; all else is refused
    "first-impact": "phases tighter narrowed looser aside collapsed nudged; times dropped nudged "
    "moved",
    "point": "time tighter looser widened nudged",
    "slope-range": "phase nudged; time looser nudged moved",
    "avoids": "flights dropped; target tighter narrowed nudged",
    "moran-root": "ratios turned; root tighter looser widened",
    "itinerary": "slopes dropped swapped doubled_in_place added turned another; phase moved",
    "dimension": "hull nudged; words turned; rho nudged moved; arcs moved; paths dropped nudged; "
    "radii tighter narrowed looser aside collapsed turned nudged moved; nodes moved; exponent "
    "nudged; growth nudged; test dropped swapped doubled_in_place added nudged moved; bits moved",
    "horseshoe-union": "parts dropped swapped doubled_in_place added turned",
    "golden-mean": "words swapped added turned",
    "separation": "phase looser nudged; times dropped nudged moved; time looser nudged moved",
    "lands": "cuts dropped nudged moved",
    "never-impacts": "phases tighter narrowed nudged",
    "absorption": "never other_type dropped emptied; lands swapped turned; cells dropped swapped "
    "emptied turned; cuts nudged moved; times nudged moved; after nudged moved; impacts moved",
    "staying-set": "cells swapped turned; gaps added",
    "branch": "cuts nudged moved; ends nudged moved",
    "covering-graph": "images swapped added turned; time tighter narrowed nudged moved; states "
    "nudged; weights nudged moved; growth nudged moved",
    "grazing": "phases tighter narrowed looser nudged; times nudged moved; landing tighter looser "
    "widened nudged moved",
    "pieces": "branches swapped turned; after nudged moved; grazings swapped turned",
    "itinerary-graph": "images swapped added turned; time tighter looser widened nudged moved; "
    "states swapped doubled_in_place aside collapsed; weights swapped doubled_in_place nudged "
    "moved; growth nudged moved",
    "expansion": "cuts nudged; times nudged; scales doubled_in_place nudged moved; rate nudged",
    "cycles": "orbits dropped swapped turned; time tighter looser widened nudged moved; radius "
    "nudged moved; images dropped swapped doubled_in_place added turned",
    "superstable-motion": "box tighter; cells added; bounces tighter looser widened nudged; ratio "
    "nudged; rest nudged",
    "passes-separation": "bounces tighter looser widened",
    "single-solution": "phase tighter looser widened",
    "single-below-windows": "low nudged; ends tighter looser widened",
    "single-eta-windows": "low nudged",
    "single-nu-windows": "above tighter looser widened; below tighter looser widened; early "
    "doubled_in_place nudged moved",
    "grazing-curve": "box tighter looser widened nudged; slope nudged; matrix tighter narrowed "
    "looser nudged moved; times dropped swapped doubled_in_place nudged moved; amplitudes tighter "
    "looser widened nudged moved",
    "grazing-meets": "box tighter looser widened nudged; matrix doubled_in_place nudged moved; "
    "amplitude tighter looser widened nudged moved",
    "stable-singles": "most moved; cuts moved",
}


def may_be_accepted(rule, kind):
    """Whether such an edit leaves a witness that still proves something true."""
    field_of, _, change = kind.partition(" ")
    fields = (each.split() for each in ACCEPTED.get(rule, "").split(";"))
    return any(x[0] == field_of and change.replace(" ", "_") in x[1:] for x in fields if x)


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
            assert may_be_accepted(rule, kind), told
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
