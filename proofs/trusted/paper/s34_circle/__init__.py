"""Section 3.4: the whole circle."""
