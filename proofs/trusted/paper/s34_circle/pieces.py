"""The circle cut where f jumps: pieces on which f is monotone, from one graze to the next."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import pairwise

from proofs.trusted.certificate import Reader
from proofs.trusted.flights import lifted
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import About, Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.numbers import TURN, Phases, Range, ceil_text, floor_text, show_range
from proofs.trusted.paper.branches import Branch
from proofs.trusted.paper.s34_circle.grazing import Grazing
from proofs.trusted.paper.s34_circle.landing import Lands, NeverImpacts, Separation
from proofs.trusted.windows import BITS

Known = Callable[[Fraction], Range | None]  # enclosures of f at phases on branches


@dataclass(frozen=True)
class Piece:
    """A branch, and the phases between it and the grazes on both sides: f is monotone there."""

    branch: Branch
    left: Grazing | None
    right: Grazing | None

    @property
    def phases(self) -> Range:
        """An interval that contains the piece."""
        low = self.branch.cuts[0] if self.left is None else self.left.phases[0]
        return low, self.branch.cuts[-1] if self.right is None else self.right.phases[1]

    def image(self, state: Range, known: Known) -> Range | None:
        """Enclose f on the part of a state in the piece; None where there is no such part.

        It lies between the images of the part's ends, or f's limits at the grazes beyond them.
        """
        (first, last), (low, high) = self.branch.phases, self.phases
        if state[1] < low or high < state[0]:
            return None
        low, high = max(state[0], low), min(state[1], high)
        one = _limit(self.left, above=True) if low < first else known(min(low, last))
        two = _limit(self.right, above=False) if last < high else known(max(first, high))
        if one is None or two is None:
            raise Unproved("an end of a state has no known image")
        return min(one[0], two[0]), max(one[1], two[1])


def _limit(grazing: Grazing | None, *, above: bool) -> Range | None:
    """Enclose f's limit at a graze, from one side."""
    if grazing is None:
        return None
    return grazing.other if grazing.below is above else grazing.graze


@dataclass(frozen=True)
class Pieces(Conclusion):
    """Theorem. Let the circle consist of the arc where the mass sticks, to which the flight from it
    returns, of phases that land there at once, and between these of branches with f' > 0 or f' < 0
    and one interval of phases that never impact, all with an interval with one graze after each.
    Then what the sentence says.

    Proof. Neighbours have a phase in common, and f is C^1 on both with f' of one sign, up to the
    graze: so f is C^1 and monotone from one graze to the next. The first impact after the others
    is where the mass sticks, and so are all later ones.
    """

    arc: Separation
    lands: tuple[Lands, Lands]
    arcs: tuple[Branch | Grazing | NeverImpacts, ...]

    def __post_init__(self) -> None:
        (first, _), (_, last) = (each.phases for each in self.lands)
        if first > lifted(self.arc.phase, -1, BITS)[0] or last < self.arc.start[1]:
            raise Unproved("the phases that land on the arc do not adjoin it")
        if not self.arc.returns:
            raise Unproved("the flight from the arc does not return to it")
        if {each.place for each in (*self.lands, *self.arcs)} != {self.arc.at}:
            raise Unproved("the hypotheses are about different oscillators")
        known = [each.phases for each in self.arcs]
        if not known or known[0][0] > self.region[0] or known[-1][1] < self.region[1]:
            raise Unproved("the parts do not reach the phases that land on the arc")
        if any(not (a < c <= b < d) for (a, b), (c, d) in pairwise(known)):
            raise Unproved("the parts are not in order, or do not adjoin")
        grazes = [isinstance(each, Grazing) for each in self.arcs]
        if any(grazes[::2]) or not all(grazes[1::2]) or grazes[-1]:
            raise Unproved("parts without and with a graze do not take turns")
        if sum(isinstance(each, NeverImpacts) for each in self.arcs) != 1:
            raise Unproved("one part without impacts is expected")
        for before, grazing, after in zip(self.arcs, self.arcs[1:], self.arcs[2:], strict=False):
            if isinstance(grazing, Grazing):
                sides = (before, after) if grazing.below else (after, before)
                for part, turn in zip(sides, (grazing.turn, grazing.beyond), strict=True):
                    if isinstance(part, Branch) and part.turn != turn:
                        raise Unproved("images beside a graze are counted from different turns")

    at = About("arc")

    @property
    def region(self) -> Phases:
        """All phases between those that land on the arc, and a few more, so that it is short."""
        low, high = self.lands[0].phases[1], self.lands[1].phases[0]
        return Phases(Fraction(floor_text(low)), Fraction(ceil_text(high)))

    def unwrapped(self, image: Range) -> Range:
        """Return what holds an image on the line, if it meets no multiple of 2 pi added to J."""
        low, high = self.region
        if not high - TURN < image[0] <= image[1] < low + TURN:
            raise Unproved("an image may be longer than the circle")
        return image

    @cached_property
    def monotone(self) -> list[Piece]:
        """The pieces with impacts, in order."""
        ends = [None, *self.arcs[1::2], None]
        return [
            Piece(x, *(y if isinstance(y, Grazing) else None for y in ends[i : i + 2]))
            for i, x in enumerate(self.arcs[::2])
            if isinstance(x, Branch)
        ]

    @property
    def sentence(self) -> str:
        return (
            f"outside J = {show_range(self.region)}, mod 2 pi, the mass sticks at once or at the "
            f"next impact, and so ever after. J consists of {len(self.monotone)} intervals, on "
            "each of which f is C^1 and monotone with f' not 0, and of one of phases without any "
            f"impact, if no touch counts; they end at {len(self.arcs) // 2} grazing phases."
        )


def pieces(context: Context, reader: Reader) -> Pieces:
    """Rule `pieces`: {separation, lands [two], branches [{branch, after}], grazings, never [one]},
    names of steps; after: see `Branch.direction`. Conclusion: `Pieces`.
    """
    arc_of, lands_of, branches_of, grazings_of, never_of = reader.fields(
        "separation", "lands", "branches", "grazings", "never"
    )
    parts: list[Branch | Grazing | NeverImpacts] = [
        *(_monotone(context, entry) for entry in branches_of.items(1, 1000)),
        *(context.step(name, Grazing) for name in grazings_of.items(0, 1000)),
        *(context.step(name, NeverImpacts) for name in never_of.items(1, 1)),
    ]
    first, last = (context.step(name, Lands) for name in lands_of.items(2, 2))
    parts.sort(key=lambda each: each.phases)
    return Pieces(context.step(arc_of, Separation), (first, last), tuple(parts))


def _monotone(context: Context, entry: Reader) -> Branch:
    """Read a branch on which f' is proved to have one sign."""
    name, after = entry.fields("branch", "after")
    branch = context.step(name, Branch)
    branch.direction(branch.phases, after.number())
    return branch
