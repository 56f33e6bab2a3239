"""Claim G16: a stable orbit beside the motion that rests, for all epsilon of an interval.

True values come from `reference` (equations (14) and (15) typed by hand, mpmath, 50 digits).
"""

import math
import random
from dataclasses import replace
from fractions import Fraction
from functools import cache
from itertools import pairwise

import pytest
from mpmath import mpf

from proofs.search import s34_attractors, s34_persistence
from proofs.trusted.certificate import Malformed
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.paper import find
from proofs.trusted.paper.s33_restitution.cycles import stable_cycle
from proofs.trusted.paper.s33_restitution.rebounds import Rebound, size
from proofs.trusted.paper.s34_circle.attractors import TwoAttractors
from proofs.trusted.paper.s34_circle.persistence import SuperstableMotion
from proofs.trusted.parameters import PAPER
from tests.oracles.judge import oracle
from tests.proofs.trusted.paper.steps import add, derive, edited

pytestmark = pytest.mark.slow

ETA, NU = mpf("0.2121"), mpf("-0.2")
MOTION = "superstable-motion-1"


def proved(monkeypatch, tries):
    branch = s34_attractors.branch
    monkeypatch.setattr(s34_persistence, "branch", lambda *given: branch(*given, tries))
    return s34_persistence.prove(PAPER, ("G16",))


@cache
def evidence():
    """A few intervals of epsilon, around 0.29."""
    with pytest.MonkeyPatch.context() as patch:
        return proved(patch, 3)


@cache
def known():
    return derive(evidence().steps)


def proof():
    return [known()[name] for name, _ in evidence().proofs["G16"]]


def both():
    motion, *cycles = proof()
    return TwoAttractors(motion, tuple(sorted(cycles, key=lambda each: each.at.epsilon)))


# -- what is concluded -----------------------------------------------------------------------------


def test_what_is_said():
    decision = find("G16").decide(PAPER, proof())
    assert find("G16").own and decision.verdict.value == "VERIFIED"
    (low, _), (_, high) = (
        decision.quantities[f"epsilon_proved_{end}"] for end in ("from", "up_to")
    )
    assert low < Fraction("0.2895") and high > Fraction("0.2905")
    for words in ("continuously on epsilon", "2-periodic", "asymptotically stable", "F^2"):
        assert words in decision.theorem
    assert "comes to rest" in decision.theorem and "two attractors" in decision.theorem
    assert oracle(both(), random.Random(1)) == []


def test_it_goes_nearly_to_the_fold_and_to_the_flip():
    """The multipliers of the printed equations are 1 near 0.28631, -1 near 0.29447."""
    with pytest.MonkeyPatch.context() as patch:
        found = proved(patch, s34_attractors._MOST)
    decision = find("G16").decide(PAPER, [step for _, step in found.proofs["G16"]])
    low, high = (decision.quantities[f"epsilon_proved_{end}"][0] for end in ("from", "up_to"))
    assert Fraction("0.2863") < low < Fraction("0.2865")
    assert Fraction("0.2932") < high < Fraction("0.2944")


# -- what it rests on ------------------------------------------------------------------------------


def test_nothing_is_decided_without_any_part():
    motion, *cycles = proof()
    row = find("G16")
    inner = sorted(cycles, key=lambda each: each.at.epsilon)[1]
    thin = replace(inner, at=replace(inner.at, epsilon=inner.at.epsilon[:1] * 2))
    elsewhere = replace(PAPER, eta=Fraction("0.2122"))
    assert row.decide(PAPER, [motion]).verdict.value == "UNDECIDED"
    assert row.decide(PAPER, cycles).verdict.value == "UNDECIDED"
    assert row.decide(PAPER, [motion, thin]).verdict.value == "UNDECIDED"
    assert row.decide(PAPER, [x for x in proof() if x != inner]).verdict.value == "UNDECIDED"
    assert row.decide(elsewhere, proof()).verdict.value == "UNDECIDED"


def at(cycle, *ends):
    return replace(cycle, at=replace(cycle.at, epsilon=tuple(map(Fraction, ends))))


