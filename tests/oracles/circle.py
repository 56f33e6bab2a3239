"""Judges of conclusions about the whole circle (section 3.4): sticking, landing, coming to rest."""

import math
from fractions import Fraction
from functools import lru_cache
from itertools import pairwise
from math import pi, sqrt

import flint

from tests.oracles import planar
from tests.oracles.motion import (
    TURN,
    Impact,
    ball,
    flight,
    inside,
    inside_mod,
    next_impact,
    separation,
    sticks,
    two_pi,
)
from tests.oracles.plastic import between, points, staying_set

_SAMPLE = 96
_LONGEST = 2.0e6  # time for which a flight that never impacts is watched
_LONG = 70_000.0  # the same, where many flights are followed


def _released(view):
    away = separation(view.eta, view.nu)
    if away is None:
        return None, None
    return away, flight(view.eta, view.nu, away, released=True)


def separation_arc(view, rng):
    """The sticking arc (3 pi - phi_s, phi_s), and the flight from phi_s."""
    away, found = _released(view)
    if away is None:
        return ["there is no separation phase"]
    told = []
    with flint.ctx.workprec(240):
        start = 3 * flint.arb.pi() - away
    if not inside(away, view.phase):
        told.append(f"phi_s is {away.str(20)}")
    if not inside_mod(start, view.start):
        told.append(f"3 pi - phi_s is {start.str(20)}")
    low, high = float(view.start[0]), float(view.phase[1])
    for k in range(24):
        beyond = (TURN * k / 24 - low) % TURN
        clear = min(beyond, abs(beyond - (high - low)), TURN - beyond) > 1e-6
        if clear and sticks(view.eta, view.nu, TURN * k / 24) != (beyond < high - low):
            told.append(f"at {TURN * k / 24:.6g} the mass sticks, or not, otherwise")
    if not isinstance(found, Impact):
        return told + ([f"the flight from phi_s: {found}"] if found else [])
    for name, own, given in (
        ("time", found.time, view.time),
        ("phase", found.turned(view.turns), view.arrival),
        ("speed", found.speed, view.speed),
    ):
        if not inside(own, given):
            told.append(f"the {name} of the impact is {own.str(15)}")
    arrival = float(found.turned(view.turns))
    if not float(away) - TURN * (1 if view.returns else 2) - 1e-9 < arrival < float(away):
        told.append("the impact is counted in another turn")
    if view.returns and not sticks(view.eta, view.nu, found.phase):
        told.append("the flight does not end in the sticking arc")
    return told


def lands(view, rng):
    """Launches that do not stick have their first impact where the mass sticks."""
    told = []
    for phase in points(view.phases, rng, 6):
        if sticks(view.eta, view.nu, phase):
            continue
        found = flight(view.eta, view.nu, phase)
        if isinstance(found, str):
            told.append(f"the launch at {float(phase):.9g}: {found}")
        if isinstance(found, Impact) and not sticks(view.eta, view.nu, found.phase):
            told.append(f"the launch at {float(phase):.9g} lands at {found.phase:.9g}")
    return told


def never_impacts(view, rng, count=2):
    """No zero of the gap before 2 pi q, on an interval of positive length."""
    if view.phases[0] >= view.phases[1]:
        return ["no interval: one phase at most"]
    told, q = [], Fraction(view.eta).denominator
    for phase in points(view.phases, rng, count):
        if sticks(view.eta, view.nu, phase):
            told.append(f"at {float(phase):.9g} the mass sticks")
            continue
        found = flight(view.eta, view.nu, phase, latest=min(_LONGEST, TURN * q - 0.01))
        if isinstance(found, Impact):
            told.append(f"the launch at {float(phase):.12g} has an impact at {found.time.str(12)}")
    return told


@lru_cache(maxsize=20_000)
def impacts_before_rest(eta, nu, phase, most):
    """How many impacts until one sticks, at most so many; None if it is not seen."""
    for n in range(most + 1):
        if sticks(eta, nu, phase):
            return n
        found = next_impact(eta, nu, Fraction(phase), _LONG)
        if found == "touches":
            return most + 1
        if not isinstance(found, Impact):
            return None
        phase = found.phase
    return most + 1


@lru_cache(maxsize=256)
def basin(eta, nu, most):
    """Sorted numbers of impacts before sticking, for phases spread over the circle."""
    phases = (TURN * ((k * 0.6180339887498949) % 1) for k in range(_SAMPLE))
    return [impacts_before_rest(eta, nu, phase, most) for phase in phases]


