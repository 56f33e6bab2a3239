"""Section 6: resonance."""
