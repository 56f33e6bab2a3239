"""h-sets, parallelepipeds with one unstable direction, and rules: when one covers another."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial, reduce

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved, rational
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.enclose import (
    Box,
    Differentiable,
    Matrix,
    add,
    decide,
    enclosed,
    integer,
    leaves,
    multiply,
    point_box,
    size,
)
from proofs.trusted.kernel.maps import Map, lifted, read_turns, turned
from proofs.trusted.kernel.meter import METER
from proofs.trusted.numbers import Range, show, show_range

MAX_POWER = 100
_MAX_DIMENSION = 6
_SIDE = (Fraction(-1), Fraction(1))
_SIGNS = {"+": 1, "-": -1}

Rows = tuple[tuple[Fraction, ...], ...]


@dataclass(frozen=True)
class HSet(Conclusion):
    """The points c + A q, q in [-1, 1]^n, A regular; the first coordinate q_1 is unstable."""

    centre: tuple[Fraction, ...]
    matrix: Rows
    inverse: Rows

    def span(self, axis: int = 0) -> Range:
        """Return the least and the greatest of a coordinate of its points."""
        reach = sum(map(abs, self.matrix[axis]))
        return self.centre[axis] - reach, self.centre[axis] + reach

    @property
    def described(self) -> str:
        """What set it is."""
        if len(self.centre) == 1:
            return show_range(self.span())
        centre = ", ".join(map(show, self.centre))
        rows = ", ".join(f"({', '.join(map(show, row))})" for row in self.matrix)
        n = len(self.centre)
        return f"the points ({centre}) + A q, q in [-1, 1]^{n}, A with the rows {rows}"

    @property
    def sentence(self) -> str:
        """Return that it is one."""
        return f"{self.described}, are a parallelepiped."


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
    METER.get().spend(sum(10 + (size(x) + size(y) >> 5) for x, y in zip(a, b, strict=True)))
    return sum((x * y for x, y in zip(a, b, strict=True)), Fraction(0))


@dataclass(frozen=True)
class LocalMap:
    """f(q) = B^-1 (F^k(c + A q) - d): an iterate from c + A q to d + B q, in their coordinates.

    turns: for each angle of the map, in its order, how many periods are taken off F^k.
    """

    map: Map
    power: int
    source: HSet
    target: HSet
    turns: tuple[int, ...] = ()

    @property
    def label(self) -> str:
        """The iterate, and how many periods are taken off."""
        name = f"`{self.map.name}`"
        name = name if self.power == 1 else f"the iterate {name}^{self.power}"
        lifts = [
            f"`{self.map.variables[circle.place]}` {lifted(turns)}"
            for circle, turns in zip(self.map.circles, self.turns, strict=True)
            if turns
        ]
        return f"{name} ({', '.join(lifts)})" if lifts else name

    def values(self, x: Sequence[Enclosure]) -> list[Enclosure]:
        """Enclose f on a box of coordinates."""
        points = turned(self.map, images(self.map, self._points(x), self.power + 1)[-1], self.turns)
        moved = [p - rational(d, p.bits) for p, d in zip(points, self.target.centre, strict=True)]
        return [add(x[0] * 0, row, moved) for row in _rows(self.target.inverse, x)]

    def jacobian(self, x: Sequence[Enclosure]) -> Matrix:
        """Enclose f' = B^-1 F'(x_(k-1)) ... F'(x_0) A (chain rule)."""
        points = images(self.map, self._points(x), self.power)
        product = along(self.map, points, _rows(self.source.matrix, x))
        return multiply(_rows(self.target.inverse, x), product)

    def _points(self, x: Sequence[Enclosure]) -> list[Enclosure]:
        rows = zip(self.source.centre, _rows(self.source.matrix, x), strict=True)
        return [add(rational(c, x[0].bits), row, x) for c, row in rows]


def images(map_: Differentiable, x: Sequence[Enclosure], count: int) -> list[list[Enclosure]]:
    """Enclose x and its images, `count` in all."""
    points = [list(x)]
    while len(points) < count:
        points.append(map_.values(points[-1]))
    return points


def along(map_: Differentiable, points: Sequence[Sequence[Enclosure]], first: Matrix) -> Matrix:
    """Enclose all products A_k ... A_1 A, A in `first`, A_i in F' on the i-th box of points."""
    return reduce(lambda product, x: multiply(map_.jacobian(x), product), points, first)


def _rows(matrix: Rows, x: Sequence[Enclosure]) -> Matrix:
    return [enclosed(point_box(row), x[0].bits) for row in matrix]


