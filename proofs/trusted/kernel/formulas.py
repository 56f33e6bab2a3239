"""Formulas: texts in Python's notation, read once, and the real functions that they give.

A text has + - * / and ** with an integer exponent other than 0, integers, pi, sqrt, exp, log, sin,
cos. D(F, x, y) is the derivative of F by x and then by y, at(F, x=G, y=H) is F with G and H put in
the places of x and y at once. Every other name is a real variable. As usual - and / are taken from
the left, -x**2 is -(x**2), and a/b*c is (a/b)*c.

A text is printed as it stands in the file. So that it is read by people as it is read here, no
other character than these is allowed, and no white space but one space on both sides of a + or -
between two terms and one after a comma.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import NamedTuple

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.enclose import Enclosures, Matrix, enclosed
from proofs.trusted.kernel.expression import FUNCTIONS, Tape
from proofs.trusted.kernel.meter import METER
from proofs.trusted.numbers import Range

MAX_VARIABLES = 30
_MAX_LENGTH = 12_000
_MAX_DEPTH = 150
_MAX_POWER = 1000
MAX_VALUES = 20
WORDS = {*FUNCTIONS, "pi", "D", "at"}
_TOKEN = re.compile(r"[0-9A-Za-z_]+|\*\*|[-+*/(),=]")
_WORD = re.compile(r"[0-9]+|[A-Za-z][A-Za-z0-9_]*")
_OPERATIONS = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/"}
FUNCTION_NAME = re.compile(r"(?!N[0-9]*$|[ADM]$)[A-Z][A-Za-z0-9]{0,19}")  # N1, A, M: h-sets
VARIABLE = re.compile(r"[a-z][a-z0-9_]{0,19}")


class Circle(NamedTuple):
    """An angle, by its place among the variables; its period, on the tape and as it is written.

    With the period's text go the values of the parameters in it.
    """

    place: int
    root: int
    period: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class Formulas:
    """Real functions of variables, on one tape; as a map, name(variables) = (F_1, ..., F_m).

    parts: the functions of which derivatives were taken; a derivative, as computed, is one only
    where its function is defined, so they are evaluated together with the roots. ranges: of
    parameters, further variables on the tape: what is enclosed is enclosed for all their values.
    circles: the angles among the variables, and their periods.
    given: what parameters and periods are, in words.
    """

    variables: tuple[str, ...]
    texts: tuple[str, ...]
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
        text = self.texts[0] if len(self.texts) == 1 else f"({', '.join(self.texts)})"
        return f"{self.name}({', '.join(self.variables)}) = {text}{self.given}"

    def free(self) -> set[str]:
        """Return the variables on which the functions depend; others are substituted away."""
        nodes = [self.tape.nodes[place] for place in self.tape.order((*self.roots, *self.parts))]
        return {self.variables[int(node.datum)] for node in nodes if node.op == "variable"}

    def values(self, x: Sequence[Enclosure]) -> list[Enclosure]:
        """Enclose the values on a box."""
        return self.enclose(self.roots, x)

    def jacobian(self, x: Sequence[Enclosure]) -> Matrix:
        """Enclose the partial derivatives, a row a function, which are proved defined, too."""
        n = len(self.variables)
        partials = [self.tape.derivative(root, v) for root in self.roots for v in range(n)]
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
    ) -> list[Enclosure]:
        """Enclose any roots of the tape on a box, the parts being proved defined there.

        parameters: their values, in place of all that their ranges allow.
        """
        bits = x[0].bits
        inputs = (*x, *(parameters or enclosed(self.ranges, bits))) if self.ranges else x
        return self.tape.evaluate((*roots, *self.parts), Enclosures(bits), inputs)[: len(roots)]


def read_formulas(*readers: Reader) -> Formulas:
    """Read texts; their variables are in the order of the alphabet, x where there are none."""
    names = {token for reader in readers for token in _tokens(reader) if token[0].isalpha()}
    return _read(readers, tuple(sorted(names - WORDS)) or ("x",))


def read_function(name: str, reader: Reader) -> Formulas:
    """Read {"variables", "values"}; names cannot be mistaken for anything else in print."""
    variables_of, values_of = reader.fields("variables", "values")
    if not FUNCTION_NAME.fullmatch(name):
        raise reader.fail("functions are named like F or Gap2, not N, N1, M, A or D")
    variables = tuple(item.string() for item in variables_of.items(1, MAX_VARIABLES))
    values = values_of.items(1, MAX_VALUES)
    names = {token for value in values for token in _tokens(value) if token[0].isalpha()}
    bound = sorted(names - WORDS - {*variables})  # names that are all substituted away
    for variable in (*variables, *bound):
        if not VARIABLE.fullmatch(variable) or variable in {*WORDS, "e"}:
            raise variables_of.fail(f"not a name for a variable: {variable[:30]!r}")
    if len(set(variables)) != len(variables):
        raise variables_of.fail("a variable is named twice")
    formulas = _read(values, (*variables, *bound), name)
    if unknown := sorted(formulas.free() - {*variables}):
        raise values_of.fail(f"unknown variable {unknown[0]!r}")
    return replace(formulas, variables=variables)


def _read(readers: Sequence[Reader], variables: tuple[str, ...], name: str = "") -> Formulas:
    if len(variables) > MAX_VARIABLES:
        raise readers[0].fail(f"more than {MAX_VARIABLES} variables")
    tape = Tape()
    places = {v: tape.add("variable", datum=Fraction(i)) for i, v in enumerate(variables)}
    placer = Placer(tape, places, [])
    roots = tuple(placer.read(reader) for reader in readers)
    texts = tuple(reader.string() for reader in readers)
    return Formulas(variables, texts, tape, roots, tuple(dict.fromkeys(placer.parts)), name)


def spelled(text: str) -> str:
    """Return a text as it has to be written: its tokens, with the spaces between them."""
    canonical, before = "", ""
    for token in _TOKEN.findall(text):
        between = token in ("+", "-") and (before == ")" or _WORD.fullmatch(before))
        canonical += f" {token} " if between else ", " if token == "," else token
        before = token
    return canonical


def _tokens(reader: Reader) -> list[str]:
    """Divide a text into its tokens; they, with the spaces that belong between them, give it."""
    text = reader.string()
    if len(text) > _MAX_LENGTH:
        raise reader.fail(f"a formula has at most {_MAX_LENGTH} characters")
    tokens: list[str] = _TOKEN.findall(text)
    METER.get().spend(5 * len(tokens))
    words = [token for token in tokens if token[0].isalnum()]
    if spelled(text) != text or not all(map(_WORD.fullmatch, words)):
        raise reader.fail(f"not a formula, or not in canonical form: {text[:40]!r}")
    return tokens


@dataclass
class Placer:
    """Puts the syntax trees of texts on a tape.

    places: of the variables, and of solutions of equations, which names stand for. parts: collects
    the functions of which derivatives are taken.
    """

    tape: Tape
    places: dict[str, int]
    parts: list[int]
    solutions: set[str] = field(default_factory=set)

    def read(self, reader: Reader) -> int:
        """Return the place of a text's expression."""
        _tokens(reader)
        try:
            return self._place(ast.parse(reader.string(), mode="eval").body, _MAX_DEPTH)
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            message = f"not a formula: {reader.string()[:40]!r}"
        except Unproved as error:
            message = str(error)
        raise reader.fail(message) from None

    def _place(self, node: ast.AST, depth: int) -> int:
        if depth == 0:
            raise Unproved(f"a formula nested more than {_MAX_DEPTH} deep")

        def inner(part: ast.AST) -> int:
            return self._place(part, depth - 1)

        match node:
            case ast.Constant(value=int(number)) if type(number) is int:
                place = self.tape.number(number)
            case ast.Name(id="pi"):
                place = self.tape.add("pi")
            case ast.Name(id=name):
                place = self._named(name)
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                place = self._folded("negative", inner(operand))
            case ast.BinOp(op=ast.Pow(), left=base, right=exponent):
                place = self.tape.add("^", inner(base), datum=_exponent(exponent))
            case ast.BinOp(op=op, left=left, right=right) if type(op) in _OPERATIONS:
                place = self._folded(_OPERATIONS[type(op)], inner(left), inner(right))
            case ast.Call(func=ast.Name(id="D"), args=[function, *by], keywords=[]) if by:
                place = self._derivative(inner(function), by)
            case ast.Call(func=ast.Name(id="at"), args=[function], keywords=words) if words:
                moves = {self._variable(word.arg): inner(word.value) for word in words}
                if len(moves) < len(words):
                    raise Unproved("a variable is substituted twice")
                place = self._moved(function, moves, depth - 1)
            case ast.Call(func=ast.Name(id=name), args=[one], keywords=[]) if name in FUNCTIONS:
                place = self.tape.add(name, inner(one))
            case _:
                raise Unproved(f"no formula has a {type(node).__name__} like this")
        return place

    def _derivative(self, place: int, by: list[ast.expr]) -> int:
        for each in by:
            variable = self._variable(each.id if isinstance(each, ast.Name) else None)
            self.parts.append(place)
            place = self.tape.derivative(place, int(self.tape.nodes[variable].datum))
        return place

    def _moved(self, function: ast.AST, moves: dict[int, int], depth: int) -> int:
        """Return a function's place, others being put in places; not into solutions: they end."""
        if names_in(function) & self.solutions:
            raise Unproved("nothing is substituted into the solution of an equation")
        before = len(self.parts)
        root = self._place(function, depth)
        place, *self.parts[before:] = self.tape.moved([root, *self.parts[before:]], moves)
        return place

    def _variable(self, name: str | None) -> int:
        place = self._named(name)
        if name in self.solutions or self.tape.nodes[place].op != "variable":
            raise Unproved(f"not a variable: {name!r}")
        return place

    def _named(self, name: str | None) -> int:
        if name not in self.places:
            raise Unproved(f"unknown variable {(name or '')[:30]!r}")
        return self.places[name]

    def _folded(self, op: str, *places: int) -> int:
        """Return the place of an operation; -a and a/b of numbers are numbers."""
        a, *b = (self.tape.nodes[place] for place in places)
        if op == "negative" and a.op == "number":
            return self.tape.number(-a.datum)
        if op == "/" and a.op == b[0].op == "number" and b[0].datum:
            return self.tape.number(a.datum / b[0].datum)
        return self.tape.add(op, *places)


def names_in(node: ast.AST) -> set[str]:
    """Return the names of which a formula is."""
    return {each.id for each in ast.walk(node) if isinstance(each, ast.Name)}


def _exponent(node: ast.AST) -> Fraction:
    sign = 1
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        node, sign = node.operand, -1
    value = node.value if isinstance(node, ast.Constant) else None
    if type(value) is not int or not 0 < value <= _MAX_POWER:
        raise Unproved(f"exponents are integers from 1 to {_MAX_POWER}, or their negatives")
    return Fraction(sign * value)
