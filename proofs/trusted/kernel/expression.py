"""Expressions on a tape: each operation once, evaluated on numbers of any kind, differentiated.

An expression is defined at a point where no division by 0, root of a negative number or logarithm
of a number <= 0 occurs in it, also in parts that cancel. It is continuous where it is defined, and
differentiable where its derivative (as computed here) is defined too.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import NamedTuple, Protocol, TypeVar

from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.meter import METER

FUNCTIONS = ("sqrt", "exp", "log", "sin", "cos", "atan")
_MAX_TAPE = 20_000
_NODE = 25  # work, for the room that one takes

T = TypeVar("T")


class Numbers(Protocol[T]):
    """Numbers of one kind: how to apply the operations of expressions to them."""

    def apply(self, op: str, arguments: list[T], datum: Fraction) -> T:
        """Return op(arguments); datum is the number of "number", the exponent of "^"."""


class Node(NamedTuple):
    """An operation on earlier nodes; datum is a number, a variable's place, or an exponent."""

    op: str
    arguments: tuple[int, ...] = ()
    datum: Fraction = Fraction(0)


class Step(NamedTuple):
    """A node to be evaluated: its place, its operation, its first and its last argument."""

    place: int
    op: str
    first: int
    last: int
    node: Node


Steps = Sequence[Step]


@dataclass
class Tape:
    """Nodes in the order of evaluation; equal nodes are stored once."""

    nodes: list[Node] = field(default_factory=list)
    _places: dict[Node, int] = field(default_factory=dict)
    _orders: dict[tuple[int, ...], list[int]] = field(default_factory=dict)
    _derivatives: dict[tuple[int, int], int] = field(default_factory=dict)
    _divided: dict[tuple[tuple[int, ...], int], tuple[Steps, Steps]] = field(default_factory=dict)

    def add(self, op: str, *arguments: int, datum: Fraction = Fraction(0)) -> int:
        """Return the place of a node, a new one where there is none like it."""
        node = Node(op, arguments, datum)
        place = self._places.setdefault(node, len(self.nodes))
        if place == len(self.nodes):
            if place >= _MAX_TAPE:
                raise Unproved("derivatives of a formula with too many operations")
            METER.get().spend(_NODE)
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
            METER.get().spend(len(needed))
            self._orders[roots] = sorted(needed)
        return self._orders[roots]

    def divided(self, roots: tuple[int, ...], variable: int) -> tuple[Steps, Steps]:
        """Return the nodes that roots need: those that do not change with a variable, the others.

        Each in the order of evaluation.
        """
        if (roots, variable) not in self._divided:
            changing, still, moving = set[int](), list[Step](), list[Step]()
            for place in self.order(roots):
                node = self.nodes[place]
                own = node.op == "variable" and node.datum == variable
                if own or not changing.isdisjoint(node.arguments):
                    changing.add(place)
                ends = (*node.arguments[:1], *node.arguments[-1:], 0, 0)
                step = Step(place, node.op, ends[0], ends[1], node)
                (moving if place in changing else still).append(step)
            self._divided[roots, variable] = still, moving
        return self._divided[roots, variable]

    def evaluate(self, roots: tuple[int, ...], numbers: Numbers[T], inputs: Sequence[T]) -> list[T]:
        """Return the roots' values at the inputs; every node that they need is evaluated."""
        values: dict[int, T] = {}
        order = self.order(roots)
        METER.get().spend(2 * len(order))
        for place in order:
            op, arguments, datum = self.nodes[place]
            if op == "variable":
                values[place] = inputs[int(datum)]
            else:
                values[place] = numbers.apply(op, [values[i] for i in arguments], datum)
        return [values[root] for root in roots]

    def moved(self, roots: Sequence[int], places: dict[int, int]) -> list[int]:
        """Return the roots with other expressions at some places, all at once."""
        moved = dict(places)
        order = self.order(tuple(roots))
        METER.get().spend(2 * len(order))
        for place in order:
            op, arguments, datum = self.nodes[place]
            if place not in moved:
                moved[place] = self.add(op, *(moved[i] for i in arguments), datum=datum)
        return [moved[root] for root in roots]

    def may_fail(self, root: int) -> bool:
        """Whether an expression may be undefined somewhere."""
        nodes = [self.nodes[place] for place in self.order((root,))]
        return any(op in ("/", "sqrt", "log") or (op == "^" and n < 0) for op, _, n in nodes)

    def derivative(self, root: int, variable: int) -> int:
        """Return the place of the partial derivative, by the rules of calculus, node by node.

        A product with a derivative that is the number 0 is left out, which is right where the other
        factor is defined: so a derivative is used only together with the root itself. No derivative
        is left out, not even 0 times that of a root, which has none where its argument is 0.
        """
        if (root, variable) not in self._derivatives:
            tangents: dict[int, int] = {}
            order = self.order((root,))
            METER.get().spend(10 * len(order))
            for place in order:
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
                result = self.sum(*slopes)
            case "-":
                result = self.sum(slopes[0], self._negative(slopes[1]))
            case "negative":
                result = self._negative(slopes[0])
            case "*":
                a, b = arguments
                result = self.sum(self.product(slopes[0], b), self.product(slopes[1], a))
            case "/":  # (a / b)' = (a' - (a / b) b') / b
                fall = self._negative(self.product(slopes[1], place))
                result = self.add("/", self.sum(slopes[0], fall), arguments[1])
            case _:
                result = self.product(slopes[0], self._rate(op, place, arguments[0], datum))
        return result

    def _rate(self, op: str, place: int, a: int, n: Fraction) -> int:
        """Return the place of the derivative of a^n or of a function of a, which is at `place`."""
        match op:
            case "^":
                lower = self.number(1) if n == 1 else self.add("^", a, datum=n - 1)
                rate = self.product(self.number(n), lower)
            case "sqrt":
                rate = self.add("/", self.number(Fraction(1, 2)), place)
            case "exp":
                rate = place
            case "log":
                rate = self.add("/", self.number(1), a)
            case "sin":
                rate = self.add("cos", a)
            case "cos":
                rate = self.add("negative", self.add("sin", a))
            case _:  # atan
                square = self.add("^", a, datum=Fraction(2))
                rate = self.add("/", self.number(1), self.add("+", self.number(1), square))
        return rate

    def _is(self, place: int, value: int) -> bool:
        node = self.nodes[place]
        return node.op == "number" and node.datum == value

    def _negative(self, a: int) -> int:
        return a if self._is(a, 0) else self.add("negative", a)

    def sum(self, a: int, b: int) -> int:
        """Return the place of a + b; b where a is the number 0, and so on."""
        if self._is(a, 0):
            return b
        return a if self._is(b, 0) else self.add("+", a, b)

    def product(self, slope: int, factor: int) -> int:
        """Return the place of a product; 0 where the slope is the number 0 (see `derivative`)."""
        if self._is(slope, 0) or self._is(factor, 1):
            return slope
        return factor if self._is(slope, 1) else self.add("*", slope, factor)
