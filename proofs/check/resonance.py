"""Rules of the group `resonance`: those about formulas."""

from proofs.check import derivation

RULES = derivation.RULES
