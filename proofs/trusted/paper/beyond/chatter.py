"""With restitution: the motion that leaves the table, comes back, and bounces until it rests."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from proofs.trusted.certificate import Reader
from proofs.trusted.equations import closing
from proofs.trusted.flights import COVER_BITS, Motion, lifted
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.numbers import Range, between, ceil_text, show_range, within
from proofs.trusted.paper.s33_restitution.rebounds import Rebound
from proofs.trusted.paper.s34_circle.landing import Separation
from proofs.trusted.paper.s34_circle.persistence import settle
from proofs.trusted.parameters import Place

_MOST_IMPACTS = 100
Box = tuple[Range, Range]


@dataclass(frozen=True)
class ChatteringMotion(Conclusion):
    """The flight from phi_s ends inside the first of boxes of states, F maps each into the next and
    the last to states on the arc where the mass sticks, that come to rest by the phase `rest`.
    """

    at: Place
    separation: Range
    boxes: tuple[Box, ...]
    rest: Fraction

    def __post_init__(self) -> None:
        """Raise Unproved unless there are boxes, and the mass rests before it leaves."""
        if not self.boxes or self.rest >= self.separation[0]:
            raise Unproved("no impacts, or no rest before the separation")

    @property
    def sentence(self) -> str:
        boxes = ", ".join(" x ".join(map(show_range, box)) for box in self.boxes)
        return (
            f"let phi_s in {between(self.separation, 12)} be the separation phase. The mass that "
            "leaves the table there with relative velocity 0 has its next impacts at states of "
            f"{boxes} (phases x velocities gamma before an impact), in this order; then it bounces "
            "where the table pushes, with speeds that tend to 0, and rests at a phase below "
            f"{ceil_text(self.rest)}, mod 2 pi, until phi_s: the motion is periodic. Every motion "
            f"with an impact in {'the first of these boxes' if self.boxes[1:] else 'this box'} "
            "comes to rest before phi_s in the same way and is this one, exactly, from phi_s on: "
            "it is superstable."
        )

    @property
    def brief(self) -> str:
        count = len(self.boxes)
        return (
            f"at {self.at} the motion from the separation phase, after {count} "
            f"impact{'s' if count > 1 else ''} and bounces that end, rests and leaves again"
        )


def _speeds(at: Place, phases: Range, gammas: Range) -> Range:
    """Enclose the relative speeds before impacts at these phases and velocities."""
    motion = Motion(at, phases, COVER_BITS)
    speed: Enclosure = closing(motion.start(), Enclosure.of(*gammas, COVER_BITS)) * motion.side
    return speed.range


def _starts(arc: Separation, first: Rebound) -> bool:
    """Whether the state at which the flight from phi_s ends is proved inside a box."""
    for turns in (0, 1):
        phases = lifted(arc.arrival, turns, COVER_BITS)
        if first.phases[0] < phases[0] and phases[1] < first.phases[1]:
            slow, fast = sorted(_speeds(arc.at, phases, (x, x)) for x in first.velocities)
            return slow[1] < arc.speed[0] and arc.speed[1] < fast[0]
    return False


def chattering_motion(
    arc: Separation, impacts: Sequence[Rebound], ratio: Fraction, rest: Fraction
) -> ChatteringMotion:
    """Theorem. Let the mass stick exactly on an arc until phi_s; let `Rebound`s be about F on boxes
    B_1, ..., B_n for one oscillator, epsilon > 0. Let the state at which the flight from phi_s ends
    be inside B_1, F(B_i) lie in B_(i+1), F(B_n) at phases of the arc, T = rest below phi_s, and let
    the hypotheses of `settle` hold for r = ratio and the kicks after impacts in F(B_n). Then what
    `ChatteringMotion.sentence` says.

    Proof. With relative velocity 0 the flight from phi_s does not depend on epsilon. What has an
    impact in B_1 has the next ones in B_2, ..., B_n and F(B_n); then, by Lemma 2 at `settle`,
    bounces at phases up to T and comes to rest, on the arc; it sticks until phi_s, and leaves with
    relative velocity 0.
    """
    if not impacts or len({each.at for each in impacts}) > 1:
        raise Unproved("impacts of one oscillator are expected")
    at, last = impacts[0].at, impacts[-1]
    low, epsilon = at.sides[2]
    if (at.eta, at.nu) != (arc.at.eta, arc.at.nu) or not 0 < low == epsilon:
        raise Unproved("the steps are about different oscillators, or impacts are plastic")
    if not _starts(arc, impacts[0]):
        raise Unproved("the flight from phi_s is not proved to end in the first box")
    for before, after in pairwise(impacts):
        if not (within(before.phase, after.phases) and within(before.velocity, after.velocities)):
            raise Unproved("a box is not proved to be mapped into the next")
    on_line = (lifted(last.phase, turns, COVER_BITS) for turns in (0, -1))
    phases = next((x for x in on_line if arc.start[1] < x[0] and x[1] < arc.phase[0]), None)
    if phases is None or rest >= arc.phase[0]:
        raise Unproved("the last impact is not proved to be where the mass sticks")
    kick = epsilon * _speeds(arc.at, phases, last.velocity)[1]
    settle(arc.at, phases, rest, kick, (epsilon, ratio))
    boxes = tuple((each.phases, each.velocities) for each in impacts)
    return ChatteringMotion(at, arc.phase, boxes, rest)


def prove_chattering_motion(context: Context, reader: Reader) -> ChatteringMotion:
    """Rule `chattering-motion`: {separation, impacts: names of rebound steps, ratio, rest}.

    Conclusion: `chattering_motion`.
    """
    arc_of, impacts_of, ratio, rest = reader.fields("separation", "impacts", "ratio", "rest")
    impacts = [context.step(name, Rebound) for name in impacts_of.items(1, _MOST_IMPACTS)]
    arc = context.step(arc_of, Separation)
    return chattering_motion(arc, impacts, ratio.number(), rest.number())
