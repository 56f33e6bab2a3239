"""Rules: branches with long flights, covering graphs, and the phases that stay in an interval."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise

from proofs.trusted.certificate import Reader
from proofs.trusted.flights import Motion, brackets, lifted
from proofs.trusted.kernel.arithmetic import Unproved, log
from proofs.trusted.kernel.context import Context
from proofs.trusted.numbers import TURN, Range
from proofs.trusted.paper.s34_circle.chaos import Branch, CoveringGraph
from proofs.trusted.paper.s34_circle.staying import StayingSet
from proofs.trusted.parameters import Parameters
from proofs.trusted.slopes import Avoids, SlopeRange
from proofs.trusted.windows import BITS, Meetings, clear, falls, leaves, level

_MOST_TURNS = 20_000
_LOG_BITS = 160


def branch(context: Context, reader: Reader) -> Branch:
    """Rule `branch`: {cuts x_0 < ... < x_n, turn K >= 1, ends e_1, ..., e_n}, for -1 < nu < 0.

    Hypotheses: on phases [x_0, x_n], gap'' > 0 on [0, t_1]; gap > 0 after t_1 in each of the
    windows of `Meetings` for the minima 0, ..., K - 1 of the table; window K starts at s > t_1.
    On [x_(i-1), x_i]: gap' < 0 on [s, e_i] and gap(e_i) < 0. Conclusion: `Branch`, begin = s.

    Proof. gap = gap' = 0 at launch, so gap > 0 on (0, t_1]. No impact lies outside the windows,
    none in the first K; and none at s, which is outside window K or its strict boundary: gap > 0
    on (0, s]. Then the gap falls to a negative value: one zero, transversal, so f is C^1 on each
    piece, and on the union since at a shared end the first impact is the same.
    """
    cuts_of, turn_of, ends_of = reader.fields("cuts", "turn", "ends")
    cuts, turn = cuts_of.numbers(2, 200), turn_of.number()
    ends = ends_of.numbers(len(cuts) - 1, len(cuts) - 1)
    if turn.denominator != 1 or not 1 <= turn <= _MOST_TURNS:
        raise turn_of.fail(f"a whole number from 1 to {_MOST_TURNS} is expected")
    if any(high <= low for low, high in pairwise(cuts)) or cuts[0] < 0 or cuts[-1] > TURN:
        raise cuts_of.fail("phases must increase, from 0 to 2 pi")
    if not -1 < context.of.nu < 0:
        raise Unproved("windows are known for -1 < nu < 0 only")
    whole = Motion(-1, context.of.eta, context.of.nu, (cuts[0], cuts[-1]), BITS)
    meetings = Meetings.of(whole)
    launched = leaves(whole)
    for low, high in meetings.before(int(turn)):
        if high > launched:
            clear(whole, (max(low, launched), high))
    begin = meetings.window(int(turn))[0]
    if begin <= launched:
        raise Unproved("the last window starts at launch")
    for phases, end in zip(pairwise(cuts), ends, strict=True):
        piece = Motion(-1, context.of.eta, context.of.nu, phases, BITS)
        if end <= begin:
            raise ends_of.fail("an end before the window")
        falls(piece, (begin, end))
        if level(piece, end)[1] >= 0:
            raise Unproved("the gap is not proved negative at an end")
    return Branch(cuts, int(turn), begin, ends)


def covering_graph(context: Context, reader: Reader) -> CoveringGraph:
    """Rule `covering-graph`: {branches, images: [{phase, time}], states, vector, growth m}.

    Hypotheses: branches Z_b, disjoint, within one turn; states D_i, closed intervals. If the ends
    of D_i and Z_b's common part X_ib have known images (see `_images`), f(X_ib) contains the
    interval between these. v >= 0 are whole numbers, not all 0; for each i the sum over b of the
    largest v_j with D_j inside that interval, 0 if there is none, is at least m v_i, m >= 1.
    Conclusion: `CoveringGraph`.

    Proof. Join i to such a j for each b: A v >= m v, so an i with v_i > 0 starts at least c m^n
    paths of length n, c > 0, to states with v_j > 0 (Collatz and Wielandt); they all go on. f is
    continuous on the union of the Z_b, and f(X_ib) contains D_j (intermediate values): each finite
    path is followed by a phase, infinite ones by compactness. The phases that follow infinite
    paths form a compact set K, f(K) in K. Two paths from i part at some step, from one state by
    different b: the phases are then in disjoint closed Z_b, a fixed distance apart. So for one
    d > 0 and all n, K has (n, d)-separated sets of c m^n points (Bowen's definition of entropy).
    """
    branches_of, images_of, states_of, vector_of, growth_of = reader.fields(
        "branches", "images", "states", "vector", "growth"
    )
    branches = _branches(context, branches_of)
    images = _images(context.of, branches, images_of)
    states = [state.range() for state in states_of.items(1, 2000)]
    vector = vector_of.numbers(len(states), len(states))
    growth = growth_of.number()
    if any(v.denominator != 1 or v < 0 for v in vector) or not any(vector):
        raise vector_of.fail("whole numbers >= 0, not all 0, are expected")
    if growth < 1:
        raise growth_of.fail("a growth below 1 proves nothing")
    best = _Targets(states, [int(v) for v in vector])
    for (low, high), value in zip(states, vector, strict=True):
        total = 0
        for one in branches:
            ends = max(low, one.phases[0]), min(high, one.phases[1])
            if ends[0] < ends[1] and ends[0] in images and ends[1] in images:
                total += best.inside(images[ends[0]], images[ends[1]])
        if total < growth * value:
            raise Unproved("the graph does not multiply the vector by the growth")
    return CoveringGraph(tuple(branches), len(states), growth, log(growth, _LOG_BITS).range)


def _branches(context: Context, reader: Reader) -> list[Branch]:
    """Read the branches, in order, disjoint, within one turn."""
    branches: list[Branch] = []
    for name in reader.items(1, 1000):
        step = context.step(name, Branch)
        if branches and step.phases[0] <= branches[-1].phases[1]:
            raise name.fail("branches must be disjoint and in order")
        branches.append(step)
    if branches[-1].phases[1] - branches[0].phases[0] >= TURN:
        raise reader.fail("the branches leave one turn")
    return branches


def _images(of: Parameters, branches: Sequence[Branch], reader: Reader) -> dict[Fraction, Range]:
    """Read brackets [s, e] of the first impact after single phases; enclose f, less 2 pi K.

    On its branch the gap has one zero, falling: gap(s) > 0 > gap(e) brackets it.
    """
    images: dict[Fraction, Range] = {}
    for entry in reader.items(1, 5000):
        phase_of, time_of = entry.fields("phase", "time")
        phase, time = phase_of.number(), time_of.range()
        one, end = _place(branches, phase, phase_of)
        if time[0] < one.begin or time[1] > end:
            raise time_of.fail("the bracket leaves the window of the first impact")
        thin = Motion(-1, of.eta, of.nu, (phase, phase), BITS)
        if not brackets(thin.gap_of, time):
            raise Unproved("a bracket does not have the signs +, - at its ends")
        images[phase] = lifted((phase + time[0], phase + time[1]), -one.turn, BITS)
    return images


def _place(branches: Sequence[Branch], phase: Fraction, reader: Reader) -> tuple[Branch, Fraction]:
    """Return the branch that a phase lies in, and the end of its impact window there."""
    for branch in branches:
        if branch.phases[0] <= phase <= branch.phases[1]:
            index = next(i for i, cut in enumerate(branch.cuts[1:]) if phase <= cut)
            return branch, branch.ends[index]
    raise reader.fail("the phase lies on no branch")


class _Targets:
    """States by their values: which is the best one inside an interval."""

    def __init__(self, states: Sequence[Range], values: Sequence[int]) -> None:
        self._best = sorted(zip(values, states, strict=True), reverse=True)
        self._found: dict[tuple[Range, Range], int] = {}

    def inside(self, one: Range, two: Range) -> int:
        """Return the largest value of a state between two enclosed images, or 0."""
        if (one, two) not in self._found:
            low, high = min(one[1], two[1]), max(one[0], two[0])
            self._found[one, two] = next(
                (value for value, state in self._best if low <= state[0] and state[1] <= high), 0
            )
        return self._found[one, two]


def staying_set(context: Context, reader: Reader) -> StayingSet:
    """Rule `staying-set`: {interval, pieces: [{slopes: a slope-range step, cuts}], gaps: avoids}.

    The theorem is `StayingSet.of`, with the gaps proved to avoid their targets.
    """
    interval_of, pieces_of, gaps_of = reader.fields("interval", "pieces", "gaps")
    pieces: list[tuple[SlopeRange, tuple[Fraction, ...]]] = []
    for entry in pieces_of.items(0, 20):
        name, cuts_of = entry.fields("slopes", "cuts")
        slopes = context.step(name, SlopeRange)
        pieces.append((slopes, cuts_of.numbers(2, 100)))
    gaps: list[tuple[Range, Range]] = []
    for name in gaps_of.items(0, 20):
        gap = context.step(name, Avoids)
        gaps.append((gap.phases, gap.target))
    try:
        return StayingSet.of(interval_of.range(), pieces, gaps)
    except ValueError as error:
        raise Unproved(str(error)) from None
