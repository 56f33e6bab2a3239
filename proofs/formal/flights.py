"""Write the Coq file of a covering graph of the impact map: data that Coq's own checker computes.

A flight is cut into steps: floating point looks for steps with which the tests of `theory/March.v`
succeed, by the same enclosures, as middle and radius. The writer is not trusted: a reader reads
`theory/Graph.v` and the definitions and theorems here.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from fractions import Fraction
from typing import NamedTuple

from proofs.formal import flight_text
from proofs.formal.hints import SLACK, Branch, Hints, NoHint, steps
from proofs.formal.written import Writer, pairs, rational
from proofs.trusted.kernel.staying import StayingSet
from proofs.trusted.numbers import Range, hull, show, show_range, within
from proofs.trusted.paper.s34_circle.other_sets import PRINTED as OTHER

BITS = 56  # of the enclosures
PARTS = 2**28  # of what is asked for, in a unit
_LARGEST = 2.0**-10  # of what the impact after an end of an interval is known to
_LONGEST = 16.0  # of equal steps, as enclosures that are turned grow
_FIRST, _LEAST = 1.0, 2.0**-20  # of steps
_SPARE = 1.02  # of a radius, for what is of second order and for rounding
_DEEPEST = 10  # halvings of an interval of phases

Run = tuple[int, int]  # a step in units, and how often


class Cut(NamedTuple):
    """How the launches from phases [a, b] come to their impact: runs of equal steps, in units."""

    unit: int
    a: int
    b: int
    lifts: list[Run]
    flights: list[Run]
    falls: list[Run]

    @property
    def times(self) -> tuple[int, int, int]:
        """T, u and v: gap'' > 0 up to T, gap > 0 up to u, gap' < 0 up to v."""
        ends = [
            sum(step * n for step, n in runs) for runs in (self.lifts, self.flights, self.falls)
        ]
        return ends[0], ends[0] + ends[1], sum(ends)

    @property
    def branch(self) -> Branch:
        """The same without the steps."""
        return Branch(*(Fraction(each, self.unit) for each in (self.a, self.b, *self.times)))

    def __str__(self) -> str:
        """As a `cut` of `theory/Flights.v`."""
        runs = " ".join(
            "[" + "; ".join(f"({step}%Z, {count}%nat)" for step, count in each) + "]"
            for each in (self.lifts, self.flights, self.falls)
        )
        return f"(Cut ({self.a}) ({self.b}) {runs})"


class Flown(NamedTuple):
    """The height, its first and its second derivative in time, for launches from [m - r, m + r].

    eps: the coefficient of restitution; velocities before the impact are from [g - s, g + s].
    """

    side: int
    eta: float
    nu: float
    m: float
    r: float
    eps: float = 0.0
    g: float = 0.0
    s: float = 0.0

    def height(self, t: float, order: int, aside: float = 0.0) -> tuple[float, float]:
        """Enclose a derivative at times t - aside to t + aside, as `March.v` does."""
        side, eta, nu, swing = self.side, self.eta, self.nu, self.nu / self.eta * (1 + self.eps)
        rise = side * (1 + nu * math.sin(self.m))
        push = side * (self.eps * self.g + swing * math.cos(self.m))
        wall, tau, psi = side * nu, eta * t, self.m + t
        turn = order * math.pi / 2  # a derivative turns by a right angle
        scale = eta**order
        middle = scale * (rise * math.cos(tau + turn) + push * math.sin(tau + turn))
        middle -= wall * math.sin(psi + turn) + (side if order == 0 else 0)
        bent = self.r**2 / 2  # of second order
        lift = self.r * abs(nu * math.cos(self.m)) + bent * abs(nu)
        radius = lift * scale * abs(math.cos(tau + turn))
        kick = self.r * abs(swing * math.sin(self.m)) + bent * abs(swing) + self.eps * self.s
        radius += kick * scale * abs(math.sin(tau + turn))
        radius += (self.r + aside) * abs(nu * math.cos(psi + turn)) + (self.r + aside) ** 2 * abs(
            nu
        )
        waves = abs(rise * math.sin(tau + turn)) + abs(push * math.cos(tau + turn))
        waves += lift + kick
        radius += aside * scale * eta * waves + (aside * eta) ** 2 * scale * (abs(rise) + abs(push))
        return middle - radius * _SPARE, middle + radius * _SPARE

    def lifts(self, t: float, step: float) -> bool:
        """Whether gap'' > 0 is seen for a step."""
        return self.height(t + step / 2, 2, step / 2)[0] > 0

    def flies(self, t: float, step: float) -> bool:
        """Whether gap > 0 is seen for a step."""
        rate = self.height(t + step / 2, 1, step / 2)[0]
        return self.height(t, 0)[0] + min(0.0, step * rate) > 0

    def falls(self, t: float, step: float) -> bool:
        """Whether gap' < 0 is seen for a step."""
        return self.height(t + step / 2, 1, step / 2)[1] < 0

    def is_over(self, t: float) -> bool:
        """Whether gap < 0 is seen at a time, where `March.v` knows sines by lengths alone."""
        return self.height(t, 0)[1] + self.r * abs(self.nu) < 0


