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


def bounds(kernel: Arithmetic, signs: Arithmetic, work: Work, order: int) -> Range:
    """Enclose f' over all boxes, one after the other; Undecided if a hypothesis is not proved."""
    with signs.precision(signs.bits):
        boxes = [signs.number(*ends) for ends in pairwise(work.cuts)]
        exclude(signs, boxes, work.grid)
        for box, bracket in zip(boxes, work.brackets, strict=True):
            _prove_bracket(signs, box, work.grid[-1], bracket)
            if order == MONOTONE:
                bend = coefficients(signs, box, signs.number(*bracket), 1)[1]
                _require(signs.positive(bend), "f'' > 0 is not proved")
    with kernel.precision(kernel.bits):
        ends = [kernel.ends(value) for value in _values(kernel, work, order)]
    return min(low for low, _ in ends), max(high for _, high in ends)


def first_impact(
    kernel: Arithmetic, signs: Arithmetic, phase: Fraction, grid: Sequence[float], about: float
) -> Range:
    """Enclose the first impact's time near `about`, and f' there."""
    with signs.precision(signs.bits):
        exclude(signs, [signs.point(phase)], grid)
    with kernel.precision(kernel.bits):
        phi = kernel.point(phase)
        time = thin_time(kernel, phi, about)
        coefficients(kernel, phi, time, 0)
        return kernel.ends(time)


def _require(holds: bool, why: str) -> None:
    if not holds:
        raise Undecided(why)


def _launch(kernel: Arithmetic, phi: Any) -> Launch:
    return launch(SIDE, kernel.point(ETA), kernel.point(NU), phi)


def exclude(kernel: Arithmetic, boxes: Sequence[Any], grid: Sequence[float]) -> None:
    """Prove gap > 0 on (0, last time]: gap'' > 0 on the first piece, the chord on the others.

    gap = lift A + rate B + D, and so is w^2/8 gap'': sine and cosine once a box, once a time.
    """
    eta, nu = kernel.point(ETA), kernel.point(NU)
    at_times, on_pieces = [], []
    for begin, end in pairwise([0.0, *grid]):
        time, piece = kernel.point(end), kernel.number(begin, end)
        (mass_sin, mass_cos), (s, c) = sincos(eta * time), sincos(time)
        at_times.append((c - mass_cos, s - mass_sin / eta, 1 - mass_cos))
        share = (time - kernel.point(begin)) ** 2 / 8
        (mass_sin, mass_cos), (s, c) = sincos(eta * piece), sincos(piece)
        pull = eta * eta * mass_cos
        on_pieces.append((share * (pull - c), share * (eta * mass_sin - s), share * pull))
    positive, greater = kernel.positive, kernel.greater or (lambda x, y: kernel.positive(x - y))
    for sin, cos in map(sincos, boxes):
        lift, rate = nu * sin, nu * cos
        heights = [a * lift + b * rate + d for a, b, d in at_times]
        drops = [a * lift + b * rate + d for a, b, d in on_pieces]
        chords = zip(heights, heights[1:], drops[1:], strict=False)
        above = positive(drops[0]) and all(map(positive, heights))
        above = above and all(greater(x, drop) and greater(y, drop) for x, y, drop in chords)
        _require(above, "an earlier impact is not excluded")


def _prove_bracket(kernel: Arithmetic, box: Any, last: float, bracket: tuple[float, float]) -> None:
    """Prove gap > 0 > gap at the ends of a bracket, and gap' < 0 from the last time of the grid."""
    start, centre = _launch(kernel, box), kernel.middle(box)
    falling = gap(start, clock(start.eta, kernel.number(last, bracket[1])), 1)
    _require(kernel.positive(-falling), "gap' < 0 is not proved up to the impact")
    tangent = _launch(kernel, kernel.series([box, box * 0 + 1]))
    for end, sign in zip(bracket, (1, -1), strict=True):
        now = clock(start.eta, kernel.point(end))
        along = kernel.coefficient(gap(tangent, now), 1)
        height = gap(_launch(kernel, centre), now) + along * (box - centre)
        _require(kernel.positive(sign * height), "the gap's signs at the bracket are not proved")


def coefficients(kernel: Arithmetic, phi: Any, time: Any, order: int) -> list[Any]:
    """Enclose the Taylor coefficients 0, ..., order of f', for launches at phi with these times."""
    start = _launch(kernel, phi)
    taylor = [slope(start, clock(start.eta, time))]
    times = [time, taylor[0] - 1]
    for k in range(1, order + 1):
        along = _launch(kernel, kernel.series([phi, phi * 0 + 1, *[phi * 0] * (k - 1)]))
        series = slope(along, clock(start.eta, kernel.series(times)))
        taylor.append(kernel.coefficient(series, k))
        times.append(taylor[-1] / (k + 1))
    return taylor


def thin_time(kernel: Arithmetic, phi: Any, about: float) -> Any:
    """Enclose the zero of the gap near `about` for one launch: Newton's method, then two signs."""
    start, time = _launch(kernel, phi), kernel.point(about)
    for _ in range((kernel.bits // 40).bit_length()):
        now = clock(start.eta, time)
        time = kernel.middle(time - gap(start, now) / gap(start, now, 1))
    for spare in range(8, 20):
        unit = kernel.point(Fraction(2) ** (spare - kernel.bits))
        before, after = (gap(start, clock(start.eta, t)) for t in (time - unit, time + unit))
        if kernel.positive(before) and kernel.positive(-after):
            return time + unit * kernel.number(-1, 1)
    raise Undecided("the impact time is lost to rounding")


def _values(kernel: Arithmetic, work: Work, order: int) -> list[Any]:
    """Return enclosures of f' whose hull holds it over the whole work."""
    if order == MONOTONE:
        at_ends = zip(map(kernel.point, work.phases), work.ends, strict=True)
        return [coefficients(kernel, phi, thin_time(kernel, phi, t), 0)[0] for phi, t in at_ends]
    values = []
    for ends, bracket, about in zip(pairwise(work.cuts), work.brackets, work.centres, strict=True):
        box = kernel.number(*ends)
        over = coefficients(kernel, box, kernel.number(*bracket), order)
        centre = kernel.middle(box)
        if order:
            over[:-1] = coefficients(kernel, centre, thin_time(kernel, centre, about), order - 1)
        steep = _horner([k * x for k, x in enumerate(over)][1:], box - centre) if order > 1 else 0
        if order > 1 and (kernel.positive(steep) or kernel.positive(-steep)):  # monotone on the box
            values += [_horner(over, kernel.point(end) - centre) for end in ends]
        else:
            values.append(_horner(over, box - centre))
    return values


def _horner(c: Sequence[Any], x: Any) -> Any:
    total = c[-1]
    for each in reversed(c[:-1]):
        total = total * x + each
    return total
