"""Chaos beyond the printed sets (section 3.4): the set near [1.32, 1.48], and the entropy of f."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.numbers import TURN, Range, ceil_text, floor_text, show, show_range
from proofs.trusted.paper import Claim, Decision, undecided
from proofs.trusted.paper.s34_circle.staying import Cell, StayingSet
from proofs.trusted.parameters import Parameters
from proofs.trusted.slopes import Impact
from proofs.trusted.verdicts import Verdict

PRINTED = (Fraction("1.32"), Fraction("1.48"))  # where section 3.4 sees another invariant set


@dataclass(frozen=True)
class Branch(Conclusion):
    """f is C^1 on [cuts[0], cuts[-1]], each first impact being transversal.

    A launch in [cuts[i], cuts[i+1]] has gap > 0 on (0, begin], gap' < 0 on [begin, ends[i]] and
    gap < 0 at ends[i]: its first impact is the one zero between. Images are counted from
    2 pi turn.
    """

    cuts: tuple[Fraction, ...]
    turn: int
    begin: Fraction
    ends: tuple[Fraction, ...]

    @property
    def phases(self) -> Range:
        """The closed interval of phases."""
        return self.cuts[0], self.cuts[-1]


@dataclass(frozen=True)
class CoveringGraph(Conclusion):
    """f has compact invariant sets on which it is continuous with entropy >= log(growth).

    By a covering graph on the branches; `entropy` encloses log(growth). states: how many.
    """

    branches: tuple[Branch, ...]
    states: int
    growth: Fraction
    entropy: Range


# -- G5 ------------------------------------------------------------------------------------------


def _another_set(of: Parameters, found: Sequence[object]) -> Decision:
    """Decide G5: is there in the printed interval a full shift on two symbols, as Lambda is one?

    The full shift has infinitely many points: where only finitely many orbits stay, it is not.
    """
    sets = [one for one in found if isinstance(one, StayingSet)]
    where = show_range(PRINTED)
    printed = next((one for one in sets if one.interval == PRINTED), None)
    if printed is None:
        return undecided(f"no proof which orbits stay in {where}")
    if printed.is_full_shift:
        return Decision(Verdict.VERIFIED, _shift_text(printed))
    if not printed.finite:
        return undecided(f"infinitely many orbits may stay in {where}")
    shifts = [one for one in sets if one.is_full_shift and one.increasing]
    points = [one for one in found if isinstance(one, Impact)]
    named = _named([printed, *shifts], points)
    theorems = [*map(_theorem, shifts), *map(_connections, shifts)]
    theorems += [_named_text(period, places) for period, places in named.items()]
    return Decision(
        Verdict.REFUTED,
        "; ".join([_few_text(printed), *map(_shift_text, shifts)]),
        witness=f"{_few_text(printed)}: no infinite invariant set lies in {where}, no Cantor set",
        corrected=" ".join([_few_theorem(of, printed), *filter(None, theorems)]),
        quantities={
            f"period_{period}_point_{i}": bounds
            for period, places in named.items()
            for i, bounds in enumerate(places, 1)
        },
    )


def _few_text(of: StayingSet) -> str:
    where = show_range(of.interval)
    if of.cycle:
        return f"the orbits that stay in {where} are one periodic orbit of period {len(of.cycle)}"
    if not of.paths:
        return f"no orbit stays in {where}"
    return f"at most {len(of.paths)} phases have orbits that stay in {where}"


def _few_theorem(of: Parameters, few: StayingSet) -> str:
    text = f"At (eta, nu) = ({show(of.eta)}, {show(of.nu)}) {_few_text(few)}"
    if not few.cycle:
        return f"{text}."
    cells = ", ".join(show_range(cell.phases) for cell in few.cycle)
    return f"{text}, with one point in each of {cells}, unstable since |f'| > 1 there."


def _shift_text(of: StayingSet) -> str:
    return f"those in {show_range(of.interval)} are a full shift on {len(of.cells)} symbols"


def _theorem(of: StayingSet) -> str:
    """State a full shift with its sets and slopes."""
    cells = ", ".join(show_range(cell.phases) for cell in of.cells)
    low, high = of.slopes
    whole = show_range(of.interval)
    return (
        f"f is C^1 with {floor_text(low, 2)} <= f' <= {ceil_text(high, 2)} on each of {cells}, "
        f"maps each of them over {whole}, and every other phase of {whole} out of it: the phases "
        f"whose orbits stay in {whole} are a Cantor set on which f is conjugate to the full shift "
        f"on {len(of.cells)} symbols, by the index of the set that f^n(phi) lies in."
    )


def brackets(cells: Sequence[Cell], points: Sequence[Impact]) -> list[Range]:
    """Return brackets of the points of the periodic orbit through cells; [] if not proved.

    Let f increase and expand on cells, [u_i, v_i] in cell i, f(u_i) <= u_(i+1), f(v_i) >= v_(i+1),
    cyclically. Then f maps each of these intervals over the next one: the periodic orbit through
    the cells, which is unique since f expands, has its points in them.
    """
    if any(cell.slopes[0] <= 1 for cell in cells):
        return []
    inside = [
        sorted((x for x in points if low <= x.phase <= high), key=lambda x: x.phase)
        for low, high in (cell.phases for cell in cells)
    ]
    for bracket in pairwise(inside[0]):
        found, following = [bracket], [*inside[1:], list(bracket)]
        for candidates in following:
            low, high = found[-1][0].image[1], found[-1][1].image
            kept = [x for x in candidates if low <= x.phase <= high[0] and high[1] < TURN]
            if len(kept) < 2:
                break
            found.append((kept[0], kept[-1]))
        if len(found) == len(cells) + 1:
            return [(u.phase, v.phase) for u, v in found[:-1]]
    return []


def _named(sets: Sequence[StayingSet], points: Sequence[Impact]) -> dict[int, list[Range]]:
    """Return the bracketed points of `StayingSet.orbits` by period."""
    named: dict[int, list[Range]] = {}
    for cells in dict.fromkeys(cells for one in sets for cells in one.orbits):
        places = named.setdefault(len(cells), [])
        places += [x for x in brackets(cells, points) if x not in places]
    return {period: sorted(places) for period, places in named.items() if places}


def _named_text(period: int, places: Sequence[Range]) -> str:
    what = "The outermost fixed points" if period == 1 else f"The points of period {period}"
    numbers = ", ".join(f"[{floor_text(u, 16)}, {ceil_text(v, 16)}]" for u, v in places)
    return f"{what} lie in {numbers}."


def _connections(of: StayingSet) -> str:
    """State what a shift on three symbols says about two on two symbols inside, if it is one.

    f increases on the cells, so the order of phases is the lexicographic order of sequences: all
    f^n(phi) <= 111... exactly if no sequence moved on begins with 2.
    """
    if len(of.cells) != 3:
        return ""
    names = ", ".join(f"{i} = {show_range(cell.phases)}" for i, cell in enumerate(of.cells))
    low, high = map(show, of.interval)
    return (
        f"With the symbols {names}: the phases with sequences over 0, 1 and those over 1, 2 are "
        "two invariant Cantor sets, each a full shift on two symbols, with the fixed point "
        "p = 111... in common; since f increases, they are the phases whose orbits stay in "
        f"[{low}, p] and those whose orbits stay in [p, {high}]. They are connected in both "
        "directions: a word over 0, 1, as long as one likes, and then a sequence over 1, 2 belong "
        "to a phase whose orbit begins near the first set and ends in the second one, and the same "
        "with the two exchanged; a sequence infinite to both sides, over 0, 1 in the past and over "
        "1, 2 in the future, to a full orbit that tends to the first set in the past and lies in "
        "the second in the future, and the same with the two exchanged."
    )


# -- G9 ------------------------------------------------------------------------------------------


def _entropy(of: Parameters, found: Sequence[object]) -> Decision:
    """Decide G9 by the best covering graph."""
    graphs = [one for one in found if isinstance(one, CoveringGraph)]
    if not graphs:
        return undecided("no covering graph is proved")
    best = max(graphs, key=lambda one: one.growth)
    size = f"{len(best.branches)} branches of f, {best.states} intervals"
    bound = f"entropy >= log {show(best.growth)} >= {floor_text(best.entropy[0])}"
    if best.growth < 2:
        return undecided(f"{bound} only, by {size}")
    return Decision(
        Verdict.VERIFIED,
        f"{bound}, by a covering graph on {size}",
        corrected=_entropy_theorem(of, best),
        quantities={"entropy": best.entropy},
    )


def _entropy_theorem(of: Parameters, graph: CoveringGraph) -> str:
    low = graph.branches[0].phases[0]
    high = graph.branches[-1].phases[1]
    turns = [branch.turn for branch in graph.branches]
    return (
        f"At (eta, nu) = ({show(of.eta)}, {show(of.nu)}) f has a compact set K in "
        f"{show_range((low, high))}, f(K) in K, on which it is continuous and has topological "
        f"entropy at least log {show(graph.growth)} >= {floor_text(graph.entropy[0])}. K lies in "
        f"{len(graph.branches)} disjoint intervals on each of which f is C^1, with flights over "
        f"{min(turns)} to {max(turns)} minima of the table."
    )


CLAIMS = (
    Claim(
        "G5",
        "At (eta, nu) = ({eta}, {nu}): [1.32, 1.48] holds another invariant set of the same kind, "
        "on which f is conjugate to the full shift on two symbols (section 3.4).",
        _another_set,
    ),
    Claim(
        "G9",
        "At (eta, nu) = ({eta}, {nu}): the topological entropy of f, the supremum over compact "
        "invariant sets on which f is continuous, is at least log 2 (section 3.1).",
        _entropy,
    ),
)
