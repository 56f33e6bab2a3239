"""How much chaos is there in all? Branches of f, and their covering graph. Row G9."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cache, cached_property
from itertools import pairwise
from typing import NamedTuple, Self

from proofs.trusted.certificate import Reader
from proofs.trusted.flights import FirstImpact, Motion, lifted
from proofs.trusted.kernel.arithmetic import Unproved, log
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.enclose import integer
from proofs.trusted.kernel.gaps import falls
from proofs.trusted.kernel.meter import METER
from proofs.trusted.numbers import (
    Phases,
    Range,
    between,
    floor_text,
    hull,
    increasing,
    show,
    show_range,
    within,
)
from proofs.trusted.parameters import Parameters, Place
from proofs.trusted.verdicts import Decision, Found, Row, Verdict, decided, undecided
from proofs.trusted.windows import BITS, DEEPEST, Meetings, clear, leaves, level

MOST_TURNS = 20_000
_HALVINGS = 12
_LOG_BITS = 160


# -- branches --------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Branch(Conclusion):
    """f is C^1 on [cuts[0], cuts[-1]], each first impact being transversal.

    A launch in [cuts[i], cuts[i+1]] has gap > 0 on (0, begin], then one zero up to ends[i], where
    gap < 0: that of its first impact. Images are counted from 2 pi turn.
    """

    at: Place
    cuts: tuple[Fraction, ...]
    turn: int
    begin: Fraction
    ends: tuple[Fraction, ...]
    _proved: set[tuple[Fraction, Range]] = field(default_factory=set, compare=False, repr=False)

    def __post_init__(self) -> None:
        if not increasing(self.cuts):
            raise Unproved("the cuts of a branch must increase")
        Phases(self.cuts[0], self.cuts[-1])
        if len(self.ends) != len(self.cuts) - 1 or not 0 < self.begin < min(self.ends):
            raise Unproved("a branch has an end after each piece's impacts, all after its begin")

    @cached_property
    def phases(self) -> Phases:
        """The closed interval of phases."""
        return Phases(self.cuts[0], self.cuts[-1])

    def motion(self, phases: Range) -> Motion:
        """Return the flights from some of the phases."""
        return Motion(self.at, phases, BITS)

    def window(self, phase: Fraction) -> Range:
        """Return the times between which the first impact after a launch at a phase comes."""
        if not within((phase, phase), self.phases):
            raise Unproved("a phase outside the branch")
        return self.begin, self.ends[max(0, bisect_left(self.cuts, phase) - 1)]

    def image(self, phase: Fraction, time: Range) -> Range:
        """Enclose phase + the time of the first impact, which is proved to be in `time`.

        On its branch the gap has one zero, falling: gap > 0 and gap < 0 at the ends bracket it.
        """
        if (phase, time) not in self._proved:
            self._require_bracket(phase, time)
            self._proved.add((phase, time))
        return phase + time[0], phase + time[1]

    def _require_bracket(self, phase: Fraction, time: Range) -> None:
        window, motion = self.window(phase), self.motion((phase, phase))
        if not within(time, window):
            raise Unproved("a bracket leaves the window of the first impact")
        signs = zip(time, window, (1, -1), strict=True)
        asked = [(end, sign) for end, known, sign in signs if end != known]
        if not any(
            all((gap_of((end, end), 0) * sign).lo > 0 for end, sign in asked)
            for gap_of in (motion.gap_of, motion.sharp_gap)
        ):
            raise Unproved("a bracket does not have the signs +, - at its ends")

    def direction(self, phases: Range, after: Fraction) -> tuple[Range, int]:
        """Return a window of the impacts after these launches, and the sign of f', the same on all.

        They come later than `after` if gap > 0 then. f' = (sin(eta t) / eta) A / gap' has one sign
        if sin(eta t) has from then on.
        """
        if not self.begin <= after < min(self.ends):
            raise Unproved("the window of the first impact begins later, or ends before")
        if after > self.begin and not self._up(phases, after, _HALVINGS):
            raise Unproved("an impact before the time given is not excluded")
        window = after, max(self.ends)
        along = self.motion(phases).clock(window).mass_sin
        if along.has_zero:
            raise Unproved("f' is not proved to have one sign on a branch")
        return window, -1 if along.lo > 0 else 1

    def _up(self, phases: Range, time: Fraction, halvings: int) -> bool:
        """Whether gap > 0 at one time after all launches in some phases, which may be halved."""
        if level(self.motion(phases), time)[0] > 0:
            return True
        middle = (phases[0] + phases[1]) / 2
        halves = (phases[0], middle), (middle, phases[1])
        return halvings > 0 and all(self._up(half, time, halvings - 1) for half in halves)

    @property
    def sentence(self) -> str:
        return (
            f"f is C^1 on {show_range(self.phases)}, the first impact being transversal, after a "
            f"time in {show_range((self.begin, max(self.ends)))}."
        )


def branch(context: Context, reader: Reader) -> Branch:
    """Rule `branch`: {flights, turn}, or {cuts x_0 < ... < x_n, turn K >= 1, ends e_1, ..., e_n}.

    flights: names of transversal first-impact steps whose phases follow one another; turn is any
    whole number. Conclusion: `Branch`, with the windows of the flights. Proof. Their first impacts
    are smooth in the phase; at a shared end they are the same.

    The second form, of long flights, is for -1 < nu < 0. Hypotheses: on phases [x_0, x_n] gap'' > 0
    on [0, t_1]; gap > 0 after t_1 in each of the windows of `Meetings` for the minima 0, ..., K - 1
    of the table; window K starts at s > t_1. On [x_(i-1), x_i]: gap' < 0 on [s, e_i] and
    gap(e_i) < 0. Conclusion: `Branch`, begin = s.

    Proof. gap = gap' = 0 at launch, so gap > 0 on (0, t_1]. No impact lies outside the windows,
    none in the first K; and none at s, which is outside window K or its strict boundary: gap > 0
    on (0, s]. Then the gap falls to a negative value: one zero, transversal, so f is C^1 on each
    piece, and on the union since at a shared end the first impact is the same.
    """
    if reader.has("flights"):
        return _joined(context, *reader.fields("flights", "turn"))
    cuts_of, turn_of, ends_of = reader.fields("cuts", "turn", "ends")
    cuts, turn = cuts_of.numbers(2, 200), integer(turn_of, 1, MOST_TURNS)
    at, phases = context.place, Phases(cuts[0], cuts[-1])
    if not -1 < at.point[1] < 0:
        raise Unproved("windows are known for -1 < nu < 0 only")
    whole = Motion(at, phases, BITS)
    meetings, launched = Meetings.of(whole), leaves(whole)
    for low, high in meetings.before(turn):
        if high > launched:
            clear(whole, (max(low, launched), high))
    begin = meetings.window(turn)[0]
    if begin <= launched:
        raise Unproved("the last window starts at launch")
    found = Branch(at, cuts, turn, begin, ends_of.numbers())
    for piece, end in zip(pairwise(cuts), found.ends, strict=True):
        if not falls(found.motion(piece).gap_of, (begin, end), DEEPEST):
            raise Unproved("the gap is not proved to fall to the impact")
        if level(found.motion(piece), end)[1] >= 0:
            raise Unproved("the gap is not proved negative at an end")
    return found


def _joined(context: Context, names: Reader, turn_of: Reader) -> Branch:
    """Join transversal first impacts to a branch."""
    flights = [context.step(name, FirstImpact) for name in names.items(1, 1000)]
    parts = [each.motion.phases for each in flights]
    if not all(each.transversal for each in flights):
        raise Unproved("a first impact is not transversal")
    if any(one[1] != two[0] for one, two in pairwise(parts)):
        raise Unproved("the parts of a branch do not follow one another")
    if len(places := {each.at for each in flights}) != 1:
        raise Unproved("the flights are about different oscillators")
    cuts, windows = (parts[0][0], *(high for _, high in parts)), [x.windows[0] for x in flights]
    ends = tuple(end for _, end in windows)
    turn = integer(turn_of, 0, MOST_TURNS)
    return Branch(places.pop(), cuts, turn, min(windows)[0], ends)


# -- the covering graph ----------------------------------------------------------------------------


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
        times = hull([(each.begin, max(each.ends)) for each in self.branches])
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


def read_images(branches: Sequence[Branch], entries: Reader) -> dict[Fraction, Range]:
    """Read phases on branches and brackets of their first impacts; enclose f there, on the line."""
    return dict(read_image(branches, entry) for entry in entries.items(1, 5000))


def read_image(branches: Sequence[Branch], entry: Reader) -> tuple[Fraction, Range]:
    """Read a phase on a branch and a bracket of its first impact; enclose f there, on the line."""
    phase_of, time_of = entry.fields("phase", "time")
    phase = phase_of.number()
    METER.get().spend(len(branches))
    on = [each for each in branches if each.cuts[0] <= phase <= each.cuts[-1]]
    if not on:
        raise phase_of.fail("the phase lies on no branch")
    return phase, lifted(on[0].image(phase, time_of.range()), -on[0].turn, BITS)


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
