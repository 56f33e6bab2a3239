"""What the checker accepts of edited documents is true, as far as the oracles see."""

from contextlib import ExitStack

import pytest

from tests.oracles.falsifier import ODD, report, run, run_rules
from tests.oracles.holes import ASKED, EQUAL, GAP, ORDER, PLACES, POINT, Lines, reopened

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


OF_IMAGES = Lines("kernel.differential:_inside", (("all(within", "any(within"),))


@pytest.fixture
def files_of_no_claims(monkeypatch):
    monkeypatch.setattr("tests.oracles.falsifier.certificates", list)


@pytest.mark.usefixtures("files_of_no_claims")
def test_what_is_accepted_of_edited_files_about_maps_and_boxes_is_true():
    found = run_rules(30, seed=5)
    assert found.accepted == 30
    assert found.refused > 15
    assert len(found.rules) > 8
    assert not found.complaints, report(found)


@pytest.mark.usefixtures("files_of_no_claims")
def test_a_hole_of_the_kernel_is_found_by_edits_alone():
    with reopened(OF_IMAGES):
        assert run_rules(80, only=("image",), enough=1).complaints
