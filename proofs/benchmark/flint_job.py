"""The claims of the main job in python-flint, the plain way: a script for the job to compete with.

    python -m proofs.benchmark.flint_job

It decides H1-H6 at the printed numbers with balls of 53 bits and the rule "subdivide
until it is decided": phases are halved, steps in time too. Earlier impacts are excluded by a march,
the gap's range over a ball of phases and each ball of times; a crossing with gap' < 0 is narrowed
by interval Newton; f' is bounded over each ball of phases. The equations are transcribed here
again, from (10) and (14), and f' is by implicit differentiation. It prints a verdict a claim.

It leaves out what the main job does besides: enclosures of the extremes of f', the repair of what
is refuted, a certificate, an independent check. It is no evidence for a claim.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any

from flint import arb

Phases = tuple[Fraction, Fraction]
Ball = Any  # flint.arb, which has no types

ETA, NU = arb(2121) / 10000, arb(-1) / 5  # nu < 0: the mass is below the table
LEFT, RIGHT = (Fraction("1.11"), Fraction("1.15")), (Fraction("1.27"), Fraction("1.32"))
WHOLE, GAP = (LEFT[0], RIGHT[1]), (LEFT[1], RIGHT[0])
SLOPES = Fraction("4.2"), Fraction("5.25")
TURN = 2 * arb.pi()
HORIZON, THIN, MOST_BALLS = 1000.0, 2.0**-10, 10_000


def ball(low: Fraction, high: Fraction) -> Ball:
    """Return a ball that contains an interval."""
    ends = [arb(x.numerator) / x.denominator for x in (low, high)]
    return ends[0] if low == high else ends[0].union(ends[1])


def during(low: float, high: float) -> Ball:
    """Return a ball that contains the times between two."""
    return arb(low).union(arb(high))


class Flight:
    """The flights of all launches from a ball of phases."""

    def __init__(self, low: Fraction, high: Fraction) -> None:
        self.phi = ball(low, high)
        self.lift, self.rate = NU * self.phi.sin(), NU * self.phi.cos()
        self.finest = max(float(high - low), THIN)  # steps in time that suit the phases

    def gap(self, t: Ball, order: int = 0) -> Ball:
        """Return table - mass, or its derivative by time, of order 1 or 2."""
        s, c = (ETA * t).sin_cos()
        table = (self.phi + t).sin_cos()[order % 2]
        up, along = 1 + self.lift, self.rate / ETA
        mass = (up * c + along * s, along * c - up * s)[order % 2]
        distance = NU * table - ETA**order * mass
        return (1 + distance, distance, -distance)[order]

    def slope(self, t: Ball) -> Ball:
        """Return f' = 1 - (dgap/dphi) / (dgap/dt) where the impacts are at times in t."""
        mass = self.rate * (ETA * t).cos() - self.lift * (ETA * t).sin() / ETA
        return 1 - (NU * (self.phi + t).cos() - mass) / self.gap(t, 1)

    def windows(self) -> list[tuple[float, float]] | None:
        """Return times that hold every first impact, the last ends with gap < 0; None: undecided.

        On (0, step] gap'' > 0 gives gap > 0, since gap(0) = gap'(0) = 0.
        """
        step = 1.0
        while not self.gap(during(0.0, step), 2) > 0:
            step /= 2
            if step < self.finest:
                return None
        time, windows = step, list[tuple[float, float]]()
        while time < HORIZON:
            ahead = time + step
            if self.gap(during(time, ahead)) > 0:
                time, step = ahead, 2 * step
            elif step > self.finest:
                step /= 2
            else:
                begin = windows.pop()[0] if windows and windows[-1][1] == time else time
                windows.append((begin, ahead))
                if self.gap(arb(ahead)) < 0:
                    return windows
                time = ahead
        return None

    def impact(self) -> Ball | None:
        """Return a ball with the time of every first impact, if all cross with gap' < 0.

        By interval Newton in the one window.
        """
        windows = self.windows()
        if windows is None or len(windows) > 1:
            return None
        time = during(*windows[0])
        while self.gap(time, 1) < 0:
            middle = time.mid()
            following = time.intersection(middle - self.gap(middle) / self.gap(time, 1))
            if not following.rad() < time.rad() / 2:
                return following
            time = following
        return None


def by_halves(phases: Phases, decide: Callable[[Flight], bool]) -> bool:
    """Halve phases until all parts are decided; False if that takes too many."""
    parts = [phases]
    for _ in range(MOST_BALLS):
        if not parts:
            return True
        low, high = parts.pop()
        if not decide(Flight(low, high)):
            parts += [(low, (low + high) / 2), ((low + high) / 2, high)]
    return False


def steep(flight: Flight) -> bool:
    """Whether f' exceeds the lower bound claimed on a ball of phases."""
    time = flight.impact()
    return time is not None and flight.slope(time) > ball(SLOPES[0], SLOPES[0])


def escapes(flight: Flight) -> bool:
    """Whether all first impacts from a ball of phases are outside I."""
    windows = flight.windows()
    return windows is not None and all(
        misses(flight.phi + during(*window), ball(*WHOLE)) for window in windows
    )


def misses(arrival: Ball, target: Ball) -> bool:
    """Whether no phase of `target` is in `arrival`, modulo 2 pi."""
    turns = int(float(arrival.mid()) / 6.283)
    return arrival.rad() < 1 and not any(
        arrival.overlaps(target + k * TURN) for k in range(turns - 1, turns + 2)
    )


def at(phase: Fraction) -> tuple[Ball, Ball]:
    """Return f, lifted, and f' at a phase."""
    flight = Flight(phase, phase)
    time = flight.impact()
    if time is None:
        raise ArithmeticError(f"the first impact after {phase} is not decided")
    return flight.phi + time, flight.slope(time)


def verdicts() -> dict[str, str]:
    """Decide the six claims; H5 and H6 for f increasing, by its values at the ends."""
    steeper = all(by_halves(phases, steep) for phases in (LEFT, RIGHT))
    most = ball(SLOPES[1], SLOPES[1])
    too_steep = any(at((low + high) / 2)[1] > most for low, high in (LEFT, RIGHT))
    (begin, end), (other, last) = ([at(phase)[0] for phase in ends] for ends in (LEFT, RIGHT))
    first = ball(LEFT[0], Fraction("1.12")) + int(float(begin.mid()) / 6.283) * TURN
    left_out = first < begin and end < first + TURN  # in I0, and not in f(I0)
    short = end - begin < TURN and last - other < TURN
    return {
        "H1": "VERIFIED" if steeper else "UNDECIDED",
        "H2": "REFUTED" if too_steep else "UNDECIDED",
        "H3": "VERIFIED" if steeper else "UNDECIDED",
        "H4": "VERIFIED" if by_halves(GAP, escapes) else "UNDECIDED",
        "H5": "REFUTED" if steeper and left_out else "UNDECIDED",
        "H6": "VERIFIED" if steeper and short else "UNDECIDED",
    }


if __name__ == "__main__":
    for claim, verdict in verdicts().items():
        print(claim, verdict)
