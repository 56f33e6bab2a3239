"""Flights over thousands of turns, for -1 < nu < 0.

Mass and table can meet in windows of time only, those of `proofs.trusted.windows.Meetings`: what
the checker has to exclude is what is excluded here, by intervals.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise

import numpy as np

from intervals import Interval, Jet, Undecided
from proofs.motion.covering import halves
from proofs.motion.flight import Flight
from proofs.motion.phase import lifted
from proofs.motion.system import System
from proofs.trusted.equations import clock, gap, launch, launch_acceleration, slope
from proofs.trusted.flights import Motion
from proofs.trusted.numbers import Range
from proofs.trusted.paper.s34_circle.entropy import Branch
from proofs.trusted.parameters import Place
from proofs.trusted.windows import Meetings

BITS = 80
_DEEPEST = 24
_Seen = tuple[float, int | None]  # a phase, and the window of its first impact


def prove_branch(
    system: System, cuts: Sequence[Fraction], turn: int, ends: Sequence[Fraction]
) -> Branch:
    """Prove f C^1 on [cuts[0], cuts[-1]], impacts in window `turn` and before `ends`, or Undecided.

    The theorem is rule `branch` of `s34_circle.entropy`.
    """
    whole = Flight(system, (cuts[0], cuts[-1]), BITS)
    windows = Meetings.of(Motion(Place.plastic(system.eta, system.nu), whole.phases, BITS))
    launched = _launched(whole)
    for low, high in windows.before(turn):
        if high > launched:
            prove_clear(whole, (max(low, launched), high))
    begin = windows.window(turn)[0]
    if begin <= launched:
        raise Undecided("the last window starts at launch")
    for phases, end in zip(pairwise(cuts), ends, strict=True):
        piece = replace(whole, phases=phases)
        prove_falls(piece, (begin, end))
        if level(piece, end)[1] >= 0:
            raise Undecided("the gap is not proved negative at an end")
    at = Place.plastic(system.eta, system.nu)
    return Branch(at, tuple(cuts), turn, begin, tuple(ends))


def _launched(flight: Flight) -> Fraction:
    """Return a time up to which gap'' > 0."""
    for halvings in range(10):
        time = Fraction(1, 2**halvings)
        if flight.gap(Fraction(0), time, order=2).certainly_positive():
            return time
    raise Undecided("the launches are not proved to leave the table")


def level(flight: Flight, time: Fraction) -> Range:
    """Enclose the gap at one time: by the ends of the phases where it is monotone in the phase."""
    now, system = flight.clock(time), flight.system
    nu = Interval(system.nu, precision=flight.precision)
    phi = Jet(flight.phi, Interval(1, precision=flight.precision))
    whole = gap(launch(system.side, flight.eta, nu, phi), now)
    tilt = whole.derivative()
    if not (tilt.certainly_positive() or tilt.certainly_negative()):
        return whole.value.inf, whole.value.sup
    ends = [replace(flight, phases=(x, x)).gap(time) for x in flight.phases]
    return min(end.inf for end in ends), max(end.sup for end in ends)


def prove_clear(flight: Flight, times: Range) -> None:
    """Prove gap > 0 on an interval of times, by chords: rule `branch`."""
    _clear(flight, times, [level(flight, time)[0] for time in times], 0)


def _clear(flight: Flight, times: Range, least: Sequence[Fraction], depth: int) -> None:
    """Do `prove_clear`, lower bounds of the gap at the ends being known."""
    if min(least) <= 0 or depth == _DEEPEST:
        raise Undecided("an earlier impact is not excluded")
    bend = max(flight.gap(*times, order=2).sup, Fraction(0))
    if min(least) > bend * (times[1] - times[0]) ** 2 / 8:
        return
    before, after = halves(times)
    between = level(flight, before[1])[0]
    _clear(flight, before, (least[0], between), depth + 1)
    _clear(flight, after, (between, least[1]), depth + 1)


def prove_falls(flight: Flight, times: Range, depth: int = 0) -> None:
    """Prove gap' < 0 on an interval of times."""
    if flight.velocity(*times).certainly_negative():
        return
    if depth == _DEEPEST:
        raise Undecided("the gap is not proved to fall to the impact")
    for half in halves(times):
        prove_falls(flight, half, depth + 1)


