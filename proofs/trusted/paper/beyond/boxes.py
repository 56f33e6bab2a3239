"""For all oscillators of a box of (eta, nu): where nothing is chaotic."""

from __future__ import annotations

from dataclasses import dataclass

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import About, Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.numbers import between
from proofs.trusted.paper.beyond.attractors import AtRest
from proofs.trusted.paper.s34_circle.landing import Separation

_HALF_TURN = 3  # less than pi


@dataclass(frozen=True)
class AllStick(Conclusion):
    """Theorem. Let eta <= 3/7, and let the flight after the separation end in the sticking arc
    within one turn. Then what the sentence says.

    Proof. Let the arc be (a, s), s = phi_s, A the launch acceleration, < 0 on the arc and > 0 from
    s to a + 2 pi. By `lands` gap is the integral of sin(eta (t - u)) / eta A(phi + u), 0 < u < t,
    eta t < pi here. 1. The flight from s has its first impact on the arc, where A < 0: from there,
    with the gap falling from 0, the same formula gives gap < 0 until phase s + 2 pi. 2. That at
    phase s + 2 pi decreases in the launch phase, where A > 0: it is < 0 after all launches
    between s and a + 2 pi, and there is no impact before phase a + 2 pi. So the first impact is on
    the arc. 3. What sticks leaves at s: f maps all phases to the arc, and that to one phase.
    """

    arc: Separation

    def __post_init__(self) -> None:
        if not self.arc.returns or self.arc.turns != 1 or 7 * self.at.eta[1] > _HALF_TURN:
            raise Unproved("the flight from the separation is not proved to end soon on the arc")

    at = About("arc")

    @property
    def sentence(self) -> str:
        return (
            "every mass that does not stick after an impact sticks after its next one, and one "
            "that sticks leaves the table at a phase in "
            f"{between(self.arc.phase)} and has its next impact where it sticks, at a phase in "
            f"{between(self.arc.arrival)}: one periodic motion attracts all, exactly from the "
            "second impact on, f(f(phi)) is constant, and f has no horseshoe."
        )


def prove_settles(context: Context, reader: Reader) -> AtRest | AllStick:
    """Rule `settles`: {separation: name of a step, or null}.

    Conclusion: `AllStick`; `AtRest` where there is no separation.
    """
    (name,) = reader.fields("separation")
    return AtRest(context.place) if name.is_null() else AllStick(context.step(name, Separation))
