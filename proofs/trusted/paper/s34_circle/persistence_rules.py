"""The rules behind G7: the flight from the separation phase, and the chatter that ends it.

A bounce, here, is a launch at a phase phi with a relative velocity w >= 0 away from the table,
where the table pushes: let a(psi) be the launch acceleration of a mass at rest on the table at
phase psi, negative on the sticking arc. In flight gap'' = a(phi + t) - eta^2 gap, since
X'' = -eta^2 X for the mass, and a is the value of gap'' where gap = 0.

Lemma 1 (one bounce). If a < 0 on [phi, phi + tau], eta tau < pi and w >= 0, then
h(t) = eta gap(t) / sin(eta t) decreases strictly on (0, tau]; so the gap has at most one zero
there, is > 0 before and < 0 after it, and gap' < 0 at it. Proof: by variation of constants,
h(t) = w + int_0^t (cos(eta s) - cot(eta t) sin(eta s)) a(phi + s) ds, and h'(t) is
eta / sin^2(eta t) times int_0^t sin(eta s) a(phi + s) ds < 0. At a zero, gap' = h' sin / eta.
If -A <= a <= -b < 0 there, the speed v at the impact has b / A <= (v / w)^2 <= A / b. Proof:
multiply gap'' + eta^2 gap = a by gap' and integrate, up to the peak, of height H, and from there:
w^2 - eta^2 H^2 and v^2 - eta^2 H^2 lie in [2 b H, 2 A H], so that v^2 <= 2 A H + eta^2 H^2 <=
(A / b) (2 b H + eta^2 H^2) <= (A / b) w^2, and the same with v and w exchanged. Without roots:
v <= w (1 + A / b) / 2, w <= v (1 + A / b) / 2, since sqrt(q) <= (1 + q) / 2.

Lemma 2 (chatter). Let -A <= a <= -b < 0 on [phi, T], 0 <= epsilon, r >= epsilon sqrt(A / b),
r < 1 and phi + 2 w / (b (1 - r)) <= T. Then all further impacts come at phases up to T; there
are none if w = 0 (the mass sticks), infinitely many if w > 0 and epsilon > 0. Proof: in flight
gap >= 0, so gap'' <= -b and gap <= w t - b t^2 / 2: as long as phases stay below T, an impact
comes within 2 w / b, and as in Lemma 1 its speed is v <= sqrt(A / b) w; v > 0, since gap'' < 0
while gap returns to 0. So the next bounce has w' = epsilon v <= r w, the times sum to at most
2 w / b (1 + r + r^2 + ...) = 2 w / (b (1 - r)), and the speeds tend to 0. At the limit of the
impacts the mass is at rest on the table, where a < 0: it sticks there, as long as a < 0.
"""

from __future__ import annotations

from fractions import Fraction

from proofs.trusted.certificate import Reader
from proofs.trusted.equations import AT_LAUNCH, Launch, clock, gap, launch, launch_acceleration
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
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved, rational
from proofs.trusted.kernel.context import Context
from proofs.trusted.numbers import Range
from proofs.trusted.paper.s34_circle.persistence import Chatter, SeparationFlight
from proofs.trusted.parameters import Parameters

_ZERO = Fraction(0)


def _side(of: Parameters) -> int:
    return 1 if of.nu > 0 else -1


def _launches(of: Parameters, phases: Range, bits: int) -> Launch:
    phi = Enclosure.of(*phases, bits)
    return launch(_side(of), rational(of.eta, bits), rational(of.nu, bits), phi)


def _accelerations(of: Parameters, phases: Range, bits: int = COVER_BITS) -> Range:
    """Enclose the launch acceleration over an interval of phases."""
    value: Enclosure = launch_acceleration(_launches(of, phases, bits))
    return value.range


