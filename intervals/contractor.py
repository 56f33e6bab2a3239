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
from math import inf, nextafter
from typing import Any, TypeAlias

import numpy as np

from intervals.array import IntervalArray, Mask
from intervals.branch import Boxes, Given, as_box, one_box
from intervals.errors import DomainError
from intervals.exact import Exact
from intervals.formula import Formula, Step
from intervals.functions import DOMAINS, TABLE, Domain
from intervals.interval import Interval
from intervals.reverse import REVERSE
from intervals.systems import Function

_SWEEPS = 2

Contracted: TypeAlias = "tuple[Interval, ...] | None"
Values: TypeAlias = list[IntervalArray]


def contract(f: Function, box: Given, targets: Sequence[Exact | Interval]) -> Contracted:
    """Return the part of a box that holds every x in it with f_i(x) in the i-th target, for all i.

    None: there is no such x. The box is an Interval, or n, with endpoints in binary64. TypeError
    if f is no formula of the functions of `intervals`.
    """
    given = one_box(box)
    formula = Formula(f, len(given))
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
        left, outside = _forward(formula, boxes)
        empty |= outside
        for output, target in zip(formula.outputs, targets, strict=True):
            empty |= _cut(left, output, target)
        for place in range(len(formula.steps) - 1, formula.variables - 1, -1):
            empty |= _backward(formula, left, place)
        smaller = tuple(left[: formula.variables])
        gained = any((4 * y.wid < 3 * x.wid).any() for x, y in zip(boxes, smaller, strict=True))
        boxes = smaller
        if not gained:
            break
    return boxes, empty


def _forward(formula: Formula, boxes: Boxes) -> tuple[Values, Mask]:
    """Return enclosures of the values of all steps where f is defined, and where it is nowhere.

    They are of one shape, but for constants. An argument is cut to the domain of its function.
    """
    values = list(boxes)
    outside: Mask = np.zeros(1, dtype=bool)
    for step in formula.steps[formula.variables :]:
        domain = _domain(step)
        if domain is None:
            operands = [values[i] for i in step.arguments]
            values.append(_FORWARD.get(step.operation, Step.applied)(step, *operands))
            continue
        place, *others = step.arguments
        inner, empty = _within(values[place], domain, closed=domain.closed)
        result = step.applied(inner, *(values[i] for i in others))
        if not domain.closed:  # where it was cut, f has no bound
            cut = inner._rows < values[place]._rows
            result = IntervalArray._of_rows(np.where(cut, inf, result._rows))
        values[place] = _within(values[place], domain, closed=True)[0]
        values.append(result)
        outside = outside | empty
    return values, outside


def _domain(step: Step) -> Domain | None:
    """Return the domain of the first argument where it is not the line."""
    if step.operation == "pow" or (step.operation == "rootn" and step.details[0] % 2 == 0):
        return TABLE["sqrt"].domain
    return DOMAINS.get(step.operation)


def _within(u: IntervalArray, domain: Domain, *, closed: bool) -> tuple[IntervalArray, Mask]:
    """Return the part of U in the domain, or in its floats but the ends, and where there is none.

    There it is a point of the domain.
    """
    low = -inf if domain.low is None else float(domain.low)
    high = inf if domain.high is None else float(domain.high)
    if not closed:
        low, high = nextafter(low, inf), nextafter(high, -inf)
    rows = np.stack((np.minimum(u._rows[0], -low), np.minimum(u._rows[1], high)))
    empty: Mask = np.asarray(rows[1] < -rows[0])
    if empty.any():
        point = min(max(0.0, low), high)
        rows = np.stack((np.where(empty, -point, rows[0]), np.where(empty, point, rows[1])))
    return IntervalArray._of_rows(rows), empty


def _constant(step: Step) -> IntervalArray:
    value = step.details[0]
    return value if isinstance(value, IntervalArray) else IntervalArray([value])


def _exp(_: Step, u: IntervalArray) -> IntervalArray:
    """Return enclosures of exp u, down to 0 where u < -650: there the kernels are slow."""
    low = u.inf < -650.0
    if not low.any():
        return u.exp()
    rows = u.maximum(-650).exp()._rows
    return IntervalArray._of_rows(np.stack((np.where(low, 0.0, rows[0]), rows[1])))


_FORWARD: dict[str, Any] = {"exp": _exp, "constant": _constant}


def _cut(left: Values, place: int, part: IntervalArray) -> Mask:
    """Cut what is left of a step; return where nothing is, and it stays as it was."""
    value = left[place]._rows
    rows = np.minimum(value, part._rows)
    empty: Mask = np.asarray(rows[1] < -rows[0])
    if empty.any():
        rows = np.where(empty, value, rows)
    left[place] = IntervalArray._of_rows(rows)
    return empty


def _backward(formula: Formula, left: Values, place: int) -> Mask:
    """Cut what is left of the arguments; a reverse operation without enclosure cuts nothing."""
    empty: Mask = np.zeros(1, dtype=bool)
    operation, arguments, details = formula.steps[place]
    for argument, rule in zip(arguments, REVERSE.get(operation, ()), strict=False):
        if formula.steps[argument].operation != "constant":
            with suppress(DomainError, OverflowError):
                part = rule(left[place], *(left[u] for u in arguments), *details)
                empty = empty | _cut(left, argument, part)
    return empty
