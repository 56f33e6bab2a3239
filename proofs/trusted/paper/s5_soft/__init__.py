"""Section 5: soft springs."""
