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
from proofs.benchmark.arithmetics import Arithmetic
from proofs.motion.system import System
from proofs.trusted.equations import clock, gap, launch, slope
from proofs.trusted.numbers import Range, hull

MONOTONE = -1  # in the place of an order
_OPENINGS = 12


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
    ends: tuple[float, float]


def coefficients(of: Arithmetic, system: System, phi: Any, time: Any, order: int) -> list[Any]:
    """Enclose the Taylor coefficients 0, ..., order of f', for launches at phi with these times."""
    eta, nu = parameters(of, system)
    found = [slope(launch(system.side, eta, nu, phi), clock(eta, time))]
    times = [time, found[0] - 1]
    for k in range(1, order + 1):
        along = of.jet([phi, phi * 0 + 1, *[phi * 0] * (k - 1)])
        now = clock(eta, of.jet(times))
        found.append(of.coefficient(slope(launch(system.side, eta, nu, along), now), k))
        times.append(found[-1] / (k + 1))
    return found


def parameters(of: Arithmetic, system: System) -> tuple[Any, Any]:
    """Return eta and nu."""
    return of.number(system.eta, system.eta), of.number(system.nu, system.nu)


def one_by_one(of: Arithmetic, coarse: Arithmetic, system: System, work: Work, order: int) -> Range:
    """Enclose f' over all boxes, one after the other; `coarse` is for signs.

    Raises Undecided where a hypothesis is not proved.
    """
    boxes = [coarse.number(*ends) for ends in pairwise(work.cuts)]
    for box, bracket in zip(boxes, work.brackets, strict=True):
        _prove_bracket(coarse, system, box, work.grid[-1], bracket)
    if order == MONOTONE:
        for box, bracket in zip(boxes, work.brackets, strict=True):
            bend = coefficients(coarse, system, box, coarse.number(*bracket), 1)[1]
            _require(coarse.positive(bend), "f'' > 0 is not proved")
        at_ends = (
            coefficients(of, system, of.number(x, x), thin_time(of, system, of.number(x, x), t), 0)
            for x, t in zip(work.phases, work.ends, strict=True)
        )
        return _range(of, [value for (value,) in at_ends])
    ranges = []
    for ends, bracket, about in zip(pairwise(work.cuts), work.brackets, work.centres, strict=True):
        box = of.number(*ends)
        over = coefficients(of, system, box, of.number(*bracket), order)
        if order:
            centre = of.middle(box)
            time = thin_time(of, system, centre, about)
            over[:-1] = coefficients(of, system, centre, time, order - 1)
            ranges += _polynomial(of, over, box - centre, ends, centre)
        else:
            ranges.append(over[0])
    return _range(of, ranges)


def _range(of: Arithmetic, values: Sequence[Any]) -> Range:
    """Return the ends of all; balls lose much to a hull of two."""
    ends = [of.ends(value) for value in values]
    return hull(ends)


def exclude(of: Arithmetic, system: System, boxes: Sequence[Any], grid: Sequence[float]) -> None:
    """Prove gap > 0 on (0, last time]: gap'' > 0 on the first piece, the chord on the others."""
    eta, nu = parameters(of, system)
    times = [0.0, *grid]
    at_ends = [clock(eta, of.number(t, t)) for t in grid]
    over = [clock(eta, of.number(*piece)) for piece in pairwise(times)]
    shares = [(of.number(b, b) - of.number(a, a)) ** 2 / 8 for a, b in pairwise(times)]
    for box in boxes:
        start = launch(system.side, eta, nu, box)
        heights = [gap(start, now) for now in at_ends]
        bends = [gap(start, now, 2) * share for now, share in zip(over, shares, strict=True)]
        above = of.positive(bends[0]) and all(map(of.positive, heights))
        chords = zip(heights, heights[1:], bends[1:], strict=False)
        ok = above and all(of.positive(a - c) and of.positive(b - c) for a, b, c in chords)
        _require(ok, "an earlier impact is not excluded")


def _prove_bracket(
    of: Arithmetic, system: System, box: Any, last: float, bracket: tuple[float, float]
) -> None:
    """Prove gap > 0 > gap at the ends of a bracket, and gap' < 0 from the last time of the grid."""
    eta, nu = parameters(of, system)
    falling = gap(launch(system.side, eta, nu, box), clock(eta, of.number(last, bracket[1])), 1)
    _require(of.positive(-falling), "gap' < 0 is not proved up to the impact")
    centre = of.middle(box)
    start = launch(system.side, eta, nu, centre)
    tangent = launch(system.side, eta, nu, of.jet([box, box * 0 + 1]))
    for end, sign in zip(bracket, (1, -1), strict=True):
        now = clock(eta, of.number(end, end))
        along = of.coefficient(gap(tangent, now), 1)
        height = gap(start, now) + along * (box - centre)
        _require(of.positive(sign * height), "the gap's signs at the bracket are not proved")


def thin_time(of: Arithmetic, system: System, phi: Any, about: float) -> Any:
    """Enclose the zero of the gap near `about` for one launch: Newton's method, then two signs."""
    eta, nu = parameters(of, system)
    start = launch(system.side, eta, nu, phi)
    time = of.number(about, about)
    for _ in range((of.bits // 40).bit_length()):
        now = clock(eta, time)
        time = of.middle(time - gap(start, now) / gap(start, now, 1))
    unit = of.number(*[Fraction(1, 2 ** (of.bits - 8))] * 2)
    for _ in range(_OPENINGS):
        low, high = time - unit, time + unit
        before, after = gap(start, clock(eta, low)), gap(start, clock(eta, high))
        if of.positive(before) and of.positive(-after):
            return of.hull(low, high)
        unit = unit * 2
    raise Undecided("the impact time is lost to rounding")


def _polynomial(
    of: Arithmetic, c: Sequence[Any], offset: Any, ends: tuple[float, float], centre: Any
) -> list[Any]:
    """Return values whose hull encloses a polynomial over the offsets.

    At the ends of the box if it is monotone, else by Horner's scheme.
    """
    if len(c) > 2:
        slopes = [k * x for k, x in enumerate(c)][1:]
        steep = _horner(slopes, offset)
        if of.positive(steep) or of.positive(-steep):
            return [_horner(c, of.number(end, end) - centre) for end in ends]
    return [_horner(c, offset)]


def _horner(c: Sequence[Any], x: Any) -> Any:
    total = c[-1]
    for one in reversed(c[:-1]):
        total = total * x + one
    return total


def _require(holds: bool, why: str) -> None:
    if not holds:
        raise Undecided(why)
