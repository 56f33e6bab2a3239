"""What a case is: an exact input, what the library says of it, what is true of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import KW_ONLY, dataclass
from fractions import Fraction
from itertools import product
from random import Random

from proofs.benchmark.peers import Arithmetic, Range
from proofs.motion.system import System
from proofs.search.image import PossibleImages, image
from proofs.search.rebound import rebound
from proofs.stress.truth import Launched, Ranges, Truth
from proofs.stress.truth import first_impact as true_impact

Answer = Ranges | list[Ranges]  # bounds by name; or of possible images, one of them true
Numbers = tuple[Fraction, Fraction]
ETA, NU = Fraction("0.2121"), Fraction("-0.2")


@dataclass(frozen=True)
class Case:
    """One exact input of a family: the case can be made again from its fields."""

    family: str

    def answer(self) -> Answer:
        """Ask the library; let it raise."""
        raise NotImplementedError

    def truths(self, kernel: Arithmetic) -> Sequence[Truth | None]:
        """Return the truth about every sample, None where it is out of reach."""
        raise NotImplementedError

    def best(self, hull: Range) -> Fraction:
        """Return the least width of an answer to this input, if `hull` are the true values."""
        raise NotImplementedError

    def inputs(self) -> dict[str, str]:
        """Return the fields as text."""
        return {name: str(getattr(self, name)) for name in self.__dataclass_fields__}


class Draw(Random):
    """Random numbers for the cases of one family; the same for a seed."""

    def __init__(self, seed: int, family: str) -> None:
        super().__init__(f"{seed} {family}")
        self.family = family

    def decimal(self, low: float, high: float, places: int = 6) -> Fraction:
        """Return a decimal between two numbers."""
        return Fraction(self.randint(int(low * 10**places), int(high * 10**places)), 10**places)

    def tiny(self, first: int, last: int) -> Fraction:
        """Return a number of the size 10^-first to 10^-last."""
        return self.decimal(1, 9.999, 3) / Fraction(10) ** self.randint(first, last)

    def sign(self) -> int:
        """Return -1 or 1."""
        return self.choice((-1, 1))

    def phase(self) -> Fraction:
        """Return a phase."""
        return self.decimal(0, 6.28)

    def system(self) -> Numbers:
        """Return the paper's parameters, or others with a sticking arc."""
        while True:
            if self.random() < 0.3:
                return ETA, NU
            eta = self.decimal(0.05, 2.5, 4)
            nu = self.sign() * self.decimal(0.05, 3, 4)
            if eta != 1 and abs(eta**2 / (nu * (1 - eta**2))) < Fraction(9, 10):
                return eta, nu


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
