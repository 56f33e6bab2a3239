"""f' over boxes of phases by Taylor forms of any order, in any arithmetic: the same work for all.

A work is a cut of an interval of phases, a grid of times and brackets of impact times, given to
all alike. Each must exclude impacts on the grid, prove the brackets and enclose f'. Order 0 is the
natural form, 1 the mean-value form. Monotonicity: f' at both ends, f'' > 0 on all boxes.

The jet of the impact time: t_0 is the time, t_1 = f' - 1 and (k + 1) t_(k+1) is the k-th Taylor
coefficient of f', which the slope formula gives along (phi + s, t_0 + ... + t_k s^k).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import Any

from intervals import Undecided
from proofs.benchmark.peers import Arithmetic, Range
from proofs.trusted.equations import Launch, clock, gap, launch, sincos, slope

ETA, NU = Fraction("0.2121"), Fraction("-0.2")
SIDE = -1  # the sign of nu: the mass flies below the table
MONOTONE = -1  # in the place of an order


@dataclass(frozen=True)
class Work:
    """What is given: exact ends, cuts, times before every impact, a time bracket a box.

    All numbers but `phases` are binary64; `centres` and `ends` are about the impact times at the
    middles of the boxes and at both ends of the phases.
    """

    phases: Range
    cuts: Sequence[float]
    grid: Sequence[float]
    brackets: Sequence[tuple[float, float]]
    centres: Sequence[float]
    ends: Sequence[float]


def bounds(of: Arithmetic, signs: Arithmetic, work: Work, order: int) -> Range:
    """Enclose f' over all boxes, one after the other; Undecided if a hypothesis is not proved."""
    with signs.precision(signs.bits):
        boxes = [signs.number(*ends) for ends in pairwise(work.cuts)]
        exclude(signs, boxes, work.grid)
        for box, bracket in zip(boxes, work.brackets, strict=True):
            _prove_bracket(signs, box, work.grid[-1], bracket)
            if order == MONOTONE:
                bend = coefficients(signs, box, signs.number(*bracket), 1)[1]
                _require(signs.positive(bend), "f'' > 0 is not proved")
    with of.precision(of.bits):
        ends = [of.ends(value) for value in _values(of, work, order)]
    return min(low for low, _ in ends), max(high for _, high in ends)


def first_impact(
    of: Arithmetic, signs: Arithmetic, phase: Fraction, grid: Sequence[float], about: float
) -> Range:
    """Enclose the first impact's time near `about`, and f' there."""
    with signs.precision(signs.bits):
        exclude(signs, [signs.point(phase)], grid)
    with of.precision(of.bits):
        phi = of.point(phase)
        time = thin_time(of, phi, about)
        coefficients(of, phi, time, 0)
        return of.ends(time)


def _require(holds: bool, why: str) -> None:
    if not holds:
        raise Undecided(why)


def _launch(of: Arithmetic, phi: Any) -> Launch:
    return launch(SIDE, of.point(ETA), of.point(NU), phi)


def exclude(of: Arithmetic, boxes: Sequence[Any], grid: Sequence[float]) -> None:
    """Prove gap > 0 on (0, last time]: gap'' > 0 on the first piece, the chord on the others.

    gap = lift A + rate B + D, and so is w^2/8 gap'': sine and cosine once a box, once a time.
    """
    eta, nu = of.point(ETA), of.point(NU)
    at_times, on_pieces = [], []
    for begin, end in pairwise([0.0, *grid]):
        time, piece = of.point(end), of.number(begin, end)
        (mass_sin, mass_cos), (s, c) = sincos(eta * time), sincos(time)
        at_times.append((c - mass_cos, s - mass_sin / eta, 1 - mass_cos))
        share = (time - of.point(begin)) ** 2 / 8
        (mass_sin, mass_cos), (s, c) = sincos(eta * piece), sincos(piece)
        pull = eta * eta * mass_cos
        on_pieces.append((share * (pull - c), share * (eta * mass_sin - s), share * pull))
    positive, greater = of.positive, of.greater or (lambda x, y: of.positive(x - y))
    for sin, cos in map(sincos, boxes):
        lift, rate = nu * sin, nu * cos
        heights = [a * lift + b * rate + d for a, b, d in at_times]
        drops = [a * lift + b * rate + d for a, b, d in on_pieces]
        chords = zip(heights, heights[1:], drops[1:], strict=False)
        above = positive(drops[0]) and all(map(positive, heights))
        above = above and all(greater(x, drop) and greater(y, drop) for x, y, drop in chords)
        _require(above, "an earlier impact is not excluded")


