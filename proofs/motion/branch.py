"""A branch of the impact map: an interval of phases on which the first impact is transversal."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction

from proofs.motion.brackets import halvings_for, impact_time, impact_times
from proofs.motion.witness import FLOATS, FlightBox
from proofs.trusted.equations import Clock, Launch, gap, slope
from proofs.trusted.flights import FirstImpact, Motion, bracketed
from proofs.trusted.kernel.arithmetic import Dual, Enclosure, Unproved
from proofs.trusted.kernel.gaps import fall
from proofs.trusted.numbers import Range, within

_SPARE = 5  # halvings of a window beyond the width of the phases


@dataclass(frozen=True)
class Branch:
    """f on an interval that is cut into parts, each with a transversal first impact: f is C^1.

    parts: the steps that prove it, with their names. Times of one launch are bracketed to
    2^(1 - bits), those of an interval of launches as the gap's signs allow, as floats show them if
    wanted; each is found once, and proved by `bracketed`.
    """

    parts: Sequence[tuple[str, FirstImpact]]
    bits: int
    floats: bool = True
    _known: dict[Range, tuple[Motion, Range]] = field(default_factory=dict, repr=False)

    def __post_init__(self) -> None:
        """Raise Unproved where a part is not proved transversal."""
        if not all(part.transversal for _, part in self.parts):
            raise Unproved("the first impact is not transversal")

    @property
    def ends(self) -> list[Fraction]:
        """The ends of the parts, in order."""
        phases = [part.motion.phases for _, part in self.parts]
        return [*(low for low, _ in phases), phases[-1][1]]

    def part(self, phases: Range) -> tuple[str, FirstImpact]:
        """Return the part that these phases lie in, with its name."""
        return next(each for each in self.parts if within(phases, each[1].motion.phases))

    def flight(self, low: Fraction, high: Fraction) -> tuple[Motion, Range]:
        """Return the launches in [low, high], a subset of one part, and when they have impacts."""
        phases = low, high
        if phases not in self._known:
            _, part = self.part(phases)
            flights, window = FlightBox.plastic(part.at, phases), part.windows[0]
            if low == high:
                time = impact_time(flights, window, self.bits)
            else:
                bits = FLOATS if self.floats else part.motion.bits
                halvings = halvings_for(window, high - low, _SPARE)
                time = impact_times(flights.gap_of(bits and bits + halvings), window, halvings)
            self._known[phases] = bracketed(part, phases, time), time
        return self._known[phases]

    def slope(self, low: Fraction, high: Fraction) -> Range:
        """Enclose f' over [low, high], a subset of one part."""
        start, now, down = self._impacts(low, high)[1:]
        value: Enclosure = slope(start, now, down)
        return value.range

    def curvature(self, low: Fraction, high: Fraction) -> Range:
        """Enclose f'': the derivative of the slope along (phi + s, t + (f' - 1) s)."""
        motion, start, now, down = self._impacts(low, high)
        time, faster = self.flight(low, high)[1], slope(start, now, down) - 1
        change = gap(motion.moving, now, 1).derivative + gap(start, now, 2) * faster
        later = motion.clock(Dual(Enclosure.of(*time, motion.bits), faster))
        bent: Dual = slope(motion.moving, later, Dual(down, change))
        return bent.derivative.range

    def _impacts(self, low: Fraction, high: Fraction) -> tuple[Motion, Launch, Clock, Enclosure]:
        """Return the launches in [low, high], with their states, and clock and gap' at impacts."""
        motion, time = self.flight(low, high)
        return motion, motion.start(), motion.clock(time), fall(motion.gap_of, time)
