"""Section 3.4 with restitution: a 2-periodic orbit of F that attracts a box of states."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from operator import lt

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.numbers import Range, show_range, within
from proofs.trusted.paper.s33_restitution.rebounds import Rebound, restitution, size
from proofs.trusted.parameters import Place


@dataclass(frozen=True)
class StablePair(Conclusion):
    """F maps `first` into `second` and back, two boxes of states, phases x velocities, apart."""

    at: Place
    first: tuple[Range, Range]
    second: tuple[Range, Range]

    @property
    def sentence(self) -> str:
        """Return the theorem."""
        first, second = (" x ".join(map(show_range, box)) for box in (self.first, self.second))
        return (
            f"F has a 2-periodic orbit, one impact in {first} (phases x velocities gamma), the "
            f"other in {second}; F^2 contracts the first box, so that this orbit attracts every "
            "motion with an impact there."
        )


def stable_pair(
    first: Rebound, at_first: Rebound, second: Rebound, at_second: Rebound
) -> StablePair:
    """Theorem. Let `Rebound`s be about F on a box B1, at a point c1 of it, on B2, at c2 of it, for
    one oscillator. Let F(c1) + DF(B1) (B1 - c1) lie in B2, the same with 1 and 2 exchanged; let the
    phases of B1 and B2 be disjoint; let |DF(B2)| |DF(B1)| r < r, r the sides of B1 and |D| the
    largest absolute values of entries. Then `StablePair`.

    Proof. By the mean value theorem F(B1) lies in B2 and F(B2) in B1, and F^2 contracts the convex
    B1 in the norm max |x_i| / r_i: it has one fixed point there, by Banach, which attracts B1.
    """
    if len({step.at for step in (first, at_first, second, at_second)}) > 1:
        raise Unproved("the steps are about different oscillators")
    if any(low < high for low, high in (first.at.eta, first.at.nu, restitution(first.at))):
        raise Unproved("the steps are about more than one oscillator")
    if not (first.phases[1] < second.phases[0] or second.phases[1] < first.phases[0]):
        raise Unproved("the boxes are not apart")
    for on, at, target in ((first, at_first, second), (second, at_second, first)):
        box, centre = (on.phases, on.velocities), (at.phases, at.velocities)
        reach = [max(b - c, d - a) for (a, b), (c, d) in zip(box, centre, strict=True)]
        more, less = _moved(on, reach)
        phases = at.phase[0] - more, at.phase[1] + more
        velocities = at.velocity[0] - less, at.velocity[1] + less
        inside = all(
            map(within, (*centre, phases, velocities), (*box, target.phases, target.velocities))
        )
        if on.turns != at.turns or not inside:
            raise Unproved("a box is not proved to be mapped into the other")
    sides = [high - low for low, high in (first.phases, first.velocities)]
    if not all(map(lt, _moved(second, _moved(first, sides)), sides)):
        raise Unproved("F^2 is not proved to contract the first box")
    return StablePair(
        first.at, (first.phases, first.velocities), (second.phases, second.velocities)
    )


def _moved(step: Rebound, sides: Sequence[Fraction]) -> tuple[Fraction, Fraction]:
    """Return |DF| times a vector with entries >= 0."""
    (p, q), (r, s) = ([size(entry) for entry in row] for row in step.derivative)
    return p * sides[0] + q * sides[1], r * sides[0] + s * sides[1]


def prove_stable_pair(context: Context, reader: Reader) -> StablePair:
    """Rule `stable-pair`: {first, at_first, second, at_second: rebound steps}.

    Conclusion: `stable_pair`.
    """
    names = reader.fields("first", "at_first", "second", "at_second")
    first, at_first, second, at_second = (context.step(name, Rebound) for name in names)
    return stable_pair(first, at_first, second, at_second)
