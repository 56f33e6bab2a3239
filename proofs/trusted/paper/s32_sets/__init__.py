"""Sections 3.1 and 3.2: the invariant set and its dimension."""
