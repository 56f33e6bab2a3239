"""Rules: inequalities about a formula on a box, from a subdivision, and their refutation.

Each is a statement about a quantity q: a component F_i of a function, or a partial derivative of
one. It is proved on every leaf of a subdivision tree, whose leaves cover the box, and refuted at
one exact point of the box.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import TypeVar

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context, Quantity, read_box, read_point, where
from proofs.trusted.kernel.enclose import Box, Exact, attempts, box_text, decide, leaves, point_box
from proofs.trusted.kernel.formula import Formula
from proofs.trusted.kernel.meter import METER
from proofs.trusted.numbers import Range, show, show_range

SIGNS = {"+": 1, "-": -1}
S = TypeVar("S", "Sign", "Monotone", "Within", "Expands")


@dataclass(frozen=True)
class Inequality(Conclusion):
    """A statement about a quantity at every point of a box."""

    quantity: Quantity
    box: Box

    @property
    def where(self) -> str:
        """The function and the box."""
        return where(self.quantity.formula, self.box, self.quantity.component)

    def holds(self, values: Range) -> bool:
        """Whether it follows where the quantity lies in these bounds."""
        raise NotImplementedError

    def fails(self, values: Range) -> bool:
        """Whether it is false if at one point the quantity lies in these bounds."""
        raise NotImplementedError

    @property
    def sentence(self) -> str:
        """Return the statement."""
        raise NotImplementedError


@dataclass(frozen=True)
class Sign(Inequality):
    """q > 0 (sign 1) or q < 0 (sign -1) on the box."""

    sign: int

    @classmethod
    def read(cls, context: Context, reader: Reader) -> Sign:
        """Read {function, component, box, sign}."""
        function, component, box, sign = reader.fields("function", "component", "box", "sign")
        quantity = Quantity.read(context, function, component)
        return cls(quantity, read_box(box, len(quantity.formula.variables)), read_sign(sign))

    def holds(self, values: Range) -> bool:
        """Whether it follows where the quantity lies in these bounds."""
        return _has_sign(values, self.sign)

    def fails(self, values: Range) -> bool:
        """Whether it is false if at one point the quantity lies in these bounds."""
        return values[1] <= 0 if self.sign > 0 else values[0] >= 0

    @property
    def sentence(self) -> str:
        """Return the statement."""
        return f"{self.where}: {self.quantity.name} {'>' if self.sign > 0 else '<'} 0"


def _has_sign(values: Range, sign: int) -> bool:
    """Whether all numbers within the bounds have this strict sign."""
    return values[0] > 0 if sign > 0 else values[1] < 0


@dataclass(frozen=True)
class Monotone(Inequality):
    """F_i is strictly increasing (sign 1) or decreasing (-1) in one variable on the box."""

    sign: int

    @classmethod
    def read(cls, context: Context, reader: Reader) -> Monotone:
        """Read {function, component, variable, box, sign}; the box has a width in the variable."""
        function, component, variable, box, sign = reader.fields(
            "function", "component", "variable", "box", "sign"
        )
        quantity = Quantity.read(context, function, component, variable)
        if quantity.variable is None:
            raise variable.fail("a variable is expected")
        ranges = read_box(box, len(quantity.formula.variables))
        if ranges[quantity.variable][0] == ranges[quantity.variable][1]:
            raise box.fail("a point in the variable")
        return cls(quantity, ranges, read_sign(sign))

    def holds(self, values: Range) -> bool:
        """Whether it follows where the derivative lies in these bounds."""
        return _has_sign(values, self.sign)

    def fails(self, values: Range) -> bool:
        """Whether it is false if at one point the derivative lies in these bounds: strictly."""
        return _has_sign(values, -self.sign)

    @property
    def sentence(self) -> str:
        """Return the statement."""
        way = "increasing" if self.sign > 0 else "decreasing"
        name = self.quantity.component_name
        return f"{self.where}: {name} is strictly {way} in {self.quantity.variable_name}"


@dataclass(frozen=True)
class Within(Inequality):
    """The quantity lies in closed bounds on the box."""

    bounds: Range

    @classmethod
    def read(cls, context: Context, reader: Reader) -> Within:
        """Read {function, component, variable or null, box, bounds}."""
        function, component, variable, box, bounds = reader.fields(
            "function", "component", "variable", "box", "bounds"
        )
        quantity = Quantity.read(context, function, component, variable)
        return cls(quantity, read_box(box, len(quantity.formula.variables)), bounds.range())

    def holds(self, values: Range) -> bool:
        """Whether it follows where the quantity lies in these bounds."""
        return self.bounds[0] <= values[0] and values[1] <= self.bounds[1]

    def fails(self, values: Range) -> bool:
        """Whether it is false if at one point the quantity lies in these bounds."""
        return values[1] < self.bounds[0] or values[0] > self.bounds[1]

    @property
    def sentence(self) -> str:
        """Return the statement."""
        return f"{self.where}: {self.quantity.name} lies in {show_range(self.bounds)}"


@dataclass(frozen=True)
class Expands(Inequality):
    """|F'| >= bound > 1 on an interval."""

    bound: Fraction

    @classmethod
    def read(cls, context: Context, reader: Reader) -> Expands:
        """Read {function of one variable and one value, interval, bound > 1}."""
        function, interval, bound_of = reader.fields("function", "interval", "bound")
        formula, bound = context.formula(function), bound_of.number()
        if len(formula.variables) != 1 or len(formula.roots) != 1:
            raise function.fail("a function of one variable with one value is expected")
        if bound <= 1:
            raise bound_of.fail("a bound above 1 is expected")
        return cls(Quantity(formula, 0, 0), (interval.range(),), bound)

    def holds(self, values: Range) -> bool:
        """Whether it follows where the derivative lies in these bounds."""
        return values[0] >= self.bound or values[1] <= -self.bound

    def fails(self, values: Range) -> bool:
        """Whether it is false if at one point the derivative lies in these bounds."""
        return -self.bound < values[0] and values[1] < self.bound

    @property
    def sentence(self) -> str:
        """Return the statement."""
        return f"{self.where}: |{self.quantity.name}| >= {show(self.bound)}"