def march(test: Callable[[float, float], bool], start: int, end: int, unit: int) -> list[Run]:
    """Return runs of steps from start to end with which the test succeeds; raise NoHint if none."""
    runs: list[Run] = []
    step = int(_FIRST * unit)
    while start < end:
        step = min(step * 2, int(_FIRST * unit))
        while not test(start / unit, min(step, end - start) / unit):
            step //= 2
            if step < _LEAST * unit:
                raise NoHint(f"no step is found at time {start / unit:.4f}")
        now = min(step, end - start)
        if runs and runs[-1][0] == now and now * (runs[-1][1] + 1) <= _LONGEST * unit:
            runs[-1] = now, runs[-1][1] + 1
        else:
            runs.append((now, 1))
        start += now
    return runs


class Cutter:
    """Cuts the flights of one oscillator; phases and times are whole numbers of a unit."""

    def __init__(self, hints: Hints, ends: Iterable[Fraction]) -> None:
        self.hints = hints
        numbers = (hints.eta, hints.nu, SLACK, *ends)
        self.unit = math.lcm(*(each.denominator for each in numbers)) * PARTS

    @property
    def numbers(self) -> dict[str, object]:
        """What the templates have of the oscillator, in units."""
        hints = self.hints
        named = {"eta": self.in_units(hints.eta), "nu": self.in_units(hints.nu), "side": hints.side}
        return {**named, "unit": self.unit, "bits": BITS}

    def in_units(self, x: Fraction) -> int:
        """Return a number in units, of which it is a multiple."""
        return int(x * self.unit)

    def _flown(self, m: float, r: float) -> Flown:
        return Flown(self.hints.side, *self.hints.floats, m, r)

    def cut(self, low: Fraction, high: Fraction, room: float = 0.0) -> Cut:
        """Cut the flights from phases [low, high], up to `room` at least around their impacts."""
        hints, unit = self.hints, self.unit
        phases = steps(float(low), float(high), 8 if low < high else 1)
        times = [hints.impact(phase) for phase in phases]
        flown = self._flown(float(low + high) / 2, float(high - low) / 2)
        least, greatest = flown.height(times[0], 0)
        slowest = min(-hints.gap(*at, 1) for at in zip(phases, times, strict=True))
        room = max(room, 2 * (greatest - least) / slowest)
        lift = int(hints.launch(phases, min(times) / 2) * unit)
        u, v = int((min(times) - room) * unit), int((max(times) + room) * unit)
        if not flown.is_over(v / unit):
            raise NoHint(f"the impacts of {show_range((low, high))} are too spread")
        return Cut(
            unit,
            self.in_units(low),
            self.in_units(high),
            march(flown.lifts, 0, lift, unit),
            march(flown.flies, lift, u, unit),
            march(flown.falls, u, v, unit),
        )

    def pieces(
        self, low: Fraction, high: Fraction, least: float = 0.0, depth: int = 0
    ) -> list[Cut]:
        """Cut an interval of phases, on the pieces of which |f'| >= least is seen."""
        try:
            slack = min(SLACK, (high - low) / 8)
            piece = self.cut(low - slack, high + slack)
            if self.slope(piece) >= least:
                return [piece]
            raise NoHint(f"f' is too near its bound in {show_range((low, high))}")
        except NoHint:
            if depth == _DEEPEST:
                raise
        middle = (low + high) / 2
        halves = (low, middle), (middle, high)
        return [piece for half in halves for piece in self.pieces(*half, least, depth + 1)]

    def slope(self, piece: Cut) -> float:
        """Return the bound from below on |f'| that `Flights.v` sees on a piece."""
        eta, nu = self.hints.floats
        m, r = (piece.a + piece.b) / 2 / self.unit, (piece.b - piece.a) / 2 / self.unit
        u, v = (each / self.unit for each in piece.times[1:])
        fall = -self._flown(m, r).height((u + v) / 2, 1, (v - u) / 2)[0]
        swing = abs(math.sin(eta * (u + v) / 2)) - eta * (v - u) / 2
        pull = abs(nu * math.sin(m) * (1 - eta**2) - eta**2) - abs(nu * (1 - eta**2)) * r
        return max(0.0, swing) / eta * max(0.0, pull) / fall / _SPARE

    def laps(self, cell: Range, targets: Sequence[Range], least: float) -> str:
        """Cut the flights from an interval that f maps over others; return `laps` of Flights.v."""
        images = [float(end) + self.hints.impact(float(end)) for end in cell]
        turns = math.floor(images[0] / math.tau)
        ends = [
            self.cut(end, end, self._room(image - turns * math.tau, targets))
            for end, image in zip(cell, images, strict=True)
        ]
        rising = str(images[0] < images[1]).lower()
        pieces = ";\n    ".join(map(str, self.pieces(*cell, least)))
        return f"  (Laps {turns} {rising} [{pieces}]\n    {ends[0]} {ends[1]})"

    def _room(self, image: float, targets: Sequence[Range]) -> float:
        """Return how well the impact after an end of an interval is to be known."""
        room = min(abs(image - float(end)) for target in targets for end in target) / 4
        if room < _LEAST / 4:
            raise NoHint(f"an image is too near the end of an interval at {image:.9f}")
        return min(room, _LARGEST)


