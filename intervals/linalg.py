"""Small dense matrices of intervals: linear systems, inverses, eigenvalues.

A matrix is an IntervalArray of the shape (n, n), the set of all real matrices with entries in the
given intervals; what is returned holds for each of them. Floating-point results of numpy's
linear algebra are candidates only: nothing that is concluded depends on them.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from math import inf
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from intervals.array import IntervalArray
from intervals.branch import as_box, clusters, concatenated
from intervals.errors import Undecided
from intervals.generic import meet
from intervals.interval import Interval
from intervals.rounding import Rows

_REFINEMENTS = 3
_SCALINGS = (0, 4, 7, 10, 13, 17, 26)  # 2^-26 suits a double, 2^-17 a triple eigenvalue, and so on


class SingularMatrix(Undecided):
    """The matrices of an enclosure are not proved regular; they need not be singular."""


class Eigenvalues(NamedTuple):
    """Each matrix has exactly `multiplicity` eigenvalues in real + i imag."""

    real: Interval
    imag: Interval
    multiplicity: int


def solve(a: IntervalArray, b: IntervalArray) -> IntervalArray:
    """Enclose all x with A x = B for A in a, B in b, where b has the shape (n,) or (n, m).

    Theorem (Krawczyk 1969; Rump 2010). Let C be a real matrix, R >= |I - C A|
    for all A in a, w > 0 a vector with R w <= beta w, beta < 1. Then each A is regular, and for
    any y and each x, max |x - y|_i / w_i <= max z_i / w_i / (1 - beta) with z >= |C (B - A y)|.
    If moreover E contains x - y, so does C (B - A y) + (I - C A) E.
    Proof. In the norm max |x_i| / w_i, that of I - C A is at most beta, so C A is regular; and
    e = x - y satisfies e = C (B - A y) + (I - C A) e.

    Raises SingularMatrix if no such C and w are found.
    """
    n = _order(a)
    if b.ndim not in (1, 2) or b.shape[0] != n or not b.size:
        raise ValueError(f"a right side of the shape {b.shape} for a matrix of the order {n}")
    columns = b.reshape(n, -1)
    inverse = _approximate_inverse(a.mid)
    c = IntervalArray.from_floats(inverse)
    rest = IntervalArray.from_floats(np.eye(n)) - c @ a
    if not np.isfinite(rest.mag).all():
        raise SingularMatrix("I - C A is beyond the range of binary64")
    weights, beta = _contraction(IntervalArray.from_floats(rest.mag))
    y = _points(inverse @ columns.mid)
    y = _points(y.mid + inverse @ (columns - a @ y).mid)
    step = c @ (columns - a @ y)
    norm = (IntervalArray.from_floats(step.mag) / weights).sup.max(axis=0)
    bound = (weights * IntervalArray.from_floats(norm) / (1 - beta)).sup
    error = IntervalArray.from_floats(-bound, bound)
    for _ in range(_REFINEMENTS):
        error = meet(error, step + rest @ error)
    return (y + error).reshape(*b.shape)


def inverse(a: IntervalArray) -> IntervalArray:
    """Enclose the inverses of all matrices in a; SingularMatrix as in `solve`."""
    return solve(a, IntervalArray.from_floats(np.eye(_order(a))))


def determinant(a: IntervalArray) -> IntervalArray:
    """Enclose the determinants of all matrices in a, by Gauss's elimination.

    Proof. Each matrix has the determinant (-1)^i p d, p its entry in row i and the first column, d
    the determinant of the other rows, less multiples of row i, without that column. Where no entry
    of the column is proved not to be 0, |d| is at most the product of the lengths of the rows
    (Hadamard).
    """
    result = IntervalArray(1)
    for _ in range(_order(a)):
        pivot = int(np.argmax(a[:, 0].mig))
        if not a[pivot, 0].mig > 0:
            bound = a.sqr().sum(axis=1).sqrt().prod()
            return result * bound.hull(-bound)
        top, rest = a[pivot], a[np.arange(len(a)) != pivot]
        result = result * (-top[0] if pivot % 2 else top[0])
        a = rest[:, 1:] - rest[:, :1] / top[0] * top[1:]
    return result


def eigenvalues(a: IntervalArray) -> list[Eigenvalues]:
    """Enclose the eigenvalues of each matrix A in a, in disjoint rectangles; n in all.

    Theorem (Gershgorin 1931). Let V, W be complex matrices, E = I - W V, M = W A V, eps >= |E|,
    mu >= |M| in the norm of the largest row sum, eps < 1, and let e_i be the i-th row sum of |E|.
    The discs with centre M_ii and radius sum over j != i of |M_ij| + e_i mu / (1 - eps) contain the
    eigenvalues of A, and a union of k of them that is disjoint from the others contains exactly
    k, with multiplicity.
    Proof. W V = I - E is regular, and A is similar to B = V^-1 A V = (I - E)^-1 M = M + F, with
    F = E (I - E)^-1 M, whose i-th row sum is at most e_i mu / (1 - eps). So the sum of |B_ij|,
    j != i, and |B_ii - M_ii| is at most the radius, and Gershgorin's theorem holds for B; as its
    off-diagonal grows from 0, the eigenvalues move continuously, within the discs.

    Rectangles contain the discs. One that meets the real axis is made symmetric to it; if it then
    has one eigenvalue, this is its own conjugate, since A is real: imag is 0.
    """
    n = _order(a)
    squares = list(_squares(a))
    if not squares:
        raise OverflowError("the discs leave the range of binary64")
    lower, upper = min(squares, key=lambda square: float(np.max(square[1] - square[0])))
    counts = [1] * n
    while True:
        reach = np.maximum(-lower[:, 1], upper[:, 1])
        on_axis = (lower[:, 1] <= 0) & (upper[:, 1] >= 0)
        lower[:, 1] = np.where(on_axis, -reach, lower[:, 1])
        upper[:, 1] = np.where(on_axis, reach, upper[:, 1])
        groups = clusters(lower, upper)
        if len(groups) == len(counts):
            break
        counts = [sum(counts[i] for i in members) for _, _, members in groups]
        lower, upper = (np.array(corners) for corners in list(zip(*groups, strict=True))[:2])
    found = []
    for index, count in enumerate(counts):
        rectangle = IntervalArray.from_floats(lower[index], upper[index])
        real, imag = as_box((rectangle[:1], rectangle[1:]), 0)
        alone = count == 1 and imag.contains_zero()
        found.append(Eigenvalues(real, Interval(0) if alone else imag, count))
    return sorted(found, key=lambda value: (value.real.inf, value.imag.inf))


def _order(a: IntervalArray) -> int:
    if a.ndim != 2 or a.shape[0] != a.shape[1] or not a.size:
        raise ValueError(f"not a square matrix: the shape is {a.shape}")
    return a.shape[0]


def _approximate_inverse(matrix: Rows) -> Rows:
    with np.errstate(all="ignore"):
        try:
            result = np.linalg.inv(matrix)
        except np.linalg.LinAlgError:
            raise SingularMatrix("the midpoint matrix is singular") from None
    if not np.isfinite(result).all():
        raise SingularMatrix("the midpoint matrix has no inverse in binary64")
    return np.asarray(result)


def _points(candidate: Rows) -> IntervalArray:
    """Return a candidate, with 0 for what is not finite."""
    return IntervalArray.from_floats(np.where(np.isfinite(candidate), candidate, 0.0))


def _contraction(r: IntervalArray) -> tuple[IntervalArray, Interval]:
    """Return w > 0, a column, and beta < 1 with R w <= beta w; SingularMatrix if w is not found.

    If P = (I - R)^-1 >= 0 and w = P v, then R w = w - v. Repeated, w is near to an eigenvector of
    R, whatever the scales of its entries are.
    """
    n = len(r)
    candidate = np.ones((n, 1))
    with suppress(np.linalg.LinAlgError), np.errstate(all="ignore"):
        powers = np.linalg.inv(np.eye(n) - r.mid)
        candidate = powers @ (powers @ (powers @ candidate))
    if not (np.isfinite(candidate).all() and (candidate > 0).all()):
        candidate = np.ones((n, 1))
    weights = IntervalArray.from_floats(candidate)
    beta = ((r @ weights) / weights).sup.max()
    if not beta < 1:
        raise SingularMatrix(f"the norm of I - C A is not below 1, but {beta}")
    return weights, Interval.from_float(float(beta))


# -- eigenvalues: complex matrices are real ones of twice the size --------------------------------


def _squares(a: IntervalArray) -> Iterator[tuple[Rows, Rows]]:
    """Yield corners (re, im) of squares around the discs, for several V and W."""
    zero = 0 * a
    doubled = concatenated([concatenated([a, zero], 1), concatenated([zero, a], 1)])
    for v, w in _bases(a.mid):
        square = None
        with suppress(OverflowError):
            square = _square(doubled, _points(_real(v)), _points(_real(w)))
        if square:
            yield square


def _square(a: IntervalArray, v: IntervalArray, w: IntervalArray) -> tuple[Rows, Rows] | None:
    """Return the squares of one choice of V and W, None if eps is not below 1."""
    n = len(a) // 2
    error = _moduli(IntervalArray.from_floats(np.eye(2 * n)) - w @ v).sum(axis=1)
    eps = float(error.sup.max())
    if not eps < 1:
        return None
    matrix = w @ a @ v
    sizes = _moduli(matrix)
    mu = float(sizes.sum(axis=1).sup.max())
    if not mu < inf:
        return None
    others = IntervalArray.from_floats(np.where(np.eye(n) > 0, 0.0, sizes.sup)).sum(axis=1)
    slack = error * (Interval.from_float(mu) / (1 - Interval.from_float(eps)))
    radius = (others + slack).sup
    disc = IntervalArray.from_floats(-radius, radius)
    index = np.arange(n)
    sides = matrix[index, index] + disc, matrix[index + n, index] + disc
    return np.stack([x.inf for x in sides], axis=1), np.stack([x.sup for x in sides], axis=1)


def _moduli(doubled: IntervalArray) -> IntervalArray:
    """Return intervals that reach up to |z_ij| or above: |x| + |y|, which cannot overflow early.

    z = x + i y has x and y in the left half of the doubled matrix.
    """
    n = len(doubled) // 2
    return abs(doubled[:n, :n]) + abs(doubled[n:, :n])


def _real(z: NDArray[Any]) -> Rows:
    """Return (x, -y; y, x) for z = x + i y: products of these are those of the complex ones."""
    return np.block([[z.real, -z.imag], [z.imag, z.real]]) + 0.0


def _bases(matrix: Rows) -> Iterator[tuple[NDArray[Any], NDArray[Any]]]:
    """Yield candidates for V and W.

    The unit matrix; Schur vectors, scaled so that the triangle above the diagonal is small, for
    eigenvectors that are nearly dependent; and eigenvectors.
    """
    unit = np.eye(len(matrix)) + 0j
    yield unit, unit
    with np.errstate(all="ignore"), suppress(np.linalg.LinAlgError):
        schur = _schur(matrix)
        for shift in _SCALINGS:
            scale = 2.0 ** (-shift * np.arange(len(matrix)))
            yield schur * scale, schur.conj().T / scale[:, np.newaxis]
        vectors = np.linalg.eig(matrix)[1] + 0j
        yield vectors, np.linalg.inv(vectors)


def _schur(matrix: Rows) -> NDArray[Any]:
    """Return a unitary Q, up to rounding, with Q* A Q upper triangular: an eigenvector a step."""
    n = len(matrix)
    q = np.eye(n) + 0j
    for k in range(n - 1):
        vectors = np.linalg.eig((q.conj().T @ matrix @ q)[k:, k:])[1]
        q[:, k:] = q[:, k:] @ np.linalg.qr(np.hstack((vectors[:, :1], np.eye(n - k))))[0]
    return q
