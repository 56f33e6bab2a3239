"""Section 3.4: how thin the full shifts are, and how fast orbits leave them. Row G19, our own."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from itertools import product

from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import About, Conclusion
from proofs.trusted.kernel.staying import StayingSet
from proofs.trusted.numbers import Range, decimals, show_range, within
from proofs.trusted.paper.s32_sets.repeller import Repeller
from proofs.trusted.paper.s34_circle.other_sets import PRINTED
from proofs.trusted.parameters import Parameters
from proofs.trusted.verdicts import Decision, Found, Row, Verdict, decided, undecided

_SYMBOLS = (2, 3)


@dataclass(frozen=True)
class ThinShift(Conclusion):
    """A full shift in I, the set K of a repeller that is the same, and how fast orbits leave I.

    Theorem. Let hull and letters of the two repellers be I and the cells, their domains in the
    cells, each word one letter; let the exponent of `escape` be 1. Then the phases whose orbits
    stay in I are K, and there is a c > 0 such that for all n the phases of I whose first n images
    lie in I have a total length between c low^n and high^n / c, low and high being its growth.

    Proof. 1. If x and f(x) are in I, x is in a cell, on which f is one-to-one, and x = g_j(f(x)),
    which lies in that cell and is mapped to f(x) too. Conversely f maps g_j(y) to y. So phases with
    n images in I are those of the disjoint intervals g_W(I), W the words of n letters, and those
    that stay are K. 2. The length of g_W(I) is the integral of |g_W'| over I; the sum over W is
    that of L^n 1, L h = the sum of |g_j'| h(g_j). With low h <= L h <= high h, L^n 1 is between
    low^n h / max h and high^n h / min h.
    """

    shift: StayingSet
    repeller: Repeller
    escape: Repeller

    def __post_init__(self) -> None:
        """Raise Unproved unless the hypotheses are proved, of one oscillator."""
        cells = self.shift.cells
        if not self.shift.whole:
            raise Unproved("no full shift on an interval")
        for each in (self.repeller, self.escape):
            if each.at != self.at or each.hull != self.shift.interval:
                raise Unproved("the full shift and the repellers are about different sets")
            if each.words != tuple(map(str, range(len(cells)))) or len(each.domains) != len(cells):
                raise Unproved("the words are not the numbers of the cells")
            if not all(map(within, each.domains, cells)):
                raise Unproved("a domain leaves its cell")
        if self.escape.exponent != 1:
            raise Unproved("the growth is not that of lengths")
        if self.repeller.dimension[1] >= 1 or self.escape.growth[1] >= 1:
            raise Unproved("the set is not proved thin")

    at = About("shift")

    @property
    def rate(self) -> Range:
        """Bounds of the escape rate."""
        return self.escape.rate

    @property
    def sentence(self) -> str:
        (low, high), whole = decimals(self.repeller.dimension), show_range(self.shift.interval)
        first, last = decimals(self.escape.growth)
        slow, fast = decimals(self.rate)
        return (
            f"{self.shift.sentence} The Hausdorff dimension of the set of those that stay in "
            f"{whole} lies between {low} and {high}. For some c > 0 and all n, the phases of "
            f"{whole} whose first n images by f lie in {whole} have a total length between "
            f"c {first}^n and {last}^n / c: orbits escape at a rate between {slow} and {fast}."
        )

    @property
    def brief(self) -> str:
        (low, high), (slow, fast) = decimals(self.repeller.dimension), decimals(self.rate)
        return (
            f"{low} <= dim <= {high} and {slow} <= escape rate <= {fast} for "
            f"I = {show_range(self.shift.interval)}"
        )

    @property
    def quantities(self) -> Mapping[str, Range]:
        symbols = len(self.shift.cells)
        return {
            f"dimension_{symbols}_symbols": self.repeller.dimension,
            f"eigenvalue_{symbols}_symbols": self.escape.growth,
            f"escape_rate_{symbols}_symbols": self.rate,
        }


def _thin(of: Parameters, found: Found) -> Decision:
    """G19: both full shifts, with the dimension and the rate of escape of each."""
    known: dict[int, ThinShift] = {}
    repellers = sorted(found.all(Repeller), key=lambda x: x.dimension[1] - x.dimension[0])
    shifts = [each for each in found.all(StayingSet) if each.whole]
    for shift, one, other in product(shifts, repellers, repellers):
        with suppress(Unproved):
            if within(PRINTED, shift.interval):
                known.setdefault(len(shift.cells), ThinShift(shift, one, other))
    missing = [symbols for symbols in _SYMBOLS if symbols not in known]
    if missing:
        return undecided(f"no dimension and rate of a full shift on {missing[0]} symbols")
    return decided(Verdict.VERIFIED, *(known[symbols] for symbols in _SYMBOLS))


ROWS = (
    Row(
        "G19",
        "3.4",
        "",
        "At (eta, nu) = ({eta}, {nu}): around [1.32, 1.48] there are two intervals in which the "
        "phases whose orbits stay are Cantor sets, full shifts on two and on three symbols, of "
        "Hausdorff dimensions between 0 and 1, from which orbits escape at positive rates.",
        _thin,
    ),
)
