"""Formulas: functions of several real variables as expressions, read, printed, differentiated.

EXPR is a rational "7/5", a variable "x", or a list: ["+", a, b, ...], ["*", a, b, ...],
["-", a, b], ["-", a], ["/", a, b], ["^", a, "n"] with an integer n other than 0, ["sqrt", a],
["exp", a], ["log", a], ["sin", a], ["cos", a], ["pi"]. An expression is defined at a point where
no division by 0, root of a negative number or logarithm of a number <= 0 occurs in it, also in
parts that cancel. It is continuous where it is defined, and differentiable where its derivative
(as computed here) is defined too.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import NamedTuple, Protocol, TypeVar

from proofs.trusted.certificate import Malformed, Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.numbers import show

FUNCTIONS = ("sqrt", "exp", "log", "sin", "cos")
MAX_VARIABLES = 6
_MAX_COMPONENTS = 20
_MAX_DEPTH = 60
_MAX_NODES = 500
_MAX_TAPE = 20_000
_MAX_TEXT = 10_000
_MAX_POWER = 1000
_FUNCTION_NAME = re.compile(r"(?!N[0-9]*$|[AM]$)[A-Z][A-Za-z0-9]{0,19}")  # N1, A, M: h-sets
_VARIABLE = re.compile(r"[a-z][a-z0-9_]{0,19}")
_RESERVED = {*FUNCTIONS, "pi", "e"}
_SUM, _PRODUCT, _POWER, _ATOM = range(4)  # how tightly a text binds

T = TypeVar("T")


class Numbers(Protocol[T]):
    """Numbers of one kind: how to apply the operations of formulas to them."""

    def apply(self, op: str, arguments: list[T], datum: Fraction | None) -> T:
        """Return op(arguments); datum is the number of "number", the exponent of "^"."""


class Node(NamedTuple):
    """An operation on earlier nodes; datum is a number, a variable's place, or an exponent."""

    op: str
    arguments: tuple[int, ...] = ()
    datum: Fraction | None = None

    @property
    def cost(self) -> int:
        """About how many multiplications it takes."""
        if self.op == "^":
            return 4 * int(self.datum or 1).bit_length()
        return 25 if self.op in FUNCTIONS else 2


