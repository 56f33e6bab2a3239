"""Section 5: every equation of the soft springs derived, and its bifurcations decided."""

from __future__ import annotations

from functools import partial

from proofs.search.derivations import prove_rows
from proofs.trusted.paper.s5_soft import soft, stability

prove = partial(prove_rows, (*soft.ROWS, *stability.ROWS))