def test_two_attractors_need_one_orbit_and_the_motion():
    motion, cycles = both().motion, both().cycles
    assert isinstance(motion, SuperstableMotion) and len(cycles) > 2
    first, second, *_ = cycles
    far = tuple((phases, (low + 1, high + 1)) for phases, (low, high) in second.boxes)
    later = tuple(((low + 1, high + 1), gammas) for (low, high), gammas in second.boxes)
    nu = replace(second, at=replace(second.at, nu=(Fraction("-0.21"),) * 2))
    end = first.at.epsilon[1]
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
        (first, at(second, end + Fraction(1, 10**9), second.at.epsilon[1])),
        (first, at(second, end - Fraction(1, 10**9), second.at.epsilon[1])),
    ):
        with pytest.raises(Unproved):
            TwoAttractors(motion, others)
    with pytest.raises(Unproved, match="for all these epsilon"):
        TwoAttractors(replace(motion, epsilons=(Fraction(0), cycles[-1].at.epsilon[0])), cycles)


# -- the theorem about boxes of epsilon ------------------------------------------------------------


@cache
def steps_of_one():
    """Boxes and centres of the last interval upwards."""
    name = [name for name, _ in evidence().proofs["G16"]][-1]
    witness = evidence().steps[name]["witness"]
    return [[known()[each] for each in witness[kind]] for kind in ("boxes", "centres")]


def moved(ends, amount):
    return ends[0] + amount, ends[1] + amount


def wider(step):
    (a, b), rest = step.derivative
    grown = tuple(3 * max(size(x), Fraction(1, 100)) for x in (a, b))
    return replace(step, derivative=(tuple((-x, x) for x in grown), rest))


TINY = Fraction(1, 100)


@pytest.mark.parametrize("place", [0, 1])
@pytest.mark.parametrize(
    ("kind", "change"),
    [
        (0, lambda x: replace(x, turns=x.turns + 1)),
        (0, lambda x: replace(x, at=replace(x.at, epsilon=x.at.epsilon[:1] * 2))),
        (0, lambda x: replace(x, phases=moved(x.phases, TINY))),
        (0, lambda x: replace(x, velocities=moved(x.velocities, TINY))),
        (0, wider),
        (1, lambda x: replace(x, turns=x.turns - 1)),
        (1, lambda x: replace(x, at=replace(x.at, epsilon=x.at.epsilon[:1] * 2))),
        (1, lambda x: replace(x, phases=moved(x.phases, TINY))),
        (1, lambda x: replace(x, velocities=moved(x.velocities, -TINY))),
        (1, lambda x: replace(x, phase=moved(x.phase, TINY))),
        (1, lambda x: replace(x, velocity=moved(x.velocity, -TINY))),
    ],
)
def test_each_hypothesis_is_asked_for(place, kind, change):
    assert isinstance(steps_of_one()[0][0], Rebound) and stable_cycle(*steps_of_one())
    edited_steps = [list(each) for each in steps_of_one()]
    edited_steps[kind][place] = change(edited_steps[kind][place])
    with pytest.raises(Unproved):
        stable_cycle(*edited_steps)


@pytest.mark.parametrize("place", [0, 1])
@pytest.mark.parametrize("side", ["phases", "velocities"])
def test_a_centre_lies_in_its_box(place, side):
    boxes, centres = (list(each) for each in steps_of_one())
    end = getattr(boxes[place], side)[1]
    centres[place] = replace(centres[place], **{side: (end, end + Fraction(1, 10**12))})
    with pytest.raises(Unproved, match="a centre is not in its box"):
        stable_cycle(boxes, centres)


def test_images_of_boxes_but_the_last_lie_in_the_next():
    boxes, centres = steps_of_one()
    for change in (
        {"phase": moved(boxes[0].phase, TINY)},
        {"velocity": (Fraction(-1), Fraction(0))},
    ):
        with pytest.raises(Unproved, match="a box is not proved to be mapped into the next"):
            stable_cycle([replace(boxes[0], **change), boxes[1]], centres)


def test_the_image_of_the_loop_needs_room():
    """The same boxes, with a derivative that contracts, but images about as far as the edges."""
    boxes, centres = steps_of_one()
    low, high = boxes[0].phases
    with pytest.raises(Unproved, match="mapped into itself"):
        stable_cycle(boxes, [centres[0], replace(centres[1], phase=(low, (low + high) / 2))])


