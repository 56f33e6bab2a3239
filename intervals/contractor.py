"""The forward-backward contractor (HC4): smaller boxes with the same solutions of f_i(x) in Y_i.

f is recorded once, as a graph of operations. Forward, each node gets the enclosure of its values
over the box; backward, from the outputs to the variables, each node hands the part of its values
that is left on to its arguments, through the reverse operation.

Theorem. If x is in the box X, f is defined at x and f(x) in Y, then x is in the contracted box;
where a box is called empty there is no such x. Proof: the value of each node at x is in the node's
enclosure; it stays there, since the value z = g(u, v) at x is in Z, u in U, v in V, and `REVERSE`
gives supersets of {u in U: g(u, v) in Z for some v in V}, and of the same for v.

Source: Benhamou, Goualard, Granvilliers, Puget 1999, Revising hull and box consistency.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from fractions import Fraction
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from intervals.array import IntervalArray, Mask
from intervals.branch import Boxes, Given, as_box, one_box
from intervals.errors import DomainError
from intervals.exact import Exact
from intervals.functions import Elementary
from intervals.interval import Interval
from intervals.numpy_protocol import jet_ufunc
from intervals.reverse import REVERSE
from intervals.systems import Function, components

_SWEEPS = 2


class Node(Elementary):
    """An operation, a method of IntervalArray, on earlier nodes; a variable, or a constant."""

    __slots__ = ("arguments", "details", "operation")

    def __init__(self, operation: str, *arguments: Any, details: tuple[Any, ...] = ()) -> None:
        self.operation = operation
        self.arguments = [_node(u) for u in arguments]
        self.details = details

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **options: Any) -> Any:
        return jet_ufunc(self, ufunc, method, inputs, options)

    def __neg__(self) -> Node:
        return Node("__neg__", self)

    def __abs__(self) -> Node:
        return Node("__abs__", self)

    def __add__(self, other: Any) -> Node:
        return Node("__add__", self, other)

    def __radd__(self, other: Any) -> Node:
        return Node("__add__", other, self)

    def __sub__(self, other: Any) -> Node:
        return Node("__sub__", self, other)

    def __rsub__(self, other: Any) -> Node:
        return Node("__sub__", other, self)

    def __mul__(self, other: Any) -> Node:
        return self.sqr() if other is self else Node("__mul__", self, other)

    def __rmul__(self, other: Any) -> Node:
        return Node("__mul__", other, self)

    def __truediv__(self, other: Any) -> Node:
        return Node("__truediv__", self, other)

    def __rtruediv__(self, other: Any) -> Node:
        return Node("__truediv__", other, self)

    def __pow__(self, exponent: Any) -> Node:
        if not isinstance(exponent, int):
            return self.pow(exponent)
        if exponent < 0:
            return 1 / self**-exponent
        return Node("__pow__", self, details=(exponent,)) if exponent else _node(1)

    def __rpow__(self, base: Any) -> Node:
        return _node(base).pow(self)

    def _monotone(self, name: str) -> Node:
        return Node(name, self)

    def sin(self) -> Node:
        """Return the sine."""
        return Node("sin", self)

    def cos(self) -> Node:
        """Return the cosine."""
        return Node("cos", self)

    def tan(self) -> Node:
        """Return the tangent."""
        return Node("tan", self)

    def sqr(self) -> Node:
        """Return the square."""
        return self**2

    def recip(self) -> Node:
        """Return 1 / x."""
        return 1 / self

    def sincos(self) -> tuple[Node, Node]:
        """Return both."""
        return self.sin(), self.cos()

    def rootn(self, n: int) -> Node:
        """Return the real n-th root."""
        return Node("rootn", self, details=(n,))

    def pow(self, exponent: Any) -> Node:
        """Return the real power; one that is not constant is (exp of) a product."""
        if isinstance(exponent, int | Fraction) and exponent:
            return Node("pow", self, details=(Fraction(exponent),))
        return Node("exp", self.log() * exponent)

    def hypot(self, other: Any) -> Node:
        """Return sqrt(x^2 + y^2)."""
        return (self**2 + _node(other) ** 2).sqrt()

    def atan2(self, x: Any) -> Node:
        """Return the angle, which is not undone."""
        return Node("atan2", self, x)

    def minimum(self, other: Any) -> Node:
        """Return the smaller, which is not undone."""
        return Node("minimum", self, other)

    def maximum(self, other: Any) -> Node:
        """Return the larger, which is not undone."""
        return Node("maximum", self, other)


def _node(value: Any) -> Node:
    """Return a node; an exact number as a constant."""
    return value if isinstance(value, Node) else Node("constant", details=(IntervalArray([value]),))


Contracted: TypeAlias = "tuple[Interval, ...] | None"
Values: TypeAlias = dict[Node, IntervalArray]


class Formula(NamedTuple):
    """The nodes in an order in which arguments come first, the variables, the outputs."""

    nodes: list[Node]
    variables: list[Node]
    outputs: list[Node]


def record(f: Function, count: int) -> Formula | None:
    """Return f of so many variables as a graph, None if f does what no graph can hold."""
    variables = [Node("variable") for _ in range(count)]
    with suppress(TypeError, AttributeError, ValueError, NotImplementedError):
        outputs = [_node(y) for y in components(f(*variables))]
        return Formula(_sorted(outputs), variables, outputs)
    return None


def _sorted(outputs: Sequence[Node]) -> list[Node]:
    """Return the nodes under the outputs, arguments first; without recursion, as it may be deep."""
    order: dict[Node, None] = {}
    waiting = [(node, False) for node in outputs]
    while waiting:
        node, ready = waiting.pop()
        if ready:
            order.setdefault(node)
        elif node not in order:
            waiting += [(node, True), *((u, False) for u in node.arguments)]
    return list(order)


def contract(f: Function, box: Given, targets: Sequence[Exact | Interval]) -> Contracted:
    """Return the part of a box that holds every x in it with f_i(x) in the i-th target, for all i.

    None: there is no such x. The box is an Interval, or n, with endpoints in binary64. TypeError
    if f is no formula of the functions of `intervals`.
    """
    given = one_box(box)
    formula = record(f, len(given))
    if formula is None:
        raise TypeError("f is no formula that can be undone")
    boxes, empty = contracted(formula, given, [IntervalArray([t]) for t in targets])
    return None if empty.any() else as_box(boxes, 0)


def contracted(
    formula: Formula, boxes: Boxes, targets: Sequence[IntervalArray], *, sweeps: int = _SWEEPS
) -> tuple[Boxes, Mask]:
    """Return the same for N boxes: their parts, and where there is none, so that they mean nothing.

    DomainError or OverflowError where f has no enclosure over a box.
    """
    empty: Mask = np.zeros(len(boxes[0]), dtype=bool)
    for _ in range(sweeps):
        left = _forward(formula, boxes)
        for output, target in zip(formula.outputs, targets, strict=True):
            empty |= _cut(left, output, target)
        for node in reversed(formula.nodes):
            empty |= _backward(left, node)
        smaller = tuple(left[v] for v in formula.variables)
        gained = any((4 * y.wid < 3 * x.wid).any() for x, y in zip(boxes, smaller, strict=True))
        boxes = smaller
        if not gained:
            break
    return boxes, empty


def _forward(formula: Formula, boxes: Boxes) -> Values:
    """Return enclosures of the values of all nodes; of one shape, but for constants."""
    values = dict(zip(formula.variables, boxes, strict=True))
    for node in formula.nodes:
        if node.operation == "constant":
            values[node] = node.details[0]
        elif node.operation != "variable":
            operation = _FORWARD.get(node.operation) or getattr(IntervalArray, node.operation)
            values[node] = operation(*(values[u] for u in node.arguments), *node.details)
    return values


def _exp(u: IntervalArray) -> IntervalArray:
    """Return enclosures of exp u, down to 0 where u < -650: there the kernels are slow."""
    low = u.inf < -650.0
    if not low.any():
        return u.exp()
    rows = u.maximum(-650).exp()._rows
    return IntervalArray._of_rows(np.stack((np.where(low, 0.0, rows[0]), rows[1])))


_FORWARD = {"exp": _exp}


def _cut(left: Values, node: Node, part: IntervalArray) -> Mask:
    """Cut what is left of a node; return where nothing is, and it stays as it was."""
    value = left[node]._rows
    rows = np.minimum(value, part._rows)
    empty: Mask = np.asarray(rows[1] < -rows[0])
    if empty.any():
        rows = np.where(empty, value, rows)
    left[node] = IntervalArray._of_rows(rows)
    return empty


def _backward(left: Values, node: Node) -> Mask:
    """Cut what is left of the arguments; a reverse operation without enclosure cuts nothing."""
    empty: Mask = np.zeros(1, dtype=bool)
    for argument, rule in zip(node.arguments, REVERSE.get(node.operation, ()), strict=False):
        if argument.operation != "constant":
            with suppress(DomainError, OverflowError):
                part = rule(left[node], *(left[u] for u in node.arguments), *node.details)
                empty = empty | _cut(left, argument, part)
    return empty
