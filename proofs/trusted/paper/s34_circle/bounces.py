"""Bounces on the arc of phases where the table pushes the mass, and the chatter that ends them.

A bounce, here, is a launch at a phase phi with a relative velocity w >= 0 away from the table,
where the table pushes: let a(psi) be the launch acceleration of a mass at rest on the table at
phase psi, negative on the sticking arc. In flight gap'' = a(phi + t) - eta^2 gap, since
X'' = -eta^2 X for the mass, and a is the value of gap'' where gap = 0. Phases are on the line.
"""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from functools import partial
from math import isqrt

from proofs.trusted.equations import closing, launch_acceleration
from proofs.trusted.flights import Motion, lifted
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.gaps import Gap, brackets
from proofs.trusted.numbers import COVER_BITS, Range
from proofs.trusted.paper.s34_circle.landing import Separation
from proofs.trusted.parameters import Place

_WIDENINGS, _RATIO_UNITS, _PHASE_UNITS = 7, 2**10, 2**128
State = tuple[Range, Range]  # phases and relative speeds of impacts
Box = tuple[Range, Range]  # phases x velocities


def push(at: Place, phases: Range, bits: int = COVER_BITS) -> Range:
    """Bound a from below and above."""
    acceleration: Enclosure = launch_acceleration(Motion(at, phases, bits).start)
    return acceleration.range


def kicked(at: Place, phases: Range, kicks: Range, bits: int = COVER_BITS) -> Gap:
    """Return the gap, by time and order, after launches with these relative velocities."""
    motion = Motion(at, phases, bits)
    kick = Enclosure.of(*kicks, bits) * motion.side
    return partial(motion.gap, motion.start._replace(kick=kick))


def bounce(at: Place, phases: Range, kicks: Range, time: Range, bits: int = COVER_BITS) -> State:
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
    if time[0] <= 0 or at.eta[1] * time[1] > 3:
        raise Unproved("a bounce is longer than its lemma allows")
    gap_of = kicked(at, phases, kicks, bits)
    if not brackets(gap_of, time):
        raise Unproved("a bracket of an impact does not have the signs +, - at its ends")
    strong, weak = push(at, (phases[0], phases[1] + time[1]), bits)
    if weak >= 0:
        raise Unproved("the table is not proved to push all through a bounce")
    (low, high), change = (-gap_of(time, 1)).range, (1 + strong / weak) / 2
    speeds = max(low, kicks[0] / change), min(high, kicks[1] * change)
    return (phases[0] + time[0], phases[1] + time[1]), speeds


def bounced(at: Place, state: State, epsilons: Range, times: Iterable[Range], bits: int) -> State:
    """Return phases and speeds of impacts after these and one bounce more for each bracket."""
    for time in times:
        phases, (slow, fast) = state
        state = bounce(at, phases, (epsilons[0] * slow, epsilons[1] * fast), time, bits)
    return state


def rest_phase(
    at: Place, phases: Range, kick: Fraction, epsilon: Fraction, last: Fraction
) -> Fraction | None:
    """Lemma 2 (chatter). Let -A <= a <= -b < 0 on [phi, T], 0 <= epsilon, r >= epsilon sqrt(A / b),
    r < 1 and phi + 2 w / (b (1 - r)) <= T. Then all further impacts come at phases up to T; there
    are none if w = 0 (the mass sticks), infinitely many if w > 0 and epsilon > 0.

    Proof. In flight gap >= 0, so gap'' <= -b and gap <= w t - b t^2 / 2: as long as phases stay
    below T, an impact comes within 2 w / b, and as in Lemma 1 its speed is v <= sqrt(A / b) w;
    v > 0, since gap'' < 0 while gap returns to 0. So the next bounce has w' = epsilon v <= r w, the
    times sum to at most 2 w / b (1 + r + r^2 + ...) = 2 w / (b (1 - r)), and the speeds tend to 0.
    At the limit of the impacts the mass is at rest on the table, where a < 0: it sticks there, as
    long as a < 0.

    Return such a T below `last`, for phi in `phases`, w at most `kick` and all coefficients up to
    epsilon, None if none is found: from below, since the longer the arc, the weaker its push.
    """
    rest = phases[1]
    for _ in range(_WIDENINGS):
        strong, weak = push(at, (phases[0], rest))
        if weak >= 0:
            return None
        square = (epsilon**2 * strong / weak * _RATIO_UNITS**2).__ceil__()
        ratio = Fraction(isqrt(max(square - 1, 0)) + 1, _RATIO_UNITS)
        if ratio >= 1:
            return None
        length = 2 * kick / (-weak * (1 - ratio))
        if phases[1] + length <= rest < last:
            return rest
        rest = phases[1] + length * Fraction(17, 16)
        rest = Fraction((rest * _PHASE_UNITS).__ceil__(), _PHASE_UNITS)
    return None


# -- on the arc where the mass sticks --------------------------------------------------------------


def _speeds(at: Place, phases: Range, gammas: Range, bits: int) -> Range:
    """Enclose the relative speeds before impacts at these phases and velocities."""
    motion = Motion(at, phases, bits)
    speed: Enclosure = closing(motion.start, Enclosure.of(*gammas, bits)) * motion.side
    return speed.range


def starts(arc: Separation, box: Box, bits: int) -> bool:
    """Whether the state at which the flight from phi_s ends is proved inside a box."""
    for turns in (0, 1):
        phases = lifted(arc.arrival, turns, bits)
        if box[0][0] < phases[0] and phases[1] < box[0][1]:
            slow, fast = sorted(_speeds(arc.at, phases, (x, x), bits) for x in box[1])
            return slow[1] < arc.speed[0] and arc.speed[1] < fast[0]
    return False


def landed(arc: Separation, box: Box, bits: int) -> State:
    """Return phases, on the line, and relative speeds of a box of impacts; raise Unproved unless
    they are inside the arc where the mass sticks, and positive.
    """
    for turns in (0, -1):
        phases = lifted(box[0], turns, bits)
        if arc.start[1] < phases[0] and phases[1] < arc.phase[0]:
            speeds = _speeds(arc.at, phases, box[1], bits)
            if speeds[0] <= 0:
                raise Unproved("a speed is not proved to be positive")
            return phases, speeds
    raise Unproved("an impact is not proved to be where the mass sticks")
