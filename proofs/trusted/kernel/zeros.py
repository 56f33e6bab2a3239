"""Rule: exactly one zero of a map in a box, and the operator of Krawczyk that proves it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import NamedTuple

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved, rational
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.enclose import (
    Box,
    Differentiable,
    add,
    box_text,
    centre_of,
    enclosed,
    is_narrower,
    point_box,
    read_box,
    tried,
)
from proofs.trusted.kernel.maps import Map
from proofs.trusted.kernel.meter import METER
from proofs.trusted.kernel.parametric import moved
from proofs.trusted.numbers import hull

Rows = Sequence[Sequence[Fraction]]


@dataclass(frozen=True)
class UniqueZero(Conclusion):
    """F = (F_1, ..., F_n) has exactly one zero in a box."""

    function: Map
    box: Box

    @property
    def sentence(self) -> str:
        """Return the statement."""
        box = box_text(self.box, self.function.variables)
        return (
            f"for {self.function.definition} and {box}: `{self.function.name}` has exactly one "
            "zero."
        )


class Piece(NamedTuple):
    """A slanted box: the y + slope (x - m), x in the side of the axis, m its middle, y in others.

    slope: 0 along the axis.
    """

    box: Box
    slope: tuple[Fraction, ...]

    def cut(self, axis: int, x: Fraction) -> Box:
        """Return the part at one value of the axis."""
        beyond = x - centre_of(self.box)[axis]
        sides = zip(self.box, self.slope, strict=True)
        return tuple(
            (x, x) if k == axis else (low + slope * beyond, high + slope * beyond)
            for k, ((low, high), slope) in enumerate(sides)
        )

    def hull(self, axis: int) -> Box:
        """Return the smallest box around it."""
        ends = [self.cut(axis, x) for x in self.box[axis]]
        return tuple(hull(sides) for sides in zip(*ends, strict=True))


def unique_zero(context: Context, reader: Reader) -> UniqueZero:
    """Rule `unique-zero`: {function of n variables with n values, box X, centre m in X, matrix C}.

    Hypothesis: with an interval matrix J that contains F'(x) for all x in X, each component of

        K = m - C F(m) + (I - C J) (X - m)

    lies strictly inside that of X. Conclusion: F has exactly one zero in X.

    Proof. For x, y in X, F(x) - F(y) = B (x - y), B in J the mean of F' on the segment. So
    g(x) = x - C F(x) = m - C F(m) + (I - C B) (x - m) maps X into K. With widths w of X, all
    positive, and R the magnitudes of I - C J, (R w)_i <= wid K_i < w_i: g is a contraction of X
    in the norm max |x_i| / w_i and has one fixed point; and C is regular, since |I - C B| < 1, so
    the fixed points are the zeros. With parameters in ranges that is said of each of them, and
    C F(m) is enclosed for all, by the mean value theorem in the parameters. Source: Krawczyk 1969;
    Moore 1977; for n = 1 with C = 1 / F'(m) this is Newton's method with a remainder.
    """
    function_of, box_of, middle_of, matrix_of = reader.fields("function", "box", "centre", "matrix")
    function = context.function(function_of)
    n = len(function.variables)
    if function.size != n or function.circles:
        raise function_of.fail("as many values as variables, and no angles, are expected")
    box, centre = read_box(box_of, n), middle_of.numbers(n, n)
    if not all(low <= m <= high for m, (low, high) in zip(centre, box, strict=True)):
        raise middle_of.fail("the centre is not in the box")
    require_zero(function, box, read_matrix(matrix_of, n), centre=centre)
    return UniqueZero(function, box)


def read_matrix(reader: Reader, n: int) -> Rows:
    """Read a square matrix by its rows."""
    return [row.numbers(n, n) for row in reader.items(n, n)]


def require_zero(
    function: Differentiable,
    box: Box,
    matrix: Rows,
    *,
    centre: Sequence[Fraction] = (),
    axis: int | None = None,
    slope: Sequence[Fraction] = (),
    inside: Box = (),
) -> None:
    """Require that K, for the middle if no other centre, lies strictly inside a box: its own, or
    another one. With an axis only the other variables count.
    """
    piece = Piece(box, tuple(slope) or (Fraction(0),) * len(box))
    middle, sides = tuple(centre) or centre_of(box), inside or box
    before: list[Enclosure] = []
    for image in tried(lambda bits: krawczyk(function, piece, middle, matrix, (axis, bits))):
        if all(sides[k][0] < x.range[0] and x.range[1] < sides[k][1] for k, x in image.items()):
            return
        if any(x.range[1] < sides[k][0] or sides[k][1] < x.range[0] for k, x in image.items()):
            raise Unproved("the Krawczyk operator does not map the box strictly inside, but away")
        if before and not is_narrower([*image.values()], before):
            break
        before = [*image.values()]
    raise Unproved("the Krawczyk operator does not map the box strictly inside")


def krawczyk(
    function: Differentiable,
    piece: Piece,
    centre: Sequence[Fraction],
    matrix: Rows,
    how: tuple[int | None, int],
) -> dict[int, Enclosure]:
    """Enclose K by variables, but the axis; how: the axis, or None, and the precision."""
    METER.get().spend(100 * len(matrix) ** 2)
    axis, bits = how
    whole = piece.box if axis is None else piece.hull(axis)
    x, middle = enclosed(piece.box, bits), enclosed(point_box(centre), bits)
    steps = [a - m for a, m in zip(x, middle, strict=True)]
    slope = [rational(each, bits) for each in piece.slope]
    values, nothing = moved(function, middle), rational(Fraction(0), bits)
    slopes = function.jacobian(enclosed(whole, bits))
    if axis is not None:
        slopes = [[*row[:axis], add(row[axis], row, slope), *row[axis + 1 :]] for row in slopes]
    columns, image = list(zip(*slopes, strict=True)), {}
    for i, entries in zip((k for k in range(len(x)) if k != axis), matrix, strict=True):
        c = [rational(entry, bits) for entry in entries]
        defect = [int(i == j) - add(nothing, c, column) for j, column in enumerate(columns)]
        image[i] = add(middle[i] - values.combined(c), defect, steps)
    return image
