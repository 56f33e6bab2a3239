"""Judges of what is said at any parameters: rest, shifts, motions that stick, stable orbits."""

from fractions import Fraction
from itertools import pairwise
from math import prod

import numpy as np

from tests.oracles.circle import _released, separation_arc
from tests.oracles.motion import TURN, Impact, flight, inside, next_impact, sticks
from tests.oracles.plastic import _impact, points


def _pushes(view, count=720):
    return [sticks(view.eta, view.nu, TURN * k / count) for k in range(count)]


def at_rest(view, rng):
    """The table pushes a mass at rest at every phase, but perhaps for one."""
    return [] if _pushes(view).count(False) <= 1 else ["at some phases the mass leaves"]


def leaves(view, rng):
    """At some phase the mass leaves."""
    return [] if not all(_pushes(view)) else ["at no phase that is looked at the mass leaves"]


def never_sticks(view, rng):
    """At no phase the mass sticks, but perhaps for one."""
    return [] if _pushes(view).count(True) <= 1 else ["at some phases the mass sticks"]


def only_touches(view, rng):
    """After launches all around the mass comes back to the table without relative velocity."""
    found = [next_impact(view.eta, view.nu, Fraction(k) / 2, 7) for k in range(12)]
    told = [x for x in found if x != "touches"]
    return [f"not a touch: {told[0]}"] if told else []


def flights_end(view, rng):
    """After launches all around, the gap is below 0 before so many turns, or the mass sticks."""
    told = []
    for k in range(12):
        found = next_impact(view.eta, view.nu, Fraction(k) / 2, TURN * view.eta.denominator)
        if found in ("touches", "none"):
            told.append(
                f"after a launch at {k / 2} there is no impact in {view.eta.denominator} turns"
            )
    return told


def comes_to_rest(view, rng):
    """The table pushes at all phases; after impacts at random each rebound is weaker."""
    if not all(_pushes(view, 180)):
        return ["at some phase the mass leaves"]
    side = 1 if view.nu > 0 else -1
    for _ in range(3):
        phase, speed = Fraction(rng.random()) * 6, rng.uniform(0.01, 2)
        for _ in range(200):
            rate = float(view.nu) * np.cos(float(phase))
            gamma = Fraction((side * speed - rate) / float(view.eta))
            found = flight(view.eta, view.nu, phase, view.epsilon, gamma)
            if view.epsilon * Fraction(speed) < 1e-5 or not isinstance(found, Impact):
                break
            if found.speed > speed * (1 + 1e-9):
                return ["a rebound is no weaker than the one before"]
            phase, speed = Fraction(found.phase), float(found.speed)
        if found in ("none", "touches"):
            return [f"after a rebound: {found}"]
    return []


def all_stick(view, rng):
    """After an impact the mass sticks, or at the latest after its next one."""
    told = separation_arc(view.arc, rng)
    for phase in [Fraction(k, 8) for k in range(51)]:
        if not sticks(view.arc.eta, view.arc.nu, float(phase)):
            found = next_impact(view.arc.eta, view.arc.nu, phase)
            if isinstance(found, Impact) and not sticks(view.arc.eta, view.arc.nu, found.phase):
                told.append(f"after an impact at {found.phase:.9g} the mass does not stick")
    return told


def _in_cell(phase, cell, slack=1e-9):
    low, high = float(cell[0]) - slack, float(cell[1]) + slack
    return any(low < phase + TURN * k < high for k in (0, 1))


def sticking_motion(view, rng):
    """The flight from the separation, impacts in the cells in turn, the last where it sticks."""
    told = separation_arc(view.arc, rng)
    _, found = _released(view.arc)
    for cell in view.cells:
        if not isinstance(found, Impact):
            return told
        if sticks(view.arc.eta, view.arc.nu, found.phase) or not _in_cell(found.phase, cell):
            return [*told, f"an impact at {found.phase:.12g}, not in {cell}"]
        found = next_impact(view.arc.eta, view.arc.nu, Fraction(found.phase))
    if isinstance(found, Impact) and not _comes_to_stick(view, found.phase):
        told.append(f"the last impact, at {found.phase:.12g}, does not stick")
    return told