def absorption(view, rng):
    """Bounds of the measure that is not absorbed after n impacts; intervals that are."""
    told, most = [], len(view.rest) - 1
    counts = [n for n in basin(view.eta, view.nu, min(most, 12)) if n is not None]
    for n, bound in enumerate(view.rest[: min(most, 12) + 1]):
        share = sum(one > n for one in counts) / max(1, len(counts))
        error = 0.02 + 4 * sqrt(share * (1 - share) / max(1, len(counts)))
        if share * TURN > float(bound) + TURN * error:
            told.append(f"after {n} impacts about {share:.3g} of the circle is left")
        if n == most and share * TURN > float(view.open) + TURN * (error + 0.01):
            told.append(
                f"after {n} impacts {share:.3g} of the circle is not where it is said to be"
            )
    away = separation(view.eta, view.nu)
    if away is not None and float(view.rest[0]) < 3 * pi - 2 * float(away) + TURN - 1e-9:
        told.append("less is left at first than the phases that do not stick")
    chosen = view.within if len(view.within) < 6 else rng.sample(view.within, 6)
    for bounds, steps in chosen:
        for share in (0, rng.random(), rng.random(), 1):
            phase = float(between(bounds, Fraction(share)))
            if share in (0, 1):
                phase += (1 - 2 * share) * 1e-9 * float(bounds[1] - bounds[0])
            found = impacts_before_rest(view.eta, view.nu, phase, steps)
            if found is not None and found > steps:
                told.append(f"{phase:.12g} is not absorbed within {steps} impacts")
    return told + (sink(view.sink, rng) if view.sink else [])


def sink(view, rng):
    """No impact after phases of an interval, one at the outer ends; what comes there is not too
    much: not absorbed, but for chance.
    """
    told = never_impacts(view.never, rng, 1)
    (low, first), (last, high) = view.ends
    if (first, last) != tuple(view.never.phases):
        told.append("the brackets are not at the ends of the interval")
    for phase in (low, high):
        found = flight(view.eta, view.nu, phase, latest=_LONGEST)
        if found and not isinstance(found, Impact):
            told.append(f"after {float(phase):.12g}: {found}")
    counts = [n for n in basin(view.eta, view.nu, 12) if n is not None]
    share = sum(n <= 12 for n in counts) / max(1, len(counts))
    error = 0.02 + 4 * sqrt(share * (1 - share) / max(1, len(counts)))
    if not view.measure <= TURN * (1 - share + error):
        told.append(f"about {share:.3g} of the circle is absorbed")
    return told


def long_transients(view, rng):
    """Phases in the interval of a full shift stick, soon, and none there at once."""
    told = staying_set(view.shift, rng)
    ((low, high),) = view.shift.region
    if not low <= view.inside[0] < view.inside[1] <= high:
        told.append("phases outside of the interval")
    for phase in points((low, high), rng, 4):
        if sticks(view.eta, view.nu, phase):
            told.append(f"at {float(phase):.9g} the mass sticks")
    for phase in points(view.inside, rng, 4):
        count = impacts_before_rest(view.eta, view.nu, float(phase), view.steps)
        if count is not None and count > view.steps:
            told.append(f"{float(phase):.9g} does not stick within {view.steps} impacts")
    return told


def touching_family(view, rng):
    """Plastic flights from the phases never end, and leave the table at once."""
    return never_impacts(view, rng, 1)


def superstable_motion(view, rng):
    """The flight from phi_s, and states of the first box, go through the boxes to rest."""
    told, (low, high) = separation_arc(view.arc, rng), view.epsilons
    if not (view.rest < view.arc.phase[1] and 0 <= low <= high < 1 and high > 0):
        told.append("no time to come to rest before phi_s, or no coefficients of restitution")
    _, found = _released(view)
    if isinstance(found, Impact) and not (
        inside_mod(found.lifted, view.boxes[0][0]) and inside(found.velocity, view.boxes[0][1])
    ):
        told.append(f"the flight from phi_s leads to ({found.phase:.9g}, {float(found.velocity)})")
    for shares in ((0, 1, 1), (1, 1, 1), (rng.random(), rng.random(), rng.random())):
        *state, epsilon = map(between, (*view.boxes[0], view.epsilons), map(Fraction, shares))
        with flint.ctx.workprec(240):
            told += _through(view, ball(state[0]), ball(state[1]), epsilon)
    return told


def _through(view, phi, gamma, epsilon):
    """Follow a state of the first box through the others, and then bounces until they are tiny."""
    for target in view.boxes[1:]:
        found = flight(view.eta, view.nu, phi, epsilon, gamma)
        if not isinstance(found, Impact):
            return [f"in a box: {found}"] if found else []
        phi, gamma = found.lifted.mid(), found.velocity.mid()
        if not (inside_mod(phi, target[0]) and inside(gamma, target[1])):
            return [f"F leads to ({found.phase:.9g}, {float(gamma):.9g})"]
    phase = phi - math.ceil((float(phi) - float(view.arc.phase[1])) / TURN) * two_pi()
    speed = (1 if view.nu > 0 else -1) * (ball(view.eta) * gamma + ball(view.nu) * phi.cos())
    if not speed > 0:
        return ["a speed that is not positive"]
    return _bounces(view, (phase, speed), epsilon)


