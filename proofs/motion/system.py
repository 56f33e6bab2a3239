"""The parameters of one oscillator, exact, and what they say at once."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any

from proofs.trusted.equations import Launch, launch
from proofs.trusted.parameters import Place


@dataclass(frozen=True)
class System:
    """eta = omega_n / omega > 0 and nu = -beta / p != 0, as exact rationals."""

    eta: Fraction
    nu: Fraction

    def __post_init__(self) -> None:
        if self.eta <= 0:
            raise ValueError(f"eta must be positive, not {self.eta}")
        if self.nu == 0:
            raise ValueError("nu must not be 0: the table would stand still")

    @property
    def side(self) -> int:
        """The sign of nu: flight means side * (scaled distance) > 0. side = -1 is p > 0."""
        return 1 if self.nu > 0 else -1

    def launched(self, phases: Any) -> Launch:
        """Return launches in floating point, at a phase or an array of them."""
        return launch(self.side, float(self.eta), float(self.nu), phases)

    @cached_property
    def place(self) -> Place:
        """The same as what conclusions are about, with plastic impacts."""
        return Place.plastic(self.eta, self.nu)

    @cached_property
    def separation_sine(self) -> Fraction | None:
        """The paper's sin(phi_s) = eta^2 / (nu (1 - eta^2)); None at eta = 1."""
        if self.eta == 1:
            return None
        return self.eta**2 / (self.nu * (1 - self.eta**2))

    @cached_property
    def sticking_arc(self) -> str:
        """ "none", "some" or "all": which phases stick after a plastic impact.

        The launch acceleration side (nu (1 - eta^2) sin(phi) - eta^2) changes sign on the
        circle exactly if |sin(phi_s)| < 1; else its sign is that of -side.
        """
        sine = self.separation_sine
        if sine is not None and abs(sine) < 1:
            return "some"
        return "none" if self.side < 0 else "all"
