"""Section 3.4 with restitution: does the stable orbit persist, do transients grow?

Claims G7, G8, and G12 of our own.

A bounce, here, is a launch at a phase phi with a relative velocity w >= 0 away from the table,
where the table pushes: let a(psi) be the launch acceleration of a mass at rest on the table at
phase psi, negative on the sticking arc. In flight gap'' = a(phi + t) - eta^2 gap, since
X'' = -eta^2 X for the mass, and a is the value of gap'' where gap = 0. Phases are on the line.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import partial

from proofs.trusted.certificate import Reader
from proofs.trusted.equations import launch_acceleration
from proofs.trusted.flights import COVER_BITS, Motion, brackets
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.numbers import Range, between, ceil_text, show
from proofs.trusted.paper.s33_restitution.cycles import StableCycle
from proofs.trusted.paper.s34_circle.landing import Separation
from proofs.trusted.parameters import PAPER, Parameters, Place
from proofs.trusted.verdicts import Decide, Decision, Found, Row, Verdict, decided, undecided

_ZERO = Fraction(0)


# -- the periodic motion ---------------------------------------------------------------------------


@dataclass(frozen=True)
class SuperstableMotion(Conclusion):
    """For every epsilon from 0 to `largest`: impacts near the first one after phi_s end in rest.

    After impacts at most `spread` beside it, in phase and in relative speed, all further ones come
    at phases up to `rest`, below phi_s.
    """

    arc: Separation
    largest: Fraction
    spread: Fraction
    rest: Fraction

    def __post_init__(self) -> None:
        if not (self.arc.returns and self.rest < self.arc.phase[0] and self.spread > 0):
            raise Unproved("no states that come to rest on the sticking arc")

    @property
    def at(self) -> Place:
        """The oscillators."""
        return Place(self.arc.at.eta, self.arc.at.nu, (_ZERO, self.largest))

    @property
    def sentence(self) -> str:
        near, turns = show(self.spread), self.arc.turns
        enclosures = (self.arc.phase, self.arc.time, self.arc.arrival, self.arc.speed)
        phase, time, arrival, speed = (between(each, 12) for each in enclosures)
        return (
            f"let phi_s in {phase} be the separation phase. The mass that leaves the table there "
            f"with relative velocity 0 lands after a time in {time}, at the phase phi_1 in "
            f"{arrival}, less {turns} turns, with a relative speed u in {speed}. All further "
            f"impacts come at phases below phi_s, up to {ceil_text(self.rest)}: none if epsilon = "
            "0, infinitely many, at phases that increase and with speeds that tend to 0, if "
            "epsilon > 0. Then the mass rests on the table until phi_s: the motion has the period "
            f"2 pi * {turns}; phi_s, phi_1 and u do not depend on epsilon. Every motion with an "
            f"impact at a phase within {near} of phi_1, with a relative speed within {near} of u, "
            "comes to rest before phi_s in the same way and is this one, exactly, from phi_s on: "
            "it is superstable. Counted as the plastic orbit (phi_1, phi_s), one landing with all "
            "that follows until it rests and one separation, it has period 2. For epsilon > 0 it "
            "is no 2-periodic orbit of the map F from one impact to the next, and none attracts "
            "this open set of states."
        )

    @property
    def brief(self) -> str:
        return (
            f"for 0 < epsilon <= {show(self.largest)} the stable motion has infinitely many "
            f"impacts in each period, of 2 pi * {self.arc.turns}: period 2 only if a landing with "
            "all that follows until rest counts as one step, and the separation as the other"
        )

    @property
    def quantities(self) -> Mapping[str, Range]:
        return {"epsilon_max": (self.largest, self.largest), **self.arc.quantities}


def superstable_motion(context: Context, reader: Reader) -> SuperstableMotion:
    """Rule `superstable-motion`: {separation, spread, cells: [{epsilon, bounces: [[t, t'], ...],
    ratio, rest}]}, epsilons 0 < e_1 < ... < e_n.

    Hypotheses: let states be phases and relative speeds of the impacts of the `separation` step and
    those at most `spread` beside; the speeds are > 0, the phases inside the arc. Cell i, on
    [e_(i-1), e_i], e_0 = 0: from the states, bounce after bounce has its impact in the bracket
    given, by `bounce`; the one after the last bracket satisfies the hypotheses of `settle`, with
    r = ratio and T = rest, below phi_s.

    Conclusion: `SuperstableMotion` for 0 <= epsilon <= e_n. Proof. With relative velocity 0 the
    flight from phi_s does not depend on epsilon; a < 0 from its impact to phi_s. It is followed by
    impacts and rest as the lemmas say, and so are impacts nearby; then the mass rests until phi_s.
    Under F these impacts are different states that converge to one; so no 2-periodic orbit attracts
    them.
    """
    separation_of, spread_of, cells = reader.fields("separation", "spread", "cells")
    arc, spread = context.step(separation_of, Separation), spread_of.number()
    phases, speeds = ((low - spread, high + spread) for low, high in (arc.arrival, arc.speed))
    if not (speeds[0] > 0 and arc.start[1] < phases[0] and phases[1] < arc.phase[0]):
        raise Unproved("the states near the impact are not all on the arc, with speed > 0")
    epsilon, rests = _ZERO, []
    for cell in cells.items(least=1):
        epsilon_of, bounces, ratio, rest = cell.fields("epsilon", "bounces", "ratio", "rest")
        epsilons = epsilon, epsilon_of.number()
        if epsilons[1] <= epsilon:
            raise epsilon_of.fail("the coefficients must increase from 0")
        box = phases, speeds
        for time in bounces.items():
            kicks = epsilons[0] * box[1][0], epsilons[1] * box[1][1]
            box = bounce(context.of, box[0], kicks, time.range())
        epsilon = epsilons[1]
        shrinking = epsilon, ratio.number()
        rests.append(rest.number())
        settle(context.of.place, box[0], rests[-1], epsilon * box[1][1], shrinking)
    return SuperstableMotion(arc, epsilon, spread, max(rests))


def _push(at: Place, phases: Range, bits: int = COVER_BITS) -> Range:
    """Bound a from below and above."""
    push: Enclosure = launch_acceleration(Motion(at, phases, bits).start())
    return push.range


def bounce(
    of: Parameters, phases: Range, kicks: Range, time: Range, bits: int = COVER_BITS
) -> tuple[Range, Range]:
    """Lemma 1 (one bounce). If a < 0 on [phi, phi + tau], eta tau < pi and w >= 0, then
    h(t) = eta gap(t) / sin(eta t) decreases strictly on (0, tau]; so the gap has at most one zero
    there, is > 0 before and < 0 after it, and gap' < 0 at it. If also -A <= a <= -b < 0, the speed
    v at the impact has v <= w (1 + A / b) / 2 and w <= v (1 + A / b) / 2.

    Proof. 1. By variation of constants, h(t) = w + int_0^t (cos(eta s) - cot(eta t) sin(eta s))
    a(phi + s) ds, and h'(t) is eta / sin^2(eta t) times int_0^t sin(eta s) a(phi + s) ds < 0. At a
    zero, gap' = h' sin / eta. 2. Multiply gap'' + eta^2 gap = a by gap' and integrate, up to the
    peak, of height H, and from there: w^2 - eta^2 H^2 and v^2 - eta^2 H^2 lie in [2 b H, 2 A H], so
    v^2 <= 2 A H + eta^2 H^2 <= (A / b) (2 b H + eta^2 H^2) <= (A / b) w^2, and the same with v and
    w exchanged; sqrt(q) <= (1 + q) / 2.

    Return phases and speeds of the impacts after all these bounces, bracketed in `time` by
    gap > 0 at its lower, gap < 0 at its upper end.
    """
    if time[0] <= 0 or of.eta * time[1] > 3:
        raise Unproved("a bounce is longer than its lemma allows")
    motion = Motion(of.place, phases, bits)
    kick = Enclosure.of(*kicks, bits) * motion.side
    gap_of = partial(motion.gap, motion.start()._replace(kick=kick))
    if not brackets(gap_of, time):
        raise Unproved("a bracket of an impact does not have the signs +, - at its ends")
    strong, weak = _push(of.place, (phases[0], phases[1] + time[1]), bits)
    if weak >= 0:
        raise Unproved("the table is not proved to push all through a bounce")
    (low, high), change = (-gap_of(time, 1)).range, (1 + strong / weak) / 2
    speeds = max(low, kicks[0] / change), min(high, kicks[1] * change)
    return (phases[0] + time[0], phases[1] + time[1]), speeds


def settle(at: Place, phases: Range, rest: Fraction, kick: Fraction, shrinking: Range) -> None:
    """Lemma 2 (chatter). Let -A <= a <= -b < 0 on [phi, T], 0 <= epsilon, r >= epsilon sqrt(A / b),
    r < 1 and phi + 2 w / (b (1 - r)) <= T. Then all further impacts come at phases up to T; there
    are none if w = 0 (the mass sticks), infinitely many if w > 0 and epsilon > 0.

    Proof. In flight gap >= 0, so gap'' <= -b and gap <= w t - b t^2 / 2: as long as phases stay
    below T, an impact comes within 2 w / b, and as in Lemma 1 its speed is v <= sqrt(A / b) w;
    v > 0, since gap'' < 0 while gap returns to 0. So the next bounce has w' = epsilon v <= r w, the
    times sum to at most 2 w / b (1 + r + r^2 + ...) = 2 w / (b (1 - r)), and the speeds tend to 0.
    At the limit of the impacts the mass is at rest on the table, where a < 0: it sticks there, as
    long as a < 0.

    Prove its hypotheses for phi in `phases`, T = rest, w at most `kick`, all coefficients up to the
    first number of `shrinking`, r the second.
    """
    (first, last), (epsilon, ratio) = phases, shrinking
    if rest <= last or not 0 < ratio < 1:
        raise Unproved("no phase of rest, or no ratio, for the chatter lemma")
    strong, weak = _push(at, (first, rest))
    if weak >= 0 or ratio**2 * -weak < epsilon**2 * -strong:
        raise Unproved("the speeds of the bounces are not proved to shrink by the ratio")
    if last + 2 * kick / (-weak * (1 - ratio)) > rest:
        raise Unproved("the bounces are not proved to end by the phase of rest")


# -- the rows --------------------------------------------------------------------------------------


def _persists(verdict: Verdict) -> Decide:
    """G7: how impacts are counted is open, as for the plastic orbit (claim G2), but where F has a
    stable 2-periodic orbit. G12: an open set of states is attracted by none, if epsilon > 0.
    """

    def decide(of: Parameters, found: Found) -> Decision:
        proved = found.first(SuperstableMotion)
        orbits = [each for each in found.all(StableCycle) if len(each.boxes) == 2]
        if verdict is Verdict.CONDITIONAL and of.epsilon and orbits:
            return decided(Verdict.VERIFIED, orbits[0], corrected=orbits[:1])
        if proved is not None and of.epsilon:
            return decided(verdict, proved, corrected=(proved, *found.elsewhere(StableCycle)))
        known = "; ".join(str(each.at) for each in found.elsewhere(SuperstableMotion))
        return undecided(f"proved for epsilon > 0, {known}, only" if known else "nothing is proved")

    return decide


_OBSERVED = (
    "an observation about simulated motions, no theorem and no certificate: medians, means and how "
    "many do not come to rest are on the page persistence.md, which python -m proofs.persistence "
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
