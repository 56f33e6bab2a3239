"""Section 3.3: is F, with restitution, a horseshoe on V1 = ABCD and V2 = EFGH? Claims N1 to N5."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from fractions import Fraction

from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.differential import Differential
from proofs.trusted.kernel.rectangles import Rectangle
from proofs.trusted.kernel.words import BarredWord
from proofs.trusted.numbers import TURN, Phases, Range, between, floor_text, show
from proofs.trusted.paper.s33_restitution.horseshoes import (
    HorseshoeFamily,
    RectangleHorseshoe,
    hyperbolic,
    shoes,
    shoes_at,
)
from proofs.trusted.paper.s33_restitution.rectangles import Strips
from proofs.trusted.paper.s33_restitution.words import GoldenMean, golden_means
from proofs.trusted.parameters import Parameters, Place
from proofs.trusted.verdicts import Decision, Found, Row, Verdict, decided, undecided


@dataclass(frozen=True)
class EdgeImage(Conclusion):
    """The state (phase, velocity), a corner of V1 or of V2, has its next impact in `image`.

    That is less so many turns.
    """

    at: Place
    strips: Strips
    phase: Fraction
    velocity: Fraction
    image: Range
    turns: int

    def __post_init__(self) -> None:
        ends = (*self.strips.left, *self.strips.right)
        if self.phase not in ends or self.velocity not in self.strips.velocities:
            raise Unproved("the state is no corner of a rectangle")

    @property
    def is_left(self) -> bool:
        """Whether the edge is a left one, whose images should be left of both rectangles."""
        return self.phase in (self.strips.left[0], self.strips.right[0])

    @property
    def edge(self) -> str:
        """The name of the edge."""
        number = 1 if self.phase in self.strips.left else 2
        return f"{'left' if self.is_left else 'right'} edge of V{number}"

    @property
    def short(self) -> Fraction:
        """By how much it falls short of the outer edge, if > 0; it is not beyond the other."""
        (first, last), (low, high) = self.strips.outer, self.image
        if not first < low <= high < last:
            return Fraction(0)
        return low - first if self.is_left else last - high

    def fails(self, others: Iterable[EdgeImage]) -> bool:
        """Whether F does not map its rectangle across both, if it falls short, by the other edge.

        Theorem. So it is if a state of that has its image, less as many turns, less than a turn
        beyond the outer edges. Proof. This edge is not beyond them in this turn of the circle, nor
        are both, on different sides, in any other one.
        """
        (first, last), edges = self.strips.outer, (self.strips.left, self.strips.right)
        return any(
            {self.phase, other.phase} in map(set, edges)
            and (other.at, other.turns) == (self.at, self.turns)
            and first - TURN < other.image[0] <= other.image[1] < last + TURN
            for other in others
        )

    @property
    def brief(self) -> str:
        target = show(self.strips.outer[0 if self.is_left else 1])
        gap = f", short of {target} by at least {floor_text(self.short)}" if self.short > 0 else ""
        return (
            f"F maps the state ({show(self.phase)}, {show(self.velocity)}) of the {self.edge} to "
            f"a phase in {between(self.image)}{gap}"
        )

    @property
    def sentence(self) -> str:
        return f"{self.brief}; {self.strips}."


def edge_images(strips: Strips, states: Sequence[Differential]) -> list[EdgeImage]:
    """Return what is proved about single states at corners of rectangles."""
    images = []
    for each in states:
        if each.place is None or each.place.epsilon is None:  # a plastic impact has no velocity
            continue
        (phase, most), (velocity, highest) = each.box
        if (phase, velocity) == (most, highest):
            with suppress(Unproved):
                state = phase, velocity
                images.append(EdgeImage(each.place, strips, *state, each.values[0], each.turns[0]))
    return images


# -- the rows --------------------------------------------------------------------------------------


def stated(of: Parameters) -> tuple[Strips, Place]:
    """Return V1 and V2 as the statement has them, and its oscillators."""
    if of.velocities is None or of.box is None:
        raise Unproved("epsilon and velocities are needed: without restitution see H7 to H9")
    return Strips(Phases(*of.left), Phases(*of.right), of.velocities), of.box


def with_restitution(of: Parameters) -> Strips:
    """Return V1 and V2 where impacts are not plastic."""
    if of.epsilon == 0:
        raise Unproved("epsilon > 0 is needed: without restitution see H7 to H9")
    return stated(of)[0]


def _full(of: Parameters, found: Found, *, edges_refute: bool = False) -> Decision:
    """Decide by a horseshoe for a whole box, or by a point of it at which a word has no orbit.

    edges_refute: whether edges that fall short there refute the claim, too.
    """
    sets, box = stated(of)
    nearby = shoes_at(of, found)
    for each in nearby:
        if each.strips == sets and box.inside(each.at):
            return decided(Verdict.VERIFIED, each, corrected=[each])
    words = [x for x in found.elsewhere(BarredWord) if x.boxes == sets.boxes and _inside(x, box)]
    states = [x for x in found.elsewhere(Differential) if _inside(x, box)]
    edges = edge_images(sets, states)
    short = [each for each in edges if each.short > 0]
    corrected = (*golden_means(found.here), *nearby)
    known = {f"image_of_{x.edge}".replace(" ", "_"): x.image for x in edges if x.at == box}
    if words or (edges_refute and any(each.fails(edges) for each in short)):
        words.sort(key=lambda x: (len(set(x.word)), len(x.word), x.word))  # of the fewest symbols
        reasons = (*words[:1], *short)
        return Decision(Verdict.REFUTED, reasons, corrected, quantities=known)
    briefs = [f"{each.brief}, at {each.at}" for each in edges]
    missing = "; ".join(["no proof about F on V1 and V2", *briefs])
    return Decision(Verdict.UNDECIDED, (), corrected, None, missing, known)


def _inside(conclusion: Conclusion, box: Place) -> bool:
    return conclusion.place is not None and conclusion.place.inside(box)


def _hyperbolic(of: Parameters, found: Found) -> Decision:
    boxes = with_restitution(of).boxes
    maps = {x.box: x for x in found.all(Rectangle)}
    if not {*boxes} <= {*maps}:
        return undecided("no proof about F on V1 and V2")
    proved = hyperbolic([maps[box] for box in boxes])
    return decided(Verdict.VERIFIED, proved, corrected=[proved])


def _orbits(of: Parameters, found: Found) -> Decision:
    """N3: the golden mean shift, or the full one; beside it, on which boxes a full one holds."""
    printed = with_restitution(of)
    whole: list[GoldenMean | RectangleHorseshoe]
    whole = [*golden_means(found.here), *shoes_at(of, found)]
    own = [each for each in whole if each.strips == printed]
    if not own:
        return undecided("no proof of which words orbits in the union of V1 and V2 follow")
    wide = [each for each in shoes(found.everywhere) if each not in own]
    states = found.elsewhere(Differential)
    sets = [each.strips for each in wide[:1] if isinstance(each.strips, Strips)]
    edges = [x for each in sets for x in edge_images(each, states) if x.short > 0]
    return decided(Verdict.VERIFIED, own[0], corrected=[*own, *wide, *edges])


def _family(of: Parameters, found: Found) -> Decision:
    """N5: horseshoes for one interval of epsilon after the other, on rectangles that move."""
    if of.epsilon is None:
        return undecided("epsilon is needed: without restitution see H7 to H9")
    point = (of.eta, of.eta), (of.nu, of.nu)
    here = [x for x in shoes(found.everywhere) if x.at.sides[:2] == point]
    proved = HorseshoeFamily(tuple(sorted(here, key=lambda each: each.at.sides[2])))
    most = proved.at.sides[2][1]
    if most <= of.epsilon:
        return undecided(f"proved up to epsilon = {show(most)} only")._replace(corrected=(proved,))
    return decided(Verdict.VERIFIED, proved, corrected=[proved], margin=most - of.epsilon)


_SETS = "V1 = {i0} x {gamma}, V2 = {i1} x {gamma} (phases x velocities before an impact)"
_AT = "At (eta, nu, epsilon) = ({eta}, {nu}, {epsilon}), with " + _SETS + ": "
ROWS = (
    Row(
        "N1",
        "3.3, Figure 4",
        "thus we have a topological horseshoe",
        _AT + "F maps V1 and V2 across both of them, their left and right edges beyond the "
        "outermost ones, a topological horseshoe: every sequence of 1 and 2 is followed by an "
        "orbit of F.",
        lambda of, found: _full(replace(of, reach=None), found, edges_refute=True),
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
        _AT + "the set Lambda_2 of the states whose full orbits stay in the union of V1 and V2 "
        "contains periodic orbits of arbitrarily high periods, uncountably many nonperiodic "
        "orbits, and an orbit that is dense in it.",
        _orbits,
    ),
    Row(
        "N4",
        "3.3, for boxes of parameters",
        "",
        "For all {box}, with " + _SETS + ": every two-sided sequence of 1 and 2 is the itinerary "
        "of exactly one full orbit of F in the union of V1 and V2, and F on the states of these is "
        "uniformly hyperbolic, and conjugate to the full shift on two symbols (where epsilon = 0: "
        "f, on the phases whose orbits stay there, to the one-sided one).",
        _full,
    ),
    Row(
        "N5",
        "3.3, for larger epsilon",
        "",
        "At (eta, nu) = ({eta}, {nu}), for every epsilon from 0 to some number above {epsilon} "
        "there are disjoint sets V1 and V2 of states, each one rectangle or the union of two, such "
        "that every two-sided sequence of 1 and 2 is the itinerary of exactly one full orbit of F "
        "in the union of V1 and V2, and F on the states of these is uniformly hyperbolic, and "
        "conjugate to the "
        "full shift on two symbols (where epsilon = 0: f, to the one-sided one).",
        _family,
    ),
)
