"""Rules about formulas: equations, power series, and values on boxes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.enclose import Box, attempts, box_text, decide, leaves
from proofs.trusted.kernel.formulas import Formulas, read_formulas
from proofs.trusted.kernel.normalform import NormalForms, number, plus, power
from proofs.trusted.kernel.taylor import Taylor
from proofs.trusted.numbers import Range, show_range, within

_MAX_ORDER = 12
_UNUSED = (Fraction(0), Fraction(0))  # the side of a variable that is substituted away


@dataclass(frozen=True)
class Equal(Conclusion):
    """left = right, at all real values of the variables at which all parts of both are defined."""

    left: str
    right: str

    @property
    def sentence(self) -> str:
        """Return the equation."""
        return f"{self.left} = {self.right}, wherever all parts of both sides are defined."


@dataclass(frozen=True)
class Series(Conclusion):
    """function = coefficients[0] + coefficients[1] x + ... + O(x^len(coefficients)) as x -> 0.

    x is the variable, from both sides; at fixed real values of the other variables at which the
    formulas `nonzero` are not 0 and the parts of the coefficients are defined.
    """

    function: str
    variable: str
    coefficients: tuple[str, ...]
    nonzero: tuple[str, ...] = ()

    @property
    def sentence(self) -> str:
        """Return the series."""
        terms = " + ".join(
            f"({each})*{self.variable}**{n}" for n, each in enumerate(self.coefficients)
        )
        where = f" where {', '.join(self.nonzero)} are not 0" if self.nonzero else ""
        return (
            f"{self.function} = {terms} + O({self.variable}**{len(self.coefficients)}) as "
            f"{self.variable} -> 0{where}."
        )


@dataclass(frozen=True)
class Value(Conclusion):
    """The function and all its parts are defined on a box; its values there are in these bounds."""

    function: str
    box: tuple[tuple[str, Range], ...]
    bounds: Range

    @property
    def sides(self) -> Mapping[str, Range]:
        """The sides of the box, by the names of the variables."""
        return dict(self.box)

    @property
    def sentence(self) -> str:
        """Return the bounds."""
        names = list(self.sides)
        where = f" for {box_text(list(self.sides.values()), names)}" if names else ""
        return f"{self.function} lies in {show_range(self.bounds)}{where}."


def equal(_: Context, reader: Reader) -> Equal:
    """Rule `formula-equal`: {left, right}.

    Hypothesis: the difference of their normal forms (see `normalform`), times the polynomials of
    which it has inverses, is 0. Conclusion: they are equal wherever all their parts are defined.
    Proof. There each operation on normal forms is one on complex numbers, no divisor being 0.
    """
    left, right = reader.fields("left", "right")
    formulas = read_formulas(left, right)
    forms = NormalForms(len(formulas.variables))
    a, b = formulas.tape.evaluate(formulas.roots, forms, forms.inputs())
    if not forms.is_zero(plus(a, b, -1)):
        raise Unproved("the normal forms of the two sides differ")
    return Equal(*formulas.texts)


def value(_: Context, reader: Reader) -> Value:
    """Rule `formula-value`: {function, box: {variable: range}, tree, bounds}.

    Hypothesis: on each leaf of the tree, which divides the box (coordinates in the order of the
    alphabet, among all names in the text), an enclosure of the function lies within the bounds, or
    its exact value, the normal form, at a leaf that is a point. Conclusion: the function is defined
    on the box, with the functions of which it takes derivatives, and lies within the bounds there.
    Proof. The leaves cover the box; an enclosure contains all values on its leaf, and exists only
    where the function is defined; a normal form has the same value.
    (Bounds of one sign are a sign, those of D(F, x) say that F is monotone or by how much it
    expands, and the value at a point refutes what it contradicts.)
    """
    function, box_of, tree, bounds_of = reader.fields("function", "box", "tree", "bounds")
    formulas = read_formulas(function)
    sides = {name: side.range() for name, side in sorted(box_of.members())}
    if set(sides) != formulas.free():
        raise box_of.fail("a side for each variable of the function is expected")
    bounds = bounds_of.range()
    for leaf in leaves(tree, tuple(sides.get(name, _UNUSED) for name in formulas.variables)):
        try:
            decide(formulas, leaf, lambda found: within(found[0].range, bounds))
        except Unproved:
            if not _exactly_within(formulas, leaf, bounds):
                raise
    return Value(function.string(), tuple(sides.items()), bounds)


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
    function, variable, coefficients_of, nonzero_of = reader.fields(
        "function", "variable", "coefficients", "nonzero"
    )
    coefficients, nonzero = coefficients_of.items(1, _MAX_ORDER), nonzero_of.items(0, _MAX_ORDER)
    formulas = read_formulas(function, *coefficients, *nonzero)
    name, tape, count = variable.string(), formulas.tape, len(coefficients)
    if name not in formulas.variables:
        raise variable.fail("a variable of the function is expected")
    x = formulas.variables.index(name)
    if tape.add("variable", datum=Fraction(x)) in tape.order(formulas.roots[1:]):
        raise variable.fail("coefficients do not depend on the variable of the series")
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
    texts = formulas.texts
    return Series(texts[0], name, texts[1 : count + 1], texts[count + 1 :])


def _divisors(formulas: Formulas) -> list[int]:
    """Return the places of all divisors in the first formula, and in what it differentiates."""
    found = []
    for place in formulas.tape.order((formulas.roots[0], *formulas.parts)):
        op, arguments, datum = formulas.tape.nodes[place]
        if op in ("sqrt", "log"):
            raise Unproved(f"no series of {op}")
        if op == "/" or (op == "^" and datum < 0):
            found.append(arguments[-1])
    return found
