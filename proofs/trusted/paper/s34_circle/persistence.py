"""Section 3.4 with restitution: does the stable orbit persist, do transients grow? Claims G7, G8.

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
from proofs.trusted.equations import AT_LAUNCH, gap, launch_acceleration
from proofs.trusted.flights import (
    COVER_BITS,
    FirstImpact,
    Motion,
    bits_for,
    bracketed,
    brackets,
    first_windows,
    lifted,
    read_phases,
    read_times,
    whole_turns,
)
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.numbers import Range, between, ceil_text, show
from proofs.trusted.paper.s34_circle.stable_pair import StablePair
from proofs.trusted.parameters import Parameters, Place
from proofs.trusted.verdicts import Decision, Found, Row, Verdict, decided, undecided

_ZERO = Fraction(0)


def _motion(of: Parameters, phases: Range, bits: int = COVER_BITS) -> Motion:
    return Motion(1 if of.nu > 0 else -1, of.eta, of.nu, phases, bits)


def _acceleration(motion: Motion) -> Enclosure:
    value: Enclosure = launch_acceleration(motion.start())
    return value


# -- the periodic motion ---------------------------------------------------------------------------


@dataclass(frozen=True)
class SuperstableMotion(Conclusion):
    """For every epsilon of `at`: impacts near the first one after phi_s end in rest before phi_s.

    phi_s in `separation` is the separation phase. The launch there with relative velocity 0 has its
    first impact after a time in `flight`, at the phase phi_s + time - 2 pi `turns` in `impact`,
    with a relative speed in `speed`. After impacts at most `spread` beside it, in phase and speed,
    all further ones come at phases up to `rest` < phi_s.
    """

    at: Place
    separation: Range
    flight: Range
    turns: int
    impact: Range
    speed: Range
    spread: Fraction
    rest: Fraction

    @property
    def largest(self) -> Fraction:
        """The largest epsilon; the least is 0."""
        return self.at.epsilon[1] if self.at.epsilon else _ZERO

    @property
    def sentence(self) -> str:
        """Return the theorem."""
        near, turns = show(self.spread), "turn" if self.turns == 1 else "turns"
        enclosures = (self.separation, self.flight, self.impact, self.speed)
        separation, flight, impact, speed = (between(each, 12) for each in enclosures)
        return (
            f"let phi_s be the separation phase, in {separation}. The mass that leaves the table "
            f"there with relative velocity 0 flies for a time t in {flight} and lands at the phase "
            f"phi_1 = phi_s + t - 2 pi * {self.turns} in {impact}, with a relative speed u in "
            f"{speed}. All further impacts of this passage come at phases below phi_s and up to "
            f"{ceil_text(self.rest)}: none if epsilon = 0, infinitely many, at "
            "phases that increase to a limit below phi_s and with speeds that tend to 0, if "
            "epsilon > 0. Then the mass rests on the table until phi_s and leaves it as before: it "
            f"moves periodically, with period 2 pi * {self.turns}, {self.turns} {turns} of the "
            "table; phi_s, phi_1 and u do not depend on epsilon. Every motion with an impact at a "
            f"phase within {near} of phi_1 and a relative speed within {near} of u comes to rest "
            "before phi_s in the same way, and from phi_s on it is this periodic motion, exactly: "
            "the return map is constant near the orbit, which is superstable. For epsilon > 0 it "
            "is not a 2-periodic orbit of the map F from one impact to the next, and none attracts "
            "this open set of states."
        )

    @property
    def brief(self) -> str:
        """Return the range of epsilon, and the period."""
        return (
            f"for 0 < epsilon <= {show(self.largest)} the stable motion has infinitely many "
            f"impacts in each period, of 2 pi * {self.turns}"
        )

    @property
    def quantities(self) -> Mapping[str, Range]:
        """Return the largest epsilon, and the flight."""
        return {
            "epsilon_max": (self.largest, self.largest),
            "separation_phase": self.separation,
            "impact_phase": self.impact,
            "impact_speed": self.speed,
            "flight": self.flight,
        }


def superstable_motion(context: Context, reader: Reader) -> SuperstableMotion:
    """Rule `superstable-motion`: {separation: [l, u], times 0 < t_1 < ... < t_n, time, spread,
    cells: [{epsilon, bounces: [[t, t'], ...], ratio, rest}]}, epsilons 0 < e_1 < ... < e_n.

    Hypotheses: 1. The launch acceleration a is < 0 at l, > 0 at u and increases on [l, u]. 2. For
    all launches in [l, u] with relative velocity 0, gap''' > 0 on [0, t_1]; the pieces
    [t_j, t_(j+1)] are closed, as in `first-impact`, but for some last ones, on which gap' < 0;
    `time` lies in these, with gap > 0 at its lower, gap < 0 at its upper end. 3. Let states be the
    phases and speeds of these impacts and those at most `spread` beside: the speeds are > 0, and
    a < 0 from the least phase to l. 4. Cell i, on [e_(i-1), e_i], e_0 = 0: from the states, bounce
    after bounce has its impact in the bracket given, by `_bounce`; the one after the last bracket
    satisfies the hypotheses of `_settle`, with r = ratio and T = rest.

    Conclusion: `SuperstableMotion` for 0 <= epsilon <= e_n. Proof. a vanishes at one phi_s in
    [l, u], by 1; there gap, gap' and gap'' vanish at launch. So, by 2, gap > 0 on (0, t_1] and on
    closed pieces: the first impact is the one in `time`, for every epsilon, and its phase is in the
    arc a < 0 that ends at phi_s, by 3. By 4 it is followed by impacts and rest as the lemmas say,
    below phi_s as a < 0 up to `rest`, and so are impacts nearby. From there to phi_s a < 0: the
    mass rests until phi_s. Under F these impacts are different states that converge to one; so no
    2-periodic orbit attracts them.
    """
    separation_of, times_of, time_of, spread_of, cells = reader.fields(
        "separation", "times", "time", "spread", "cells"
    )
    separation, spread, of = read_phases(separation_of), spread_of.number(), context.of
    time, turns, impact, speed = _flight(of, separation, times_of, time_of)
    phases, speeds = ((low - spread, high + spread) for low, high in (impact, speed))
    if not (spread > 0 and speeds[0] > 0 and phases[1] < separation[0]):
        raise Unproved("the states near the impact are not all before phi_s, with speed > 0")
    arc = (phases[0], separation[0])
    if _acceleration(_motion(of, arc, bits_for(separation))).hi >= 0:
        raise Unproved("the table does not push from the impact to the separation phase")
    epsilon, rests = _ZERO, []
    for cell in cells.items(least=1):
        end, rest = _cell(of, epsilon, (phases, speeds), cell)
        epsilon = end
        rests.append(rest)
    at = Place((of.eta, of.eta), (of.nu, of.nu), (_ZERO, epsilon))
    return SuperstableMotion(at, separation, time, turns, impact, speed, spread, max(rests))


def _flight(
    of: Parameters, separation: Range, times_of: Reader, time_of: Reader
) -> tuple[Range, int, Range, Range]:
    """Return time, turns, phase and speed of the impact: hypotheses 1 and 2."""
    times, bits = read_times(times_of), bits_for(separation)
    low, high = (_acceleration(_motion(of, (end, end), bits)) for end in separation)
    motion = _motion(of, separation, bits)
    # at launch gap' = 0, so that gap''' is the derivative of the launch acceleration
    slope: Enclosure = gap(motion.start(), AT_LAUNCH, 3)
    if not (low.hi < 0 < high.lo and slope.lo > 0):
        raise Unproved("the separation phase is not isolated")
    step = FirstImpact(of.place, motion, *first_windows(motion.gap_of, times, 3))
    if not step.transversal:
        raise Unproved("an earlier impact is not excluded, or the gap is not proved to fall to it")
    inner, time = bracketed(step, separation, time_of)
    arrival = (separation[0] + time[0], separation[1] + time[1])
    turns = int((arrival[1] - separation[0]) // whole_turns(1, bits)[0]) + 1
    speed = (-inner.gap_of(time, 1)).range
    return time, turns, lifted(arrival, -turns, bits), speed


def _cell(
    of: Parameters, begin: Fraction, states: tuple[Range, Range], cell: Reader
) -> tuple[Fraction, Fraction]:
    """Return the cell's last epsilon and its phase of rest: hypothesis 4."""
    epsilon_of, bounces, ratio, rest_of = cell.fields("epsilon", "bounces", "ratio", "rest")
    end, rest, (phases, speeds) = epsilon_of.number(), rest_of.number(), states
    if end <= begin:
        raise epsilon_of.fail("the coefficients must increase from 0")
    for bounce in bounces.items():
        kicks = begin * speeds[0], end * speeds[1]
        phases, speeds = _bounce(of, phases, kicks, bounce.range())
    _settle(of, (*phases, rest), end * speeds[1], (end, ratio.number()))
    return end, rest


def _bounce(of: Parameters, phases: Range, kicks: Range, time: Range) -> tuple[Range, Range]:
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
    motion = _motion(of, phases)
    kick = Enclosure.of(*kicks, COVER_BITS) * motion.side
    gap_of = partial(motion.gap, motion.start()._replace(kick=kick))
    if not brackets(gap_of, time):
        raise Unproved("a bracket of an impact does not have the signs +, - at its ends")
    strong, weak = _acceleration(_motion(of, (phases[0], phases[1] + time[1]))).range
    if weak >= 0:
        raise Unproved("the table is not proved to push all through a bounce")
    (low, high), change = (-gap_of(time, 1)).range, (1 + strong / weak) / 2
    speeds = max(low, kicks[0] / change), min(high, kicks[1] * change)
    return (phases[0] + time[0], phases[1] + time[1]), speeds


def _settle(
    of: Parameters, phases: tuple[Fraction, Fraction, Fraction], kick: Fraction, shrinking: Range
) -> None:
    """Lemma 2 (chatter). Let -A <= a <= -b < 0 on [phi, T], 0 <= epsilon, r >= epsilon sqrt(A / b),
    r < 1 and phi + 2 w / (b (1 - r)) <= T. Then all further impacts come at phases up to T; there
    are none if w = 0 (the mass sticks), infinitely many if w > 0 and epsilon > 0.

    Proof. In flight gap >= 0, so gap'' <= -b and gap <= w t - b t^2 / 2: as long as phases stay
    below T, an impact comes within 2 w / b, and as in Lemma 1 its speed is v <= sqrt(A / b) w;
    v > 0, since gap'' < 0 while gap returns to 0. So the next bounce has w' = epsilon v <= r w, the
    times sum to at most 2 w / b (1 + r + r^2 + ...) = 2 w / (b (1 - r)), and the speeds tend to 0.
    At the limit of the impacts the mass is at rest on the table, where a < 0: it sticks there, as
    long as a < 0.

    Prove its hypotheses for phi between the first two of `phases`, T the third, w at most `kick`;
    shrinking: the largest epsilon, and r.
    """
    (first, last, rest), (epsilon, ratio) = phases, shrinking
    if rest <= last or not 0 < ratio < 1:
        raise Unproved("no phase of rest, or no ratio, for the chatter lemma")
    low, high = _acceleration(_motion(of, (first, rest))).range
    if high >= 0 or ratio**2 * -high < epsilon**2 * -low:
        raise Unproved("the speeds of the bounces are not proved to shrink by the ratio")
    if last + 2 * kick / (-high * (1 - ratio)) > rest:
        raise Unproved("the bounces are not proved to end by the phase of rest")


# -- the rows --------------------------------------------------------------------------------------


def _persists(of: Parameters, found: Found) -> Decision:
    """G7: an open set of states is attracted by no 2-periodic orbit of F, if epsilon > 0."""
    proved = found.first(SuperstableMotion)
    if proved is not None and of.epsilon:
        return decided(Verdict.REFUTED, proved, corrected=(proved, *found.elsewhere(StablePair)))
    known = "; ".join(str(each.at) for each in found.elsewhere(SuperstableMotion))
    return undecided(f"proved for epsilon > 0, {known}, only" if known else "nothing is proved")


def _transients(of: Parameters, found: Found) -> Decision:
    """G8: no conclusion proves anything about it."""
    del of, found
    reason = "an observation about simulated motions: there is nothing to prove"
    return Decision(Verdict.SIMULATED, missing=reason)


_AT = "At (eta, nu) = ({eta}, {nu})"
ROWS = (
    Row(
        "G7",
        "3.4",
        "there is a stable 2-periodic orbit which attracts all the initial conditions chosen",
        _AT + ", for other coefficients of restitution too (epsilon = {epsilon} among them): the "
        "map F from one impact to the next has a stable 2-periodic orbit, and it attracts the "
        "initial conditions.",
        _persists,
    ),
    Row(
        "G8",
        "3.4",
        "the trajectories took longer time to reach the periodic orbit",
        _AT + ": trajectories take the longer to reach the stable orbit the larger the coefficient "
        "of restitution is.",
        _transients,
    ),
)
