"""Each rule of the paper's sections on a true witness, edited in every way: refused, or true.

The edits are those of `mutations`. What is accepted says the same, or says what the oracles, which
know nothing of the checker, do not contradict.
"""

import json
import random
from collections import Counter
from dataclasses import replace
from fractions import Fraction
from functools import cache, partial
from itertools import permutations

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
from proofs.trusted.kernel.meter import Exhausted, metered
from proofs.trusted.parameters import PAPER, Parameters, Place
from proofs.trusted.rules import RULES
from proofs.trusted.verify import derive, premises
from tests.once import EFFORT, committed, once, report
from tests.oracles.judge import oracle
from tests.proofs.trusted import renewing
from tests.proofs.trusted.edits import at, edited, put, walk
from tests.proofs.trusted.kernel.lemma_examples import EXAMPLES
from tests.proofs.trusted.kernel.lemma_examples import text as lemma
from tests.proofs.trusted.mutations import field, inside, is_number

TEN_PIECES = replace(PAPER, eta=Fraction("0.21"))  # of the circle: few, so that all is soon derived
ALL_STICK, AFTER_THE_ARC = (
    Place(*(tuple(map(Fraction, side)) for side in sides))
    for sides in (
        (("0.3", "0.302"), ("0.19", "0.192")),
        (("0.2378", "0.2382"), ("-0.2059", "-0.2055")),
    )
)
WORK = 3_000_000
REFUSED = (*renewing.REFUSED, Exhausted)


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
    made = Curves(Fraction(0))
    made.grazing(2, [x for x in seen_curves(2, Fraction(0))[-1] if 1.41 < x.eta < 1.45])
    return made.derivation.steps


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
    """For each rule the shortest step of the committed files, of reports before lemmas."""
    steps = {}
    texts = {x: text for x, text in committed().items() if not x.startswith("systems/")}
    for file, text in (texts | {name: lemma(name) for name in EXAMPLES}).items():
        for name, step in json.loads(text)["steps"].items():
            place = file in EXAMPLES, len(json.dumps(step)), file, name
            steps.setdefault(step["rule"], []).append(place)
    return {rule: min(each)[2:] for rule, each in steps.items()}


LENGTHY = "dimension", "grazing-curve"
SMALLER = dict.fromkeys(("branch", "lands", "absorption"), (PAPER, coarse))
SMALLER |= dict.fromkeys(
    ("pieces", "itinerary-graph", "expansion", "grazing"), (TEN_PIECES, few_pieces)
)


SMALLER |= {"grazing-curve": (None, grazing_curve), "grazing-meets": (None, grazing_curve)}
SMALLER |= {
    "sticking-motion@all": (ALL_STICK, settling),
    "sticking-motion": (AFTER_THE_ARC, coming_back),
}


SHAPES = {  # other steps by a rule, whose witnesses have other fields
    ("single-windows", "above"): ("single.json", "single-windows-1"),
    ("single-windows", "below"): ("single.json", "single-windows-2"),
    ("superstable-motion", "passes"): ("persistence.json", "superstable-motion-3"),
}


def source(rule):
    """Steps, what they prove, the name of one by this rule, or of the other shape after an @."""
    shape, (rule, _, named) = rule, rule.partition("@")
    if shape in SMALLER:
        steps, context = SMALLER[shape][1](), derived(*SMALLER[shape])
        return steps, context, next(x for x, step in steps.items() if step["rule"] == rule)
    file, name = SHAPES[rule, named] if named else shortest()[rule]
    text = lemma(file) if file in EXAMPLES else committed()[file]
    context = premises(text) if file in EXAMPLES or "/" in file else report(file[:-5]).context
    return json.loads(text)["steps"], context, name


def sharper(witness):
    """Numbers at bounds, like others, and just beside those before and behind: kind, path, edit."""
    little = Fraction(1, 10**9)
    for path, value in walk(witness):
        if is_number(value):
            yield from ((f"put to {bound}", path, put(path, bound)) for bound in "01" if path)
        elif isinstance(value, list) and all(map(is_number, value)):
            for i, j in (pair for k in range(1, len(value)) for pair in ((k, k - 1), (k - 1, k))):
                near = Fraction(value[j]) + (little if i > j else -little)
                yield "put beside", (*path, i), put((*path, i), str(near))
        elif isinstance(value, dict):
            numbers = [key for key in value if is_number(value[key])]
            for one, other in permutations(numbers, 2):
                yield "put alike", (*path, one), put((*path, one), value[other])


def edits(steps, name):
    """A file with the witness of a step, and its edits, by what is done to which field."""
    base = ("steps", name, "witness")
    around = {**{other: {} for other in steps}, name: steps[name]}
    document = {"parameters": {}, "functions": {}, "steps": around, "claims": []}
    kinds = {}
    for kind, path, edit in inside(document):
        if path[:3] == base:
            kinds.setdefault(f"{field(path[3:])} {kind}", []).append((path[3:], edit))
    for kind, path, edit in sharper(around[name]["witness"]):
        whole = partial(_within, base, edit)
        kinds.setdefault(f"{field(path)} {kind}", []).append((path, whole))
    return document, kinds


