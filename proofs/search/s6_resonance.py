"""Section 6, resonance: what its claims follow from, at eta = 1 and for all nu and epsilon."""

from __future__ import annotations

from functools import partial

from proofs.methods import derive
from proofs.search.derivations import prove_rows
from proofs.trusted.paper.formulas import Equal, Unknowns
from proofs.trusted.paper.s6_resonance import displayed as eq
from proofs.trusted.paper.s6_resonance.resonance import ROWS


def _explicit(wanted: Unknowns) -> dict[str, str]:
    """Solve lemmas of which the right side is the unknown."""
    sides = {each.right: each.left for each in wanted.lemmas if isinstance(each, Equal)}
    return {name: derive.write(derive.simplest(derive.read(sides[name]))) for name in wanted.names}


_SOLVERS = dict.fromkeys((eq.AT_REST, eq.OFF_THE_MAP), _explicit)

prove = partial(prove_rows, ROWS, solvers=_SOLVERS)
