"""Functions given by formulas, see `trees`: on a tape, on which they are evaluated."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.enclose import Enclosures, Matrix
from proofs.trusted.kernel.expression import Tape
from proofs.trusted.kernel.trees import (
    At,
    Derivative,
    Number,
    Operation,
    Pi,
    Power,
    Tree,
    Variable,
    is_name,
    read_tree,
)

MAX_VARIABLES = 30
MAX_VALUES = 20
FUNCTION_NAME = re.compile(r"(?!N[0-9]*$|[AM]$)[A-Z][A-Za-z0-9]{0,11}")  # N1, A, M: h-sets


@dataclass(frozen=True, eq=False)
class Formulas:
    """Real functions of variables, on one tape; as a map, name(variables) = (F_1, ..., F_m).

    parts: the functions of which derivatives were taken; a derivative, as computed, is one only
    where its function is defined, so they are evaluated together with the roots.
    """

    variables: tuple[str, ...]
    trees: tuple[Tree, ...]
    tape: Tape
    roots: tuple[int, ...]
    parts: tuple[int, ...]
    name: str = ""

    @property
    def definition(self) -> str:
        """Write F(x, ...) = ..."""
        values = ", ".join(map(str, self.trees))
        values = values if len(self.trees) == 1 else f"({values})"
        return f"`{self.name}({', '.join(self.variables)}) = {values}`"

    def values(self, x: Sequence[Enclosure]) -> list[Enclosure]:
        """Enclose the values on a box."""
        return self._enclose(self.roots, x)

    def jacobian(self, x: Sequence[Enclosure]) -> Matrix:
        """Enclose the partial derivatives, a row a function, which are proved defined, too."""
        n = len(self.variables)
        partials = [self.tape.derivative(root, v) for root in self.roots for v in range(n)]
        entries = self._enclose((*partials, *self.roots), x)
        return [entries[i * n : (i + 1) * n] for i in range(len(self.roots))]

    def _enclose(self, roots: tuple[int, ...], x: Sequence[Enclosure]) -> list[Enclosure]:
        return self.tape.evaluate((*roots, *self.parts), Enclosures(x[0].bits), x)[: len(roots)]


def read_formulas(*readers: Reader) -> Formulas:
    """Read formulas; their variables are in the order of the alphabet, x where there are none."""
    try:
        return on_tape(*map(read_tree, readers))
    except Unproved as error:
        raise readers[0].fail(str(error)) from None


def read_function(name: str, reader: Reader) -> Formulas:
    """Read {"variables", "values"}; names cannot be mistaken for anything else in print."""
    variables_of, values_of = reader.fields("variables", "values")
    if not FUNCTION_NAME.fullmatch(name):
        raise reader.fail("functions are named like F or Gap2, not N, N1, M or A")
    variables = tuple(item.string() for item in variables_of.items(1, MAX_VARIABLES))
    for variable in variables:
        if not is_name(variable) or not variable[0].islower() or variable == "e":
            raise variables_of.fail(f"not a name for a variable: {variable[:30]!r}")
    if len(set(variables)) != len(variables):
        raise variables_of.fail("a variable is named twice")
    try:
        trees = [read_tree(value) for value in values_of.items(1, MAX_VALUES)]
        return on_tape(*trees, variables=variables, name=name)
    except Unproved as error:
        raise values_of.fail(str(error)) from None


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
    parts: collects the functions of which derivatives are taken.
    """

    tape: Tape
    places: dict[str, int]
    parts: list[int]

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
                for node in [self.tape.nodes[self._variable(name)] for name in by]:
                    if node.op != "variable":
                        raise Unproved("a derivative by what is no variable")
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
        """Return the place of a function with others in the places of what is bound in it."""
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
