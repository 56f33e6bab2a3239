"""How much chaos is there in all? The covering graph of branches of f. Row G9."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from itertools import pairwise
from typing import NamedTuple, Self

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved, log
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.meter import METER
from proofs.trusted.numbers import (
    Phases,
    Range,
    between,
    floor_text,
    hull,
    show,
    show_range,
    within,
)
from proofs.trusted.paper.branches import Branch, read_images
from proofs.trusted.parameters import Parameters, Place
from proofs.trusted.verdicts import Decision, Found, Row, Verdict, decided, undecided

_LOG_BITS = 160


@dataclass(frozen=True)
class EntropyBound(Conclusion):
    """In the union of disjoint branches f has an invariant set with entropy >= log(growth).

    By a covering graph on so many intervals, `states`. cells: closed intervals, one in each branch,
    that f maps over them all, if that is the graph; else none.
    """

    at: Place
    branches: tuple[Branch, ...]
    states: int
    growth: Fraction
    cells: tuple[Phases, ...] = ()

    def __post_init__(self) -> None:
        if any(one.phases[1] >= two.phases[0] for one, two in pairwise(self.branches)):
            raise Unproved("branches must be disjoint and in order")
        inside = [b for x in self.cells for b, y in enumerate(self.branches) if within(x, y.phases)]
        if self.cells and not (sorted({*inside}) == inside and len(inside) == self.growth):
            raise Unproved("cells are in branches, one in each, and as many as the growth")

    @property
    def entropy(self) -> Range:
        """Enclose log(growth)."""
        return log(self.growth, _LOG_BITS).range

    @property
    def sentence(self) -> str:
        if self.cells:
            return self._shift
        domain = hull([each.phases for each in self.branches])
        times = hull([each.times for each in self.branches])
        return (
            f"f has a compact set K in {show_range(domain)}, f(K) in K, on which it is continuous "
            f"and has topological entropy at least log {show(self.growth)} >= "
            f"{floor_text(self.entropy[0])}. K lies in {len(self.branches)} disjoint intervals on "
            f"each of which f is C^1, with flights over times in {between(times, 0)}."
        )

    @property
    def _shift(self) -> str:
        named = ", ".join(f"C{i} = {show_range(cell)}" for i, cell in enumerate(self.cells))
        return (
            f"f is continuous on each of {named}, all first impacts from there being transversal, "
            "and maps each over the interval from the first to the last of them. So each sequence "
            f"of the symbols 0 to {len(self.cells) - 1} is the itinerary of a phase whose orbit "
            "stays in these sets, each periodic one that of a periodic orbit; on the compact set "
            "of all phases whose orbits stay there, f has the full shift on "
            f"{len(self.cells)} symbols as a factor, and entropy at least "
            f"{floor_text(self.entropy[0])}."
        )

    @property
    def brief(self) -> str:
        if self.cells:
            return f"f maps {len(self.cells)} sets each over them all: a full shift is a factor"
        return (
            f"entropy >= log {show(self.growth)} >= {floor_text(self.entropy[0])}, by a covering "
            f"graph on {len(self.branches)} branches of f, {self.states} intervals"
        )

    @property
    def latex(self) -> str:
        return rf"h(f|_K) \ge \log {show(self.growth)}"

    @property
    def quantities(self) -> Mapping[str, Range]:
        return {"entropy_lower_bound": self.entropy}


class Weighted(NamedTuple):
    """Intervals D_i, weights v_i >= 0, not all 0, and m = growth >= 1: by which a graph multiplies
    the weights, at least or at most.
    """

    states: Sequence[Range]
    weights: Sequence[Fraction]
    growth: Fraction

    @classmethod
    def read(cls, states: Reader, weights: Reader, growth: Reader) -> Self:
        """Read them."""
        vector, ratio = weights.numbers(1, 2000), growth.number()
        if ratio < 1 or min(vector) < 0 or not any(vector):
            raise Unproved("a growth >= 1 of weights >= 0, not all 0, is expected")
        ends = [state.range() for state in states.items(len(vector), len(vector))]
        return cls(ends, vector, ratio)


def entropy_bound(
    branches: Sequence[Branch], images: Mapping[Fraction, Range], graph: Weighted
) -> EntropyBound:
    """Theorem. Let Z_b be disjoint branches, in order, f of some of their phases lie in `images`,
    D_i, v_i and m be those of `graph`, the D_i its states. If the ends of the part X_ib that
    D_i and Z_b have in common have known images, f(X_ib) contains the interval between these. For
    each i let the sum over b of the greatest v_j with D_j in that interval, 0 if there is none, be
    at least m v_i. Then what `EntropyBound.sentence` says; with one state and as
    large an m as there are branches, of the X_1b as cells.

    Proof. 1. Join i to such a j for each b: A v >= m v, so an i with v_i > 0 starts at least
    c m^n paths of length n, c > 0, to states with v_j > 0 (Collatz and Wielandt); they all go on.
    2. f is continuous on the union of the Z_b, and f(X_ib) contains D_j (intermediate values): each
    finite path is followed by a phase, infinite ones by compactness. The phases that follow
    infinite paths form a compact set K, f(K) in K. 3. Two paths from i part at some step, from one
    state by different b: the phases are then in disjoint closed Z_b, a fixed distance apart. So for
    one d > 0 and all n, K has (n, d)-separated sets of c m^n points (Bowen's definition).
    4. With one state f maps each X_1b over it, and so over all of them: all sequences of the b are
    followed. For one that repeats after p steps, f^p maps an interval in X_1b over itself, by
    intermediate values: it has a fixed point there. As the X_1b are apart, the itinerary is a
    continuous map of the phases that stay in them onto all sequences, and turns f into the shift.
    """
    states, weights, growth = graph
    if len(places := {each.at for each in branches}) != 1:
        raise Unproved("the branches are about no oscillator, or about different ones")
    ranked = sorted(zip(weights, states, strict=True), reverse=True)

    @cache
    def best(one: Range, two: Range) -> Fraction:
        """Return the greatest weight of a state between two enclosed images."""
        METER.get().spend(2 * len(ranked))
        low, high = min(one[1], two[1]), max(one[0], two[0])
        inside = (weight for weight, state in ranked if low <= state[0] and state[1] <= high)
        return next(inside, Fraction(0))

    for (low, high), weight in zip(states, weights, strict=True):
        METER.get().spend(4 * len(branches))
        parts = [(max(low, each.phases[0]), min(high, each.phases[1])) for each in branches]
        known = [(a, b) for a, b in parts if a < b and a in images and b in images]
        if sum(best(images[a], images[b]) for a, b in known) < growth * weight:
            raise Unproved("the graph does not multiply the weights by the growth")
    is_full = len(states) == 1 and growth == len(known) > 1
    cells = tuple(Phases(*part) for part in known) if is_full else ()
    return EntropyBound(places.pop(), tuple(branches), len(states), growth, cells)


def covering_graph(context: Context, reader: Reader) -> EntropyBound:
    """Rule `covering-graph`: {branches, images: [{phase, time}], states, weights, growth}.

    time brackets the first impact after a phase, as in `Branch.image`. Conclusion: `entropy_bound`.
    """
    names, images, *graph = reader.fields("branches", "images", "states", "weights", "growth")
    branches = [context.step(name, Branch) for name in names.items(1, 1000)]
    return entropy_bound(branches, read_images(branches, images), Weighted.read(*graph))


# -- the row ---------------------------------------------------------------------------------------


def _entropy(of: Parameters, found: Found) -> Decision:
    """G9: by the greatest bound."""
    del of
    bounds = sorted(found.all(EntropyBound), key=lambda bound: bound.growth)
    if not bounds or bounds[-1].growth == 1:  # log 1 bounds nothing
        return undecided("no covering graph is proved")
    if bounds[-1].growth < 2:
        return undecided(f"{bounds[-1].brief}, only", bounds[-1].quantities)
    return decided(Verdict.VERIFIED, bounds[-1], corrected=bounds[-1:])


ROWS = (
    Row(
        "G9",
        "3.1",
        "",
        "At (eta, nu) = ({eta}, {nu}): the topological entropy of f, the supremum over compact "
        "invariant sets on which f is continuous, is at least log 2.",
        _entropy,
    ),
)
