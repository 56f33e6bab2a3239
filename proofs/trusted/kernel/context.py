"""What a rule about formulas may use: the file's functions, the steps before it, the work left."""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction
from typing import TypeVar

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.enclose import Box, Components, box_text, integer
from proofs.trusted.kernel.formula import Formula
from proofs.trusted.parameters import Parameters

C = TypeVar("C", bound=Conclusion)


@dataclass
class Context:
    """The premises of a step: the statement's numbers, the file's functions, the steps before."""

    parameters: Parameters | None = None
    functions: dict[str, Formula] = field(default_factory=dict)
    known: dict[str, Conclusion] = field(default_factory=dict)

    @property
    def of(self) -> Parameters:
        """The statement's numbers; Unproved in a file that has none."""
        if self.parameters is None:
            raise Unproved("the rule is about an oscillator, and the file has no parameters")
        return self.parameters

    def formula(self, name: Reader) -> Formula:
        """Return the function of that name."""
        if name.string() not in self.functions:
            raise name.fail(f"names no function: {name.string()[:40]!r}")
        return self.functions[name.string()]

    def step(self, name: Reader, kind: type[C]) -> C:
        """Return the conclusion of an earlier step of one kind."""
        step = self.known.get(name.string())
        if not isinstance(step, kind):
            raise name.fail(f"names no earlier step that is a {kind.__name__}")
        return step

    def map_of(self, formula: Formula) -> Components:
        """Return the whole function as a map."""
        return Components.of(formula)


def where(formula: Formula, box: Box, *components: int) -> str:
    """Write the function, or components of it, and the box that a sentence is about."""
    return f"for {formula.definition(*components)} and {box_text(box, formula.variables)}"


def read_box(reader: Reader, dimension: int) -> Box:
    """Read a closed box with exact ends; a side may be a point."""
    return tuple(side.range() for side in reader.items(dimension, dimension))


def read_point(reader: Reader, dimension: int) -> tuple[Fraction, ...]:
    """Read an exact point."""
    return reader.numbers(dimension, dimension)


@dataclass(frozen=True)
class Quantity:
    """A component of a function, or a partial derivative of one."""

    formula: Formula
    component: int
    variable: int | None = None

    @classmethod
    def read(
        cls, context: Context, function: Reader, component: Reader, variable: Reader | None = None
    ) -> Quantity:
        """Read a component (counted from 1), and the name of a variable, or null."""
        formula = context.formula(function)
        index = integer(component, 1, len(formula.roots)) - 1
        if variable is None or variable.is_null():
            return cls(formula, index)
        if variable.string() not in formula.variables:
            raise variable.fail(f"no variable of {formula.name}: {variable.string()[:30]!r}")
        return cls(formula, index, formula.variables.index(variable.string()))

    @property
    def component_name(self) -> str:
        """The component's name, F or F_1."""
        return self.formula.component(self.component)

    @property
    def variable_name(self) -> str:
        """The variable of the derivative, "" where there is none."""
        return "" if self.variable is None else self.formula.variables[self.variable]

    @property
    def name(self) -> str:
        """The quantity's name, F_1 or dF_1/dx."""
        whole = self.component_name
        return whole if self.variable is None else f"d{whole}/d{self.variable_name}"

    @property
    def roots(self) -> tuple[int, ...]:
        """The component's root and, last, the quantity's: both must be defined."""
        root, tape = self.formula.roots[self.component], self.formula.tape
        return (root,) if self.variable is None else (root, tape.derivative(root, self.variable))

    def map(self) -> Components:
        """Return the component and, last, the quantity, as a map."""
        return Components(self.formula.tape, len(self.formula.variables), self.roots)
