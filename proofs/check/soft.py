"""Rules of the group `soft`: those about formulas."""

from proofs.check import derivation

RULES = derivation.RULES
