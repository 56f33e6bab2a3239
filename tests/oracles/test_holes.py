"""The oracles find each hole of the audit, as long as the checker still has it."""

import random

import pytest

from tests.oracles.holes import HOLES
from tests.oracles.judge import oracle
from tests.oracles.sources import conclusions, rows
from tests.oracles.verdicts import verdict_oracle


def complaints(made, decided, of, known):
    """All that the oracles say about a document's conclusions and rows."""
    for name in {name for claim, *_ in decided for name in made["proofs"][claim]}:
        yield from oracle(known[name], random.Random(0), of)
    for claim, verdict, texts, shown in decided:
        yield from verdict_oracle(claim, of, verdict, texts)
        yield from (x for one in shown for x in oracle(one, random.Random(0), of))


@pytest.mark.parametrize("hole", HOLES, ids=lambda hole: hole.name)
def test_a_hole_is_found(hole):
    made = hole.make()
    try:
        of, known = conclusions(made)
        decided = list(rows(made, hole.claims, of, known))
    except ValueError as error:
        pytest.skip(f"closed: {error}")
    if any(verdict != hole.false for _, verdict, *_ in decided):
        pytest.skip(f"closed: {decided[0][1]}")
    told = list(complaints(made, decided, of, known))
    assert any(hole.told in one for one in told), told