def _prove_bracket(of: Arithmetic, box: Any, last: float, bracket: tuple[float, float]) -> None:
    """Prove gap > 0 > gap at the ends of a bracket, and gap' < 0 from the last time of the grid."""
    start, centre = _launch(of, box), of.middle(box)
    falling = gap(start, clock(start.eta, of.number(last, bracket[1])), 1)
    _require(of.positive(-falling), "gap' < 0 is not proved up to the impact")
    tangent = _launch(of, of.series([box, box * 0 + 1]))
    for end, sign in zip(bracket, (1, -1), strict=True):
        now = clock(start.eta, of.point(end))
        along = of.coefficient(gap(tangent, now), 1)
        height = gap(_launch(of, centre), now) + along * (box - centre)
        _require(of.positive(sign * height), "the gap's signs at the bracket are not proved")


def coefficients(of: Arithmetic, phi: Any, time: Any, order: int) -> list[Any]:
    """Enclose the Taylor coefficients 0, ..., order of f', for launches at phi with these times."""
    start = _launch(of, phi)
    taylor = [slope(start, clock(start.eta, time))]
    times = [time, taylor[0] - 1]
    for k in range(1, order + 1):
        along = _launch(of, of.series([phi, phi * 0 + 1, *[phi * 0] * (k - 1)]))
        series = slope(along, clock(start.eta, of.series(times)))
        taylor.append(of.coefficient(series, k))
        times.append(taylor[-1] / (k + 1))
    return taylor


def thin_time(of: Arithmetic, phi: Any, about: float) -> Any:
    """Enclose the zero of the gap near `about` for one launch: Newton's method, then two signs."""
    start, time = _launch(of, phi), of.point(about)
    for _ in range((of.bits // 40).bit_length()):
        now = clock(start.eta, time)
        time = of.middle(time - gap(start, now) / gap(start, now, 1))
    for spare in range(8, 20):
        unit = of.point(Fraction(2) ** (spare - of.bits))
        before, after = (gap(start, clock(start.eta, t)) for t in (time - unit, time + unit))
        if of.positive(before) and of.positive(-after):
            return time + unit * of.number(-1, 1)
    raise Undecided("the impact time is lost to rounding")


def _values(of: Arithmetic, work: Work, order: int) -> list[Any]:
    """Return enclosures of f' whose hull holds it over the whole work."""
    if order == MONOTONE:
        at_ends = zip(map(of.point, work.phases), work.ends, strict=True)
        return [coefficients(of, phi, thin_time(of, phi, t), 0)[0] for phi, t in at_ends]
    values = []
    for ends, bracket, about in zip(pairwise(work.cuts), work.brackets, work.centres, strict=True):
        box = of.number(*ends)
        over = coefficients(of, box, of.number(*bracket), order)
        centre = of.middle(box)
        if order:
            over[:-1] = coefficients(of, centre, thin_time(of, centre, about), order - 1)
        steep = _horner([k * x for k, x in enumerate(over)][1:], box - centre) if order > 1 else 0
        if order > 1 and (of.positive(steep) or of.positive(-steep)):  # monotone on the box
            values += [_horner(over, of.point(end) - centre) for end in ends]
        else:
            values.append(_horner(over, box - centre))
    return values


def _horner(c: Sequence[Any], x: Any) -> Any:
    total = c[-1]
    for each in reversed(c[:-1]):
        total = total * x + each
    return total
