"""Stable periodic orbits of the map with restitution, of transversal impacts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.numbers import Range, show_range, within
from proofs.trusted.paper.s33_restitution.rebounds import Rebound, restitution, size
from proofs.trusted.parameters import Place

_MOST_IMPACTS = 100
Box = tuple[Range, Range]


@dataclass(frozen=True)
class StableCycle(Conclusion):
    """F maps each box of states, phases x velocities, into the next, the last into the first."""

    at: Place
    boxes: tuple[Box, ...]

    def __post_init__(self) -> None:
        """Raise Unproved unless the phases of the boxes are apart."""
        phases = sorted(box[0] for box in self.boxes)
        if not phases or any(one[1] >= two[0] for one, two in pairwise(phases)):
            raise Unproved("the boxes are not apart")

    @property
    def sentence(self) -> str:
        count = len(self.boxes)
        boxes = ", ".join(" x ".join(map(show_range, box)) for box in self.boxes)
        each = f"an impact in each of {boxes} (phases x velocities gamma), in this order"
        power, box = "F", "this box"
        if count == 1:
            each = f"its impacts in {boxes} (phases x velocities gamma)"
        else:
            power, box = f"F^{count}", "the first box"
        return (
            f"F has a {count}-periodic orbit, {each}; {power} contracts {box}, so that this orbit "
            "attracts every motion with an impact there."
        )

    @property
    def brief(self) -> str:
        count = len(self.boxes)
        return f"at {self.at} F has a stable {count}-periodic orbit of transversal impacts"


def stable_cycle(boxes: Sequence[Rebound], centres: Sequence[Rebound]) -> StableCycle:
    """Theorem. Let `Rebound`s be about F on boxes B_1, ..., B_k and at a point c_i of each, for one
    oscillator. Let F(c_i) + DF(B_i) (B_i - c_i) lie in B_(i+1), B_(k+1) = B_1; let the phases of
    the boxes be disjoint; let |DF(B_k)| ... |DF(B_1)| r < r, r the sides of B_1 and |D| the largest
    absolute values of entries. Then `StableCycle`.

    Proof. By the mean value theorem F(B_i) lies in B_(i+1), and F^k contracts the convex B_1 in the
    norm max |x_i| / r_i: it has one fixed point there, by Banach, which attracts B_1. The boxes are
    apart, so that its period is k.
    """
    if not boxes or len({step.at for step in (*boxes, *centres)}) > 1:
        raise Unproved("the steps are about more than one oscillator, or there are none")
    at = boxes[0].at
    if any(low < high for low, high in (at.eta, at.nu, restitution(at))):
        raise Unproved("the steps are about more than one oscillator")
    for on, point, target in zip(boxes, centres, (*boxes[1:], boxes[0]), strict=True):
        box, centre = (on.phases, on.velocities), (point.phases, point.velocities)
        reach = [max(b - c, d - a) for (a, b), (c, d) in zip(box, centre, strict=True)]
        more, less = _moved(on, reach)
        phases = point.phase[0] - more, point.phase[1] + more
        velocities = point.velocity[0] - less, point.velocity[1] + less
        inside = all(
            map(within, (*centre, phases, velocities), (*box, target.phases, target.velocities))
        )
        if on.turns != point.turns or not inside:
            raise Unproved("a box is not proved to be mapped into the next")
    sides = [high - low for low, high in (boxes[0].phases, boxes[0].velocities)]
    shrunk: Sequence[Fraction] = sides
    for on in boxes:
        shrunk = _moved(on, shrunk)
    if not all(after < before for after, before in zip(shrunk, sides, strict=True)):
        raise Unproved("the loop is not proved to contract the first box")
    return StableCycle(at, tuple((box.phases, box.velocities) for box in boxes))


def _moved(step: Rebound, sides: Sequence[Fraction]) -> tuple[Fraction, Fraction]:
    """Return |DF| times a vector with entries >= 0."""
    (p, q), (r, s) = ([size(entry) for entry in row] for row in step.derivative)
    return p * sides[0] + q * sides[1], r * sides[0] + s * sides[1]


def prove_stable_cycle(context: Context, reader: Reader) -> StableCycle:
    """Rule `stable-cycle`: {boxes: names of rebound steps, centres: as many}.

    Conclusion: `stable_cycle`.
    """
    boxes_of, centres_of = reader.fields("boxes", "centres")
    boxes = [context.step(name, Rebound) for name in boxes_of.items(1, _MOST_IMPACTS)]
    count = len(boxes)
    centres = [context.step(name, Rebound) for name in centres_of.items(count, count)]
    return stable_cycle(boxes, centres)
