"""Enclose the minimum and the maximum of a differentiable function on an interval."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from operator import itemgetter

from intervals import DomainError, Interval, Undecided

Range = tuple[Fraction, Fraction]


@dataclass(frozen=True)
class Extremes:
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
    reach = slope * Interval(0, width, precision=slope.precision)
    common = (left + reach).intersection(right - reach)
    if common is None:
        raise Undecided("the enclosures of a piece contradict each other")
    return common


def extremes(
    g: Callable[[Fraction], Interval],
    dg: Callable[[Fraction, Fraction], Interval],
    points: Sequence[Fraction],
    tolerance: Fraction = Fraction(1, 10**12),
    most: int = 400,
) -> Extremes:
    """Enclose min g and max g over [points[0], points[-1]].

    A piece is final where g' has one sign on it, where its range is narrower than `tolerance`,
    or where values of g elsewhere make it useless for both extremes; others, and those on which
    dg raises DomainError, are halved, widest first. When there are `most` pieces, they stay as
    wide as they are: the bounds hold all the same. Raises Undecided if dg has no answer then.
    """
    known: dict[Fraction, Interval] = {}
    done: list[tuple[Range, Interval]] = []
    waiting = deque(pairwise(points))

    def at(x: Fraction) -> Interval:
        if x not in known:
            known[x] = g(x)
        return known[x]

    def final(values: Interval, slope: Interval) -> bool:
        if not slope.contains_zero() or values.wid < tolerance:
            return True
        least, greatest = min(v.sup for v in known.values()), max(v.inf for v in known.values())
        return least <= values.inf and values.sup <= greatest

    while waiting:
        low, high = waiting.popleft()
        full = len(done) + len(waiting) + 1 >= most
        middle = (low + high) / 2
        try:
            slope = dg(low, high)
        except DomainError as error:
            if full:
                raise Undecided(f"on one of {most} pieces: {error}") from None
            waiting += [(low, middle), (middle, high)]
            continue
        values = piece_range(at(low), at(high), slope, high - low)
        if full or final(values, slope):
            done.append(((low, high), values))
        else:
            waiting += [(low, middle), (middle, high)]
    done.sort(key=itemgetter(0))
    ends = (*(low for (low, _), _ in done), points[-1])
    return Extremes(ends, tuple(at(x) for x in ends), tuple(values for _, values in done))