def sticks_once(view, rng):
    """The flight from the separation, impacts in the cells, then in the orbit's, or none."""
    told = separation_arc(view.arc, rng)
    _, found = _released(view.arc)
    orbit = getattr(view.end, "cells", ())
    sets = [[cell] for cell in view.cells] + ([orbit] * 60 if orbit else [[view.end.phases]])
    for near in sets:
        if not isinstance(found, Impact):
            return told
        if sticks(view.arc.eta, view.arc.nu, found.phase):
            return [*told, f"the mass sticks at {found.phase:.12g}"]
        if not any(_in_cell(found.phase, cell) for cell in near):
            return [*told, f"an impact at {found.phase:.12g}, not in {near}"]
        found = next_impact(view.arc.eta, view.arc.nu, Fraction(found.phase))
    if not orbit and isinstance(found, Impact):
        told.append(f"one more impact, at {found.phase:.12g}")
    return told


def _comes_to_stick(view, phase):
    """Whether the mass sticks at an impact, or, if a landing is said, at the next one."""
    eta, nu = view.arc.eta, view.arc.nu
    if sticks(eta, nu, phase) or view.landing is None:
        return sticks(eta, nu, phase)
    found = next_impact(eta, nu, Fraction(phase))
    return not isinstance(found, Impact) or sticks(eta, nu, found.phase)


def returning_motion(view, rng):
    """Flights from phi_s and from the last phase come back there, or stick, and are closer then."""
    told, back, (away, first) = separation_arc(view.arc, rng), [], _released(view.arc)
    last = float(view.beyond.points[-1]) - float(away)
    for found in (first, next_impact(view.arc.eta, view.arc.nu, view.beyond.points[-1])):
        impacts = [found]
        for cell in view.cells:
            if not isinstance(impacts[-1], Impact):
                return told
            if not _in_cell(impacts[-1].phase, cell):
                told.append(f"an impact at {impacts[-1].phase:.12g}, not in {cell}")
            impacts.append(next_impact(view.arc.eta, view.arc.nu, Fraction(impacts[-1].phase)))
        if not isinstance(impacts[-1], Impact):
            return told
        phase = impacts[-1].phase
        late = (phase - float(away)) % TURN
        if late > last + 1e-9 and not _comes_to_stick(view, phase):
            told.append(f"a last impact at {phase:.12g}")
        back.append(late if late < last else 0.0)
    if not view.contraction < 1 or abs(back[1] - back[0]) > view.contraction * last + 1e-9:
        told.append(f"they come back {back[1] - back[0]:.9g} apart")
    return told


def stable_orbit(view, rng):
    """Cells that are apart, mapped into each other in turn; the product of slopes is bounded."""
    told, cells, slopes = [], view.cells, []
    around = [*sorted(cells), *((low + TURN, high) for low, high in sorted(cells)[:1])]
    if any(b[0] <= a[1] for a, b in pairwise(around)):
        told.append("the cells overlap")
    if not view.contraction[1] < 1:
        told.append("no contraction is said")
    for cell, after in zip(cells, (*cells[1:], *cells[:1]), strict=True):
        for phase in points(cell, rng, 1):
            found = _impact(view, phase)
            if not isinstance(found, Impact):
                told += [f"the launch at {float(phase):.12g}: {found}"] if found else []
            elif not _in_cell(found.phase, after):
                told.append(f"f({float(phase):.12g}) = {found.phase:.12g}, not in the next cell")
            elif phase == sum(cell) / 2:
                slopes.append(abs(found.slope))
    if len(slopes) == len(cells) and not inside(prod(slopes), view.contraction, 1e-9):
        told.append(f"the multiplier is about {float(prod(slopes)):.9g}")
    return told
