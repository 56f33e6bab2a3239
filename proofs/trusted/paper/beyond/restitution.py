"""Motions with restitution, at any parameters: chaos, stable motions, rest. Rows X6 to X9."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.paper.beyond.attractors import Leaves, first_proved
from proofs.trusted.paper.s33_restitution.horseshoes import shoes_at
from proofs.trusted.paper.s34_circle.landing import NeverImpacts
from proofs.trusted.paper.s34_circle.persistence import SuperstableMotion, restituting_cycles
from proofs.trusted.paper.s34_circle.touching import touching_family
from proofs.trusted.parameters import Parameters, Place
from proofs.trusted.verdicts import Decision, Found, Row, Verdict, decided, undecided


@dataclass(frozen=True)
class ComesToRest(Conclusion):
    """Theorem. Let nu > 0, c = nu |1 - eta^2|, A = eta^2 + c, b = eta^2 - c > 0, K the lesser one
    of A / b and 1 + c / (b eta), and epsilon^2 K < 1. Then what the sentence says.

    Proof. The relative acceleration a of a free mass at the table, -eta^2 + c sin(phi) up to the
    sign of c, lies in [-A, -b] at all phases.
    In flight gap >= 0 and gap'' = a - eta^2 gap <= -b: each flight ends with an impact, after a
    rebound w within 2 w / b. Its speed v has v^2 <= K w^2: 1. v <= sqrt(A / b) w as in the chatter
    lemma of `superstable-motion`. 2. gap'' gap' integrated over the flight, by parts, is v^2 - w^2
    = 2 c times the integral of -cos(phi) gap. The solution y of y'' + eta^2 y = -b with y = 0, y' =
    w at first is >= gap until eta t = pi, by variation of constants, and falls to 0 before, at
    tan(eta t / 2) = x, x = w eta / b. So the integral of gap is at most that of y until then,
    2 b (x - arctan x) / eta^3 <= b x^2 / (2 eta^3), as x^2 / 4 + arctan x - x has the derivative
    x (x - 1)^2 / (2 (1 + x^2)) >= 0. Hence v^2 <= w^2 (1 + c / (b eta)).
    So the next rebound is epsilon v <= r w, r = epsilon sqrt(K) < 1: the times sum to at most 2 w /
    (b (1 - r)), the speeds tend to 0. Then the mass is at rest on the table, and stays, as a < 0.
    """

    at: Place

    def __post_init__(self) -> None:
        (eta, last), (nu, most) = self.at.eta, self.at.nu
        if (eta, nu) != (last, most) or nu < 0:
            raise Unproved("one eta and one nu > 0 are expected")
        push, change = eta * eta, nu * abs(1 - eta * eta)
        least = push - change
        growth = min(push + change, least + change / eta)  # K b
        if least <= 0 or self.at.sides[2][1] ** 2 * growth >= least:
            raise Unproved("the speeds of the rebounds are not proved to shrink")

    @property
    def sentence(self) -> str:
        return (
            "after its first impact every motion comes to rest on the table within a finite time, "
            "and stays there for ever: the table pushes at all phases, and rebounds become weaker."
        )


def _at(of: Parameters) -> Place:
    return Place.restituting(of.eta, of.nu, of.epsilon or Fraction(0))


def _rest(of: Parameters) -> Conclusion | None:
    return first_proved(_at(of), ComesToRest)


def _chaotic(of: Parameters, found: Found) -> Decision:
    horseshoes, none = shoes_at(of, found), _rest(of)
    if horseshoes:
        return decided(Verdict.VERIFIED, horseshoes[0])
    return undecided("no horseshoe is proved") if none is None else decided(Verdict.REFUTED, none)


def _stable(of: Parameters, found: Found) -> Decision:
    motions = [*found.all(SuperstableMotion), *restituting_cycles(found)]
    if motions:
        return decided(Verdict.VERIFIED, *motions)
    none = _rest(of)
    return undecided("none is proved") if none is None else decided(Verdict.REFUTED, none)


def _touches(of: Parameters, found: Found) -> Decision:
    never, none = found.first(NeverImpacts), _rest(of)
    if none is not None:
        return decided(Verdict.REFUTED, none)
    if never is None or not of.epsilon:
        return undecided("no phases are proved after which there is no impact, or epsilon is 0")
    return decided(Verdict.VERIFIED, touching_family(never))


def _rests(of: Parameters, found: Found) -> Decision:
    del found
    rest, leaves = _rest(of), first_proved(of.place, Leaves)
    if rest is not None:
        return decided(Verdict.VERIFIED, rest)
    if leaves is not None:
        return decided(Verdict.REFUTED, leaves)
    return undecided("whether rebounds become weaker is not proved")


_AT = "At (eta, nu) = ({eta}, {nu}), epsilon = {epsilon}: "
ROWS = (
    Row(
        "X6",
        "beyond",
        "",
        _AT + "the map F from one impact to the next has a compact invariant set of positive "
        "topological entropy.",
        _chaotic,
    ),
    Row(
        "X7",
        "beyond",
        "",
        _AT + "there is a periodic motion with impacts that attracts an open set of others.",
        _stable,
    ),
    Row("X8", "beyond", "", _AT + "every motion comes to rest on the table for ever.", _rests),
    Row(
        "X9",
        "beyond",
        "",
        _AT + "an open set of states, phases and velocities, is attracted to motions that leave "
        "the table and touch it again, without relative velocity, and so on for ever.",
        _touches,
    ),
)
