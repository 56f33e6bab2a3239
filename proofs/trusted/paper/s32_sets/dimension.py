"""Section 3.2, Claim 1 read for the map itself: the dimension of the set that stays in I. H13."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass

from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import About, Conclusion
from proofs.trusted.kernel.moran import MoranRoot
from proofs.trusted.numbers import Phases, ceil_text, decimals, floor_text, hull, show_range, within
from proofs.trusted.paper.s32_sets.invariant import InvariantSet, staying
from proofs.trusted.paper.s32_sets.moran import NoGap
from proofs.trusted.paper.s32_sets.repeller import Repeller
from proofs.trusted.parameters import Parameters
from proofs.trusted.verdicts import Decision, Found, Row, Verdict, decided, undecided

FULL = ("0", "1")
WITHOUT_000 = ("1", "01", "001")
_FACTORS = {FULL: "", WITHOUT_000: "000"}  # sequences of the words are those without the factor


@dataclass(frozen=True)
class StayingDimension(Conclusion):
    """The set K of a repeller is the set Lambda of the phases whose orbits stay in its hull I.

    Theorem. This is so if the domains begin and end with I and hold all of I0 and I1 in I, for a
    horseshoe around I, and if the itineraries of Lambda are the sequences of the words.

    Proof. A point x of Lambda is in the domains with all its images, since it is in I0 or I1. So
    x = g_w(y), w the word that its itinerary begins with, y a later image of x, in Lambda as well;
    and so on, so that x is in K. Conversely the images of K are in the domains, which are in I.
    """

    repeller: Repeller
    staying: InvariantSet

    def __post_init__(self) -> None:
        """Raise Unproved unless the hypotheses are proved, of one oscillator."""
        base = self.staying.base
        if len(self.repeller.domains) != 2:
            raise Unproved("the repeller has not two domains")
        (low, start), (end, high) = self.repeller.domains
        if not (low, high) == self.interval == self.repeller.hull or self.at != base.at:
            raise Unproved("the domains and the invariant set do not begin and end with the hull")
        if not within((start, end), base.gap):
            raise Unproved("the domains do not hold all of I0 and I1 in I")
        if _FACTORS.get(self.repeller.words) != self.staying.shift.factors:
            raise Unproved("the set that stays in I is not proved to have these words")

    at = About("repeller")

    @property
    def interval(self) -> Phases:
        """I."""
        return self.staying.interval

    @property
    def bounds(self) -> tuple[str, str]:
        """The bounds of the dimension, to two places more than they decide."""
        return decimals(self.repeller.dimension)

    @property
    def sentence(self) -> str:
        (flat, steep), (low, high) = hull(self.repeller.slopes), self.bounds
        slopes = "sizes of the slopes" if self.repeller.falls else "slopes"
        return (
            f"{self.staying.sentence} The {slopes} of f along the words "
            f"{', '.join(self.repeller.words)} are between {floor_text(flat, 2)} and "
            f"{ceil_text(steep, 2)}, and the Hausdorff dimension of Lambda lies between {low} and "
            f"{high}."
        )

    @property
    def brief(self) -> str:
        low, high = self.bounds
        return f"{low} <= dim <= {high} for I = {show_range(self.interval)}"

    @property
    def latex(self) -> str:
        low, high = self.bounds
        return rf"{low} \le \dim \Lambda \le {high}"


def _dimension(of: Parameters, found: Found) -> Decision:
    """H13: by the set of I itself, or by a larger one, whose dimension is not smaller.

    Claim 1 is proved for lines (H12); the paper's conclusions say it of the set of f itself.
    """
    ratios = of.moran_ratios
    if max(ratios) >= 1:
        return decided(Verdict.REFUTED, NoGap(ratios))
    around = []
    for each in found.all(Repeller):
        with suppress(Unproved):
            if within(of.interval, each.hull):
                around.append(StayingDimension(each, staying(each.hull, found)))
    root = next((each for each in found.all(MoranRoot) if each.ratios == ratios), None)
    if root is None or not around:
        return undecided("no bracket of s_0, or no horseshoe around I with dimension")
    best = next((each for each in around if each.interval == of.interval), around[0])
    low, high = best.repeller.dimension
    known = {"dimension": around[0].repeller.dimension, "s0": root.root}
    known |= {} if best is around[0] else {"dimension_of_I": (low, high)}
    if high < root.root[0] or (best.interval == of.interval and root.root[1] < low):
        return decided(Verdict.REFUTED, best, root, corrected=around, known=known)
    return undecided(f"{best.brief}, and {root.brief}", known=known)


ROWS = (
    Row(
        "H13",
        "3.2, Claim 1, and 8",
        "We proved that Lambda is a Cantor set and computed its Hausdorff dimension",
        "At (eta, nu) = ({eta}, {nu}): the phases whose images by f all stay in I = {i} form a set "
        "of Hausdorff dimension s_0, where {r0}^s_0 + {r1}^s_0 = 1.",
        _dimension,
    ),
)
