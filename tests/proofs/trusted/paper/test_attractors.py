"""Claim G16: a stable orbit beside the motion that rests, for all epsilon of an interval.

True values come from `reference` (equations (14) and (15) typed by hand, mpmath, 50 digits).
"""

import random
from dataclasses import replace
from fractions import Fraction
from fractions import Fraction as F
from itertools import pairwise

import flint
import pytest

from proofs.trusted.certificate import Malformed
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.oscillator import Oscillator
from proofs.trusted.paper import find
from proofs.trusted.paper.s34_circle.attractors import TwoAttractors
from proofs.trusted.paper.s34_circle.cycles import Cycles, touching
from proofs.trusted.paper.s34_circle.landing import NeverImpacts
from proofs.trusted.paper.s34_circle.persistence import SuperstableMotion
from proofs.trusted.parameters import PAPER
from tests.oracles.judge import oracle, view
from tests.oracles.laps import graze
from tests.proofs.trusted.paper.steps import add, derive, edited, evidence, known_of

pytestmark = pytest.mark.slow


def proof():
    return [each for _, each in evidence("persistence").proofs["G16"]]


def both():
    motion, *cycles = proof()
    return TwoAttractors(motion, tuple(sorted(cycles, key=lambda each: each.place.epsilon)))


# -- what is concluded -----------------------------------------------------------------------------


def test_what_is_said():
    decision = find("G16").decide(PAPER, proof())
    assert find("G16").own and decision.verdict.value == "VERIFIED"
    for words in ("continuously on epsilon", "2-periodic", "asymptotically stable", "F^2"):
        assert words in decision.theorem
    assert "comes to rest" in decision.theorem and "two attractors" in decision.theorem
    assert oracle(both(), random.Random(1)) == []


def test_nothing_is_decided_without_any_part():
    motion, *cycles = proof()
    row = find("G16")
    inner = sorted(cycles, key=lambda each: each.place.epsilon)[1]
    thin = at(inner, *inner.place.epsilon[:1] * 2)
    elsewhere = replace(PAPER, eta=Fraction("0.2122"))
    assert row.decide(PAPER, [motion]).verdict.value == "UNDECIDED"
    assert row.decide(PAPER, cycles).verdict.value == "UNDECIDED"
    assert row.decide(PAPER, [motion, thin]).verdict.value == "UNDECIDED"
    assert row.decide(PAPER, [x for x in proof() if x != inner]).verdict.value == "UNDECIDED"
    assert row.decide(elsewhere, proof()).verdict.value == "UNDECIDED"


# -- what it rests on ------------------------------------------------------------------------------


def at(cycle, *ends, **sides):
    place = replace(cycle.place, epsilon=tuple(map(Fraction, ends)), **sides)
    return replace(cycle, function=Oscillator(place.sides))


def test_two_attractors_need_one_orbit_and_the_motion():
    motion, cycles = both().motion, both().cycles
    assert isinstance(motion, SuperstableMotion) and len(cycles) > 2
    first, second, *_ = cycles
    far = tuple((phases, (low + 1, high + 1)) for phases, (low, high) in second.boxes)
    later = tuple(((low + 1, high + 1), gammas) for (low, high), gammas in second.boxes)
    nu = at(second, *second.place.epsilon, nu=(Fraction("-0.21"),) * 2)
    end = first.place.epsilon[1]
    for others in (
        (),
        (second, first),
        (first, first),
        cycles[::2],
        (at(first, 0, end), second),
        (first, nu),
        (first, replace(second, boxes=far)),
        (first, replace(second, boxes=later)),
        (first, replace(second, boxes=second.boxes[:1])),
        (first, replace(second, boxes=second.boxes[::-1])),
        (first, at(second, end + Fraction(1, 10**9), second.place.epsilon[1])),
        (first, at(second, end - Fraction(1, 10**9), second.place.epsilon[1])),
    ):
        with pytest.raises(Unproved):
            TwoAttractors(motion, others)
    with pytest.raises(Unproved, match="for all these epsilon"):
        TwoAttractors(replace(motion, epsilons=(Fraction(0), cycles[-1].place.epsilon[0])), cycles)


def test_one_round_is_needed():
    """What contracts a box after several rounds only does not depend continuously on epsilon."""
    first, *others = both().cycles
    with pytest.raises(Unproved, match="several rounds"):
        replace(both(), cycles=(replace(first, rounds=2), *others))


def test_the_intervals_meet():
    ends = [each.place.epsilon for each in both().cycles]
    assert all(one[1] == two[0] for one, two in pairwise(ends))
    assert both().at.epsilon == (ends[0][0], ends[-1][1])


EDITS = [
    (("orbit", "function", "epsilon", 1), add("1/1000")),
    (("orbit", "function", "eta"), lambda ends: [add("1/1000")(end) for end in ends]),
    (("orbit", "box"), lambda box: box[::-1]),
]


@pytest.mark.parametrize(("path", "change"), EDITS)
def test_an_edited_witness_is_refused(path, change):
    name = evidence("persistence").proofs["G16"][-1][0]
    steps = {name: evidence("persistence").steps[name]}
    derive(steps)
    with pytest.raises((Unproved, Malformed)):
        derive(edited(steps, (name, "witness", *path), change))


# -- the periodic orbit through two grazes that is there exactly if a touch counts as an impact ----


@pytest.fixture(scope="module")
def found():
    (cycles,) = (each for each in known_of("entropy").values() if isinstance(each, Cycles))
    return cycles


@pytest.fixture(scope="module")
def grazes(found):
    """What never impacts, and the grazes on both sides."""
    arcs = found.expansion.pieces.arcs
    place = next(i for i, each in enumerate(arcs) if isinstance(each, NeverImpacts))
    return place, arcs[place - 1], arcs[place + 1]


def test_each_graze_is_a_touch_at_the_other_one(grazes):
    _, a, b = grazes
    (first, there, *_), (last, back, *_) = graze(view(a)), graze(view(b))
    with flint.ctx.workprec(240):
        turns = [x / (2 * flint.arb.pi()) for x in (first + there - last, last + back - first)]
        assert all(abs(x - round(float(x))) < 1e-20 for x in turns)
        assert abs(sum(turns) - 10000) < 1e-20


def test_the_word_is_told_apart_from_those_that_are_open(found):
    assert found.touching == touching(found.expansion) == (5, 6)
    assert found.touching not in found.words + found.left
    assert found.counts[1] == (32, 32)
    assert (
        "If a touch without relative velocity counts as an impact, there is one" in found.sentence
    )


def changed(found, place, **sides):
    """The expansion with the grazes beside what never impacts replaced."""
    arcs = list(found.expansion.pieces.arcs)
    for side, fields in sides.items():
        at = place + (-1 if side == "a" else 1)
        arcs[at] = replace(arcs[at], **fields)
    pieces = replace(found.expansion.pieces, arcs=tuple(arcs))
    return replace(found.expansion, pieces=pieces)


def test_without_a_hypothesis_there_is_no_such_word(found, grazes):
    place, a, b = grazes
    later = F(1, 100)
    for lie in (
        {"a": {"time": (a.time[0] - 1, a.time[1] - 1)}},  # the touch is elsewhere
        {"b": {"time": (b.time[0] + 1, b.time[1] + 1)}},
        {"a": {"landing": (b.time[0], b.time[0] + later)}},  # an impact within q turns
        {"b": {"landing": (a.time[0], a.time[0] + later)}},
    ):
        assert touching(changed(found, place, **lie)) is None
