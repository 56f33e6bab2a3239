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
from proofs.trusted.kernel.enclose import Matrix, enclosed, multiply
from proofs.trusted.numbers import Range, show_range, within
from proofs.trusted.paper.s33_restitution.rebounds import Rebound, size
from proofs.trusted.paper.s33_restitution.rectangles import meet
from proofs.trusted.parameters import Place

_MOST_IMPACTS = 100
_BITS = 128  # of the derivative of F^k
Box = tuple[Range, Range]


@dataclass(frozen=True)
class StableCycle(Conclusion):
    """F maps each of k boxes of states, phases x velocities, but the last one into the next; F^n,
    n = k times `rounds`, maps the first into itself, and contracts it.
    """

    at: Place
    boxes: tuple[Box, ...]
    rounds: int = 1

    def __post_init__(self) -> None:
        """Raise Unproved unless the phases of the boxes are apart."""
        phases = sorted(box[0] for box in self.boxes)
        apart = all(one[1] < two[0] for one, two in pairwise(phases))
        if not phases or not apart or self.rounds < 1:
            raise Unproved("the boxes are not apart")

    @property
    def sentence(self) -> str:
        count = len(self.boxes)
        boxes = ", ".join(" x ".join(map(show_range, box)) for box in self.boxes)
        each = f"an impact in each of {boxes} (phases x velocities gamma), in this order"
        power, box = f"F^{count * self.rounds}", "the first box"
        if count == 1:
            each = f"its impacts in {boxes} (phases x velocities gamma)"
            power, box = "F" if self.rounds == 1 else power, "this box"
        return (
            f"F has a {count}-periodic orbit, {each}; {power} contracts {box}, so that this orbit "
            "attracts every motion with an impact there."
        )

    @property
    def brief(self) -> str:
        count = len(self.boxes)
        return f"at {self.at} F has a stable {count}-periodic orbit of transversal impacts"


def stable_cycle(boxes: Sequence[Rebound], centres: Sequence[Rebound]) -> StableCycle:
    """Theorem. Let `Rebound`s be about F on boxes B_1, ..., B_n and on boxes C_i in B_i, for the
    same oscillators, with the same turns. Let F(B_i) lie in B_(i+1) and F(C_i) in C_(i+1) for
    i < n; let the phases of B_1, ..., B_k be disjoint, k dividing n. With intervals
    D_i = DF(B_i) ... DF(B_1) let B' = F(C_n) + D_n (B_1 - C_1) lie in B_1, and |D_n| r < r: r the
    sides of B_1, |D| the largest absolute values of entries. If k < n, let F(C_k) + D_k (B' - C_1)
    lie in B_1. Then `StableCycle`.

    Proof, for each oscillator. F^i(C_1) lies in F(C_i). On B_1 the derivative of F^i is in D_i, and
    so are its means. By the mean value theorem F^n maps the convex B_1 into B', and contracts
    it in the norm max |x_i| / r_i: it has one fixed point x there, by Banach, which attracts B_1.
    x is in B', so that F^k(x) is in B_1, and fixed by F^n as well: it is x. B_1, ..., B_k are
    apart, so that the period is k.
    """
    if not boxes or len({step.at for step in (*boxes, *centres)}) > 1:
        raise Unproved("the steps are not about the same oscillators, or there are none")
    for on, inside in zip(boxes, centres, strict=True):
        if on.turns != inside.turns or not _in(_states(inside), _states(on)):
            raise Unproved("a centre is not in its box")
    for before, after in pairwise(boxes):
        if not _in(_image(before), _states(after)):
            raise Unproved("a box is not proved to be mapped into the next")
    for before, after in pairwise(centres):
        if not _in(_image(before), _states(after)):
            raise Unproved("a centre is not proved to be mapped into the next")
    product, first = loop(boxes), _states(boxes[0])
    count = next((i for i, box in enumerate(boxes) if i and meet(box.phases, first[0])), len(boxes))
    image = _reached(first, centres, product)
    if len(boxes) % count or not _in(image, first):
        raise Unproved("the first box is not proved to be mapped into itself")
    if count < len(boxes) and not _in(_reached(image, centres[:count], loop(boxes[:count])), first):
        raise Unproved("the period of the orbit is not proved")
    sides = [high - low for low, high in _states(boxes[0])]
    if not all(after < side for after, side in zip(_moved(product, sides), sides, strict=True)):
        raise Unproved("the loop is not proved to contract the first box")
    return StableCycle(boxes[0].at, tuple(map(_states, boxes[:count])), len(boxes) // count)


def _reached(box: Sequence[Range], centres: Sequence[Rebound], product: Matrix) -> list[Range]:
    """Enclose the image of a box by the mean value theorem, from that of the first centre."""
    reach = [max(b - c, d - a) for (a, b), (c, d) in zip(box, _states(centres[0]), strict=True)]
    return [
        (low - more, high + more)
        for (low, high), more in zip(_image(centres[-1]), _moved(product, reach), strict=True)
    ]


def _states(step: Rebound) -> Box:
    return step.phases, step.velocities


def _image(step: Rebound) -> Box:
    return step.phase, step.velocity


def _in(inner: Sequence[Range], outer: Sequence[Range]) -> bool:
    return all(map(within, inner, outer))


def loop(boxes: Sequence[Rebound]) -> Matrix:
    """Enclose DF(B_k) ... DF(B_1)."""
    first, *rest = ([enclosed(row, _BITS) for row in box.derivative] for box in boxes)
    for after in rest:
        first = multiply(after, first)
    return first


def _moved(matrix: Matrix, sides: Sequence[Fraction]) -> list[Fraction]:
    """Return |D| times a vector with entries >= 0."""
    return [
        sum((size(entry.range) * side for entry, side in zip(row, sides, strict=True)), Fraction(0))
        for row in matrix
    ]


def prove_stable_cycle(context: Context, reader: Reader) -> StableCycle:
    """Rule `stable-cycle`: {boxes: names of rebound steps, centres: as many}.

    Conclusion: `stable_cycle`.
    """
    boxes_of, centres_of = reader.fields("boxes", "centres")
    boxes = [context.step(name, Rebound) for name in boxes_of.items(1, _MOST_IMPACTS)]
    count = len(boxes)
    centres = [context.step(name, Rebound) for name in centres_of.items(count, count)]
    return stable_cycle(boxes, centres)
