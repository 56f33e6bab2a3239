"""Section 3.4 with restitution: where the stable motion of claim G7 ends. Claim G15 of our own.

The bounces that follow the flight from phi_s end in rest before phi_s as long as epsilon is small;
as it grows, the phase at which they end moves to phi_s. Beyond, the mass passes phi_s in flight.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from proofs.trusted.certificate import Reader
from proofs.trusted.flights import Motion
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.numbers import Range, show
from proofs.trusted.paper.s34_circle.landing import Separation
from proofs.trusted.paper.s34_circle.persistence import SuperstableMotion, bounce, settle
from proofs.trusted.parameters import Parameters, Place
from proofs.trusted.verdicts import Decision, Found, Row, Verdict, decided, undecided

_BITS = 256  # near the border each bounce loses three bits
_MOST = 100  # bounces


@dataclass(frozen=True)
class BouncesEnd(Conclusion):
    """After the flight from phi_s, and so many bounces, the mass comes to rest before phi_s, with
    infinitely many more or none; or else, if not `rests`, it passes phi_s in flight.
    """

    arc: Separation
    epsilon: Fraction
    bounces: int
    rests: bool

    def __post_init__(self) -> None:
        if not self.arc.returns or self.epsilon <= 0:
            raise Unproved("no bounces on the arc on which the mass sticks")

    @property
    def at(self) -> Place:
        """The oscillator."""
        return Place(self.arc.at.eta, self.arc.at.nu, (self.epsilon, self.epsilon))

    @property
    def sentence(self) -> str:
        return (
            f"the mass that leaves the table at phi_s with relative velocity 0 {self.brief}, the "
            "first separation phase after it lands."
        )

    @property
    def brief(self) -> str:
        if self.rests:
            return "has infinitely many impacts after it lands, and comes to rest before phi_s"
        return f"has {self.bounces} impacts after it lands, and is in flight at phi_s"


def bounces_end(context: Context, reader: Reader) -> BouncesEnd:
    """Rule `bounces-end`: {separation, epsilon > 0, bounces: [[t, t'], ...], rest: [] or
    [ratio, rest]}.

    Hypotheses: the impact of the `separation` step has a speed > 0 and a phase inside the arc;
    bounce after bounce has its impact in the bracket given, by Lemma 1 (`bounce`). After them:
    Lemma 2 (`settle`) with r = ratio and T = rest, below phi_s; or, where there is no rest, all
    flights have gap > 0 at phi_s. Conclusion: `BouncesEnd`. Proof. In the second case a < 0 from
    the last impact to phi_s, so by Lemma 1 the gap has no zero before a time at which it is > 0.
    """
    separation_of, epsilon_of, bounces_of, rest_of = reader.fields(
        "separation", "epsilon", "bounces", "rest"
    )
    arc, epsilon = context.step(separation_of, Separation), epsilon_of.number()
    if not (0 < epsilon < 1 and arc.speed[0] > 0 and arc.start[1] < arc.arrival[0]):
        raise Unproved("no impact on the arc with a speed > 0 is followed by a bounce")
    phases, speeds = arc.arrival, arc.speed
    times, rest = bounces_of.items(most=_MOST), rest_of.numbers(0, 2)
    for time in times:
        kicks = epsilon * speeds[0], epsilon * speeds[1]
        phases, speeds = bounce(context.of, phases, kicks, time.range(), _BITS)
        if speeds[0] <= 0:
            raise Unproved("a speed is not proved to be positive")
    if phases[1] >= arc.phase[0]:
        raise Unproved("an impact is not proved to be before the separation phase")
    if len(rest) == 2:
        if rest[1] >= arc.phase[0]:
            raise Unproved("the phase of rest is not below the separation phase")
        settle(context.of.place, phases, rest[1], epsilon * speeds[1], (epsilon, rest[0]))
    else:
        kicks = epsilon * speeds[0], epsilon * speeds[1]
        _check_flight(context.of, arc, phases, kicks)
    return BouncesEnd(arc, epsilon, len(times), len(rest) == 2)


def _check_flight(of: Parameters, arc: Separation, phases: Range, kicks: Range) -> None:
    """Prove that all flights are above the table at phi_s; of.eta times the time below pi."""
    time = arc.phase[0] - phases[1], arc.phase[1] - phases[0]
    if of.eta * time[1] > 3:
        raise Unproved("a flight is longer than its lemma allows")
    motion = Motion(of.place, phases, _BITS)
    start = motion.start()._replace(kick=Enclosure.of(*kicks, _BITS) * motion.side)
    if motion.gap(start, time).lo <= 0:
        raise Unproved("the mass is not proved to be in flight at the separation phase")


@dataclass(frozen=True)
class Border(Conclusion):
    """The stable motion rests in every turn up to one epsilon, and at another; at a third no more.

    A theorem from conclusions: the set of epsilon at which it rests has a boundary point between
    the last two, since it contains the one and not the other.
    """

    motion: SuperstableMotion
    rests: BouncesEnd
    passes: BouncesEnd

    def __post_init__(self) -> None:
        if not (self.rests.rests and not self.passes.rests):
            raise Unproved("rest is not proved at one epsilon and excluded at another")
        if not self.motion.largest <= self.rests.epsilon < self.passes.epsilon:
            raise Unproved("the epsilons are not in order")
        if not self.motion.arc == self.rests.arc == self.passes.arc:
            raise Unproved("the motions are about different oscillators")

    @property
    def at(self) -> Place:
        """The oscillators."""
        return Place(self.motion.at.eta, self.motion.at.nu, (Fraction(0), self.passes.epsilon))

    @property
    def sentence(self) -> str:
        low, high = show(self.rests.epsilon), show(self.passes.epsilon)
        return (
            "the motion that leaves the table at the separation phase phi_s with relative velocity "
            "0 comes to rest before the first phi_s after it lands, and is periodic, for every "
            f"epsilon up to {show(self.motion.largest)}, and at epsilon = {low}. At epsilon = "
            f"{high} it does not: it {self.passes.brief}. The set of all epsilon at which it comes "
            f"to rest before that phi_s has a boundary point in [{low}, {high}]."
        )

    @property
    def brief(self) -> str:
        low, high = show(self.rests.epsilon), show(self.passes.epsilon)
        return (
            f"it comes to rest before phi_s up to epsilon = {show(self.motion.largest)} and at "
            f"{low}; at {high} it {self.passes.brief}"
        )

    @property
    def quantities(self) -> Mapping[str, Range]:
        return {"epsilon_border": (self.rests.epsilon, self.passes.epsilon)}


def _ends(of: Parameters, found: Found) -> Decision:
    """G15: a border from what is proved about single epsilons."""
    at = (of.eta, of.eta), (of.nu, of.nu)
    ends = [x for x in found.elsewhere(BouncesEnd) if (x.at.eta, x.at.nu) == at]
    motions = [x for x in found.elsewhere(SuperstableMotion) if (x.at.eta, x.at.nu) == at]
    rests = max((x for x in ends if x.rests), key=lambda x: x.epsilon, default=None)
    passes = min((x for x in ends if not x.rests), key=lambda x: x.epsilon, default=None)
    if not motions or rests is None or passes is None:
        return undecided("no epsilon is known at which it rests, or none at which it does not")
    border = Border(motions[0], rests, passes)
    return decided(Verdict.VERIFIED, border, corrected=[border])


ROWS = (
    Row(
        "G15",
        "3.4, for larger epsilon",
        "",
        "At (eta, nu) = ({eta}, {nu}): the stable motion with infinitely many impacts in each "
        "period (claim G7) ends as epsilon grows, where its impacts do not come to an end before "
        "the mass would leave the table: there are two coefficients of restitution, at the "
        "smaller one it comes to rest, at the larger one it is in flight at the separation phase.",
        _ends,
    ),
)
