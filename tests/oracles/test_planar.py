"""The judges of a file's own maps of the plane see what is not so."""

import random
from dataclasses import replace
from fractions import Fraction

import pytest

from proofs.trusted.verify import premises
from tests.oracles.judge import oracle
from tests.proofs.trusted.kernel.lemma_examples import text

KNOWN = premises(text("rectangles")).known
TENTH = Fraction(1, 10)


def moved(box):
    return tuple((low + TENTH, high + TENTH) for low, high in box)


LIES = {
    "rectangle-1": [
        lambda x: replace(x, edges=tuple(map(moved, x.edges))),
        lambda x: replace(x, edges=x.edges[::-1]),
    ],
    "horseshoe-1": [
        lambda x: replace(x, margin=x.margin + TENTH),
        lambda x: replace(x, boxes=tuple((side, (0, TENTH / 4)) for side, _ in x.boxes)),
    ],
    "barred-word-1": [lambda x: replace(x, boxes=KNOWN["horseshoe-1"].boxes)],
    "differential-1": [
        lambda x: replace(x, values=moved(x.values)),
        lambda x: replace(x, matrix=x.matrix[::-1]),
    ],
    "stable-cycle-1": [
        lambda x: replace(x, boxes=tuple(map(moved, x.boxes))),
        lambda x: replace(x, boxes=x.boxes[:1]),
    ],
}


@pytest.mark.parametrize(
    ("name", "lie"), [(name, lie) for name, lies in LIES.items() for lie in lies]
)
def test_lies_about_maps_of_the_plane_are_seen(name, lie):
    assert oracle(KNOWN[name], random.Random(1)) == []
    assert oracle(lie(KNOWN[name]), random.Random(1)) != []
