"""Boxes that a map takes into their interior: truths beside simulation, and lies."""

import json
import random
from fractions import Fraction
from itertools import product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from proofs.trusted.certificate import Malformed
from proofs.trusted.files import render
from proofs.trusted.kernel.trapping import Trapped, outside
from proofs.trusted.verify import Rejected, check
from tests.oracles.judge import oracle
from tests.proofs.trusted.kernel.lemma_examples import text

UNION, RING = "trapping-1", "trapping-2"


def edited(*edits):
    """The example with other entries, by their paths below the steps, or from `functions` on."""
    document = json.loads(text("trapping"))
    for path, value in edits:
        place = document if path[0] == "functions" else document["steps"]
        for key in path[:-1]:
            place = place[key]
        assert place[path[-1]] != value
        place[path[-1]] = value
    return render(document)


def trapped_by(source):
    return [each for each in check(source).conclusions if isinstance(each, Trapped)]


def test_what_is_said_is_so():
    union, ring = trapped_by(text("trapping"))
    for said in ("is continuous on T, the union of the 2 boxes", "form a compact set K"):
        assert said in union.sentence
    assert "fixed point" not in union.sentence and "fixed point" not in ring.sentence
    for each in (union, ring):
        assert oracle(each, random.Random("trapping")) == []


def test_one_box_has_a_fixed_point():
    whole = [["0", "2"], ["0", "1"]]
    steps = [
        (("image-1", "witness", "box"), whole),
        (("image-1", "witness", "bounds"), [["3/4", "5/4"], ["1/10", "7/8"]]),
        ((UNION, "witness", "images"), ["image-1"]),
    ]
    one, _ = trapped_by(edited(*steps))
    assert "`F` has a fixed point in T" in one.sentence and "the box `x` in [0, 2]" in one.sentence


OF_FIRST, OF_LAST, OF_RING = (
    ("image-1", "witness"),
    ("image-2", "witness"),
    ("image-3", "witness"),
)
MAY_BE = "may be in it"
LIES = [  # what is false, the edits, the reason
    ("a gap between the boxes", [((*OF_LAST, "box", 0), ["101/100", "2"])], MAY_BE),
    ("a hole at a side", [((*OF_FIRST, "box", 1), ["1/5", "1"])], MAY_BE),
    ("images that end at a side", [((*OF_FIRST, "box", 1), ["1/10", "1"])], MAY_BE),
    ("bounds too wide", [((*OF_FIRST, "bounds", 1), ["1/10", "1"])], MAY_BE),
    ("bounds too narrow", [((*OF_FIRST, "bounds", 1), ["1/10", "1/2"])], "not proved on"),
    ("one box of two", [((UNION, "witness", "images"), ["image-1"])], MAY_BE),
    ("the other box", [((UNION, "witness", "images"), ["image-2"])], MAY_BE),
    ("two maps", [((UNION, "witness", "images"), ["image-1", "image-3"])], "different maps"),
    ("no image", [((UNION, "witness", "images"), [])], "entries"),
    ("no step", [((UNION, "witness", "images"), ["image-9"])], "names no earlier step"),
    ("an angle not all around", [((*OF_RING, "box", 0), ["0", "6"])], "all around"),
    ("a velocity that leaves", [((*OF_RING, "box", 1), ["-3/4", "3/4"])], MAY_BE),
    ("another map", [(("functions", "F", "values", 0), "x/4 + 4/5")], "not proved on"),
    ("fewer values than variables", [(("functions", "F", "values"), ["x/4 + 3/4"])], "entries"),
]


@pytest.mark.parametrize(("edits", "reason"), [x[1:] for x in LIES], ids=[x[0] for x in LIES])
def test_lies(edits, reason):
    with pytest.raises((Rejected, Malformed)) as caught:
        check(edited(*edits))
    assert reason in str(caught.value)


SIDES = st.tuples(st.integers(0, 6), st.integers(0, 6)).map(lambda x: tuple(sorted(x)))
BOXES = st.tuples(SIDES, SIDES)


@given(BOXES, st.lists(BOXES, max_size=5))
def test_what_is_left_of_a_box_is_in_no_other(box, union):
    """By points between those of the grid, and on it."""
    rest = outside(box, union)

    def among(point, boxes):
        return any(
            all(a <= x <= b for x, (a, b) in zip(point, each, strict=True)) for each in boxes
        )

    grid = [Fraction(k, 2) for k in range(13)]
    for point in product(grid, grid):
        if among(point, [box]):
            assert among(point, union) or among(point, rest)
        else:
            assert not among(point, rest)
    for part in rest:
        inner = [(a + b) / Fraction(2) for a, b in part]
        assert any(a == b for a, b in part) or not among(inner, union)
