"""What is drawn over the cells: curves of single-impact orbits, in closed form or proved here."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import suppress
from fractions import Fraction
from itertools import pairwise
from typing import NamedTuple

from proofs.report.figures.curves import along, closed
from proofs.report.figures.figure import all_of
from proofs.search.curves import Curves, Seen, seen_curves
from proofs.search.evidence import FAILED
from proofs.trusted.atlas import Region
from proofs.trusted.kernel.context import Context
from proofs.trusted.paper.beyond.grazing import GrazingCurve, nu_squared, ratio
from proofs.trusted.paper.beyond.meetings import Meeting
from proofs.trusted.subjects import Oscillators

PERIODS = 5  # of the table, at most, between the impacts of an orbit
GRAZING = "grazing"
_MOST_SEEN = 80  # points of curves of grazing that are seen, for which proofs are looked for
_MANY = 5  # windows between multiples of 1/(2 n)
Points = list[tuple[float, float]]


class Line(NamedTuple):
    """A piece of a curve: of what, of orbits with one impact in n table periods, and where."""

    name: str
    n: int
    points: Points


class Overlay(NamedTuple):
    """Lines, and proved points at which two of them meet."""

    lines: list[Line]
    meetings: Points


def overlay(region: Region) -> Overlay:
    """Return the curves that pass through a region; none for a range of epsilon."""
    if not isinstance(region.subject, Oscillators):
        return Overlay([], [])
    least, epsilon = region.subject.epsilon or (Fraction(0),) * 2
    if least < epsilon:
        return Overlay([], [])
    proved = _grazing(region, epsilon)
    curves = list(_closed(region, ratio(epsilon)))
    for curve in all_of(proved, GrazingCurve) if proved else ():
        curves.append((GRAZING, curve.n, list(zip(*along(curve), strict=True))))
    meetings = [
        (float(sum(each.box[0]) / 2), float(sum(each.amplitude) / 2))
        for each in (all_of(proved, Meeting) if proved else ())
    ]
    lines = [Line(name, n, part) for name, n, points in curves for part in _inside(region, points)]
    return Overlay(lines, [place for place in meetings if holds(region, place)])


def holds(region: Region, place: tuple[float, float]) -> bool:
    """Whether a point is in a region."""
    (low, high), (least, most) = region.sides_of
    return low <= place[0] <= high and least <= place[1] <= most


def _inside(region: Region, points: Points) -> Iterator[Points]:
    """Yield the parts of a curve that pass through a region, with an end outside on each side."""
    part: Points = []
    for begin, end in pairwise(points):
        if any(map(math.isnan, (begin[1], end[1]))) or not (
            holds(region, begin) or holds(region, end)
        ):
            if part:
                yield part
            part = []
        else:
            part = [*(part or [begin]), end]
    if part:
        yield part


def _closed(region: Region, q: Fraction) -> Iterator[tuple[str, int, Points]]:
    low, high = region.first
    windows = [
        (n, k)
        for n in range(1, PERIODS + 1)
        for k in range(low * 2 * n // 1, -(-high * 2 * n // 1))
    ]
    step = 1 + len(windows) // _MANY  # short curves need fewer points
    for n, k in windows:
        ends = max(low, Fraction(k, 2 * n)), min(high, Fraction(k + 1, 2 * n))
        for name, etas, nus in closed(n, q, *map(float, ends)):
            points = list(zip(etas, nus, strict=True))
            yield name, n, [*points[:-1:step], points[-1]]


def _grazing(region: Region, epsilon: Fraction) -> Context | None:
    """Prove the curves of grazing that are seen to pass through a region."""
    made, left = Curves(epsilon), _MOST_SEEN
    for n in range(1, PERIODS + 1):
        for run in seen_curves(n, epsilon):
            part = _near(region, n, ratio(epsilon), run)
            left -= len(part)
            if part and left >= 0:
                with suppress(*FAILED):
                    made.grazing(n, part)
    return made.derivation.context if made.traced else None


def _near(region: Region, n: int, q: Fraction, run: list[Seen]) -> list[Seen]:
    """Return the part of a curve, as it is seen, from before to after it is in a region."""
    side = -1 if 2 * n * run[0].eta // 1 % 2 else 1

    def nu(seen: Seen) -> float:
        return side * math.sqrt(nu_squared(n, q, (float(seen.eta), seen.p), math.pi))

    places = [(float(seen.eta), nu(seen)) for seen in run]
    crossed = [k for k, two in enumerate(pairwise(places)) if _crosses(region, *two)]
    return run[crossed[0] : crossed[-1] + 2] if crossed else []


def _crosses(region: Region, begin: tuple[float, float], end: tuple[float, float]) -> bool:
    """Whether the box around two points meets a region."""
    sides = zip(begin, end, region.sides_of, strict=True)
    return all(min(a, b) <= side[1] and max(a, b) >= side[0] for a, b, side in sides)
