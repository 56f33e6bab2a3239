"""What a case is: an exact input, what the library says of it, and what is true of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from random import Random

from proofs.benchmark.peers import Arithmetic, Range

Ranges = dict[str, Range]
Answer = Ranges | list[Ranges]  # bounds by name; or of possible images, one of them true
System = tuple[Fraction, Fraction]
ETA, NU = Fraction("0.2121"), Fraction("-0.2")


@dataclass(frozen=True)
class Truth:
    """Bounds of true values, by name; none of them, and a reason, where there is no value."""

    known: Ranges
    reason: str = ""


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

    def system(self) -> System:
        """Return the paper's parameters, or others with a sticking arc."""
        while True:
            if self.random() < 0.3:
                return ETA, NU
            eta = self.decimal(0.05, 2.5, 4)
            nu = self.sign() * self.decimal(0.05, 3, 4)
            if eta != 1 and abs(eta**2 / (nu * (1 - eta**2))) < Fraction(9, 10):
                return eta, nu
