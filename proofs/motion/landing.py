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
from proofs.motion.flight import Flight
from proofs.motion.image import separation_phase
from proofs.motion.impact import impact_time, locate
from proofs.motion.kernel import Launches
from proofs.motion.phase import lifted, turn
from proofs.motion.system import System
from proofs.motion.windows import BITS, level, prove_clear
from proofs.trusted.equations import gap, launch_acceleration
from proofs.trusted.numbers import Phase, Phases, Range
from proofs.trusted.paper.s34_circle.absorption import BRACKET, Cell
from proofs.trusted.paper.s34_circle.entropy import Branch
from proofs.trusted.paper.s34_circle.landing import (
    Lands,
    NeverImpacts,
    Separation,
    closest_approach,
)
from proofs.trusted.parameters import Place


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


def prove_cells(system: System, branch: Branch, at: Cutting, origin: Fraction) -> list[Cell]:
    """Prove the time brackets; return the cells between the cuts."""
    phases, early = _floats(at.cuts), _floats(at.times)
    late = early + float(BRACKET)
    heights = Launches(system, IntervalArray.from_floats(phases)).heights(np.stack((early, late)))
    signs = heights[0].certainly_positive() & heights[1].certainly_negative()
    pieces = np.maximum(0, np.searchsorted(_floats(branch.cuts), phases) - 1)
    ends = _floats(branch.ends)[pieces]
    if not (signs & (early >= float(at.after)) & (late <= ends)).all():
        raise Undecided("a time bracket at a cut is not proved")
    cells = list(pairwise(at.cuts))
    for cell in cells if at.after > branch.begin else ():
        if level(Flight(system, cell, BITS), at.after)[0] <= 0:
            raise Undecided("an impact before the time given is not excluded")
    last = max(branch.ends)
    along = Flight(system, (at.cuts[0], at.cuts[-1]), BITS).clock(at.after, last)
    if along.mass_sin.contains_zero():
        raise Undecided("f' is not proved to have one sign on a branch")
    arrivals = [(x + t, x + t + BRACKET) for x, t in zip(at.cuts, at.times, strict=True)]
    images = [(min(u[0], v[0]), max(u[1], v[1])) for u, v in pairwise(arrivals)]
    flights = [
        (max(at.after, low - b), min(last, high - a))
        for (a, b), (low, high) in zip(cells, images, strict=True)
    ]
    rows = zip(cells, images, _stretches(system, cells, flights), strict=True)
    return [Cell(cell, tuple(reduced(image, origin)), factor) for cell, image, factor in rows]


def _floats(values: Sequence[Fraction]) -> NDArray[np.float64]:
    return np.array([float(value) for value in values])


def _stretches(
    system: System, phases: Sequence[Range], flights: Sequence[Range]
) -> list[Fraction | None]:
    """Bound 1/|f'| over the cells."""
    launches = Launches(system, _array(phases))
    now = launches.clock(_array(flights))
    along = now.mass_sin / system.eta * launch_acceleration(launches.start)
    speeds: IntervalArray = gap(launches.start, now, 1)
    known = along.certainly_positive() | along.certainly_negative()
    bounds: list[Fraction | None] = [None] * len(phases)
    found = (speeds[known] / along[known]).mag
    for index, value in zip(np.flatnonzero(known).tolist(), found.tolist(), strict=True):
        bounds[index] = Fraction(value)
    return bounds


def _array(ranges: Sequence[Range]) -> IntervalArray:
    return IntervalArray([Interval(low, high, precision=100) for low, high in ranges])


def reduced(image: Range, origin: Fraction) -> Iterator[Range]:
    """Yield the images, less multiples of 2 pi, that meet [origin, origin + 2 pi]."""
    whole = turn(BITS)
    if image[1] - image[0] >= whole.inf:
        raise Undecided("a cell's image is longer than the circle")
    count = int((image[0] - origin) // whole.sup) - 1
    for turns in range(count, count + 4):
        low, high = lifted(image, -turns, BITS)
        if high >= origin and low <= origin + whole.sup:
            yield low, high


def short(value: Fraction, places: int) -> Fraction:
    """Round down to so many binary places."""
    return Fraction(value * 2**places // 1, 2**places)
