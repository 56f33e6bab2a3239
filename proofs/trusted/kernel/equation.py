"""What is proved about formulas: equations, power series, values.

A formula is a text in Python's notation: + - * / and ** with integers, pi, sin, cos, sqrt, exp,
log; D(F, x, y) is the derivative of F by x and then by y, at(F, x=G, y=H) is F with G and H put
in the places of x and y at once. Every other name is a real variable.
"""

from __future__ import annotations

from dataclasses import dataclass

from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.numbers import Range, between, show_range


@dataclass(frozen=True)
class Equal(Conclusion):
    """left = right, at all real values of the variables at which all parts of both are defined."""

    left: str
    right: str

    @property
    def sentence(self) -> str:
        """Return the equation."""
        return f"{self.left} = {self.right}, wherever all parts of both sides are defined."


@dataclass(frozen=True)
class Series(Conclusion):
    """function = coefficients[0] + coefficients[1] x + ... + O(x^len(coefficients)) as x -> 0.

    x is the variable, from both sides; at fixed real values of the other variables at which the
    formulas `nonzero` are not 0 and the parts of the coefficients are defined.
    """

    function: str
    variable: str
    coefficients: tuple[str, ...]
    nonzero: tuple[str, ...] = ()

    @property
    def sentence(self) -> str:
        """Return the series."""
        terms = " + ".join(
            f"({each})*{self.variable}**{n}" for n, each in enumerate(self.coefficients)
        )
        where = f" where {', '.join(self.nonzero)} are not 0" if self.nonzero else ""
        return (
            f"{self.function} = {terms} + O({self.variable}**{len(self.coefficients)}) as "
            f"{self.variable} -> 0{where}."
        )


@dataclass(frozen=True)
class Value(Conclusion):
    """The function and all its parts are defined on a box; its values there are in these bounds."""

    function: str
    box: tuple[tuple[str, Range], ...]
    bounds: Range

    @property
    def sentence(self) -> str:
        """Return the bounds."""
        box = ", ".join(f"{name} in {show_range(side)}" for name, side in self.box)
        return f"{self.function} lies in {between(self.bounds)} for {box}."