def graph(writer: Writer, hints: Hints, i: int, found: StayingSet) -> None:
    """Write the graph of a staying set: where its phases go, and its entropy."""
    cutter = Cutter(hints, [end for cell in found.cells for end in cell])
    bound = _bound(float(found.expansion))
    targets = [[found.cells[j] for j in after] for after in found.onward]
    data = [
        cutter.laps(cell, after, float(bound))
        for cell, after in zip(found.cells, targets, strict=True)
    ]
    values = {**cutter.numbers, "i": i}
    is_other = within(hull(found.cells), OTHER)
    arrows = [(a, b) for a, after in enumerate(found.onward) for b in after]
    cells = ", ".join(map(show_range, found.cells))
    says = (
        f"a next impact follows each phase of {cells}, at f; with {len(arrows)} arrows between "
        f"these intervals each infinite path is followed by one phase alone, each periodic path by "
        f"a periodic phase; the slope is {show(bound)} at least in size, and f on these phases is "
        "conjugate to the shift on paths, and they are a compact set"
    )
    writer.state(
        f"graph{i}",
        says,
        flight_text.GRAPH,
        ("G5",) if is_other else (),
        **values,
        cells="; ".join(f"({rational(a)}, {rational(b)})" for a, b in found.cells),
        arrows=pairs(arrows),
        numerators=pairs([(cutter.in_units(a), cutter.in_units(b)) for a, b in found.cells]),
        flights=";\n".join(data),
        m=bound.numerator,
        n=bound.denominator,
    )
    growth = min(map(len, found.onward))
    if growth > 1:
        says = f"the entropy of f on these phases is at least log({growth})"
        ones = "[" + "; ".join("1" for _ in found.cells) + "]%Z"
        named = {**values, "growth": growth, "ones": ones}
        writer.state(f"entropy{i}", says, flight_text.ENTROPY, ("G9",), **named)


def _bound(least: float) -> Fraction:
    """Return a bound above 1 on |f'|, with room for enclosures."""
    return Fraction(math.floor((1 + 0.8 * (least - 1)) * 100), 100)
