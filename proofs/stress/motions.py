"""Motions: the plastic map, the map with restitution, and the binary64 kernel, each as a case."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from intervals import Undecided
from proofs.motion.covering import cover_by_impacts
from proofs.motion.flight import Flight
from proofs.motion.image import Image, PossibleImages, image
from proofs.motion.impact import NoImpact, Sticks, first_impact, locate
from proofs.motion.rebound import rebound
from proofs.motion.slope_cover import BINARY64, slope_cover
from proofs.motion.system import System
from proofs.stress.cases import Answer, Ranges, Truth, Unknown
from proofs.stress.kernels import Kernel
from proofs.stress.truth import Launched
from proofs.stress.truth import first_impact as true_impact
from proofs.trusted.numbers import Range

_SAMPLES = (Fraction(0), Fraction(1, 2), Fraction(1), Fraction(281, 1009))


@dataclass(frozen=True)
class ImageCase:
    """The plastic map over the launch phases [low, high], a point or an interval."""

    family: str
    eta: Fraction
    nu: Fraction
    low: Fraction
    high: Fraction
    digits: int = 30
    horizon: Fraction = Fraction(1000)

    def answer(self) -> Answer:
        """Return bounds of flight, phase and slope, or the set of possible images."""
        found = image(self._system, (self.low, self.high), digits=self.digits, horizon=self.horizon)
        if isinstance(found, PossibleImages):
            return _possible(found)
        return Answer(((_named(found),),))

    def bits(self) -> int | None:
        """Return the precision at which the first impacts are found: 53, 64, 128, ..."""
        phases = (self.low, self.high)
        try:
            if self.low < self.high:
                parts = cover_by_impacts(self._system, phases, horizon=self.horizon)
                return max(part.flight.precision for part in parts)
            for finest in (Fraction(1, 8), Fraction(1, 256)):
                flight = Flight(self._system, phases, BINARY64)
                if _transversal(flight, self.horizon, finest):
                    return BINARY64
            return locate(self._system, phases, horizon=self.horizon).flight.precision
        except Undecided:
            return None

    def truths(self, kernel: Kernel) -> Sequence[Truth | None]:
        """Return the truth at the ends and inside."""
        return [
            _truth(kernel, Launched(self.eta, self.nu, phi), self.horizon)
            for phi in _samples(self.low, self.high)
        ]

    def best(self, name: str, hull: Range) -> Fraction:
        """Return the width of the true values and of the digits asked for."""
        return hull[1] - hull[0] + max(map(abs, hull)) / Fraction(10) ** self.digits

    @property
    def _system(self) -> System:
        return System(self.eta, self.nu)


def _possible(found: PossibleImages) -> Answer:
    images = tuple({"flight": time, "phase": phase} for time, phase in found.images)
    return Answer((images,), possible=True)


def _named(found: Image) -> Ranges:
    named = {"flight": found.flight, "phase": found.phase, "slope": found.slope}
    return named if found.dwell is None else named | {"dwell": found.dwell}


def _transversal(flight: Flight, horizon: Fraction, finest: Fraction) -> bool:
    try:
        return first_impact(flight, horizon, finest).transversal
    except (NoImpact, Sticks):
        raise
    except Undecided:
        return False


def _truth(kernel: Kernel, of: Launched, horizon: Fraction) -> Truth | None:
    try:
        return true_impact(kernel, of, horizon)
    except (Unknown, ArithmeticError):
        return None


def _samples(low: Fraction, high: Fraction) -> list[Fraction]:
    return sorted({low + share * (high - low) for share in _SAMPLES})


@dataclass(frozen=True)
class ReboundCase:
    """The map with restitution at the phases [low, high] and one velocity."""

    family: str
    eta: Fraction
    nu: Fraction
    low: Fraction
    high: Fraction
    epsilon: Fraction
    gamma: Fraction
    digits: int = 30
    horizon: Fraction = Fraction(1000)

    def answer(self) -> Answer:
        """Return bounds of flight, phase, velocity and DF."""
        system, phases = System(self.eta, self.nu), (self.low, self.high)
        found = rebound(
            system, phases, (self.gamma, self.gamma), self.epsilon,
            digits=self.digits, horizon=self.horizon,
        )  # fmt: skip
        named = {"flight": found.flight, "phase": found.phase, "velocity": found.velocity}
        for row, of in zip(found.jacobian, ("phase", "velocity"), strict=True):
            for bounds, by in zip(row, ("phi", "gamma"), strict=True):
                named[f"{of} by {by}"] = bounds
        return Answer(((named,),))

    def bits(self) -> int | None:
        """Return None: the search does not tell."""
        return None

    def truths(self, kernel: Kernel) -> Sequence[Truth | None]:
        """Return the truth at the ends and inside."""
        return [
            _truth(kernel, Launched(self.eta, self.nu, phi, self.epsilon, self.gamma), self.horizon)
            for phi in _samples(self.low, self.high)
        ]

    def best(self, name: str, hull: Range) -> Fraction:
        """Return the width of the true values and of the digits asked for."""
        return hull[1] - hull[0] + max(map(abs, hull)) / Fraction(10) ** self.digits


@dataclass(frozen=True)
class CoverCase:
    """The binary64 kernel over [low, high] in `boxes` boxes, seen at three phases of one.

    A box that binary64 does not decide is asked again, alone, in higher precision.
    """

    family: str
    eta: Fraction
    nu: Fraction
    low: Fraction
    high: Fraction
    boxes: int

    def answer(self) -> Answer:
        """Return bounds of flight and slope on the box around each sample."""
        found = slope_cover(System(self.eta, self.nu), (self.low, self.high), self.boxes)
        rows = []
        for x in self._points():
            k = int(np.searchsorted(found.boxes.inf, float(x), side="right")) - 1
            rows.append(({name: _bounds(part[k]) for name, part in
                          (("flight", found.times), ("slope", found.slopes))},))  # fmt: skip
        return Answer(tuple(rows), int(found.bits.max()))

    def _box(self) -> Range:
        width = (self.high - self.low) / self.boxes
        low = self.low + self.boxes // 2 * width
        return low, low + width

    def _points(self) -> list[Fraction]:
        low, high = self._box()
        return [low + share * (high - low) / 8 for share in (1, 4, 7)]

    def bits(self) -> int | None:
        """Return None: the answer says."""
        return None

    def truths(self, kernel: Kernel) -> Sequence[Truth | None]:
        """Return the truth at the three phases."""
        return [
            _truth(kernel, Launched(self.eta, self.nu, x), Fraction(1000)) for x in self._points()
        ]

    def best(self, name: str, hull: Range) -> Fraction:
        """Return the width over the whole box, from that over 6/8 of it, and of binary64."""
        return (hull[1] - hull[0]) * 4 / 3 + max(map(abs, hull)) / 2**52


def _bounds(one: object) -> Range:
    return Fraction(float(one.inf)), Fraction(float(one.sup))  # type: ignore[attr-defined]
