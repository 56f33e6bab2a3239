"""Write the Coq file of two rectangles of states that F, with restitution, maps across both.

The writer is not trusted: coqc proves every line. Floating point chooses the numbers.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import pairwise, product
from typing import NamedTuple

from proofs.formal import rebound_text as text
from proofs.formal.hints import NoHint, binary, steps
from proofs.formal.lemma_text import FLOATS, INTEGERS
from proofs.formal.written import Case, NoTheorem, Writer, by_cases, fields
from proofs.trusted.equations import (
    Clock,
    Launch,
    arrival,
    clock,
    gap,
    launch_with_restitution,
    return_map_derivative,
)
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import place_of
from proofs.trusted.kernel.horseshoe import Horseshoe
from proofs.trusted.kernel.rectangles import Rectangle
from proofs.trusted.numbers import Range, show
from proofs.trusted.paper.s33_restitution.horseshoes import RectangleHorseshoe, restituting
from proofs.trusted.paper.s33_restitution.rectangles import Strips
from proofs.trusted.parameters import Parameters
from proofs.trusted.verify import Report

CLAIMS = ("N1", "N2", "N3")
_SLACK = Fraction(1, 1000)  # flights are proved beyond the edges, too
_ROOM = Fraction(1, 1000)  # of a bracket of impact times
_BITS = 40
_FINEST = 2.0**-12
_MOST = 64  # pieces of a rectangle
_STRICT = 1.1  # bounds on DF are so much wider than what is seen

State = tuple[float, float]


class Bounds(NamedTuple):
    """Of the entries of DF: P >= p > 0, |Q| <= q, |R| <= r, |S| <= s."""

    p: Fraction
    q: Fraction
    r: Fraction
    s: Fraction

    def rate(self, c: Fraction) -> Fraction:
        """Return the k of the theorem, rounded up."""
        least = max((1 + self.q * c) / self.p, (self.r + self.s * c) / c)
        return Fraction(math.ceil(least * 100 + 1), 100)

    def holds(self, c: Fraction) -> bool:
        """Whether the hypotheses of the theorem hold for cones |dg| <= c |dphi|."""
        return self.rate(c) < 1 and self.r + self.s * c <= c * (self.p - self.q * c)


class Window(NamedTuple):
    """States of [a, b] x [d, e]: height'' > 0 up to T, height > 0 up to u, falling up to v."""

    a: Fraction
    b: Fraction
    d: Fraction
    e: Fraction
    T: Fraction
    u: Fraction
    v: Fraction


class Flights:
    """Flights with restitution in floating point, after states of a rectangle."""

    def __init__(self, of: Rectangle) -> None:
        at = place_of(of)
        self.of, self.side, (self.phases, self.velocities) = of, at.side, of.box
        self.eta, self.nu, self.eps = (float(side[0]) for side in at.sides)

    def _at(self, state: State, time: float) -> tuple[Launch, Clock]:
        start = launch_with_restitution(
            self.side, self.eta, self.nu, state[0], epsilon=self.eps, gamma=state[1]
        )
        return start, clock(self.eta, time)

    def height(self, state: State, time: float, order: int = 0) -> float:
        """Return the distance of mass and table, or a derivative in time."""
        start, now = self._at(state, time)
        return float(gap(start, now, order))

    def velocity(self, state: State, time: float) -> float:
        """Return gamma of an impact at this time."""
        return float(arrival(*self._at(state, time))[1])

    def derivative(self, state: State, time: float) -> list[float]:
        """Return the entries of DF for an impact at this time."""
        start, now = self._at(state, time)
        rows = return_map_derivative(start, now, self.eps)
        return [float(entry) for row in rows for entry in row]

    def impact(self, state: State) -> float:
        """Return the time of the first impact, by Newton's method from the certificate's."""
        part = min(
            self.of.parts, key=lambda each: abs(float(sum(each.box[0], Fraction(0))) / 2 - state[0])
        )
        time = float(sum(part.values[0])) / 2 + math.tau * part.turns[0] - state[0]
        for _ in range(20):
            time -= self.height(state, time) / self.height(state, time, 1)
        return time

    def window(self, room: float) -> Window:
        """Return how the states of the rectangle, and some around, come to their impact."""
        a, b = self.phases[0] - _SLACK, self.phases[1] + _SLACK
        d, e = self.velocities[0] - _SLACK, self.velocities[1] + _SLACK
        states = grid((a, b), (d, e))
        times = [self.impact(state) for state in states]
        lift = 4.0
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
        bits = 5 - math.floor(math.log2(room))
        u, v = binary(min(times) - room, bits, True), binary(max(times) + room, bits)
        return Window(a, b, d, e, Fraction(lift), u, v)

    def _falls(self, states: Sequence[State], u: float, v: float) -> bool:
        rates = [self.height(*at, 1) for at in product(states, steps(u, v, 16))]
        return max(rates) < 0.25 * min(rates)

    def bounds(self, window: Window) -> Bounds:
        """Return bounds on DF, for impacts at any time of the window."""
        states = grid(self.phases, self.velocities)
        times = steps(float(window.u), float(window.v), 8)
        entries = list(zip(*(self.derivative(*at) for at in product(states, times)), strict=True))
        largest = [_up(max(map(abs, entry)) * _STRICT) for entry in entries[1:]]
        return Bounds(Fraction(math.floor(min(entries[0]) / _STRICT * 20), 20), *largest)

    def pieces(self) -> list[tuple[Range, Range]]:
        """Return pieces of the phases, and brackets of impact times that show the velocities."""
        low, high = self.phases
        count = 1
        while count <= _MOST:
            cuts = [low + (high - low) * i / count for i in range(count + 1)]
            found = [(part, self._bracket(part)) for part in pairwise(cuts)]
            if all(self._stays(*each) for each in found):
                return found
            count *= 2
        raise NoHint("velocities of images are not seen to stay")

    def _bracket(self, phases: Range) -> Range:
        times = [self.impact(state) for state in grid(phases, self.velocities)]
        return binary(min(times) - _ROOM, 14), binary(max(times) + _ROOM, 14, up=True)

    def _stays(self, phases: Range, times: Range) -> bool:
        low, high = map(float, self.velocities)
        spare = (high - low) / 200
        at = product(grid(phases, self.velocities), steps(float(times[0]), float(times[1]), 8))
        return all(low + spare < self.velocity(*each) < high - spare for each in at)


def grid(phases: Range, velocities: Range) -> list[State]:
    """Return states of a rectangle."""
    (x, y), (g, h) = ((float(low), float(high)) for low, high in (phases, velocities))
    return list(product(steps(x, y, 12), steps(g, h, 4)))


def _middle(ends: Range) -> float:
    return float(sum(ends, Fraction(0))) / 2


def _up(x: float) -> Fraction:
    return Fraction(math.ceil(x * 100), 100)


def _found(report: Report, source: str) -> Iterator[tuple[RectangleHorseshoe, list[Rectangle]]]:
    """Yield the horseshoes of two rectangles of one oscillator that claims rest on."""
    document, known = json.loads(source), report.context.known
    used = [name for claim in document["claims"] for name in claim["proof"]]
    for name in dict.fromkeys(used):
        step = known[name]
        if not isinstance(step, Horseshoe):
            continue
        try:
            shoe = restituting(step)
        except Unproved:
            continue
        maps = [known[each] for each in document["steps"][name]["witness"]["rectangles"]]
        if (
            isinstance(shoe.strips, Strips)
            and all(low == high for low, high in shoe.at.sides)
            and shoe.at.sides[2][0] > 0
            and shoe.rates.cone.slope == 0
            and step.is_rising
        ):
            yield shoe, [each for each in maps if isinstance(each, Rectangle)]


class Rectangles(Writer):
    """Collects the lemmas and theorems on two rectangles."""

    def __init__(self, shoe: RectangleHorseshoe, maps: list[Rectangle]) -> None:
        super().__init__()
        self.shoe, self.maps = shoe, maps
        self.flights = [Flights(each) for each in maps]
        self.c = shoe.rates.cone.width
        self.windows, self.bounds = self._chosen()
        (left, velocities), (right, _) = (each.box for each in maps)
        self.numbers = {
            **dict(zip(("A", "b0", "a1", "B"), (*left, *right), strict=True)),
            **{"g0": velocities[0], "g1": velocities[1], "c": self.c},
            **self.bounds._asdict(),
        }

    def _chosen(self) -> tuple[list[Window], Bounds]:
        """Return windows of impact times that are narrow enough for the bounds on DF there."""
        room = 0.25
        while room > _FINEST:
            windows = [each.window(room) for each in self.flights]
            each = [flight.bounds(w) for flight, w in zip(self.flights, windows, strict=True)]
            p, *others = zip(*each, strict=True)
            found = Bounds(min(p), *map(max, others))
            if found.p > 1 and found.holds(self.c):
                return windows, found
            room /= 2
        raise NoHint("the cone condition is not seen")

    def rectangle(self, i: int) -> None:
        """Write what is shown of one rectangle."""
        x, y = self.maps[i].box[0]
        named = {"i": i, "x": x, "y": y, "k": self.maps[i].turns[0], **self.windows[i]._asdict()}
        self.add(text.RECTANGLE, **named)
        pieces = self.flights[i].pieces()
        for j, ((low, high), (first, last)) in enumerate(pieces):
            times = {"first": max(first, self.windows[i].u), "last": min(last, self.windows[i].v)}
            self.add(text.VELOCITY, i=i, j=j, l=low, h=high, **times)
        parts = [(f"velocity{i}_{j}", part[1]) for j, (part, _) in enumerate(pieces)]
        self.add(text.FACTS, **named, velocities=by_cases(parts, "apply {}; lra"))

    def theorems_on(self) -> None:
        """Write the model, the full shift and the hyperbolicity."""
        (p, q, r, s), c = self.bounds, self.c
        self.state("model", text.MODEL_IN_WORDS, text.MODEL)
        for i in (0, 1):
            self.rectangle(i)
        strips = self.shoe.strips
        rate = self.bounds.rate(c)
        says = (
            f"{strips}: each two-sided sequence of 1 and 2 is the history of exactly one full "
            "orbit of F there; on the states of these orbits F is conjugate to the two-sided full "
            f"shift; states of sequences that agree from -n to n are {show(rate)}^n size apart"
        )
        self.state("rectangles_horseshoe", says, text.HORSESHOE, rate=rate)
        contraction = _up(float(c * (r * q + s * p) / (c * p - r)) + 1e-9)
        says = (
            f"there horizontal distances grow {show(p)} times at least, vertical ones shrink to "
            f"{show(max(q, s))} times at most, the cones |dgamma| <= {show(c)} |dphi| are kept and "
            f"stretched {show(p - q * c)} times, in those around the vertical distances shrink to "
            f"{show(contraction)} times at most"
        )
        named = {"expansion": p - q * c, "contraction": contraction}
        self.state("hyperbolic", says, text.HYPERBOLIC, **named)

    def edge(self, of: Parameters) -> None:
        """Write that a corner of the printed V2 falls short, if it does."""
        if of.velocities is None:
            return
        x, g = of.right[1], of.velocities[0]
        window, k = self.windows[1], self.maps[1].turns[0]
        inside = window.a < x < window.b and window.d < g < window.e
        if inside and self.flights[1].impact((float(x), float(g))) < math.tau * k - 1e-6:
            says = (
                f"the printed V2 falls short: ({show(x)}, {show(g)}) on its right edge has an "
                f"image, at a phase below {show(x)}"
            )
            self.state("printed_edge_falls_short", says, text.EDGE, i=1, x=x, g=g, k=k, u=window.u)


def case(report: Report, source: str, digest: str, floats: bool) -> Case:
    """Return the Coq file of the first two rectangles that F maps across both."""
    for shoe, maps in _found(report, source):
        writer = Rectangles(shoe, maps)
        writer.theorems_on()
        if isinstance(report.parameters, Parameters):
            writer.edge(report.parameters)
        eta, nu, eps = (low for low, _ in shoe.at.sides)
        bits = "" if floats else f", i_prec {_BITS}"
        head = text.HEAD.format(
            digest=digest,
            arithmetic=FLOATS if floats else INTEGERS,
            **fields(side=shoe.at.side, eta=eta, nu=nu, eps=eps, bits=bits),
        )
        return writer.ended(head)
    raise NoTheorem("it has no horseshoe of two rectangles at one oscillator with restitution")
