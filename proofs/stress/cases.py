"""What a case is: an exact input, what the library says of it, what is true of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from itertools import product
from random import Random
from typing import NamedTuple

from proofs.benchmark.peers import Arithmetic, Range
from proofs.motion.system import System
from proofs.search.image import PossibleImages, image
from proofs.search.rebound import rebound
from proofs.stress.truth import Launched, Ranges, Truth, first_impact

Answer = Ranges | list[Ranges]  # bounds by name; or of possible images, one of them true
Numbers = tuple[Fraction, Fraction]
ETA, NU = Fraction("0.2121"), Fraction("-0.2")
_SAMPLES = (Fraction(0), Fraction(281, 1009), Fraction(1, 2), Fraction(1))


class Case(NamedTuple):
    """One exact input of a family, from which it can be made again.

    ask: the library, which may raise. truths: what is true at samples, None where that is out of
    reach. least: the width that an answer has at least whose true values fill a range.
    """

    family: str
    given: Mapping[str, object]
    ask: Callable[[], Answer]
    truths: Callable[[Arithmetic], Sequence[Truth | None]]
    least: Callable[[Range], Fraction]

    def inputs(self) -> dict[str, str]:
        """Return family and input as text."""
        return {"family": self.family, **{name: str(x) for name, x in self.given.items()}}


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


def flight(
    family: str,
    oscillator: Numbers,
    phases: Numbers,
    digits: int = 30,
    horizon: int = 1000,
    *,
    before: Numbers | None = None,
) -> Case:
    """Return the map over launch phases, a point or an interval.

    before: epsilon and gamma, without which impacts are plastic.
    """
    (eta, nu), (low, high), far = oscillator, phases, Fraction(horizon)
    given = {"eta": eta, "nu": nu, "low": low, "high": high, "digits": digits, "horizon": far}
    if before is not None:
        given |= zip(("epsilon", "gamma"), before, strict=True)

    def ask() -> Answer:
        system = System(eta, nu)
        if before is not None:
            (epsilon, gamma), names = before, product(("phase", "velocity"), ("phi", "gamma"))
            seen = rebound(system, phases, (gamma, gamma), epsilon, digits=digits, horizon=far)
            bounds = {"flight": seen.flight, "phase": seen.phase, "velocity": seen.velocity}
            entries = zip(names, seen.jacobian, strict=True)
            return bounds | {f"{name} by {by}": entry for (name, by), entry in entries}
        images = image(system, phases, digits=digits, horizon=far)
        if isinstance(images, PossibleImages):
            return [{"flight": time, "phase": phase} for time, phase in images.images]
        bounds = {"flight": images.flight, "phase": images.phase, "slope": images.slope}
        return bounds if images.dwell is None else bounds | {"dwell": images.dwell}

    def truth(kernel: Arithmetic, phi: Fraction) -> Truth | None:
        try:
            return first_impact(kernel, Launched(eta, nu, phi, *(before or ())), far)
        except ArithmeticError:
            return None

    def truths(kernel: Arithmetic) -> Sequence[Truth | None]:
        samples = sorted({low + share * (high - low) for share in _SAMPLES})
        return [truth(kernel, phi) for phi in samples]

    def least(hull: Range) -> Fraction:
        return hull[1] - hull[0] + max(map(abs, hull)) / Fraction(10) ** digits

    return Case(family, given, ask, truths, least)
