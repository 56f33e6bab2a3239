"""Conclusions about where flights land: on the sticking arc, or nowhere. Trusted, and shared."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from proofs.trusted.equations import Launch
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.numbers import TURN, Range, show_range
from proofs.trusted.slopes import SlopeRange

Number = Any


@dataclass(frozen=True)
class Separation(Conclusion):
    """The launch acceleration is < 0 exactly on the arc from a to phi_s, mod 2 pi: there the mass
    sticks, until phi_s. The flight from phi_s has its first impact, a transversal one, after a
    time in `time`, at the phase in `arrival`, mod 2 pi.

    start encloses a = 3 pi - phi_s, phase encloses phi_s, both in (0, 2 pi).
    """

    start: Range
    phase: Range
    time: Range
    arrival: Range

    @property
    def returns(self) -> bool:
        """Whether the flight from phi_s ends in the interior of the sticking arc."""
        return self.start[1] < self.arrival[0] and self.arrival[1] < self.phase[0]


@dataclass(frozen=True)
class Lands(Conclusion):
    """The first impact of every launch in `phases`, mod 2 pi, that does not stick is in the arc."""

    phases: Range


@dataclass(frozen=True)
class NeverImpacts(Conclusion):
    """After a launch in `phases` gap > 0 up to the time 2 pi q, where eta = p/q in lowest terms.

    Then mass and table are exactly where they were at launch, and as fast: gap = gap' = 0.
    """

    phases: Range

    @property
    def sentence(self) -> str:
        """Return the theorem."""
        return f"after a launch in {show_range(self.phases)} the mass never impacts again."


@dataclass(frozen=True)
class Absorption(Conclusion):
    """Phases that reach the sticking arc.

    The phases that do not within n impacts have a measure of at most rest[n]. within: intervals
    of phases, mod 2 pi, all of which do within that number of impacts.
    """

    rest: tuple[Fraction, ...]
    within: tuple[tuple[Range, int], ...]


def closest_approach(
    eta: Fraction, nu: Number, start: Launch, away: Number, half_turn: Number
) -> tuple[Number, ...]:
    """Return numbers; if all are > 0, the launch at pi/2 + away is one of `NeverImpacts`.

    Theorem, for -1 < nu < 0, eta = p/q in lowest terms and |away| < pi/2. Let n = |nu| and
    a = 1 - n. The mass is at X = R cos(eta s), the table at Z = 1 - n cos(u), s and u being times
    since the highest point of X and the lowest of Z: u = s + w + 2 pi m q/p mod 2 pi in the mass's
    oscillation m, with w = delta/eta + away and tan(delta) = rate / (eta (1 + lift)), which has the
    sign of away.
    An impact X = Z says n (1 - cos u) + R (1 - cos eta s) = R - a =: r. As 1 - cos x >= 2 (x/pi)^2
    on [-pi, pi], u^2 <= 5 r/n and (eta s)^2 <= 5 r/a; as 1 - cos x >= x^2/2 (1 - x^2/12),
    n c u^2 + a eta^2 d s^2 <= 2 r with c = 1 - 5r/(12n), d = 1 - 5r/(12a). So (|u| + |s|)^2 <=
    T = 2r (1/(n c) + 1/(a eta^2 d)), s^2 <= S = 2r/(a eta^2 d).
    (1) In an oscillation m that p does not divide, w + 2 pi m q/p is 2 pi/p - |w| or more from all
    multiples of 2 pi: no impact if (|w| + |u| + |s|)^2 <= 2 (w^2 + T) < (2 pi/p)^2.
    (2) In the others, by periodicity m = 0: where s^2 <= S, gap'' = n cos(u) + R eta^2 cos(eta s)
    >= n (1 - S - w^2) - (a + r) eta^2, R = a + r. If that is > 0 the gap is convex there, 0 with
    its derivative at launch: > 0 elsewhere.
    Below r is bounded by (R^2 - a^2) / (2a), and w by away + rate / (eta^2 (1 + lift)); the
    numbers are the differences in (1) and (2), n c and a eta^2 d.
    """
    height, speed = 1 + start.lift, start.rate / start.eta
    deepest, size, square = 1 + nu, -nu, start.eta * start.eta
    excess = (height * height + speed * speed - deepest * deepest) / (2 * deepest)
    table = size * (1 - 5 * excess / (12 * size))
    mass = deepest * square * (1 - 5 * excess / (12 * deepest))
    lag = away + speed / (start.eta * height)
    near = 2 * excess / mass
    reach = near + 2 * excess / table
    turn = 2 * half_turn / eta.numerator
    passes = turn * turn - 2 * (lag * lag + reach)
    convex = size * (1 - near - lag * lag) - (deepest + excess) * square
    return passes, convex, table, mass


def repelling(found: Sequence[object], inside: Range) -> list[SlopeRange]:
    """Return what is known around a fixed point p inside an interval, on the longest part first.

    f maps each interval across itself, f' > 1, and no image is longer than the circle: so there is
    one fixed point p, and it is the same for intervals inside the first. Phases near p stay near
    it for as many impacts as one likes. A phase below p moves down until it lands between f(lower
    end) and the lower end.
    """
    known = [
        step
        for step in found
        if isinstance(step, SlopeRange)
        and inside[0] <= step.points[0]
        and step.points[-1] <= inside[1]
        and step.images[0][1] < step.points[0]
        and step.points[-1] < step.images[-1][0]
        and min(low for low, _ in step.pieces) > 1
        and max(high for _, high in step.pieces) * (step.points[-1] - step.points[0]) < TURN
    ]
    known.sort(key=lambda step: step.points[0] - step.points[-1])
    return [
        step
        for step in known
        if known[0].points[0] <= step.points[0] and step.points[-1] <= known[0].points[-1]
    ]


def fixed_point(known: Sequence[SlopeRange]) -> Range:
    """Enclose the fixed point by Newton's method from the lower end a of the last interval.

    p - a = (a - f(a)) / (f'(x) - 1) for an x between them.
    """
    start, (low, high) = known[-1].points[0], known[-1].images[0]
    least = min(bottom for bottom, _ in known[-1].pieces) - 1
    most = max(top for _, top in known[-1].pieces) - 1
    return start + (start - high) / most, start + (start - low) / least
