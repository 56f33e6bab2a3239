"""Arithmetic, formulas, and the rules that hold for any map."""
