"""All periodic points of an expanding map of the interval, one for each word, to any precision.

Theorem. Let I_0, ..., I_(k-1) be disjoint closed intervals within an interval I, f C^1 on each of
them with |f'| >= L > 1, and let f(I_j) contain I for every j.
(1) For each word w = w_0 ... w_(n-1) there is exactly one point p(w) with f^n(p) = p and
f^i(p) in I_(w_i) for i < n, and f(p(w)) = p(s w), where s w = w_1 ... w_(n-1) w_0.
Let W be a finite set of words with s W = W, x(w) in I_(w_0) for w in W, R(w) = f(x(w)) - x(s w)
and d(w) = p(w) - x(w).
(2) |d(w)| <= max over W of |R| / (L - 1).
(3) d(w) lies in (D(s w) - R(w)) / S(w) if d(s w) lies in D(s w), and S(w), which does not contain
0, contains f' on the segment from x(w) to p(w).
(4) (f^n)'(p(w)) is the product of f' over p(w), p(s w), ..., p(s^(n-1) w).

Proof. f is strictly monotone on I_j, and its inverse g_j: I -> I_j shrinks distances by 1/L at
least. A point is as in (1) exactly if it is fixed by g_(w_0) o ... o g_(w_(n-1)), which maps I
into itself and is a contraction: there is one. f takes it to a point with the itinerary s w and
of the same kind, which is p(s w). By the mean value theorem f(p) - f(x) = f'(y) d(w) with y
between p and x; the left side is p(s w) - x(s w) - R(w) = d(s w) - R(w): this is (3). Take the w
with the largest |d|: L |d(w)| <= |d(w)| + |R(w)|: this is (2). (4) is the chain rule.

Since |f'| > 1 on them, each step of (3) gives more than it takes: R(w) alone must be known to
many digits, while S(w) on a box around p(w) may stay in binary64 and serves all precisions. Each
pass multiplies the error by the relative width of S, about 1e-12.

Source: the contraction principle for inverse branches, and the shadowing bound that follows
(Katok and Hasselblatt 1995, sections 1.7 and 6.1); (3) is one step of Gauss and Seidel's for
the cyclic interval Newton system.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from fractions import Fraction
from math import prod
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from intervals import Interval, IntervalArray, Undecided
from intervals.rounding import float_down, float_up
from proofs.methods.words import Symbols, Words

Range = tuple[Fraction, Fraction]
Floats = NDArray[np.float64]

_MOST_SWEEPS = 500
_COARSE = 1e-9
_SPARE_DIGITS = (6, 12, 24, 48)  # of the points, beyond those that the multipliers shall have
_GUARD_BITS = 40


class Germs(Protocol):
    """f near the points of an array of boxes, proved to be C^1 there; see `ExpandingMap.germs`."""

    @property
    def slopes(self) -> IntervalArray:
        """Enclosures of f' over the boxes, in their order."""
        ...

    def defect(self, index: int, x: Interval, y: Interval) -> Interval:
        """Enclose f(x) - y for x within the box `index` and y near f(x), at their precision."""
        ...

    def slope(self, index: int, x: Interval, y: Interval) -> Interval:
        """Enclose f' at the points of x, within the box `index`, whose image lies in y."""
        ...

    def defects(self, x: IntervalArray, y: IntervalArray) -> IntervalArray:
        """Enclose f(x) - y for all boxes at once, in binary64."""
        ...

    def slopes_at(self, x: IntervalArray, y: IntervalArray) -> IntervalArray:
        """Enclose f' likewise."""
        ...


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

    def defects(self, symbols: Symbols, x: Floats, y: Floats) -> IntervalArray:
        """Enclose f(x[i]) - y[i], where x[i] lies in the domain symbols[i]."""
        ...

    def germs(self, symbols: Symbols, boxes: IntervalArray) -> Germs:
        """Return f over narrow boxes, of which box i meets the domain symbols[i].

        A box exceeds its domain by less than the spacing of binary64.
        """
        ...


@dataclass(frozen=True)
class PeriodicPoint:
    """The point p(w), its minimal period, and (f^n)'(p(w)), n the length of w: proved bounds."""

    word: str
    period: int
    point: Range
    multiplier: Range


