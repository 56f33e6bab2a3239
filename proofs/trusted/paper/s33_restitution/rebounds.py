"""The impact map F with restitution on rectangles: conclusions of proof steps, and joining them.

A state is (phi, gamma): phase and velocity v / (omega_n p) before an impact. F takes it to the
state before the next impact; its phase is taken on the line, less a fixed number of turns.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction

from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.numbers import TURN, Range, ceil_text, hull, within

Box = tuple[Range, Range, Range]  # eta, nu, epsilon
Entries = tuple[tuple[Range, Range], tuple[Range, Range]]  # DF: rows (phase, velocity)
CONE = Fraction(2)  # unstable vectors have |dgamma| <= CONE |dphi|


class Unjoined(ValueError):
    """Conclusions that do not join to the one wanted, and why."""


def size(values: Range) -> Fraction:
    """Return the largest absolute value in a range."""
    return max(abs(values[0]), abs(values[1]))


@dataclass(frozen=True)
class Rebound(Conclusion):
    """For oscillators in `box` and states in phases x velocities: impacts after `turns` turns.

    All states are possible, F is smooth in states and parameters; `phase` and `velocity` enclose
    F, `derivative` its derivative DF.
    """

    box: Box
    phases: Range
    velocities: Range
    turns: int
    phase: Range
    velocity: Range
    derivative: Entries

    def reaches(self, box: Box, velocities: Range) -> bool:
        """Whether it is about these oscillators and velocities, and maybe more."""
        inside = all(within(a, b) for a, b in zip(box, self.box, strict=True))
        return inside and within(velocities, self.velocities)


@dataclass(frozen=True)
class Rectangle(Conclusion):
    """For oscillators in `box`: F on phases x velocities, smooth, all states possible.

    Phases of images are less `turns` turns. left, right: enclosures of those of the left and of
    the right edge; velocity: of all image velocities; derivative: of DF.
    """

    box: Box
    phases: Range
    velocities: Range
    turns: int
    left: Range
    right: Range
    velocity: Range
    derivative: Entries


@dataclass(frozen=True)
class BarredWord(Conclusion):
    """For oscillators in `box`: no orbit x_0, ..., x_n of F with x_k in the rectangle word[k].

    0 stands for left x velocities, 1 for right x velocities. short: by how much the n-th image
    at least falls short of the last rectangle.
    """

    box: Box
    sets: tuple[Range, Range]
    velocities: Range
    word: tuple[int, ...]
    short: Fraction


def edge(parts: Sequence[Rebound], phase: Fraction, box: Box, velocities: Range) -> Rebound:
    """Return the conclusion about one phase, at least these velocities, that says most."""
    known = [
        part
        for part in parts
        if part.reaches(box, velocities) and within((phase, phase), part.phases)
    ]
    if not known:
        raise Unjoined("no step is about all states of an edge")
    return min(known, key=lambda part: part.phase[1] - part.phase[0])


def rectangle(parts: Sequence[Rebound], box: Box, phases: Range, velocities: Range) -> Rectangle:
    """Join conclusions whose phases, one after the other, cover a rectangle.

    Where two of them meet the first impact is the same, so F is one smooth map, its phase
    continuous, as all take the same number of turns off.
    """
    used: list[Rebound] = []
    reach = phases[0]
    known = [part for part in parts if part.reaches(box, velocities)]
    if not reach < phases[1]:
        raise Unjoined("a rectangle without width")
    while reach < phases[1]:
        onward = [part for part in known if part.phases[0] <= reach < part.phases[1]]
        if not onward:
            raise Unjoined("the steps do not cover the rectangle")
        used.append(max(onward, key=lambda part: part.phases[1]))
        reach = used[-1].phases[1]
    ends = [edge(parts, phase, box, velocities) for phase in phases]
    turns = used[0].turns
    if any(part.turns != turns for part in (*used, *ends)):
        raise Unjoined("the impacts are whole turns apart")
    (p, q), (r, s) = (
        tuple(hull([part.derivative[i][j] for part in used]) for j in (0, 1)) for i in (0, 1)
    )
    velocity = hull([part.velocity for part in used])
    images = ends[0].phase, ends[1].phase
    return Rectangle(box, phases, velocities, turns, *images, velocity, ((p, q), (r, s)))


def check_pair(rectangles: tuple[Rectangle, Rectangle]) -> None:
    """Raise Unjoined unless the first rectangle lies left of the second, about the same map.

    In both the next phase increases with phi, and only one of its values modulo 2 pi can lie in
    a rectangle, as image phases are between those of the edges: the line replaces the circle.
    """
    first, second = rectangles
    if (first.box, first.velocities) != (second.box, second.velocities):
        raise Unjoined("the rectangles are about different oscillators or velocities")
    if first.phases[1] >= second.phases[0]:
        raise Unjoined("the rectangles overlap")
    for one in rectangles:
        if one.derivative[0][0][0] <= 0:
            raise Unjoined("the next phase is not proved to increase with the phase")
        if one.right[1] >= first.phases[0] + TURN or one.left[0] <= second.phases[1] - TURN:
            raise Unjoined("an image reaches around the circle")


def barred(
    parts: Sequence[Rebound],
    rectangles: tuple[Rectangle, Rectangle],
    word: tuple[int, ...],
    bounds: Sequence[Fraction],
    sign: int,
) -> BarredWord:
    """Show that no orbit x_0, ..., x_n follows a word, by bounds on its phases.

    From above, sign = 1: the next phase increases with phi. So if phi_k <= b_k, a phase of the
    rectangle, and gamma_k is in G_k, then phi_(k+1) <= e_k, the greatest image phase of
    {b_k} x G_k, and phi_(k+1) <= min(e_k, right end) <= b_(k+1). G_0 is the rectangle's, then
    G_(k+1) the image velocities of word[k]. It ends with e_(n-1) < the left end of word[n]. From
    below, sign = -1, likewise: all that follows compares sign times the phases.
    """
    check_pair(rectangles)
    first = rectangles[0]
    if len(word) != len(bounds) + 1 or len(word) < 2 or not set(word) <= {0, 1}:
        raise Unjoined("a word needs a bound for each of its symbols but the last")
    far, near = (1, 0) if sign > 0 else (0, 1)
    gammas, extreme = first.velocities, rectangles[word[0]].phases[far]
    for symbol, bound in zip(word, bounds, strict=False):
        here = rectangles[symbol]
        end = sign * here.phases[far]
        if not min(sign * extreme, end) <= sign * bound <= end:
            raise Unjoined("a phase beyond the bound is not excluded")
        image = edge(parts, bound, first.box, gammas)
        if image.turns != here.turns:
            raise Unjoined("the impacts are whole turns apart")
        extreme, gammas = image.phase[far], here.velocity
        if not within(gammas, first.velocities):
            raise Unjoined("an image velocity leaves the rectangles")
    short = sign * (rectangles[word[-1]].phases[near] - extreme)
    if short <= 0:
        raise Unjoined("an orbit along the word is not excluded")
    sets = first.phases, rectangles[1].phases
    return BarredWord(first.box, sets, first.velocities, word, short)


@dataclass(frozen=True)
class Horseshoe(Conclusion):
    """What the function `horseshoe` proves; margin: by how far edges overshoot the targets."""

    rectangles: tuple[Rectangle, Rectangle]
    arrows: tuple[tuple[int, ...], tuple[int, ...]]
    margin: Fraction
    expansion: Fraction
    contraction: Fraction


def horseshoe(
    rectangles: tuple[Rectangle, Rectangle], arrows: tuple[tuple[int, ...], tuple[int, ...]]
) -> Horseshoe:
    """Prove that F maps rectangle i across the rectangles arrows[i], hyperbolically.

    Hypotheses: N_0 lies left of N_1, both have the velocities G; image velocities are in the
    interior of G; of each i the left edge goes to the left and the right edge to the right of
    all N_j, j in arrows[i]; with Q(x, y) = x^2 - y^2, (x, y) = (dphi, dgamma / CONE), and any
    matrix D = (p q; r s) of numbers within the bounds of DF in these coordinates, D^T Q D - Q is
    positive definite.

    Theorem. Let A be the compact set of states whose full orbits x_(n+1) = F(x_n) exist and follow
    these arrows. Each two-sided path of arrows is the itinerary of exactly one full orbit in A. A
    is hyperbolic: vectors with |y| <= |x| are mapped to such, x at least `expansion` > 1 times
    longer; vectors whose image has |x| <= |y| are such, y of the image at most `contraction` < 1
    times as long. If epsilon > 0, F is one-to-one, and F on A is conjugate to the two-sided shift
    on paths. If epsilon = 0, phases alone are a map f, and each one-sided path is the itinerary of
    exactly one phase.

    Proof. The difference of the images of two states of N_i is D times theirs, D a mean of DF.
    Call the graph of a function gamma(phi) over the phases of N_i, with Lipschitz constant CONE, a
    curve. By Q(D z) > Q(z) >= 0 the image of a curve is such a graph, over an interval that
    contains N_j's phases, with velocities in G: it contains a curve of N_j. So finite paths are
    followed, by compactness all. Uniqueness and hyperbolicity: Q(z_n) increases along two orbits
    of one itinerary and is bounded, so z_n -> 0 at both ends, Q(z_n) = 0 and z = 0. |x'| >=
    (|p| - |q|) |x| if |y| <= |x|; if |x'| <= |y'|, then |p x| <= |y'| + |q y| <= |r x| +
    (|q| + |s|) |y|, which bounds |x|, then |y'| <= |r x| + |s y|. F is one-to-one for
    epsilon > 0: from the state before an impact the flight is run back to its launch, the last
    zero of the gap before; phase and velocity there determine gamma, as epsilon != 0. The
    itinerary is then a continuous bijection of compact sets. For epsilon = 0 F depends on phi
    alone. See Gidea and Zgliczynski, Covering relations for multidimensional dynamical systems,
    J. Differential Equations 202 (2004).
    """
    check_pair(rectangles)
    margins = []
    for one, targets in zip(rectangles, arrows, strict=True):
        low, high = hull([rectangles[target].phases for target in targets])
        margins += [low - one.left[1], one.right[0] - high]
        if not one.velocities[0] < one.velocity[0] <= one.velocity[1] < one.velocities[1]:
            raise Unjoined("an image velocity is not in the interior of the velocities")
    if min(margins) <= 0:
        short = ceil_text(-min(margins))
        raise Unjoined(f"an edge is not mapped beyond the rectangles: up to {short} short")
    return Horseshoe(rectangles, arrows, min(margins), *rates(rectangles))


def rates(rectangles: Iterable[Rectangle]) -> Range:
    """Return a lower bound > 1 on expansion, an upper bound < 1 on contraction; or Unjoined.

    What they mean, and why they make compact invariant sets hyperbolic, says `horseshoe`.
    """
    each = []
    for one in rectangles:
        if not in_cones(one.derivative):
            raise Unjoined("the cone condition is not proved")
        each.append(growth(one.derivative))
    expansion, contraction = min(a for a, _ in each), max(b for _, b in each)
    if expansion <= 1 or contraction >= 1:
        raise Unjoined("the rates are not proved hyperbolic")
    return expansion, contraction


def in_cones(of: Entries) -> bool:
    """Whether p > 0 and D^T Q D - Q is positive definite within bounds, with `magnitudes`.

    The second diagonal entry, q^2 - s^2 + 1, and the determinant, which is
    p^2 + s^2 - q^2 - r^2 - 1 - (p s - q r)^2, are positive.
    """
    least, most, q, r, s = magnitudes(of)
    determinant = least**2 - q**2 - r**2 - 1 - (most * s + q * r) ** 2
    return least > 0 and s < 1 and determinant > 0


def magnitudes(of: Entries) -> tuple[Fraction, Fraction, Fraction, Fraction, Fraction]:
    """Return the least p, and bounds on |p|, |q|, |r|, |s|, for (x, y) = (dphi, dgamma / CONE)."""
    (p, q), (r, s) = of
    return p[0], size(p), CONE * size(q), size(r) / CONE, size(s)


def stable_slope(of: Entries) -> Fraction:
    """Return a bound on |x / y| for vectors (x, y) whose image (x', y') has |x'| <= |y'|."""
    least, _, q, r, s = magnitudes(of)
    if least <= r:
        raise Unjoined("phases do not expand enough for the cones")
    return (q + s) / (least - r)


def growth(of: Entries) -> Range:
    """Return the expansion p - |q| and the contraction |r| (|q| + |s|) / (p - |r|) + |s|."""
    least, _, q, r, s = magnitudes(of)
    return least - q, r * stable_slope(of) + s
