"""The impact map with restitution, F of (14) and (15): flights from sets of states at impact."""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING

from intervals.errors import Undecided
from proofs.motion.flight import Flight
from proofs.motion.impact import HORIZON, FirstImpact, NoImpact, first_impact, impact_time, narrowed
from proofs.trusted.equations import (
    Launch,
    arrival,
    closing,
    flight_derivative,
    gap,
    launch,
    launch_with_restitution,
    return_map_derivative,
)
from proofs.trusted.kernel.arithmetic import Dual
from proofs.trusted.numbers import Range

if TYPE_CHECKING:
    from intervals import Interval

    Matrix = tuple[tuple[Interval, Interval], tuple[Interval, Interval]]
_NONE = Fraction(0)


@dataclass(frozen=True, kw_only=True)
class Rebounds(Flight):
    """All flights after an impact at a phase of `phases` with a velocity of `velocities`.

    The velocity is that before the impact, gamma = v / (omega_n p). The oscillators are all those
    with epsilon in its range, eta and nu within `eta_reach` and `nu_reach` of the system's.
    """

    velocities: Range
    epsilon: Range
    eta_reach: Fraction = _NONE
    nu_reach: Fraction = _NONE

    def __post_init__(self) -> None:
        """Raise ValueError where eta, nu or epsilon could leave the model."""
        if not (0 <= self.eta_reach < self.system.eta and 0 <= self.nu_reach < abs(self.system.nu)):
            raise ValueError("the ranges of eta and nu must keep away from 0")
        if not 0 <= self.epsilon[0] <= self.epsilon[1] <= 1:
            raise ValueError("epsilon must lie in [0, 1]")

    @property
    def etas(self) -> Range:
        """The range of the frequency ratio."""
        return self.system.eta - self.eta_reach, self.system.eta + self.eta_reach

    @cached_property
    def gamma(self) -> Interval:
        """The velocities before the impact."""
        value: Interval = self.number(*self.velocities)
        return value

    @cached_property
    def restitution(self) -> Interval:
        """The coefficients of restitution."""
        value: Interval = self.number(*self.epsilon)
        return value

    @property
    def _nu(self) -> Interval:
        nu, reach = self.system.nu, self.nu_reach
        value: Interval = self.number(nu - reach, nu + reach)
        return value

    def _launch(self, phi: Interval | Dual) -> Launch:
        return launch_with_restitution(
            self.system.side, self.eta, self._nu, phi, epsilon=self.restitution, gamma=self.gamma
        )

    @cached_property
    def closing_speed(self) -> Interval:
        """The speed -gap' >= 0 with which mass and table meet; < 0 is physically impossible."""
        value: Interval = closing(self.start, self.gamma)
        return value if self.system.side > 0 else -value

    @property
    def single(self) -> bool:
        """Whether this is one flight."""
        ranges = (self.phases, self.velocities, self.epsilon)
        return self.eta_reach == self.nu_reach == 0 and all(low == high for low, high in ranges)

    @property
    def narrowest(self) -> Fraction:
        """The width of the narrowest side of a box of flights that is no point."""
        ranges = (self.phases, self.velocities, self.epsilon)
        widths = [*(high - low for low, high in ranges), 2 * self.eta_reach, 2 * self.nu_reach]
        return min(width for width in widths if width > 0)

    @property
    def leaves(self) -> bool:
        """Whether each flight begins with gap' > 0 or gap'' > 0.

        Undecided unless each state is proved possible.
        """
        if self.closing_speed.inf < 0:
            raise Undecided("a state before the impact is not proved possible: gap' <= 0 there")
        return super().leaves or self.gap(_NONE, order=1).certainly_positive()

    def rises(self, until: Fraction) -> bool:
        """Whether gap > 0 on (0, until]: as gap(0) = 0 <= gap'(0), gap'' > 0 or gap' > 0 does."""
        return any(self.gap(_NONE, until, order).certainly_positive() for order in (2, 1))

    def arrival_velocity(self, time: Range) -> Interval:
        """Enclose the velocity gamma of the mass at the times given: (15)."""
        value: Interval = arrival(self.start, self.clock(*time))[1]
        return value

    def centred(self, time: Range) -> tuple[Interval, Interval]:
        """Enclose phases, on the line, and velocities of all impacts, whose times are in `time`.

        By the mean value theorem in (phi, kick), from the flight in the middle of the box, and
        that flight's time by the interval Newton method.
        """
        kick: Interval = self.restitution * closing(self.start, self.gamma)
        phi = self.phi
        centre, push = (self.number(x.mid) for x in (phi, kick))
        middle = launch(self.system.side, self.eta, self._nu, centre)._replace(kick=push)
        fall, arrived = self.gap(*time, order=1), self.number(*time)
        for _ in range(2):
            guess = arrived.mid
            height = gap(middle, self.clock(guess))
            arrived = _common(arrived, guess - height / fall)
        values = centre + arrived, arrival(middle, self.clock(arrived.inf, arrived.sup))[1]
        rows = flight_derivative(self.start, self.clock(*time))
        phase, velocity = (
            value + row[0] * (phi - centre) + row[1] * (kick - push)
            for value, row in zip(values, rows, strict=True)
        )
        return phase, velocity

    def derivative(self, time: Range) -> Matrix:
        """Enclose DF over all states, impact times in `time`: rows (phase, velocity)."""
        value: Matrix = return_map_derivative(self.start, self.clock(*time), self.restitution)
        return value


