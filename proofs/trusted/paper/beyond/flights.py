"""How much of the circle comes to rest on the table, or never to it, at any parameters. X5, X10."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.paper.beyond.attractors import (
    AtRest,
    NeverSticks,
    OnlyTouches,
    all_stick,
    first_proved,
)
from proofs.trusted.paper.beyond.returning import StickingMotion, SticksOnce
from proofs.trusted.paper.s34_circle.circle import MAJORITY, basin, most
from proofs.trusted.paper.s34_circle.landing import NeverImpacts, Separation
from proofs.trusted.parameters import Parameters, Place
from proofs.trusted.verdicts import Decision, Found, Row, Verdict, decided, undecided


@dataclass(frozen=True)
class FlightsEnd(Conclusion):
    """Theorem. Let nu > 0, eta = p/q. Then what the sentence says.

    Proof. After a plastic impact gap = (1 + lift) cos(eta t) + (rate / eta) sin(eta t) - 1
    - nu sin(phi + t) as long as there is no other. It has the period 2 pi q and the mean -1 over
    it, as its waves have whole numbers of periods in it: it is < 0 at some time before 2 pi q.
    """

    at: Place

    def __post_init__(self) -> None:
        if self.at.nu[0] <= 0 or self.at.eta[0] != self.at.eta[1]:
            raise Unproved("nu > 0 and one eta are expected")

    @property
    def sentence(self) -> str:
        turns = self.at.eta[0].denominator
        return (
            f"no flight after a plastic impact lasts for {turns} turn{'s' if turns > 1 else ''} of "
            "the table: before that the table would reach the mass, and pass it."
        )


def _flies(of: Parameters, found: Found) -> Decision:
    never = found.first(NeverImpacts) or first_proved(of.place, OnlyTouches)
    none = first_proved(of.place, FlightsEnd)
    if never is not None:
        return decided(Verdict.VERIFIED, never)
    return undecided("none are proved") if none is None else decided(Verdict.REFUTED, none)


def _comes(of: Parameters, found: Found) -> Decision:
    """X10: a mass that sticks leaves at phi_s, so that one motion alone sticks and is periodic."""
    motion, arc = found.first(StickingMotion), found.first(Separation)
    none = first_proved(of.place, AtRest, NeverSticks) or found.first(SticksOnce)
    if none is None and motion is not None and motion.cells:  # two impacts a period, or more
        none = motion
    if none is not None:
        return decided(Verdict.REFUTED, none)
    every = all_stick(found)
    if every is not None:
        return decided(Verdict.VERIFIED, every)
    if arc is not None and arc.returns and arc.share > MAJORITY:
        return decided(Verdict.VERIFIED, arc, known={"basin_fraction": (arc.share, Fraction(1))})
    return basin(most, printed=False)(of, found)


ROWS = (
    Row(
        "X5",
        "beyond",
        "",
        "At (eta, nu) = ({eta}, {nu}), for plastic impacts: there is an interval of phases from "
        "which the mass leaves the table and never makes an impact again (a touch without relative "
        "velocity is none).",
        _flies,
    ),
    Row(
        "X10",
        "beyond",
        "",
        "At (eta, nu) = ({eta}, {nu}), for plastic impacts: from more than half of the circle "
        "orbits come to a periodic motion with one impact, after which the mass sticks, and one "
        "separation a period.",
        _comes,
    ),
)