@dataclass
class Tape:
    """Nodes in the order of evaluation; equal nodes are stored once."""

    nodes: list[Node] = field(default_factory=list)
    _places: dict[Node, int] = field(default_factory=dict)
    _orders: dict[tuple[int, ...], list[int]] = field(default_factory=dict)
    _derivatives: dict[tuple[int, int], int] = field(default_factory=dict)

    def add(self, op: str, *arguments: int, datum: Fraction | None = None) -> int:
        """Return the place of a node, a new one where there is none like it."""
        node = Node(op, arguments, datum)
        place = self._places.setdefault(node, len(self.nodes))
        if place == len(self.nodes):
            if place >= _MAX_TAPE:
                raise Unproved("derivatives of a formula with too many operations")
            self.nodes.append(node)
        return place

    def number(self, value: Fraction | int) -> int:
        """Return the place of a number."""
        return self.add("number", datum=Fraction(value))

    def order(self, roots: tuple[int, ...]) -> list[int]:
        """Return the places that the roots need, in the order of evaluation."""
        if roots not in self._orders:
            needed, waiting = set(roots), list(roots)
            while waiting:
                fresh = set(self.nodes[waiting.pop()].arguments) - needed
                needed |= fresh
                waiting += fresh
            self._orders[roots] = sorted(needed)
        return self._orders[roots]

    def evaluate(self, roots: tuple[int, ...], numbers: Numbers[T], inputs: Sequence[T]) -> list[T]:
        """Return the roots' values at the inputs; every node that they need is evaluated."""
        values: dict[int, T] = {}
        for place in self.order(roots):
            op, arguments, datum = self.nodes[place]
            if op == "variable":
                values[place] = inputs[int(datum or 0)]
            else:
                values[place] = numbers.apply(op, [values[i] for i in arguments], datum)
        return [values[root] for root in roots]

    def cost(self, roots: tuple[int, ...]) -> int:
        """Return about how many multiplications an evaluation takes."""
        return sum(self.nodes[place].cost for place in self.order(roots))

    def derivative(self, root: int, variable: int) -> int:
        """Return the place of the partial derivative, by the rules of calculus, node by node.

        A product with the number 0 is left out, which is right where the other factor is
        defined: so a derivative is used only together with the root itself.
        """
        if (root, variable) not in self._derivatives:
            tangents: dict[int, int] = {}
            for place in self.order((root,)):
                tangents[place] = self._tangent(place, tangents, variable)
            self._derivatives[root, variable] = tangents[root]
        return self._derivatives[root, variable]

    def _tangent(self, place: int, tangents: dict[int, int], variable: int) -> int:
        op, arguments, datum = self.nodes[place]
        slopes = [tangents[i] for i in arguments]
        if op == "variable":
            return self.number(int(datum == variable))
        if all(self._is(slope, 0) for slope in slopes):
            return self.number(0)
        match op:
            case "+":
                result = self._sum(*slopes)
            case "-":
                result = self._sum(slopes[0], self._negative(slopes[1]))
            case "negative":
                result = self._negative(slopes[0])
            case "*":
                a, b = arguments
                result = self._sum(self._product(slopes[0], b), self._product(a, slopes[1]))
            case "/":  # (a / b)' = (a' - (a / b) b') / b
                fall = self._negative(self._product(place, slopes[1]))
                result = self.add("/", self._sum(slopes[0], fall), arguments[1])
            case _:
                rate = self._rate(op, place, arguments[0], int(datum or 0))
                result = self._product(rate, slopes[0])
        return result

    def _rate(self, op: str, place: int, a: int, n: int) -> int:
        """Return the place of the derivative of a^n or of a function of a, which is at `place`."""
        match op:
            case "^":
                lower = self.number(1) if n == 1 else self.power(a, n - 1)
                rate = self._product(self.number(n), lower)
            case "sqrt":
                rate = self.add("/", self.number(Fraction(1, 2)), place)
            case "exp":
                rate = place
            case "log":
                rate = self.add("/", self.number(1), a)
            case "sin":
                rate = self.add("cos", a)
            case _:  # cos
                rate = self.add("negative", self.add("sin", a))
        return rate

    def power(self, base: int, n: int) -> int:
        """Return the place of base^n, n not 0."""
        return self.add("^", base, datum=Fraction(n))

    def _is(self, place: int, value: int) -> bool:
        node = self.nodes[place]
        return node.op == "number" and node.datum == value

    def _negative(self, a: int) -> int:
        return a if self._is(a, 0) else self.add("negative", a)

    def _sum(self, a: int, b: int) -> int:
        if self._is(a, 0):
            return b
        return a if self._is(b, 0) else self.add("+", a, b)

    def _product(self, a: int, b: int) -> int:
        if self._is(a, 0) or self._is(b, 1):
            return a
        return b if self._is(b, 0) or self._is(a, 1) else self.add("*", a, b)


@dataclass(frozen=True)
class Formula:
    """A function F = (F_1, ..., F_m) of named variables, with its components as texts."""

    name: str
    variables: tuple[str, ...]
    tape: Tape = field(repr=False)
    roots: tuple[int, ...]
    texts: tuple[str, ...]

    def component(self, index: int) -> str:
        """Return the name of a component, counted from 0."""
        return self.name if len(self.roots) == 1 else f"{self.name}_{index + 1}"

    def definition(self, *components: int) -> str:
        """Write F(x, ...) = ..., or some components alone, in infix notation."""
        variables = ", ".join(self.variables)
        if components:
            parts = (f"{self.component(i)}({variables}) = {self.texts[i]}" for i in components)
            return ", ".join(parts)
        text = self.texts[0] if len(self.texts) == 1 else f"({', '.join(self.texts)})"
        return f"{self.name}({variables}) = {text}"


def read_formula(name: str, reader: Reader) -> Formula:
    """Read {"variables", "values"}; names cannot be mistaken for anything else in print."""
    variables_of, values_of = reader.fields("variables", "values")
    if not _FUNCTION_NAME.fullmatch(name):
        raise reader.fail("functions are named like F or Gap2, not N, N1, M or A")
    variables = tuple(item.string() for item in variables_of.items(1, MAX_VARIABLES))
    for variable in variables:
        if not _VARIABLE.fullmatch(variable) or variable in _RESERVED:
            raise variables_of.fail(f"not a name for a variable: {variable[:30]!r}")
    if len(set(variables)) != len(variables):
        raise variables_of.fail("a variable is named twice")
    tape = Tape()
    for place in range(len(variables)):
        tape.add("variable", datum=Fraction(place))
    values = values_of.items(1, _MAX_COMPONENTS)
    roots = tuple(_read(tape, variables, value, _MAX_DEPTH) for value in values)
    return Formula(name, variables, tape, roots, _texts(tape, variables, roots, values_of))


