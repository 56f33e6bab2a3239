"""Bounces on the arc of phases where the table pushes the mass, and the chatter that ends them.

The lemmas, with their proofs, are those of `s34_circle.bounces`: where the launch
acceleration is negative along a flight, the gap has one zero at most, the speed changes little
(Lemma 1), and bounces that are weak enough add up to a rest (Lemma 2).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction

from intervals import Interval, Undecided
from proofs.motion.system import System
from proofs.trusted.equations import Launch, clock, gap, launch, launch_acceleration
from proofs.trusted.flights import Motion, lifted
from proofs.trusted.kernel.arithmetic import Enclosure
from proofs.trusted.numbers import Range
from proofs.trusted.paper.s34_circle.landing import Separation
from proofs.trusted.paper.s34_circle.persistence import Box, Cell

BITS = 256  # of states that are followed far
_WIDENINGS = 7
_NEWTON = 3  # steps, each doubling the digits
_MOST_BOUNCES = 60
_RATIO_GRID = 2**10


def around(arc: Separation, spread: Fraction) -> Box:
    """Return a box of states about so far around that at which the flight from phi_s ends."""
    phases = arc.arrival if arc.arrival[0] > 0 else lifted(arc.arrival, 1, BITS)
    (phase, speed), grid = ((low + high) / 2 for low, high in (phases, arc.speed)), spread / 1000
    motion = Motion(arc.at, (phase, phase), BITS)
    start = motion.start()
    gamma = ((Enclosure.of(speed, speed, BITS) * motion.side - start.rate) / start.eta).range[0]
    centre = (round(x / grid) * grid for x in (phase, gamma))
    low, high = ((x - spread, x + spread) for x in centre)
    return low, high


@dataclass(frozen=True)
class Pushing:
    """The arc of phases up to `last` on which the launch acceleration is known to be negative.

    precision: of enclosures; times and phases of a witness are multiples of 1 / grid.
    """

    system: System
    last: Fraction
    precision: int = 53
    grid: int = 2**24

    def settle(self, epsilon: Range, phases: Range, speeds: Range) -> Cell:
        """Prove that impacts at these phases, with these speeds before, end in rest before `last`.

        Bounces are enclosed one by one until Lemma 2 applies; Undecided if a bounce may leave the
        arc, or the bounces become so many that it will not apply.
        """
        bounces: list[Range] = []
        kicks = epsilon[0] * speeds[0], epsilon[1] * speeds[1]
        while len(bounces) < _MOST_BOUNCES:
            ending = self.ending(epsilon[1], phases, kicks[1])
            if ending is not None:
                return Cell(epsilon, bounces, *ending)
            time, speeds = self.bounce(phases, kicks)
            bounces.append(time)
            phases = phases[0] + time[0], phases[1] + time[1]
            kicks = epsilon[0] * speeds[0], epsilon[1] * speeds[1]
        raise Undecided(f"{_MOST_BOUNCES} bounces and no rest")

    def accelerations(self, phases: Range) -> Interval:
        """Enclose the launch acceleration over an interval of phases."""
        value: Interval = launch_acceleration(self._launches(phases))
        return value

    def _launches(self, phases: Range) -> Launch:
        eta, nu = (Interval(x, precision=self.precision) for x in (self.system.eta, self.system.nu))
        return launch(self.system.side, eta, nu, Interval(*phases, precision=self.precision))

    def ending(
        self, epsilon: Fraction, phases: Range, kick: Fraction
    ) -> tuple[Fraction, Fraction] | None:
        """Return (ratio, rest) that satisfy the hypotheses of Lemma 2, None if none is found.

        The phase of rest is sought from below: the longer the arc, the weaker its push.
        """
        rest = phases[1]
        for _ in range(_WIDENINGS):
            acceleration = self.accelerations((phases[0], rest))
            weakest, strongest = -acceleration.sup, -acceleration.inf
            if weakest <= 0:
                return None
            least = float(epsilon) * math.sqrt(strongest / weakest) * (1 + 1e-9)
            ratio = _up(Fraction(least), _RATIO_GRID)
            if ratio >= 1:
                return None
            end = phases[1] + 2 * kick / (weakest * (1 - ratio))
            if end <= rest < self.last:
                return ratio, rest
            rest = _up(end + (end - phases[1]) / 16, self.grid)
        return None

    def bounce(self, phases: Range, kicks: Range) -> tuple[Range, Range]:
        """Bracket the next impact after all bounces given; return times and speeds.

        kicks: the relative velocities after the impact, > 0. The brackets are those of Lemma 1,
        opened around floating-point candidates until the signs of the gap are proved.
        """
        if kicks[0] <= 0:
            raise Undecided("a bounce as weak as one likes is no bounce that can be bracketed")
        kick = Interval(*kicks, precision=self.precision) * self.system.side
        start = self._launches(phases)._replace(kick=kick)
        about = [self.candidate(phi, w) for phi in phases for w in kicks]
        opening = (max(about) - min(about)) / 8 + Fraction(2**8, self.grid)
        low, high = _down(min(about), self.grid), _up(max(about), self.grid)
        for _ in range(_WIDENINGS):
            below = self._gap(start, (low, low)).certainly_positive()
            above = self._gap(start, (high, high)).certainly_negative()
            if below and above:
                break
            low = low if below else max(_down(low - opening, self.grid), low / 2)
            high = high if above else _up(high + opening, self.grid)
            opening *= 2
        else:
            raise Undecided("the end of a bounce is not bracketed")
        if phases[1] + high > self.last or self.system.eta * high > 3:
            raise Undecided("a bounce may leave the arc on which the table pushes")
        push = self.accelerations((phases[0], phases[1] + high))
        if not push.certainly_negative():
            raise Undecided("a bounce may leave the arc on which the table pushes")
        speed, change = -self._gap(start, (low, high), 1), (1 + push.inf / push.sup) / 2
        speeds = max(speed.inf, kicks[0] / change), min(speed.sup, kicks[1] * change)
        return (low, high), speeds

    def candidate(self, phase: Fraction, kick: Fraction) -> Fraction:
        """Return about the time of the next impact, by Newton's method from the parabola's."""
        time = Fraction(self._seen(float(phase), float(kick)))
        if self.precision > 53:
            start = self._launches((phase, phase))._replace(kick=kick * self.system.side)
            for _ in range(_NEWTON):
                time -= (self._gap(start, (time, time)) / self._gap(start, (time, time), 1)).mid
                time = _down(time, self.grid)
        return time

    def _seen(self, phase: float, kick: float) -> float:
        eta, nu = float(self.system.eta), float(self.system.nu)
        start = launch(self.system.side, eta, nu, phase)._replace(kick=self.system.side * kick)
        if (push := launch_acceleration(start)) >= 0:
            raise Undecided("in floating point a bounce begins off the arc")
        time = 2 * kick / -push
        for _ in range(_WIDENINGS):
            now = clock(eta, time)
            if gap(start, now, 1) >= 0:
                raise Undecided("in floating point a bounce leaves the arc")
            time -= gap(start, now) / gap(start, now, 1)
        return float(time)

    def flies(self, phases: Range, kicks: Range, until: Range) -> bool:
        """Whether gap > 0 at all phases `until` after all these launches."""
        times = until[0] - phases[1], until[1] - phases[0]
        kick = Interval(*kicks, precision=self.precision) * self.system.side
        start = self._launches(phases)._replace(kick=kick)
        return self._gap(start, times).certainly_positive()

    def _gap(self, start: Launch, times: Range, order: int = 0) -> Interval:
        now = clock(start.eta, Interval(*times, precision=self.precision))
        value: Interval = gap(start, now, order)
        return value


def _up(value: Fraction, grid: int) -> Fraction:
    return Fraction(-(-value * grid // 1), grid)


def _down(value: Fraction, grid: int) -> Fraction:
    return Fraction(value * grid // 1, grid)
