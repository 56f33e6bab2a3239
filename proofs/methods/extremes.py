"""Enclose the minimum and the maximum of a differentiable function on an interval."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from heapq import heappop, heappush
from itertools import pairwise
from math import inf
from operator import attrgetter
from typing import NamedTuple

from intervals.errors import DomainError, Undecided
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.numbers import Range, mean_values


class Extremes(NamedTuple):
    """g at points low = x_0 < ... < x_n = high, and enclosures of g over the n pieces between."""

    points: tuple[Fraction, ...]
    values: tuple[Range, ...]
    pieces: tuple[Range, ...]

    @property
    def minimum(self) -> Range:
        """Bounds on min g: the least lower bound of a piece, the least upper one at a point."""
        return min(low for low, _ in self.pieces), min(high for _, high in self.values)

    @property
    def maximum(self) -> Range:
        """Bounds on max g."""
        return max(low for low, _ in self.values), max(high for _, high in self.pieces)


class _Piece(NamedTuple):
    """A piece, what orders it among others (the widest first), and g over it if that is known."""

    order: Fraction | float
    low: Fraction
    high: Fraction
    values: Range | None
    obstacle: str = ""


def extremes(
    g: Callable[[Fraction], Range],
    dg: Callable[[Fraction, Fraction], Range],
    points: Sequence[Fraction],
    tolerance: Fraction = Fraction(1, 10**12),
    most: int = 400,
) -> Extremes:
    """Enclose min g and max g over [points[0], points[-1]].

    A piece is final where g' has one sign on it, or where its range is narrower than `tolerance`;
    of the others, that of the widest range is halved, first those on which dg raises. When there
    are `most` pieces, they stay as wide as they are: the bounds hold all the same. Raises Undecided
    if dg has no answer then.
    """
    at_points: dict[Fraction, Range] = {}
    done: list[_Piece] = []
    waiting: list[_Piece] = []

    def at(x: Fraction) -> Range:
        if x not in at_points:
            at_points[x] = g(x)
        return at_points[x]

    def examine(low: Fraction, high: Fraction) -> None:
        try:
            slope = dg(low, high)
        except (DomainError, Unproved) as error:
            heappush(waiting, _Piece(-inf, low, high, None, str(error)))
            return
        values = mean_values(at(low), at(high), slope, high - low)
        width = values[1] - values[0]
        piece = _Piece(-width, low, high, values)
        if not slope[0] <= 0 <= slope[1] or width < tolerance:
            done.append(piece)
        else:
            heappush(waiting, piece)

    for low, high in pairwise(points):
        examine(low, high)
    while waiting and len(done) + len(waiting) < most:
        piece = heappop(waiting)
        middle = (piece.low + piece.high) / 2
        examine(piece.low, middle)
        examine(middle, piece.high)
    if waiting and waiting[0].values is None:
        raise Undecided(f"on one of {most} pieces: {waiting[0].obstacle}")
    done = sorted(done + waiting, key=attrgetter("low"))
    ends = (*(piece.low for piece in done), points[-1])
    ranges = tuple(piece.values for piece in done if piece.values is not None)
    return Extremes(ends, tuple(at(x) for x in ends), ranges)
