"""Section 5: every equation of the soft springs derived, and its bifurcations decided."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from proofs.search.derivations import prove_rows
from proofs.search.evidence import Evidence
from proofs.trusted.paper import GROUPS
from proofs.trusted.paper.s5_soft import soft, stability
from proofs.trusted.parameters import Parameters

CLAIMS = GROUPS["soft"]


def prove(
    of: Parameters,
    claims: Sequence[str],
    *,
    digits: int = 30,
    tell: Callable[[str], None] = lambda stage: None,
) -> Evidence:
    """Prove what the claims asked for follow from; they are about all values of the parameters."""
    return prove_rows((*soft.ROWS, *stability.ROWS), claims, digits, tell)
