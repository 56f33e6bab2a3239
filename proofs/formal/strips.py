"""Cut the flights from a rectangle of states, with restitution, so that Coq's checker sees them.

Floating point looks for the cuts, enclosures by the operations of `theory/Strips.v` bound DF.
Nothing here is trusted.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from functools import cached_property
from itertools import product
from typing import NamedTuple

from proofs.formal.flights import BITS, Cut, Flown, march
from proofs.formal.hints import SLACK, NoHint, steps
from proofs.trusted.equations import clock, gap, launch_with_restitution
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.conclusion import place_of
from proofs.trusted.kernel.enclose import enclosed
from proofs.trusted.kernel.rectangles import Rectangle
from proofs.trusted.numbers import Range, hull, within

ASIDE = Fraction(1, 1000)  # flights are proved for velocities beyond the edges, too
_FINEST = 2.0**-12
_DEEPEST = 7  # halvings of a rectangle
_SPARE = 1.002  # bounds on DF are so much wider than what is enclosed

State = tuple[float, float]
Entries = list[Enclosure]  # P, Q, R, S of DF


class Bounds(NamedTuple):
    """Of the entries of DF: P >= p > 0, |Q| <= q, |R| <= r, |S| <= s."""

    p: Fraction
    q: Fraction
    r: Fraction
    s: Fraction

    @classmethod
    def of(cls, every: Sequence[Entries]) -> Bounds:
        """Round the bounds of what is enclosed outward."""
        p, *others = zip(*every, strict=True)
        largest = [max(-low, high) for each in others for low, high in [_span(each)]]
        most = [Fraction(math.ceil(float(each) * _SPARE * 100), 100) for each in largest]
        return cls(Fraction(math.floor(float(_span(p)[0]) / _SPARE * 20), 20), *most)

    def rate(self, c: Fraction) -> Fraction:
        """Return the k of the theorem, rounded up."""
        least = max((1 + self.q * c) / self.p, (self.r + self.s * c) / c)
        return Fraction(math.ceil(least * 100 + 1), 100)

    def holds(self, c: Fraction) -> bool:
        """Whether the hypotheses of the theorem hold for cones |dg| <= c |dphi|."""
        if self.p <= 1:
            return False
        return self.rate(c) < 1 and self.r + self.s * c <= c * (self.p - self.q * c)


class Window(NamedTuple):
    """Of all flights: height'' > 0 up to T, height > 0 up to u, falling up to v; in units."""

    T: int
    u: int
    v: int


class Piece(NamedTuple):
    """Flights of some phases, and a bracket of their impact, in units."""

    cut: Cut
    early: int
    late: int

    def __str__(self) -> str:
        return f"(Piece {self.cut} ({self.early}) ({self.late}))"


class Flights:
    """Flights with restitution after states of a rectangle, in floating point and in enclosures."""

    def __init__(self, of: Rectangle, unit: int) -> None:
        at = place_of(of)
        self.of, self.unit, self.side, (self.phases, self.velocities) = of, unit, at.side, of.box
        self.sides = eta, nu, eps = [low for low, _ in at.sides]
        self.eta, self.nu, self.eps = map(float, (eta, nu, eps))

    @property
    def beyond(self) -> Range:
        """The velocities of the flights that are proved."""
        return self.velocities[0] - ASIDE, self.velocities[1] + ASIDE

    def height(self, state: State, time: float, order: int = 0) -> float:
        """Return the distance of mass and table, or a derivative in time."""
        start = launch_with_restitution(
            self.side, self.eta, self.nu, state[0], epsilon=self.eps, gamma=state[1]
        )
        return float(gap(start, clock(self.eta, time), order))

    def impact(self, state: State) -> float:
        """Return the time of the first impact, by Newton's method from the certificate's."""
        part = min(
            self.of.parts, key=lambda each: abs(float(sum(each.box[0], Fraction(0))) / 2 - state[0])
        )
        time = float(sum(part.values[0])) / 2 + math.tau * part.turns[0] - state[0]
        for _ in range(20):
            time -= self.height(state, time) / self.height(state, time, 1)
        return time

    @cached_property
    def window(self) -> Window:
        """How all states, and some around, come to their impact: the widest that is seen."""
        states = grid((self.phases[0] - SLACK, self.phases[1] + SLACK), self.beyond)
        times, lift, room = [self.impact(state) for state in states], 4.0, 0.25
        while any(
            self.height(state, time, 2) < 0.2 * self.height(state, 0.0, 2)
            for state in states
            for time in steps(0, lift, 16)
        ):
            lift /= 2
            if lift < _FINEST:
                raise NoHint("the mass does not leave the table at once")
        while not self._falls(states, min(times) - room, max(times) + room):
            room /= 2
            if room < _FINEST:
                raise NoHint("the impacts of a rectangle are no branch")
        ends = lift, min(times) - room, max(times) + room
        return Window(*(int(end * self.unit) for end in ends))

    def _falls(self, states: Sequence[State], u: float, v: float) -> bool:
        rates = [self.height(*at, 1) for at in product(states, steps(u, v, 16))]
        return max(rates) < 0.25 * min(rates)

    def piece(self, phases: Range) -> Piece:
        """Cut the flights from some phases, and bracket their impacts."""
        low, high = phases[0] - SLACK, phases[1] + SLACK
        (a, b), (d, e) = ((float(x), float(y)) for x, y in ((low, high), self.beyond))
        launch = self.side, self.eta, self.nu, (a + b) / 2, (b - a) / 2
        flown = Flown(*launch, self.eps, (d + e) / 2, (e - d) / 2)
        states, unit, (lift, u, v) = grid((low, high), self.beyond), self.unit, self.window
        times = [self.impact(state) for state in states]
        least, greatest = flown.height(times[0], 0)
        slowest = min(-self.height(*at, 1) for at in zip(states, times, strict=True))
        room = 2 * (greatest - least) / slowest
        early, late = int((min(times) - room) * unit), int((max(times) + room) * unit)
        if not flown.is_over(v / unit):
            raise NoHint("the impacts of a piece are too spread")
        parts = (flown.lifts, 0, lift), (flown.flies, lift, u), (flown.falls, u, v)
        runs = [march(*part, unit) for part in parts]
        cut = Cut(unit, int(low * unit), int(high * unit), *runs)
        return Piece(cut, max(u, early), min(v, late))

    def entries(self, piece: Piece) -> tuple[Entries, Enclosure]:
        """Enclose DF and the velocity of the images."""
        ends = (piece.cut.a, piece.cut.b), (piece.early, piece.late)
        phases, times = ((Fraction(x, self.unit), Fraction(y, self.unit)) for x, y in ends)
        points = [(each, each) for each in self.sides]
        box = enclosed((*points, phases, self.beyond, times), BITS)
        return _entries(box)

    def pieces(
        self, phases: Range, c: Fraction, depth: int = 0
    ) -> tuple[list[Piece], list[Entries]]:
        """Cut phases into pieces on each of which cones are kept; return DF on each as well."""
        try:
            piece = self.piece(phases)
            entries, velocity = self.entries(piece)
            if within(velocity.range, self.velocities) and Bounds.of([entries]).holds(c):
                return [piece], [entries]
            raise NoHint("neither velocities nor cones are seen to be kept")
        except (NoHint, Unproved) as failure:
            if depth == _DEEPEST:
                raise NoHint(str(failure)) from None
        middle = sum(phases, Fraction(0)) / 2
        halves = (phases[0], middle), (middle, phases[1])
        (first, low), (second, high) = (self.pieces(half, c, depth + 1) for half in halves)
        return first + second, low + high

    def edges(self, targets: Range) -> tuple[int, int]:
        """Return times after the impacts from the left edge, and before those from the right."""
        found = []
        for end, target, last in zip(self.phases, targets, (max, min), strict=True):
            time = last(self.impact(state) for state in grid((end, end), self.beyond))
            reached = float(target) + math.tau * self.of.turns[0] - float(end)
            found.append(int((time + reached) / 2 * self.unit))
        return found[0], found[1]


def _entries(box: Sequence[Enclosure]) -> tuple[Entries, Enclosure]:
    """Enclose DF and the velocity after a flight by the operations of `theory/Strips.v`.

    box: eta, nu, epsilon, and the phases, velocities and times of the flights.
    """
    eta, nu, eps, phi, gamma, time = box
    sin, cos = phi.sincos()
    (low, high), (first, last) = phi.range, time.range
    middle, start = (low + high) / 2, Enclosure.of(first, first, BITS)
    by = Enclosure.of(Fraction(0), last - first, BITS)
    ts, tc = _turned(eta * start, eta * by)
    _, table = _turned(start + middle, phi - middle + by)
    rise, kick = 1 + nu * sin, eps * gamma + nu / eta * (1 + eps) * cos
    bounce, swing = eps * (eta * gamma + nu * cos), eta * rise - nu / eta * (1 + eps) * sin
    fall = eta * kick * tc - eta * rise * ts - nu * table
    sinking = eta * rise * tc + eta * kick * ts
    p, q = (bounce * tc - swing * ts) / fall, -(eps * ts / fall)
    r, s = sinking * p - (swing * tc + bounce * ts), sinking * q - eps * tc
    return [p, q, r, s], rise * ts - kick * tc


def _span(values: Sequence[Enclosure]) -> Range:
    """Return the least interval around enclosures."""
    return hull([each.range for each in values])


def _turned(angle: Enclosure, by: Enclosure) -> tuple[Enclosure, Enclosure]:
    """Enclose sine and cosine of a sum."""
    (sin, cos), (more, less) = angle.sincos(), by.sincos()
    return sin * less + cos * more, cos * less - sin * more


def grid(phases: Range, velocities: Range) -> list[State]:
    """Return states of a rectangle."""
    (x, y), (g, h) = ((float(low), float(high)) for low, high in (phases, velocities))
    return list(product(steps(x, y, 12), steps(g, h, 4)))
