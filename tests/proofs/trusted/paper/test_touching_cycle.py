"""The periodic orbit through two grazes that is there exactly if a touch counts as an impact: G18.

Against the gap typed by hand, at the paper's oscillator; and without each hypothesis.
"""

from dataclasses import replace
from fractions import Fraction as F

import flint
import pytest

from proofs.trusted.paper.s34_circle.cycles import Cycles, touching
from proofs.trusted.paper.s34_circle.landing import NeverImpacts
from tests.oracles.adapter import view
from tests.oracles.laps import graze
from tests.proofs.trusted.paper.steps import known_of

pytestmark = pytest.mark.slow  # all that is proved of the entropy is derived


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