def bracket(branch: Branch, system: System, phase: Fraction, about: float) -> tuple[Range, Range]:
    """Prove a bracket of one launch's impact time; return it and the image, less 2 pi turn."""
    flight = Flight(system, (phase, phase), BITS)
    index = next(i for i, cut in enumerate(branch.cuts[1:]) if phase <= cut)
    opening = Fraction(1, 2**32)
    for _ in range(12):
        centre = round(about / opening) * opening
        low, high = max(branch.begin, centre - opening), min(branch.ends[index], centre + opening)
        signs = flight.gap(low).certainly_positive(), flight.gap(high).certainly_negative()
        if low < high and all(signs):
            return (low, high), lifted((phase + low, phase + high), -branch.turn, BITS)
        opening *= 4
    raise Undecided("no bracket of an impact time is proved")


# -- candidates in floating point ----------------------------------------------------------------


@dataclass(frozen=True)
class Candidate:
    """About when a launch has its first impact, in which window, and the slope of f there."""

    turn: int
    time: float
    slope: float


@dataclass(frozen=True)
class Candidates:
    """The first impact in floating point, looked for in the windows only: never evidence."""

    system: System
    turns: int

    def impact(self, phase: float) -> Candidate | None:
        """Return about where the first impact is, None if there is none."""
        eta, nu = float(self.system.eta), float(self.system.nu)
        start = launch(-1, eta, nu, phase)
        amplitude = math.hypot(1 + start.lift, start.rate / eta)
        acceleration = launch_acceleration(start)
        if acceleration <= 0 or amplitude <= 1 + nu:
            return None
        bend = abs(nu) + eta * eta * amplitude
        sigma = math.acos(max(-1.0, min(1.0, (1 - amplitude) / -nu))) + 1e-6
        tau = math.acos((1 + nu) / amplitude) + eta * sigma + 1e-6
        delta = math.atan2(start.rate / eta, 1 + start.lift)
        middles = math.pi / 2 - phase + 2 * math.pi * np.arange(self.turns + 1)
        offsets = np.remainder(eta * middles - delta + math.pi, 2 * math.pi) - math.pi
        for turn in np.nonzero(np.abs(offsets) <= tau)[0]:
            middle = float(middles[turn])  # numpy's floats are slow one by one
            time = max(middle - sigma, min(1.0, acceleration / (2 * bend)))
            while time < middle + sigma:
                now = clock(eta, time)
                height, speed = gap(start, now), gap(start, now, 1)
                if height < 1e-13:
                    return Candidate(int(turn), time, slope(start, now))
                time += (speed + math.sqrt(speed * speed + 2 * bend * height)) / bend
        return None

    def runs(self, low: float, high: float, count: int) -> Iterator[tuple[float, float]]:
        """Yield the intervals, seen from a grid of count + 1 phases, where all launches have their
        first impact in one window: up to where f jumps.
        """
        grid = [low + (high - low) * i / count for i in range(count + 1)]
        points = [(phase, self._turn(phase)) for phase in grid]
        begin = points[0]
        for left, right in pairwise(points):
            for before, after in self._jumps(left, right):
                if begin[1] is not None:
                    yield begin[0], before[0]
                begin = after
        if begin[1] is not None:
            yield begin[0], high

    def _turn(self, phase: float) -> int | None:
        found = self.impact(phase)
        return None if found is None else found.turn

    def _jumps(self, left: _Seen, right: _Seen) -> Iterator[tuple[_Seen, _Seen]]:
        """Yield neighbouring phases with impacts in different windows."""
        if left[1] == right[1]:
            return
        middle = (left[0] + right[0]) / 2
        if not left[0] < middle < right[0]:
            yield left, right
            return
        between = middle, self._turn(middle)
        yield from self._jumps(left, between)
        yield from self._jumps(between, right)
