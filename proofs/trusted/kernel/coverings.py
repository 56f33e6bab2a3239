"""Rule: intervals that a map takes over others, with weights: how much chaos there is at least."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from itertools import pairwise
from typing import NamedTuple, Self

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import AboutMap, Subject, given, named
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.elementary import log
from proofs.trusted.kernel.laps import Lap
from proofs.trusted.kernel.meter import METER
from proofs.trusted.numbers import Range, floor_text, hull, show, show_range, within

_LOG_BITS = 160


@dataclass(frozen=True)
class EntropyBound(AboutMap):
    """In the union of disjoint branches f has an invariant set with entropy >= log(growth).

    By a covering graph on so many intervals, `states`. cells: closed intervals, one in each branch,
    that f maps over them all, if that is the graph; else none.
    """

    function: Subject
    branches: tuple[Lap, ...]
    states: int
    growth: Fraction
    cells: tuple[Range, ...] = ()

    def __post_init__(self) -> None:
        if any(one.source[1] >= two.source[0] for one, two in pairwise(self.branches)):
            raise Unproved("branches must be disjoint and in order")
        inside = [b for x in self.cells for b, y in enumerate(self.branches) if within(x, y.source)]
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
        f, domain = named(self.function), hull([each.source for each in self.branches])
        return (
            f"{given(self.function)}{f} has a compact set K in {show_range(domain)}, {f}(K) in K, "
            f"on which it is continuous and has topological entropy at least log "
            f"{show(self.growth)} >= {floor_text(self.entropy[0])}. K lies in {len(self.branches)} "
            f"disjoint intervals on each of which {f} is C^1."
        )

    @property
    def _shift(self) -> str:
        f, count = named(self.function), len(self.cells)
        cells = ", ".join(f"C{i} = {show_range(cell)}" for i, cell in enumerate(self.cells))
        point, smooth = "phase" if self.place else "point", getattr(self.function, "smooth", "")
        return (
            f"{given(self.function)}{f} is continuous on each of {cells}{smooth}, and maps each "
            "over the interval from the first to the last of them. So each sequence of the symbols "
            f"0 to {count - 1} is the itinerary of a {point} whose orbit stays in these sets, each "
            f"periodic one that of a periodic orbit; on the compact set of all {point}s whose "
            f"orbits stay there, {f} has the full shift on {count} symbols as a factor, and "
            f"entropy at least {floor_text(self.entropy[0])}."
        )

    @property
    def brief(self) -> str:
        f = named(self.function)
        if self.cells:
            return f"{f} maps {len(self.cells)} sets each over them all: a full shift is a factor"
        return (
            f"entropy >= log {show(self.growth)} >= {floor_text(self.entropy[0])}, by a covering "
            f"graph on {len(self.branches)} branches of {f}, {self.states} intervals"
        )

    @property
    def latex(self) -> str:
        return "" if self.place is None else rf"h(f|_K) \ge \log {show(self.growth)}"

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
    branches: Sequence[Lap], images: Mapping[Fraction, Range], graph: Weighted
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
    function = branches[0].subject
    if any(each.subject != function for each in branches):
        raise Unproved("the branches are those of different maps")
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
        parts = [(max(low, each.source[0]), min(high, each.source[1])) for each in branches]
        known = [(a, b) for a, b in parts if a < b and a in images and b in images]
        if sum(best(images[a], images[b]) for a, b in known) < growth * weight:
            raise Unproved("the graph does not multiply the weights by the growth")
    is_full = len(states) == 1 and growth == len(known) > 1
    cells = tuple(known) if is_full else ()
    return EntropyBound(function, tuple(branches), len(states), growth, cells)


def covering_graph(context: Context, reader: Reader) -> EntropyBound:
    """Rule `covering-graph`: {branches, images: [{phase, ...}], states, weights, growth}.

    branches: steps `slopes` of a map of the line, or `branch`; images: of points of these, see
    `read_images`, or with the time of the first impact, as in `Branch.image`. Conclusion:
    `entropy_bound`.
    """
    names, images, *graph = reader.fields("branches", "images", "states", "weights", "growth")
    branches = [context.step(name, Lap) for name in names.items(1, 1000)]
    return entropy_bound(branches, read_images(branches, images), Weighted.read(*graph))


def read_images(branches: Sequence[Lap], entries: Reader) -> dict[Fraction, Range]:
    """Read points of branches, and what their images are proved by; enclose these, on the line."""
    return dict(read_image(branches, entry) for entry in entries.items(1, 5000))


def read_image(branches: Sequence[Lap], entry: Reader) -> tuple[Fraction, Range]:
    """Read a point of a branch, its field `phase`, and enclose its image."""
    phase_of = dict(entry.entries()).get("phase")
    if phase_of is None:
        raise entry.fail("a point, `phase`, is expected")
    phase = phase_of.number()
    METER.get().spend(len(branches))
    on = [each for each in branches if within((phase, phase), each.source)]
    if not on:
        raise phase_of.fail("the phase lies on no branch")
    return phase, on[0].read_image(phase, entry)
