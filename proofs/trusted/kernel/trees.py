"""Formulas as trees: their one reader, their one printer, and substitution.

A text is in Python's notation: + - * / and ** with an integer exponent other than 0, integers, pi,
sqrt, exp, log, sin, cos, names of variables of at most 12 characters. D(F, x, y) is the derivative
of F by x and then by y; at(F, x=G, y=H), F with G and H in the places of x and y at once, binds x
and y in F, where they are named u, u1, u2 and so on, whatever the text calls them. As usual - and /
are taken from the left, -x**2 is -(x**2), and a/b*c is (a/b)*c.

What is printed is printed from the tree. Printed text, read again, is the same tree.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import count

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.expression import FUNCTIONS
from proofs.trusted.kernel.meter import METER

_MAX_LENGTH = 12_000
_MAX_DEPTH = 150
_MAX_POWER = 1000
_TEXT = re.compile(r"(?:[-+*/(),= ]|[A-Za-z]\w*+|[0-9]++(?![A-Za-z_]))*+", re.ASCII)
_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,11}")
_WORDS = {*FUNCTIONS, "pi", "D", "at"}
_OPERATIONS = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/"}
SUM, SIGNED, PRODUCT, POWER, ATOM = range(5)  # how tightly a part is bound


class Tree:
    """A formula. parts: the formulas that it is made of."""

    @property
    def parts(self) -> tuple[Tree, ...]:
        return ()

    @cached_property
    def free(self) -> frozenset[str]:
        """Its variables, but for those that are bound."""
        return frozenset[str]().union(*(part.free for part in self.parts))

    @cached_property
    def bound(self) -> frozenset[str]:
        """The variables that it, or a part of it, binds."""
        return frozenset[str]().union(*(part.bound for part in self.parts))

    def __str__(self) -> str:
        return Printer().text(self)


@dataclass(frozen=True)
class Number(Tree):
    """An integer >= 0."""

    value: int


@dataclass(frozen=True)
class Pi(Tree):
    """The number pi."""


@dataclass(frozen=True)
class Variable(Tree):
    """A real variable."""

    name: str

    @cached_property
    def free(self) -> frozenset[str]:
        return frozenset((self.name,))


@dataclass(frozen=True)
class Operation(Tree):
    """A sum, difference, product, quotient, negative, or a function of its arguments."""

    op: str
    arguments: tuple[Tree, ...]

    @property
    def parts(self) -> tuple[Tree, ...]:
        return self.arguments


@dataclass(frozen=True)
class Power(Tree):
    """An integer power, other than 0."""

    base: Tree
    exponent: int

    @property
    def parts(self) -> tuple[Tree, ...]:
        return (self.base,)


@dataclass(frozen=True)
class Derivative(Tree):
    """The derivative by some variables, one after the other, which stay free."""

    function: Tree
    by: tuple[str, ...]

    @property
    def parts(self) -> tuple[Tree, ...]:
        return (self.function, *map(Variable, self.by))


Places = tuple[tuple[str, Tree], ...]  # formulas in the places of variables


@dataclass(frozen=True)
class At(Tree):
    """A function with others in the places of variables, all at once: these it binds."""

    function: Tree
    places: Places

    @property
    def parts(self) -> tuple[Tree, ...]:
        return (self.function, *(value for _, value in self.places))

    @cached_property
    def free(self) -> frozenset[str]:
        inner = self.function.free - {name for name, _ in self.places}
        return inner.union(*(value.free for _, value in self.places))

    @cached_property
    def bound(self) -> frozenset[str]:
        names = (name for name, _ in self.places)
        return frozenset(names).union(*(part.bound for part in self.parts))


def substitute(tree: Tree, places: Mapping[str, Tree]) -> Tree:
    """Return a formula with others in the places of its variables, all at once.

    Raises Unproved where one of them would be captured: bound by an `At`, or differentiated by.
    """
    METER.get().spend(10)
    places = {name: value for name, value in places.items() if name in tree.free}
    match tree:
        case Variable(name=name) if places:
            return places[name]
        case Operation(op=op, arguments=arguments) if places:
            return Operation(op, tuple(substitute(each, places) for each in arguments))
        case Power(base=base, exponent=n) if places:
            return Power(substitute(base, places), n)
        case Derivative(function=function, by=by) if places:
            after = [places.get(name, Variable(name)) for name in by]
            renamed = [each.name for each in after if isinstance(each, Variable)]
            others = [places.get(name, Variable(name)) for name in tree.free - {*by}]
            if len({*renamed}) < len({*by}) or any(x.free & {*renamed} for x in others):
                raise Unproved("a substitution that changes what is differentiated")
            return Derivative(substitute(function, places), tuple(renamed))
        case At(function=function, places=inner) if places:
            bound = {name for name, _ in inner}
            outer = {name: x for name, x in places.items() if name in function.free - bound}
            if any(value.free & bound for value in outer.values()):
                raise Unproved("a substitution that captures a variable")
            put = tuple((name, substitute(value, places)) for name, value in inner)
            return At(substitute(function, outer), put)
    return tree


# -- the reader ------------------------------------------------------------------------------------


def is_name(text: str) -> bool:
    """Whether a variable can be called so."""
    return bool(_NAME.fullmatch(text)) and text not in _WORDS


def read_tree(reader: Reader) -> Tree:
    """Read a formula."""
    text = reader.string()
    if len(text) > _MAX_LENGTH:
        raise reader.fail(f"a formula has at most {_MAX_LENGTH} characters")
    METER.get().spend(2 * len(text))
    try:
        if not _TEXT.fullmatch(text):
            raise Unproved("a character that is in no formula")
        return _tree(ast.parse(text, mode="eval").body, _MAX_DEPTH)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        message = f"not a formula: {text[:40]!r}"
    except Unproved as error:
        message = str(error)
    raise reader.fail(message) from None


def formula(text: str) -> Tree:
    """Return the formula that a text says."""
    return read_tree(Reader(text))


def _tree(node: ast.AST | None, depth: int) -> Tree:
    if depth == 0:
        raise Unproved(f"a formula nested more than {_MAX_DEPTH} deep")

    def inner(part: ast.AST) -> Tree:
        return _tree(part, depth - 1)

    tree: Tree
    match node:
        case ast.Constant(value=int(number)) if type(number) is int:
            tree = Number(number)
        case ast.Name(id=name):
            tree = Pi() if name == "pi" else Variable(_name(name))
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            tree = Operation("negative", (inner(operand),))
        case ast.BinOp(op=ast.Pow(), left=base, right=exponent):
            tree = Power(inner(base), _exponent(exponent))
        case ast.BinOp(op=op, left=left, right=right) if type(op) in _OPERATIONS:
            tree = Operation(_OPERATIONS[type(op)], (inner(left), inner(right)))
        case ast.Call(func=ast.Name(id="D"), args=[function, *by], keywords=[]) if by:
            variables = [_name(each.id if isinstance(each, ast.Name) else None) for each in by]
            tree = Derivative(inner(function), tuple(variables))
        case ast.Call(func=ast.Name(id="at"), args=[function], keywords=words) if words:
            places = tuple((_name(word.arg), inner(word.value)) for word in words)
            tree = bind(inner(function), places)
        case ast.Call(func=ast.Name(id=name), args=[one], keywords=[]) if name in FUNCTIONS:
            tree = Operation(name, (inner(one),))
        case _:
            raise Unproved(f"no formula has a {type(node).__name__} like this")
    return tree


def _name(name: str | None) -> str:
    if name is None or not is_name(name):
        raise Unproved(f"not a name for a variable: {(name or '')[:30]!r}")
    return name


def bind(function: Tree, places: Places) -> At:
    """Return at(function, ...); bound are the first u, u1, ... that are nowhere else in it."""
    given = [name for name, _ in places]
    if len({*given}) < len(given):
        raise Unproved("a variable is substituted twice")
    others = function.bound | function.free - {*given}
    fresh = (name for n in count() if (name := f"u{n or ''}") not in others)
    new = dict(zip(given, fresh, strict=False))
    renamed = substitute(function, {name: Variable(new[name]) for name in given})
    return At(renamed, tuple((new[name], value) for name, value in places))


def _exponent(node: ast.AST) -> int:
    sign = 1
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        node, sign = node.operand, -1
    value = node.value if isinstance(node, ast.Constant) else None
    if type(value) is not int or not 0 < value <= _MAX_POWER:
        raise Unproved(f"exponents are integers from 1 to {_MAX_POWER}, or their negatives")
    return sign * value


# -- the printer -----------------------------------------------------------------------------------


class Printer:
    """Prints trees in plain text; other notations override its marks.

    All products are explicit, a negative number or factor that is not the first has brackets, and
    so has what is raised to a power unless it is a symbol, a number or a function.
    """

    def text(self, tree: Tree) -> str:
        """Return a formula."""
        return self.part(tree)[0]

    def part(self, tree: Tree) -> tuple[str, int]:
        """Return a part of a formula, and how tightly it is bound."""
        METER.get().spend(2)
        match tree:
            case Number(value=value):
                printed = str(value), ATOM
            case Variable(name=name):
                printed = self.symbol(name), ATOM
            case Pi():
                printed = self.symbol("pi"), ATOM
            case Power(base=base, exponent=n):
                printed = self.power(base, n), POWER
            case Operation(op="negative", arguments=(one,)):
                printed = f"-{self.inside(one, POWER)}", SIGNED
            case Operation(op=op, arguments=(left, right)):
                printed = self.operation(op, left, right)
            case Operation(op=name, arguments=(one,)):
                printed = self.function(name, one), ATOM
            case Derivative(function=function, by=by):
                printed = self.derivative(function, by), ATOM
            case At(function=function, places=places):
                printed = self.at(function, places), ATOM
            case _:
                raise TypeError(f"not a formula: {tree!r}")
        return printed

    def operation(self, op: str, left: Tree, right: Tree) -> tuple[str, int]:
        """Return a sum, difference, product or quotient."""
        if op in "+-":
            return f"{self.inside(left, SUM)} {op} {self.inside(right, PRODUCT)}", SUM
        first, bound = self.part(left)
        first = self.bracketed(first, bound, SIGNED)
        written = self.product(first, self.inside(right, POWER), op)
        return written, SIGNED if bound == SIGNED else PRODUCT

    def inside(self, tree: Tree, least: int) -> str:
        """Return a part, in brackets unless it is bound as tightly as that."""
        return self.bracketed(*self.part(tree), least)

    def bracketed(self, text: str, bound: int, least: int) -> str:
        """Put brackets around what is not bound tightly."""
        return text if bound >= least else self.brackets(text)

    def brackets(self, text: str) -> str:
        """Put brackets around."""
        return f"({text})"

    def symbol(self, name: str) -> str:
        """Return a variable."""
        return name

    def product(self, left: str, right: str, op: str) -> str:
        """Return a product or a quotient."""
        return f"{left}{op}{right}"

    def power(self, base: Tree, n: int) -> str:
        """Return a power."""
        return f"{self.inside(base, ATOM)}**{n if n > 0 else f'({n})'}"

    def function(self, name: str, one: Tree) -> str:
        """Return a function."""
        return f"{name}({self.text(one)})"

    def derivative(self, function: Tree, by: tuple[str, ...]) -> str:
        """Return a derivative."""
        return f"D({', '.join([self.text(function), *by])})"

    def at(self, function: Tree, places: Places) -> str:
        """Return what has other formulas in places."""
        put = [f"{name}={self.text(value)}" for name, value in places]
        return f"at({', '.join([self.text(function), *put])})"
