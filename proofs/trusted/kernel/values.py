"""Rules about formulas: equations, power series, and values on boxes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.enclose import Box, attempts, box_text, decide, leaves
from proofs.trusted.kernel.formulas import Formulas, on_tape, read_formulas, same_form
from proofs.trusted.kernel.normalform import NormalForms, number, plus, power
from proofs.trusted.kernel.taylor import Taylor
from proofs.trusted.kernel.trees import (
    Number,
    Operation,
    Places,
    Power,
    Tree,
    Variable,
    bind,
    formula,
    read_tree,
)
from proofs.trusted.numbers import Range, show_range, within

_MAX_ORDER = 12
_UNUSED = ((Fraction(0), Fraction(0)),)  # the side of x where there is no variable


@dataclass(frozen=True)
class Equal(Conclusion):
    """left = right, at all real values of the variables at which all parts of both are defined."""

    left: Tree
    right: Tree

    @classmethod
    def read(cls, left: str, right: str) -> Equal:
        """Return what two texts say."""
        return cls(formula(left), formula(right))

    @property
    def formulas(self) -> tuple[Tree, ...]:
        """All formulas in it."""
        return self.left, self.right

    def put(self, places: Places) -> Equal:
        """Return it with formulas in the places of variables."""
        return Equal(*(bind(each, places) for each in self.formulas))

    def prove(self) -> None:
        """Raise Unproved unless it holds by `formula-equal`."""
        formulas = on_tape(*self.formulas)
        if not same_form(formulas.tape, *formulas.roots):
            raise Unproved("the normal forms of the two sides differ")

    @property
    def sentence(self) -> str:
        """Return the equation."""
        return f"`{self.left} = {self.right}`, wherever all parts of both sides are defined."


@dataclass(frozen=True)
class Series(Conclusion):
    """function = coefficients[0] + coefficients[1] x + ... + O(x^len(coefficients)) as x -> 0.

    x is the variable, from both sides; at fixed real values of the other variables at which the
    formulas `nonzero` are not 0 and the parts of the coefficients are defined.
    """

    function: Tree
    variable: Variable
    coefficients: tuple[Tree, ...]
    nonzero: tuple[Tree, ...] = ()

    @classmethod
    def read(
        cls, function: str, variable: str, coefficients: Sequence[str], nonzero: Sequence[str] = ()
    ) -> Series:
        """Return what texts say."""
        lists = (tuple(map(formula, texts)) for texts in (coefficients, nonzero))
        return cls(formula(function), Variable(variable), *lists)

    @property
    def formulas(self) -> tuple[Tree, ...]:
        """All formulas in it."""
        return self.function, *self.coefficients, *self.nonzero

    def put(self, places: Places) -> Series:
        """Return it with formulas in the places of variables, which x is not."""
        if self.variable.name in dict(places):
            raise Unproved("the variable of a series is no unknown")
        function, *others = (bind(each, places) for each in self.formulas)
        count = len(self.coefficients)
        return Series(function, self.variable, tuple(others[:count]), tuple(others[count:]))

    def prove(self) -> None:
        """Raise Unproved unless it holds by `formula-series`."""
        formulas, count = on_tape(*self.formulas), len(self.coefficients)
        name, tape = self.variable.name, formulas.tape
        if name not in self.function.free or any(name in x.free for x in self.formulas[1:]):
            raise Unproved("the function, and no coefficient, depends on the variable of a series")
        x = formulas.variables.index(name)
        forms = NormalForms(len(formulas.variables))
        roots = (*formulas.roots, *_divisors(formulas))
        rest, *values = tape.evaluate(roots, forms, forms.inputs())
        divisors = values[len(formulas.roots) - 1 :]
        taylor = Taylor(forms, x, values[count : len(formulas.roots) - 1])
        for divisor in divisors:
            taylor.order(divisor)
        for n, each in enumerate(values[:count]):
            rest = plus(rest, forms.times(each, power(x, n) if n else number(1)), -1)
        if not taylor.vanishes(rest, count):
            raise Unproved("the series begins otherwise")

    @property
    def polynomial(self) -> Tree:
        """What the series begins with."""
        powers = [Power(n, (self.variable,)) if n > 1 else self.variable for n in range(_MAX_ORDER)]
        terms = [
            Operation("*", (each, powers[n])) if n else each
            for n, each in enumerate(self.coefficients)
            if each != Number(0)
        ]
        return reduce(lambda a, b: Operation("+", (a, b)), terms or [Number(0)])

    @property
    def sentence(self) -> str:
        """Return the series."""
        coefficients = on_tape(*self.coefficients)
        nonzero = ", ".join(f"`{each}`" for each in self.nonzero)
        where = [f"{nonzero} are not 0"] if nonzero else []
        if any(map(coefficients.tape.may_fail, coefficients.roots)):
            where.append("the coefficients are defined")
        rest = Power(len(self.coefficients), (self.variable,))
        return (
            f"`{self.function} = {self.polynomial} + O({rest})` as `{self.variable}` -> 0"
            f"{' where ' if where else ''}{' and '.join(where)}."
        )


@dataclass(frozen=True)
class Value(Conclusion):
    """The function and all its parts are defined on a box; its values there are in these bounds."""

    function: Tree
    box: tuple[tuple[Variable, Range], ...]
    bounds: Range

    @property
    def sides(self) -> Mapping[str, Range]:
        """The sides of the box, by the names of the variables."""
        return {variable.name: side for variable, side in self.box}

    @property
    def sentence(self) -> str:
        """Return the bounds."""
        where = f" for {box_text([*self.sides.values()], [*self.sides])}" if self.box else ""
        return f"`{self.function}` lies in {show_range(self.bounds)}{where}."


def equal(_: Context, reader: Reader) -> Equal:
    """Rule `formula-equal`: {left, right}.

    Hypothesis: the difference of their normal forms (see `normalform`), times the polynomials of
    which it has inverses, is 0. Conclusion: they are equal wherever all their parts are defined.
    Proof. There each operation on normal forms is one on complex numbers, no divisor being 0.
    """
    found = _equal(reader)
    found.prove()
    return found


def value(_: Context, reader: Reader) -> Value:
    """Rule `formula-value`: {function, box: {variable: range}, tree, bounds}.

    Hypothesis: on each leaf of the tree, which divides the box (coordinates in the order of the
    alphabet), an enclosure of the function lies within the bounds, or its exact value, the normal
    form, at a leaf that is a point. Conclusion: the function is defined on the box, with the
    functions of which it takes derivatives, and lies within the bounds there.
    Proof. The leaves cover the box; an enclosure contains all values on its leaf, and exists only
    where the function is defined; a normal form has the same value.
    (Bounds of one sign are a sign, those of D(F, x) say that F is monotone or by how much it
    expands, and the value at a point refutes what it contradicts.)
    """
    function, box_of, tree, bounds_of = reader.fields("function", "box", "tree", "bounds")
    formulas = read_formulas(function)
    sides = {name: side.range() for name, side in sorted(box_of.members())}
    if set(sides) != formulas.trees[0].free:
        raise box_of.fail("a side for each variable of the function is expected")
    bounds = bounds_of.range()
    for leaf in leaves(tree, tuple(sides.values()) or _UNUSED):
        try:
            decide(formulas, leaf, lambda found: within(found[0].range, bounds))
        except Unproved:
            if not _exactly_within(formulas, leaf, bounds):
                raise
    box = tuple((Variable(name), side) for name, side in sides.items())
    return Value(formulas.trees[0], box, bounds)


def _exactly_within(formulas: Formulas, box: Box, bounds: Range) -> bool:
    """Whether a box is a point, where the function is defined and has a rational normal form."""
    if any(low < high for low, high in box) or not any(attempts(formulas, box)):
        return False
    forms = NormalForms(len(box))
    point = [number(low) for low, _ in box]
    (value,) = formulas.tape.evaluate(formulas.roots, forms, point)
    exact = value.get((), Fraction(0))
    return value.keys() <= {()} and within((exact, exact), bounds)


def series(_: Context, reader: Reader) -> Series:
    """Rule `formula-series`: {function F, variable x, coefficients, nonzero}.

    Hypotheses, F being made with + - * / and powers, exp, sin, cos, D and at alone, and C being the
    polynomial with the coefficients, n of them:
    1. the normal form of each divisor in F is N / D, D without 0, and N has a Taylor series in x
       whose leading coefficient is a number times a product of powers of `nonzero`;
    2. that of F - C is P/Q; Q has so, too, and is of order m, say; 3. the coefficients of P below
       x^(m + n) are 0.
    Conclusion: F = C + O(x^n), n terms, as x -> 0, x not 0, wherever `nonzero` are not 0 and the
    parts of the coefficients are defined.

    Proof. Fix the other variables so. Numerators are analytic in x, being polynomials in x and in
    exponentials of monomials in x, so by 1 no divisor is 0 for small x other than 0: F is defined
    there, and F - C = P/Q, where P = O(x^(m+n)) and |Q| >= c |x|^m, c > 0.
    """
    found = _series(reader)
    found.prove()
    return found


def _series(reader: Reader) -> Series:
    function_of, variable_of, *lists = reader.fields(
        "function", "variable", "coefficients", "nonzero"
    )
    function, variable = read_tree(function_of), read_tree(variable_of)
    if not isinstance(variable, Variable):
        raise variable_of.fail("a variable is expected")
    coefficients, nonzero = (
        tuple(map(read_tree, each.items(least, _MAX_ORDER)))
        for each, least in zip(lists, (1, 0), strict=True)
    )
    return Series(function, variable, coefficients, nonzero)


def _equal(reader: Reader) -> Equal:
    return Equal(*map(read_tree, reader.fields("left", "right")))


def read_lemma(reader: Reader) -> Equal | Series:
    """Read an equation or a series."""
    return _equal(reader) if reader.has("left") else _series(reader)


def _divisors(formulas: Formulas) -> list[int]:
    """Return the places of all divisors in the first formula, and in what it differentiates."""
    found = []
    for place in formulas.tape.order((formulas.roots[0], *formulas.parts)):
        op, arguments, datum = formulas.tape.nodes[place]
        if op in ("sqrt", "log", "atan"):
            raise Unproved(f"no series of {op}")
        if op == "/" or (op == "^" and datum < 0):
            found.append(arguments[-1])
    return found
