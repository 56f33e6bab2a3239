"""How much chaos is there in all? The covering graph of branches of f. Row G9."""

from __future__ import annotations

from proofs.trusted.kernel.coverings import EntropyBound
from proofs.trusted.parameters import Parameters
from proofs.trusted.verdicts import Decision, Found, Row, Verdict, decided, undecided


def _entropy(of: Parameters, found: Found) -> Decision:
    """G9: by the greatest bound."""
    del of
    bounds = sorted(found.all(EntropyBound), key=lambda bound: bound.growth)
    if not bounds or bounds[-1].growth == 1:  # log 1 bounds nothing
        return undecided("no covering graph is proved")
    if bounds[-1].growth < 2:
        return undecided(f"{bounds[-1].brief}, only", bounds[-1].quantities)
    return decided(Verdict.VERIFIED, bounds[-1], corrected=bounds[-1:])


ROWS = (
    Row(
        "G9",
        "3.1",
        "",
        "At (eta, nu) = ({eta}, {nu}): the topological entropy of f, the supremum over compact "
        "invariant sets on which f is continuous, is at least log 2.",
        _entropy,
    ),
)