@dataclass(frozen=True)
class NoZero(Conclusion):
    """F has no zero in the box."""

    formula: Formula
    box: Box

    @property
    def sentence(self) -> str:
        """Return the statement."""
        return f"{where(self.formula, self.box)}: {self.formula.name} has no zero"


@dataclass(frozen=True)
class Refuted(Conclusion):
    """The statement is false, because of the quantity's value at one point."""

    statement: Inequality
    point: tuple[Fraction, ...]

    @property
    def sentence(self) -> str:
        """Return the negation."""
        variables = self.statement.quantity.formula.variables
        point = box_text(point_box(self.point), variables)
        return f"it is false that {self.statement.sentence}; a witness is {point}"


def read_sign(reader: Reader) -> int:
    """Read "+" or "-"."""
    if reader.string() not in SIGNS:
        raise reader.fail('"+" or "-" is expected')
    return SIGNS[reader.string()]


def excludes_zero(value: Enclosure) -> bool:
    """Whether an enclosure has one strict sign."""
    return value.lo > 0 or value.hi < 0


def _proved(context: Context, reader: Reader, kind: type[S]) -> S:
    """Read {claim, tree}; return the claim, proved on each leaf of the tree."""
    claim, tree = reader.fields("claim", "tree")
    statement = kind.read(context, claim)
    map_ = statement.quantity.map()
    for leaf in leaves(tree, statement.box):
        decide(map_, leaf, lambda values: statement.holds(values[-1].range))
    return statement


def sign(context: Context, reader: Reader) -> Sign:
    """Rule `sign`: {claim: {function, component, box, sign}, tree}.

    Hypothesis: on each leaf of the tree an enclosure of F_i excludes 0 and the other sign.
    Conclusion: F_i has that strict sign on the box, because the leaves cover it.
    """
    return _proved(context, reader, Sign)


def monotone(context: Context, reader: Reader) -> Monotone:
    """Rule `monotone`: {claim: {function, component, variable, box, sign}, tree}.

    Hypothesis: on each leaf an enclosure of the partial derivative has that strict sign.
    Conclusion: F_i is strictly monotone along every segment of the box in that direction, by the
    mean value theorem: it is differentiable on the whole segment.
    """
    return _proved(context, reader, Monotone)


def range_(context: Context, reader: Reader) -> Within:
    """Rule `range`: {claim: {function, component, variable, box, bounds}, tree}.

    Hypothesis: on each leaf an enclosure of F_i (variable null), or of its partial derivative,
    lies within the bounds. Conclusion: so does the quantity on the box.
    """
    return _proved(context, reader, Within)


def expansion(context: Context, reader: Reader) -> Expands:
    """Rule `expansion`: {claim: {function, interval, bound}, tree}.

    Hypothesis: on each leaf an enclosure of F' is >= bound, or <= -bound. Conclusion: |F'| >= bound
    on the interval, with one sign since F' is continuous.
    """
    return _proved(context, reader, Expands)


def no_zero(context: Context, reader: Reader) -> NoZero:
    """Rule `no-zero`: {function, box, tree}.

    Hypothesis: on each leaf an enclosure of some component excludes 0. Conclusion: F = 0 has no
    solution in the box.
    """
    function, box_of, tree = reader.fields("function", "box", "tree")
    formula = context.formula(function)
    box = read_box(box_of, len(formula.variables))
    for leaf in leaves(tree, box):
        decide(context.map_of(formula), leaf, lambda values: any(map(excludes_zero, values)))
    return NoZero(formula, box)


STATEMENTS: dict[str, type[Sign | Monotone | Within | Expands]] = {
    "sign": Sign,
    "monotone": Monotone,
    "range": Within,
    "expansion": Expands,
}


def refute_at(context: Context, reader: Reader) -> Refuted:
    """Rule `refute-at`: {rule, claim, point}: the claim of a step by that rule, and a point.

    Hypotheses: the point lies in the box; there the quantity, evaluated exactly if it is rational
    and enclosed otherwise, contradicts the claim: for `sign` the opposite sign or 0, for `range`
    and `expansion` a value outside, for `monotone` a derivative of the opposite strict sign (then
    F_i is not monotone as claimed beside the point). Conclusion: the claim is false.
    """
    rule, claim, point_of = reader.fields("rule", "claim", "point")
    if rule.string() not in STATEMENTS:
        raise rule.fail(f"not one of {', '.join(STATEMENTS)}")
    statement = STATEMENTS[rule.string()].read(context, claim)
    point = read_point(point_of, len(statement.box))
    inside = zip(point, statement.box, strict=True)
    if not all(low <= value <= high for value, (low, high) in inside):
        raise point_of.fail("the point is not in the box")
    if not any(statement.fails(values) for values in _at(context, statement.quantity, point)):
        raise Unproved("the claim is not proved false at the point")
    return Refuted(statement, point)


def _at(context: Context, quantity: Quantity, point: tuple[Fraction, ...]) -> list[Range]:
    """Return bounds on a quantity at a point: the exact value, or better and better enclosures."""
    map_ = quantity.map()
    METER.get().spend(20 * map_.tape.cost(map_.roots))
    try:
        value = map_.tape.evaluate(map_.roots, Exact(), point)[-1]
    except Unproved:
        return [values[-1].range for values in attempts(map_, point_box(point))]
    return [(value, value)]
