"""Enclose the minimum and the maximum of a differentiable function on an interval."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from heapq import heappop, heappush
from itertools import pairwise
from math import inf
from operator import attrgetter
from typing import TYPE_CHECKING, NamedTuple

from intervals.errors import DomainError, Undecided

if TYPE_CHECKING:
    from intervals import Interval

Range = tuple[Fraction, Fraction]


class Extremes(NamedTuple):
    """g at points low = x_0 < ... < x_n = high, and enclosures of g over the n pieces between."""

    points: tuple[Fraction, ...]
    values: tuple[Interval, ...]
    pieces: tuple[Interval, ...]

    @property
    def minimum(self) -> Range:
        """Bounds on min g: the least lower bound of a piece, the least upper one at a point."""
        return min(p.inf for p in self.pieces), min(v.sup for v in self.values)

    @property
    def maximum(self) -> Range:
        """Bounds on max g."""
        return max(v.inf for v in self.values), max(p.sup for p in self.pieces)


def piece_range(left: Interval, right: Interval, slope: Interval, width: Fraction) -> Interval:
    """Enclose g over [x, x + width] from g(x), g(x + width) and g' over the piece.

    g lies in g(x) + g' [0, w] and in g(x + w) - g' [0, w] (mean value theorem, both ends); where
    g' has one sign, the intersection is the hull of the two values: no loss by monotonicity.
    """
    reach = slope * type(slope)(0, width, precision=slope.precision)
    common = (left + reach).intersection(right - reach)
    if common is None:
        raise Undecided("the enclosures of a piece contradict each other")
    return common


class _Piece(NamedTuple):
    """A piece, what orders it among others (the widest first), and g over it if that is known."""

    order: Fraction | float
    low: Fraction
    high: Fraction
    values: Interval | None
    obstacle: str = ""


def extremes(
    g: Callable[[Fraction], Interval],
    dg: Callable[[Fraction, Fraction], Interval],
    points: Sequence[Fraction],
    tolerance: Fraction = Fraction(1, 10**12),
    most: int = 400,
) -> Extremes:
    """Enclose min g and max g over [points[0], points[-1]].

    A piece is final where g' has one sign on it, where its range is narrower than `tolerance`,
    or where values of g elsewhere make it useless for both extremes; of the others, that of the
    widest range is halved, first those on which dg raises DomainError. When there are `most`
    pieces, they stay as wide as they are: the bounds hold all the same. Raises Undecided if dg
    has no answer then.
    """
    known: dict[Fraction, Interval] = {}
    done: list[_Piece] = []
    waiting: list[_Piece] = []

    def at(x: Fraction) -> Interval:
        if x not in known:
            known[x] = g(x)
        return known[x]

    def examine(low: Fraction, high: Fraction) -> None:
        try:
            slope = dg(low, high)
        except DomainError as error:
            heappush(waiting, _Piece(-inf, low, high, None, str(error)))
            return
        values = piece_range(at(low), at(high), slope, high - low)
        piece = _Piece(-values.wid, low, high, values)
        if not slope.contains_zero() or values.wid < tolerance:
            done.append(piece)
        else:
            heappush(waiting, piece)

    def useless(values: Interval) -> bool:
        least, greatest = min(v.sup for v in known.values()), max(v.inf for v in known.values())
        return least <= values.inf and values.sup <= greatest

    for low, high in pairwise(points):
        examine(low, high)
    while waiting and len(done) + len(waiting) < most:
        piece = heappop(waiting)
        if piece.values is not None and useless(piece.values):
            done.append(piece)
            continue
        middle = (piece.low + piece.high) / 2
        examine(piece.low, middle)
        examine(middle, piece.high)
    if waiting and waiting[0].values is None:
        raise Undecided(f"on one of {most} pieces: {waiting[0].obstacle}")
    done = sorted(done + waiting, key=attrgetter("low"))
    ends = (*(piece.low for piece in done), points[-1])
    ranges = tuple(piece.values for piece in done if piece.values is not None)
    return Extremes(ends, tuple(at(x) for x in ends), ranges)
