"""Witnesses of first impacts, found with the checker's own lemmas: times and windows.

A gap is asked for by `stays_up` and `falls` of `trusted.flights`, in the checker's numbers, of few
bits at first. Nothing here is evidence: what a rule concludes is.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import NamedTuple

from intervals.errors import DomainError, Undecided
from proofs.trusted.equations import (
    Launch,
    clock,
    gap,
    launch,
    launch_acceleration,
)
from proofs.trusted.flights import Motion
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.gaps import Gap, falls, first_windows, stays_up
from proofs.trusted.numbers import COVER_BITS, Range, rounded_bits
from proofs.trusted.parameters import Place

HORIZON = Fraction(1000)
_NOW = Fraction(0)
_TINIEST = Fraction(1, 2**200)
_ATTEMPTS = 8
MOST_BITS = _ATTEMPTS * COVER_BITS  # until a launch counts as grazing or sticking
_HALVINGS = 4  # of a window, as the rule halves it
_LIKELY = 0.375  # of bend w^2: up to 1/2 a step of 2 w may not be closed; few of them are
_PATIENCE = 4  # steps after one that was too long, until a longer one is tried whatever the bend
_CLOSE = Fraction(1, 1000)  # of times to that of a touch
_MOST_WINDOWS = 256  # where mass and table touch more often, finer steps will show no more
BLIND = (DomainError, Unproved, OverflowError, ValueError)  # numbers that do not see


class NoImpact(Undecided):
    """No impact was found up to the horizon (or the mass never separates from the table)."""


class Impossible(ValueError):
    """No mass above the table can have this velocity before an impact at this phase."""


class Sticks(Undecided):
    """All phases of a set stick to the table first: their flights start elsewhere."""


class Unsettled(Undecided):
    """In some windows of time impacts are possible, and none is certain up to where one looked.

    excluded: times up to the first window, gap > 0 between them.
    """

    def __init__(self, windows: Sequence[Range], times: Sequence[Fraction], reason: str) -> None:
        begin = windows[0][0]
        near = f"an impact near time {float(begin):.9g} is neither proved nor excluded"
        super().__init__(f"{near}{reason and f': {reason}'}")
        self.excluded = up_to(begin, times)


# -- launches --------------------------------------------------------------------------------------


@dataclass(frozen=True)
class FlightBox:
    """All launches after impacts at phases of `phases`, of oscillators with eta, nu, epsilon.

    Impacts are plastic. separating: the launch acceleration is known to be >= 0, as it is at the
    separation phase, where it vanishes.
    """

    sides: tuple[Range, Range, Range]
    phases: Range
    separating: bool = False

    @classmethod
    def plastic(cls, at: Place, phases: Range, *, separating: bool = False) -> FlightBox:
        """Return the launches of a place."""
        return cls(at.sides, phases, separating)

    @property
    def orders(self) -> tuple[int, ...]:
        """Which derivatives of the gap may be the first that is > 0 at launch."""
        return (2, 3) if self.separating else (2,)

    def start(self, bits: int) -> Launch:
        """Return the launch states in numbers of a precision."""
        eta, nu, phi = (Enclosure.of(*each, bits) for each in (*self.sides[:2], self.phases))
        return launch(1 if self.sides[1][0] > 0 else -1, eta, nu, phi)

    def gap_of(self, bits: int, start: Launch | None = None) -> Gap:
        """Return the gap in numbers of a precision; start: the launch states in these."""
        begin = start or self.start(bits)

        def gap_of(time: Range, order: int) -> Enclosure:
            value: Enclosure = gap(begin, clock(begin.eta, Enclosure.of(*time, bits)), order)
            return value

        return gap_of

    def touch_near(self, times: Range) -> str:
        """Say that a plastic flight without an earlier impact touches the table here; "" elsewhere.

        eta = p/q: after q turns of the table mass and table are where they were, as fast.
        """
        eta, last = self.sides[0]
        time = math.tau * (turns := eta.denominator)
        near = eta == last and times[0] - _CLOSE <= time <= times[1] + _CLOSE
        if not near:
            return ""
        return (
            f"at time 2 pi {turns} = {time:.9g} mass and table are where they were at the launch, "
            "and touch without relative velocity if there was no impact before"
        )


def name_of(phases: Range) -> str:
    """Write a set of phases."""
    low, high = (f"{float(x):.9g}" for x in phases)
    return f"phase {low}" if low == high else f"every phase in [{low}, {high}]"


# -- the first impact ------------------------------------------------------------------------------


class Seen(NamedTuple):
    """What may be proved of a first impact: as `first_windows` takes and concludes it.

    times: 0 < t_1 < ... < t_n; bits: of the numbers that saw it.
    """

    flights: FlightBox
    bits: int
    times: tuple[Fraction, ...]
    windows: tuple[Range, ...]
    transversal: bool

    @property
    def excluded(self) -> list[Fraction]:
        """The times up to the first window: gap > 0 between them."""
        return up_to(self.windows[0][0], self.times)

    def proved_windows(self) -> tuple[Range, ...]:
        """Prove them by the checker's lemmas, for the launches that leave after plastic impacts."""
        eta, nu, _ = self.flights.sides
        bits = max(self.bits, bits_for_pieces(self.times))
        motion = Motion(Place(eta, nu), self.flights.phases, bits)
        return first_windows(motion.gap_of, self.times, *self.flights.orders)[0]


