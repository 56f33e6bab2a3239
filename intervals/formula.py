"""Formulas: functions that are recorded once, as graphs, and evaluated over any number type.

A function of n real variables is called once, on n variables that know nothing but what is done to
them. What it returns is a graph of operations, and all that the solvers prove is about the real
function that the graph stands for. So a program that would take another way for other arguments
cannot have anything false proved: what asks a variable for a truth, an order or digits is refused,
and whatever else it does has been done, once, before a proof begins.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple, NoReturn

from intervals.analytic import Analytic
from intervals.errors import HINT
from intervals.exact import fraction, whole
from intervals.functions import Elementary
from intervals.numpy_protocol import jet_ufunc
from intervals.systems import Function, components

_OPERATORS: dict[str, Callable[..., Any]] = {
    "__neg__": operator.neg,
    "__abs__": operator.abs,
    "__add__": operator.add,
    "__sub__": operator.sub,
    "__mul__": operator.mul,
    "__truediv__": operator.truediv,
    "__pow__": operator.pow,
}
_SYMMETRIC = ("hypot", "minimum", "maximum")


class NoFormula(TypeError):
    """A function that uses other things than numbers have, such as the ends of an Interval."""


class Step(NamedTuple):
    """An operation on the values of earlier steps; details are what is no value, as exponents."""

    operation: str
    arguments: tuple[int, ...] = ()
    details: tuple[Any, ...] = ()

    def applied(self, *operands: Any) -> Any:
        """Return the value, of numbers of any type; an exact one may stand beside another."""
        if self.operation in _OPERATORS:
            return _OPERATORS[self.operation](*operands, *self.details)
        if self.operation == "constant":
            return self.details[0]
        if len(operands) == 2 and not hasattr(operands[0], self.operation):
            if self.operation in _SYMMETRIC:
                operands = operands[::-1]
            elif self.operation == "pow":
                return operator.pow(*operands)
            else:
                operands = 0 * operands[1] + operands[0], operands[1]
        return getattr(operands[0], self.operation)(*operands[1:], *self.details)


class _Tape:
    """The steps of a recording, and the first question that no graph answers, if one came."""

    def __init__(self) -> None:
        self.steps: list[Step] = []
        self.refused: str | None = None

    def node(self, operation: str, *arguments: Any, details: tuple[Any, ...] = ()) -> Node:
        places = tuple(map(self.place, arguments))
        self.steps.append(Step(operation, places, details))
        return Node(self, len(self.steps) - 1)

    def place(self, value: Any) -> int:
        node = (
            value if isinstance(value, Node) else self.node("constant", details=(_number(value),))
        )
        if node.tape is not self:
            self.refuse("the variable of another one")
        return node.index

    def refuse(self, question: str) -> NoReturn:
        self.refused = self.refused or f"a formula cannot be asked for {question}: {HINT}"
        raise TypeError(self.refused)


def _number(value: Any) -> Any:
    """Return a constant: an exact number, or intervals; a float raises TypeError, or any other."""
    if isinstance(value, Elementary | Analytic):
        return value
    number = whole(value)
    return fraction(value) if number is None else number


def _refusal(question: str) -> Callable[..., Any]:
    def method(self: Node, *_: Any) -> NoReturn:
        self.tape.refuse(question)

    return method


def _recorded(operation: str, *, swapped: bool = False) -> Callable[..., Any]:
    """Return the method that records an operation on numbers."""

    def method(self: Node, *others: Any) -> Any:
        operands = (*others, self) if swapped else (self, *others)
        return self.tape.node(operation, *operands)

    return method


_TRUTH, _ORDER = _refusal("the truth of =="), _refusal("an order (<, min, max, sorted)")
_DIGITS = _refusal("its digits (int, float, range, round, %, //, the functions of math)")


class Node(Elementary):
    """The value of a step of a recording, which does not answer what it cannot know."""

    __slots__ = ("index", "tape")

    def __init__(self, tape: _Tape, index: int) -> None:
        self.tape = tape
        self.index = index

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **options: Any) -> Any:
        try:
            return jet_ufunc(self, ufunc, method, inputs, options)
        except TypeError as error:
            self.tape.refuse(f"what numpy.{ufunc.__name__} asks ({error})")

    __eq__ = __ne__ = _TRUTH
    __lt__ = __le__ = __gt__ = __ge__ = _ORDER
    __bool__ = _refusal("its truth (if, while, and, or, not)")
    __hash__ = _refusal("its place (dictionaries, sets, caches)")
    __iter__ = __len__ = _refusal("its parts")
    __int__ = __float__ = __complex__ = __index__ = _DIGITS
    __round__ = __floor__ = __ceil__ = __trunc__ = _DIGITS
    __mod__ = __rmod__ = __floordiv__ = __rfloordiv__ = __divmod__ = __rdivmod__ = _DIGITS

    __neg__, __abs__ = _recorded("__neg__"), _recorded("__abs__")
    __add__, __radd__ = _recorded("__add__"), _recorded("__add__", swapped=True)
    __sub__, __rsub__ = _recorded("__sub__"), _recorded("__sub__", swapped=True)
    _product, __rmul__ = _recorded("__mul__"), _recorded("__mul__", swapped=True)
    __truediv__, __rtruediv__ = _recorded("__truediv__"), _recorded("__truediv__", swapped=True)
    pow, __rpow__ = _recorded("pow"), _recorded("pow", swapped=True)
    hypot, atan2 = _recorded("hypot"), _recorded("atan2")
    minimum, maximum, cosh = _recorded("minimum"), _recorded("maximum"), _recorded("cosh")

    def __pos__(self) -> Node:
        return self

    def __mul__(self, other: Any) -> Any:
        return self.sqr() if other is self else self._product(other)

    def __pow__(self, exponent: Any) -> Any:
        n = whole(exponent)
        if n is None:
            return self.pow(exponent)
        if n == 0:
            return 0 * self + 1
        return self.tape.node("__pow__", self, details=(n,))

    def _monotone(self, name: str) -> Node:
        return self.tape.node(name, self)

    def sincos(self) -> tuple[Node, Node]:
        """Return both."""
        return self.sin(), self.cos()

    def sqr(self) -> Node:
        """Return the square."""
        return self.tape.node("__pow__", self, details=(2,))

    def recip(self) -> Any:
        """Return 1 / x."""
        return 1 / self

    def fma(self, factor: Any, term: Any) -> Any:
        """Return x y + z."""
        return self * factor + term

    def rootn(self, n: int) -> Node:
        """Return the real n-th root."""
        if n < 1:
            raise ValueError("a root has a degree of at least 1")
        return self.tape.node("rootn", self, details=(n,))


class Formula:
    """f(x_1, ..., x_n), recorded: Formula(f, n). Of n numbers of any type it returns a list.

    Theorem. Over Intervals, IntervalArrays, jets, Decorated sets and boxes of the plane the values
    enclose, as these types promise, those of the function that the recorded graph stands for.
    steps: arguments come first, and before all the variables; outputs: the steps that are returned.
    TypeError, with a hint, where f asks a variable for what no set of numbers has.
    """

    steps: list[Step]
    outputs: list[int]

    def __init__(self, f: Function, variables: int) -> None:
        self.variables = variables
        if isinstance(f, Formula):
            self.steps, self.outputs = f.steps, f.outputs
            if f.variables != variables:
                raise TypeError(
                    f"a formula of {f.variables} variables, where {variables} are given"
                )
            return
        tape = _Tape()
        nodes = [tape.node("variable") for _ in range(variables)]
        try:
            outputs = [tape.place(y) for y in components(f(*nodes))]
        except (TypeError, AttributeError, NotImplementedError) as error:
            if tape.refused:
                raise TypeError(tape.refused) from error
            raise NoFormula(f"no formula of the functions here: {error}") from error
        if tape.refused:  # and f went on
            raise TypeError(tape.refused)
        self.steps, self.outputs = _needed(tape.steps, outputs, variables)

    def values(self, x: Sequence[Any]) -> list[Any]:
        """Return the values of all steps."""
        if len(x) != self.variables:
            raise TypeError(f"{len(x)} numbers for a formula of {self.variables} variables")
        values = list(x)
        for step in self.steps[self.variables :]:
            values.append(step.applied(*[values[i] for i in step.arguments]))
        return values

    def only(self, *x: Any) -> Any:
        """Return the value of a formula that has one; else ValueError."""
        (value,) = self(*x)
        return value

    def __call__(self, *x: Any) -> list[Any]:
        """Return the values, also of a constant as numbers of the type of x."""
        values = self.values(x)
        return [
            0 * x[0] + values[i] if self.steps[i].operation == "constant" else values[i]
            for i in self.outputs
        ]


def _needed(steps: list[Step], outputs: list[int], variables: int) -> tuple[list[Step], list[int]]:
    """Return the steps that the outputs depend on, and the variables, in their order."""
    needed = set(outputs) | set(range(variables))
    for index in range(len(steps) - 1, -1, -1):
        if index in needed:
            needed.update(steps[index].arguments)
    places = {index: place for place, index in enumerate(sorted(needed))}
    kept = [
        steps[i]._replace(arguments=tuple(places[j] for j in steps[i].arguments)) for i in places
    ]
    return kept, [places[i] for i in outputs]