def _within(place, edit, document):
    edit(at(document, place))


def again(context, name, rule, witness):
    """What a step concludes with another witness."""
    known = {x: each for x, each in context.known.items() if x != name}
    result = Context(context.parameters, context.functions, known)
    with metered(WORK):
        derive(result, Reader({name: {"rule": rule, "witness": witness}}))
    return result.known[name]


OWN = [rule for rule, place in RULES.items() if not place.startswith("kernel.")]
OWN += ["sticking-motion@all", *map("@".join, SHAPES)]
OWN += ["moran-root", "itinerary", "staying-set", "covering-graph", "stable-orbit"]


ACCEPTED = {  # what may be done to which field, in some places; all else is refused
    "avoids": "points dropped nudged moved put_beside; target tighter narrowed nudged put_beside",
    "moran-root": "ratios turned; root tighter looser widened",
    "itinerary": "slopes dropped swapped doubled_in_place added turned another; phase moved "
    "put_to_0 put_to_1",
    "dimension": "hull nudged; words turned put_to_0 put_to_1; rho nudged moved; arcs moved "
    "put_alike; paths dropped nudged moved put_to_0; radii tighter narrowed looser aside collapsed "
    "turned nudged moved put_beside; nodes moved put_alike; exponent nudged; growth nudged "
    "put_to_1; test dropped swapped doubled_in_place added nudged moved put_beside put_to_0 "
    "put_to_1; bits moved",
    "separation": "phase tighter narrowed looser nudged",
    "lands": "cuts dropped nudged moved put_beside put_to_0",
    "never-impacts": "phases tighter narrowed nudged put_beside",
    "absorption": "never other_type dropped emptied; lands swapped turned; cells dropped swapped "
    "emptied turned; cuts nudged moved; times nudged moved; after nudged moved; impacts moved "
    "put_to_1",
    "staying-set": "cells swapped turned; gaps added",
    "branch": "cuts nudged moved put_beside put_to_1; ends nudged moved put_beside",
    "covering-graph": "images swapped added turned; time tighter narrowed nudged moved; states "
    "nudged; weights nudged moved put_to_1; growth nudged moved put_to_1",
    "grazing": "phases tighter narrowed looser nudged; times nudged moved put_beside; landing "
    "tighter looser widened nudged moved",
    "pieces": "branches swapped turned; after nudged moved; grazings swapped turned",
    "itinerary-graph": "images swapped added turned; time tighter looser widened nudged moved "
    "put_beside; states swapped doubled_in_place aside collapsed; weights put_to_1 swapped "
    "doubled_in_place nudged moved put_beside; growth nudged moved",
    "expansion": "cuts nudged; times nudged; scales doubled_in_place nudged moved put_beside "
    "put_to_1; rate nudged; orbits dropped swapped turned; time tighter looser widened nudged "
    "moved put_beside; radius nudged moved; images dropped swapped doubled_in_place added turned",
    "superstable-motion": "box tighter; cells added; bounces tighter looser widened nudged "
    "put_beside",
    "superstable-motion@passes": "box tighter; bounces tighter looser widened",
    "single-solution": "phase tighter looser widened; n put_to_1; latest other_type nudged moved",
    "single-windows": "above tighter looser widened; below tighter looser widened; early "
    "doubled_in_place nudged moved put_beside",
    "single-windows@above": "low nudged",
    "single-windows@below": "low nudged; ends tighter looser widened",
    "grazing-curve": "box tighter looser widened nudged; slope nudged put_to_0; matrix tighter "
    "narrowed looser nudged moved put_beside put_to_0; times dropped swapped doubled_in_place "
    "nudged moved put_beside put_to_1; epsilon put_to_0; points dropped emptied swapped turned "
    "doubled_in_place added",
    "grazing-meets": "box tighter looser widened nudged put_beside; matrix doubled_in_place nudged "
    "moved put_beside put_to_0",
    "stable-singles": "most moved put_to_1; n put_alike put_to_1; cuts moved put_alike put_to_1",
}


def may_be_accepted(rule, kind):
    """Whether such an edit leaves a witness that still proves something true."""
    field_of, _, change = kind.partition(" ")
    fields = (each.split() for each in ACCEPTED.get(rule, "").split(";"))
    return any(x[0] == field_of and change.replace(" ", "_") in x[1:] for x in fields if x)


def verify(rule, most):
    """Assert that each edit is refused, or proves what is true; so many of each kind are made."""
    shape = rule
    (steps, context, name), chance = source(rule), random.Random(rule)
    rule, own, counts = rule.partition("@")[0], context.known[name], Counter()
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
            assert may_be_accepted(shape, kind), told
            if found.sentence != own.sentence:
                assert not list(oracle(found, random.Random(1), of)), told
    assert counts["refused"] > counts["accepted"]


BY_SPEED = [pytest.param(x, marks=[pytest.mark.slow] * (x in LENGTHY)) for x in OWN]


@pytest.mark.parametrize("rule", BY_SPEED)
def test_an_edited_witness_is_refused_or_true(rule):
    verify(rule, 1 if EFFORT.quick or rule in LENGTHY else 2)