@dataclass(frozen=True)
class Covers(Conclusion):
    """The map covers the target by the source."""

    local: LocalMap
    orientation: int

    @property
    def sentence(self) -> str:
        """Return the statement."""
        return (
            f"for {self.local.map.definition}: N => M under {self.local.label}, with N "
            f"{self.local.source.described}, and M {self.local.target.described}."
        )


def h_set(_: Context, reader: Reader) -> HSet:
    """Rule `h-set`: {centre, matrix A, inverse}.

    Hypothesis: the inverse times A is the unit matrix, exactly. Conclusion: the points c + A q, q
    in [-1, 1]^n, are a parallelepiped. Proof. A is invertible.
    """
    centre_of, matrix_of, inverse_of = reader.fields("centre", "matrix", "inverse")
    centre = centre_of.numbers(1, _MAX_DIMENSION)
    n = len(centre)
    matrix, inverse = (
        tuple(row.numbers(n, n) for row in rows.items(n, n)) for rows in (matrix_of, inverse_of)
    )
    columns = list(zip(*matrix, strict=True))
    products = [[_dot(row, column) for column in columns] for row in inverse]
    if products != [[int(i == j) for j in range(n)] for i in range(n)]:
        raise Unproved("the inverse is not that of the matrix")
    return HSet(centre, matrix, inverse)


def covers(context: Context, reader: Reader) -> Covers:
    """Rule `covers`: {function, power k, source N, target M, sign, left, right, support}.

    For a map with angles also `turns`, an integer for each of them. N = c + A [-1, 1]^n and
    M = d + B [-1, 1]^n are h-sets of which the first coordinate is unstable; f(q) =
    B^-1 (F^k(c + A q) - p - d), p the turns times the periods. Hypotheses, with the sign s = 1 or
    -1, on each leaf of the trees: s f_1 < -1 on `left`, the face q_1 = -1; s f_1 > 1 on `right`,
    the face q_1 = 1; on `support`, the whole [-1, 1]^n, |f_1| > 1 or |f_j| < 1 for all j > 1.

    Conclusion: N =F^k=> M in the sense of Zgliczynski and Gidea (2004, definition 6), of degree s,
    the angles being lifted so.

    Proof. f is continuous on the cube. Let h_t shrink the coordinates f_j, j > 1, by 1 - 2t for
    t <= 1/2, then move f_1 along a segment to 2 s q_1. Up to t = 1/2 a point with |f_1| > 1 keeps
    its f_1, another one its |h_j| < 1, and then h_j = 0: h never meets the sides |q_j| = 1 of the
    target within |q_1| <= 1. On the faces q_1 = -1, 1, h_1 stays beyond -1 and 1. At t = 1,
    h(q) = (2 s q_1, 0, ..., 0). That is the definition.
    """
    names = ("function", "power", "source", "target", "sign", "left", "right", "support")
    more = ("turns",) if reader.has("turns") else ()
    fields = reader.fields(*names, *more)
    function, power, source_of, target_of, sign, left, right, support, *_ = fields
    map_, k = context.function(function), integer(power, 1, MAX_POWER)
    source, target = context.step(source_of, HSet), context.step(target_of, HSet)
    n = len(map_.variables)
    if not n == map_.size == len(source.centre) == len(target.centre):
        raise function.fail("the function and the h-sets must have one dimension")
    if sign.string() not in _SIGNS:
        raise sign.fail('"+" or "-" is expected')
    turns, s = read_turns(map_, reader), _SIGNS[sign.string()]
    local = LocalMap(map_, k, source, target, turns)
    for tree, face, way in ((left, -1, -s), (right, 1, s)):
        for leaf in leaves(tree, ((Fraction(face), Fraction(face)), *cube(n - 1))):
            decide(local, leaf, partial(_first_beyond, way))
    for leaf in leaves(support, cube(n)):
        decide(local, leaf, _clear_of_the_sides)
    return Covers(local, s)


def cube(n: int) -> Box:
    """Return [-1, 1]^n."""
    return (_SIDE,) * n


def beyond(value: Enclosure, way: int = 0) -> bool:
    """Whether way value > 1, way being 1 or -1; |value| > 1 without one."""
    one = 1 << value.bits
    return (way >= 0 and value.lo > one) or (way <= 0 and value.hi < -one)


def _first_beyond(way: int, values: list[Enclosure]) -> bool:
    return beyond(values[0], way)


def _clear_of_the_sides(values: list[Enclosure]) -> bool:
    one = 1 << values[0].bits
    return beyond(values[0]) or all(-one < value.lo and value.hi < one for value in values[1:])
