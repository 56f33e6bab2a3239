"""Section 3.1, Theorems 2 to 4: the set of phases whose orbits stay in I. Claims H7 to H10.

Lambda is the set of phases of I whose orbits stay in I; f^-n(I) is read as the phases of I whose
n-th image is in I, since f maps phases outside I into it too.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import About, Conclusion
from proofs.trusted.kernel.itineraries import Itinerary
from proofs.trusted.kernel.shifts import closed_paths, log_of
from proofs.trusted.kernel.staying import StayingSet
from proofs.trusted.numbers import Phases, Range, show_range, within
from proofs.trusted.paper.s31_horseshoe import horseshoes
from proofs.trusted.paper.s32_sets.subshift import Subshift
from proofs.trusted.parameters import Parameters
from proofs.trusted.verdicts import Decision, Found, Row, Verdict, decided, undecided


@dataclass(frozen=True)
class InvariantSet(Conclusion):
    """The phases of an interval J whose orbits stay in J, by orbits of its ends in a horseshoe.

    Theorem. Let f be a horseshoe on I0 and I1 within I, and J within I. Let L be its invariant set,
    which itineraries conjugate to the full shift, and L_J = {phi : f^n(phi) in J for n >= 0}. Let
    the orbit of each end of J, unless it is one of I, follow a word w_0 ... w_(k-1) in I0 and I1
    and then be in neither; c = 0, 1, 2 as it is then below I0, between I0 and I1, or above I1. Then
    itineraries conjugate f on L_J to the subshift of the sequences of which no factor u_0 ... u_k
    comes before w_0 ... w_(k-1) c of the lower end, and each comes before that of the upper end.

    Proof. 1. L_J is in L, for it stays in I. 2. A point x of L with the itinerary u is below an end
    phi exactly if u_0 ... u_k comes before w_0 ... w_(k-1) c, in lexicographic order: if u_j is the
    first letter that differs from w_j, j < k, then f^j(x), f^j(phi) are in different sets, in that
    order, and j times the inverse of an increasing branch keeps it. If none differs, f^k(x) is in
    the set of u_k, and f^k(phi) is beside it, in the order of u_k and c. 3. So L_J = {x in L : no
    iterate is below the one end or above the other} is as stated; a restriction of the conjugacy.
    """

    base: StayingSet
    interval: Phases
    orbits: tuple[Itinerary, ...]

    at = About("base")

    def __post_init__(self) -> None:
        """Raise Unproved unless J is in I, and the orbits are those of its other ends, in order."""
        if not self.base.is_horseshoe or not within(self.interval, self.base.interval):
            raise Unproved("the horseshoe is not around the interval")
        ends = sorted(set(self.interval) - set(self.base.interval))
        if [(x.base, x.phase) for x in self.orbits] != [(self.base, end) for end in ends]:
            raise Unproved("the ends of I are not followed until they leave I0 and I1")

    @cached_property
    def shift(self) -> Subshift:
        """The sequences that are itineraries."""
        cuts = {orbit.phase: orbit.cut for orbit in self.orbits}
        low, high = self.interval
        return Subshift.between(cuts.get(low, "0"), cuts.get(high, "2"))

    @property
    def sentence(self) -> str:
        text = (
            f"let Lambda be the set of phases whose orbits stay in {show_range(self.interval)}, "
            f"{self.base.sets}. The itinerary phi -> alpha_0 alpha_1 ..., f^k(phi) in I_(alpha_k) "
            f"for k >= 0, is a homeomorphism from Lambda onto the one-sided {self.shift.named}, and"
            " conjugates f to it."
        )
        if not self.shift.arrows:
            return f"{text} There are none: Lambda is empty."
        if not self.shift.chaotic:
            return text
        counts = ", ".join(map(str, closed_paths(self.shift.arrows)))
        return (
            f"{text} This subshift is irreducible: Lambda is a Cantor set, with periodic orbits of "
            "arbitrarily high periods, uncountably many nonperiodic orbits and a dense one; f^n "
            f"has {counts} fixed points in Lambda for n = 1, ..., 8; the topological entropy of f "
            f"on Lambda is {log_of(self.shift.growth)}."
        )

    @property
    def brief(self) -> str:
        return f"the itineraries of Lambda are the {self.shift.named}"

    @property
    def quantities(self) -> Mapping[str, Range]:
        return {"growth": self.shift.growth} if self.shift.chaotic else {}


def staying(interval: Range, found: Found) -> InvariantSet:
    """Return the set that stays in an interval, by a horseshoe around it and orbits of its ends."""
    base = _around(interval, found)
    known = {orbit.phase: orbit for orbit in found.all(Itinerary) if orbit.base == base}
    ends = sorted(set(interval) - set(base.interval))
    return InvariantSet(base, Phases(*interval), tuple(known[x] for x in ends if x in known))


def _around(interval: Range, found: Found) -> StayingSet:
    for base in horseshoes(found):
        if within(interval, base.interval):
            return base
    raise Unproved("no horseshoe is proved on sets around the given interval I")


def _homeomorphism(of: Parameters, found: Found) -> Decision:
    """H7: h is a homeomorphism onto a subshift, which is all exactly if no word is forbidden."""
    known = staying(of.interval, found)
    if not within(of.gap, known.base.gap) or of.interval != (of.left[0], of.right[1]):
        return undecided("I0 and I1 do not hold all points of Lambda on their sides of the gap")
    if not known.shift.forbidden:
        return decided(Verdict.VERIFIED, known)
    return decided(Verdict.REFUTED, known, *known.orbits, corrected=[known.base, known])


def _chaotic(of: Parameters, found: Found) -> Decision:
    """H8 and H9: the subshift is irreducible; or Lambda is empty."""
    known = staying(of.interval, found)
    if not known.shift.arrows:
        return decided(Verdict.REFUTED, known)
    if not known.shift.chaotic:
        return undecided(f"the subshift is not proved irreducible: {known.brief}")
    return decided(Verdict.VERIFIED, known)


def _measure_zero(of: Parameters, found: Found) -> Decision:
    base = _around(of.interval, found)
    if not base.is_null:
        return undecided(f"{base.brief}, not above 2")
    return decided(Verdict.VERIFIED, base)


_AT = "At (eta, nu) = ({eta}, {nu}), for Lambda = {{phi in I : f^n(phi) in I for all n}}, I = {i}: "
ROWS = (
    Row(
        "H7",
        "3.1, Theorem 2",
        "is a homeomorphism",
        _AT + "the itinerary map h from Lambda to the sequences alpha_0 alpha_1 ... over 0, 1, "
        "alpha_k = 0 or 1 where f^k(phi) is in I0 = {i0} or I1 = {i1}, is a homeomorphism.",
        _homeomorphism,
    ),
    Row(
        "H8",
        "3.1, Theorem 3",
        "countably many periodic orbits of arbitrarily high periods",
        _AT + "f has in Lambda countably many periodic orbits of arbitrarily high periods, "
        "uncountably many nonperiodic orbits, and an orbit dense in Lambda.",
        _chaotic,
    ),
    Row("H9", "3.2, Theorem 4", "is a Cantor set", _AT + "Lambda is a Cantor set.", _chaotic),
    Row(
        "H10",
        "3.4",
        "this set has zero Lebesgue measure",
        _AT + "Lambda has Lebesgue measure zero.",
        _measure_zero,
    ),
)
