"""Motions: the plastic map and the map with restitution, each as a case."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import KW_ONLY, dataclass
from fractions import Fraction
from itertools import product

from proofs.benchmark.peers import Arithmetic, Range
from proofs.motion.system import System
from proofs.search.image import PossibleImages, image
from proofs.search.rebound import rebound
from proofs.stress.cases import Answer, Case, Truth
from proofs.stress.truth import Launched
from proofs.stress.truth import first_impact as true_impact

_SAMPLES = (Fraction(0), Fraction(281, 1009), Fraction(1, 2), Fraction(1))
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
        found = image(System(self.eta, self.nu), phases, digits=self.digits, horizon=self.horizon)
        if isinstance(found, PossibleImages):
            return [{"flight": time, "phase": phase} for time, phase in found.images]
        named = {"flight": found.flight, "phase": found.phase, "slope": found.slope}
        if found.dwell is not None:
            named["dwell"] = found.dwell
        return named


@dataclass(frozen=True)
class ReboundCase(MapCase):
    """The map with restitution at one velocity."""

    epsilon: Fraction
    gamma: Fraction

    def answer(self) -> Answer:
        """Return bounds of flight, phase, velocity and DF."""
        system = System(self.eta, self.nu)
        phases, velocities = (self.low, self.high), (self.gamma, self.gamma)
        asked = system, phases, velocities, self.epsilon
        found = rebound(*asked, digits=self.digits, horizon=self.horizon)
        named = {"flight": found.flight, "phase": found.phase, "velocity": found.velocity}
        entries = product(("phase", "velocity"), ("phi", "gamma"))
        named |= {f"{of} by {by}": x for (of, by), x in zip(entries, found.jacobian, strict=True)}
        return named

    def launched(self, phi: Fraction) -> Launched:
        """Return one of the launches."""
        return Launched(self.eta, self.nu, phi, self.epsilon, self.gamma)
