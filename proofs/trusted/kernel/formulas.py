"""Functions given by formulas, see `trees`: on a tape, on which they are evaluated."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.enclose import Circle, Matrix, centre_of, enclosed, point_box
from proofs.trusted.kernel.evaluation import Partial, enclose
from proofs.trusted.kernel.expression import Tape
from proofs.trusted.kernel.normalform import NormalForms, plus
from proofs.trusted.kernel.operations import Enclosures
from proofs.trusted.kernel.trees import (
    At,
    Derivative,
    Number,
    Operation,
    Pi,
    Power,
    Tree,
    Variable,
    read_tree,
)
from proofs.trusted.numbers import Range

MAX_VARIABLES = 30
MAX_VALUES = 20
FUNCTION_NAME = re.compile(r"(?!N[0-9]*$|[ADM]$)[A-Z][A-Za-z0-9]{0,11}")  # N1, A, M: h-sets


@dataclass(frozen=True, eq=False)
class Formulas:
    """Real functions of variables, on one tape; as a map, name(variables) = (F_1, ..., F_m).

    parts: the functions of which derivatives were taken; a derivative, as computed, is one only
    where its function is defined, so they are evaluated together with the roots. ranges: of
    parameters, further variables on the tape: what is enclosed is enclosed for all their values.
    circles: the angles among the variables. given: parameters and periods, in words.
    """

    variables: tuple[str, ...]
    trees: tuple[Tree, ...]
    tape: Tape
    roots: tuple[int, ...]
    parts: tuple[int, ...]
    name: str = ""
    ranges: tuple[Range, ...] = ()
    circles: tuple[Circle, ...] = ()
    given: str = ""

    @property
    def size(self) -> int:
        """The number of values."""
        return len(self.roots)

    @property
    def definition(self) -> str:
        """Write F(x, ...) = ..."""
        values = ", ".join(map(str, self.trees))
        values = values if len(self.trees) == 1 else f"({values})"
        return f"`{self.name}({', '.join(self.variables)}) = {values}`{self.given}"

    def values(self, x: Sequence[Enclosure]) -> list[Enclosure]:
        """Enclose the values on a box."""
        return self.enclose(self.roots, x)

    def jacobian(self, x: Sequence[Enclosure]) -> Matrix:
        """Enclose the partial derivatives, a row a function, which are proved defined, too."""
        return self._slopes(x, range(len(self.variables)))

    def bend(self, x: Sequence[Enclosure]) -> Enclosure:
        """Enclose the second derivative of the one value by the one variable."""
        roots = [self.roots[0]]
        for _ in range(2):
            roots.append(self.tape.derivative(roots[-1], 0))
        return self.enclose(tuple(roots), x)[-1]

    def pinned(self) -> Formulas:
        """Return the map with each parameter at the middle of its range."""
        return replace(self, ranges=point_box(centre_of(self.ranges)))

    def sensitivity(self, x: Sequence[Enclosure]) -> Matrix:
        """Enclose the derivatives by the parameters."""
        return self._slopes(x, [len(self.variables) + k for k in range(len(self.ranges))])

    def derivative(self, root: int, place: int) -> int:
        """Return a partial derivative, on the tape."""
        return self.tape.derivative(root, place)

    def launched(self, states: Sequence[Enclosure], parameters: Sequence[Enclosure]) -> Launched:
        """Return them for these states and parameters, as functions of the variable after these."""
        return Launched(self, states, parameters, Partial(len(states)))

    def _slopes(self, x: Sequence[Enclosure], by: Sequence[int]) -> Matrix:
        n = len(by)
        partials = [self.tape.derivative(root, v) for root in self.roots for v in by]
        entries = self.enclose((*partials, *self.roots), x)
        return [entries[i * n : (i + 1) * n] for i in range(len(self.roots))]

    def periods(self, bits: int) -> dict[int, Enclosure]:
        """Enclose the periods of the angles, by their places among the variables."""
        roots = tuple(circle.root for circle in self.circles)
        values = self.tape.evaluate(roots, Enclosures(bits), ()) if roots else []
        return {circle.place: x for circle, x in zip(self.circles, values, strict=True)}

    def enclose(
        self,
        roots: tuple[int, ...],
        x: Sequence[Enclosure],
        parameters: Sequence[Enclosure] = (),
        partial: Partial | None = None,
    ) -> list[Enclosure]:
        """Enclose any roots of the tape on a box, the parts being proved defined there.

        parameters: their values, in place of all that their ranges allow. partial: what is known
        from other values of one variable.
        """
        bits = x[0].bits
        inputs = (*x, *(parameters or enclosed(self.ranges, bits))) if self.ranges else x
        wanted = (*roots, *self.parts)
        return enclose(self.tape, wanted, inputs, bits, partial)[: len(roots)]


@dataclass(frozen=True)
class Launched:
    """Formulas of one variable, a time, for all of some states and parameters."""

    formulas: Formulas
    states: Sequence[Enclosure]
    parameters: Sequence[Enclosure]
    partial: Partial

    def on(self, roots: Sequence[int], t: Enclosure) -> list[Enclosure]:
        """Enclose roots at times."""
        return self.formulas.enclose(tuple(roots), [*self.states, t], self.parameters, self.partial)


def read_formulas(*readers: Reader) -> Formulas:
    """Read formulas; their variables are in the order of the alphabet, x where there are none."""
    try:
        return on_tape(*map(read_tree, readers))
    except Unproved as error:
        raise readers[0].fail(str(error)) from None


def on_tape(*trees: Tree, variables: tuple[str, ...] = (), name: str = "") -> Formulas:
    """Return the functions that formulas give, of these variables, else of all theirs."""
    free = frozenset[str]().union(*(tree.free for tree in trees))
    variables = variables or tuple(sorted(free)) or ("x",)
    if len(variables) > MAX_VARIABLES:
        raise Unproved(f"more than {MAX_VARIABLES} variables")
    tape = Tape()
    places = {v: tape.add("variable", datum=Fraction(i)) for i, v in enumerate(variables)}
    placer = Placer(tape, places, [])
    roots = tuple(map(placer.place, trees))
    return Formulas(variables, trees, tape, roots, tuple(dict.fromkeys(placer.parts)), name)


@dataclass
class Placer:
    """Puts trees on a tape.

    places: of the variables; bound ones are variables of the tape, too, until they are moved away.
    parts: collects the functions of which derivatives are taken. solutions: names with places that
    stand for solutions of equations.
    """

    tape: Tape
    places: dict[str, int]
    parts: list[int]
    solutions: set[str] = field(default_factory=set)

    def place(self, tree: Tree) -> int:
        """Return the place of a formula."""
        match tree:
            case Number(value=value):
                place = self.tape.number(value)
            case Pi():
                place = self.tape.add("pi")
            case Variable(name=name):
                place = self._variable(name)
            case Power(exponent=n, parts=(base,)):
                place = self.tape.add("^", self.place(base), datum=Fraction(n))
            case Operation(op=op, parts=parts):
                place = self._folded(op, *map(self.place, parts))
            case Derivative(by=by, parts=(function,)):
                place = self.place(function)
                for name, node in [(x, self.tape.nodes[self._variable(x)]) for x in by]:
                    if node.op != "variable" or name in self.solutions:
                        raise Unproved(f"not a variable: {name!r}")
                    self.parts.append(place)
                    place = self.tape.derivative(place, int(node.datum))
            case At(names=names, parts=(function, *others)):
                place = self._moved(function, names, [self.place(other) for other in others])
            case _:
                raise TypeError(f"not a formula: {tree!r}")
        return place

    def _variable(self, name: str) -> int:
        if name not in self.places:
            raise Unproved(f"unknown variable {name!r}")
        return self.places[name]

    def _moved(self, function: Tree, names: tuple[str, ...], others: Sequence[int]) -> int:
        """Return the place of a function with others in the places of what is bound in it.

        Not into solutions of equations, which end where the motion does.
        """
        if function.free & self.solutions:
            raise Unproved("nothing is substituted into the solution of an equation")
        numbers = (Fraction(MAX_VARIABLES + int(name[1:])) for name in names)
        bound = [self.tape.add("variable", datum=number) for number in numbers]
        inner = replace(self, places=self.places | dict(zip(names, bound, strict=True)))
        before, root = len(self.parts), inner.place(function)
        roots = [root, *self.parts[before:]]
        place, *self.parts[before:] = self.tape.moved(roots, dict(zip(bound, others, strict=True)))
        return place

    def _folded(self, op: str, *places: int) -> int:
        """Return the place of an operation; -a and a/b of numbers are numbers."""
        a, *b = (self.tape.nodes[place] for place in places)
        if op == "negative" and a.op == "number":
            return self.tape.number(-a.datum)
        if op == "/" and a.op == b[0].op == "number" and b[0].datum:
            return self.tape.number(a.datum / b[0].datum)
        return self.tape.add(op, *places)


def same_form(tape: Tape, one: int, two: int) -> bool:
    """Whether two functions have the same normal form: they agree where both are defined."""
    forms = NormalForms(MAX_VARIABLES)
    left, right = tape.evaluate((one, two), forms, forms.inputs())
    return forms.is_zero(plus(left, right, -1))
