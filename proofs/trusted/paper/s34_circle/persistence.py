"""Section 3.4 with restitution: does the stable orbit persist, do transients grow?

Claims G7, G8, and G12 of our own. Phases are on the line.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise
from typing import NamedTuple

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion, place_of
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.differential import Differential
from proofs.trusted.kernel.stable import StableCycle
from proofs.trusted.numbers import Range, between, bits_for, ceil_text, show, show_range, within
from proofs.trusted.paper.s34_circle.bounces import (
    Box,
    State,
    bounced,
    kicked,
    landed,
    rest_phase,
    starts,
)
from proofs.trusted.paper.s34_circle.landing import Separation
from proofs.trusted.parameters import PAPER, Parameters, Place
from proofs.trusted.verdicts import Decide, Decision, Found, Row, Verdict, decided, undecided

_MOST_IMPACTS, _MOST_BOUNCES = 100, 100


# -- the periodic motion ---------------------------------------------------------------------------


@dataclass(frozen=True)
class SuperstableMotion(Conclusion):
    """For all epsilon of a range: the motion from phi_s has impacts in boxes, one in each, then
    bounces on the arc where the mass sticks, and comes to rest at a phase up to `rest`.

    So does every motion with an impact in the first box.
    """

    arc: Separation
    epsilons: Range
    boxes: tuple[Box, ...]
    rest: Fraction

    def __post_init__(self) -> None:
        least, largest = self.epsilons
        if not (self.boxes and self.rest < self.arc.phase[0]):
            raise Unproved("no states that come to rest on the sticking arc")
        if not (0 <= least <= largest < 1 and largest > 0):
            raise Unproved("no coefficients of restitution")

    @property
    def at(self) -> Place:
        """The oscillators."""
        return replace(self.arc.at, epsilon=self.epsilons)

    @property
    def largest(self) -> Fraction:
        """The greatest epsilon."""
        return self.epsilons[1]

    @property
    def sentence(self) -> str:
        enclosures = (self.arc.phase, self.arc.time, self.arc.arrival, self.arc.speed)
        phase, time, arrival, speed = (between(each, 12) for each in enclosures)
        images = ", ".join(" x ".join(map(between, box)) for box in self.boxes[1:])
        return (
            f"let phi_s in {phase} be the separation phase. The mass that leaves the table there "
            f"with relative velocity 0 lands after a time in {time}, at the phase phi_1 in "
            f"{arrival}, less {self.arc.turns} turns, with a relative speed u in {speed}, in the "
            f"box B = {' x '.join(map(show_range, self.boxes[0]))} (phases x velocities gamma "
            "before an impact). "
            f"{f'Its next impacts are in {images}, in this order. ' if images else ''}All further "
            f"impacts come at phases below phi_s, none after {ceil_text(self.rest)} (an upper "
            "bound), mod 2 pi: none if epsilon = 0, infinitely many, at phases that increase and "
            "with speeds that tend to 0, if epsilon > 0. Then the mass rests on the table until "
            f"phi_s: the motion has a period{self._period}; phi_s, phi_1 and u do not depend on "
            "epsilon. Every motion with an impact in B comes to rest before phi_s in the same way "
            "and is this one, exactly, from phi_s on: it is superstable. Counted as the plastic "
            "orbit (phi_1, phi_s), one landing with all that follows until it rests and one "
            "separation, it has period 2. For epsilon > 0 it is no 2-periodic orbit of the map F "
            "from one impact to the next, and none attracts this open set of states."
        )

    @property
    def _period(self) -> str:
        return "" if self.boxes[1:] else f" of 2 pi * {self.arc.turns}"

    @property
    def brief(self) -> str:
        return (
            f"for {self._coefficients} the stable "
            f"motion has infinitely many impacts in each period{self._period}: period 2 only if a "
            "landing with all that follows until rest counts as one step, and the separation as "
            "the other"
        )

    @property
    def _coefficients(self) -> str:
        """The epsilon > 0 that it is about."""
        least, largest = map(show, self.epsilons)
        if least == largest:
            return f"epsilon = {largest}"
        return f"{least} {'<=' if self.epsilons[0] else '<'} epsilon <= {largest}"

    @property
    def quantities(self) -> Mapping[str, Range]:
        return {"epsilon_proved_up_to": (self.largest, self.largest), **self.arc.quantities}


@dataclass(frozen=True)
class Passes(Conclusion):
    """After the flight from phi_s, and so many bounces, the mass passes phi_s in flight."""

    arc: Separation
    epsilon: Fraction
    bounces: int

    def __post_init__(self) -> None:
        if not (self.arc.returns and self.arc.speed[0] > 0 and 0 < self.epsilon < 1):
            raise Unproved("no impact on the arc with a speed > 0 is followed by a bounce")

    @property
    def at(self) -> Place:
        """The oscillator."""
        return replace(self.arc.at, epsilon=(self.epsilon, self.epsilon))

    @property
    def sentence(self) -> str:
        return (
            "the mass that leaves the table at the separation phase phi_s with relative velocity 0 "
            f"{self.brief}, the first one after it lands."
        )

    @property
    def brief(self) -> str:
        return f"has {self.bounces} impacts after it lands, and is in flight at phi_s"


class Cell(NamedTuple):
    """Brackets of the first bounces for all epsilon of a range."""

    epsilons: Range
    bounces: Sequence[Range]


def superstable_motion(
    arc: Separation, box: Box, impacts: Sequence[Differential], cells: Sequence[Cell]
) -> SuperstableMotion | Passes:
    """Theorem. Let the mass stick exactly on an arc until phi_s, and the state at which the flight
    from phi_s ends be inside a box of states. Let cells have intervals of epsilon, each from the
    end of the one before. Let `impacts`, if any, be about the same eta, nu and all these epsilon:
    on states that contain the box, on some that contain its image, and so on. Let the last image,
    or the box if there are none, have phases inside the arc and speeds > 0; from there, for each
    cell, bounce after bounce have its impact in the bracket given, by `bounce`, and the one after
    the last bracket satisfy the hypotheses of Lemma 2 (`rest_phase`), with a T below phi_s. Then
    what `SuperstableMotion.sentence` says; if no T is found after the bounces of one cell, without
    `impacts`, see `passes`.

    Proof. With relative velocity 0 the flight from phi_s does not depend on epsilon. What has an
    impact in the box has the next ones in its images, then on the arc, where a < 0, as the lemmas
    say, and comes to rest there; it sticks until phi_s, and leaves with relative velocity 0. Under
    F these impacts are different states that converge to one; so no 2-periodic orbit attracts them.
    """
    if any(one.epsilons[1] != two.epsilons[0] for one, two in pairwise(cells)):
        raise Unproved("the coefficients of cells do not follow one another")
    epsilons, bits = (cells[0].epsilons[0], cells[-1].epsilons[1]), bits_for(box[0])
    if not starts(arc, box, bits):
        raise Unproved("the flight from phi_s is not proved to end in the first box")
    boxes = [box]
    for each in impacts:
        at = each.place
        if at is None or at.epsilon is None or at.sides[:2] != arc.at.sides[:2]:
            raise Unproved("the steps are about different oscillators")
        if not within(epsilons, at.epsilon):
            raise Unproved("the steps are about different coefficients of restitution")
        if not all(map(within, boxes[-1], each.box)):
            raise Unproved("a box is not proved to be mapped into the next")
        boxes.append((each.values[0], each.values[1]))
    state = landed(arc, boxes[-1], bits)
    rests = []
    for cell in cells:
        last, speeds = bounced(arc.at, state, cell.epsilons, cell.bounces, bits)
        greatest = cell.epsilons[1]
        rest = rest_phase(arc.at, last, greatest * speeds[1], greatest, arc.phase[0])
        if rest is None:
            if impacts or cell.epsilons[0] < greatest or len(cells) > 1:
                raise Unproved("the bounces are not proved to end before phi_s")
            return passes(arc, (last, speeds), cell, bits)
        rests.append(rest)
    return SuperstableMotion(arc, epsilons, tuple(boxes), max(rests))


def passes(arc: Separation, state: State, cell: Cell, bits: int) -> Passes:
    """Theorem. Let the last bounce that a cell brackets, at one epsilon, end in a state, and all
    flights after it have gap > 0 at phi_s. Then what `Passes.sentence` says. Proof. a < 0 from the
    last impact to phi_s, so by Lemma 1 (`bounce`) gap has no zero before a time at which it is > 0.
    """
    (epsilon, _), (phases, (slow, fast)) = cell.epsilons, state
    time = arc.phase[0] - phases[1], arc.phase[1] - phases[0]
    if time[0] <= 0 or arc.at.eta[1] * time[1] > 3:
        raise Unproved("the last flight begins after phi_s, or is longer than its lemma allows")
    if kicked(arc.at, phases, (epsilon * slow, epsilon * fast), bits)(time, 0).lo <= 0:
        raise Unproved("the mass is not proved to be in flight at the separation phase")
    return Passes(arc, epsilon, len(cell.bounces))


def prove_superstable_motion(context: Context, reader: Reader) -> SuperstableMotion | Passes:
    """Rule `superstable-motion`: {separation, box: [phases, velocities], impacts: names of
    differential steps, cells: [{epsilon: [e, e'], bounces: [[t, t'], ...]}]}.

    Conclusion: `superstable_motion`, or that of `passes`.
    """
    arc_of, box_of, impacts_of, cells_of = reader.fields("separation", "box", "impacts", "cells")
    phases, velocities = (side.range() for side in box_of.items(2, 2))
    impacts = [context.step(name, Differential) for name in impacts_of.items(most=_MOST_IMPACTS)]
    cells = []
    for cell in cells_of.items(least=1):
        epsilons, bounces = cell.fields("epsilon", "bounces")
        times = [time.range() for time in bounces.items(most=_MOST_BOUNCES)]
        cells.append(Cell(epsilons.range(), times))
    arc = context.step(arc_of, Separation)
    return superstable_motion(arc, (phases, velocities), impacts, cells)


# -- the rows --------------------------------------------------------------------------------------


def restituting_cycles(found: Found) -> list[StableCycle]:
    """Return the stable cycles of F: those of the plastic map f are about epsilon = 0 alone."""
    return [each for each in found.all(StableCycle) if place_of(each).epsilon is not None]


def _persists(verdict: Verdict) -> Decide:
    """G7: how impacts are counted is open, as for the plastic orbit (claim G2), but where F has a
    stable 2-periodic orbit. G12: an open set of states is attracted by none, if epsilon > 0.
    """

    def decide(of: Parameters, found: Found) -> Decision:
        proved = found.first(SuperstableMotion)
        orbits = [each for each in restituting_cycles(found) if len(each.boxes) == 2]
        if verdict is Verdict.CONDITIONAL and of.epsilon and orbits:
            return decided(Verdict.VERIFIED, orbits[0], corrected=orbits[:1])
        if proved is not None and of.epsilon:
            return decided(verdict, proved, corrected=(proved, *found.elsewhere(StableCycle)))
        known = "; ".join(str(each.at) for each in found.elsewhere(SuperstableMotion))
        return undecided(f"proved for epsilon > 0, {known}, only" if known else "nothing is proved")

    return decide


_OBSERVED = (
    "an observation about simulated motions, no theorem and no certificate: medians, means and how "
    "many do not come to rest are on the page persistence.md, which python -m proofs persistence "
    "makes"
)


def _transients(of: Parameters, found: Found) -> Decision:
    """G8: no conclusion proves anything about it."""
    del of, found
    return Decision(Verdict.SIMULATED, missing=_OBSERVED)


_AT = "At (eta, nu) = ({eta}, {nu})"
ROWS = (
    Row(
        "G7",
        "3.4",
        "there is a stable 2-periodic orbit which attracts all the initial conditions chosen",
        _AT + ", for other coefficients of restitution too (epsilon = {epsilon} among them): there "
        "is a stable 2-periodic orbit, and it attracts an open set of initial conditions.",
        _persists(Verdict.CONDITIONAL),
    ),
    Row(
        "G12",
        "3.4",
        "",
        _AT + ", epsilon = {epsilon}: the map F from one impact to the next has a 2-periodic orbit "
        "that attracts almost every initial condition.",
        _persists(Verdict.REFUTED),
    ),
    Row(
        "G8",
        "3.4",
        "the trajectories took longer time to reach the periodic orbit",
        _AT + ": trajectories take the longer to reach the stable orbit the larger the coefficient "
        "of restitution is.",
        _transients,
        PAPER.place,
    ),
)
