"""Section 3.3: from what F does on rectangles of states to horseshoes, for boxes of oscillators.

Each theorem is a rule: a function from conclusions of earlier steps, named in the witness.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.meter import METER
from proofs.trusted.numbers import Range, ceil_text, floor_text, hull, show, show_range
from proofs.trusted.paper.s33_restitution.cones import Cone, Rates, rates
from proofs.trusted.paper.s33_restitution.rebounds import size
from proofs.trusted.paper.s33_restitution.rectangles import (
    ALL,
    Blocks,
    Maps,
    Strips,
    blocks,
    crossing,
    parts_of,
    read_maps,
    require_rising,
    strips,
)
from proofs.trusted.parameters import Place
from proofs.trusted.slopes import signed


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
            f"compact set K in the union of V1 and V2 with F(K) = K, F on K is {self.rates}."
        )

    @property
    def brief(self) -> str:
        grow, shrink = floor_text(self.grow, 2), ceil_text(self.shrink, 3)
        return f"horizontal distances grow at least {grow} times, vertical ones shrink to {shrink}"


def hyperbolic(maps: Maps) -> Hyperbolic:
    """Theorem. What `Hyperbolic.sentence` says, if `strips` and `rates` hold, and |p| > 1,
    |q| + |s| < 1.

    Proof. 1. By the mean value theorem differences of images are D times those of the states, D a
    mean of DF, p and (q, s) are its entries in question. 2. An invariant cone field with such rates
    on a compact invariant set makes it hyperbolic.
    """
    grow = min(signed(each.derivative[0][0], each.sign)[0] for each in maps)
    shrink = max(size(each.derivative[0][1]) + size(each.derivative[1][1]) for each in maps)
    if grow <= 1 or shrink >= 1:
        raise Unproved("distances are not proved to grow and to shrink")
    return Hyperbolic(maps[0].at, strips(maps), grow, shrink, rates(parts_of(maps)))


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
            text += f" {FULL_SHIFT.format(self.rates)}"
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


def horseshoe(context: Context, reader: Reader) -> RectangleHorseshoe:
    """Rule `rectangle-horseshoe`: {rectangles: two or four names, cone: [slope, width]}.

    Two, N_0 left of N_1, have the same velocities, and all arrows i -> j. Of four, N_0 and N_1 are
    for the states next after N_0 and N_2, N_2 and N_3 for those next after N_1 and N_3, epsilon is
    > 0, velocities of N_0 and N_1 are apart from those of N_2 and N_3, N_0 lies left of N_1, N_2
    left of N_3, and where an image may have a phase of one of N_0 to N_3 that is not next, its
    velocity is not one of it. For other arrows see `golden-mean`.

    Hypotheses: 1. All are about the same oscillators; in each the next phase increases with phi, or
    in each that decreases epsilon > 0, and images do not reach around the circle. 2. Of each N_i
    the left edge goes to the left and the right edge to the right of all next N_j, or the other way
    around where the next phase decreases; images of parts of N_i that may have phases of a next
    N_j have velocities in the interior of those of N_j. 3. The inequalities of `rates`.

    Conclusion: let V1 be the union of those N_i on the left, V2 of those on the right, and A the
    compact set of the states whose full orbits x_(n+1) = F(x_n) stay in V1 or V2. It lies in the
    interiors of the N_i. Each two-sided sequence of 1 and 2 is the itinerary of exactly one full
    orbit in A, which is hyperbolic. If epsilon > 0, F is one-to-one, and F on A is conjugate to the
    two-sided shift. If epsilon = 0, phases alone are a map f, and each one-sided sequence is the
    itinerary of exactly one phase.

    Proof. 1. Call a compact connected part of N_i that meets its left and its right edge a crossing
    set, as N_i is itself. By 2 its image, connected, reaches beyond each next N_j on both sides,
    and where it has phases of N_j, it has velocities of N_j: so it contains a crossing set of N_j
    (boundary bumping). So finite paths are followed, by compactness all. Full orbits in V1 and V2
    follow the arrows: only next rectangles hold the images. 2. Let z_n be the differences of two
    orbits of one itinerary, both in the same rectangle for each n; z_(n+1) is D times z_n, D a mean
    of DF. Were one z_n != 0 in the cone, then all after it, by (1) of `rates`, and they would grow
    without bound. So all z_n != 0 are outside, and by (2) |y| of z_n is at most contraction^k times
    that of z_(n-k), for all k: z_n = 0. No arrow leads from an edge, and a state of A is an image:
    by hypothesis 2 its velocity is in the interior. 3. F is one-to-one for epsilon > 0: from the
    state before an impact the flight is run back to its launch, the last zero of the gap before;
    phase and velocity there determine gamma, as epsilon != 0. The itinerary is then a continuous
    bijection of compact sets. 4. For epsilon = 0 F depends on phi alone, p = f' > 1. See Gidea and
    Zgliczynski, Covering relations for multidimensional dynamical systems, J. Differential
    Equations 202 (2004).
    """
    METER.get().spend(2000)  # all in fractions, which nobody counts
    names, cone_of = reader.fields("rectangles", "cone")
    maps, cone = read_maps(context, names, 4), Cone(*cone_of.numbers(2, 2))
    if len(maps) == 2:
        sets: Strips | Blocks = strips(maps)
        margin = crossing(maps, ALL)
    elif len(maps) == 4:
        sets = blocks(maps)
        margin = crossing(maps, ((0, 1), (2, 3)) * 2)
    else:
        raise names.fail("two or four rectangles")
    if maps[0].at.sides[2][0] == 0:  # the sentence is about f' then, not about |f'|
        require_rising(maps)
    return RectangleHorseshoe(maps[0].at, sets, margin, rates(parts_of(maps), cone))


def union(context: Context, reader: Reader) -> RectangleHorseshoe:
    """Rule `horseshoe-union`: {parts: names of rectangle-horseshoes}.

    Hypotheses: all are on the same rectangles; each is for a box of oscillators that agrees with
    the hull of those before it but for one side, where they meet. Conclusion: a horseshoe for the
    hull of all boxes, which is their union, with the worst of the bounds. Proof. Boxes that agree
    but for one side, on which they meet, have no oscillator between them: each of the hull is in
    one of the boxes, whose step is about it and these rectangles.
    """
    (names,) = reader.fields("parts")
    parts = [context.step(name, RectangleHorseshoe) for name in names.items(least=1)]
    first = parts[0]
    at, sets = first.at, first.strips
    for part in parts:
        sides = ("eta", "nu", "epsilon")
        apart = [name for name in sides if getattr(at, name) != getattr(part.at, name)]
        if part.strips != sets or len(apart) > 1:
            raise Unproved("horseshoes are on other rectangles, or their boxes form no box")
        for name in apart:
            one, two = getattr(at, name), getattr(part.at, name)
            if one[1] < two[0] or two[1] < one[0]:
                raise Unproved(f"the boxes leave a hole in {name}")
            at = replace(at, **{name: hull([one, two])})
    margin = min(part.margin for part in parts)
    return RectangleHorseshoe(at, sets, margin, Rates.worst([part.rates for part in parts]))


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
