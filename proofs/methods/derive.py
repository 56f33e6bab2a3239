"""Formulas in sympy, and back.

What sympy finds is a candidate: the checker has a computation of its own. sympy is imported by
what needs it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from math import lcm
from types import MappingProxyType
from typing import Any

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel import trees
from proofs.trusted.kernel.formulas import read_formulas
from proofs.trusted.kernel.operations import ARITHMETIC


class _Expressions:
    """The operations of formulas on expressions of sympy."""

    def apply(self, op: str, arguments: Sequence[Any], datum: Fraction) -> Any:
        """Return op(arguments)."""
        import sympy

        if op == "number":
            return sympy.Rational(datum.numerator, datum.denominator)
        if op == "pi":
            return sympy.pi
        if op == "^":
            return arguments[0] ** int(datum)
        return (ARITHMETIC.get(op) or getattr(sympy, op))(*arguments)


def read(text: str, places: Mapping[str, Any] = MappingProxyType({})) -> Any:
    """Return a formula as a sympy expression, with others in the places of some variables."""
    import sympy

    formula = read_formulas(Reader(text))
    inputs = [places.get(name, sympy.Symbol(name)) for name in formula.variables]
    return formula.tape.evaluate(formula.roots, _Expressions(), inputs)[0]


def is_real(expression: Any) -> bool:
    """Whether an expression of real names has no imaginary unit, and nothing undefined."""
    import sympy

    return not expression.has(sympy.I, sympy.zoo, sympy.oo, sympy.nan)


def vanishes(expression: Any) -> bool:
    """Whether sympy reduces an expression to 0: expanded angles, sin^2 = 1 - cos^2, numerators."""
    import sympy

    expression = sympy.expand_trig(_whole_angles(expression))
    top = sympy.expand(sympy.numer(sympy.together(expression)))
    for sine in top.atoms(sympy.sin):
        square = 1 - sympy.cos(sine.args[0]) ** 2
        top = sympy.expand(sympy.rem(top, sine**2 - square, sine))
    return bool(top == 0)


def _whole_angles(expression: Any) -> Any:
    """Write angles as sums, and scale the variables until they have integer coefficients."""
    import sympy

    circular = (sympy.sin, sympy.cos)
    parts = {part: part.func(sympy.expand(part.args[0])) for part in expression.atoms(*circular)}
    expression = expression.xreplace(parts)
    terms = [
        term
        for part in parts.values()
        for angle in part.args
        for term in sympy.Add.make_args(angle)
    ]
    scale = lcm(*(int(sympy.denom(term.as_coeff_Mul()[0])) for term in terms))
    pairs = [(symbol, scale * symbol) for symbol in expression.free_symbols]
    return expression.subs(pairs, simultaneous=True) if scale > 1 else expression


# -- back to formulas ------------------------------------------------------------------------------


def simplest(expression: Any) -> Any:
    """Return a quotient of factored polynomials in what occurs, sines and cosines among it."""
    import sympy

    expression = sympy.sympify(expression)
    if expression.has(sympy.sin, sympy.cos, sympy.tan):
        if vanishes(expression):
            return sympy.Integer(0)
        expression = sympy.trigsimp(expression)
        expression = expression.replace(sympy.tan, lambda x: sympy.sin(x) / sympy.cos(x))
    return sympy.factor(expression)


def factors(expression: Any) -> list[Any]:
    """Return the factors of an expression that are no numbers, those of a polynomial irreducible.

    sympy has none where x and exp(r*x) occur beside each other: then they are those written.
    """
    import sympy

    try:
        return [factor for factor, _ in sympy.factor_list(expression)[1]]
    except sympy.PolynomialError:
        powers = (factor.as_base_exp()[0] for factor in sympy.Mul.make_args(expression))
        return [base for base in powers if not base.is_number]


def write(expression: Any) -> str:
    """Write an expression of sympy as the checker reads it."""
    from sympy.printing.str import StrPrinter

    class Printer(StrPrinter):  # type: ignore[misc]
        """Half powers are roots, and e is exp(1)."""

        def _print_Pow(self, power: Any, rational: bool = False) -> str:  # noqa: N802
            base, exponent = power.as_base_exp()
            if exponent.is_Rational and exponent.q == 2:
                root = f"sqrt({self._print(base)})"
                top = root if abs(exponent.p) == 1 else f"{root}**{abs(exponent.p)}"
                return top if exponent > 0 else f"1/{top}"
            text: str = super()._print_Pow(power, rational)
            return text

        def _print_Exp1(self, _: Any) -> str:  # noqa: N802
            return "exp(1)"

    return str(trees.formula(Printer().doprint(expression)))
