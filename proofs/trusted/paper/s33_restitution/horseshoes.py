"""Section 3.3: from what F does on rectangles of states to horseshoes, for boxes of oscillators.

The rules `rectangle` and `horseshoe` prove it of any map; here is what that means for F.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from fractions import Fraction

from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion, place_of
from proofs.trusted.kernel.horseshoe import Horseshoe
from proofs.trusted.kernel.laps import signed
from proofs.trusted.kernel.rates import Rates, rates, size
from proofs.trusted.kernel.rectangles import Rectangle, require_together
from proofs.trusted.numbers import Phases, Range, ceil_text, floor_text, hull, show, show_range
from proofs.trusted.paper.s33_restitution.rectangles import Blocks, Strips, sets_of
from proofs.trusted.parameters import Parameters, Place
from proofs.trusted.verdicts import Found

NAMES = "phi", "gamma"


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
        return (
            f"{self.strips.smooth}. The images of two states on one horizontal line of a rectangle "
            f"are at least {floor_text(self.grow, 2)} times as far apart (phases on the line), of "
            f"two on one vertical line at most {ceil_text(self.shrink, 3)} times. For every "
            "compact set K in the union of V1 and V2 with F(K) = K, F on K is "
            f"{self.rates.said(*NAMES)}."
        )

    @property
    def brief(self) -> str:
        grow, shrink = floor_text(self.grow, 2), ceil_text(self.shrink, 3)
        return f"horizontal distances grow at least {grow} times, vertical ones shrink to {shrink}"


def hyperbolic(maps: Sequence[Rectangle]) -> Hyperbolic:
    """Theorem. What `Hyperbolic.sentence` says of V1 and V2, if `require_together` and `rates`
    hold, and the entries of DF on parts, (p, q) and (r, s), obey |p| > 1, |q| + |s| < 1.

    Proof. 1. By the mean value theorem differences of images are D times those of the states, D a
    mean of DF, p and (q, s) are its entries in question. 2. An invariant cone field with such rates
    on a compact invariant set makes it hyperbolic.
    """
    require_together(maps)
    strips, parts = strips_of(maps), [part for each in maps for part in each.parts]
    grow = min(signed(each.slope, each.sign)[0] for each in maps)
    shrink = max(size(part.matrix[0][1]) + size(part.matrix[1][1]) for part in parts)
    if grow <= 1 or shrink >= 1:
        raise Unproved("distances are not proved to grow and to shrink")
    return Hyperbolic(place_of(maps[0]), strips, grow, shrink, rates(parts))


def strips_of(maps: Sequence[Rectangle]) -> Strips:
    """Return two rectangles of one height."""
    (left, heights), (right, others) = (each.box for each in maps)
    if heights != others:
        raise Unproved("the rectangles are about different velocities")
    return Strips(Phases(*left), Phases(*right), heights)


# -- horseshoes ------------------------------------------------------------------------------------


@dataclass(frozen=True)
class RectangleHorseshoe(Conclusion):
    """F maps V1 and V2 across both, edges at least `margin` beyond: the full shift."""

    at: Place
    strips: Strips | Blocks
    margin: Fraction
    rates: Rates

    def __post_init__(self) -> None:
        if isinstance(self.strips, Blocks) and self.at.sides[2][0] == 0:
            raise Unproved("without restitution a state is its phase: two rectangles are needed")

    @property
    def sentence(self) -> str:
        least, most = self.at.sides[2]
        text = f"{self.strips.smooth}. {self.strips.CROSSED}; {self.brief}."
        if most > 0:
            text += f" {FULL_SHIFT.format(self.rates.said(*NAMES))}"
        if least == 0:
            text += f" {ONE_SIDED.format(floor_text(self.rates.expansion, 2))}"
        return text

    @property
    def brief(self) -> str:
        return f"edges overshoot both rectangles by at least {floor_text(self.margin)}"


FULL_SHIFT = (
    "Each two-sided sequence of 1 and 2 is the itinerary of exactly one full orbit of F in the "
    "union of V1 and V2; the states of these orbits are a compact set, on which F is {}. All of "
    "them lie in the open rectangles: the same is true of those. For epsilon > 0 F is one-to-one "
    "on the union of V1 and V2, and on this set conjugate to the two-sided full shift on two "
    "symbols, of entropy log 2."
)
ONE_SIDED = (
    "For epsilon = 0 the plastic map f is continuously differentiable on the phases of V1 and of "
    "V2, with f' >= {}; each one-sided sequence is the itinerary of exactly one phase whose orbit "
    "stays there, and f on these is conjugate to the one-sided full shift, of entropy log 2."
)


def restituting(shoe: Horseshoe) -> RectangleHorseshoe:
    """Theorem. On V1 and V2 of a horseshoe as in `sets_of`, of oscillators, `RectangleHorseshoe`.

    Proof. Paths of arrows are the sequences of V1 and V2: of four rectangles, by the velocities,
    which tell where a state comes from. F is one-to-one for epsilon > 0: from the state before an
    impact the flight is run back to its launch, the last zero of the gap before; phase and velocity
    there determine gamma, as epsilon != 0. For epsilon = 0 F depends on phi alone, and the next
    phase increases.
    """
    at = place_of(shoe)
    if at.sides[2][0] == 0 and not shoe.is_rising:  # the sentence is about f' then, not about |f'|
        raise Unproved("the next phase is not proved to increase with the phase")
    return RectangleHorseshoe(at, sets_of(shoe), shoe.margin, shoe.rates)


def shoes(found: Iterable[Conclusion]) -> list[RectangleHorseshoe]:
    """Return what conclusions say of V1 and V2, for as large boxes of oscillators as they do."""
    proved: list[RectangleHorseshoe] = []
    for each in found:
        with suppress(Unproved):
            if isinstance(each, RectangleHorseshoe | Horseshoe):
                shoe = restituting(each) if isinstance(each, Horseshoe) else each
                while other := next((x for x in proved if adjoin(x, shoe)), None):
                    proved.remove(other)
                    shoe = union(other, shoe)
                proved.append(shoe)
    return proved


def shoes_at(of: Parameters, found: Found) -> list[RectangleHorseshoe]:
    """Return those that are about a statement's oscillator."""
    return [each for each in shoes(found.everywhere) if each.at.holds(of)]