def spiral(root, turn, shift=0):
    """F around 0: a rotation by an angle, times `root`, on boxes of half sides 1 / 100, and 0."""
    at, entries = both().cycles[0].at, [[math.cos(turn), -math.sin(turn)], [math.sin(turn)] * 2]
    entries[1][1] = math.cos(turn)
    rows = [[Fraction(root * x) for x in row] for row in entries]
    derivative = tuple(tuple((x, x) for x in row) for row in rows)
    found, sides = [], [Fraction(1, 100)] * 2
    for _ in range(8):
        box = [(1 - x, 1 + x) for x in sides]
        sides = [sum(abs(x) * side for x, side in zip(row, sides, strict=True)) for row in rows]
        image = [(1 - x, 1 + x) for x in sides]
        found.append(Rebound(at, *box, 0, *image, derivative))
    point = (Fraction(1),) * 2
    still = {"phases": point, "velocities": point, "phase": point, "velocity": moved(point, shift)}
    return found, [replace(each, **still) for each in found]


def test_an_orbit_around_which_states_turn():
    """|F'| expands every box, |(F^n)'| does not: the period is told from the boxes, and proved."""
    boxes, centres = spiral(0.8, 1.0)
    with pytest.raises(Unproved):
        stable_cycle(boxes[:1], centres[:1])
    assert stable_cycle(boxes[:2], centres[:2]).rounds == 2
    found = stable_cycle(boxes, centres)
    assert (found.boxes, found.rounds) == (((boxes[0].phases, boxes[0].velocities),), 8)
    assert "a 1-periodic orbit" in found.sentence and "F^8 contracts this box" in found.sentence
    apart = [replace(centres[0], phase=moved(centres[0].phase, Fraction(1, 100))), *centres[1:]]
    with pytest.raises(Unproved):  # a centre that leads elsewhere
        stable_cycle(boxes, apart)
    with pytest.raises(Unproved):
        replace(found, rounds=0)
    with pytest.raises(Unproved, match="several rounds"):
        replace(both(), cycles=(replace(both().cycles[0], rounds=2), *both().cycles[1:]))


def test_the_period_of_an_orbit_is_proved():
    """F^2 contracts by 1/100, but F^1 leads out of the box: no orbit of period 1."""
    boxes, centres = spiral(0.1, 0.0)
    wide = tuple(((row[0][0] * 500,) * 2, row[1]) for row in boxes[0].derivative)
    first = replace(boxes[0], derivative=wide)
    flat = tuple(((Fraction(0),) * 2,) * 2 for _ in range(2))
    second = replace(boxes[1], derivative=flat)
    assert stable_cycle([boxes[0], second], centres[:2]).rounds == 2
    away = replace(centres[1], phase=moved(centres[1].phase, Fraction(1, 200)))
    with pytest.raises(Unproved, match="period"):
        stable_cycle([first, second], [centres[0], away])


def test_the_intervals_meet():
    ends = [each.at.epsilon for each in both().cycles]
    assert all(one[1] == two[0] for one, two in pairwise(ends))
    assert both().at.epsilon == (ends[0][0], ends[-1][1])


def rebound_steps():
    name = evidence().proofs["G16"][-1][0]
    witness = evidence().steps[name]["witness"]
    names = [*witness["boxes"], *witness["centres"], name]
    return {each: evidence().steps[each] for each in names}


NAME = -1  # stands for the cycle's own name
EDITS = [
    ((NAME, "boxes"), lambda names: names[::-1]),
    ((NAME, "boxes"), lambda names: names[:1]),
    ((NAME, "boxes"), lambda names: [names[0], names[0]]),
    ((NAME, "boxes"), lambda names: []),
    ((NAME, "centres"), lambda names: names[::-1]),
    ((NAME, "centres"), lambda names: names[:1]),
    ((0, "epsilon", 1), add("1/1000")),
    ((0, "epsilon", 0), add("-1/1000")),
    ((0, "phases", 1), add("1/100")),
    ((1, "velocities", 0), add("-1/100")),
    ((2, "epsilon"), lambda ends: [ends[0], ends[0]]),
    ((2, "phases"), lambda ends: [add("1/1000")(end) for end in ends]),
    ((3, "phases", 0), add("1/10000")),
    ((3, "impact", 0), add("1/10")),
]


@pytest.mark.parametrize(("path", "change"), EDITS)
def test_an_edited_witness_is_refused(path, change):
    steps = rebound_steps()
    names = list(steps)
    derive(steps)
    with pytest.raises((Unproved, Malformed)):
        derive(edited(steps, (names[path[0]], "witness", *path[1:]), change))
