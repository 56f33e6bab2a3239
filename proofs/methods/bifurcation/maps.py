"""Maps given by equations between a point and its image, and their derivatives.

The image of x is written x1, and the equations G(x, x1, parameters) = 0 define it: an explicit map
has x1 - f(x) for G. At a solution where G_x1, the derivative by the image, is regular, the image is
a smooth function of the point, with the Jacobian J that G_x1 J + G_x = 0 determines.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from proofs.methods import derive
from proofs.methods.grammar import canonical
from proofs.trusted.certificate import Malformed, Reader
from proofs.trusted.kernel import trees
from proofs.trusted.kernel.formulas import read_formulas
from proofs.trusted.kernel.head import read_function
from proofs.trusted.kernel.solutions import implicit_derivative

Rows = list[list[str]]  # a matrix of formulas


def image_of(variable: str) -> str:
    """Return the name of a variable's image: x1 of x, and x1_ of x_, which is X1 of X."""
    small = variable.rstrip("_")
    return f"{small}1{variable[len(small) :]}"


@dataclass(frozen=True)
class Map:
    """A map of one or two variables: for each an equation, a formula that is 0."""

    state: tuple[str, ...]
    equations: tuple[str, ...]

    def __post_init__(self) -> None:
        if len(self.state) not in (1, 2) or len(self.state) != len(self.equations):
            raise ValueError("a map has one or two variables x, with x1, and as many equations")

    @classmethod
    def read(cls, *lines: str) -> Map:
        """Read lines such as "x1 = r*x*(1 - x)"; the variables are the x for which x1 occurs."""
        equations, names = [], list[str]()
        for line in lines:
            left, equals, right = (part.strip() for part in line.partition("="))
            if not (left and equals and right):
                raise ValueError(f"an equation such as x1 = 2*x is expected, not {line[:60]!r}")
            sides = canonical(left), canonical(right)
            for side in reversed(sides) if sides[1].isidentifier() else sides:
                names += read_formulas(Reader(side)).variables
            equations.append(
                sides[0] if sides[1] == "0" else str(trees.formula(f"{sides[0]} - ({sides[1]})"))
            )
        try:  # with names that the checker takes for variables
            read_function("F", Reader({"variables": sorted({*names}), "values": equations}))
        except Malformed as error:
            raise ValueError(str(error).removeprefix("$.variables: ")) from None
        return cls(tuple(x for x in dict.fromkeys(names) if image_of(x) in names), tuple(equations))

    @cached_property
    def images(self) -> tuple[str, ...]:
        """The names of the images."""
        return tuple(map(image_of, self.state))

    @cached_property
    def parameters(self) -> tuple[str, ...]:
        """All other names, in alphabetical order."""
        names = read_formulas(*map(Reader, self.equations)).variables
        return tuple(x for x in names if x not in (*self.state, *self.images))

    def with_numbers(self, **values: str) -> Map:
        """Return the map with numbers in the place of some parameters."""
        if unknown := sorted(set(values) - set(self.parameters)):
            raise ValueError(f"the map has no parameter {unknown[0]}")
        if not values:
            return self
        given = ", ".join(f"{name}={value}" for name, value in values.items())
        return Map(self.state, tuple(f"at({each}, {given})" for each in self.equations))

    # -- as formulas -------------------------------------------------------------------------------

    def partials(self, names: tuple[str, ...]) -> Rows:
        """Return the derivatives of the equations, at any point and its image."""
        return [[f"D({each}, {name})" for name in names] for each in self.equations]

    def resting(self, text: str) -> str:
        """Return a formula where the image is the point itself."""
        return f"at({text}, {', '.join(f'{image_of(x)}={x}' for x in self.state)})"

    @cached_property
    def fixed(self) -> tuple[str, ...]:
        """The formulas that are 0 at fixed points."""
        return tuple(map(self.resting, self.equations))

    def characteristic(self, multiplier: str) -> str:
        """Return det(G_x + multiplier G_x1) at rest: 0 if that is an eigenvalue of J."""
        pairs = zip(self.partials(self.state), self.partials(self.images), strict=True)
        rows = [[f"{a} + {multiplier}*{b}" for a, b in zip(*pair, strict=True)] for pair in pairs]
        return self.resting(determinant(rows))

    def turning(self) -> str:
        """Return det G_x1 at rest, not 0 where J is defined."""
        return self.resting(determinant(self.partials(self.images)))

    def invariants(self) -> dict[str, str]:
        """Return trace and determinant of the Jacobian at rest, of a map of the plane.

        det(G_x + m G_x1) = det(G_x1) (m^2 - m trace + determinant).
        """
        at_one, at_minus_one = self.characteristic("1"), self.characteristic("(-1)")
        turning = self.turning()
        return {
            "trace": f"({at_minus_one} - {at_one})/(2*{turning})",
            "determinant": f"{self.characteristic('0')}/{turning}",
        }

    def drift(self, parameter: str) -> list[str]:
        """Return the derivatives of a fixed point by a parameter, where 1 is no multiplier."""
        rows = [[f"D({each}, {x})" for x in self.state] for each in self.fixed]
        rates = [f"D({each}, {parameter})" for each in self.fixed]
        below = determinant(rows)
        replaced = (
            [
                [rate if j == i else a for j, a in enumerate(row)]
                for row, rate in zip(rows, rates, strict=True)
            ]
            for i in range(len(self.state))
        )
        return [f"(-{determinant(each)}/{below})" for each in replaced]

    def implicit(self, jacobian: Rows) -> tuple[str, ...]:
        """Return the entries of G_x1 J + G_x, which are 0 if J is the Jacobian."""
        flat = [entry for row in jacobian for entry in row]
        return implicit_derivative(self.equations, self.state, self.images, flat)

    # -- by sympy ----------------------------------------------------------------------------------

    @cached_property
    def jacobian(self) -> Any:
        """The Jacobian at any point and its image, as a matrix of sympy; ValueError if none is."""
        return self._jacobian({})

    @cached_property
    def jacobian_at_rest(self) -> Any:
        """The Jacobian at fixed points."""
        return self._jacobian(self.at_rest({}))

    def at_rest(self, point: Mapping[str, Any]) -> dict[str, Any]:
        """Return the expressions of a fixed point, by name, and the same for its image."""
        import sympy

        images = {image_of(x): point.get(x, sympy.Symbol(x)) for x in self.state}
        return {**point, **images}

    def _jacobian(self, places: Mapping[str, Any]) -> Any:
        import sympy

        def placed(text: str) -> Any:
            formula = derive.simplest(derive.read(text, places))
            if not derive.is_real(formula):
                raise ValueError(f"nowhere a real number: {text[:60]}")
            return formula

        _, here, there = (
            sympy.Matrix([[placed(entry) for entry in row] for row in rows])
            for rows in ([[*self.equations]], *map(self.partials, (self.state, self.images)))
        )
        if there.det() == 0:
            raise ValueError(f"the equations do not determine {', '.join(self.images)}")
        return (-there.inv() * here).applyfunc(derive.simplest)


def determinant(rows: Rows) -> str:
    """Write the determinant of a matrix of formulas of one or two rows."""
    if len(rows) == 1:
        return f"({rows[0][0]})"
    (a, b), (c, d) = rows
    return f"(({a})*({d}) - ({b})*({c}))"
