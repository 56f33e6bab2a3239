"""Rule: curves of zeros, proved in a chain of slanted boxes around all of each."""

from __future__ import annotations

from bisect import bisect_left
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import pairwise

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.enclose import Box, box_text, read_box
from proofs.trusted.kernel.maps import Map
from proofs.trusted.kernel.zeros import Piece, Rows, read_matrix, require_zero
from proofs.trusted.numbers import Range, show_range, within

_MOST_PIECES = 2000


@dataclass(frozen=True)
class Arc(Conclusion):
    """The zeros of F = (F_1, ..., F_n) in a chain of pieces: a graph over one of n + 1 variables.

    axis: the place of that variable, along which the pieces follow each other; points: boxes
    inside of pieces, with one value of it each, and the zero at that value.
    """

    function: Map
    axis: int
    pieces: tuple[Piece, ...]
    points: tuple[Box, ...] = ()

    def __post_init__(self) -> None:
        """Raise Unproved unless the pieces have lengths, and each begins where the last ended."""
        along = [piece.box[self.axis] for piece in self.pieces]
        if any(low >= high for low, high in along) or any(a[1] != b[0] for a, b in pairwise(along)):
            raise Unproved("pieces of an arc are not one after the other")
        if any(piece.slope[self.axis] for piece in self.pieces):
            raise Unproved("a piece is slanted along its axis")
        if not all(map(self._holds, self.points)):
            raise Unproved("a point is not in a piece of the arc")

    def _holds(self, point: Box) -> bool:
        x, end = point[self.axis]
        after = bisect_left(self._reached, x)  # and a piece begins where this one ends
        return x == end and any(
            within((x, x), piece.box[self.axis])
            and all(map(within, point, piece.cut(self.axis, x)))
            for piece in self.pieces[after : after + 2]
        )

    @cached_property
    def _reached(self) -> list[Fraction]:
        return [piece.box[self.axis][1] for piece in self.pieces]

    @property
    def ends(self) -> Range:
        """Return the values of the axis between which it goes."""
        return self.pieces[0].box[self.axis][0], self.pieces[-1].box[self.axis][1]

    def width(self, place: int) -> Fraction:
        """Return how wide the pieces are in a variable, at most, at one value of the axis."""
        return max(high - low for low, high in (piece.box[place] for piece in self.pieces))

    @property
    def path(self) -> str:
        """Say where it is."""
        names, ends = self.function.variables, self.ends
        first, last = (
            box_text(piece.cut(self.axis, x), names)
            for piece, x in zip((self.pieces[0], self.pieces[-1]), ends, strict=True)
        )
        return f"in a chain of {len(self.pieces)} slanted boxes, from {first} to {last}"

    @property
    def passed(self) -> str:
        """Say which points it passes."""
        shown = "; ".join(box_text(point, self.function.variables) for point in self.points)
        return f", which passes {shown}" if shown else ""

    @property
    def sentence(self) -> str:
        """Return the statement."""
        name, axis = self.function.name, self.function.variables[self.axis]
        return (
            f"for {self.function.definition}: the zeros of `{name}` {self.path}, are the graph "
            f"of a smooth function of `{axis}` in {show_range(self.ends)}{self.passed}."
        )


def arc(context: Context, reader: Reader) -> Arc:
    """Rule `arc`: {function of n + 1 variables with n values, axis, pieces, points}; see `an_arc`.

    axis: the name of a variable. Conclusion: the zeros of F in the pieces are a smooth graph over
    the axis.
    """
    function_of, axis_of, pieces_of, points_of = reader.fields(
        "function", "axis", "pieces", "points"
    )
    function = context.function(function_of)
    if function.size + 1 != len(function.variables) or function.circles:
        raise function_of.fail("one value less than variables, and no angles, are expected")
    if axis_of.string() not in function.variables:
        raise axis_of.fail("a variable of the function is expected")
    return an_arc(function, function.variables.index(axis_of.string()), pieces_of, points_of)


def an_arc(function: Map, axis: int, pieces_of: Reader, points_of: Reader) -> Arc:
    """Theorem. Let F have n values and n + 1 variables, one of them, x, the axis, y the others.

    Pieces: {box, slope, matrix C}, see `Piece`; points: {box, matrix C} with one value of x, slope
    0. Hypotheses: for each of them, X and Y the sides of its box, s its slope, m the middle, J
    containing F' on the slanted box, J_x and J_y its columns,

        K = m_y - C F(m) - C (J_x + J_y s) (X - m_x) + (I - C J_y) (Y - m_y)

    lies strictly inside Y. Each piece begins at the x where the one before ends, and there the K of
    one of the two, for this x alone, lies inside the other one. Conclusion: the zeros of F in the
    pieces are the graph y(x) of a smooth function on the whole interval; each point's box has one.

    Proof. Let G(x, y) = F(x, y + s (x - m_x)): G_x = F_x + F_y s, G_y = F_y. At each x in X, G(x,
    .) has exactly one zero in Y, as in `unique-zero`, and G_y is regular there. It is inside Y, so
    by the implicit function theorem it is smooth in x. At a common end the zero of one piece is in
    the other one, so it is the zero there, too. A point's box is part of a piece.
    """
    pieces = [_read_piece(function, axis, each) for each in pieces_of.items(1, _MOST_PIECES)]
    points = [_read_point(function, each) for each in points_of.items(0, _MOST_PIECES)]
    chain, boxes = tuple(piece for piece, _ in pieces), tuple(point for point, _ in points)
    found = Arc(function, axis, chain, boxes)
    for piece, matrix in pieces:
        require_zero(function, piece.box, matrix, axis=axis, slope=piece.slope)
    for point, matrix in points:
        require_zero(function, point, matrix, axis=axis)
    for (first, before), (second, after) in pairwise(pieces):
        ends = [piece.cut(axis, second.box[axis][0]) for piece in (first, second)]
        try:
            require_zero(function, ends[0], before, axis=axis, inside=ends[1])
        except Unproved:
            require_zero(function, ends[1], after, axis=axis, inside=ends[0])
    return found


def _read_piece(function: Map, axis: int, reader: Reader) -> tuple[Piece, Rows]:
    box_of, slope_of, matrix_of = reader.fields("box", "slope", "matrix")
    n = len(function.variables)
    piece = Piece(read_box(box_of, n), slope_of.numbers(n, n))
    return piece, read_matrix(matrix_of, n - 1)


def _read_point(function: Map, reader: Reader) -> tuple[Box, Rows]:
    box_of, matrix_of = reader.fields("box", "matrix")
    n = len(function.variables)
    return read_box(box_of, n), read_matrix(matrix_of, n - 1)
