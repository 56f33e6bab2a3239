"""Rule: one periodic orbit of a map, alone in a box; whether it attracts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from itertools import combinations

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.contractor import Point
from proofs.trusted.kernel.covers import MAX_POWER, images
from proofs.trusted.kernel.enclose import (
    Box,
    Matrix,
    box_text,
    enclosed,
    integer,
    multiply,
    read_box,
    tried,
)
from proofs.trusted.kernel.maps import Map, counted, read_turns
from proofs.trusted.kernel.periodic import Closing, derivative
from proofs.trusted.kernel.zeros import read_matrix, require_zero

ATTRACTING, SADDLE, REPELLING = "attracting", "a saddle", "repelling"
_SQUARINGS = 8  # of a matrix of three rows and more


@dataclass(frozen=True)
class PeriodicOrbit(Conclusion):
    """A map has exactly one periodic orbit of a least period with a first point in a box.

    turns: the periods by which its angles have increased after it; stability: what its multipliers
    are, where that is proved; that they are those of a saddle or larger, for one or two variables.
    """

    function: Map
    period: int
    turns: tuple[int, ...]
    box: Box
    stability: str | None

    @property
    def sentence(self) -> str:
        """Return the statement."""
        map_, place = self.function, box_text(self.box, self.function.variables)
        turned = [
            f"`{map_.variables[circle.place]}` having {'de' if turns < 0 else 'in'}creased by "
            f"{counted(turns)}"
            for circle, turns in zip(map_.circles, self.turns, strict=True)
        ]
        orbit = (
            "fixed point" if self.period == 1 else f"periodic orbit of least period {self.period}"
        )
        start = "" if self.period == 1 else " that begins"
        after = f" ({', '.join(turned)})" if turned else ""
        kind = "" if self.stability is None else f"; it is {self.stability}"
        return f"for {map_.definition}: exactly one {orbit}{start} at {place}{after}{kind}."


def periodic_orbit(context: Context, reader: Reader) -> PeriodicOrbit:
    """Rule `periodic-orbit`: {function F, period n, box X, matrix C}.

    For a map with angles also `turns`, an integer k for each of them; p is the turns times the
    periods. Hypotheses: by `require_zero` with C the function F^n(x) - p - x has exactly one zero
    in X; no two of the enclosures of X, F(X), ..., F^(n-1)(X) can be the same point, with angles
    taken modulo their periods. Conclusion: F has exactly one orbit of period n that begins in X and
    whose angles have increased by p after it; n is its least period.

    Proof. The points from which orbits of period n go on so are the zeros of that function; the n
    points of the one that begins in X are different.

    With one or two variables let M enclose (F^n)' on X, T its trace and D its determinant. If
    |D| < 1 and |T| < 1 + D, the orbit is attracting: both multipliers, the zeros of
    z^2 - T z + D, are inside the unit circle (Jury). If (1 + D)^2 < T^2, it is a saddle: the
    polynomial has opposite signs at 1 and -1, so exactly one zero lies between them. If |D| > 1 and
    |T| < |1 + D|, both are outside (as 1/z for the case before). With one variable M is the
    multiplier. With more than two the orbit is attracting if the absolute values in each row of a
    power of M have a sum < 1: that is a norm of the power, so no eigenvalue of M reaches 1.
    """
    more = ("turns",) if reader.has("turns") else ()
    fields = reader.fields("function", "period", "box", "matrix", *more)
    function_of, period_of, box_of, matrix_of, *_ = fields
    function, period = context.function(function_of), integer(period_of, 1, MAX_POWER)
    n, turns = len(function.variables), read_turns(function, reader)
    if function.size != n:
        raise function_of.fail("as many values as variables are expected")
    box = read_box(box_of, n)
    require_zero(Closing(function, period, turns), box, read_matrix(matrix_of, n))
    for points, matrix in tried(partial(_followed, function, box, period)):
        if not any(may_be_one(function, x, y) for x, y in combinations(points, 2)):
            return PeriodicOrbit(function, period, turns, box, _stability(matrix))
    raise Unproved("the points of the orbit are not proved to be different")


def _followed(function: Map, box: Box, period: int, bits: int) -> tuple[list[Point], Matrix]:
    """Enclose a box's images, and the derivative along them."""
    points = images(function, enclosed(box, bits), period)
    return points, derivative(function, points)


def may_be_one(function: Map, x: Sequence[Enclosure], y: Sequence[Enclosure]) -> bool:
    """Whether two boxes may have a point in common, angles being taken modulo their periods."""
    periods = function.periods(x[0].bits)
    for place, (a, b) in enumerate(zip(x, y, strict=True)):
        apart = a - b
        if place in periods:
            ratio = apart / periods[place]
            if -(-ratio.lo >> ratio.bits) > ratio.hi >> ratio.bits:
                return False
        elif not apart.has_zero:
            return False
    return True


def _stability(matrix: Matrix) -> str | None:
    """Return what the multipliers of all matrices in an interval matrix are, if that is proved."""
    unit = 1 << matrix[0][0].bits
    if len(matrix) == 1:
        size = magnitude(matrix[0][0])
        return ATTRACTING if size.hi < unit else REPELLING if size.lo > unit else None
    if len(matrix) > 2:
        return ATTRACTING if _contracts(matrix, unit) else None
    (a, b), (c, d) = matrix
    trace, determinant = magnitude(a + d), a * d - b * c
    area, ends = magnitude(determinant), magnitude(determinant + 1)
    if (determinant + 1 - trace).lo > 0 and area.hi < unit:
        return ATTRACTING
    if (trace - ends).lo > 0:
        return SADDLE
    return REPELLING if (ends - trace).lo > 0 and area.lo > unit else None


def _contracts(matrix: Matrix, unit: int) -> bool:
    """Whether a power of all matrices in an interval matrix has a norm < 1, by squaring."""
    for _ in range(_SQUARINGS):
        if all(sum(magnitude(x).hi for x in row) < unit for row in matrix):
            return True
        matrix = multiply(matrix, matrix)
    return False


def magnitude(x: Enclosure) -> Enclosure:
    """Enclose the absolute value."""
    return x if x.lo >= 0 else -x if x.hi <= 0 else Enclosure(0, max(-x.lo, x.hi), x.bits)