def time_bracket(flight: Rebounds, found: FirstImpact, bits: int = 64) -> Range:
    """Enclose the times of a transversal first impact: of a single flight to 2^(1 - bits).

    Of a box of flights as the gap's signs allow.
    """
    if flight.single:
        return impact_time(found, flight.phases, bits)
    low, high = found.window
    # until what may still be gained is small beside the narrowest side of the box
    halvings = 18 + min(300, ((high - low) / flight.narrowest).__ceil__().bit_length())
    return narrowed(flight, found.window, halvings)


@dataclass(frozen=True)
class Arrival:
    """The next impact of all flights of a box: F and DF, the phase on the line less whole turns.

    found: the proof that it is the first one; derivative: rows (phase, velocity), columns
    (phi, gamma).
    """

    found: FirstImpact
    flight: Range
    turns: int
    phase: Range
    velocity: Range
    derivative: tuple[tuple[Range, Range], tuple[Range, Range]]


def next_impact(flight: Rebounds, *, bits: int = 64, horizon: Fraction = HORIZON) -> Arrival:
    """Enclose F and DF over a box of flights; for a single one times are known to 2^(1 - bits).

    Raises NoImpact, or Undecided where a state may be impossible, may graze or stick, or where
    the first impacts of the box are not one smooth function of state and parameters.
    """
    from proofs.motion.phase import lifted, turn  # with mpmath

    found, time = locate_impact(flight, bits=bits, horizon=horizon)
    precise = flight
    if flight.single:
        precise = replace(flight, precision=bits + 30 + found.loss)
    arrival = flight.phases[0] + time[0], flight.phases[1] + time[1]
    turns = int(arrival[0] // turn(precise.precision).sup)
    on_line, velocity = precise.centred(time)
    on_line = _common(precise.number(*arrival), on_line)
    phase = lifted((on_line.inf, on_line.sup), -turns, precise.precision)
    velocity = _common(precise.arrival_velocity(time), velocity)
    (p, q), (r, s) = ([(entry.inf, entry.sup) for entry in row] for row in precise.derivative(time))
    return Arrival(found, time, turns, phase, (velocity.inf, velocity.sup), ((p, q), (r, s)))


def locate_impact(
    flight: Rebounds, *, bits: int = 64, horizon: Fraction = HORIZON
) -> tuple[FirstImpact, Range]:
    """Return the transversal first impact of a box of flights, and its times as `next_impact`."""
    found = _locate(flight, horizon)
    return found, time_bracket(flight, found, bits)


def _common(one: Interval, two: Interval) -> Interval:
    """Return what two enclosures of the same have in common."""
    both = one.intersection(two)
    if both is None:
        raise ArithmeticError("two enclosures exclude each other")
    return both


def _locate(flight: Rebounds, horizon: Fraction) -> FirstImpact:
    """Return the transversal first impact, looked for with finer and finer steps.

    For a single flight the precision grows too; for a box of flights two attempts are enough.
    """
    attempts = 8 if flight.single else 2
    for attempt in range(attempts):
        finer = replace(flight, precision=flight.precision * (1 + attempt * flight.single))
        try:
            found = first_impact(finer, horizon, Fraction(1, 2 ** (3 + 4 * attempt)))
        except NoImpact:
            raise
        except Undecided:
            if attempt == attempts - 1:
                raise
            continue
        if found.transversal:
            return found
    raise Undecided("the first impact may graze, or is not the same on the whole box")
