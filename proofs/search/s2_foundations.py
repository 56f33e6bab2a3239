"""Section 2 and the appendix: the model's equations derived, sticking, marching, and measures.

Claims M1 to M5, M7 to M9, A1 and A2. They are about all values of the parameters, or about exact
witnesses; A1 also names phases of the parameters given that never impact again.
"""

from __future__ import annotations

from contextlib import suppress

from proofs.search.derivations import prove_rows
from proofs.search.evidence import FAILED, Evidence, Proof, Steps
from proofs.search.request import Request, proving
from proofs.search.s34_circle import prove_longest
from proofs.trusted.paper import s2_foundations, s7_appendix


@proving
def prove(request: Request) -> Evidence:
    """Prove what the claims asked for follow from."""
    rows = (*s2_foundations.ROWS, *s7_appendix.ROWS)
    evidence = prove_rows(request, rows)
    if request.asks("A1"):
        request.tell("phases without a next impact")
        evidence.proofs["A1"] += unending(request, evidence.steps)
    return evidence


def unending(request: Request, steps: Steps) -> Proof:
    """Prove that an interval of phases never impacts again, if one is found."""
    if -1 < request.of.nu < 0 < request.of.eta < 1:
        with suppress(*FAILED):
            return [prove_longest(request.prover(steps))]
    return []
