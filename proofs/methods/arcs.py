"""Follow a curve of zeros of a map of n + 1 variables to n values, in slanted boxes: rule `arc`."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from fractions import Fraction
from typing import Any, NamedTuple

from intervals import IntervalError, Undecided
from proofs.methods.lemmas import dot, krawczyk, middles, newton, require_zero, undecided, written
from proofs.trusted.certificate import texts
from proofs.trusted.kernel.enclose import Box, centre_of, enclosed, point_box
from proofs.trusted.kernel.maps import Map
from proofs.trusted.kernel.zeros import Piece

_UNIT = Fraction(1, 10**6)  # of the axis
_FINE = Fraction(1, 10**10)  # of the other sides
_PLACES = 10**6  # of matrices and slopes
_SHORTEST = Fraction(1, 10**5)
_ROOM = Fraction(13, 10)
_TRIES = 4
_BITS = 64
_FACTOR = Fraction(3, 2)
Rows = Sequence[Sequence[Fraction]]


class Traced(NamedTuple):
    """A piece of an arc, with the matrix by which there is one zero for each value of the axis."""

    piece: Piece
    matrix: Rows

    @property
    def witness(self) -> dict[str, Any]:
        """What the checker needs."""
        return {
            "box": written(self.piece.box),
            "slope": texts(self.piece.slope),
            "matrix": [texts([*row]) for row in self.matrix],
        }


def thin(
    map_: Map, axis: int | None, guess: Sequence[Fraction], places: int
) -> tuple[Box, dict[str, Any]]:
    """Return a box 10^-places wide around a zero, at the guess's value of the axis; its witness."""
    bits, unit = places * 4 + 40, Fraction(1, 10**places)
    centre, rows = newton(map_, guess, axis=axis, bits=bits)
    box = tuple(
        (x, x) if k == axis else (round(x / unit) * unit - unit, round(x / unit) * unit + unit)
        for k, x in enumerate(centre)
    )
    matrix = _short(rows)
    require_zero(map_, box, matrix, axis=axis, bits=bits)
    return box, {"box": written(box), "matrix": [texts([*row]) for row in matrix]}


def follow(
    map_: Map,
    axis: int,
    start: Sequence[Fraction],
    end: Fraction,
    *,
    step: Fraction,
    most: int = 2000,
    accept: Callable[[Piece], None] = lambda piece: None,
) -> list[Traced]:
    """Return the pieces of an arc from a value of the axis, which grows, up to another one.

    start: about a point; accept: raises where a piece is not wanted, which is then halved. The arc
    ends before where no piece is short enough, or there are so many; Undecided if there is none.
    """
    pieces: list[Traced] = []
    place, longest = list(start), step
    while place[axis] < end and len(pieces) < most:
        ahead = min(step, end - place[axis])
        try:
            traced = _traced(map_, axis, place, ahead)
            if pieces:
                _require_joined(map_, axis, pieces[-1], traced)
            accept(traced.piece)
        except IntervalError as failure:
            step = ahead / 2 // _UNIT * _UNIT
            if step >= _SHORTEST:
                continue
            if pieces:
                break
            raise Undecided(str(failure)) from None
        pieces.append(traced)
        place = [*centre_of(traced.piece.cut(axis, place[axis] + ahead))]
        step = min(longest, step * _FACTOR // _UNIT * _UNIT)
    return pieces


def _traced(map_: Map, axis: int, place: Sequence[Fraction], ahead: Fraction) -> Traced:
    """Return a piece that begins at a value of the axis: it is widened until it holds one zero."""
    guess = list(place)
    guess[axis] += ahead / 2
    centre, rows = newton(map_, guess, axis=axis)
    matrix = _short(rows)
    with undecided():
        along = middles([row[axis] for row in map_.jacobian(enclosed(point_box(centre), _BITS))])
    changes = iter(_short([[-dot(row, along) for row in matrix]])[0])
    slope = tuple(Fraction(0) if k == axis else next(changes) for k in range(len(centre)))
    reach = dict.fromkeys(range(len(centre)), _FINE)
    for _ in range(_TRIES):
        box = tuple(
            (place[axis], place[axis] + ahead) if k == axis else _around(x, reach[k])
            for k, x in enumerate(centre)
        )
        image = krawczyk(map_, box, matrix, axis=axis, slope=slope)
        if all(box[k][0] < low and high < box[k][1] for k, (low, high) in image.items()):
            return Traced(Piece(box, slope), matrix)
        for k, (low, high) in image.items():
            reach[k] = _ROOM * max(abs(low - centre[k]), abs(high - centre[k]))
    raise Undecided("a box with one zero for each value of the axis is not found")


def _short(matrix: Rows) -> Rows:
    return [[Fraction(round(entry * _PLACES), _PLACES) for entry in row] for row in matrix]


def _around(value: Fraction, reach: Fraction) -> tuple[Fraction, Fraction]:
    return (value - reach) // _FINE * _FINE, -(-(value + reach) // _FINE) * _FINE


def _require_joined(map_: Map, axis: int, before: Traced, after: Traced) -> None:
    """Prove that both have the same zero where they meet; Undecided if not."""
    ends = [each.piece.cut(axis, after.piece.box[axis][0]) for each in (before, after)]
    with suppress(Undecided):
        require_zero(map_, ends[0], before.matrix, axis=axis, inside=ends[1])
        return
    require_zero(map_, ends[1], after.matrix, axis=axis, inside=ends[0])
