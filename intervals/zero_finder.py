"""All zeros of n equations in n variables in a box, by branch and bound with Krawczyk's operator.

See `search` for what a box and a function may be.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from fractions import Fraction
from functools import partial
from math import inf
from time import monotonic
from typing import TypeAlias

import numpy as np

from intervals.array import IntervalArray, Mask
from intervals.branch import (
    Bounds,
    Boxes,
    Given,
    all_of,
    as_box,
    clusters,
    evaluated,
    join,
    larger,
    meets,
    one_box,
    select,
    shaved,
    split,
)
from intervals.contractor import contracted
from intervals.errors import DomainError
from intervals.formula import Formula
from intervals.generic import meet
from intervals.interval import Interval
from intervals.jet import Jet
from intervals.operators import SystemResult, contract, krawczyk
from intervals.rounding import MAX
from intervals.systems import Function, Roots, components

_NEAR = 2.0**-18  # of a side of the given box
_FINITE = IntervalArray.from_floats([-MAX], [MAX])
_MOST_DERIVATIVES = 8
Demand: TypeAlias = "tuple[Formula, list[IntervalArray]]"


@np.errstate(over="ignore")  # widths may be inf
def zeros(
    f: Function,
    box: Given,
    *,
    where: Function | None = None,
    tolerance: float = 2.0**-38,
    limit: int = 100_000,
    seconds: float = inf,
) -> list[SystemResult]:
    """Return boxes that together contain all zeros of f in the given box, sorted.

    where: a formula g; only zeros with g >= 0, in all components, are asked for, and others may or
    may not be in the list.

    Theorem. The rest of the given box is free of zeros. A box with the outcome UNIQUE contains
    exactly one zero in the given box, and two such boxes different ones; AT_LEAST_ONE and UNDECIDED
    are as in `krawczyk`, and may also be about a zero of another box. No box: no zero.

    Proof. Each sub-box X is cut by `contracted` and `shaved`, and replaced by its common part with
    the Krawczyk image of a larger X', which has all zeros of X' and thus of X. Where there is
    exactly one in X', X is done, and so is each sub-box within X'. A zero on the common face of two
    sub-boxes is inside the larger boxes of both, and may be found twice: if the box of one zero is
    within the larger box of another, the two are the same. Sub-boxes whose sides are below
    `tolerance` times those of the given box, once that is cut, and those left after `limit` ones,
    or after so many seconds, are tried like the others, in larger boxes yet: a side cut to almost
    nothing leaves no room for the rounding of the others. Then they are joined where they meet and
    examined by `krawczyk`; those where nothing is decided once more where they are near to each
    other, and by `_multiple`.
    """
    end = monotonic() + seconds
    given = one_box(box)
    nothing = select(given, slice(0))
    found, small = [nothing], [nothing]
    waiting, scale = given, None
    f = Formula(f, len(given))
    demands = [_demand(f, IntervalArray([0]))]
    if where is not None:
        region = IntervalArray.from_floats([0.0], [inf])
        demands.append(_demand(Formula(where, len(given)), region))
    while len(waiting[0]):
        limit -= len(waiting[0])
        for demand in demands:
            waiting = _cut(demand, waiting)
        if not len(waiting[0]):
            break
        scale = scale or waiting
        if monotonic() > end:
            limit = 0
        more, waiting = _round(f, waiting)
        found += more
        for around in found[1:]:
            waiting = select(waiting, ~_inside(waiting, around))
        halves, cut = split(waiting, scale, tolerance if limit > 0 else inf)
        small.append(select(waiting, ~cut))
        waiting = halves
    left, near = join(small), np.array([min(float(x.wid[0]), MAX) * _NEAR for x in scale or given])
    wider = [tuple(map(_wider, hull, near)) for hull in _hulls(left, near)]
    for around in _round(f, join([nothing, *wider]))[0]:
        left = select(left, ~_inside(left, around))
        found.append(around)
    zero, unclear = _distinct(f, join(found))
    left = join([left, _common(select(unclear, meets(unclear, given)), given)])
    results = [r for one in _each(zero) for r in _in_given(f, one, given)]
    results += _examined(f, left, zero, near)
    return sorted(results, key=lambda result: [x.inf for x in result.box or ()])


def _demand(formula: Formula, target: IntervalArray) -> Demand:
    return formula, [target] * len(formula.outputs)


def _cut(demand: Demand, boxes: Boxes) -> Boxes:
    """Return parts of the boxes with all that fulfil the demand."""
    formula, targets = demand

    def contract(x: Boxes) -> tuple[Boxes, Mask]:
        return contracted(formula, x, targets)

    rest = [select(boxes, slice(0))]
    for part, answer in evaluated(contract, boxes):
        smaller, empty = answer or (select(boxes, part), np.zeros(1, dtype=bool))
        rest.append(select(smaller, ~empty))
    smaller, empty = shaved(contract, join(rest))
    return select(smaller, ~empty)


def _round(f: Function, boxes: Boxes) -> tuple[list[Boxes], Boxes]:
    """Return larger boxes with exactly one zero, and what remains of the boxes inside no such.

    Where f and its Jacobian have no enclosure on a larger box, the box itself is tried; if they
    have none there either, it remains unless f alone excludes 0.
    """
    operator = partial(contract, f, steps=2)
    found, rest = [], []
    for part, answer in evaluated(operator, tuple(map(larger, boxes))):
        here = select(boxes, part)
        around = tuple(map(larger, here)) if answer else here
        final = answer or next(evaluated(operator, here))[1]
        if final is None:
            if _may_vanish(f, here):
                rest.append(here)
            continue
        none, unique, image = final
        found += _each(select(around, unique))
        rest.append(select(_common(here, image), ~none & ~unique & meets(here, image)))
    return found, join(rest)


def _may_vanish(f: Function, boxes: Boxes) -> bool:
    """Whether f over one box has no enclosure, or one that contains 0."""
    ((_, values),) = evaluated(lambda x: components(f(*x)), boxes)
    return values is None or all(y.contains_zero() for y in values)


def _each(boxes: Boxes) -> list[Boxes]:
    return [select(boxes, slice(i, i + 1)) for i in range(len(boxes[0]))]


def _common(boxes: Boxes, other: Boxes) -> Boxes:
    """Return the common parts, where the boxes meet."""
    return tuple(meet(x, y) for x, y in zip(boxes, other, strict=True))


def _inside(boxes: Boxes, other: Boxes) -> Mask:
    """Return which boxes are subsets of another one."""
    return all_of(x.subset(y) for x, y in zip(boxes, other, strict=True))


def _distinct(f: Function, around: Boxes) -> tuple[Boxes, Boxes]:
    """Contract boxes with exactly one zero each: to different ones, and to possible repetitions."""
    count = len(around[0])
    if not count:
        return around, around
    zero = contract(f, around, steps=60)[2]
    distinct, unclear = np.zeros((2, count), dtype=bool)
    for i, (one, near) in enumerate(zip(_each(zero), _each(around), strict=True)):
        same = _inside(one, around) | _inside(zero, near)
        if not (same & distinct).any():
            unclear[i] = (meets(zero, one) & distinct).any()
            distinct[i] = not unclear[i]
    return select(zero, distinct), select(zero, unclear)


def _in_given(f: Function, zero: Boxes, given: Boxes) -> list[SystemResult]:
    """Return what is known of a zero, the only one in its box, as one in the given box."""
    reason = "exactly one zero in a larger box"
    if _inside(zero, given):
        return [SystemResult(Roots.UNIQUE, as_box(zero, 0), reason)]
    if not meets(zero, given):
        return []
    outcome, box, why = krawczyk(f, as_box(_common(zero, given), 0))
    if outcome is Roots.NONE:
        return []
    if outcome is Roots.UNDECIDED:
        if point := _rational_zero(f, box):
            return [SystemResult(Roots.UNIQUE, point, f"{reason}, which f takes exactly here")]
        return [SystemResult(outcome, box, f"{reason}, at the boundary of the given box")]
    return [SystemResult(Roots.UNIQUE, box, f"{reason}, {why} here")]


def _rational_zero(f: Function, box: Sequence[Interval] | None) -> tuple[Interval, ...] | None:
    """Return a zero of small denominators in the box; None if f is no formula for Fractions."""
    point = [x.mid.limit_denominator(1000) for x in box or ()]
    if box and all(x.contains(value) for x, value in zip(box, point, strict=True)):
        with suppress(AttributeError, TypeError, ZeroDivisionError):
            if all(y == 0 and isinstance(y, int | Fraction) for y in components(f(*point))):
                return tuple(map(Interval, point))
    return None


def _wider(x: IntervalArray, reach: float) -> IntervalArray:
    return meet(x + IntervalArray.from_floats([-reach], [reach]), _FINITE)


def _examined(f: Formula, boxes: Boxes, zero: Boxes, near: Bounds) -> list[SystemResult]:
    """Join boxes that meet, and return what is known of each hull that may have a zero."""
    open_, results = _hulls(boxes, np.zeros(len(boxes))), []
    for hull in open_:
        if result := _known(f, hull, zero):
            results.append(result)
    vague = [r for r in results if r.outcome is Roots.UNDECIDED and r.box]
    if len(vague) > 1:  # around a multiple zero there are gaps between them
        sides = zip(*(r.box or () for r in vague), strict=True)
        for hull in _hulls(tuple(IntervalArray(list(side)) for side in sides), near):
            inside = [r for r in vague if _inside(_boxes(r), hull).all()]
            if len(inside) > 1 and not meets(zero, hull).any() and (one := _known(f, hull, zero)):
                results = [r for r in results if r not in inside] + [one]
    return [_multiple(f, r) for r in results]


def _boxes(result: SystemResult) -> Boxes:
    return tuple(IntervalArray([side]) for side in result.box or ())


def _hulls(boxes: Boxes, near: Bounds) -> list[Boxes]:
    """Return the hulls of groups of boxes that are as near as this to each other."""
    lower = np.stack([x.inf for x in boxes], axis=-1)
    upper = np.stack([x.sup for x in boxes], axis=-1)
    groups = [members for _, _, members in clusters(lower - near, upper + near)]
    ends = ((lower[g].min(axis=0), upper[g].max(axis=0)) for g in groups)
    return [
        tuple(IntervalArray.from_floats([a], [b]) for a, b in zip(low, high, strict=True))
        for low, high in ends
    ]


def _known(f: Formula, hull: Boxes, zero: Boxes) -> SystemResult | None:
    """Return what is known of a hull, None if it has no zero but those that are known."""
    try:
        outcome, box, reason = krawczyk(f, as_box(hull, 0))
    except (DomainError, OverflowError) as error:
        outcome, box, reason = Roots.UNDECIDED, as_box(hull, 0), str(error)
    if outcome is Roots.UNIQUE:
        if _inside(zero, hull).any():
            return None
        if meets(zero, hull).any():
            outcome, reason = Roots.UNDECIDED, "perhaps the zero of another box"
    return None if outcome is Roots.NONE else SystemResult(outcome, box, reason)


def _multiple(f: Formula, result: SystemResult) -> SystemResult:
    """Return the result, or that there is one zero p, of multiplicity k, where this is proved.

    Theorem. If f, of one variable, has k derivatives on X, the first of which, and f itself, but
    not the last one, vanish at p in X, and the last one nowhere on X, p is the only zero of f in X:
    by Taylor's formula f(x) is (x - p)^k times a value of the k-th derivative over k!. Fractions
    show where derivatives vanish; p is one of small denominator.
    """
    if result.outcome is Roots.UNIQUE or len(result.box or ()) != 1:
        return result
    (x,) = result.box or ()
    p = x.mid.limit_denominator(1000)
    with suppress(AttributeError, TypeError, ArithmeticError):
        exact = f.only(Jet.variable(p, _MOST_DERIVATIVES)).coefficients
        k = next((i for i, c in enumerate(exact) if c != 0), 0)
        last = f.only(Jet.variable(x, k)).coefficients[k]
        if k > 1 and x.contains(p) and not last.contains_zero():
            return SystemResult(Roots.UNIQUE, (Interval(p),), f"one zero, of multiplicity {k}")
    return result
