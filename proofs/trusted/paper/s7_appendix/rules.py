"""Rule: Method I on a finite set. The other rules of the group are those about formulas."""

from __future__ import annotations

from fractions import Fraction
from math import inf

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.context import Context
from proofs.trusted.paper.s7_appendix.appendix import MethodOne

_MOST_POINTS = 6


def method_one(context: Context, reader: Reader) -> MethodOne:
    """Rule `method-one`: {points: n <= 6, sets: lists of points in increasing order, values}.

    The sets are different ones, the empty set with value 0 among them. Conclusion: `MethodOne`.
    Proof. If a value is < 0, every set that has a cover has covers with sums below any number,
    that set taken often enough. If not, a best cover uses no set twice, only sets that meet A, and
    one that contains the first point of A: outer(A) is the least value(T) + outer(A - T) over the
    T that contain that point.
    """
    points_of, sets_of, values_of = reader.fields("points", "sets", "values")
    points = points_of.number()
    if points.denominator != 1 or not 1 <= points <= _MOST_POINTS:
        raise points_of.fail(f"a whole number from 1 to {_MOST_POINTS} is expected")
    members = [item.numbers(0, _MOST_POINTS) for item in sets_of.items(1, 2**_MOST_POINTS)]
    for each in members:
        if list(each) != sorted(set(each)) or not set(each) <= set(range(int(points))):
            raise sets_of.fail("points of the set are expected, in increasing order")
    sets = tuple(frozenset(map(int, each)) for each in members)
    values = values_of.numbers(len(sets), len(sets))
    if len(set(sets)) != len(sets):
        raise sets_of.fail("a set is there twice")
    if (frozenset(), Fraction(0)) not in zip(sets, values, strict=True):
        raise sets_of.fail("the empty set with value 0 is expected")
    masks = [sum(1 << point for point in each) for each in sets]
    outer = _infima(int(points), dict(zip(masks, values, strict=True)))
    return MethodOne(int(points), sets, values, outer)


def _infima(points: int, values: dict[int, Fraction]) -> tuple[Fraction | float, ...]:
    """Return the infima over covers, for all subsets as bit masks."""
    best: list[Fraction | float] = [Fraction(0)]
    for wanted in range(1, 1 << points):
        first = wanted & -wanted
        sums = [value + best[wanted & ~mask] for mask, value in values.items() if mask & first]
        best.append(min(sums, default=inf))
    below = min(values.values()) < 0
    return tuple(-inf if below and value < inf else value for value in best)
