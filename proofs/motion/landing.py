"""Where flights land: on the sticking arc, nowhere, or in the images of cells. The theorems are
those of the rules of `s34_circle`."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from intervals import Interval, IntervalArray, Undecided
from proofs.motion.covering import halves
from proofs.motion.flight import Flight
from proofs.motion.image import separation_phase
from proofs.motion.impact import impact_time, locate
from proofs.motion.phase import lifted, turn
from proofs.motion.system import System
from proofs.motion.windows import BITS, level, prove_clear
from proofs.trusted.equations import (
    clock,
    inverse_bend,
    inverse_slope,
    launch,
    launch_acceleration,
)
from proofs.trusted.numbers import Phase, Phases, Range, within
from proofs.trusted.paper.s34_circle.absorption import BRACKET
from proofs.trusted.paper.s34_circle.cells import Cell, Inverse
from proofs.trusted.paper.s34_circle.entropy import Branch
from proofs.trusted.paper.s34_circle.landing import (
    Lands,
    NeverImpacts,
    Separation,
    closest_approach,
)
from proofs.trusted.parameters import Place

_HALVINGS = 12


def prove_separation(system: System, bits: int) -> tuple[Separation, list[Fraction]]:
    """Enclose the ends of the sticking arc, and the flight from it, to about 2^-bits.

    Return that, and the times of the proof, the window of the impact being the last piece.
    """
    if system.sticking_arc != "some":
        raise Undecided("the mass sticks nowhere, or everywhere: there is no separation phase")
    unit = Fraction(1, 2**bits)
    if system.sticking_arc != "some":
        raise Undecided("the mass never sticks, or never leaves: there is no separation phase")
    centre = round(separation_phase(system, bits + 20)[0] / unit) * unit
    phase = Phase(centre - unit, centre + unit)
    ends = [launch_acceleration(Flight(system, (x, x), bits + 40).start) for x in phase]
    if not (ends[0].certainly_negative() and ends[1].certainly_positive()):
        raise Undecided("the separation phase is not bracketed")
    found = locate(system, phase, separating=True)
    time = impact_time(found, phase, bits - 10)
    speed = -found.thin(phase, bits).velocity(*time)
    pi, whole = Interval.pi(precision=bits + 20), turn(bits + 20)
    odd = 1 + 2 * int((phase[0] / pi.inf - Fraction(1, 2)) // 1)
    start = (pi * odd).inf - phase[1], (pi * odd).sup - phase[0]
    impact = phase[0] + time[0], phase[1] + time[1]
    turns = 1 + int((impact[1] - phase[0]) // whole.inf)
    arrival = impact[0] - turns * whole.sup, impact[1] - turns * whole.inf
    at = Place.plastic(system.eta, system.nu)
    times = [*(each for each in found.times[1:] if each <= found.window[0]), found.window[1]]
    return Separation(at, start, phase, time, turns, arrival, (speed.inf, speed.sup)), times


def _at(system: System) -> Place:
    return Place.plastic(system.eta, system.nu)


def prove_lands(system: System, arc: Separation, cuts: Sequence[Fraction], turns: int) -> Lands:
    """Prove that the launches between the first and the last cut land on the sticking arc."""
    if cuts[0] >= cuts[-1]:
        raise Undecided("no phases in this order land there")
    start, end = lifted(arc.start, turns, BITS), lifted(arc.phase, turns, BITS)
    for low, high in pairwise(cuts if turns else (cuts[0], cuts[0])):
        flight = Flight(system, (low, high), BITS)
        if turns:
            prove_clear(flight, (arc.start[0] - high, start[1] - low))
        if level(flight, end[0] - high)[1] >= 0:
            raise Undecided("the gap is not negative at the end of the sticking arc")
    return Lands(arc.at, (cuts[0], cuts[-1]))


def prove_never(system: System, phases: Range) -> NeverImpacts:
    """Prove that no flight from some phases near pi/2 ends."""
    flight, half_turn = Flight(system, phases, BITS), Interval.pi(precision=BITS)
    nu = Interval(system.nu, precision=BITS)
    bounds = closest_approach(system.eta, nu, flight.start, flight.phi - half_turn / 2, half_turn)
    if not all(bound.certainly_positive() for bound in bounds):
        raise Undecided("an impact is not excluded")
    return NeverImpacts(_at(system), Phases(*phases))


@dataclass(frozen=True)
class Cutting:
    """Cuts of a branch, times just before the impacts after launches there, a time before all."""

    cuts: Sequence[Fraction]
    times: Sequence[Fraction]
    after: Fraction


def impact_before(system: System, phase: Fraction, about: Fraction) -> Fraction:
    """Return a time from which on the gap falls through 0 within `BRACKET`, or Undecided."""
    flight = Flight(system, (phase, phase), BITS)
    for _ in range(4):
        time = short(about, 48) - BRACKET / 2
        height = flight.gap(time)
        if height.certainly_positive() and flight.gap(time + BRACKET).certainly_negative():
            return time
        about = time - height.mid / flight.gap(time, order=1).mid
    raise Undecided("a time bracket at a cut is not proved")


def prove_cells(system: System, branch: Branch, at: Cutting, origin: Fraction) -> list[Cell]:
    """Prove the cells between the cuts, at which the times are those of `impact_before`."""
    if not within((at.cuts[0], at.cuts[-1]), branch.phases):
        raise Undecided("a phase outside the branch")
    pieces = np.maximum(0, np.searchsorted(_floats(branch.cuts), _floats(at.cuts)) - 1)
    ends = [branch.ends[piece] for piece in pieces.tolist()]
    if any(t < at.after or t + BRACKET > end for t, end in zip(at.times, ends, strict=True)):
        raise Undecided("a bracket leaves the window of the first impact")
    if at.after > branch.begin and not _up(system, (at.cuts[0], at.cuts[-1]), at.after, _HALVINGS):
        raise Undecided("an impact before the time given is not excluded")
    window = at.after, max(branch.ends)
    along = Flight(system, (at.cuts[0], at.cuts[-1]), BITS).clock(*window).mass_sin
    if along.contains_zero():
        raise Undecided("f' is not proved to have one sign on a branch")
    sign = -1 if along.certainly_positive() else 1
    arrivals = [(x + t, x + t + BRACKET) for x, t in zip(at.cuts, at.times, strict=True)]
    cells = list(pairwise(at.cuts))
    pairs = [pair[::sign] for pair in pairwise(arrivals)]
    flights = [
        (max(window[0], low[0] - b), min(window[1], high[1] - a))
        for (a, b), (low, high) in zip(cells, pairs, strict=True)
    ]
    brackets = [(t, t + BRACKET) for t in at.times]
    thin, _ = inverse_slopes(system, _array([(x, x) for x in at.cuts]), _array(brackets))
    _, bent = inverse_slopes(system, _array(cells), _array(flights))
    slopes, bends = (_ranges(values * sign) for values in (thin, bent))
    found = []
    for cell, pair, ends_of, bend in zip(cells, pairs, pairwise(slopes), bends, strict=True):
        turned = list(reduced(pair, origin))
        images = tuple((first[0], last[1]) for first, last in turned)
        inverses = tuple(Inverse.of(each, ends_of[::sign], bend) for each in turned)
        found.append(Cell(cell, images, inverses))
    return found


def _up(system: System, phases: Range, time: Fraction, halvings: int) -> bool:
    """Whether gap > 0 at one time after all launches in some phases, which may be halved."""
    if level(Flight(system, phases, BITS), time)[0] > 0:
        return True
    return halvings > 0 and all(_up(system, half, time, halvings - 1) for half in halves(phases))


def inverse_slopes(
    system: System, phases: IntervalArray, times: IntervalArray
) -> tuple[IntervalArray, IntervalArray]:
    """Enclose 1/f' and its derivative in the image, for launches and impact times in boxes."""
    start, now = launch(system.side, system.eta, system.nu, phases), clock(system.eta, times)
    first: IntervalArray = inverse_slope(start, now)
    return first, inverse_bend(start, now, first)


def _floats(values: Sequence[Fraction]) -> NDArray[np.float64]:
    return np.array([float(value) for value in values])


def _array(ranges: Sequence[Range]) -> IntervalArray:
    return IntervalArray([Interval(low, high, precision=100) for low, high in ranges])


def _ranges(values: IntervalArray) -> list[Range]:
    return [
        *zip(map(Fraction, values.inf.tolist()), map(Fraction, values.sup.tolist()), strict=True)
    ]


def reduced(image: Sequence[Range], origin: Fraction) -> Iterator[tuple[Range, Range]]:
    """Yield the brackets of an image's ends, less multiples of 2 pi, of all parts on the line."""
    whole = turn(BITS)
    if image[1][1] - image[0][0] >= whole.inf:
        raise Undecided("a cell's image is longer than the circle")
    count = int((image[0][0] - origin) // whole.sup) - 1
    for turns in range(count, count + 4):
        low, high = (lifted(end, -turns, BITS) for end in image)
        if high[1] >= origin and low[0] <= origin + whole.sup:
            yield low, high


def short(value: Fraction, places: int) -> Fraction:
    """Round down to so many binary places."""
    return Fraction(value * 2**places // 1, 2**places)
