"""A branch of the impact map: an interval of phases on which the first impact is transversal."""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction
from typing import TYPE_CHECKING

from proofs.motion.flight import Flight
from proofs.motion.impact import FirstImpact, impact_time, time_range
from proofs.trusted.numbers import Range

if TYPE_CHECKING:
    from intervals import Interval


@dataclass(frozen=True)
class Branch:
    """f on an interval that is cut into parts, each with a transversal first impact: f is C^1.

    Times of one launch are enclosed to 2^(1 - bits), those of an interval of launches as the
    gap's signs allow; each is found once.
    """

    parts: tuple[FirstImpact, ...]
    bits: int
    _times: dict[Range, Range] = field(default_factory=dict, repr=False, compare=False)

    @property
    def ends(self) -> list[Fraction]:
        """The ends of the parts, in order."""
        return [p.flight.phases[0] for p in self.parts] + [self.parts[-1].flight.phases[1]]

    def part(self, low: Fraction, high: Fraction) -> FirstImpact:
        """Return the part that [low, high] lies in."""
        return next(
            p for p in self.parts if p.flight.phases[0] <= low and high <= p.flight.phases[1]
        )

    def time(self, low: Fraction, high: Fraction) -> Range:
        """Enclose the impact times of all launches in [low, high], a subset of one part."""
        key = low, high
        if key not in self._times:
            part = self.part(low, high)
            thin = low == high
            self._times[key] = impact_time(part, key, self.bits) if thin else time_range(part, key)
        return self._times[key]

    def _flight(self, low: Fraction, high: Fraction) -> Flight:
        part, phases = self.part(low, high), (low, high)
        return part.thin(phases, self.bits) if low == high else part.part(phases)

    def slope(self, low: Fraction, high: Fraction) -> Interval:
        """Enclose f' over [low, high], a subset of one part."""
        return self._flight(low, high).slope(self.time(low, high))

    def curvature(self, low: Fraction, high: Fraction) -> Interval:
        """Enclose f'' over [low, high], a subset of one part."""
        return self._flight(low, high).slope_and_curvature(self.time(low, high))[1]
