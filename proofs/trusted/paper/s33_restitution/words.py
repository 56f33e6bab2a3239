"""Section 3.3: the golden mean shift that is left where V2 is never repeated."""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import suppress
from dataclasses import dataclass

from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion, place_of
from proofs.trusted.kernel.horseshoe import Horseshoe
from proofs.trusted.kernel.rates import Rates
from proofs.trusted.numbers import Phases
from proofs.trusted.paper.s33_restitution.horseshoes import NAMES
from proofs.trusted.paper.s33_restitution.rectangles import Strips
from proofs.trusted.parameters import Place

_ARROWS = (0, 1), (0,)


@dataclass(frozen=True)
class GoldenMean(Conclusion):
    """Full orbits in V1 and V2 are those that never repeat V2: the golden mean shift."""

    at: Place
    strips: Strips
    rates: Rates

    @property
    def sentence(self) -> str:
        return (
            f"{self.strips.smooth}, and one-to-one. Let Lambda_2 be the set of all states whose "
            "full orbits stay in the union of V1 and V2. F on Lambda_2 is conjugate, by the "
            "itinerary, to the shift on all two-sided sequences of 1 and 2 without 22 (golden mean "
            f"shift), and is {self.rates.said(*NAMES)}. Lambda_2 lies in the open rectangles, so "
            "that it is theirs too. It has topological entropy log((1 + sqrt 5)/2), periodic "
            "orbits of every period, uncountably many nonperiodic orbits and a dense orbit."
        )

    @property
    def brief(self) -> str:
        return "F on Lambda_2 is conjugate to the two-sided shift on sequences without 22"


def golden_mean(shoe: Horseshoe) -> GoldenMean:
    """Theorem. Of oscillators with epsilon > 0 let V1 and V2, of one height, be the wider
    rectangles of a horseshoe with the arrows 1 -> 1, 1 -> 2, 2 -> 1. Then `GoldenMean`.

    Proof. Full orbits in V1 and V2 follow the arrows, and F is one-to-one: see `restituting`.
    """
    at = place_of(shoe)
    if shoe.arrows != _ARROWS or not shoe.wider:
        raise Unproved("V2 is not proved never to be repeated")
    if at.sides[2][0] <= 0:
        raise Unproved("without restitution F is not one-to-one")
    (left, heights), (right, others) = shoe.wider
    if heights != others:
        raise Unproved("the rectangles are about different velocities")
    return GoldenMean(at, Strips(Phases(*left), Phases(*right), heights), shoe.rates)


def golden_means(found: Iterable[Conclusion]) -> list[GoldenMean]:
    """Return what conclusions say of V1 and V2 so."""
    proved = []
    for each in found:
        with suppress(Unproved):
            if isinstance(each, GoldenMean | Horseshoe):
                proved.append(golden_mean(each) if isinstance(each, Horseshoe) else each)
    return proved
