"""Section 5: every equation of the soft springs derived, and its bifurcations decided."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence

from proofs.claims.soft import DERIVATIONS
from proofs.derivations import prove_derivations
from proofs.facts import Parameters
from proofs.groups import Evidence
from proofs.runner import run

CLAIMS = tuple(derivation.id for derivation in DERIVATIONS)


def prove(
    of: Parameters,
    claims: Sequence[str],
    *,
    digits: int = 30,
    tell: Callable[[str], None] = lambda stage: None,
) -> Evidence:
    """Prove what the claims asked for follow from; they are about all values of the parameters."""
    return prove_derivations(DERIVATIONS, claims, digits, tell)


def main(arguments: list[str] | None = None) -> int:
    """Run the command; return the exit status."""
    return run("soft", arguments, __doc__)


if __name__ == "__main__":
    sys.exit(main())
