"""n equations in n variables: values, Jacobian matrices, and products of matrices of intervals.

A box is a sequence of n Intervals, or of n IntervalArrays of one shape (N,), which are N boxes; a
matrix is a list of rows of these. A function f(x_1, ..., x_n) is a formula that returns n numbers
(or one, not in a list) for intervals and for jets.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from enum import Enum
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from intervals.array import IntervalArray
from intervals.generic import middle
from intervals.interval import Interval
from intervals.jet import Jet

Function: TypeAlias = Callable[..., Any]
Box: TypeAlias = Sequence[Any]
Matrix: TypeAlias = list[list[Any]]


class Roots(Enum):
    """What is proved about the zeros of f in the given box."""

    UNIQUE = "exactly one zero"
    NONE = "no zero"
    AT_LEAST_ONE = "at least one zero"
    UNDECIDED = "not decided"


def components(value: Any) -> list[Any]:
    """Return the values of f as a list; numpy's arrays of objects are lists, too."""
    if isinstance(value, np.ndarray):
        return list(value.reshape(-1))
    return list(value) if isinstance(value, list | tuple) else [value]


def jacobian(f: Function, box: Box) -> tuple[list[Any], Matrix]:
    """Enclose f_i and J_ij = d f_i / d x_j over a box, by jets of order 1.

    Of arrays one evaluation has all derivatives, along a first axis; of Intervals each has its own.
    """
    if isinstance(box[0], IntervalArray):
        return _all_at_once(f, box)
    columns = []
    for j in range(len(box)):
        jets = (Jet(x, 0 * x + int(i == j)) for i, x in enumerate(box))
        columns.append(components(f(*jets)))
    values = [jet.value for jet in columns[0]]
    return values, [[jet.derivative() for jet in row] for row in zip(*columns, strict=True)]


def _all_at_once(f: Function, box: Box) -> tuple[list[Any], Matrix]:
    directions = np.eye(len(box)).reshape(len(box), len(box), *(1 for _ in box[0].shape))
    zero = np.zeros((1, *box[0].shape))
    jets = (
        Jet(x, IntervalArray.from_floats(row + zero))
        for x, row in zip(box, directions, strict=True)
    )
    found = components(f(*jets))
    return [jet.value for jet in found], [list(jet.derivative()) for jet in found]


def approximate_inverse(matrix: Matrix) -> Matrix:
    """Return points that invert the midpoints of a matrix, or do not: nothing depends on it."""
    middles = np.array([[np.asarray(x.mid, dtype=np.float64) for x in row] for row in matrix])
    stack = np.moveaxis(middles, (0, 1), (-2, -1))
    entries = np.moveaxis(inverses(stack), (-2, -1), (0, 1))
    like = matrix[0][0]
    if isinstance(like, Interval):
        return [[Interval.from_float(c, precision=like.precision) for c in row] for row in entries]
    return [[IntervalArray.from_floats(c) for c in row] for row in entries]


def inverses(matrices: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return about the inverses of a stack of matrices; some pseudo-inverse if one is singular."""
    with np.errstate(all="ignore"):
        try:
            found = np.linalg.inv(matrices)
        except np.linalg.LinAlgError:
            found = np.linalg.pinv(matrices)
    return np.where(np.abs(found) < 2.0**300, found, 0.0)  # not where it overflowed, nor NaN


def dot(row: Iterable[Any], column: Iterable[Any]) -> Any:
    """Return the sum of the products."""
    first, *others = (a * b for a, b in zip(row, column, strict=True))
    return sum(others, first)


def matrix_product(a: Matrix, b: Matrix) -> Matrix:
    """Return the product of two matrices."""
    if isinstance(a[0][0], IntervalArray):
        product = _stacked(a) @ _stacked(b)
        return [[product[..., i, j] for j in range(len(b[0]))] for i in range(len(a))]
    return [[dot(row, column) for column in zip(*b, strict=True)] for row in a]


def _stacked(matrix: Matrix) -> Any:
    """Return an array of matrices as one with the two axes of the matrix behind the others."""
    return np.stack([np.stack(row, -1) for row in matrix], -2)


def spread(row: list[Any], box: Box, i: int) -> Any:
    """Return the sum over j != i of row_j (X_j - m_j), m the midpoint; 0 if there is none."""
    terms = (a * (x - middle(x)) for a, x in zip(row, box, strict=True))
    return sum((term for j, term in enumerate(terms) if j != i), 0)
