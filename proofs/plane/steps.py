"""The steps of a certificate about a box of oscillators, while they are proposed."""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction
from itertools import product
from typing import Any

from intervals import Undecided
from intervals.cover import halves
from proofs.trusted.certificate import SCHEMA
from proofs.trusted.files import box_to_json, render
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.enclose import enclosed
from proofs.trusted.numbers import Range
from proofs.trusted.oscillator import PlasticMap
from proofs.trusted.parameters import Place
from proofs.trusted.windows import BITS

_NOT_SEEN = "no transversal first impact is seen"
_HALVINGS = 1  # of phases whose flights are too different
_LATER = Fraction(11, 2)  # than the last impact that is seen, at most


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

    def windows(
        self, phases: Range, latest: float, halvings: int = _HALVINGS
    ) -> dict[Range, Range]:
        """Return the windows of the first impacts after launches in parts of `phases`, in order.

        latest: about when the last of them comes. Raises Undecided where they are not proved
        transversal.
        """
        function = PlasticMap(self.box, Fraction(latest) + _LATER)
        try:
            return {phases: function.window(enclosed((phases,), BITS))}
        except Unproved:
            if not halvings:
                raise Undecided(_NOT_SEEN) from None
        left, right = (self.windows(part, latest, halvings - 1) for part in halves(phases))
        return left | right

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
