"""What the checker accepts of edited documents is true, as far as the oracles see."""

from contextlib import ExitStack

import pytest

from tests.oracles.falsifier import ODD, report, run
from tests.oracles.holes import ASKED, EQUAL, GAP, ORDER, PLACES, POINT, reopened

pytestmark = pytest.mark.slow


def test_what_is_accepted_of_edited_documents_is_true():
    found = run(40, seed=3)
    assert found.accepted == 40
    assert found.refused > 20
    assert len(found.conclusions) > 15
    assert not found.complaints, report(found)


@pytest.mark.long
def test_thousands_that_are_accepted_are_true():
    found = run(5000, seed=4, odd=ODD)
    assert found.accepted == 5000
    assert not found.complaints, report(found)


@pytest.mark.parametrize(
    ("claim", "lines", "odd"),
    [
        ("G5", ORDER, ()),
        ("H15", (EQUAL,), ()),
        ("H17", (GAP,), ()),
        ("M6", POINT, ()),
        ("G3", (ASKED, PLACES), (ODD[4],)),
    ],
)
def test_holes_are_found_by_edits_alone(claim, lines, odd):
    """Only the image that straddles 2 pi takes a document that is made for it."""
    with ExitStack() as stack:
        for each in lines:
            stack.enter_context(reopened(each))
        assert run(80, odd=odd, only=(claim,), enough=1).complaints
