"""Horseshoes at any parameters: cells, and which f maps over which. Row X2."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved, log
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.meter import METER
from proofs.trusted.numbers import Phases, Range, between, floor_text, show_range
from proofs.trusted.paper.beyond.attractors import AtRest, first_proved
from proofs.trusted.paper.s31_horseshoe import read_part
from proofs.trusted.paper.s32_sets.subshift import irreducible, spectral_radius
from proofs.trusted.paper.s34_circle.entropy import EntropyBound
from proofs.trusted.paper.s34_circle.other_sets import apart
from proofs.trusted.parameters import Parameters, Place
from proofs.trusted.slopes import ImageArc, SlopeRange, image_arc
from proofs.trusted.verdicts import Decision, Found, Row, Verdict, decided, undecided

_MOST_CELLS = 100
_PERIODS = 8
_LOG_BITS = 128


@dataclass(frozen=True)
class MarkovSet(Conclusion):
    """The phases whose orbits stay in disjoint cells, f expanding each over some of them.

    onward[i]: the cells that f maps cell i over; it misses the others. slopes: bounds on |f'|.
    """

    at: Place
    cells: tuple[Phases, ...]
    slopes: Range
    onward: tuple[tuple[int, ...], ...]

    def __post_init__(self) -> None:
        """Raise Unproved unless the cells are in order and apart, and the graph is chaotic."""
        count = len(self.cells)
        if count < 2 or not apart(self.cells) or self.slopes[0] <= 1:
            raise Unproved("two cells or more, apart and in order, on which f expands")
        known = all(set(after) <= set(range(count)) for after in self.onward)
        if len(self.onward) != count or not known or not irreducible(self._arrows):
            raise Unproved("the graph of the cells is not irreducible")
        if all(len(after) == 1 for after in self.onward):
            raise Unproved("the cells are those of one periodic orbit")

    @property
    def _arrows(self) -> Mapping[int, Sequence[int]]:
        return dict(enumerate(self.onward))

    @property
    def full(self) -> bool:
        """Whether each cell is mapped over all."""
        return all(len(after) == len(self.cells) for after in self.onward)

    @cached_property
    def growth(self) -> Range:
        """Bounds on the number whose log is the entropy."""
        return spectral_radius(self._arrows)

    @property
    def fixed_points(self) -> list[int]:
        """How many phases f^n fixes there, n = 1, 2, ...: the closed paths of n steps."""
        rows = [[int(i == j) for j in self._arrows] for i in self._arrows]
        traces = []
        for _ in range(_PERIODS):
            rows = [[sum(row[k] for k in self._sources[j]) for j in self._arrows] for row in rows]
            traces.append(sum(row[i] for i, row in enumerate(rows)))
        return traces

    @cached_property
    def _sources(self) -> list[list[int]]:
        return [[i for i, after in self._arrows.items() if j in after] for j in self._arrows]

    @property
    def sentence(self) -> str:
        named = ", ".join(f"C{i} = {show_range(cell)}" for i, cell in enumerate(self.cells))
        arrows = ", ".join(f"{i} by {', '.join(map(str, x))}" for i, x in self._arrows.items())
        steps = f"full shift on {len(self.cells)} symbols"
        if not self.full:
            steps = f"subshift of the sequences in which each symbol is followed so: {arrows}"
        return (
            f"f is continuously differentiable and monotone on each of {named}, with |f'| >= "
            f"{floor_text(self.slopes[0], 3)}. The phases whose orbits stay in these sets are a "
            "Cantor set, on which f is topologically conjugate to the one-sided "
            f"{steps}, the n-th symbol being the number of the set that holds f^n(phi). f^n has "
            f"{', '.join(map(str, self.fixed_points))} fixed points there for n = 1, ..., "
            f"{_PERIODS}; there are periodic orbits of arbitrarily high periods, uncountably many "
            "nonperiodic ones and a dense one; the entropy of f there is the log of a number in "
            f"{between(self.growth)}."
        )

    @property
    def brief(self) -> str:
        kind = "full shift on" if self.full else "subshift on"
        return f"a {kind} {len(self.cells)} symbols, |f'| >= {floor_text(self.slopes[0], 3)}"

    @property
    def quantities(self) -> Mapping[str, Range]:
        low, high = (log(end, _LOG_BITS).range for end in self.growth)
        return {"growth": self.growth, "entropy": (low[0], high[1])}


def contains(arc: ImageArc, cell: Phases) -> bool:
    """Whether an image, which may pass phase 0, is proved to contain a cell."""
    beyond = arc.low[1] <= cell[0] or cell[1] <= arc.high[0]
    return beyond if arc.passes_zero else arc.covers(cell)


def misses(arc: ImageArc, cell: Phases) -> bool:
    """Whether an image, which may pass phase 0, is proved to miss a cell."""
    between_ends = arc.high[1] < cell[0] and cell[1] < arc.low[0]
    return between_ends if arc.passes_zero else arc.misses(cell)


def markov_set(parts: Sequence[SlopeRange]) -> MarkovSet:
    """Theorem. Let f be C^1 on disjoint closed intervals C_0, C_1, ... of phases, |f'| > 1, and map
    each onto an arc that contains or misses each of them; let the graph of "contains" lead from
    every cell to every cell, and more than one way from some. Then what `MarkovSet.sentence` says.

    Proof. 1. f is monotone on C_i and its image is shorter than the circle: f is one-to-one there,
    and the phases of C_i that are sent into an interval of phases inside the arc are an interval.
    2. So for a path i_0, ..., i_n the phases phi with f^k(phi) in C_(i_k), k <= n, are a closed
    interval, that f maps onto that of i_1, ..., i_n, and at most max |C| / mu^n long, mu = min |f'|
    > 1; for what is no path there are none. 3. Nested, these shrink to one phase for each infinite
    path: itineraries are a bijection to the paths. The cells are apart and f is continuous on them,
    so it is continuous; paths are compact: it is a homeomorphism, and turns f into the shift.
    4. The shift on the paths of such a graph is as said, see `Subshift.chaotic`; its entropy is the
    log of the spectral radius (Lind and Marcus 1995, theorem 4.3.1), and closed paths are its
    periodic points.
    """
    parts = sorted(parts, key=lambda part: part.domain)
    if len({part.at for part in parts}) != 1 or not all(part.expands for part in parts):
        raise Unproved("f is not proved to expand on all cells")
    METER.get().spend(len(parts) ** 3)
    onward = []
    for part in parts:
        arc = image_arc(part)
        covered = [contains(arc, other.domain) for other in parts]
        missed = [misses(arc, other.domain) for other in parts]
        if not all(a or b for a, b in zip(covered, missed, strict=True)):
            raise Unproved("an image is proved neither to contain a cell nor to miss it")
        onward.append(tuple(j for j, each in enumerate(covered) if each))
    ends = [end for x in parts for end in (x.minimum[0], x.maximum[1])]
    sizes = [abs(end) for end in ends]
    cells = tuple(part.domain for part in parts)
    return MarkovSet(parts[0].at, cells, (min(sizes), max(sizes)), tuple(onward))


def prove_markov_set(context: Context, reader: Reader) -> MarkovSet:
    """Rule `markov-set`: {cells: [{slopes: a slope-range step, domain: two of its points}]}.

    Conclusion: `markov_set`.
    """
    (cells_of,) = reader.fields("cells")
    return markov_set([read_part(context, cell) for cell in cells_of.items(2, _MOST_CELLS)])


def _chaotic(of: Parameters, found: Found) -> Decision:
    graphs = [each for each in found.all(EntropyBound) if each.growth > 1]
    for known in (*found.all(MarkovSet), *graphs):
        return decided(Verdict.VERIFIED, known)
    none = first_proved(of.place, AtRest)
    return undecided("no horseshoe is proved") if none is None else decided(Verdict.REFUTED, none)


ROWS = (
    Row(
        "X2",
        "beyond",
        "",
        "At (eta, nu) = ({eta}, {nu}), for plastic impacts: f has a compact invariant set on which "
        "it is continuous and its topological entropy is positive.",
        _chaotic,
    ),
)
