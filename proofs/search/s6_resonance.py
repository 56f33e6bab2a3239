"""Section 6, resonance: what its claims follow from."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from proofs.search.derivations import prove_rows
from proofs.search.evidence import Evidence
from proofs.trusted.paper.s6_resonance.resonance import ROWS
from proofs.trusted.parameters import Parameters

CLAIMS = tuple(row.id for row in ROWS)


def prove(
    of: Parameters,
    claims: Sequence[str],
    *,
    digits: int = 30,
    tell: Callable[[str], None] = lambda stage: None,
) -> Evidence:
    """Prove what the claims asked for follow from; they are about eta = 1 and all nu, epsilon."""
    return prove_rows(ROWS, claims, digits, tell)