def bits_for_pieces(times: Sequence[Fraction]) -> int:
    """Return the precision for pieces of times: gaps are of the order w^2 in a piece of width w."""
    shortest = min(now - before for before, now in pairwise((_NOW, *times)))
    return rounded_bits(COVER_BITS + 2 * (1 / shortest).__ceil__().bit_length())


def up_to(last: Fraction, times: Sequence[Fraction]) -> list[Fraction]:
    """Return the times that are not after the last."""
    return [time for time in times if time <= last]


def march(
    flights: FlightBox,
    bits: int,
    horizon: Fraction = HORIZON,
    finest: Fraction = Fraction(1, 8),
    excluded: Sequence[Fraction] = (),
    *,
    single: bool = False,
) -> Seen:
    """Exclude impacts from time 0 on until one is certain, for all launches at once.

    Steps are doubled (for a while after one that was too long only where the bend at all times may
    allow it), and halved down to `finest`, or to an eighth of the time passed if that is less; what
    is then not excluded opens a window, in which they grow again. excluded: times up to which the
    gap is known to be > 0. single: a window that is left behind raises Unsettled; nothing that
    comes after could make the impact transversal.

    Raises NoImpact or Unsettled at the horizon (Unsettled also after too many windows), Sticks
    where all phases do, Undecided where the launch itself is not decided.
    """
    start, windows = flights.start(bits), list[Range]()
    gap_of = flights.gap_of(bits, start)
    if not excluded:
        _require_leaving(flights, start)
    times = list(excluded) or [first_step(gap_of, flights.orders)]
    value, bend = gap_of((times[-1], times[-1]), 0), gap_of((_NOW, horizon), 2)
    step, allowed = times[-1] - (times[-2] if len(times) > 1 else 0), min(finest, times[-1] / 8)
    patience = 0

    def unsettled() -> Unsettled:
        return Unsettled(windows, times, flights.touch_near(windows[0]))

    while not windows or value.hi >= 0:
        now = times[-1]
        least = min(finest, now / 8)
        if len(windows) > (0 if now >= horizon else _MOST_WINDOWS):
            raise unsettled()
        if now >= horizon:
            raise NoImpact(f"there is no impact up to time {float(horizon):g} (the horizon)")
        ahead = now + step
        following = gap_of((ahead, ahead), 0)
        if stays_up(gap_of, (now, ahead), min(value.lo, following.lo), bend):
            if single and windows:
                raise unsettled()
            hopeless = patience > 0 and following.lo <= bend.hi * _LIKELY * float(step) ** 2
            step, allowed, patience = (step if hopeless else 2 * step), least, patience - 1
        elif step > allowed:
            step, patience = max(step / 2, allowed), _PATIENCE
            continue
        else:
            begin = _open(windows, times, ahead)
            step = allowed = min(2 * allowed, max(16 * least, (ahead - begin) / 8))
        times.append(ahead)
        value = following
    transversal = len(windows) == 1 and falls(gap_of, windows[0], _HALVINGS)
    return Seen(flights, bits, tuple(times), tuple(windows), transversal)


def _open(windows: list[Range], times: list[Fraction], ahead: Fraction) -> Fraction:
    """Add the time until `ahead` to the last window, or begin one; return when it began."""
    begin = times[-1]
    if windows and windows[-1][1] == begin:
        begin, _ = windows.pop()
        times.pop()
    windows.append((begin, ahead))
    return begin


def _require_leaving(flights: FlightBox, start: Launch) -> None:
    """Raise Sticks where all phases stick."""
    if not flights.separating and launch_acceleration(start).hi < 0:
        raise Sticks(f"{name_of(flights.phases)} sticks to the table after the impact")


def first_step(gap_of: Gap, orders: Sequence[int]) -> Fraction:
    """Return a time up to which the gap opens, as a derivative of one of these orders is > 0."""
    step = Fraction(1)
    while step > _TINIEST:
        if any(gap_of((_NOW, step), order).lo > 0 for order in orders):
            return step
        step /= 2
    raise Undecided("a phase sticks, or it is not decided whether it does")


def locate(flights: FlightBox, *, horizon: Fraction = HORIZON) -> Seen:
    """Return the transversal first impact of (nearly) one launch, with the least bits it needs.

    Close to grazing or to the onset of sticking steps and rounding must be finer: what is excluded
    stays so, and the first window that is left open is looked at again. At last Undecided says that
    the launch is too close to one.
    """
    excluded: Sequence[Fraction] = ()
    for attempt in range(_ATTEMPTS):
        bits = COVER_BITS * (attempt + 1)
        finest = Fraction(1, 2 ** (3 + 10 * attempt))
        try:
            located = march(flights, bits, horizon, finest, excluded, single=True)
        except (NoImpact, Sticks):
            raise
        except Unsettled as failure:
            excluded = failure.excluded
        except (Undecided, *BLIND):
            continue
        else:
            if located.transversal:
                return located
            excluded = located.excluded
    seen = flights.touch_near((excluded[-1], excluded[-1])) if excluded else ""
    why = f": {seen}" if seen else " grazes, or starts to stick, to within what was tried"
    raise Undecided(f"phase {float(flights.phases[0]):.12g}{why}")
