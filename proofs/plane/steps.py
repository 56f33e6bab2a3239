"""The steps of a certificate about a box of oscillators, while they are proposed."""

from __future__ import annotations

from bisect import bisect
from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import product
from typing import Any

from intervals import Undecided
from intervals.cover import halves
from proofs.motion.witness import Flights
from proofs.trusted.certificate import SCHEMA
from proofs.trusted.files import box_to_json, render
from proofs.trusted.flights import Motion
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.enclose import enclosed
from proofs.trusted.kernel.gaps import Gap, falls
from proofs.trusted.numbers import COVER_BITS, Range
from proofs.trusted.oscillator import PlasticMap
from proofs.trusted.parameters import Place
from proofs.trusted.windows import BITS

_NOT_SEEN = "no transversal first impact is seen"
_HALVINGS = 1  # of phases whose flights are too different
_LATER = Fraction(11, 2)  # than the last impact that is seen, at most
_CUTS, _FALLS = 9, 4  # halvings of the window of an impact: for a bracket, and until the gap falls
_SHARES = (
    Fraction(1),
    Fraction(1, 8),
    Fraction(1, 64),
)  # of the window, after the last impact that is seen


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


def times_for(flights: Flights, orders: Sequence[int], latest: float) -> list[Fraction]:
    """Return times for `first_windows`, of flights that end at about `latest` at most.

    orders: of which one derivative of the gap is > 0 at launch. Raises Undecided where none seem to
    prove a transversal first impact.
    """
    try:
        *times, begin, end = flights.times(orders, Fraction(latest) + _LATER)
    except Unproved:
        raise Undecided(_NOT_SEEN) from None
    last = impact_times(flights.gap_of, (begin, end), _CUTS)[1]
    for share in _SHARES:
        soon = last + (end - begin) * share
        if falls(flights.gap_of, (begin, soon), _FALLS):
            return [*times, begin, soon]
    raise Undecided(_NOT_SEEN)


def impact_times(gap_of: Gap, window: Range, halvings: int) -> Range:
    """Bracket the impacts of all launches of a set, as the signs of their gaps allow.

    To multiples of 2^-halvings of the window: where the gap is > 0 for all launches no zero lies
    before, where it is < 0 none lies after.
    """
    (low, high), count = window, 2**halvings
    unit = (high - low) / count
    inner = range(1, count)
    first = bisect(inner, False, key=lambda k: gap_of((low + k * unit,) * 2, 0).lo <= 0)
    last = bisect(inner, False, key=lambda k: gap_of((high - k * unit,) * 2, 0).hi >= 0)
    return low + first * unit, high - last * unit


def bracket(box: Place, phases: Range, times: list[Fraction]) -> Range:
    """Bracket all first impacts after some phases, in the last of the pieces between times."""
    gap_of = Motion(box, phases, COVER_BITS).sharp_gap
    return impact_times(gap_of, (times[-2], times[-1]), _CUTS)


def corners(box: Place) -> tuple[list[float], list[float]]:
    """Return eta and nu at the centre and at the corners of a box, in floating point."""
    etas, nus = box.eta, box.nu
    centre = (etas[0] + etas[1]) / 2, (nus[0] + nus[1]) / 2
    points: list[tuple[Fraction, Fraction]] = [centre, *product(etas, nus)]
    return [float(eta) for eta, _ in points], [float(nu) for _, nu in points]
