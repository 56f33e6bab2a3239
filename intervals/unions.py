"""Unions of intervals, as lists in order of disjoint ones; division by intervals that contain 0."""

from __future__ import annotations

from collections.abc import Iterable

from intervals.interval import Interval


def union(parts: Iterable[Interval]) -> list[Interval]:
    """Return disjoint intervals, in order, with the same union."""
    result: list[Interval] = []
    for part in sorted(parts, key=lambda x: x.inf):
        if result and part.inf <= result[-1].sup:
            result[-1] = result[-1].hull(part)
        else:
            result.append(part)
    return result


def quotients(z: Interval, v: Interval, within: Interval) -> list[Interval]:
    """Return what there is in `within` of {x : x y in Z for some y in V}: none to two intervals.

    Theorem. They contain each such x. Proof. If 0 is not in V, x = z / y for some z and y. If 0 is
    in V and in Z every x is one. Else let Z > 0, or take -Z and -V: y < 0 gives
    x = z / y <= inf Z / inf V, y > 0 gives x >= inf Z / sup V, and y = 0 none.
    """
    if not v.contains_zero():
        common = (z / v).intersection(within)
        return [] if common is None else [common]
    if z.contains_zero():
        return [within]
    if z.sup < 0:
        z, v = -z, -v
    least, parts = Interval(z.inf, precision=within.precision), []
    if v.inf < 0:
        end = (least / Interval(v.inf, precision=within.precision)).sup
        parts.append((within.inf, min(end, within.sup)))
    if v.sup > 0:
        end = (least / Interval(v.sup, precision=within.precision)).inf
        parts.append((max(end, within.inf), within.sup))
    some = (ends for ends in parts if ends[0] <= ends[1])
    return union(Interval(*ends, precision=within.precision) for ends in some)