@dataclass(frozen=True)
class Isolated:
    """For each word a box that contains x(w) and p(w), with f over it, and one for p(w) alone."""

    boxes: IntervalArray
    germs: Germs
    points: IntervalArray


def periodic_points(
    of: ExpandingMap,
    words: Words,
    digits: int | None = None,
    tell: Callable[[str], None] = lambda stage: None,
) -> list[PeriodicPoint]:
    """Enclose p(w) and its multiplier for all words, in binary64 or to a number of digits.

    A multiplier then has a relative width of at most 10^-digits, and a point a width of at most
    that times the largest absolute value in its domain. Raises Undecided where that is not reached.
    """
    tell(f"{len(words.texts)} words in binary64")
    found = isolate(of, words)
    if digits is None:
        slopes = found.germs.slopes_at(found.points, found.points[words.following])
        return _listed(words, _ranges(found.points), _ranges(_products(slopes, words)))
    for spare in _SPARE_DIGITS:
        enclosed = refine(of, words, found, digits + spare, tell)
        tell(f"multipliers of {len(words.cycles)} orbits")
        exact = _multipliers(words, found.germs, enclosed)
        if all(x.wid * 10**digits <= x.mig for x in exact):
            return _listed(
                words, [(x.inf, x.sup) for x in enclosed], [(x.inf, x.sup) for x in exact]
            )
    raise Undecided(f"the multipliers are not found to {digits} digits")


def find_points(of: ExpandingMap, words: Words) -> Floats:
    """Return about p(w), within the domains: x(w) moves to the preimage of x(s w), repeatedly."""
    low, high = (
        np.array([rounded(domain[end]) for domain in of.domains])[words.symbols]
        for end, rounded in enumerate((float_up, float_down))
    )
    x: Floats = 0.5 * (low + high)
    before = np.inf
    for _ in range(_MOST_SWEEPS):
        value, slope = of.approximate(words.symbols, x)
        moved: Floats = np.clip(x + (x[words.following] - value) / slope, low, high)
        change, x = float(np.max(np.abs(moved - x))), moved
        if not (change < before or change > _COARSE * np.max(np.abs(x))):
            break  # rounding is all that moves
        before = change
    if not ((low <= x) & (x <= high)).all():
        raise Undecided("no candidates for the periodic points are found in the domains")
    return x


def isolate(of: ExpandingMap, words: Words) -> Isolated:
    """Enclose all points in binary64: candidates, boxes by (2), then (3) twice."""
    x = find_points(of, words)
    at = IntervalArray.from_floats(x)
    defects = of.defects(words.symbols, x, x[words.following])
    reach = Interval.from_float(float(defects.mag.max())) / (of.expansion - 1)
    ends = IntervalArray(list(of.domains))[words.symbols]
    boxes = at.widen(reach.sup).intersection(ends)
    if boxes is None:
        raise ArithmeticError("a candidate lies outside its domain")
    germs = of.germs(words.symbols, boxes)
    points = _moved(at, corrections(words, defects, germs.slopes), boxes)
    at = IntervalArray.from_floats(points.mid)
    defects = germs.defects(at, at[words.following])
    return Isolated(boxes, germs, _moved(at, corrections(words, defects, germs.slopes), boxes))


def _moved(x: IntervalArray, by: IntervalArray, boxes: IntervalArray) -> IntervalArray:
    moved = (x + by).intersection(boxes)
    if moved is None:
        raise ArithmeticError("two enclosures of the same point are disjoint")
    return moved


def corrections(words: Words, defects: IntervalArray, slopes: IntervalArray) -> IntervalArray:
    """Enclose d(w) = p(w) - x(w) for all words from R(w) and S(w): (2), and (3) until it stalls.

    L of (2) is the least |S| here: the proof of (2) uses f' on the segments of (3) only.
    """
    least = Interval.from_float(float(slopes.mig.min()))
    if not least.inf > 1:
        raise Undecided("f is not proved to expand near the points")
    reach = (Interval.from_float(float(defects.mag.max())) / (least - 1)).sup
    found = (defects * 0).widen(reach)
    while True:
        narrower = found.intersection((found[words.following] - defects) / slopes)
        if narrower is None:
            raise ArithmeticError("two enclosures of the same correction are disjoint")
        before, found = float(found.wid.max()), narrower
        if not float(found.wid.max()) < before * 0.5 * (1.0 + 1.0 / float(least.inf)):
            return found


