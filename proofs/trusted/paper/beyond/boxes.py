"""For all oscillators of a box of (eta, nu): full shifts by covering; where nothing is chaotic."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import NamedTuple

from proofs.trusted.certificate import Reader
from proofs.trusted.flights import FirstImpact, excess
from proofs.trusted.kernel.arithmetic import Unproved, log
from proofs.trusted.kernel.conclusion import About, Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.enclose import integer
from proofs.trusted.numbers import Phases, Range, between, floor_text, show_range
from proofs.trusted.paper.beyond.attractors import AtRest
from proofs.trusted.paper.s34_circle.landing import Separation
from proofs.trusted.paper.staying import apart
from proofs.trusted.parameters import Place

MOST_CELLS = 50
_MOST_FLIGHTS = 1000
_MOST_TURNS = 10**6
_BITS = 128
_HALF_TURN = 3  # less than pi


# -- full shifts, by covering ----------------------------------------------------------------------


class Sheet(NamedTuple):
    """A cell of phases in parts, the first impacts of each, and the turns that images are less."""

    flights: tuple[FirstImpact, ...]
    turns: int

    @property
    def cell(self) -> Phases:
        """The phases."""
        return Phases(self.flights[0].motion.phases[0], self.flights[-1].motion.phases[1])

    def sides(self, target: Range) -> set[int]:
        """Return on which sides of the target, -1 and 1, the images of the two ends are."""
        found = set()
        for step, phase in zip((self.flights[0], self.flights[-1]), self.cell, strict=True):
            for sign, end in zip((-1, 1), target, strict=True):
                if excess(step, phase, (end, end), self.turns, step.motion.bits) == sign:
                    found.add(sign)
                    break
            else:
                raise Unproved("the image of a cell's end is not proved to be beyond the cells")
        return found


@dataclass(frozen=True)
class CoveringShift(Conclusion):
    """f is continuous on disjoint cells of phases and maps each over the interval of them all."""

    at: Place
    cells: tuple[Phases, ...]

    def __post_init__(self) -> None:
        if len(self.cells) < 2 or not apart(self.cells):
            raise Unproved("two cells or more, apart and in order")

    @property
    def entropy(self) -> Range:
        """Enclose the log of the number of cells."""
        return log(Fraction(len(self.cells)), _BITS).range

    @property
    def sentence(self) -> str:
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
        return f"f maps {len(self.cells)} sets each over them all: a full shift is a factor"

    @property
    def quantities(self) -> Mapping[str, Range]:
        return {"entropy_lower_bound": self.entropy}


def covering_shift(sheets: Sequence[Sheet]) -> CoveringShift:
    """Theorem. Let the first impact from each phase of disjoint closed intervals C_0, ..., C_(n-1)
    be transversal, n >= 2, and let F_i = phi + t - 2 pi k_i send one end of each C_i below all
    of them, the other end beyond all. Then what `CoveringShift.sentence` says.

    Proof. 1. The time t of a transversal first impact depends continuously on the phase, where
    parts of C_i meet it is the same: F_i is continuous on C_i, and f is F_i mod 2 pi. 2. Let J be
    the interval from the first to the last C_i. By intermediate values F_i(C_i) contains J. So the
    phases that follow a finite word i_0, ..., i_m are a nonempty compact set, since in C_(i_0)
    there is an interval that F_(i_0) maps onto one in C_(i_1), and so on; infinite words are
    followed by compactness. For a word that repeats, f^p maps such an interval over itself: it has
    a fixed point. 3. K, all phases whose orbits stay in the C_i, is compact, f(K) in K, f is
    continuous there; as the C_i are apart, the itinerary is a continuous map of K onto all
    sequences, and turns f into the shift: the entropy of f is that of the shift at least.
    """
    places = {step.at for sheet in sheets for step in sheet.flights}
    if len(places) != 1:
        raise Unproved("the hypotheses are about different oscillators")
    for sheet in sheets:
        if not all(step.transversal for step in sheet.flights):
            raise Unproved("a first impact is not transversal")
        parts = [step.motion.phases for step in sheet.flights]
        if any(one[1] != two[0] for one, two in pairwise(parts)):
            raise Unproved("the parts of a cell do not follow one another")
    sheets = sorted(sheets, key=lambda sheet: sheet.cell)
    found = CoveringShift(places.pop(), tuple(sheet.cell for sheet in sheets))
    target = found.cells[0][0], found.cells[-1][1]
    if any(sheet.sides(target) != {-1, 1} for sheet in sheets):
        raise Unproved("both ends of a cell are sent to the same side of the cells")
    return found


def prove_covering_shift(context: Context, reader: Reader) -> CoveringShift:
    """Rule `covering-shift`: {cells: [{flights: names of first-impact steps, turns}]}.

    The phases of a cell's flights follow one another; turns is a whole number, k_i. Conclusion:
    `covering_shift`.
    """
    (cells_of,) = reader.fields("cells")
    sheets = []
    for entry in cells_of.items(2, MOST_CELLS):
        flights_of, turns_of = entry.fields("flights", "turns")
        flights = tuple(context.step(x, FirstImpact) for x in flights_of.items(1, _MOST_FLIGHTS))
        sheets.append(Sheet(flights, integer(turns_of, 0, _MOST_TURNS)))
    return covering_shift(sheets)


# -- where no motion is chaotic --------------------------------------------------------------------


@dataclass(frozen=True)
class AllStick(Conclusion):
    """Theorem. Let eta <= 3/7, and let the flight after the separation end in the sticking arc
    within one turn. Then what the sentence says.

    Proof. Let the arc be (a, s), s = phi_s, A the launch acceleration, < 0 on the arc and > 0 from
    s to a + 2 pi. By `lands` gap is the integral of sin(eta (t - u)) / eta A(phi + u), 0 < u < t,
    eta t < pi here. 1. The flight from s has its first impact on the arc, where A < 0: from there,
    with the gap falling from 0, the same formula gives gap < 0 until phase s + 2 pi. 2. That at
    phase s + 2 pi decreases in the launch phase, where A > 0: it is < 0 after all launches
    between s and a + 2 pi, and there is no impact before phase a + 2 pi. So the first impact is on
    the arc. 3. What sticks leaves at s: f maps all phases to the arc, and that to one phase.
    """

    arc: Separation

    def __post_init__(self) -> None:
        if not self.arc.returns or self.arc.turns != 1 or 7 * self.at.eta[1] > _HALF_TURN:
            raise Unproved("the flight from the separation is not proved to end soon on the arc")

    at = About("arc")

    @property
    def sentence(self) -> str:
        return (
            "every mass that does not stick after an impact sticks after its next one, and one "
            "that sticks leaves the table at a phase in "
            f"{between(self.arc.phase)} and has its next impact where it sticks, at a phase in "
            f"{between(self.arc.arrival)}: one periodic motion attracts all, exactly from the "
            "second impact on, f(f(phi)) is constant, and f has no horseshoe."
        )


def prove_settles(context: Context, reader: Reader) -> AtRest | AllStick:
    """Rule `settles`: {separation: name of a step, or null}.

    Conclusion: `AllStick`; `AtRest` where there is no separation.
    """
    (name,) = reader.fields("separation")
    return AtRest(context.place) if name.is_null() else AllStick(context.step(name, Separation))
