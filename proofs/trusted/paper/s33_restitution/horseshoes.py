"""Section 3.3: from what F does on rectangles of states to symbolic dynamics, and its absence.

Each theorem is a rule: a function from conclusions of earlier steps, named in the witness.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import product
from typing import NamedTuple

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.meter import METER
from proofs.trusted.numbers import (
    TURN,
    Range,
    ceil_text,
    floor_text,
    hull,
    show,
    show_range,
    within,
)
from proofs.trusted.paper.s33_restitution.rebounds import (
    Rebound,
    Rectangle,
    RectangleMap,
    restitution,
    size,
)
from proofs.trusted.parameters import Place

CONE = Fraction(2)  # unstable vectors have |dgamma| <= CONE |dphi|
_LONGEST = 10  # symbols of a barred word
Maps = tuple[RectangleMap, RectangleMap]


@dataclass(frozen=True)
class Strips:
    """Two rectangles with the same velocities, V1 = left to the left of V2 = right."""

    left: Rectangle
    right: Rectangle

    def __post_init__(self) -> None:
        """Raise Unproved where they are not."""
        if self.left.velocities != self.right.velocities:
            raise Unproved("the rectangles have different velocities")
        if self.left.phases[1] >= self.right.phases[0]:
            raise Unproved("the rectangles overlap")

    @property
    def outer(self) -> Range:
        """The phases of the left edge of V1 and of the right edge of V2."""
        return self.left.phases[0], self.right.phases[1]

    def __str__(self) -> str:
        """Write both."""
        return f"V1 = {self.left}, V2 = {self.right} (closed, phases x velocities)"


def strips(maps: Maps) -> Strips:
    """Return the rectangles of two maps, or raise Unproved unless these are about one oscillator
    and in both the next phase increases with phi, and images do not reach around the circle.

    So only one of the values of a next phase modulo 2 pi can lie in a rectangle, as image phases
    are between those of the edges: the line replaces the circle.
    """
    found = Strips(maps[0].rectangle, maps[1].rectangle)
    if maps[0].at != maps[1].at:
        raise Unproved("the rectangles are about different oscillators")
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
        """Write what hyperbolic means."""
        return (
            f"uniformly hyperbolic: unstable directions have |dgamma| <= {show(CONE)} |dphi| and "
            f"each step stretches them at least {floor_text(self.expansion, 2)} times in phase, "
            f"stable ones have |dphi| <= {show(1 / CONE)} |dgamma| and shrink in velocity to at "
            f"most {ceil_text(self.contraction, 3)} times"
        )


def worst(each: Iterable[Rates]) -> Rates:
    """Return rates that hold for all."""
    expansions, contractions = zip(*each, strict=True)
    return Rates(min(expansions), max(contractions))


def rates(on: RectangleMap) -> Rates:
    """Theorem. Let p > 0, and for D = (p q; r s), any matrix of numbers within the bounds on DF
    in the coordinates (x, y) of `Rates`, and Q(x, y) = x^2 - y^2, let D^T Q D - Q be positive
    definite. Then vectors with |y| <= |x| are mapped to such, those whose image has |x'| <= |y'|
    have |x| <= |y|, and `Rates` holds, if its bounds are on the right sides of 1.

    Proof. 1. The form is positive definite if its second diagonal entry, q^2 - s^2 + 1, and its
    determinant, p^2 + s^2 - q^2 - r^2 - 1 - (p s - q r)^2, are positive. 2. Q increases, hence the
    cones. 3. |x'| >= (|p| - |q|) |x| if |y| <= |x|. 4. If |x'| <= |y'|, then |p x| <= |y'| + |q y|
    <= |r x| + (|q| + |s|) |y|, which bounds |x|, then |y'| <= |r x| + |s y|.
    """
    (p, q_range), (r_range, s_range) = on.derivative
    q, r, s = CONE * size(q_range), size(r_range) / CONE, size(s_range)
    determinant = p[0] ** 2 - q**2 - r**2 - 1 - (p[1] * s + q * r) ** 2
    if p[0] <= r or s >= 1 or determinant <= 0:
        raise Unproved("the cone condition is not proved")
    found = Rates(p[0] - q, r * (q + s) / (p[0] - r) + s)
    if found.expansion <= 1 or found.contraction >= 1:
        raise Unproved("the rates are not proved hyperbolic")
    return found


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


# -- covering --------------------------------------------------------------------------------------


def crossing(maps: Maps, arrows: tuple[tuple[int, ...], tuple[int, ...]]) -> Fraction:
    """Return by how far edges overshoot: F maps rectangle i across the rectangles arrows[i].

    Theorem. Let image velocities lie in the interior of G, the velocities of both rectangles, and
    of each i the left edge go to the left and the right edge to the right of all N_j, j in
    arrows[i]; let `strips` and `rates` hold. Let A be the compact set of states whose full orbits
    x_(n+1) = F(x_n) exist and follow these arrows. Each two-sided path of arrows is the itinerary
    of exactly one full orbit in A, which is hyperbolic. If epsilon > 0, F is one-to-one, and F on
    A is conjugate to the two-sided shift on paths. If epsilon = 0, phases alone are a map f, and
    each one-sided path is the itinerary of exactly one phase.

    Proof. 1. Call the graph of a function gamma(phi) over the phases of N_i, with Lipschitz
    constant CONE, a curve. By `rates` the image of a curve is such a graph, over an interval that
    contains N_j's phases, with velocities in G: it contains a curve of N_j. So finite paths are
    followed, by compactness all. 2. The difference of the images of two states of N_i is D times
    theirs, D a mean of DF. So along two orbits of one itinerary Q(z_n) increases and is bounded,
    z_n -> 0 at both ends, Q(z_n) = 0 and z = 0. 3. F is one-to-one for epsilon > 0: from the state
    before an impact the flight is run back to its launch, the last zero of the gap before; phase
    and velocity there determine gamma, as epsilon != 0. The itinerary is then a continuous
    bijection of compact sets. 4. For epsilon = 0 F depends on phi alone, p = f' > 1. See Gidea and
    Zgliczynski, Covering relations for multidimensional dynamical systems, J. Differential
    Equations 202 (2004).
    """
    margins = []
    for each, targets in zip(maps, arrows, strict=True):
        low, high = hull([maps[target].phases for target in targets])
        margins += [low - each.left[1], each.right[0] - high]
        velocities = each.rectangle.velocities
        if not velocities[0] < each.velocity[0] <= each.velocity[1] < velocities[1]:
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
        """Return the theorem; for epsilon = 0 about the phases alone."""
        least, most = restitution(self.at)
        text = (
            f"let {self.strips}. All their states are physically possible (gap' <= 0), F is smooth "
            "on them and maps each across both, left edges to the left and right ones to the right "
            f"of both by at least {floor_text(self.margin)}."
        )
        if most > 0:
            text += (
                " Each two-sided sequence of 1 and 2 is the itinerary of exactly one full orbit of "
                "F in V1 and V2; the states of these orbits are a compact set, on which F is "
                f"{self.rates}. {'If epsilon > 0, ' if least == 0 else ''}F is one-to-one on V1 "
                "and V2, and on this set conjugate to the two-sided full shift on two symbols, of "
                "entropy log 2."
            )
        if least == 0:
            phases = " and ".join(
                show_range(x.phases) for x in (self.strips.left, self.strips.right)
            )
            text += (
                f" {'If epsilon = 0, the' if most > 0 else 'The'} plastic map f is continuously "
                f"differentiable on {phases}, with f' >= {floor_text(self.rates.expansion, 2)}; "
                "each one-sided sequence of 1 and 2 is the itinerary of exactly one phase whose "
                "orbit stays in them, and f on these phases is conjugate to the one-sided full "
                "shift on two symbols, of entropy log 2."
            )
        return text

    @property
    def brief(self) -> str:
        """Return the margin."""
        return f"edges overshoot both rectangles by at least {floor_text(self.margin)}"


def horseshoe(context: Context, reader: Reader) -> RectangleHorseshoe:
    """Rule `rectangle-horseshoe`: {rectangles: two names}.

    Conclusion: `crossing` with all arrows.
    """
    maps = read_maps(context, *reader.fields("rectangles"))
    margin = crossing(maps, ((0, 1), (0, 1)))
    return RectangleHorseshoe(maps[0].at, strips(maps), margin, worst(map(rates, maps)))


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
    return RectangleHorseshoe(at, sets, margin, worst(part.rates for part in parts))


# -- words that no orbit follows -------------------------------------------------------------------


@dataclass(frozen=True)
class BarredWord(Conclusion):
    """There is no orbit x_0, ..., x_n of F with x_k in V1 where word[k] = 0, in V2 where it is 1.

    short: by how much the n-th image at least falls short of the last rectangle.
    """

    at: Place
    strips: Strips
    word: tuple[int, ...]
    short: Fraction

    @property
    def brief(self) -> str:
        """Return the word, and where."""
        return f"{self._text}, at {self.at}"

    @property
    def sentence(self) -> str:
        """Return the statement."""
        return f"{self._text}; {self.strips}."

    @property
    def _text(self) -> str:
        names = [f"V{symbol + 1}" for symbol in self.word]
        return (
            f"no orbit of F follows {' '.join(names)}: the last impact misses {names[-1]} by at "
            f"least {floor_text(self.short)}"
        )


def barred_word(context: Context, reader: Reader) -> BarredWord:
    """Rule `barred-word`: {rectangles: two names, word of 0 and 1, images: rebound steps, from}.

    from: "above" or "below". Hypotheses, from above: image k is about the states {b_k} x G_k at
    least, b_k a phase of the rectangle word[k], G_0 its velocities, G_(k+1) the image velocities
    of the rectangle word[k]; with e_0 the right end of word[0] and e_(k+1) the greatest phase of
    image k, min(e_k, right end of word[k]) <= b_k; the last e_n is left of word[n]. From below:
    with left for right and <= for >=. Conclusion: no orbit follows the word.
    Proof. The next phase increases with phi (`strips`). So if phi_k <= b_k and gamma_k is in G_k,
    then phi_(k+1) <= e_(k+1), and phi_(k+1) <= b_(k+1) if it is in the rectangle.
    """
    maps_of, word_of, images_of, side = reader.fields("rectangles", "word", "images", "from")
    maps, word = read_maps(context, maps_of), word_of.string()
    if side.string() not in ("above", "below"):
        raise side.fail("above or below")
    if not set(word) <= {"0", "1"} or not 2 <= len(word) <= _LONGEST:
        raise word_of.fail(f"a word is 2 to {_LONGEST} symbols 0 and 1")
    above, path = side.string() == "above", [maps[int(symbol)] for symbol in word]
    end = 1 if above else 0
    gammas, extreme = path[0].rectangle.velocities, path[0].phases[end]
    for here, name in zip(path, images_of.items(len(word) - 1, len(word) - 1), strict=False):
        image, (low, high) = context.step(name, Rebound), here.phases
        bound = image.phases[0]
        if bound != image.phases[1] or not low <= bound <= high:
            raise Unproved("a bound is not a phase of the rectangle")
        if (bound < min(extreme, high)) if above else (bound > max(extreme, low)):
            raise Unproved("a phase beyond the bound is not excluded")
        if (image.at, image.turns) != (here.at, here.turns):
            raise Unproved("an image is about another oscillator, or whole turns apart")
        if not within(gammas, image.velocities):
            raise Unproved("an image is not about all velocities")
        extreme, gammas = image.phase[end], here.velocity
        if not within(gammas, here.rectangle.velocities):
            raise Unproved("an image velocity leaves the rectangles")
    low, high = path[-1].phases
    short = low - extreme if above else extreme - high
    if short <= 0:
        raise Unproved("an orbit along the word is not excluded")
    return BarredWord(maps[0].at, strips(maps), tuple(map(int, word)), short)


@dataclass(frozen=True)
class GoldenMean(Conclusion):
    """Full orbits in V1 and V2 are those that never repeat V2: the golden mean shift."""

    at: Place
    strips: Strips
    rates: Rates

    @property
    def sentence(self) -> str:
        """Return the theorem."""
        return (
            f"let {self.strips}. All their states are physically possible (gap' <= 0), F is smooth "
            "and one-to-one on V1 and V2. Let Lambda_2 be the set of all states whose full orbits "
            "stay in V1 and V2. F on Lambda_2 is conjugate, by the itinerary, to the shift on all "
            f"two-sided sequences of 1 and 2 without 22 (golden mean shift), and is {self.rates}. "
            "Lambda_2 has topological entropy log((1 + sqrt 5)/2), periodic orbits of every "
            "period, uncountably many nonperiodic orbits and a dense orbit."
        )

    @property
    def brief(self) -> str:
        """Return the point."""
        return "F on Lambda_2 is conjugate to the two-sided shift on sequences without 22"


def golden_mean(context: Context, reader: Reader) -> GoldenMean:
    """Rule `golden-mean`: {rectangles: two names, part: a rectangle, words: barred-word steps}.

    Hypotheses: epsilon > 0; every word of some length that ends in 11 (V2 twice) contains a barred
    word; V1 and N = `part`, a part of V2 with the same left edge, have the arrows 0 -> 0, 0 -> 1,
    1 -> 0. Conclusion: `GoldenMean.sentence`.
    Proof. 1. V2 is never followed by V2 in a full orbit, thus by V1. 2. The right edge of N goes to
    the right of V1 and the next phase increases on V2, so a state of V2 outside N does not go to
    V1. So full orbits in V1 and V2 follow the arrows, and `crossing` describes those.
    """
    names, part_of, words_of = reader.fields("rectangles", "part", "words")
    maps, part = read_maps(context, names), context.step(part_of, RectangleMap)
    words = [context.step(name, BarredWord) for name in words_of.items(most=64)]
    (first, second), found = maps, strips(maps)
    if restitution(first.at)[0] <= 0:
        raise Unproved("without restitution F is not one-to-one")
    if any((word.at, word.strips) != (first.at, found) for word in words):
        raise Unproved("words are about other rectangles or oscillators")
    if not never_twice([word.word for word in words]):
        raise Unproved("V2 is not proved never to be repeated")
    same = part.turns == second.turns and part.phases[0] == second.phases[0]
    if not same or part.phases[1] > second.phases[1]:
        raise Unproved("N is no part of V2 with the same left edge")
    strips((first, part))
    crossing((first, part), ((0, 1), (0,)))
    return GoldenMean(first.at, found, worst([rates(first), rates(part)]))


def never_twice(words: Sequence[tuple[int, ...]]) -> bool:
    """Whether every word of some length that ends in 11 contains one of these."""
    longest = max(map(len, words), default=0)
    METER.get().spend(len(words) << longest)
    return longest > 0 and all(
        any((*start, 1, 1)[k : k + len(word)] == word for word in words for k in range(longest))
        for start in product((0, 1), repeat=longest - 2)
    )
