"""Formulas on intervals: values and derivatives on boxes, and subdivisions on which they decide."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import intervals
from intervals import Interval, IntervalError, Undecided
from intervals.cover import halves
from proofs.trusted.kernel.covers import Rows
from proofs.trusted.kernel.enclose import Box, centre_of, point_box
from proofs.trusted.kernel.formulas import Formulas
from proofs.trusted.kernel.operations import ARITHMETIC

_MOST_BOXES = 10_000
_DEEPEST = 40
Values = list[Interval]
Matrix = list[Values]
Tree = list[Any] | None


@dataclass(frozen=True)
class Intervals:
    """The operations of formulas on intervals of one precision."""

    precision: int = 53

    def apply(self, op: str, arguments: list[Interval], datum: Fraction) -> Interval:
        """Enclose op(arguments)."""
        if op == "number":
            return Interval(datum, precision=self.precision)
        if op == "pi":
            return Interval.pi(precision=self.precision)
        if op == "^":
            return arguments[0] ** int(datum)
        function = ARITHMETIC.get(op) or getattr(intervals, op)
        result: Interval = function(*arguments)
        return result


def values(formula: Formulas, x: Values, roots: tuple[int, ...] | None = None) -> Values:
    """Enclose a function's components, or other roots on its tape."""
    return formula.tape.evaluate(roots or formula.roots, Intervals(x[0].precision), x)


def jacobian(formula: Formulas, x: Values, roots: tuple[int, ...] | None = None) -> Matrix:
    """Enclose the partial derivatives of the components, or of other roots."""
    n = len(formula.variables)
    rows = [[formula.tape.derivative(r, v) for v in range(n)] for r in roots or formula.roots]
    return [values(formula, x, tuple(row)) for row in rows]


def dot(row: Sequence[Any], column: Sequence[Any]) -> Any:
    """Return the sum of the products."""
    return sum((a * b for a, b in zip(row, column, strict=True)), 0)


def enclosed(formula: Formulas, box: Box) -> Values:
    """Enclose the components on a box by the natural and the mean value form."""
    x = [Interval(*side) for side in box]
    centre = [Interval(*side) for side in point_box(centre_of(box))]
    steps, result = [a - m for a, m in zip(x, centre, strict=True)], []
    parts = (values(formula, x), values(formula, centre), jacobian(formula, x))
    for natural, value, row in zip(*parts, strict=True):
        common = natural.intersection(dot(row, steps) + value)
        if common is None:
            raise Undecided("two enclosures of the same values are disjoint")
        result.append(common)
    return result


def inverse(matrix: Rows) -> Rows:
    """Return the exact inverse (Gauss and Jordan), or raise Undecided."""
    n = len(matrix)
    rows = [[*row, *(Fraction(int(i == j)) for j in range(n))] for i, row in enumerate(matrix)]
    for k in range(n):
        pivot = next((i for i in range(k, n) if rows[i][k]), None)
        if pivot is None:
            raise Undecided("a singular matrix")
        rows[k], rows[pivot] = rows[pivot], rows[k]
        rows[k] = [entry / rows[k][k] for entry in rows[k]]
        for i in range(n):
            if i != k and (factor := rows[i][k]):
                rows[i] = [a - factor * b for a, b in zip(rows[i], rows[k], strict=True)]
    return tuple(tuple(row[n:]) for row in rows)


def subdivide(
    box: Box, decided: Callable[[Box], bool], scale: Box | None = None, most: int = _MOST_BOXES
) -> Tree:
    """Return a tree whose leaves are all decided: undecided boxes are halved, longest side first.

    Sides are compared as parts of those of `scale`, the box itself where none is given. Raises
    Undecided if that does not end.
    """
    left = [most]

    def divide(part: Box, depth: int) -> Tree:
        left[0] -= 1
        if left[0] < 0 or depth > _DEEPEST:
            raise Undecided(f"{most} boxes, divided {_DEEPEST} times, do not suffice")
        try:
            if decided(part):
                return None
        except IntervalError:
            pass
        axis, *sides = halved(part, scale or box)
        cut = sides[0][axis][1]
        return [str(axis + 1), str(cut), *(divide(side, depth + 1) for side in sides)]

    return divide(box, 0)


def halved(box: Box, scale: Box) -> tuple[int, Box, Box]:
    """Return the place of the side that is longest as a part of a scale's, and both halves of it.

    Undecided where the box is a point.
    """
    lengths = shares(box, scale)
    axis = lengths.index(max(lengths))
    if not lengths[axis]:
        raise Undecided("not decided at a point")
    lower, upper = ((*box[:axis], half, *box[axis + 1 :]) for half in halves(box[axis]))
    return axis, lower, upper


def shares(box: Box, scale: Box) -> list[Fraction]:
    """Return the sides of a box as parts of those of a scale, where these are no points."""
    return [(b - a) / (d - c or 1) for (a, b), (c, d) in zip(box, scale, strict=True)]
