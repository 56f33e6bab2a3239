"""The steps of a certificate about a box of oscillators, while they are proposed."""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction
from itertools import product
from typing import Any

from intervals import Undecided
from proofs.plane.flights import Flights, times_for
from proofs.trusted.certificate import SCHEMA, texts
from proofs.trusted.files import box_to_json, render
from proofs.trusted.numbers import Range
from proofs.trusted.parameters import Place

_HALVINGS = 1  # of phases whose flights are too different


@dataclass
class Steps:
    """Steps about a box; the last one is what the certificate claims."""

    box: Place
    steps: dict[str, dict[str, Any]] = field(default_factory=dict)

    def add(self, rule: str, witness: dict[str, Any]) -> str:
        """Add a step, and return its name."""
        name = f"{rule}-{len(self.steps) + 1}"
        self.steps[name] = {"rule": rule, "witness": witness}
        return name

    def impact(self, phases: Range, latest: float) -> tuple[str, list[Fraction]]:
        """Add the first impacts after launches in `phases`; return the step and its times.

        latest: about when the last of them comes.
        """
        times = times_for(Flights(self.box, phases), latest)
        return self.add("first-impact", {"phases": texts(phases), "times": texts(times)}), times

    def impacts(
        self, phases: Range, latest: float, halvings: int = _HALVINGS
    ) -> list[tuple[str, list[Fraction]]]:
        """Add the same in parts where that must be, in order."""
        try:
            return [self.impact(phases, latest)]
        except Undecided:
            if not halvings:
                raise
        low, high = phases
        parts = (low, (low + high) / 2), ((low + high) / 2, high)
        return [each for part in parts for each in self.impacts(part, latest, halvings - 1)]

    def certificate(self) -> str:
        """Return the certificate's text."""
        return render(
            {
                "schema": SCHEMA,
                "parameters": box_to_json(self.box),
                "functions": {},
                "steps": self.steps,
                "claims": [next(reversed(self.steps))],
            }
        )


def corners(box: Place) -> tuple[list[float], list[float]]:
    """Return eta and nu at the centre and at the corners of a box, in floating point."""
    etas, nus = box.eta, box.nu
    centre = (etas[0] + etas[1]) / 2, (nus[0] + nus[1]) / 2
    points: list[tuple[Fraction, Fraction]] = [centre, *product(etas, nus)]
    return [float(eta) for eta, _ in points], [float(nu) for _, nu in points]
