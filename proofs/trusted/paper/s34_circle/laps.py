"""How much chaos at most? What the pieces of the circle can lead to, in a graph. Row G17."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cache

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import About, Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.coverings import EntropyBound, Weighted, read_images
from proofs.trusted.kernel.elementary import log
from proofs.trusted.kernel.meter import METER
from proofs.trusted.numbers import Range, between, show, within
from proofs.trusted.paper.s34_circle.pieces import Known, Pieces
from proofs.trusted.parameters import Parameters
from proofs.trusted.verdicts import Decision, Found, Row, Verdict, decided, undecided

_LOG_BITS = 160
_NEAR = Fraction(1, 100)  # within which row G17 asks for the entropy


# -- the outer graph -------------------------------------------------------------------------------


@dataclass(frozen=True)
class EntropyRange(Conclusion):
    """The entropy of f is log of a number in [lower.growth, growth], by so many `states`."""

    pieces: Pieces
    lower: EntropyBound
    states: int
    growth: Fraction

    def __post_init__(self) -> None:
        if self.lower.at != self.at or self.growth < self.lower.growth:
            raise Unproved("two bounds that are not those of one entropy")
        if not set(self.lower.branches) <= {each.branch for each in self.pieces.monotone}:
            raise Unproved("the lower bound is about other branches")

    at = About("pieces")

    @property
    def entropy(self) -> Range:
        """Enclose the entropy."""
        return self.lower.entropy[0], log(self.growth, _LOG_BITS).range[1]

    @property
    def sentence(self) -> str:
        return (
            f"{self.pieces.sentence} Let h be the supremum of the topological entropies of f on "
            "compact sets K of phases with f(K) in K on which f is continuous. Then log "
            f"{show(self.lower.growth)} <= h <= log {show(self.growth)}: h is in "
            f"{between(self.entropy)}. If N_n words of length n over these intervals are followed "
            "by orbits in J, the limit of log(N_n) / n lies in the same range. Both hold whether a "
            "graze or a touch counts as an impact or not."
        )

    @property
    def brief(self) -> str:
        return (
            f"log {show(self.lower.growth)} <= entropy <= log {show(self.growth)}, by graphs on "
            f"{self.lower.states} and {self.states} intervals"
        )

    @property
    def latex(self) -> str:
        return rf"\log {show(self.lower.growth)} \le h \le \log {show(self.growth)}"

    @property
    def quantities(self) -> Mapping[str, Range]:
        return {"entropy": self.entropy}


def entropy_range(
    pieces: Pieces, lower: EntropyBound, known: Known, outer: Weighted
) -> EntropyRange:
    """Theorem. Let J and the pieces be those of `Pieces`, `known` enclose f at phases, and D_i
    be intervals, one of them containing J, with weights v_i > 0. For each i let the sum over the
    pieces b with D_i of the least v_j with f(X_ib) and J together in D_j, X_ib the part of D_i in
    b, be at most m v_i, m = growth >= 1. Then what `EntropyRange.sentence` says.

    Proof. 1. Let N_n(i) be the number of words of n pieces that phases of D_i follow, orbits in J.
    Then N_n(i) <= the sum of N_(n-1)(j) over these b, j, but for a constant: a word of phases that
    never impact, or one that ends since f(X_ib) misses J. So N_n(i) <= C n m^n, and so is N_n.
    N_(k+n) <= N_k N_n: the limit exists; different paths of the lower bound are different words.
    2. Let K be such a set. K' = {phi: f^n(phi) in J for all n} in K is compact, f(K') in K'. An
    ergodic measure on K either lives on K', or on the one orbit that leads from the arc to it: so
    by the variational principle f has no more entropy on K than on K'.
    3. In an (n, d)-separated set E of K', order the phases that follow one word: two neighbours
    are d apart at some time k < n, and f^k is monotone on them, so that at most |J|/d pairs are
    for the same k: E has at most N_n (1 + n |J| / d) points (Misiurewicz and Szlenk 1980).
    """
    states, weights, growth = outer
    if min(weights) <= 0:
        raise Unproved("weights > 0 are expected")
    region, monotone = pieces.region, pieces.monotone
    ranked = sorted(zip(weights, states, strict=True))
    if not any(within(region, state) for state in states):
        raise Unproved("no state contains all phases that do not lead to the arc")

    @cache
    def least(image: Range) -> Fraction:
        """Return the least weight of a state that contains what an image has in common with J."""
        METER.get().spend(2 * len(ranked))
        first, last = pieces.unwrapped(image)
        low, high = max(first, region[0]), min(last, region[1])
        if low > high:
            return Fraction(0)
        weight = next((v for v, state in ranked if within((low, high), state)), None)
        if weight is None:
            raise Unproved("an image is in no state")
        return weight

    for state, weight in zip(states, weights, strict=True):
        METER.get().spend(4 * len(monotone))
        found = (piece.image(state, known) for piece in monotone)
        if sum(least(image) for image in found if image is not None) > growth * weight:
            raise Unproved("the graph may multiply the weights by more than the growth")
    return EntropyRange(pieces, lower, len(states), growth)


def itinerary_graph(context: Context, reader: Reader) -> EntropyRange:
    """Rule `itinerary-graph`: {pieces, lower, images: [{phase, time}], states, weights, growth}.

    pieces and lower: steps of the rules `pieces` and `covering-graph`; the rest as in the latter.
    Conclusion: `entropy_range`.
    """
    pieces_of, lower_of, images, *graph = reader.fields(
        "pieces", "lower", "images", "states", "weights", "growth"
    )
    cut, lower = context.step(pieces_of, Pieces), context.step(lower_of, EntropyBound)
    known = read_images([piece.branch for piece in cut.monotone], images)
    return entropy_range(cut, lower, known.get, Weighted.read(*graph))


# -- the row ---------------------------------------------------------------------------------------


def _entropy(of: Parameters, found: Found) -> Decision:
    """G17: by the narrowest range."""
    del of
    ranges = sorted(found.all(EntropyRange), key=lambda x: x.entropy[1] - x.entropy[0])
    if not ranges:
        return undecided("no upper bound of the entropy is proved")
    (low, high), best = ranges[0].entropy, ranges[0]
    if high - low > _NEAR:
        return undecided(f"{best.brief}, only", best.quantities)
    return decided(Verdict.VERIFIED, best, corrected=[best], margin=_NEAR - high + low)


ROWS = (
    Row(
        "G17",
        "3.4",
        "",
        "At (eta, nu) = ({eta}, {nu}): the topological entropy of f, the supremum over compact "
        "invariant sets on which f is continuous, is known to within 0.01, from both sides.",
        _entropy,
    ),
)