def _read(tape: Tape, variables: tuple[str, ...], reader: Reader, depth: int) -> int:
    """Put an expression on the tape."""
    if depth == 0:
        raise reader.fail(f"nested more than {_MAX_DEPTH} deep")
    if len(tape.nodes) > _MAX_NODES:
        raise reader.fail(f"a function of more than {_MAX_NODES} operations")
    word = _word(reader)
    if word is not None:
        if word in variables:
            return variables.index(word)
        if word[:1].isalpha():
            raise reader.fail(f"unknown variable {word[:30]!r}")
        return tape.number(reader.number())
    first, *rest = reader.items(1, _MAX_NODES)
    if first.string() == "^" and len(rest) == 2:
        return tape.power(_read(tape, variables, rest[0], depth - 1), _exponent(rest[1]))
    arguments = [_read(tape, variables, item, depth - 1) for item in rest]
    return _operation(tape, first, arguments)


def _operation(tape: Tape, op_of: Reader, arguments: list[int]) -> int:
    """Put an operation on the tape; sums and products of many are of two, from the left."""
    op, count = op_of.string(), len(arguments)
    if op == "-" and count == 1:
        return tape.add("negative", *arguments)
    fits = {"+": count >= 2, "*": count >= 2, "-": count == 2, "/": count == 2, "pi": count == 0}
    if not fits.get(op, op in FUNCTIONS and count == 1):
        raise op_of.fail(f"no operation {op[:20]!r} with {count} arguments")
    result = tape.add(op, *arguments[:2])
    for other in arguments[2:]:
        result = tape.add(op, result, other)
    return result


def _word(reader: Reader) -> str | None:
    try:
        return reader.string()
    except Malformed:
        return None


def _exponent(reader: Reader) -> int:
    value = reader.number()
    if value.denominator != 1 or not 0 < abs(value) <= _MAX_POWER:
        raise reader.fail(f"exponents are integers from 1 to {_MAX_POWER}, or their negatives")
    return int(value)


def _texts(
    tape: Tape, variables: tuple[str, ...], roots: tuple[int, ...], reader: Reader
) -> tuple[str, ...]:
    """Write expressions in infix notation, with the brackets that show their structure."""
    texts: dict[int, tuple[str, int]] = {}
    for place in tape.order(roots):
        texts[place] = _infix(tape.nodes[place], variables, texts)
        if len(texts[place][0]) > _MAX_TEXT:
            raise reader.fail(f"a function whose text has more than {_MAX_TEXT} characters")
    return tuple(texts[root][0] for root in roots)


def _infix(
    node: Node, variables: tuple[str, ...], texts: dict[int, tuple[str, int]]
) -> tuple[str, int]:
    """Return a node's text and how tightly it binds."""

    def inner(index: int, least: int) -> str:
        text, binds = texts[node.arguments[index]]
        return text if binds >= least else f"({text})"

    op, datum = node.op, node.datum or Fraction(0)
    match op:
        case "number":
            text = show(datum)
            binds = _SUM if datum < 0 else _PRODUCT if "/" in text else _ATOM
        case "variable" | "pi":
            text, binds = op if op == "pi" else variables[int(datum)], _ATOM
        case "+" | "-":
            text, binds = f"{inner(0, _SUM)} {op} {inner(1, _PRODUCT)}", _SUM
        case "negative":
            text, binds = f"-{inner(0, _PRODUCT)}", _SUM
        case "*" | "/":
            text, binds = f"{inner(0, _PRODUCT)}{op}{inner(1, _POWER)}", _PRODUCT
        case "^":
            exponent = show(datum) if datum > 0 else f"({show(datum)})"
            text, binds = f"{inner(0, _ATOM)}^{exponent}", _POWER
        case _:
            text, binds = f"{op}({texts[node.arguments[0]][0]})", _ATOM
    return text, binds
