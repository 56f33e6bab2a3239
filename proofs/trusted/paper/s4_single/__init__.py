"""Section 4: single-impact orbits."""
