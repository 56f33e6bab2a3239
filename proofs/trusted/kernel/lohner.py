"""Sets of states that a flow carries on, step by step: high-order enclosures in Lohner's frames.

The solutions of x' = f(x, w, t) with x(0) = start(w), for all w in a box, and the derivatives of x
by w. How steps and frames are chosen has no influence on what is proved.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import isqrt
from typing import NamedTuple, TypeVar

from proofs.trusted.kernel.arithmetic import Enclosure, Unproved, rational
from proofs.trusted.kernel.enclose import Matrix, add, multiply
from proofs.trusted.kernel.formulas import Formulas
from proofs.trusted.kernel.meter import METER
from proofs.trusted.kernel.series import Program, Series

Point = list[Enclosure]
T = TypeVar("T")

_MARGIN, _UNITS = 6, 64  # an a priori box is wider by 2^-6 of itself and so many units
_FRAME = 50  # bits of the entries of a frame


class Field(NamedTuple):
    """x' = f, and with it W' = f_x W + f_w for derivatives, ready for series.

    The variables are those of the formulas: x_1, ..., x_n from the number `first` on, then t, and w
    around them; then the entries of W, row by row. The columns of W are for the initial values of
    x, then for those w that occur in f: `causes`, their numbers among w.
    """

    first: int
    n: int
    causes: tuple[int, ...]
    plain: Program
    linear: Program

    def inputs(self, w: Sequence[T], x: Sequence[T], t: T) -> list[T]:
        """Return what belongs to the variables of the formulas, in their order."""
        return [*w[: self.first], *x, t, *w[self.first :]]


def linearized(formulas: Formulas, first: int) -> Field:
    """Return the field with these formulas of all variables, the states from number `first` on."""
    tape, roots, n = formulas.tape, formulas.roots, formulas.size
    count, time = len(formulas.variables), first + n
    nodes = (tape.nodes[place] for place in tape.order(roots))
    occurring = {int(node.datum) for node in nodes if node.op == "variable"}
    causes = sorted(occurring - {*range(first, time + 1)})
    columns = [*range(first, time), *causes]

    def entry(row: int, column: int) -> int:
        number = count + row * len(columns) + column
        return tape.add("variable", datum=Fraction(number))

    states, rates = {first + i: root for i, root in enumerate(roots)}, dict[int, int]()
    for i, root in enumerate(roots):
        for j, cause in enumerate(columns):
            total = tape.number(0) if j < n else tape.derivative(root, cause)
            for k in range(n):
                product = tape.product(tape.derivative(root, first + k), entry(k, j))
                total = tape.sum(total, product)
            rates[count + i * len(columns) + j] = total
    clock, parts = {time: tape.number(1)}, (*formulas.parts, *roots)
    plain = Program(tape, states | clock, parts, count)
    linear = Program(tape, states | rates | clock, parts, count + n * len(columns))
    numbers = tuple(number if number < first else number - n - 1 for number in causes)
    return Field(first, n, numbers, plain, linear)


class Set(NamedTuple):
    """States at one time, c + V q + B (R q + r), q = w - m; their derivatives by w, in V + B R.

    m is the middle of the box of w; c, V, B have point entries. c + B r holds the state for q = 0.
    """

    c: Point
    v: Matrix
    b: Matrix
    r: Point
    rest: Matrix

    def states(self, q: Sequence[Enclosure]) -> Point:
        """Enclose the states."""
        return moved(moved(self.c, self.v, q), self.b, moved(self.r, self.rest, q))


class Step(NamedTuple):
    """What is proved of all solutions that begin in a set, at the times s h after it, s in [0, 1].

    x and W, in this order, are in the sum of c_k s^k, plus [0, s] rest, c_k the k-th of
    `coefficients`; x is in `path`. For w = m, x(0) = c it is the same with those of `middle`.
    """

    h: Fraction
    before: Set
    coefficients: list[Point]
    middle: list[Point]
    rest: Point
    path: Point


class States(NamedTuple):
    """The states at some times of a step: of all solutions, of that for q = 0; derivatives by w.

    end: of the solution that begins at c. v, b: what V and B of the set have become.
    """

    all: Point
    middle: Point
    derivative: Matrix
    end: Point
    v: Matrix
    b: Matrix


@dataclass(frozen=True, eq=False)
class Solutions:
    """All solutions that begin with w in a box; q = w - m, m its middle."""

    field: Field
    w: Point
    middle: Point
    q: Point

    @classmethod
    def of(cls, field: Field, w: Sequence[Enclosure]) -> Solutions:
        """Return the solutions for all w in a box."""
        middle = list(map(middle_of, w))
        return cls(field, list(w), middle, less(w, middle))

    @property
    def bits(self) -> int:
        """The precision."""
        return self.w[0].bits

    def begin(self, start: Point, slopes: Matrix) -> Set:
        """Return the set of the first states, from start(m) and the derivatives of start by w."""
        c, v = list(map(middle_of, start)), [list(map(middle_of, row)) for row in slopes]
        return Set(c, v, unit(len(c), self.bits), less(start, c), list(map(less, slopes, v)))

    def step(self, now: Set, time: Fraction, h: Fraction, order: int) -> Step | None:
        """Prove where the solutions are from a time on, for a time h; None if it is not proved.

        Theorem. Let P be the Taylor polynomials of x and W, of order p, for all x(0) in a box X and
        all w; let Y be compact, R the coefficients of order p + 1 for all x, W in Y and all times
        of the step, and let P([0, 1]) + [0, 1] R lie in the interior of Y. Then all solutions
        exist, and are in P(s) + [0, s] R for s in [0, 1]. Proof. f is analytic about Y, where the
        coefficients are defined. As long as a solution is in Y, it is in P(s) + s^(p+1) R, by
        Taylor's theorem with Lagrange's remainder in each component, hence in the interior of Y;
        so there is no first time at which it leaves it, and it does not end before s = 1.
        """
        n, t = self.field.n, rational(time, self.bits)
        box = list(map(Enclosure.hull, now.states(self.q), now.c))  # convex, and c is in it
        identity = unit(n, self.bits, n + len(self.field.causes))
        start = [*self.field.inputs(self.w, box, t), *(x for row in identity for x in row)]
        always, during = Enclosure(0, 1 << self.bits, self.bits), t.hull(rational(time + h, t.bits))
        try:
            coefficients = _states(Series(self.field.linear, start, h), order)
            path = polynomial(coefficients, always)
            y = list(map(_wider, path))
            start = [*self.field.inputs(self.w, y[:n], during), *y[n:]]
            rest = Series(self.field.linear, start, h).coefficients(order + 1)[:-1]
        except Unproved:
            return None
        path = polynomial([path, rest], always)
        if not all(side.lo < x.lo and x.hi < side.hi for x, side in zip(path, y, strict=True)):
            return None
        middle = Series(self.field.plain, self.field.inputs(self.middle, now.c, t), h)
        return Step(h, now, coefficients, _states(middle, order), rest, path[:n])

    def at(self, step: Step, s: Enclosure) -> States:
        """Enclose the states at the times s h after the beginning of a step.

        Proof. By the mean value theorem x = phi(c, m) + S (x(0) - c) + S_w q, where x(0) is in the
        set and S, S_w are the entries of W, and x_w = S x_w(0) + S_w.
        """
        n, before, until = self.field.n, step.before, Enclosure(0, s.hi, s.bits)
        whole = polynomial([polynomial(step.coefficients, s), step.rest], until)
        end = polynomial([polynomial(step.middle, s), step.rest[:n]], until)
        width = n + len(self.field.causes)
        rows = [whole[n + width * i : n + width * (i + 1)] for i in range(n)]
        slopes = [row[:n] for row in rows]
        v, b = multiply(slopes, before.v), multiply(slopes, before.b)
        for row, entries in zip(v, rows, strict=True):
            for j, x in zip(self.field.causes, entries[n:], strict=True):
                row[j] = row[j] + x
        derivative = list(map(more, v, multiply(b, before.rest)))
        middle = moved(end, b, before.r)
        mean = moved(middle, derivative, self.q)
        return States(list(map(Enclosure.meet, mean, whole)), middle, derivative, end, v, b)

    def after(self, step: Step) -> Set:
        """Return the set in which a step ends, in a new frame (Lohner 1987)."""
        before, last = step.before, self.at(step, rational(Fraction(1), self.bits))
        c, v = list(map(middle_of, last.end)), [list(map(middle_of, row)) for row in last.v]
        frame, inverse = orthogonal(last.b, moved(before.r, before.rest, self.q))
        along, change = multiply(inverse, last.b), multiply(inverse, list(map(less, last.v, v)))
        shift = less(last.end, c)
        r = [
            add(add(x * 0, p, before.r), q, shift)
            for x, p, q in zip(c, along, inverse, strict=True)
        ]
        return Set(c, v, frame, r, list(map(more, multiply(along, before.rest), change)))


def _states(series: Series, order: int) -> list[Point]:
    """Return the coefficients up to an order, without those of the time, which are the last."""
    return [series.coefficients(k)[:-1] for k in range(order + 1)]


def orthogonal(matrix: Matrix, widths: Sequence[Enclosure]) -> tuple[Matrix, Matrix]:
    """Return a matrix Q, about orthogonal, and an enclosure of its inverse.

    Q is from the columns of the matrix by Gram and Schmidt, those that carry most first. Theorem.
    If Q'Q = I + E and the sums of |E| by rows are at most e <= 1/2, then Q is regular, and Q^-1
    differs from Q' by at most 2 e max |Q'| in each entry. Proof. Q^-1 = (I + E)^-1 Q', and
    (I + E)^-1 - I = -E (I + E)^-1 has sums by rows of at most e / (1 - e) <= 2 e.
    """
    n, bits = len(matrix), widths[0].bits
    METER.get().spend(10 * n**3)
    columns = [[(x.lo + x.hi) >> 1 for x in column] for column in zip(*matrix, strict=True)]
    carried = [
        sum(x * x for x in column) * (width.hi - width.lo) ** 2
        for column, width in zip(columns, widths, strict=True)
    ]
    order = sorted(range(n), key=lambda j: -carried[j])
    directions = _gram_schmidt([columns[j] for j in order])
    turned = [[rational(Fraction(x, 1 << _FRAME), bits) for x in row] for row in directions]
    frame = [list(row) for row in zip(*turned, strict=True)]
    error = map(less, multiply(turned, frame), unit(n, bits))
    most = max(sum(map(_magnitude, row)) for row in error)
    if most >> (bits - 1):
        raise Unproved("a frame is not proved regular")
    e = (2 * most * max(_magnitude(x) for row in turned for x in row) >> bits) + 1
    return frame, [[Enclosure(x.lo - e, x.hi + e, bits) for x in row] for row in turned]


def _gram_schmidt(columns: Sequence[Sequence[int]]) -> list[list[int]]:
    """Return about orthonormal vectors, in units of 2^-50, that span what the first columns do.

    What a column leaves beside the ones before it is found twice, to be orthogonal to them, too.
    """
    one, directions = 1 << _FRAME, list[list[int]]()
    for column in columns:
        excess = max(map(abs, column)).bit_length() - 2 * _FRAME
        rest = [x >> excess if excess > 0 else x << -excess for x in column]
        for q in directions * 2:
            dot = sum(x * y for x, y in zip(rest, q, strict=True)) >> _FRAME
            rest = [x - (dot * y >> _FRAME) for x, y in zip(rest, q, strict=True)]
        length = isqrt(sum(x * x for x in rest)) or 1
        directions.append([x * one // length for x in rest])
    return directions


def polynomial(coefficients: Sequence[Point], s: Enclosure) -> Point:
    """Enclose the sum of c_k s^k, by Horner's rule."""
    if s.lo == s.hi == 1 << s.bits:
        return [
            Enclosure(sum(x.lo for x in c), sum(x.hi for x in c), s.bits)
            for c in zip(*coefficients, strict=True)
        ]
    total = coefficients[-1]
    for row in reversed(coefficients[:-1]):
        total = [x + s * y for x, y in zip(row, total, strict=True)]
    return total