def separation_flight(context: Context, reader: Reader) -> SeparationFlight:
    """Rule `separation-flight`: {separation: [l, u], times 0 < t_1 < ... < t_n, time}.

    Hypotheses: the launch acceleration is < 0 at l, > 0 at u, and increases on [l, u], so it
    vanishes at one phi_s there; for all launches in [l, u] with relative velocity 0,
    gap''' > 0 on [0, t_1]; open pieces as in rule `first-impact`, one interval that ends at
    t_n, with gap' < 0 on it; `time` lies in there, with gap > 0 at its lower, gap < 0 at its upper
    end. Conclusion: at phi_s gap, gap' and gap'' vanish, so that gap > 0 on (0, t_1], by linear
    interpolation up to the open pieces, and the first impact comes in `time`, after `turns` turns
    of the table less up to one.
    """
    separation_of, times_of, time_of = reader.fields("separation", "times", "time")
    separation, times = read_phases(separation_of), read_times(times_of)
    bits = bits_for(separation)
    motion = Motion(_side(context.of), context.of.eta, context.of.nu, separation, bits)
    _isolate(context.of, motion)
    windows, transversal = first_windows(motion.gap_of, times, 3)
    if not transversal:
        raise Unproved("an earlier impact is not excluded, or the gap not proved to fall")
    inner, time = bracketed(
        FirstImpact(context.of.place, motion, windows, True), separation, time_of
    )
    speed = (-inner.gap(inner.start(), time, 1)).range
    arrival = (separation[0] + time[0], separation[1] + time[1])
    turns = int((arrival[1] - separation[0]) // whole_turns(1, bits)[0]) + 1
    return SeparationFlight(separation, time, turns, lifted(arrival, -turns, bits), speed)


def _isolate(of: Parameters, motion: Motion) -> None:
    """Prove that the launch acceleration goes once from - to + in motion.phases."""
    low, high = (_accelerations(of, (end, end), motion.bits) for end in motion.phases)
    # at launch gap' = 0, so that gap''' is the derivative of the launch acceleration
    slope: Enclosure = gap(motion.start(), AT_LAUNCH, 3)
    if not (low[1] < 0 < high[0] and slope.lo > 0):
        raise Unproved("the separation phase is not isolated")


def chatter(context: Context, reader: Reader) -> Chatter:
    """Rule `chatter`: {flight, spread, cells: [{epsilon, bounces: [[t, t'], ...], ratio, rest}]}.

    `flight` names a separation-flight step; the cells' epsilons increase, 0 < e_1 < ... < e_n,
    and cell i is about [e_(i-1), e_i], e_0 = 0. Hypotheses: the launch acceleration is < 0 from
    `spread` before the step's impact phases to the lower end of `separation`; in each cell, from
    the states at most `spread` beside those of that impact, bounce after bounce has its impact in
    the bracket given, by Lemma 1; the one after the last bracket satisfies Lemma 2 with
    r = ratio and T = rest. Conclusion: `Chatter` for all epsilon in [0, e_n]; e_n <= r < 1, and
    rest < phi_s, since the launch acceleration is < 0 up to `rest`.
    """
    flight_of, spread_of, cells_of = reader.fields("flight", "spread", "cells")
    after = context.step(flight_of, SeparationFlight)
    spread = spread_of.number()
    states = [(low - spread, high + spread) for low, high in (after.impact, after.speed)]
    arc = (states[0][0], after.separation[0])
    if not (spread > 0 and states[1][0] > 0 and states[0][1] < arc[1]):
        raise Unproved("the states near the impact are not all in the sticking arc, with speed > 0")
    if _accelerations(context.of, arc, bits_for(after.separation))[1] >= 0:
        raise Unproved("the table does not push from the impact to the separation phase")
    begin, rests = _ZERO, []
    for cell in cells_of.items(least=1):
        epsilon_of, bounces, ratio, rest = cell.fields("epsilon", "bounces", "ratio", "rest")
        end = epsilon_of.number()
        if end <= begin:
            raise epsilon_of.fail("the coefficients must increase from 0")
        phases, speeds = states
        for bounce in bounces.items():
            kicks = begin * speeds[0], end * speeds[1]
            phases, speeds = _bounce(context.of, phases, kicks, bounce)
        rests.append(_settle(context.of, phases, end * speeds[1], (end, ratio.number()), rest))
        begin = end
    return Chatter(after, (_ZERO, begin), spread, max(rests))


def _bounce(of: Parameters, phases: Range, kicks: Range, bracket: Reader) -> tuple[Range, Range]:
    """Return the phases and speeds at the impacts after all bounces given, by Lemma 1.

    gap > 0 at t and gap < 0 at t' put the zero between them.
    """
    time = bracket.range()
    if time[0] <= 0 or of.eta * time[1] > 3:
        raise Unproved("a bounce is longer than its lemma allows")
    kick = Enclosure.of(*kicks, COVER_BITS) * _side(of)
    start = _launches(of, phases, COVER_BITS)._replace(kick=kick)

    def enclose(times: Range, order: int) -> Enclosure:
        now = clock(start.eta, Enclosure.of(*times, COVER_BITS))
        value: Enclosure = gap(start, now, order)
        return value

    if not brackets(enclose, time):
        raise Unproved("a bracket of an impact does not have the signs +, - at its ends")
    strong, weak = _accelerations(of, (phases[0], phases[1] + time[1]))
    if weak >= 0:
        raise Unproved("the table is not proved to push all through a bounce")
    (low, high), change = (-enclose(time, 1)).range, (1 + strong / weak) / 2
    speeds = max(low, kicks[0] / change), min(high, kicks[1] * change)
    return (phases[0] + time[0], phases[1] + time[1]), speeds


def _settle(
    of: Parameters, phases: Range, kick: Fraction, shrinking: Range, rest: Reader
) -> Fraction:
    """Return T, the hypotheses of Lemma 2 proved for all launches with at most this kick.

    shrinking: the largest epsilon, and r.
    """
    end, (epsilon, ratio) = rest.number(), shrinking
    if end <= phases[1] or not 0 < ratio < 1:
        raise Unproved("no phase of rest, or no ratio, for the chatter lemma")
    low, high = _accelerations(of, (phases[0], end))
    if high >= 0 or ratio**2 * -high < epsilon**2 * -low:
        raise Unproved("the speeds of the bounces are not proved to shrink by the ratio")
    if phases[1] + 2 * kick / (-high * (1 - ratio)) > end:
        raise Unproved("the bounces are not proved to end by the phase of rest")
    return end