_SIDES = "eta", "nu", "epsilon"


def adjoin(one: RectangleHorseshoe, two: RectangleHorseshoe) -> bool:
    """Whether horseshoes have the same rectangles and cone, and their boxes meet and form a box."""
    if (one.strips, one.rates.cone) != (two.strips, two.rates.cone):
        return False
    pairs = zip(one.at.sides, two.at.sides, strict=True)
    apart = [(x, y) for x, y in pairs if x != y]
    return len(apart) < 2 and all(x[0] <= y[1] and y[0] <= x[1] for x, y in apart)


def union(one: RectangleHorseshoe, two: RectangleHorseshoe) -> RectangleHorseshoe:
    """Theorem. Horseshoes that `adjoin` are one for the hull of both boxes, with the worst of the
    bounds. Proof. Boxes that agree but for one side, on which they meet, have no oscillator
    between them: each of the hull is in one of them.
    """
    pairs = zip(_SIDES, one.at.sides, two.at.sides, strict=True)
    hulls = {name: hull([x, y]) for name, x, y in pairs if x != y}
    margin = min(one.margin, two.margin)
    at, both = replace(one.at, **hulls), Rates.worst([one.rates, two.rates])
    return RectangleHorseshoe(at, one.strips, margin, both)


# -- as epsilon grows ------------------------------------------------------------------------------


def _listed(shoe: RectangleHorseshoe) -> str:
    epsilon, slope = show_range(shoe.at.sides[2]), show(shoe.rates.cone.slope)
    return f"epsilon in {epsilon}: {shoe.strips.named}, e = {slope}"


@dataclass(frozen=True)
class HorseshoeFamily(Conclusion):
    """Horseshoes for intervals of epsilon, each from the end of the one before, from 0 on."""

    shoes: tuple[RectangleHorseshoe, ...]

    def __post_init__(self) -> None:
        reached = Fraction(0)
        for shoe in self.shoes:
            eta, nu, (low, high) = shoe.at.sides
            if (eta, nu) != self.shoes[0].at.sides[:2] or eta[0] < eta[1] or nu[0] < nu[1]:
                raise Unproved("the horseshoes are about more than one eta and nu")
            if low != reached or high <= low:
                raise Unproved("the horseshoes leave a hole in epsilon")
            reached = high
        if not self.shoes:
            raise Unproved("no horseshoe for small epsilon")

    @property
    def at(self) -> Place:
        """The oscillators."""
        first, last = self.shoes[0].at, self.shoes[-1].at
        return replace(first, epsilon=(first.sides[2][0], last.sides[2][1]))

    @property
    def sentence(self) -> str:
        least = Rates(
            min(shoe.rates.expansion for shoe in self.shoes),
            max(shoe.rates.contraction for shoe in self.shoes),
        )
        return (
            "for each epsilon there are disjoint sets V1 and V2 of states, each one rectangle of "
            "phases x velocities or the union of a first and a second one, closed, and a number e: "
            f"{'; '.join(map(_listed, self.shoes))}. All their states are physically possible "
            "(gap' <= 0), and F is smooth on them. Where they are one rectangle each, "
            f"{Strips.CROSSED}; where they are unions, {Blocks.CROSSED}; edges overshoot by at "
            f"least {self._spare}. "
            + FULL_SHIFT.format(
                "uniformly hyperbolic: unstable directions are stretched at least "
                f"{floor_text(least.expansion, 2)} times in phase by each step, stable ones "
                f"shrink to at most {ceil_text(least.contraction, 3)} times in |dgamma - e dphi|"
            )
            + f" {ONE_SIDED.format(floor_text(self.shoes[0].rates.expansion, 2))}"
        )

    @property
    def brief(self) -> str:
        most = show(self.at.sides[2][1])
        return (
            f"a full shift on two symbols for every epsilon from 0 to {most}; edges overshoot by "
            f"at least {self._spare}"
        )

    @property
    def _spare(self) -> str:
        return floor_text(min(shoe.margin for shoe in self.shoes))

    @property
    def quantities(self) -> Mapping[str, Range]:
        most = self.at.sides[2][1]
        return {"epsilon_proved_up_to": (most, most)}
