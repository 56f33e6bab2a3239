"""Section 6, resonance: what its claims follow from, at eta = 1 and for all nu and epsilon."""

from __future__ import annotations

from functools import partial

from proofs.search.derivations import prove_rows
from proofs.search.request import proving
from proofs.trusted.paper.s6_resonance.resonance import ROWS

prove = proving(partial(prove_rows, rows=ROWS))
