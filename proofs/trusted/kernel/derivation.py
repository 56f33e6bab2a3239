"""Rules: equations between formulas, their power series, their values. Formulas are texts.

A text is read as `formulas` says, and not evaluated by Python.
"""

from __future__ import annotations

import ast
from collections.abc import Callable
from dataclasses import dataclass, field
from fractions import Fraction

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.angles import Angles, Finer
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.enclose import Box, Components, decide, leaves
from proofs.trusted.kernel.equation import Equal, Series, Value
from proofs.trusted.kernel.expansion import Expansions, Laurent
from proofs.trusted.kernel.formula import FUNCTIONS, Tape
from proofs.trusted.numbers import Range

_MAX_LENGTH = 12_000
_MAX_DEPTH = 150
_MAX_VARIABLES = 30
_MAX_POWER = 64
_MAX_ORDER = 12
_SPARE = 8  # how many terms a series may lose by cancellation

_WORDS = {*FUNCTIONS, "D", "at"}
_UNUSED = (Fraction(0), Fraction(0))  # the side of a variable that is substituted away
_OPERATIONS = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/"}


@dataclass
class Formulas:
    """The formulas of one step: their variables in the order of appearance, on one tape.

    parts: the functions of which derivatives were taken; a derivative, as computed, is one only
    where its function is defined.
    """

    tape: Tape = field(default_factory=Tape)
    variables: dict[str, int] = field(default_factory=dict)
    parts: list[int] = field(default_factory=list)

    def read(self, reader: Reader) -> int:
        """Put a text on the tape, return its place."""
        text = reader.string()
        if len(text) > _MAX_LENGTH or not text.isascii():
            raise reader.fail(f"a formula has at most {_MAX_LENGTH} characters, all ASCII")
        try:
            tree = ast.parse(text, mode="eval").body
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            raise reader.fail(f"not a formula: {text[:40]!r}") from None
        return self._place(tree, reader, _MAX_DEPTH)

    def variable(self, name: str, reader: Reader) -> int:
        """Return the place of a variable; its number is that of its appearance."""
        if name not in self.variables:
            if len(self.variables) >= _MAX_VARIABLES:
                raise reader.fail(f"more than {_MAX_VARIABLES} variables")
            self.variables[name] = self.tape.add("variable", datum=Fraction(len(self.variables)))
        return self.variables[name]

    def free(self, *roots: int) -> list[str]:
        """Return the variables that formulas depend on; those substituted away are others."""
        needed = set(self.tape.order(roots))
        return [name for name, place in self.variables.items() if place in needed]

    def _place(self, node: ast.AST, reader: Reader, depth: int) -> int:
        if depth == 0:
            raise reader.fail(f"nested more than {_MAX_DEPTH} deep")

        def inner(part: ast.AST) -> int:
            return self._place(part, reader, depth - 1)

        match node:
            case ast.Constant(value=int(number)) if type(number) is int:
                place = self.tape.number(number)
            case ast.Name(id=name) if name not in _WORDS:
                place = self.tape.add("pi") if name == "pi" else self.variable(name, reader)
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                place = self.tape.add("negative", inner(operand))
            case ast.BinOp(op=ast.Pow(), left=base, right=exponent):
                place = self.tape.power(inner(base), _exponent(exponent, reader))
            case ast.BinOp(op=op, left=left, right=right) if type(op) in _OPERATIONS:
                place = self.tape.add(_OPERATIONS[type(op)], inner(left), inner(right))
            case ast.Call(func=ast.Name(id="D"), args=[function, *by], keywords=[]) if by:
                place = self._derivative(inner(function), by, reader)
            case ast.Call(func=ast.Name(id="at"), args=[function], keywords=words) if words:
                places = [(word.arg, inner(word.value)) for word in words]
                before = len(self.parts)
                root = inner(function)
                moved = self._moved([root, *self.parts[before:]], places, reader)
                place, self.parts[before:] = moved[0], moved[1:]
            case ast.Call(func=ast.Name(id=name), args=[one], keywords=[]) if name in FUNCTIONS:
                place = self.tape.add(name, inner(one))
            case _:
                raise reader.fail(f"no formula has a {type(node).__name__} like this")
        return place

    def _derivative(self, place: int, by: list[ast.expr], reader: Reader) -> int:
        for name in by:
            if not isinstance(name, ast.Name) or name.id not in self.variables:
                raise reader.fail("a derivative is by variables of the function")
            self.parts.append(place)
            place = self.tape.derivative(place, list(self.variables).index(name.id))
        return place

    def _moved(
        self, roots: list[int], places: list[tuple[str | None, int]], reader: Reader
    ) -> list[int]:
        """Return the places of formulas with others in the places of variables, all at once."""
        moved: dict[int, int] = {}
        for name, place in places:
            if name is None or name not in self.variables or self.variables[name] in moved:
                raise reader.fail("variables of the function are substituted, each once")
            moved[self.variables[name]] = place
        for place in self.tape.order(tuple(roots)):
            node = self.tape.nodes[place]
            if place not in moved:
                inputs = [moved[argument] for argument in node.arguments]
                moved[place] = self.tape.add(node.op, *inputs, datum=node.datum)
        return [moved[root] for root in roots]


