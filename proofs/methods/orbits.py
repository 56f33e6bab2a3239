"""All periodic points of an expanding map of the interval, one for each word, to any precision.

Theorem. Let I_0, ..., I_(k-1) be disjoint closed intervals within an interval I, f C^1 on each of
them with |f'| >= L > 1, and let f(I_j) contain I for every j.
(1) For each word w = w_0 ... w_(n-1) there is exactly one point p(w) with f^n(p) = p and
f^i(p) in I_(w_i) for i < n, and f(p(w)) = p(s w), where s w = w_1 ... w_(n-1) w_0.
Let x_i be in I_(w_i) for i < n, indices modulo n, p_i = f^i(p(w)), R_i = f(x_i) - x_(i+1) and
d_i = p_i - x_i.
(2) |d_i| <= max |R_j| / (L - 1).
(3) d_i = (d_(i+1) - R_i) / S_i with S_i a value of f' on the segment from x_i to p_i, on which f
lies between f(x_i) and p_(i+1). So d_0 = a + b d_0, where a and b come from a = 0, b = 1 by
a -> (a - R_i) / S_i, b -> b / S_i for i = n - 1, ..., 0, and |b| < 1.
(4) (f^n)'(p(w)) is the product of f' over p_0, ..., p_(n-1).

Proof. f is strictly monotone on I_j, and its inverse g_j: I -> I_j shrinks distances by 1/L at
least. A point is as in (1) exactly if it is fixed by g_(w_0) o ... o g_(w_(n-1)), which maps I
into itself and is a contraction: there is one. f takes it to a point with the itinerary s w and
of the same kind, which is p(s w). By the mean value theorem f(p_i) - f(x_i) = S_i d_i; the left
side is p_(i+1) - x_(i+1) - R_i = d_(i+1) - R_i: this is (3). Take the i with the largest |d_i|:
L |d_i| <= |d_i| + |R_i|: this is (2). (4) is the chain rule.

Each pass takes the middles of what is known for the x_i: the error is squared.

Source: the contraction principle for inverse branches, and the shadowing bound that follows
(Katok and Hasselblatt 1995, sections 1.7 and 6.1).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from intervals import Interval, Undecided
from intervals.rounding import float_down, float_up
from proofs.methods.words import Symbols, Words

Range = tuple[Fraction, Fraction]
Floats = NDArray[np.float64]

_MOST_SWEEPS = 500
_COARSE = 1e-9
_SPARE_DIGITS = 12  # of the points, beyond those that the multipliers shall have
_GUARD_BITS = 40


class ExpandingMap(Protocol):
    """A map for which the hypotheses of the theorem are proved, with I_j and L."""

    @property
    def domains(self) -> tuple[Range, ...]:
        """The intervals I_0, I_1, ..."""
        ...

    @property
    def expansion(self) -> Fraction:
        """A number L > 1 with |f'| >= L on all of them."""
        ...

    def approximate(self, symbols: Symbols, x: Floats) -> tuple[Floats, Floats]:
        """Return about f and f' at x[i] in the domain symbols[i]: candidates, never evidence."""
        ...

    def defect(self, symbol: int, x: Interval, y: Interval) -> Interval:
        """Enclose f(x) - y for x in the domain, known to its precision, and y near f(x)."""
        ...

    def slope(self, symbol: int, x: Interval, y: Interval) -> Interval:
        """Enclose f' at the points of x in the domain whose images lie in y."""
        ...


@dataclass(frozen=True)
class PeriodicPoint:
    """The point p(w), its minimal period, and (f^n)'(p(w)), n the length of w: proved bounds."""

    word: str
    period: int
    point: Range
    multiplier: Range


