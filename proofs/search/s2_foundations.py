"""Section 2 and the appendix: the model's equations derived, sticking, marching, and measures.

Claims M1 to M5, M7 to M9, A1 and A2. They are about all values of the parameters, or about exact
witnesses; A1 also names phases of the parameters given that never impact again.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from intervals import DomainError, Undecided
from proofs.motion.impact import HORIZON
from proofs.motion.system import System
from proofs.search.derivations import prove_derivations
from proofs.search.evidence import Evidence
from proofs.search.s34_circle import prove_longest
from proofs.search.steps import Prover
from proofs.trusted.certificate import Reader, texts
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.paper import GROUPS
from proofs.trusted.paper.s2_foundations.relations import DERIVATIONS
from proofs.trusted.paper.s7_appendix.appendix import NEGATIVE
from proofs.trusted.paper.s7_appendix.rules import method_one
from proofs.trusted.parameters import Parameters

CLAIMS = GROUPS["foundations"]


def prove(
    of: Parameters,
    claims: Sequence[str],
    *,
    digits: int = 30,
    tell: Callable[[str], None] = lambda stage: None,
) -> Evidence:
    """Prove what the claims asked for follow from."""
    evidence = prove_derivations(DERIVATIONS, claims, digits, tell)
    if "A1" in claims:
        tell("phases without a next impact")
        evidence.proofs["A1"] += unending(of, evidence.steps)
    if "A2" in claims:
        name, witness = "method-one-1", counterexample()
        evidence.steps[name] = {"rule": "method-one", "witness": witness}
        evidence.proofs["A2"] = [(name, method_one(Context(of), Reader(witness)))]
    return evidence


def unending(of: Parameters, steps: dict[str, dict[str, Any]]) -> list[tuple[str, Conclusion]]:
    """Prove that an interval of phases never impacts again, if one is found."""
    if not -1 < of.nu < 0 < of.eta < 1:
        return []
    try:
        return [prove_longest(Prover(System(of.eta, of.nu), 0, HORIZON, steps))]
    except (Undecided, DomainError):
        return []


def counterexample() -> dict[str, Any]:
    """Return the witness of a premeasure from which Method I makes no outer measure."""
    points, sets, values = NEGATIVE
    return {
        "points": str(points),
        "sets": [[str(point) for point in sorted(each)] for each in sets],
        "values": texts(values),
    }
