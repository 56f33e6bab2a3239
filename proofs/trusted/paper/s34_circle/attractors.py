"""Section 3.4 with restitution: two attractors. Claim G16 of our own.

For epsilon in a window the map F has a stable periodic orbit of transversal impacts, beside the
motion of claim G7, which comes to rest on the table in every turn.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from itertools import pairwise

from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion, place_of
from proofs.trusted.kernel.stable import StableCycle
from proofs.trusted.numbers import Range, between, common, hull, show_range, within
from proofs.trusted.paper.s34_circle.persistence import SuperstableMotion
from proofs.trusted.parameters import Parameters, Place
from proofs.trusted.verdicts import Decision, Found, Row, Verdict, decided, undecided


@dataclass(frozen=True)
class TwoAttractors(Conclusion):
    """Stable cycles for intervals of epsilon > 0, each from the end of the one before, are one
    orbit; the motion that rests is another one.

    Theorem. Let cycles have as many boxes each, for the same eta and nu; let first boxes of
    neighbours have a state in common. Then their orbits depend continuously on epsilon, as one.
    Proof. 1. On an interval F^k contracts one box into itself, by one rate for all its epsilon, and
    depends continuously on epsilon there; so does its fixed point. 2. At the common epsilon of two
    intervals F^k maps both first boxes into themselves, so what they have in common, too: there it
    has a fixed point, which is the only one of both. 3. The motion has infinitely many impacts in
    a period, the orbit k.
    """

    motion: SuperstableMotion
    cycles: tuple[StableCycle, ...]

    def __post_init__(self) -> None:
        if not self.cycles or place_of(self.cycles[0]).sides[2][0] <= 0:
            raise Unproved("no stable cycle for epsilon > 0")
        for each in self.cycles:
            if each.rounds > 1:
                raise Unproved("an orbit that contracts a box after several rounds only")
            if place_of(each).sides[:2] != self.motion.at.sides[:2]:
                raise Unproved("the motions are about different oscillators")
        for before, after in pairwise(self.cycles):
            if place_of(before).sides[2][1] != place_of(after).sides[2][0]:
                raise Unproved("the cycles leave a hole in epsilon, or overlap")
            if len(before.boxes) != len(after.boxes):
                raise Unproved("the cycles have different periods")
            for one, two in zip(before.boxes[0], after.boxes[0], strict=True):
                common(one, two)
        if not within(self.at.sides[2], self.motion.at.sides[2]):
            raise Unproved("the motion is not known to come to rest for all these epsilon")

    @property
    def at(self) -> Place:
        """The oscillators."""
        first, last = (place_of(self.cycles[k]).sides[2] for k in (0, -1))
        return replace(place_of(self.cycles[0]), epsilon=(first[0], last[1]))

    @property
    def sentence(self) -> str:
        count = len(self.cycles[0].boxes)
        states = [
            [hull(values) for values in zip(*boxes, strict=True)]
            for boxes in zip(*(each.boxes for each in self.cycles), strict=True)
        ]
        impacts = ", ".join(" x ".join(map(between, state)) for state in states)
        return (
            f"for every one of these epsilon F has a {count}-periodic orbit of transversal "
            f"impacts, which depends continuously on epsilon, with an impact in each of {impacts} "
            "(phases x velocities gamma), in this order; it is asymptotically stable: for "
            f"{len(self.cycles)} intervals of epsilon, one after the other, F^{count} contracts a "
            "box of states into itself, so that it attracts every motion with an impact there. "
            "Beside it there is the motion that leaves the table at the separation phase and comes "
            "to rest, after infinitely many impacts, before the first one after it lands; it "
            "attracts an open set of states, too: there are two attractors at least."
        )

    @property
    def brief(self) -> str:
        return (
            f"for every epsilon in {show_range(self.at.sides[2])} a stable "
            f"{len(self.cycles[0].boxes)}-periodic orbit, beside the motion that comes to rest"
        )

    @property
    def quantities(self) -> Mapping[str, Range]:
        low, high = self.at.sides[2]
        return {"epsilon_proved_from": (low, low), "epsilon_proved_up_to": (high, high)}


def _coexist(of: Parameters, found: Found) -> Decision:
    """G16: all stable cycles at this eta and nu, in the order of epsilon."""
    at = (of.eta, of.eta), (of.nu, of.nu)
    motions = [x for x in found.elsewhere(SuperstableMotion) if x.at.sides[:2] == at]
    cycles = [x for x in found.elsewhere(StableCycle) if place_of(x).sides[:2] == at]
    if not motions or not cycles:
        return undecided("no motion is known that comes to rest, or no stable cycle")
    cycles.sort(key=lambda each: place_of(each).sides[2])
    both = TwoAttractors(min(motions, key=lambda x: x.epsilons), tuple(cycles))
    if not both.at.sides[2][0] < both.at.sides[2][1]:
        return undecided("a stable cycle is known at one epsilon only")
    return decided(Verdict.VERIFIED, both, corrected=[both])


ROWS = (
    Row(
        "G16",
        "3.4, for larger epsilon",
        "",
        "At (eta, nu) = ({eta}, {nu}): for all coefficients of restitution of an interval the map "
        "F has a stable periodic orbit, continuous in epsilon, beside the stable motion with "
        "infinitely many impacts in each period (claim G7): there is more than one attractor.",
        _coexist,
    ),
)