def _exponent(node: ast.expr, reader: Reader) -> int:
    sign = 1
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        node, sign = node.operand, -1
    value = node.value if isinstance(node, ast.Constant) else None
    if type(value) is not int or not 0 < value <= _MAX_POWER:
        raise reader.fail(f"exponents are integers from 1 to {_MAX_POWER}, or their negatives")
    return sign * value


def _prove(formulas: Formulas, reader: Reader, by_forms: Callable[[Angles], None]) -> None:
    """Prove something by normal forms, with units of angles as fine as it takes."""
    units = Angles(0).units
    while True:
        try:
            by_forms(Angles(len(formulas.variables), units=units))
        except Finer:
            continue
        break


def equal(context: Context, reader: Reader) -> Equal:
    """Rule `formula-equal`: {left, right}, formulas.

    Hypothesis: the two have normal forms P/Q and R/S with P S - R Q = 0, as polynomials in the
    variables, pi, roots, and sines and cosines of angles that are expanded by the addition theorem,
    modulo sin(a)^2 + cos(a)^2 = 1 and sqrt(a)^2 = a. Conclusion: they are equal wherever all their
    parts are defined. Proof. There each operation is one on real numbers, no divisor being 0.
    """
    left, right = reader.fields("left", "right")
    formulas = Formulas()
    roots = (formulas.read(left), formulas.read(right))

    def by_forms(forms: Angles) -> None:
        a, b = formulas.tape.evaluate(roots, forms, forms.inputs())
        if forms.apply("-", [a, b], None).top:
            raise Unproved("the normal forms of the two sides differ")

    _prove(formulas, reader, by_forms)
    return Equal(left.string(), right.string())


def series(context: Context, reader: Reader) -> Series:
    """Rule `formula-series`: {function, variable, coefficients, nonzero}.

    Hypothesis: the Laurent series of the function in the variable x, computed with normal forms as
    coefficients, each division being by a leading coefficient that is a number times some of
    `nonzero`, has no negative powers and begins with the coefficients. Conclusion: function = sum
    of coefficient_j x^j + O(x^n), n of them, as x -> 0, x not 0, wherever `nonzero` are not 0 and
    the parts of the coefficients are defined. Proof. At fixed values of the other variables each
    part of the function is analytic near x = 0, but for a pole at 0, and has the series computed.
    """
    function, variable, coefficients_of, nonzero_of = reader.fields(
        "function", "variable", "coefficients", "nonzero"
    )
    coefficients, nonzero = coefficients_of.items(1, _MAX_ORDER), nonzero_of.items(0, _MAX_ORDER)
    formulas = Formulas()
    root = formulas.read(function)
    if variable.string() not in formulas.variables:
        raise variable.fail("a variable of the function is expected")
    wanted = tuple(formulas.read(text) for text in coefficients)
    divisors = tuple(formulas.read(text) for text in nonzero)
    if variable.string() in formulas.free(*wanted, *divisors):
        raise variable.fail("coefficients do not depend on the variable of the series")
    number = list(formulas.variables).index(variable.string())

    def by_forms(forms: Angles) -> None:
        values = formulas.tape.evaluate((*wanted, *divisors), forms, forms.inputs())
        numbers = Expansions(forms, number, len(wanted), tuple(values[len(wanted) :]))
        found = _expanded(formulas, root, numbers)
        if any(found.coefficient(n).top for n in range(found.start, 0)):
            raise Unproved("a pole")
        for n, value in enumerate(values[: len(wanted)]):
            if forms.apply("-", [found.coefficient(n), value], None).top:
                raise Unproved(f"another coefficient of power {n}")

    _prove(formulas, reader, by_forms)
    return Series(
        function.string(),
        variable.string(),
        tuple(text.string() for text in coefficients),
        tuple(text.string() for text in nonzero),
    )


def _expanded(formulas: Formulas, root: int, numbers: Expansions) -> Laurent:
    """Return the series of a function up to its length; it is begun longer where terms are lost."""
    order = numbers.length
    for numbers.length in range(order, order + _SPARE):
        roots = (root, *formulas.parts)
        found = formulas.tape.evaluate(roots, numbers, numbers.inputs())[0]
        if found.end >= order:
            return found
    raise Unproved("too few terms of the series are known")


def value(context: Context, reader: Reader) -> Value:
    """Rule `formula-value`: {function, box: {variable: range}, tree, bounds}.

    Hypothesis: on each leaf of the tree, which divides the box (coordinates in the order in which
    the variables appear), an enclosure of the function lies within the bounds. Conclusion: the
    function is defined on the box and lies within the bounds there.
    """
    function, box_of, tree, bounds_of = reader.fields("function", "box", "tree", "bounds")
    formulas = Formulas()
    root = formulas.read(function)
    sides = {name: side.range() for name, side in box_of.members()}
    if set(sides) != set(formulas.free(root, *formulas.parts)):
        raise box_of.fail("a side for each variable of the function is expected")
    box: Box = tuple(sides.get(name, _UNUSED) for name in formulas.variables)
    bounds = bounds_of.range()
    map_ = Components(formulas.tape, len(box), (root, *formulas.parts))
    for leaf in leaves(tree, box):
        decide(map_, leaf, lambda found: _within(found[0].range, bounds))
    return Value(function.string(), tuple(sides.items()), bounds)


def _within(values: Range, bounds: Range) -> bool:
    return bounds[0] <= values[0] and values[1] <= bounds[1]
