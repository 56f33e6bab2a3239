"""Section 3.4 with restitution: where the stable motion of claim G7 ends. Claim G15 of our own.

The bounces that follow the flight from phi_s end in rest before phi_s as long as epsilon is small;
as it grows, the phase at which they end moves to phi_s. Beyond, the mass passes phi_s in flight.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.numbers import Range, show
from proofs.trusted.paper.s34_circle.persistence import Passes, SuperstableMotion
from proofs.trusted.parameters import Parameters, Place
from proofs.trusted.verdicts import Decision, Found, Row, Verdict, decided, undecided


@dataclass(frozen=True)
class Border(Conclusion):
    """The stable motion rests in every turn up to one epsilon, and at another; at a third no more.

    A theorem from conclusions: the set of epsilon at which it rests has a boundary point between
    the last two, since it contains the one and not the other. With impacts between landing and the
    last bounces it might rest before a later phi_s.
    """

    motion: SuperstableMotion
    rests: SuperstableMotion
    passes: Passes

    def __post_init__(self) -> None:
        (first, reached), (single, low) = self.motion.epsilons, self.rests.epsilons
        if not first == 0 < reached <= single == low < self.passes.epsilon:
            raise Unproved("the epsilons are not in order")
        if self.motion.boxes[1:] or self.rests.boxes[1:]:
            raise Unproved("the motion may pass phi_s before it comes to rest")
        if not self.motion.arc == self.rests.arc == self.passes.arc:
            raise Unproved("the motions are about different oscillators")

    @property
    def at(self) -> Place:
        """The oscillators."""
        return Place(self.motion.at.eta, self.motion.at.nu, (Fraction(0), self.passes.epsilon))

    @property
    def sentence(self) -> str:
        low, high = show(self.rests.largest), show(self.passes.epsilon)
        return (
            "the motion that leaves the table at the separation phase phi_s with relative velocity "
            "0 comes to rest before the first phi_s after it lands, and is periodic, for every "
            f"epsilon up to {show(self.motion.largest)}, and at epsilon = {low}. At epsilon = "
            f"{high} it does not: it {self.passes.brief}. The set of all epsilon at which it comes "
            f"to rest before that phi_s has a boundary point in [{low}, {high}]."
        )

    @property
    def brief(self) -> str:
        low, high = show(self.rests.largest), show(self.passes.epsilon)
        return (
            f"it comes to rest before phi_s up to epsilon = {show(self.motion.largest)} and at "
            f"{low}; at {high} it {self.passes.brief}"
        )

    @property
    def quantities(self) -> Mapping[str, Range]:
        return {"epsilon_border": (self.rests.largest, self.passes.epsilon)}


def _ends(of: Parameters, found: Found) -> Decision:
    """G15: a border from what is proved about single epsilons."""
    at = of.place.sides[:2]
    rests = [x for x in found.elsewhere(SuperstableMotion) if x.at.sides[:2] == at]
    passes = [x for x in found.elsewhere(Passes) if x.at.sides[:2] == at]
    if not passes or len(rests) < 2:
        return undecided("no epsilon is known at which it rests, or none at which it does not")
    rests.sort(key=lambda x: x.epsilons)
    border = Border(rests[0], rests[-1], min(passes, key=lambda x: x.epsilon))
    return decided(Verdict.VERIFIED, border, corrected=[border])


ROWS = (
    Row(
        "G15",
        "3.4, for larger epsilon",
        "",
        "At (eta, nu) = ({eta}, {nu}): the stable motion with infinitely many impacts in each "
        "period (claim G7) ends as epsilon grows, where its impacts do not come to an end before "
        "the mass would leave the table: there are two coefficients of restitution, at the "
        "smaller one it comes to rest, at the larger one it is in flight at the separation phase.",
        _ends,
    ),
)
