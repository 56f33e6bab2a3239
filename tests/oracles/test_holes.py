"""The oracles find each hole of the audit, as long as the checker still has it."""

import random

import pytest

from tests.oracles.holes import HOLES
from tests.oracles.judge import oracle
from tests.oracles.sources import conclusions, rows
from tests.oracles.verdicts import verdict_oracle


def complaints(made, claims):
    """All that the oracles say about a document's conclusions and rows."""
    of, known = conclusions(made)
    for name in {name for claim in claims for name in made["proofs"][claim]}:
        yield from oracle(known[name], random.Random(0), of)
    for claim, verdict, texts in rows(made, claims):
        yield from verdict_oracle(claim, of, verdict, texts)


@pytest.mark.parametrize("hole", HOLES, ids=lambda hole: hole.name)
def test_a_hole_is_found(hole):
    try:
        told = list(complaints(hole.make(), hole.claims))
    except ValueError as error:
        pytest.skip(f"the checker refuses it now: {error}")
    assert any(hole.told in one for one in told), told
