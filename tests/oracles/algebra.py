"""Equalities and power series by computer algebra, sympy's: a second opinion on exact rules."""

from __future__ import annotations

from typing import Any

from proofs.methods import derive
from proofs.trusted.kernel.values import Equal, Series


def agrees(lemma: Equal | Series) -> bool:
    """Whether sympy proves a lemma."""
    if isinstance(lemma, Equal):
        return equal(*map(str, lemma.formulas))
    coefficients = tuple(map(str, lemma.coefficients))
    return begins(str(lemma.function), str(lemma.variable), coefficients)


def equal(left: str, right: str) -> bool:
    """Whether sympy finds two formulas equal."""
    return derive.vanishes(derive.read(left) - derive.read(right))


def begins(function: str, variable: str, coefficients: tuple[str, ...]) -> bool:
    """Whether sympy finds that a power series begins with these coefficients."""
    import sympy

    x = sympy.Symbol(variable)
    begun = sum(derive.read(text) * x**n for n, text in enumerate(coefficients))
    rest = derive.read(function) - begun
    top, bottom = sympy.fraction(sympy.together(rest))
    return _order(top, x) >= _order(bottom, x) + len(coefficients)


def _order(function: Any, x: Any, most: int = 16) -> int:
    """Return the least order of a derivative that is not 0 at x = 0."""
    for order in range(most):
        if not derive.vanishes(function.subs(x, 0)):
            return order
        function = function.diff(x)
    return most
