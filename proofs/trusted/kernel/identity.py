"""Rule: identities between formulas and their derivatives, in exact arithmetic."""

from __future__ import annotations

from dataclasses import dataclass

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.enclose import integer
from proofs.trusted.kernel.formula import Formula
from proofs.trusted.kernel.normalform import NormalForms

_MAX_ORDER = 4


@dataclass(frozen=True)
class Identity(Conclusion):
    """Two components are equal, or a partial derivative of one and another."""

    formula: Formula
    left: int
    derivative: tuple[int, ...]
    right: int

    @property
    def sentence(self) -> str:
        """Return the statement."""
        sides = tuple(dict.fromkeys((self.left, self.right)))
        names = [self.formula.component(index) for index in (self.left, self.right)]
        if self.derivative:
            order = f"^{len(self.derivative)}" if len(self.derivative) > 1 else ""
            by = " ".join(f"d{self.formula.variables[v]}" for v in self.derivative)
            names[0] = f"d{order} {names[0]} / {by}"
        variables = ", ".join(self.formula.variables)
        return (
            f"for {self.formula.definition(*sides)} and all real {variables} at which both sides "
            f"are defined: {names[0]} = {names[1]}"
        )


def identity(context: Context, reader: Reader) -> Identity:
    """Rule `identity`: {function, left, derivative: [variables], right}.

    Hypothesis: D F_i and F_j, D the partial derivative in these variables one after the other,
    have the normal forms P/Q and R/S with P S - R Q = 0, a polynomial identity modulo
    sin(a)^2 + cos(a)^2 = 1 and sqrt(a)^2 = a. Conclusion: D F_i = F_j at each point where
    both expressions, with F_i and all D before, are defined.

    Proof. There each operation on quotients is one on real numbers, with no division by 0, so
    D F_i = P/Q, F_j = R/S with Q, S not 0. That the relations hold at each point is all that is
    used: other relations between the generators are not needed for a difference to be 0.
    """
    function, left_of, derivative_of, right_of = reader.fields(
        "function", "left", "derivative", "right"
    )
    formula = context.formula(function)
    count = len(formula.roots)
    left, right = integer(left_of, 1, count) - 1, integer(right_of, 1, count) - 1
    names = [item.string() for item in derivative_of.items(0, _MAX_ORDER)]
    if not set(names) <= set(formula.variables):
        raise derivative_of.fail(f"variables of {formula.name} are expected")
    if left == right and not names:
        raise right_of.fail("a component is compared with itself")
    variables = tuple(map(formula.variables.index, names))
    one, two = formula.roots[left], formula.roots[right]
    for variable in variables:
        one = formula.tape.derivative(one, variable)
    forms = NormalForms(len(formula.variables))
    a, b = formula.tape.evaluate((one, two), forms, forms.inputs())
    if forms.apply("-", [a, b], None).top:
        raise Unproved(f"the normal forms of the two sides of {formula.name} differ")
    return Identity(formula, left, variables, right)
