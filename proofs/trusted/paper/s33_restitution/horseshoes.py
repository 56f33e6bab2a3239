"""Section 3.3: from what F does on rectangles of states to horseshoes, for boxes of oscillators.

Each theorem is a rule: a function from conclusions of earlier steps, named in the witness.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import NamedTuple

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.numbers import TURN, Phases, Range, ceil_text, floor_text, hull, show_range
from proofs.trusted.paper.s33_restitution.rebounds import RectangleMap, sides, size
from proofs.trusted.parameters import Place

CONE = Fraction(2)  # unstable vectors have |dgamma| <= CONE |dphi|
Maps = tuple[RectangleMap, RectangleMap]


@dataclass(frozen=True)
class Strips:
    """Two rectangles of states, V1 = left x velocities to the left of V2 = right x velocities."""

    left: Phases
    right: Phases
    velocities: Range

    def __post_init__(self) -> None:
        if self.left[1] >= self.right[0] or self.velocities[0] >= self.velocities[1]:
            raise Unproved("the rectangles overlap or have no width")

    @property
    def outer(self) -> Range:
        """The phases of the left edge of V1 and of the right edge of V2."""
        return self.left[0], self.right[1]

    def __str__(self) -> str:
        left, right, gamma = map(show_range, (self.left, self.right, self.velocities))
        return f"V1 = {left} x {gamma}, V2 = {right} x {gamma} (closed, phases x velocities)"

    @property
    def smooth(self) -> str:
        """The beginning of a theorem about them."""
        return (
            f"let {self}: all their states are physically possible (gap' <= 0), and F is smooth "
            "on them"
        )


def strips(maps: Maps) -> Strips:
    """Return the rectangles of two maps, or raise Unproved unless these are about one oscillator
    and in both the next phase increases with phi, and images do not reach around the circle.

    So only one of the values of a next phase modulo 2 pi can lie in a rectangle, as image phases
    are between those of the edges: the line replaces the circle.
    """
    first, second = maps
    found = Strips(first.phases, second.phases, first.velocities)
    if (first.at, first.velocities) != (second.at, second.velocities):
        raise Unproved("the rectangles are about different oscillators or velocities")
    for each in maps:
        if each.derivative[0][0][0] <= 0:
            raise Unproved("the next phase is not proved to increase with the phase")
        if each.right[1] >= found.outer[0] + TURN or each.left[0] <= found.outer[1] - TURN:
            raise Unproved("an image reaches around the circle")
    return found


def read_maps(context: Context, names: Reader) -> Maps:
    """Read the names of two rectangle steps."""
    first, second = (context.step(name, RectangleMap) for name in names.items(2, 2))
    return first, second


# -- cones -----------------------------------------------------------------------------------------


class Rates(NamedTuple):
    """How vectors (x, y) = (dphi, dgamma / CONE) grow and shrink under DF.

    expansion: a lower bound > 1 on |x'| / |x| where |y| <= |x|; contraction: an upper bound < 1
    on |y'| / |y| where |x'| <= |y'|.
    """

    expansion: Fraction
    contraction: Fraction

    def __str__(self) -> str:
        return (
            "uniformly hyperbolic: unstable directions have |dgamma| <= 2 |dphi| and are stretched "
            f"at least {floor_text(self.expansion, 2)} times in phase by each step, stable ones "
            f"have |dphi| <= |dgamma| / 2 and shrink to at most {ceil_text(self.contraction, 3)} "
            "times in velocity"
        )

    @staticmethod
    def worst(each: Sequence[Rates]) -> Rates:
        """Return rates that hold for all."""
        return Rates(min(x.expansion for x in each), max(x.contraction for x in each))


def rates(maps: Sequence[RectangleMap]) -> Rates:
    """Return the rates of hypothesis 3 of the rule `rectangle-horseshoe`, or Unproved.

    They hold, as does the hypothesis, if p > 0 and the bounds are on the right sides of 1.
    Proof. 1. The form is positive definite if its second diagonal entry, q^2 - s^2 + 1, and its
    determinant, p^2 + s^2 - q^2 - r^2 - 1 - (p s - q r)^2, are positive. 2. Q increases, so vectors
    with |y| <= |x| are mapped to such, and |x'| <= |y'| implies |x| <= |y|. 3. |x'| >= (|p| - |q|)
    |x| if |y| <= |x|. 4. If |x'| <= |y'|, then |p x| <= |y'| + |q y| <= |r x| + (|q| + |s|) |y|,
    which bounds |x|, then |y'| <= |r x| + |s y|.
    """
    found = []
    for each in maps:
        (p, q_range), (r_range, s_range) = each.derivative
        q, r, s = CONE * size(q_range), size(r_range) / CONE, size(s_range)
        determinant = p[0] ** 2 - q**2 - r**2 - 1 - (p[1] * s + q * r) ** 2
        if p[0] <= r or s >= 1 or determinant <= 0:
            raise Unproved("the cone condition is not proved")
        found.append(Rates(p[0] - q, r * (q + s) / (p[0] - r) + s))
    least = Rates.worst(found)
    if least.expansion <= 1 or least.contraction >= 1:
        raise Unproved("the rates are not proved hyperbolic")
    return least


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
            f"compact set K in V1 and V2 with F(K) = K, F on K is {self.rates}."
        )

    @property
    def brief(self) -> str:
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
    return Hyperbolic(maps[0].at, strips(maps), grow, shrink, rates(maps))


# -- horseshoes ------------------------------------------------------------------------------------


def crossing(maps: Maps, arrows: tuple[tuple[int, ...], tuple[int, ...]]) -> Fraction:
    """Check hypotheses 1 and 2 of the rule `rectangle-horseshoe` for these arrows, or Unproved.

    Return by how much at least edges overshoot the rectangles that they should.
    """
    (lowest, highest), margins = strips(maps).velocities, []
    for each, targets in zip(maps, arrows, strict=True):
        low, high = hull([maps[target].phases for target in targets])
        margins += [low - each.left[1], each.right[0] - high]
        if not lowest < each.velocity[0] <= each.velocity[1] < highest:
            raise Unproved("an image velocity is not in the interior of the velocities")
    if min(margins) <= 0:
        short = ceil_text(-min(margins))
        raise Unproved(f"an edge is not mapped beyond the rectangles: up to {short} short")
    return min(margins)


@dataclass(frozen=True)
class RectangleHorseshoe(Conclusion):
    """F maps V1 and V2 across both, edges at least `margin` beyond: the full shift."""

    at: Place
    strips: Strips
    margin: Fraction
    rates: Rates

    @property
    def sentence(self) -> str:
        least, most = sides(self.at)[2]
        text = f"{self.strips.smooth}. F maps each across both; {self.brief}."
        if most > 0:
            text += (
                " Each two-sided sequence of 1 and 2 is the itinerary of exactly one full orbit of "
                "F in V1 and V2; the states of these orbits are a compact set, on which F is "
                f"{self.rates}. All of them lie in the open rectangles: the same is true of those. "
                "For epsilon > 0 F is one-to-one on V1 and V2, and on this set "
                "conjugate to the two-sided full shift on two symbols, of entropy log 2."
            )
        if least == 0:
            text += (
                " For epsilon = 0 the plastic map f is continuously differentiable on the phases "
                f"of V1 and of V2, with f' >= {floor_text(self.rates.expansion, 2)}; each "
                "one-sided sequence is the itinerary of exactly one phase whose orbit stays there, "
                "and f on these is conjugate to the one-sided full shift, of entropy log 2."
            )
        return text

    @property
    def brief(self) -> str:
        return f"edges overshoot both rectangles by at least {floor_text(self.margin)}"


def horseshoe(context: Context, reader: Reader) -> RectangleHorseshoe:
    """Rule `rectangle-horseshoe`: {rectangles: two names}.

    Hypotheses: 1. N_0 lies left of N_1, both about the same oscillators and with the same
    velocities G; in both the next phase increases with phi, and images do not reach around the
    circle. 2. Image velocities lie in the interior of G, and of each N_i the left edge goes to the
    left and the right edge to the right of all N_j, i -> j being all arrows (for other arrows see
    `golden-mean`). 3. With (x, y) = (dphi, dgamma / 2), Q = x^2 - y^2 and D any matrix of numbers
    within the bounds on DF in these coordinates, p > 0 and D^T Q D - Q is positive definite; if
    |y| <= |x|, |x'| >= expansion |x|, expansion > 1; if |x'| <= |y'|, |y'| <= contraction |y|,
    contraction < 1.

    Conclusion: let A be the compact set of states whose full orbits x_(n+1) = F(x_n) exist and
    follow the arrows. It lies in the interiors of the N_i. Each two-sided path of arrows is the
    itinerary of exactly one full orbit in A, which is hyperbolic. If epsilon > 0, F is one-to-one,
    and F on A is conjugate to the two-sided shift on paths. If epsilon = 0, phases alone are a map
    f, and each one-sided path is the itinerary of exactly one phase.

    Proof. 1. Call the graph of a function gamma(phi) over the phases of N_i, with Lipschitz
    constant 2, a curve. By 3 the image of a curve is such a graph, over an interval that contains
    N_j's phases, with velocities in G: it contains a curve of N_j. So finite paths are followed, by
    compactness all. 2. The difference of the images of two states of N_i is D times theirs, D a
    mean of DF. So along two orbits of one itinerary Q(z_n) increases and is bounded, z_n -> 0 at
    both ends, Q(z_n) = 0 and z = 0. No arrow leads from an edge, and the velocity of a state of A
    is that of an image: by hypothesis 2 it is in the interior. 3. F is one-to-one for epsilon > 0:
    from the state before an impact the flight is run back to its launch, the last zero of the gap
    before; phase and velocity there determine gamma, as epsilon != 0. The itinerary is then a
    continuous bijection of compact sets. 4. For epsilon = 0 F depends on phi alone, p = f' > 1. See
    Gidea and Zgliczynski, Covering relations for multidimensional dynamical systems, J.
    Differential Equations 202 (2004).
    """
    maps = read_maps(context, *reader.fields("rectangles"))
    margin = crossing(maps, ((0, 1), (0, 1)))
    return RectangleHorseshoe(maps[0].at, strips(maps), margin, rates(maps))


def union(context: Context, reader: Reader) -> RectangleHorseshoe:
    """Rule `horseshoe-union`: {parts: names of rectangle-horseshoes}.

    Hypotheses: all are on the same rectangles; each is for a box of oscillators that agrees with
    the hull of those before it but for one side, where they meet. Conclusion: a horseshoe for the
    hull of all boxes, which is their union, with the worst of the bounds.
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
