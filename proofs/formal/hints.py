"""Where to cut: floating point looks for the numbers that the Coq files are written with.

Nothing here is trusted. A hint that is wrong makes coqc refuse a lemma.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from fractions import Fraction
from functools import cached_property
from itertools import product
from typing import NamedTuple

from proofs.motion.simulate import next_impact
from proofs.motion.system import System
from proofs.trusted.equations import clock, gap, launch, slope
from proofs.trusted.numbers import Range

SLACK = Fraction(1, 10000)  # f is differentiable at the ends of a set: branches go on beyond them
_FINEST = 2.0**-40
_DEEPEST = 14


class NoHint(ValueError):
    """Floating point finds no way to cut: the theorem may hold, and is not written."""


class Branch(NamedTuple):
    """Launches from [a, b]: gap'' > 0 up to T, gap > 0 up to u, gap' < 0 up to v, then gap < 0."""

    a: Fraction
    b: Fraction
    T: Fraction
    u: Fraction
    v: Fraction


class Piece(NamedTuple):
    """For launches phi from [p, q] the impact is at z + r (phi - p), up to d."""

    p: Fraction
    q: Fraction
    z: Fraction
    r: Fraction
    d: Fraction


class Escape(NamedTuple):
    """For launches from [p, q]: gap'' > 0 up to T, gap < 0 at v, before lap K of the target."""

    p: Fraction
    q: Fraction
    T: Fraction
    K: int
    v: Fraction


def binary(x: float, bits: int, up: bool = False) -> Fraction:
    """Return x rounded down, or up, to a multiple of 2^-bits."""
    return Fraction((math.ceil if up else math.floor)(Fraction(x) * 2**bits), 2**bits)


def steps(low: float, high: float, count: int) -> list[float]:
    """Return count + 1 numbers from low to high, evenly spaced."""
    return [low + (high - low) * index / count for index in range(count + 1)]


class Hints(System):
    """Flights of one oscillator in floating point."""

    @cached_property
    def floats(self) -> tuple[float, float]:
        """Eta and nu."""
        return float(self.eta), float(self.nu)

    def gap(self, phase: float, time: float | Fraction, order: int = 0) -> float:
        """Return the distance of mass and table, or a derivative in time."""
        eta, nu = self.floats
        value: float = gap(launch(self.side, eta, nu, phase), clock(eta, float(time)), order)
        return value

    def slope(self, phase: float, time: float) -> float:
        """Return f' for an impact at this time."""
        eta, nu = self.floats
        value: float = slope(launch(self.side, eta, nu, phase), clock(eta, time))
        return value

    def impact(self, phase: float) -> float:
        """Return the time of the first impact."""
        impact = next_impact(self, phase)
        if impact is None:
            raise NoHint(f"no first impact after phase {phase:.6f}")
        time = impact.time
        for _ in range(3):
            time -= self.gap(phase, time) / self.gap(phase, time, 1)
        return time

    def rate(self, phase: float) -> float:
        """Return f'."""
        return self.slope(phase, self.impact(phase))

    def rates(self, domain: Range) -> tuple[float, float]:
        """Return about the least and the greatest f' on an interval."""
        values = [self.rate(phase) for phase in steps(float(domain[0]), float(domain[1]), 64)]
        return min(values), max(values)

    def launch(self, phases: list[float], most: float) -> Fraction:
        """Return a time up to which gap'' > 0 for launches from these phases."""
        lift = Fraction(4)
        starts = [self.gap(phase, 0.0, 2) for phase in phases]
        if min(starts) <= 0:
            raise NoHint("the mass sticks first")
        while lift > most or any(
            self.gap(phase, time, 2) < 0.2 * start
            for phase, start in zip(phases, starts, strict=True)
            for time in steps(0, float(lift), 16)
        ):
            lift /= 2
        return lift

    def pieces(self, branch: Branch, domain: Range, bounds: Range) -> Iterator[Piece]:
        """Yield pieces of an interval of phases, on each of which f' is easily seen in bounds."""
        p, high = domain
        while p < high:
            q = high
            while (piece := self._piece(branch, p, q, bounds)) is None:
                q = p + (q - p) / 2
                if q - p < _FINEST:
                    raise NoHint(f"f' is too near its bound at phase {float(p):.6f}")
            yield piece
            p = q

    def _piece(self, branch: Branch, p: Fraction, q: Fraction, bounds: Range) -> Piece | None:
        """Return the piece if the line follows the impact well enough for the bounds."""
        phases = steps(float(p), float(q), 8)
        times = [self.impact(phase) for phase in phases]
        width = phases[-1] - phases[0]
        r = binary((times[-1] - times[0]) / width, 12)
        errors = [t - float(r) * (x - phases[0]) for t, x in zip(times, phases, strict=True)]
        spread = max(errors) - min(errors) + 1e-12
        bits = 4 - math.floor(math.log2(spread))
        z, d = binary((max(errors) + min(errors)) / 2, bits), binary(spread, bits, True)
        low, high = (
            float(z) + min(0.0, float(r) * width) - float(d),
            float(z) + max(0.0, float(r) * width) + float(d),
        )
        if low < branch.u or high > branch.v:
            return None
        for x in phases:
            band = [self.slope(x, float(z + r * (Fraction(x) - p) + e * d)) for e in (-2, 0, 2)]
            if min(band) < bounds[0] or max(band) > bounds[1]:
                return None
        return Piece(p, q, z, r, d)

    def escapes(self, phases: Range, target: Range, depth: int = 0) -> list[Escape]:
        """Return pieces of an interval of phases, none of which has its impact in the target."""
        found = self._escape(phases, target)
        if found is not None:
            return [found]
        if depth == _DEEPEST:
            raise NoHint(f"phase {float(phases[0]):.6f} is not seen to leave {target}")
        middle = (phases[0] + phases[1]) / 2
        parts = (phases[0], middle), (middle, phases[1])
        return [each for part in parts for each in self.escapes(part, target, depth + 1)]

    def _escape(self, phases: Range, target: Range) -> Escape | None:
        launches = steps(float(phases[0]), float(phases[1]), 8)
        start = self.launch(launches, math.tau)
        if start < target[1] - phases[0]:
            raise NoHint("the target is too wide for the launches")
        for lap in range(1, 200):
            latest = float(target[0]) + math.tau * lap - launches[-1]
            earliest = max(float(start), latest - math.tau)
            times = [latest - (latest - earliest) * 0.75**index for index in range(50)]
            time = binary(min(times, key=self._highest(launches)), 24)
            if self._highest(launches)(time) < -1e-6:
                return Escape(*phases, start, lap, time)
            above = [
                self.gap(phase, psi - phase + math.tau * lap)
                for phase, psi in product(launches, steps(float(target[0]), float(target[1]), 16))
            ]
            if min(above) < 1e-5:
                return None
        return None

    def _highest(self, launches: list[float]) -> Callable[[float | Fraction], float]:
        return lambda time: max(self.gap(phase, time) for phase in launches)
