"""Bounces on the arc of phases where the table pushes the mass: brackets for the lemmas.

The lemmas, with their proofs and what proves their hypotheses, are in `s34_circle.bounces`: where
the launch acceleration is negative along a flight, the gap has one zero at most, the speed changes
little (Lemma 1), and bounces that are weak enough add up to a rest (Lemma 2).
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from intervals import Undecided
from proofs.trusted.equations import clock, gap, launch, launch_acceleration
from proofs.trusted.flights import Motion, lifted
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.numbers import COVER_BITS, Range
from proofs.trusted.paper.s34_circle.bounces import Box, State, bounce, kicked, rest_phase
from proofs.trusted.paper.s34_circle.landing import Separation
from proofs.trusted.paper.s34_circle.persistence import Cell
from proofs.trusted.parameters import Place

BITS = 256  # of states that are followed far
_WIDENINGS = 7
_NEWTON = 3  # steps, each doubling the digits
_CLOSE = 1e-12
_MOST_BOUNCES = 60


def around(arc: Separation, spread: Fraction) -> Box:
    """Return a box of states about so far around that at which the flight from phi_s ends."""
    phases = arc.arrival if arc.arrival[0] > 0 else lifted(arc.arrival, 1, BITS)
    (phase, speed), grid = ((low + high) / 2 for low, high in (phases, arc.speed)), spread / 1000
    motion = Motion(arc.at, (phase, phase), BITS)
    start = motion.start
    gamma = ((Enclosure.of(speed, speed, BITS) * motion.side - start.rate) / start.eta).range[0]
    centre = (round(x / grid) * grid for x in (phase, gamma))
    low, high = ((x - spread, x + spread) for x in centre)
    return low, high


@dataclass(frozen=True)
class Pushing:
    """The arc of phases up to `last` on which the launch acceleration is known to be negative.

    bits: of enclosures; times and phases of a witness are multiples of 1 / grid.
    """

    at: Place
    last: Fraction
    bits: int = COVER_BITS
    grid: int = 2**24

    def settle(
        self, epsilon: Range, phases: Range, speeds: Range, leave: Range | None = None
    ) -> tuple[Cell, Fraction | None]:
        """Prove that impacts at these phases, with these speeds before, end in rest before `last`.

        Bounces are enclosed one by one until Lemma 2 applies, or the mass flies at all phases of
        `leave`. Return them, and when they end, if they do; Undecided if a bounce may leave the
        arc, or they become so many that neither is so.
        """
        bounces: list[Range] = []
        while len(bounces) < _MOST_BOUNCES:
            kicks = epsilon[0] * speeds[0], epsilon[1] * speeds[1]
            rest = rest_phase(self.at, phases, kicks[1], epsilon[1], self.last)
            if rest is not None or (leave is not None and self.flies(phases, kicks, leave)):
                return Cell(epsilon, bounces), rest
            time, (phases, speeds) = self.bounce(phases, kicks)
            bounces.append(time)
        raise Undecided(f"{_MOST_BOUNCES} bounces and no rest")

    def bounce(self, phases: Range, kicks: Range) -> tuple[Range, State]:
        """Bracket the next impact after all bounces given; return times, and the next state.

        kicks: the relative velocities after the impact, > 0. The bracket is opened around
        floating-point candidates until the signs of the gap are proved.
        """
        if kicks[0] <= 0:
            raise Undecided("a bounce as weak as one likes is no bounce that can be bracketed")
        gap_of = kicked(self.at, phases, kicks, self.bits)
        about = [self.candidate(phi, w) for phi in phases for w in kicks]
        opening = (max(about) - min(about)) / 8 + Fraction(2**8, self.grid)
        low, high = _down(min(about), self.grid), _up(max(about), self.grid)
        for _ in range(_WIDENINGS):
            below, above = gap_of((low, low), 0).lo > 0, gap_of((high, high), 0).hi < 0
            if below and above:
                break
            low = low if below else max(_down(low - opening, self.grid), low / 2)
            high = high if above else _up(high + opening, self.grid)
            opening *= 2
        else:
            raise Undecided("the end of a bounce is not bracketed")
        if phases[1] + high > self.last:
            raise Undecided("a bounce may leave the arc on which the table pushes")
        try:
            return (low, high), bounce(self.at, phases, kicks, (low, high), self.bits)
        except Unproved as failure:
            raise Undecided(str(failure)) from None

    def candidate(self, phase: Fraction, kick: Fraction) -> Fraction:
        """Return about the time of the next impact, by Newton's method from the parabola's."""
        time = Fraction(self._seen(float(phase), float(kick)))
        if self.bits > COVER_BITS:
            gap_of = kicked(self.at, (phase, phase), (kick, kick), self.bits)
            for _ in range(_NEWTON):
                value, slope = (gap_of((time, time), order).range[0] for order in (0, 1))
                time = _down(time - value / slope, self.grid)
        return time

    def _seen(self, phase: float, kick: float) -> float:
        eta, nu = map(float, self.at.point)
        side = self.at.side
        start = launch(side, eta, nu, phase)._replace(kick=side * kick)
        if (acceleration := launch_acceleration(start)) >= 0:
            raise Undecided("in floating point a bounce begins off the arc")
        time = 2 * kick / -acceleration
        for _ in range(_WIDENINGS):
            now = clock(eta, time)
            if gap(start, now, 1) >= 0:
                raise Undecided("in floating point a bounce leaves the arc")
            step = gap(start, now) / gap(start, now, 1)
            time -= step
            if abs(step) < _CLOSE * time:
                break
        return float(time)

    def flies(self, phases: Range, kicks: Range, until: Range) -> bool:
        """Whether gap > 0 at all phases `until` after all these launches."""
        times = until[0] - phases[1], until[1] - phases[0]
        return kicked(self.at, phases, kicks, self.bits)(times, 0).lo > 0


def _up(value: Fraction, grid: int) -> Fraction:
    return Fraction(-(-value * grid // 1), grid)


def _down(value: Fraction, grid: int) -> Fraction:
    return Fraction(value * grid // 1, grid)
