"""The oracles find each hole of the audit when it is put back; as they are, all are closed."""

import random
from contextlib import ExitStack
from functools import cache

import pytest

from proofs.trusted.certificate import Malformed, Reader
from proofs.trusted.verify import Rejected
from tests.oracles.holes import HOLES, reopened
from tests.oracles.judge import oracle
from tests.oracles.sources import conclusions, rows
from tests.oracles.verdicts import verdict_oracle

pytestmark = pytest.mark.slow


@cache
def document(hole):
    return hole.make()


def decided(hole):
    """The verdict of the hole's claim, and all that the oracles say about it."""
    made = document(hole)
    names = set(made["proofs"][hole.claim])
    for name, step in reversed(made["steps"].items()):
        names |= set(Reader(step).mentioned()) if name in names else set()
    steps = {name: step for name, step in made["steps"].items() if name in names}
    of, known = conclusions({**made, "steps": steps})
    ((_, verdict, shown),) = rows(made, [hole.claim], of, known)
    told = verdict_oracle(hole.claim, of, verdict)
    for one in (*(known[name] for name in made["proofs"][hole.claim]), *shown):
        told += oracle(one, random.Random(0), of)
    return verdict, told


@pytest.mark.parametrize("hole", HOLES, ids=lambda hole: hole.name)
def test_a_hole_that_is_put_back_is_found(hole):
    with ExitStack() as stack:
        for lines in hole.lines:
            stack.enter_context(reopened(lines))
        verdict, told = decided(hole)
    assert verdict == hole.false
    assert any(hole.told in one for one in told), told


@pytest.mark.parametrize("hole", HOLES, ids=lambda hole: hole.name)
def test_a_hole_is_closed(hole):
    try:
        _, told = decided(hole)
    except (Rejected, Malformed):
        return
    assert not told
