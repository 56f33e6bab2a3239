"""Formulas as trees: their one reader, their one printer, and substitution.

A text is in Python's notation: + - * / and ** with an integer exponent other than 0, integers,
decimals of at most 40 places, which are exact too, pi, sqrt, exp, log, sin, cos, atan, names of
variables of at most 12 characters. D(F, x, y) is the derivative of F by x and then by y; at(F, x=G,
y=H), F with G and H in the places of x and y at once, binds x and y in F, where they are named _1,
_2 and so on, whatever the text calls them. As usual - and / are taken from the left, -x**2 is
-(x**2), and a/b*c is (a/b)*c.

What is printed is printed from the tree. Printed text, read again, is the same tree.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.expression import FUNCTIONS
from proofs.trusted.kernel.meter import METER
from proofs.trusted.numbers import show

_MAX_LENGTH = 12_000
_MAX_DEPTH = 150
_MAX_POWER = 1000
_TEXT = re.compile(
    r"(?:[-+*/(),= ]|[A-Za-z_]\w*+|[0-9]++(?:\.[0-9]{1,40}+)?+(?![\w.]))*+", re.ASCII
)
_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,11}")
_BOUND = re.compile(r"_[1-9][0-9]{0,3}")
_WORDS = {*FUNCTIONS, "pi", "D", "at"}
_OPERATIONS = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/"}
SUM, SIGNED, PRODUCT, POWER, ATOM = range(5)  # how tightly a part is bound


class Tree:
    """A formula, made of parts."""

    parts: tuple[Tree, ...] = ()

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
    """An integer, or a decimal, >= 0."""

    value: Fraction | int


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
    """A sum, difference, product, quotient, negative, or a function of one part."""

    op: str
    parts: tuple[Tree, ...]


@dataclass(frozen=True)
class Power(Tree):
    """An integer power, other than 0, of one part."""

    exponent: int
    parts: tuple[Tree, ...]


@dataclass(frozen=True)
class Derivative(Tree):
    """The derivative of one part by some variables, one after the other, which stay free."""

    by: tuple[str, ...]
    parts: tuple[Tree, ...]

    @cached_property
    def free(self) -> frozenset[str]:
        return self.parts[0].free | {*self.by}


@dataclass(frozen=True)
class At(Tree):
    """The first part with the others in the places of variables, all at once: these it binds."""

    names: tuple[str, ...]
    parts: tuple[Tree, ...]

    @cached_property
    def free(self) -> frozenset[str]:
        function, *others = (part.free for part in self.parts)
        return (function - {*self.names}).union(*others)

    @cached_property
    def bound(self) -> frozenset[str]:
        return frozenset(self.names).union(*(part.bound for part in self.parts))


Places = tuple[tuple[str, Tree], ...]  # formulas in the places of variables


def substitute(tree: Tree, places: Mapping[str, Tree]) -> Tree:
    """Return a formula with others in the places of its variables, all at once.

    Raises Unproved where one of them would be captured: bound by an `At`, or differentiated by.
    """
    METER.get().spend(10)
    places = {name: value for name, value in places.items() if name in tree.free}
    if not places or isinstance(tree, Variable):
        return places[tree.name] if places and isinstance(tree, Variable) else tree
    inner = [places] * len(tree.parts)
    if isinstance(tree, At):
        inner[0] = {x: value for x, value in places.items() if x not in tree.names}
        if any(
            value.free & {*tree.names} for x, value in inner[0].items() if x in tree.parts[0].free
        ):
            raise Unproved("a substitution that captures a variable")
    parts = tuple(map(substitute, tree.parts, inner))
    if isinstance(tree, Derivative):
        by = tuple(x.name for n in tree.by if isinstance(x := places.get(n, Variable(n)), Variable))
        others = [places.get(name, Variable(name)).free for name in tree.free - {*tree.by}]
        if len({*by}) < len({*tree.by}) or any(free & {*by} for free in others):
            raise Unproved("a substitution that changes what is differentiated")
        return Derivative(by, parts)
    return replace(tree, parts=parts)  # type: ignore[type-var]


# -- the reader ------------------------------------------------------------------------------------


def is_name(text: str) -> bool:
    """Whether a variable can be called so."""
    return bool(_NAME.fullmatch(text)) and text not in _WORDS


def read_tree(reader: Reader) -> Tree:
    """Read a formula."""
    text = reader.string()
    if len(text) > _MAX_LENGTH:
        raise reader.fail(f"a formula has at most {_MAX_LENGTH} characters")
    METER.get().spend(10 * len(text))
    try:
        if not _TEXT.fullmatch(text):
            raise Unproved("a character that is in no formula")
        tree = _tree(ast.parse(text, mode="eval").body, text, _MAX_DEPTH)
        if any(map(_BOUND.fullmatch, tree.free)):
            raise Unproved("a variable without a name")
        return tree
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        message = f"not a formula: {text[:40]!r}"
    except Unproved as error:
        message = str(error)
    raise reader.fail(message) from None


def formula(text: str) -> Tree:
    """Return the formula that a text says."""
    return read_tree(Reader(text))


def _tree(node: ast.AST | None, text: str, depth: int) -> Tree:
    if depth == 0:
        raise Unproved(f"a formula nested more than {_MAX_DEPTH} deep")

    def inner(part: ast.AST) -> Tree:
        return _tree(part, text, depth - 1)

    tree: Tree
    match node:
        case ast.Constant(col_offset=start, end_col_offset=end) if text[start].isdigit():
            number = Fraction(text[start:end])  # the value would be a float
            tree = Number(number if number.denominator > 1 else int(number))
        case ast.Name(id=name):
            tree = Pi() if name == "pi" else Variable(_name(name))
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            tree = Operation("negative", (inner(operand),))
        case ast.BinOp(op=ast.Pow(), left=base, right=exponent):
            tree = Power(_exponent(exponent), (inner(base),))
        case ast.BinOp(op=op, left=left, right=right) if type(op) in _OPERATIONS:
            tree = Operation(_OPERATIONS[type(op)], (inner(left), inner(right)))
        case ast.Call(func=ast.Name(id="D"), args=[function, *by], keywords=[]) if by:
            names = tuple(_name(x.id if isinstance(x, ast.Name) else None) for x in by)
            tree = Derivative(names, (inner(function),))
        case ast.Call(func=ast.Name(id="at"), args=[function], keywords=words) if words:
            places = tuple((_name(word.arg), inner(word.value)) for word in words)
            tree = bind(inner(function), places)
        case ast.Call(func=ast.Name(id=name), args=[one], keywords=[]) if name in FUNCTIONS:
            tree = Operation(name, (inner(one),))
        case _:
            raise Unproved(f"no formula has a {type(node).__name__} like this")
    return tree


def _name(name: str | None) -> str:
    if name is None or not (is_name(name) or _BOUND.fullmatch(name)):
        raise Unproved(f"not a name for a variable: {(name or '')[:30]!r}")
    return name


def bind(function: Tree, places: Places) -> At:
    """Return at(function, ...); what it binds are the first _k after those bound in it."""
    given = [name for name, _ in places]
    first = 1 + max((int(name[1:]) for name in function.bound), default=0)
    names = tuple(f"_{k}" for k in range(first, first + len(given)))
    if len({*given}) < len(given) or function.free & {*names} - {*given}:
        raise Unproved("a variable is substituted twice")
    renamed = substitute(function, dict(zip(given, map(Variable, names), strict=True)))
    return At(names, (renamed, *(value for _, value in places)))


def _exponent(node: ast.expr) -> int:
    value = ast.literal_eval(node)
    if type(value) is not int or not 0 < abs(value) <= _MAX_POWER:
        raise Unproved(f"exponents are integers from 1 to {_MAX_POWER}, or their negatives")
    return value


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
                return show(value) if isinstance(value, Fraction) else str(value), ATOM
            case Pi() | Variable():
                return self.symbol("pi" if isinstance(tree, Pi) else tree.name), ATOM
            case Power(exponent=n, parts=(base,)):
                return self.power(base, n), POWER
            case Operation(op="negative", parts=(one,)):
                return f"-{self.inside(one, POWER)}", SIGNED
            case Operation(op=op, parts=(left, right)):
                return self.operation(op, left, right)
        return self.call(tree, *map(self.text, tree.parts)), ATOM

    def operation(self, op: str, left: Tree, right: Tree) -> tuple[str, int]:
        """Return a sum, difference, product or quotient."""
        if op in "+-":
            return f"{self.inside(left, SUM)} {op} {self.inside(right, PRODUCT)}", SUM
        first, bound = self.part(left)
        first = first if bound >= SIGNED else self.brackets(first)
        written = self.product(first, self.inside(right, POWER), op)
        return written, SIGNED if bound == SIGNED else PRODUCT

    def inside(self, tree: Tree, least: int) -> str:
        """Return a part, in brackets unless it is bound as tightly as that."""
        text, bound = self.part(tree)
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

    def call(self, tree: Tree, first: str, *others: str) -> str:
        """Return a function, a derivative, or a formula with others in places, by its parts."""
        if isinstance(tree, At):
            others = tuple(f"{name}={x}" for name, x in zip(tree.names, others, strict=True))
        name = tree.op if isinstance(tree, Operation) else "at" if isinstance(tree, At) else "D"
        by = tree.by if isinstance(tree, Derivative) else ()
        return f"{name}({', '.join((first, *by, *others))})"
