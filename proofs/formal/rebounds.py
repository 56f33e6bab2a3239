"""Write the Coq file of two rectangles of states that F, with restitution, maps across both.

Data that Coq's own checker computes. The writer is not trusted: a reader reads `theory/Rebounds.v`
and the theorems here.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from fractions import Fraction

from proofs.formal import rebound_text as text
from proofs.formal.flights import BITS, PARTS
from proofs.formal.hints import SLACK, NoHint
from proofs.formal.strips import ASIDE, Bounds, Flights, Piece
from proofs.formal.written import Case, NoTheorem, Writer, fields
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.horseshoe import Horseshoe
from proofs.trusted.kernel.rectangles import Rectangle
from proofs.trusted.numbers import show, within
from proofs.trusted.paper.s33_restitution.horseshoes import RectangleHorseshoe, restituting
from proofs.trusted.paper.s33_restitution.rectangles import Strips
from proofs.trusted.parameters import Parameters
from proofs.trusted.verify import Report

CLAIMS = ("N1", "N2", "N3")


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
    """Collects the theorems on two rectangles."""

    def __init__(self, shoe: RectangleHorseshoe, maps: list[Rectangle]) -> None:
        super().__init__()
        self.shoe, self.maps, self.c = shoe, maps, shoe.rates.cone.width
        (self.left, self.velocities), (self.right, _) = (each.box for each in maps)
        sides = [low for low, _ in shoe.at.sides]
        numbers = [*sides, *self.left, *self.right, *self.velocities, ASIDE, SLACK]
        self.unit = math.lcm(*(each.denominator for each in numbers), 100) * PARTS
        self.flights = [Flights(each, self.unit) for each in maps]
        self.pieces, self.bounds = self._chosen()
        edges = dict(zip(("A", "b0", "a1", "B"), (*self.left, *self.right), strict=True))
        inner, outer = self.velocities, self.flights[0].beyond
        data = (*self.bounds, *inner, *outer)
        self.numbers = {
            **{"bits": BITS, "unit": self.unit, "side": shoe.at.side},
            **dict(zip(("eta_", "nu_", "eps_"), map(self._in_units, sides), strict=True)),
            **edges,
            **{"g0": inner[0], "g1": inner[1], "c": self.c},
            **self.bounds._asdict(),
            "bounds": " ".join(f"({self._in_units(each)})" for each in data),
        }

    def _in_units(self, x: Fraction) -> int:
        return int(x * self.unit)

    def _chosen(self) -> tuple[list[list[Piece]], Bounds]:
        """Return pieces of both rectangles that are small enough for the theorems."""
        found = [each.pieces(each.phases, self.c) for each in self.flights]
        bounds = Bounds.of([entries for _, every in found for entries in every])
        if not bounds.holds(self.c):
            raise NoHint("the cone condition is not seen")
        return [pieces for pieces, _ in found], bounds

    def _strip(self, i: int) -> str:
        """Return the data of a rectangle."""
        flights, of = self.flights[i], self.maps[i]
        edges = [self._in_units(end) for end in flights.phases]
        times = flights.edges((self.left[0], self.right[1]))
        numbers = [*edges, of.turns[0], *flights.window]
        pieces = ";\n    ".join(map(str, self.pieces[i]))
        first = " ".join(f"({each})" for each in numbers)
        return f"Strip {first}\n    [{pieces}]\n    {times[0]} {times[1]}"

    def theorems_on(self, of: object) -> None:
        """Write the model, the full shift and the hyperbolicity."""
        (p, q, r, s), c = self.bounds, self.c
        self.state("model", text.MODEL_IN_WORDS, text.MODEL)
        self.add(text.STRIPS, left=self._strip(0), right=self._strip(1))
        strips, rate = self.shoe.strips, self.bounds.rate(c)
        says = (
            f"{strips}: each two-sided sequence of 1 and 2 is the history of exactly one full "
            "orbit of F there; on the states of these orbits F is conjugate to the two-sided full "
            f"shift; states of sequences that agree from -n to n are {show(rate)}^n size apart"
        )
        self.state("rectangles_horseshoe", says, text.HORSESHOE, rate=rate)
        least = float(c * (r * q + s * p) / (c * p - r))
        contraction = Fraction(math.ceil(least * 100 + 1e-6), 100)
        says = (
            f"there horizontal distances grow {show(p)} times at least, vertical ones shrink to "
            f"{show(max(q, s))} times at most, the cones |dgamma| <= {show(c)} |dphi| are kept and "
            f"stretched {show(p - q * c)} times, in those around the vertical distances shrink to "
            f"{show(contraction)} times at most"
        )
        named = {"expansion": p - q * c, "contraction": contraction}
        self.state("hyperbolic", says, text.HYPERBOLIC, self._uniform(of), **named)

    def _uniform(self, of: object) -> tuple[str, ...]:
        """Return claim N2 where the printed rectangles lie in these."""
        if not isinstance(of, Parameters) or of.velocities is None:
            return ()
        pairs = (of.left, self.left), (of.right, self.right), (of.velocities, self.velocities)
        return ("N2",) if all(within(*pair) for pair in pairs) else ()

    def edge(self, of: object) -> None:
        """Write that a corner of the printed V2 falls short, if it does."""
        if not isinstance(of, Parameters) or of.velocities is None:
            return
        first, x, g = of.left[0], of.right[1], of.velocities[0]
        (low, high), (least, most) = self.maps[1].box
        flights = self.flights[1]
        own = math.tau * self.maps[1].turns[0]  # the time after which the phase is again x
        time, beyond = flights.impact((float(x), float(g))), own + float(first - x)
        if low <= x <= high and least <= g <= most and beyond + 1e-6 < time < own - 1e-6:
            says = (
                f"the printed V2 falls short: ({show(x)}, {show(g)}) on its right edge has an "
                f"image at a phase between {show(first)} and {show(x)}, and all images of V2 are "
                "within one turn of the circle"
            )
            at = {"l_": self._in_units(first), "x_": self._in_units(x), "g_": self._in_units(g)}
            at["t0"] = max(int((time + beyond) / 2 * self.unit), flights.window.u)
            at["t"] = int((time + own) / 2 * self.unit)
            self.state(
                "printed_edge_falls_short", says, text.EDGE, ("N1",), l=first, x=x, g=g, **at
            )


def case(report: Report, source: str, digest: str) -> Case:
    """Return the Coq file of the first two rectangles that F maps across both."""
    for shoe, maps in _found(report, source):
        writer = Rectangles(shoe, maps)
        writer.theorems_on(report.parameters)
        writer.edge(report.parameters)
        eta, nu, eps = (low for low, _ in shoe.at.sides)
        numbers = fields(side=shoe.at.side, eta=eta, nu=nu, eps=eps)
        return writer.ended(text.HEAD.format(digest=digest, **numbers))
    raise NoTheorem("it has no horseshoe of two rectangles at one oscillator with restitution")