def periodic_points(
    expanding: ExpandingMap,
    words: Words,
    digits: int,
    tell: Callable[[str], None] = lambda stage: None,
) -> list[PeriodicPoint]:
    """Enclose p(w) and its multiplier for all words.

    A multiplier has a relative width of at most 10^-digits, and a point a width of at most that
    times the largest absolute value in its domain. Raises Undecided where that is not reached.
    """
    tell(f"{len(words.texts)} words in binary64")
    starts, symbols = find_points(expanding, words).tolist(), words.symbols.tolist()
    length, rows = len(words.texts[0]), dict[int, PeriodicPoint]()
    for cycle in words.cycles:
        tell(f"{len(rows)} of {len(words.texts)} words to {digits} digits")
        letters, first = [symbols[i] for i in cycle], [starts[i] for i in cycle]
        points, once = _enclose_orbit(expanding, letters, first, digits, length // len(cycle))
        for i, point in zip(cycle, points, strict=True):
            ends = (point.inf, point.sup), (once.inf, once.sup)
            rows[i] = PeriodicPoint(words.texts[i], len(cycle), *ends)
    return [rows[i] for i in range(len(words.texts))]


def find_points(expanding: ExpandingMap, words: Words) -> Floats:
    """Return about p(w), within the domains: x(w) moves to the preimage of x(s w), repeatedly."""
    low, high = (
        np.array([rounded(domain[end]) for domain in expanding.domains])[words.symbols]
        for end, rounded in enumerate((float_up, float_down))
    )
    x: Floats = 0.5 * (low + high)
    before = np.inf
    for _ in range(_MOST_SWEEPS):
        value, slope = expanding.approximate(words.symbols, x)
        moved: Floats = np.clip(x + (x[words.following] - value) / slope, low, high)
        change, x = float(np.max(np.abs(moved - x))), moved
        if not (change < before or change > _COARSE * np.max(np.abs(x))):
            break  # rounding is all that moves
        before = change
    if not ((low <= x) & (x <= high)).all():
        raise Undecided("no candidates for the periodic points are found in the domains")
    return x


def _enclose_orbit(
    expanding: ExpandingMap,
    symbols: Sequence[int],
    starts: Sequence[float],
    digits: int,
    power: int,
) -> tuple[list[Interval], Interval]:
    """Enclose the points of an orbit, and a power of its multiplier, by (2) to (4) pass by pass."""
    precision = (digits + _SPARE_DIGITS) * 10 // 3 + _GUARD_BITS
    domains = [Interval(*expanding.domains[j], precision=precision) for j in symbols]
    scales = [max(map(abs, expanding.domains[j])) / 10**digits for j in symbols]
    centres = [Interval.from_float(x, precision=precision) for x in starts]
    boxes = list[Interval]()
    before: Fraction | float = math.inf
    while True:
        ahead = [*centres[1:], centres[0]]
        defects = [expanding.defect(*each) for each in zip(symbols, centres, ahead, strict=True)]
        if not boxes:
            reach = max(defect.mag for defect in defects) / (expanding.expansion - 1)
            boxes = [_common(x.widen(reach), y) for x, y in zip(centres, domains, strict=True)]
        slopes = _slopes(expanding, symbols, centres, boxes, defects)
        moves = zip(centres, corrections(defects, slopes), boxes, strict=True)
        points = [_common(centre + move, box) for centre, move, box in moves]
        multiplier = math.prod(slopes[1:], start=slopes[0]) ** power
        fine = all(point.wid <= most for point, most in zip(points, scales, strict=True))
        if fine and multiplier.wid * 10**digits <= multiplier.mig:
            return points, multiplier
        widest = max(point.wid for point in points)
        if not fine and 2 * widest >= max(box.wid for box in boxes):
            raise Undecided(f"the points are known to {float(widest):.1e} only")
        if fine and 2 * multiplier.wid >= before:
            raise Undecided(f"a multiplier is known to {float(multiplier.wid):.1e} only")
        boxes, before = points, multiplier.wid
        centres = [Interval(point.mid, precision=precision) for point in points]


def _slopes(
    expanding: ExpandingMap,
    symbols: Sequence[int],
    centres: Sequence[Interval],
    boxes: Sequence[Interval],
    defects: Sequence[Interval],
) -> list[Interval]:
    """Enclose f' on the segments from x_i, in centres, to p_i, in boxes: the S_i of (3)."""
    ahead = [*range(1, len(boxes)), 0]
    return [
        expanding.slope(j, boxes[i].hull(centres[i]), boxes[k].hull(centres[k] + defects[i]))
        for i, (j, k) in enumerate(zip(symbols, ahead, strict=True))
    ]


def corrections(defects: Sequence[Interval], slopes: Sequence[Interval]) -> list[Interval]:
    """Enclose d_i for all points of an orbit from R_i and S_i, by (3)."""
    if not all(slope.mig > 1 for slope in slopes):
        raise Undecided("f is not proved to expand near the points")
    steps = list(zip(reversed(defects), reversed(slopes), strict=True))
    a, b = defects[0] * 0, defects[0] * 0 + 1
    for defect, slope in steps:
        a, b = (a - defect) / slope, b / slope
    shift, shifts = a / (1 - b), list[Interval]()
    for defect, slope in steps:
        shift = (shift - defect) / slope
        shifts.append(shift)
    return shifts[::-1]


def _common(x: Interval, y: Interval) -> Interval:
    common = x.intersection(y)
    if common is None:
        raise ArithmeticError("two enclosures of the same point are disjoint")
    return common
