"""Zeros of n equations in n variables: the Krawczyk and the interval Newton operator.

Let f be C^1 on a box X, m in X, J an interval matrix that contains f'(x) for x in X (found by
jets), C a real matrix, A = C J, and

    K_i = m_i - (C f(m))_i + sum over j of (I - A)_ij (X_j - m_j)
    N_i = m_i - ((C f(m))_i + sum over j != i of A_ij (X_j - m_j)) / A_ii

where N_i = X_i if A_ii contains 0. "Proper" means: for each i, a subset of X_i other than X_i.

Theorem. (1) Every zero of f in X is in K and in N. (2) If X and K, or X and N, are disjoint, there
is none. (3) If K is proper in X, or N is, there is exactly one.

Proof. For x, y in X, f(x) - f(y) = B (x - y), where B in J is the mean of f' on the segment. With
y = m and f(x) = 0, C B (x - m) = -C f(m): row by row this is (1), hence (2). In (3) let
w_i = wid X_i, which is > 0: a point has no proper subset but the empty one.
K proper: let R_ij be the magnitude of (I - A)_ij. A product of intervals is at least as wide as
one of them times any number of the other, so sum over j of R_ij w_j <= wid K_i < w_i. Thus
g(x) = x - C f(x) maps X into K, within X, and is a contraction in the norm max |x_i| / w_i: it
has exactly one fixed point in X. The norm of I - C B is below 1, so C is regular, and the fixed
points are the zeros of f.
N proper: likewise w_i > sum over j != i of |A_ij| w_j / min |A_ii|, so each matrix of A is
strictly diagonally dominant with weights w, hence regular, and so are C and each B: f is
injective on X. Let T(x) be N with the numbers x - m and C B, B the mean of f' on [m, x], in place
of X - m and A. T is continuous and maps X into N, within X: by Brouwer's theorem it has a fixed
point, and there C f = 0.

Source: Krawczyk 1969; Hansen and Sengupta 1981; Neumaier, Interval Methods for Systems of
Equations, 1990, chapter 5.

Zeros of n equations in n variables from signs on the faces of a box.

Theorem (Miranda 1940). Let f be continuous on a box X, C a regular matrix. If for each i
(C f)_i <= 0 on one of the two faces of X orthogonal to x_i and (C f)_i >= 0 on the other, f has a
zero in X. For n = 1 this is the intermediate value theorem.

If f is C^1, J contains f' over X and m is in X, (C f)_i on the face x_i = e lies in
(C f(m'))_i + sum over j != i of (C J)_ij (X_j - m_j), where m'_i = e and m'_j = m_j else: the
mean-value form on that face. It lies in the natural form as well.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple, TypeAlias, overload

import numpy as np
from numpy.typing import NDArray

from intervals.array import IntervalArray, Mask
from intervals.branch import all_of
from intervals.formula import Formula
from intervals.generic import ends, meet, middle, where
from intervals.interval import Interval
from intervals.systems import (
    Box,
    Function,
    Matrix,
    Roots,
    approximate_inverse,
    components,
    dot,
    jacobian,
    matrix_product,
    spread,
)


def signs_on_faces(f: Function, box: Box, jacobian: Matrix, inverse: Matrix) -> Mask:
    """Return where the theorem holds for C = I, or for C = inverse, proved to be regular."""
    n = len(box)
    identity = [[int(i == j) for j in range(n)] for i in range(n)]
    plain = _opposite(f, box, identity, jacobian)
    if plain.all():
        return plain
    product = matrix_product(inverse, jacobian)
    return plain | (_regular(inverse, jacobian) & _opposite(f, box, inverse, product))


def _opposite(f: Function, box: Box, factor: Matrix, product: Matrix) -> Mask:
    """Return where (C f)_i has opposite signs on opposite faces, for each i; product is C J."""
    certain = np.asarray(True)
    for i, x in enumerate(box):
        around = spread(product[i], box, i)
        values = []
        for end in ends(x):
            face = [*box[:i], end, *box[i + 1 :]]
            centre = [middle(y) for y in face]
            centred = dot(factor[i], components(f(*centre))) + around
            values.append(meet(dot(factor[i], components(f(*face))), centred))
        low, high = values
        rising = (low.sup <= 0) & (high.inf >= 0)
        certain = certain & (rising | ((low.inf >= 0) & (high.sup <= 0)))
    return certain


def _regular(inverse: Matrix, jacobian: Matrix) -> Mask:
    """Return where C is regular: C B is strictly diagonally dominant for the middle B of J."""
    product = matrix_product(inverse, [[middle(x) for x in row] for row in jacobian])
    dominant = np.asarray(True)
    for i, row in enumerate(product):
        others = sum((abs(x) for j, x in enumerate(row) if j != i), 0)
        dominant = dominant & (abs(row[i]) - others).certainly_positive()
    return dominant


_OUTCOMES = np.array([Roots.UNDECIDED, Roots.NONE, Roots.UNIQUE, Roots.AT_LEAST_ONE])
_REASONS = {
    Roots.UNDECIDED: "the image leaves the box, and f shows no opposite signs on opposite faces",
    Roots.NONE: "an enclosure of f excludes 0, or the image is disjoint from the box",
    Roots.UNIQUE: "the image is a proper part of its box",
    Roots.AT_LEAST_ONE: "opposite signs on opposite faces",
}


class SystemResult(NamedTuple):
    """The outcome, a box that contains every zero of the given box, and a reason."""

    outcome: Roots
    box: tuple[Interval, ...] | None
    reason: str


class SystemResults(NamedTuple):
    """The same for N boxes: an array of outcomes, n arrays of intervals, an array of reasons.

    Where the outcome is NONE the box means nothing.
    """

    outcomes: NDArray[np.object_]
    boxes: tuple[IntervalArray, ...]
    reasons: NDArray[np.object_]


class _State(NamedTuple):
    """Where there is no zero, where there is one, the box with them; C and J on a larger box."""

    none: Mask
    unique: Mask
    box: tuple[Any, ...]
    inverse: Matrix
    derivatives: Matrix


_Image: TypeAlias = Callable[[Function, Box, Matrix, Matrix], list[Any]]


@overload
def krawczyk(
    f: Function, box: Interval | Sequence[Interval], *, steps: int = 60
) -> SystemResult: ...
@overload
def krawczyk(f: Function, box: Sequence[IntervalArray], *, steps: int = 60) -> SystemResults: ...
def krawczyk(f: Function, box: Interval | Box, *, steps: int = 60) -> SystemResult | SystemResults:
    """Decide existence and uniqueness of zeros of f, and contract the box, by the operator K.

    n Intervals, or one, are a box, at their precision; n IntervalArrays of the shape (N,) are N.
    AT_LEAST_ONE is proved by signs on the faces, see `miranda`. Iteration ends when no side of a
    box shrinks by a quarter.
    """
    return _solve(f, box, _krawczyk_image, steps)


@overload
def newton_system(
    f: Function, box: Interval | Sequence[Interval], *, steps: int = 60
) -> SystemResult: ...
@overload
def newton_system(
    f: Function, box: Sequence[IntervalArray], *, steps: int = 60
) -> SystemResults: ...
def newton_system(
    f: Function, box: Interval | Box, *, steps: int = 60
) -> SystemResult | SystemResults:
    """Do the same by the operator N; where 0 is not in A_ii it lies within K, but for rounding."""
    return _solve(f, box, _newton_image, steps)


def contract(f: Function, box: Box, steps: int) -> tuple[Mask, Mask, tuple[Any, ...]]:
    """Return where K proves that there is no zero, and exactly one, and the contracted box."""
    return _contract(f, box, _krawczyk_image, steps)[:3]


def _solve(
    f: Function, box: Interval | Box, image: _Image, steps: int
) -> SystemResult | SystemResults:
    box = (box,) if isinstance(box, Interval) else box
    f = Formula(f, len(box))
    state = _contract(f, box, image, steps)
    some = np.asarray(False)
    if not (state.none | state.unique).all():
        some = signs_on_faces(f, state.box, state.derivatives, state.inverse)
    outcomes = _OUTCOMES[np.select([state.none, state.unique, some], [1, 2, 3], 0)]
    if isinstance(outcomes, np.ndarray):
        reasons = np.array([_REASONS[outcome] for outcome in outcomes], dtype=object)
        return SystemResults(outcomes, state.box, reasons)
    return SystemResult(outcomes, None if state.none else state.box, _REASONS[outcomes])


def _contract(f: Function, box: Box, image: _Image, steps: int) -> _State:
    """Apply an operator until nothing shrinks.

    (3) is tested against the box that the image was computed from; no zero of the given box is
    lost on the way to it, so what is proved there holds for the given box.
    """
    if steps < 1:
        raise ValueError("at least one step")
    none = unique = np.zeros(np.shape(box[0].inf), dtype=bool)
    for _ in range(steps):
        values, derivatives = jacobian(f, box)
        if len(values) != len(box):
            raise ValueError(f"{len(values)} equations in {len(box)} variables")
        inverse = approximate_inverse(derivatives)
        pairs = list(zip(image(f, box, inverse, derivatives), box, strict=True))
        for y, x, value in zip(*zip(*pairs, strict=True), values, strict=True):
            none = none | y.disjoint(x) | np.logical_not(value.contains_zero())
        unique = unique | all_of(y.subset(x) & np.logical_not(y.equal(x)) for y, x in pairs)
        box = tuple(meet(x, y) for y, x in pairs)
        stalled = all_of(4 * y.wid >= 3 * x.wid for y, (_, x) in zip(box, pairs, strict=True))
        if (none | stalled).all():
            break
    return _State(none, unique, tuple(box), inverse, derivatives)


def _krawczyk_image(f: Function, box: Box, inverse: Matrix, derivatives: Matrix) -> list[Any]:
    middles = [middle(x) for x in box]
    values = components(f(*middles))
    offsets = [x - m for x, m in zip(box, middles, strict=True)]
    image = []
    for i, row in enumerate(matrix_product(inverse, derivatives)):
        rest = [int(i == j) - a for j, a in enumerate(row)]
        image.append(middles[i] - dot(inverse[i], values) + dot(rest, offsets))
    return image


def _newton_image(f: Function, box: Box, inverse: Matrix, derivatives: Matrix) -> list[Any]:
    middles = [middle(x) for x in box]
    values = components(f(*middles))
    image = []
    for i, row in enumerate(matrix_product(inverse, derivatives)):
        usable = np.logical_not(row[i].contains_zero())
        diagonal = where(usable, row[i], 0 * row[i] + 1)
        shift = (dot(inverse[i], values) + spread(row, box, i)) / diagonal
        image.append(where(usable, middles[i] - shift, box[i]))
    return image
