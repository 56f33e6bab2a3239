"""Motions: the plastic map, the map with restitution, and the binary64 kernel, each as a case."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import KW_ONLY, dataclass
from fractions import Fraction

import numpy as np

from intervals import IntervalArray
from proofs.benchmark.peers import Arithmetic, Range
from proofs.motion.slope_cover import slope_cover
from proofs.motion.system import System
from proofs.search.image import PossibleImages, image
from proofs.search.rebound import rebound
from proofs.stress.cases import Answer, Case, Truth
from proofs.stress.truth import Launched
from proofs.stress.truth import first_impact as true_impact

_SAMPLES = (Fraction(0), Fraction(281, 1009), Fraction(1, 2), Fraction(1))
_BOX_SAMPLES = (Fraction(1, 8), Fraction(1, 2), Fraction(7, 8))
_HORIZON = Fraction(1000)


@dataclass(frozen=True)
class MapCase(Case):
    """A map over the launch phases [low, high], a point or an interval."""

    eta: Fraction
    nu: Fraction
    low: Fraction
    high: Fraction
    _: KW_ONLY
    digits: int = 30
    horizon: Fraction = _HORIZON

    @property
    def system(self) -> System:
        """The oscillator."""
        return System(self.eta, self.nu)

    def launched(self, phi: Fraction) -> Launched:
        """Return one of the launches."""
        return Launched(self.eta, self.nu, phi)

    def truths(self, kernel: Arithmetic) -> Sequence[Truth | None]:
        """Return the truth at the ends and inside."""
        phases = sorted({self.low + share * (self.high - self.low) for share in _SAMPLES})
        return [_truth(kernel, self.launched(phi), self.horizon) for phi in phases]

    def best(self, hull: Range) -> Fraction:
        """Return the width of the true values and of the digits asked for."""
        return hull[1] - hull[0] + max(map(abs, hull)) / Fraction(10) ** self.digits


def _truth(kernel: Arithmetic, of: Launched, horizon: Fraction) -> Truth | None:
    try:
        return true_impact(kernel, of, horizon)
    except ArithmeticError:
        return None


@dataclass(frozen=True)
class ImageCase(MapCase):
    """The plastic map."""

    def answer(self) -> Answer:
        """Return bounds of flight, phase and slope, or the set of possible images."""
        phases = self.low, self.high
        found = image(self.system, phases, digits=self.digits, horizon=self.horizon)
        if isinstance(found, PossibleImages):
            images = tuple({"flight": time, "phase": phase} for time, phase in found.images)
            return Answer((images,), possible=True)
        named = {"flight": found.flight, "phase": found.phase, "slope": found.slope}
        if found.dwell is not None:
            named["dwell"] = found.dwell
        return Answer(((named,),))


@dataclass(frozen=True)
class ReboundCase(MapCase):
    """The map with restitution at one velocity."""

    epsilon: Fraction
    gamma: Fraction

    def answer(self) -> Answer:
        """Return bounds of flight, phase, velocity and DF."""
        phases, velocities = (self.low, self.high), (self.gamma, self.gamma)
        found = rebound(
            self.system,
            phases,
            velocities,
            self.epsilon,
            digits=self.digits,
            horizon=self.horizon,
        )
        named = {"flight": found.flight, "phase": found.phase, "velocity": found.velocity}
        for of, row in zip(("phase", "velocity"), found.jacobian, strict=True):
            for by, bounds in zip(("phi", "gamma"), row, strict=True):
                named[f"{of} by {by}"] = bounds
        return Answer(((named,),))

    def launched(self, phi: Fraction) -> Launched:
        """Return one of the launches."""
        return Launched(self.eta, self.nu, phi, self.epsilon, self.gamma)


@dataclass(frozen=True)
class CoverCase(Case):
    """The binary64 kernel over [low, high] in `boxes` boxes, seen at three phases of one.

    A box that binary64 does not decide is asked again, alone, in higher precision.
    """

    eta: Fraction
    nu: Fraction
    low: Fraction
    high: Fraction
    boxes: int

    def answer(self) -> Answer:
        """Return bounds of flight and slope on the box around each sample."""
        found = slope_cover(System(self.eta, self.nu), (self.low, self.high), self.boxes)
        samples = []
        for x in self._points():
            k = int(np.searchsorted(found.boxes.inf, float(x), side="right")) - 1
            parts = {"flight": found.times[k], "slope": found.slopes[k]}
            samples.append(({name: _ends(part) for name, part in parts.items()},))
        return Answer(tuple(samples))

    def _points(self) -> list[Fraction]:
        """Return three phases of the box in the middle."""
        width = (self.high - self.low) / self.boxes
        low = self.low + self.boxes // 2 * width
        return [low + share * width for share in _BOX_SAMPLES]

    def truths(self, kernel: Arithmetic) -> Sequence[Truth | None]:
        """Return the truth at the three phases."""
        launches = [Launched(self.eta, self.nu, x) for x in self._points()]
        return [_truth(kernel, of, _HORIZON) for of in launches]

    def best(self, hull: Range) -> Fraction:
        """Return the width over the whole box, from that over 6/8 of it, and of binary64."""
        return (hull[1] - hull[0]) * 4 / 3 + max(map(abs, hull)) / 2**52


def _ends(x: IntervalArray) -> Range:
    return Fraction(float(x.inf)), Fraction(float(x.sup))
