"""Section 3.3: is F, with restitution, a horseshoe on V1 = ABCD and V2 = EFGH? Claims N1 to N4."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction

from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.numbers import Phases, Range, ceil_text, floor_text, show, within
from proofs.trusted.paper.s33_restitution.horseshoes import (
    Maps,
    Rates,
    RectangleHorseshoe,
    Strips,
    rates,
    strips,
    worst,
)
from proofs.trusted.paper.s33_restitution.rebounds import Rebound, RectangleMap, outward, size
from proofs.trusted.paper.s33_restitution.words import BarredWord, GoldenMean
from proofs.trusted.parameters import Parameters, Place
from proofs.trusted.verdicts import Decision, Found, Row, Verdict, decided, undecided

_NO_RECTANGLES = "epsilon > 0 and velocities are needed: without restitution see H7 to H9"


@dataclass(frozen=True)
class Hyperbolic(Conclusion):
    """F multiplies horizontal distances in V1 and V2 by at least `grow`, vertical ones by at most
    `shrink`, and is hyperbolic where it stays there.
    """

    at: Place
    strips: Strips
    grow: Fraction
    shrink: Fraction
    rates: Rates

    @property
    def sentence(self) -> str:
        """Return the theorem."""
        return (
            f"let {self.strips}. All their states are physically possible (gap' <= 0), and F is "
            "smooth on them. The images of two states on one horizontal line of a rectangle are at "
            f"least {floor_text(self.grow, 2)} times as far apart (phases on the line), of two on "
            f"one vertical line at most {ceil_text(self.shrink, 3)} times. For every compact set K "
            f"in V1 and V2 with F(K) = K, F on K is {self.rates}."
        )

    @property
    def brief(self) -> str:
        """Return the factors."""
        grow, shrink = floor_text(self.grow, 2), ceil_text(self.shrink, 3)
        return f"horizontal distances grow at least {grow} times, vertical ones shrink to {shrink}"


def hyperbolic(maps: Maps) -> Hyperbolic:
    """Theorem. What `Hyperbolic.sentence` says, if `strips` and `rates` hold, and p > 1,
    |q| + |s| < 1.

    Proof. 1. By the mean value theorem differences of images are D times those of the states, D a
    mean of DF, p and (q, s) are its entries in question. 2. An invariant cone field with such rates
    on a compact invariant set makes it hyperbolic.
    """
    grow = min(each.derivative[0][0][0] for each in maps)
    shrink = max(size(each.derivative[0][1]) + size(each.derivative[1][1]) for each in maps)
    if grow <= 1 or shrink >= 1:
        raise Unproved("distances are not proved to grow and to shrink")
    return Hyperbolic(maps[0].at, strips(maps), grow, shrink, worst(map(rates, maps)))


@dataclass(frozen=True)
class EdgeImage(Conclusion):
    """The state (phase, velocity) of an edge of V1 or of V2 has its next impact in `image`."""

    at: Place
    strips: Strips
    phase: Fraction
    velocity: Fraction
    image: Range

    def __post_init__(self) -> None:
        """Raise Unproved unless the state is a corner."""
        ends = (*self.strips.left, *self.strips.right)
        if self.phase not in ends or self.velocity not in self.strips.velocities:
            raise Unproved("the state is no corner of a rectangle")

    @property
    def edge(self) -> tuple[str, int]:
        """The side and the number of the rectangle."""
        number = 1 if self.phase in self.strips.left else 2
        lefts = self.strips.left[0], self.strips.right[0]
        return "left" if self.phase in lefts else "right", number

    @property
    def short(self) -> Fraction:
        """By how much it falls short of the outer edge, if > 0; it is not beyond the other."""
        low, high = self.strips.outer
        if not low < self.image[0] <= self.image[1] < high:
            return Fraction(0)
        return self.image[0] - low if self.edge[0] == "left" else high - self.image[1]

    @property
    def brief(self) -> str:
        """Return the image, and where."""
        return f"{self._text}, at {self.at}"

    @property
    def sentence(self) -> str:
        """Return the statement."""
        return f"{self._text}; {self.strips}."

    @property
    def _text(self) -> str:
        side, number = self.edge
        outer = show(self.strips.outer[0 if side == "left" else 1])
        short = f", short of {outer} by at least {floor_text(self.short)}" if self.short > 0 else ""
        return (
            f"F maps the state ({show(self.phase)}, {show(self.velocity)}) of the {side} edge of "
            f"V{number} to a phase in {outward(self.image)}{short}"
        )


def edge_images(strips: Strips, found: Sequence[Rebound]) -> list[EdgeImage]:
    """Return what is proved about single states at corners of rectangles."""
    images = []
    for each in found:
        (phase, last), (velocity, top) = each.phases, each.velocities
        if phase == last and velocity == top:
            with suppress(Unproved):
                images.append(EdgeImage(each.at, strips, phase, velocity, each.phase))
    return images


def printed(of: Parameters) -> Strips | None:
    """Return V1 and V2 as the statement has them; None without velocities or epsilon."""
    if of.velocities is None or of.epsilon is None:
        return None
    return Strips(Phases(*of.left), Phases(*of.right), of.velocities)


def _crosses(of: Parameters, found: Found) -> Decision:
    """N1: F maps V1 and V2 across both, at a point, so that edges that fall short refute it."""
    if of.epsilon is None:
        return undecided(_NO_RECTANGLES)
    point = Place((of.eta, of.eta), (of.nu, of.nu), (of.epsilon, of.epsilon))
    return _full(of, found, point, edges_refute=True)


def _on_box(of: Parameters, found: Found) -> Decision:
    """N4: all words are followed, for the whole box."""
    if of.box is None:
        return undecided(_NO_RECTANGLES)
    return _full(of, found, Place(*of.box), edges_refute=False)


def _full(of: Parameters, found: Found, box: Place, *, edges_refute: bool) -> Decision:
    """Decide by a horseshoe for a whole box, or by a point of it at which a word has no orbit."""
    sets = printed(of)
    if sets is None:
        return undecided(_NO_RECTANGLES)
    nearby = found.all(RectangleHorseshoe)
    whole = [each for each in nearby if each.strips == sets and inside(box, each.at)]
    if whole:
        return decided(Verdict.VERIFIED, whole[0], corrected=whole[:1])
    words = [x for x in found.elsewhere(BarredWord) if x.strips == sets and inside(x.at, box)]
    edges = edge_images(sets, [x for x in found.elsewhere(Rebound) if inside(x.at, box)])
    short = [each for each in edges if each.short > 0]
    corrected = (*found.all(GoldenMean), *nearby)
    if words or (short and edges_refute):
        reasons = (*shortest(words), *short)
        return Decision(Verdict.REFUTED, reasons, corrected, quantities=_images(edges, box))
    missing = "; ".join(["no proof about F on V1 and V2", *(each.brief for each in edges)])
    return Decision(Verdict.UNDECIDED, (), corrected, None, missing, _images(edges, box))


def _images(edges: Sequence[EdgeImage], at: Place) -> dict[str, Range]:
    named = [(each.edge, each.image) for each in edges if each.at == at]
    return {f"image_of_{side}_edge_of_V{number}": image for (side, number), image in named}


def shortest(words: Sequence[BarredWord]) -> list[BarredWord]:
    """Return the word that says most: of the fewest symbols, then the shortest."""
    return sorted(words, key=lambda x: (len(set(x.word)), len(x.word), x.word))[:1]


def _hyperbolic(of: Parameters, found: Found) -> Decision:
    sets = printed(of)
    if sets is None or not of.epsilon:
        return undecided(_NO_RECTANGLES)
    maps = [x for x in found.all(RectangleMap) if x.velocities == sets.velocities]
    known = {each.phases: each for each in maps}
    if sets.left not in known or sets.right not in known:
        return undecided("no proof about F on V1 and V2")
    try:
        proved = hyperbolic((known[sets.left], known[sets.right]))
    except Unproved as failure:
        return undecided(str(failure))
    return decided(Verdict.VERIFIED, proved, corrected=[proved])


def _orbits(of: Parameters, found: Found) -> Decision:
    """N3: the golden mean shift, or the full one; beside it, on which boxes a full one holds."""
    sets = printed(of)
    if sets is None or not of.epsilon:
        return undecided(_NO_RECTANGLES)
    golden = [each for each in found.all(GoldenMean) if each.strips == sets]
    whole = [each for each in found.all(RectangleHorseshoe) if each.strips == sets]
    own = [*golden, *whole]
    if not own:
        return undecided("no proof of which words orbits in V1 and V2 follow")
    wide = [each for each in found.elsewhere(RectangleHorseshoe) if each not in whole]
    states = found.elsewhere(Rebound)
    edges = [x for each in wide[:1] for x in edge_images(each.strips, states) if x.short > 0]
    return decided(Verdict.VERIFIED, own[0], corrected=[*own, *wide, *edges])


def inside(one: Place, two: Place) -> bool:
    """Whether the oscillators of one box are among those of another, with restitution."""
    within_epsilon = one.epsilon and two.epsilon and within(one.epsilon, two.epsilon)
    return bool(within_epsilon) and within(one.eta, two.eta) and within(one.nu, two.nu)


_SETS = "V1 = {i0} x {gamma}, V2 = {i1} x {gamma} (phases x velocities before an impact)"
_AT = "At (eta, nu, epsilon) = ({eta}, {nu}, {epsilon}), with " + _SETS + ": "
ROWS = (
    Row(
        "N1",
        "3.3, Figure 4",
        "thus we have a topological horseshoe",
        _AT + "F maps V1 and V2 across both of them, a topological horseshoe: every sequence of 1 "
        "and 2 is followed by an orbit of F.",
        _crosses,
    ),
    Row(
        "N2",
        "3.3, Figure 4",
        "the vertical distances are greatly contracted and the horizontal distances are expanded",
        _AT + "F shrinks vertical distances in V1 and in V2 and expands horizontal ones, each by a "
        "uniform factor, and is uniformly hyperbolic on the states whose full orbits stay there.",
        _hyperbolic,
    ),
    Row(
        "N3",
        "3.3",
        "countably many periodic orbits of arbitrarily high periods",
        _AT + "the set Lambda_2 of the states whose full orbits stay in V1 and V2 contains "
        "periodic orbits of arbitrarily high periods, uncountably many nonperiodic orbits, and an "
        "orbit that is dense in it.",
        _orbits,
    ),
    Row(
        "N4",
        "3.3, for boxes of parameters",
        "",
        "For all {box}, with " + _SETS + ": every two-sided sequence of 1 and 2 is the itinerary "
        "of exactly one full orbit of F in V1 and V2, and F on the states of these is uniformly "
        "hyperbolic, and conjugate to the full shift on two symbols (where epsilon = 0: f, on the "
        "phases whose orbits stay there, to the one-sided one).",
        _on_box,
    ),
)
