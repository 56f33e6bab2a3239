"""Flights over thousands of turns, for -1 < nu < 0: candidates in floating point, never evidence.

Mass and table can meet in windows of time only, those of `proofs.trusted.windows.Meetings`.
"""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

from proofs.motion.simulate import marched
from proofs.motion.system import System
from proofs.trusted.equations import launch_acceleration, slope

_LEVEL = 1e-13  # of a gap that counts as 0
_Seen = tuple[float, int | None]  # a phase, and the window of its first impact


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

    @cached_property
    def _shares(self) -> tuple[list[float], list[int]]:
        """The fractional parts of eta k, in order, for the turns k, and these turns."""
        p, q = self.system.eta.numerator, self.system.eta.denominator
        shares = sorted((turn * p % q / q, turn) for turn in range(self.turns + 1))
        return [share for share, _ in shares], [turn for _, turn in shares]

    def _windows(self, offset: float, tau: float) -> list[int]:
        """Return the turns k, in order, for which offset + 2 pi eta k is near a multiple of 2 pi:
        within tau.
        """
        shares, turns = self._shares
        low, width = (-tau - offset) / math.tau % 1, min(tau / math.pi, 1)
        near = turns[bisect_left(shares, low) : bisect_right(shares, low + width)]
        return sorted({*near, *turns[: bisect_right(shares, low + width - 1)]})

    def impact(self, phase: float) -> Candidate | None:
        """Return about where the first impact is, None if there is none."""
        eta, nu = float(self.system.eta), float(self.system.nu)
        start = self.system.launched(phase)
        amplitude = math.hypot(1 + start.lift, start.rate / eta)
        acceleration = launch_acceleration(start)
        if acceleration <= 0 or amplitude <= 1 + nu:
            return None
        bend = abs(nu) + eta * eta * amplitude
        sigma = math.acos(max(-1.0, min(1.0, (1 - amplitude) / -nu))) + 1e-6
        tau = math.acos((1 + nu) / amplitude) + eta * sigma + 1e-6
        delta = math.atan2(start.rate / eta, 1 + start.lift)
        first = math.pi / 2 - phase
        for turn in self._windows(eta * first - delta, tau):
            middle = first + 2 * math.pi * turn
            time = max(middle - sigma, min(1.0, acceleration / (2 * bend)))
            if impact := marched(start, bend, time, middle + sigma, level=_LEVEL, close=0.0):
                return Candidate(turn, impact[0], slope(start, impact[1]))
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
        candidate = self.impact(phase)
        return None if candidate is None else candidate.turn

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
