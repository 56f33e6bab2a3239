"""h-sets: parallelepipeds with one unstable direction, exact, and a map in their coordinates."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from proofs.trusted.kernel.arithmetic import Enclosure, Unproved, rational
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.enclose import Components, Matrix, add
from proofs.trusted.numbers import show

Rows = tuple[tuple[Fraction, ...], ...]


@dataclass(frozen=True)
class HSet(Conclusion):
    """The points c + A q, q in [-1, 1]^n, A regular; the first coordinate q_1 is unstable."""

    centre: tuple[Fraction, ...]
    matrix: Rows
    inverse: Rows

    @property
    def sentence(self) -> str:
        """Return what set it is."""
        centre = ", ".join(map(show, self.centre))
        rows = ", ".join(f"({', '.join(map(show, row))})" for row in self.matrix)
        n = len(self.centre)
        return f"the points ({centre}) + A q, q in [-1, 1]^{n}, A with the rows {rows}"


def inverse(matrix: Rows) -> Rows:
    """Return the exact inverse (Gauss and Jordan), or raise Unproved."""
    n = len(matrix)
    rows = [[*row, *(Fraction(int(i == j)) for j in range(n))] for i, row in enumerate(matrix)]
    for k in range(n):
        pivot = next((i for i in range(k, n) if rows[i][k]), None)
        if pivot is None:
            raise Unproved("a singular matrix")
        rows[k], rows[pivot] = rows[pivot], rows[k]
        rows[k] = [entry / rows[k][k] for entry in rows[k]]
        for i in range(n):
            if i != k and (factor := rows[i][k]):
                rows[i] = [a - factor * b for a, b in zip(rows[i], rows[k], strict=True)]
    return tuple(tuple(row[n:]) for row in rows)


def disjoint(one: HSet, two: HSet) -> bool:
    """Whether the normal of some face separates two h-sets (a separating plane: sufficient).

    The values of w . x on c + A [-1, 1]^n are w . c + [-r, r], r = sum over j of |w . A_j|. For
    n <= 2 some face normal separates any two disjoint ones.
    """
    for normal in (*one.inverse, *two.inverse):
        apart = abs(_dot(normal, two.centre) - _dot(normal, one.centre))
        columns = (*zip(*one.matrix, strict=True), *zip(*two.matrix, strict=True))
        if apart > sum(abs(_dot(normal, column)) for column in columns):
            return True
    return False


def _dot(a: Sequence[Fraction], b: Sequence[Fraction]) -> Fraction:
    return sum((x * y for x, y in zip(a, b, strict=True)), Fraction(0))


@dataclass(frozen=True)
class LocalMap:
    """f(q) = B^-1 (F^k(c + A q) - d): an iterate from c + A q to d + B q, in their coordinates."""

    map: Components
    power: int
    source: HSet
    target: HSet

    def values(self, x: Sequence[Enclosure]) -> list[Enclosure]:
        """Enclose f on a box of coordinates."""
        points = self._points(x)
        for _ in range(self.power):
            points = self.map.values(points)
        moved = [p - d for p, d in zip(points, _vector(self.target.centre, x), strict=True)]
        return [add(_zero(x), row, moved) for row in _rows(self.target.inverse, x)]

    def jacobian(self, x: Sequence[Enclosure]) -> Matrix:
        """Enclose f' = B^-1 F'(x_(k-1)) ... F'(x_0) A (chain rule)."""
        points, product = self._points(x), _rows(self.source.matrix, x)
        for _ in range(self.power):
            product = multiply(self.map.jacobian(points), product)
            points = self.map.values(points)
        return multiply(_rows(self.target.inverse, x), product)

    def _points(self, x: Sequence[Enclosure]) -> list[Enclosure]:
        centre = _vector(self.source.centre, x)
        rows = _rows(self.source.matrix, x)
        return [add(c, row, x) for c, row in zip(centre, rows, strict=True)]


def multiply(a: Matrix, b: Matrix) -> Matrix:
    """Enclose the product of two matrices."""
    columns = list(zip(*b, strict=True))
    nothing = a[0][0] * 0
    return [[add(nothing, row, column) for column in columns] for row in a]


def _zero(x: Sequence[Enclosure]) -> Enclosure:
    return Enclosure(0, 0, x[0].bits)


def _vector(entries: Sequence[Fraction], x: Sequence[Enclosure]) -> list[Enclosure]:
    return [rational(entry, x[0].bits) for entry in entries]


def _rows(matrix: Rows, x: Sequence[Enclosure]) -> Matrix:
    return [_vector(row, x) for row in matrix]