def _bounces(view, state, epsilon):
    """Follow impacts with a phase on the line and a relative speed, until they are tiny."""
    phase, speed = state
    side = 1 if view.nu > 0 else -1
    for _ in range(60):
        if phase > ball(view.rest):
            return [f"an impact at {phase.str(12)}, after the phase of rest"]
        if not sticks(view.eta, view.nu, phase):
            return [f"at {phase.str(9)} the table does not push"]
        if epsilon * Fraction(float(speed)) < Fraction(1, 10**9):
            return []
        # relative velocity before: X' - Z' = -side speed, X' = -eta gamma
        gamma = (side * speed - ball(view.nu) * phase.cos()) / ball(view.eta)
        found = flight(view.eta, view.nu, phase, epsilon, gamma)
        if not isinstance(found, Impact):
            return [f"after a bounce: {found}"] if found == "none" else []
        phase, speed = found.lifted.mid(), found.speed.mid()
    return []


def stable_cycle(view, rng):
    """F maps each box of states into the next but the last, F^k the first into itself."""
    if planar.is_of_a_file(view):
        return planar.stable_cycle(view, rng)
    phases = sorted(box[0] for box in view.boxes)
    told = ["the boxes meet"] if any(a[1] >= b[0] for a, b in pairwise(phases)) else []
    for _ in range(4):
        phi, gamma = (between(side, Fraction(rng.random())) for side in view.boxes[0])
        around = [*view.boxes[1:], *[None] * (len(view.boxes) * (view.rounds - 1)), view.boxes[0]]
        for target in around:
            found = flight(view.eta, view.nu, phi, view.epsilon, gamma)
            if isinstance(found, str):
                told.append(f"a state of the orbit: {found}")
            elif (
                found
                and target
                and not (inside_mod(found.lifted, target[0]) and inside(found.velocity, target[1]))
            ):
                told.append(f"F leads to ({found.phase:.9g}, {float(found.velocity):.9g})")
            if not isinstance(found, Impact):
                break
            phi, gamma = found.lifted.mid(), found.velocity.mid()
    return told


def two_attractors(view, rng, count=4):
    """Stable cycles for intervals of epsilon, one after the other, and the motion that rests."""
    told = superstable_motion(view.motion, rng)
    reached = view.box[2][0]
    for one, two in pairwise(view.cycles):
        if any(a[1] < b[0] or b[1] < a[0] for a, b in zip(one.boxes[0], two.boxes[0], strict=True)):
            told.append("two orbits")
    for cycle in view.cycles:
        if cycle.box[2][0] != reached or cycle.box[:2] != view.motion.box[:2]:
            told.append(f"no cycle from epsilon = {float(reached):.6g} on")
        reached = cycle.box[2][1]
    for cycle in rng.sample(view.cycles, min(count, len(view.cycles))):
        cycle.epsilon = between(cycle.box[2], Fraction(rng.random()))
        told += stable_cycle(cycle, rng)
    if not 0 < view.box[2][0] < reached == view.box[2][1] <= view.motion.epsilons[1]:
        told.append("not as far as said")
    return told


def passes(view, rng):
    """The bounces after the flight from phi_s: how many, until it is in flight at phi_s."""
    told, arc = separation_arc(view.arc, rng), view.arc
    side = 1 if view.nu > 0 else -1
    with flint.ctx.workprec(240):
        phase, speed = (ball(sum(ends) / 2) for ends in (arc.arrival, arc.speed))
        for count in range(80):
            if view.epsilon * Fraction(float(speed)) < Fraction(1, 10**12):
                return [*told, "it comes to rest"]
            gamma = (side * speed - ball(view.nu) * phase.cos()) / ball(view.eta)
            found = flight(view.eta, view.nu, phase, view.epsilon, gamma)
            if found is None:
                return told
            if not isinstance(found, Impact) or found.lifted > ball(arc.phase[1]):
                end = f"it is in flight at phi_s after {count} bounces"
                return told if count == view.bounces else [*told, end]
            phase, speed = found.lifted.mid(), found.speed.mid()
    return [*told, "bounces have no end"]


def border(view, rng):
    """The motion rests up to one epsilon, and at another, not at a third."""
    told = [
        *superstable_motion(view.motion, rng),
        *superstable_motion(view.rests, rng),
        *passes(view.passes, rng),
    ]
    (first, reached), rests = view.motion.epsilons, view.rests.epsilons
    if not first == 0 < reached <= rests[0] == rests[1] < view.passes.epsilon:
        told.append("no border")
    return told
