"""What the checker accepts of edited documents is true, as far as the oracles see."""

import importlib
import inspect
import textwrap
from contextlib import ExitStack, contextmanager
from typing import Any, NamedTuple

import pytest

from tests.oracles.falsifier import ODD, report, rules_of, run

pytestmark = pytest.mark.slow


# -- the holes that a hostile audit found, to be put back one by one -------------------------------


class Lines(NamedTuple):
    """A function, "module:name" below proofs.trusted, and pieces of it as they are and were."""

    where: str
    pieces: tuple[tuple[str, str], ...]


@contextmanager
def reopened(lines):
    """The function as it was."""
    name, _, path = lines.where.partition(":")
    module = importlib.import_module(f"proofs.trusted.{name}")
    function = module
    for part in path.split("."):
        function = getattr(function, part)
    source = textwrap.dedent(inspect.getsource(function))
    for closed, opened in lines.pieces:
        assert closed in source, f"{lines.where} has no {closed!r}"
        source = source.replace(closed, opened)
    made: dict[str, Any] = {}
    exec(f"from __future__ import annotations\n{source}", vars(module), made)
    code = getattr(made[function.__name__], "__func__", made[function.__name__]).__code__
    function.__code__, before = code, function.__code__
    try:
        yield
    finally:
        function.__code__ = before


ORDER = (
    Lines(
        "kernel.staying:staying_set",
        (
            ("sorted(cells, key=lambda x: x.domain)", "list(cells)"),
            ('raise Unproved("cells overlap")', "pass"),
        ),
    ),
    Lines(
        "kernel.staying:StayingSet.__post_init__",
        (("not apart(self.cells)", "False"),),
    ),
)
ASKED = Lines("verdicts:Row.is_asked", (("self.printed_at is None", "True"),))
PLACES = Lines(
    "paper.s34_circle.circle:_is_the_printed_orbit",
    (("all(within(phase, (x - _HALF, x + _HALF)) for x, phase in printed)", "True"),),
)
GAP = Lines("paper.s32_sets.linear:LinearSet.__post_init__", (("sum(self.ratios) >= 1", "False"),))
EQUAL = Lines(
    "paper.s32_sets.linear_steps:_gap_estimates",
    (("if true and false:", "if False:"), ("if true:", "if not false:")),
)
POINT = (
    Lines("numbers:Phases._require", (("low < high", "low <= high"),)),
    Lines("paper.s34_circle.landing:never_impacts", (("phases[0] < phases[1]", "True"),)),
)


# -- what the falsifier finds ----------------------------------------------------------------------


@pytest.fixture
def files_of_no_claims(monkeypatch):
    monkeypatch.setattr("tests.oracles.falsifier.certificates", list)


def require_true(wanted, seed, **options):
    """So many edited documents are accepted, others are refused, and all say what is so."""
    found = run(wanted, seed, **options)
    assert found.accepted == wanted
    assert found.refused > wanted // 2
    assert not found.complaints, report(found)
    return found


CLAIMS = {"H2", "H4", "H8", "H12", "H16", "M5", "M9", "N2", "P3", "R3", "S5", "S11", "A2", "G4"}
RULES = {
    "covers",
    "h-set",
    "image",
    "separation",
    "sticking-motion",
    "stable-singles",
    "unique-zero",
}


def test_what_is_accepted_of_edited_documents_is_true():
    assert len(require_true(40, 3, only=CLAIMS).conclusions) > 10


@pytest.mark.usefixtures("files_of_no_claims")
def test_what_is_accepted_of_edited_files_about_maps_and_boxes_is_true():
    assert {*require_true(30, 5, only=RULES, targets=rules_of).rules} >= RULES


@pytest.mark.long
def test_thousands_that_are_accepted_are_true():
    require_true(5000, 4, odd=ODD)


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


@pytest.mark.usefixtures("files_of_no_claims")
def test_a_hole_of_the_kernel_is_found_by_edits_alone():
    with reopened(OF_IMAGES):
        assert run(80, only=("image",), enough=1, targets=rules_of).complaints