def _wider(x: Enclosure) -> Enclosure:
    margin = ((x.hi - x.lo) >> _MARGIN) + _UNITS
    return Enclosure(x.lo - margin, x.hi + margin, x.bits)


def _magnitude(x: Enclosure) -> int:
    return max(-x.lo, x.hi)


def middle_of(x: Enclosure) -> Enclosure:
    """Return about the middle of an enclosure, as a point."""
    m = (x.lo + x.hi) >> 1
    return Enclosure(m, m, x.bits)


def moved(x: Sequence[Enclosure], matrix: Matrix, q: Sequence[Enclosure]) -> Point:
    """Enclose x + A q."""
    return [add(value, row, q) for value, row in zip(x, matrix, strict=True)]


def less(x: Sequence[Enclosure], y: Sequence[Enclosure]) -> Point:
    """Enclose x - y."""
    return [a - b for a, b in zip(x, y, strict=True)]


def more(x: Sequence[Enclosure], y: Sequence[Enclosure]) -> Point:
    """Enclose x + y."""
    return [a + b for a, b in zip(x, y, strict=True)]


def unit(n: int, bits: int, columns: int = 0) -> Matrix:
    """Return the unit matrix; if there are to be more columns, 0 in these."""
    count = columns or n
    return [[rational(Fraction(int(i == j)), bits) for j in range(count)] for i in range(n)]
