"""Branch and bound over many boxes at once: the sign and the range of a function on a box.

A box is an Interval, or a list of n, with endpoints in binary64 (another raises ValueError). f is
a formula of n numbers that takes IntervalArrays and jets of them. Where f is not C^1, its
derivatives have no enclosure (DomainError), and it is used without them; where it has none itself
(DomainError, OverflowError), the sub-box is split like one that is not decided. Each search ends
after about `limit` sub-boxes, with what it has proved by then.
"""

from __future__ import annotations

from collections.abc import Callable
from enum import Enum
from fractions import Fraction
from math import inf
from typing import NamedTuple

import numpy as np

from intervals.branch import Bounds, Boxes, Given, evaluated, join, one_box, select, split
from intervals.errors import DomainError
from intervals.formula import Formula
from intervals.generic import ends, middle, where
from intervals.interval import Interval
from intervals.systems import Function, components, jacobian

_SMALLEST = 2.0**-48  # in proportion to the given box


class Sign(Enum):
    """What is proved about the sign of f in the given box."""

    POSITIVE = "f > 0"
    NEGATIVE = "f < 0"
    ZERO = "f has a zero"
    UNDECIDED = "not decided"


class SignResult(NamedTuple):
    """The sign, and bounds lower <= f <= upper on the box; upper is None if it was not needed."""

    sign: Sign
    lower: float
    upper: float | None


class Range(NamedTuple):
    """The range of f lies in outer; inner, if there is one, lies in the range of f."""

    outer: Interval
    inner: Interval | None


def sign_of(f: Function, box: Given, *, limit: int = 100_000) -> SignResult:
    """Decide whether f > 0 on the box, f < 0, or f has a zero.

    Theorem. If f is continuous, f < 0 at one point of a box and f > 0 at another, then f has a
    zero there, as a box is connected. Where f touches 0, nothing is decided.
    """
    formula, given = _scalar(f, box)
    low, some_low = _least(formula, given, lambda found: 0.0, limit)
    if low > 0:
        return SignResult(Sign.POSITIVE, low, None)
    high, some_high = _least(lambda *x: -formula.only(*x), given, lambda found: 0.0, limit)
    if high > 0:
        return SignResult(Sign.NEGATIVE, low, -high)
    zero = some_low < 0 and some_high < 0
    return SignResult(Sign.ZERO if zero else Sign.UNDECIDED, low, -high)


def range_of(
    f: Function, box: Given, tolerance: float = 2.0**-30, *, limit: int = 100_000
) -> Range:
    """Enclose the range of f over the box from outside and, if f is continuous, from inside.

    f takes values at or below inner.inf and at or above inner.sup at two points of the box, so it
    takes all between. Unless the limit or rounding ends the search, the ends of the two intervals
    differ by at most `tolerance`.
    """
    formula, given = _scalar(f, box)
    low, some_low = _least(formula, given, lambda found: found - tolerance, limit)
    high, some_high = _least(
        lambda *x: -formula.only(*x), given, lambda found: found - tolerance, limit
    )
    outer = Interval(Fraction(low), Fraction(-high))
    if some_low > -some_high:
        return Range(outer, None)
    return Range(outer, Interval(Fraction(some_low), Fraction(-some_high)))


def _scalar(f: Function, box: Given) -> tuple[Formula, Boxes]:
    """Return f as a formula of one value, and the box as an array of one."""
    given = one_box(box)
    formula = Formula(f, len(given))
    if len(formula.outputs) != 1:
        raise ValueError(f"a function with one value, not {len(formula.outputs)}")
    return formula, given


def _least(
    f: Function, given: Boxes, goal: Callable[[float], float], limit: int
) -> tuple[float, float]:
    """Return (lower, found): f >= lower on the box, f <= found at one of its points.

    A sub-box with f > goal(found) is not split; the search ends early if found < goal(found).
    DomainError if a sub-box without enclosure remains.
    """
    waiting = given
    lower = found = inf
    while len(waiting[0]):
        parts, lows = [], []
        for part, answer in evaluated(lambda boxes: _bounds(f, boxes), waiting):
            limit -= part.stop - part.start
            here = select(waiting, part)
            known = answer or next(evaluated(lambda boxes: _natural(f, boxes), here))[1]
            low, some, smaller = known or (np.array([-inf]), inf, here)
            found = min(found, some)
            parts.append(smaller)
            lows.append(low)
        waiting, low = join(parts), np.concatenate(lows)
        going = ~(low > goal(found)) & (limit > 0 and not found < goal(found))
        halves, cut = split(select(waiting, going), given, _SMALLEST)
        going[going] = cut
        lower = min(lower, low[~going].min(initial=inf))
        waiting = halves
    if lower == -inf:
        raise DomainError("f has no enclosure on some of the sub-boxes")
    return float(lower), found


def _natural(f: Function, boxes: Boxes) -> tuple[Bounds, float, Boxes]:
    """Do the same as `_bounds` without derivatives, which may not exist."""
    (value,), (at_point,) = (components(f(*x)) for x in (boxes, [middle(x) for x in boxes]))
    return value.inf, float(at_point.sup.min()), boxes


def _bounds(f: Function, boxes: Boxes) -> tuple[Bounds, float, Boxes]:
    """Return lower bounds of f, its least upper bound at a point, and parts with the same minima.

    If df/dx_j >= 0 on X, the minimum over X is one over the face x_j = inf; likewise for <= 0. On
    what remains, f(x) lies in f(m) + sum of (df/dx_j)(X) (X_j - m_j).
    """
    (value,), (slopes,) = jacobian(f, boxes)
    part = []
    for x, slope in zip(boxes, slopes, strict=True):
        left, right = ends(x)
        part.append(where(slope.inf >= 0, left, where(slope.sup <= 0, right, x)))
    points = [middle(x) for x in part]
    (mean,) = at_points = components(f(*points))
    for x, m, slope in zip(part, points, slopes, strict=True):
        mean = mean + slope * (x - m)
    return np.maximum(value.inf, mean.inf), float(at_points[0].sup.min()), tuple(part)