def refine(
    of: ExpandingMap,
    words: Words,
    found: Isolated,
    digits: int,
    tell: Callable[[str], None] = lambda stage: None,
) -> list[Interval]:
    """Enclose the points to a number of digits: (2) and (3) from better x(w), pass by pass."""
    precision = digits * 10 // 3 + _GUARD_BITS
    boxes = [box.with_precision(precision) for box in found.boxes.tolist()]
    points = [point.with_precision(precision) for point in found.points.tolist()]
    following, symbols = words.following.tolist(), words.symbols.tolist()
    scales = [max(abs(end) for end in domain) / 10**digits for domain in of.domains]
    wanted = [scales[symbol] for symbol in symbols]
    before = max(point.wid for point in points)
    while any(point.wid > width for point, width in zip(points, wanted, strict=True)):
        tell(f"{len(points)} points known to {float(before):.0e}, to refine to {digits} digits")
        centres = [Interval(point.mid, precision=precision) for point in points]
        defects = [
            found.germs.defect(i, centre, centres[following[i]]) for i, centre in enumerate(centres)
        ]
        moves = _scaled_corrections(words, defects, found.germs.slopes)
        points = [
            _common(centre + move, box)
            for centre, move, box in zip(centres, moves, boxes, strict=True)
        ]
        widest = max(point.wid for point in points)
        if 2 * widest > before:
            raise Undecided(f"the points are known to {float(widest):.1e} only")
        before = widest
    return points


def _scaled_corrections(
    words: Words, defects: list[Interval], slopes: IntervalArray
) -> list[Interval]:
    """Do `corrections` for defects of any size: they are linear in a common factor 2^k."""
    largest = max(defect.mag for defect in defects)
    if largest == 0:
        return defects
    exponent = largest.numerator.bit_length() - largest.denominator.bit_length()
    up, down = (Interval(Fraction(2) ** k, precision=2) for k in (-exponent, exponent))
    scaled = IntervalArray([defect * up for defect in defects])
    return [move * down for move in corrections(words, scaled, slopes).tolist()]


def _common(x: Interval, y: Interval) -> Interval:
    common = x.intersection(y)
    if common is None:
        raise ArithmeticError("two enclosures of the same point are disjoint")
    return common


def _products(slopes: IntervalArray, words: Words) -> IntervalArray:
    """Return the products of (4) from f' at each point."""
    total, index = slopes, words.following
    for _ in words.texts[0][1:]:
        total, index = total * slopes[index], words.following[index]
    return total


def _multipliers(words: Words, germs: Germs, points: list[Interval]) -> list[Interval]:
    """Return the products of (4) from narrow enclosures of the points, once for each orbit."""
    found, length = list(points), len(words.texts[0])
    for cycle in words.cycles:
        ahead = (*cycle[1:], cycle[0])
        slopes = [germs.slope(i, points[i], points[j]) for i, j in zip(cycle, ahead, strict=True)]
        once = prod(slopes[1:], start=slopes[0])
        for i in cycle:
            found[i] = once ** (length // len(cycle))
    return found


def _ranges(values: IntervalArray) -> list[Range]:
    bounds = zip(values.inf.tolist(), values.sup.tolist(), strict=True)
    return [(Fraction(low), Fraction(high)) for low, high in bounds]


def _listed(
    words: Words, points: Iterable[Range], multipliers: Iterable[Range]
) -> list[PeriodicPoint]:
    periods = {i: len(cycle) for cycle in words.cycles for i in cycle}
    rows = zip(words.texts, points, multipliers, strict=True)
    return [PeriodicPoint(text, periods[i], p, m) for i, (text, p, m) in enumerate(rows)]
