"""Bifurcations of fixed points of a map of one's own, of the line or the plane."""
