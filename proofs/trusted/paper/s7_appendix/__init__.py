"""The appendix: the marching algorithm, and measures."""
