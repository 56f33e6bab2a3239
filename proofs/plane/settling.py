"""Attractors: rest, motions that stick, stable orbits, for boxes of oscillators."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from contextlib import suppress
from fractions import Fraction
from itertools import islice
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from intervals import Undecided
from proofs.motion.many import next_impacts, separation_phases
from proofs.motion.simulate import next_impact
from proofs.motion.system import System
from proofs.plane.steps import Steps, corners
from proofs.trusted.certificate import texts
from proofs.trusted.equations import clock, gap, launch, launch_acceleration
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.differential import BITS, sharp_values
from proofs.trusted.kernel.enclose import enclosed
from proofs.trusted.numbers import TURN, Range, bits_for, hull
from proofs.trusted.oscillator import SEPARATES, PlasticMap
from proofs.trusted.paper.beyond.attractors import AtRest
from proofs.trusted.parameters import Place

Floats = NDArray[np.float64]
_FARTHEST = 70.0
_SOON = 3 / 7  # eta at most, where all masses seem to stick
_SOONER = 7  # than two turns
_PLACES = 6  # decimals of phases
_ROOM = Fraction(1, 10**5)  # around phases that are seen
_MOST_IMPACTS = 12
_LATER = 1e-3  # after the separation, where floats tell that the mass leaves
_GRID, _TRANSIENT = 600, 64  # phases whose orbits are followed, and for how long
_CLOSER, _TRIES = 80, 3
_NEAR = 1e-6
_SAMPLES = 5  # of a set
_SHARE, _LARGER = 0.15, 1.05  # of cells, for what enclosures are wider
_AFTER, _BEYOND, _MORE, _APART = 0.004, 0.35, 0.3, 2.5  # launches beyond the arc
_SHORT = 2.9  # of eta times how long the mass flies until it lands on the arc


class Cell(NamedTuple):
    """A cell of phases in the certificate, and where f sends it."""

    witness: dict[str, Any]
    image: Range


def propose(box: Place) -> Iterator[Steps]:
    """Yield certificates that seem to prove an attractor all over a box.

    Where the motion from the separation seems to stick again at the centre, smaller boxes will have
    a proof of that, and stable orbits, which take longer, are not looked for.
    """
    with suppress(Undecided):
        yield rests(box)
        return
    try:
        _rehearse(box)
        yield sticks(box)
    except Undecided:
        if _sticks_at_centre(box):
            raise
    yield stays_stable(box)


def _rehearse(box: Place) -> None:
    """Follow motions from the separation, at the centre and the corners of a box, in fixed sets.

    Raises Undecided where they do not seem to come back to the arc, or to contract, so.
    """
    seen, (etas, nus), steep = _separations(box), corners(box), 1.0
    phases = (seen + _LATER)[None, :]
    for _ in range(_MOST_IMPACTS + 1):
        _, images, slopes, _ = next_impacts(box.side, etas, nus, phases, _FARTHEST)
        steep *= float(np.abs(slopes).max()) if len(phases) > 1 else 1.0
        low, high = float(images.min()), float(images.max())
        if not high - low < _APART:
            raise Undecided("motions from the separation differ too much over the box")
        if target := _target(box, low, high):
            break
        phases = np.linspace(low, high, _SAMPLES)[:, None] - math.tau * (low // math.tau)
    else:
        raise Undecided("the mass is not seen to stick again soon")
    last = target[1] + _MORE * (target[1] - float(seen.max()))
    if last > float(seen.min()):
        launches = np.maximum(last, seen + _LATER)
        slopes = next_impacts(box.side, etas, nus, launches, _FARTHEST).slopes
        if not steep * float(np.abs(slopes).max()) < 1:
            raise Undecided("motions from just after the separation do not come back closer")


def _sticks_at_centre(box: Place) -> bool:
    """Whether the motion from the separation seems to stick again soon, at the centre of a box."""
    (eta, last), (nu, most) = box.eta, box.nu
    system = System((eta + last) / 2, (nu + most) / 2)
    try:
        phase = float(_separations(Place.plastic(system.eta, system.nu))[0]) + _LATER
    except Undecided:
        return False
    for _ in range(_MOST_IMPACTS):
        impact = next_impact(system, phase, _FARTHEST)
        if impact is None:
            return bool(launch_acceleration(system.launched(phase)) <= 0)
        phase = impact.phase
    return False


def rests(box: Place) -> Steps:
    """Return the steps where the mass is at rest."""
    made = Steps(box)
    try:
        AtRest(box)
    except Unproved as failure:
        raise Undecided(str(failure)) from None
    made.add("sticking-motion", _witness(None))
    return made


def settles(box: Place) -> Steps:
    """Return the steps where all motions rest or stick; Undecided where they seem to go on."""
    with suppress(Undecided):
        return rests(box)
    if box.nu[0] < 0 or box.eta[1] > _SOON:
        raise Undecided("not all motions are seen to come to rest, or to stick")
    made = Steps(box)
    name, _, arrival = _separation(made)
    early, last = _target(box, *map(float, arrival)) or (0.0, math.inf)
    later = last > float(_separations(box).min()) or float(arrival[1]) - last > _SOONER
    if early is not None or later:
        raise Undecided("the flight from the separation is not seen to end soon on the arc")
    made.add("sticking-motion", _witness(name))
    return made


def _witness(
    separation: str | None,
    cells: Sequence[Cell] = (),
    beyond: Cell | None = None,
    landing: str | None = None,
) -> dict[str, Any]:
    """Write what the rule `sticking-motion` reads."""
    return {
        "separation": separation,
        "cells": [cell.witness for cell in cells],
        "beyond": beyond and beyond.witness,
        "landing": landing,
    }


# -- motions that stick ----------------------------------------------------------------------------


def sticks(box: Place) -> Steps:
    """Return the steps for rule `sticking-motion`.

    Where the last impact seems to come after the arc at some oscillators, launches up to there are
    followed as well.
    """
    up_to = None
    for _ in range(_TRIES):
        made, last = _returning(box, up_to)
        if last is None:
            return made
        up_to = last + _MORE * (last - float(_separations(box).max()))
    raise Undecided("impacts come ever later after the arc")


def _returning(box: Place, up_to: float | None) -> tuple[Steps, float | None]:
    """Follow the motion from the separation, and launches up to a phase after it, until it returns.

    Return the steps; and where there is a last impact after that phase, where it is.
    """
    made = Steps(box)
    after = 0.0 if up_to is None else _AFTER + 2 * float(np.ptp(_separations(box)))
    name, start, arrival = _separation(made, after)
    beyond, cells = None, list[Cell]()
    if up_to is not None:
        up_to = max(up_to, float(start) + _AFTER)
        beyond = _cell(made, _rounded(float(start) - _AFTER / 4, up_to))
        arrival = hull([arrival, beyond.image])
    while not (target := _target(box, *map(float, arrival))):
        if len(cells) == _MOST_IMPACTS:
            raise Undecided("the mass is not seen to stick again soon")
        cells.append(_cell(made, _rounded(*map(float, arrival))))
        arrival = cells[-1].image
    early, last = target
    if last > (up_to or float(_separations(box).min())):
        return made, last
    landing = None
    if early is not None:
        cuts = _rounded(early, float(_start(box).max()) + after + _AFTER)
        landing = made.add("lands", {"separation": name, "cuts": texts(cuts), "turns": "0"})
    made.add("sticking-motion", _witness(name, cells, beyond, landing))
    return made, None


def _target(box: Place, low: float, high: float) -> tuple[float | None, float] | None:
    """Return the ends of where last impacts seem to be, in the turn of the arc; None if elsewhere.

    The first is None where it is on the arc; else launches from there land on the arc next.
    """
    seen, start, (etas, nus) = _separations(box), _start(box), map(np.array, corners(box))
    turns = math.ceil((high - float(seen.max()) - _BEYOND) / math.tau)
    low, high = low - math.tau * turns, high - math.tau * turns
    if low > float(start.max()):
        return None, high
    heights = gap(launch(box.side, etas, nus, low), clock(etas, seen - low))
    if low > 0 and (etas * (seen - low)).max() < _SHORT and (heights < 0).all():
        return low, high
    return None


def _separations(box: Place) -> Floats:
    """Return about the phases at which the mass leaves, at the centre and the corners of a box."""
    phases = separation_phases(*map(np.array, corners(box))) % math.tau
    if not np.isfinite(phases).all():
        raise Undecided("the mass sticks nowhere, or everywhere, at some of the oscillators")
    return phases


def _start(box: Place) -> Floats:
    """Return about the phases at which the mass begins to stick, in the turn before it leaves."""
    seen = _separations(box)
    return np.asarray(math.pi * (1 + 2 * ((seen / math.pi - 0.5) // 1)) - seen)


def _separation(made: Steps, after: float = 0) -> tuple[str, Fraction, Range]:
    """Add the separation, with launches until some time after it.

    Return its name, the last phase, and where there are impacts next, as phase + time.
    """
    seen, (etas, nus) = _separations(made.box), corners(made.box)
    phase = _rounded(float(seen.min()), float(seen.max()) + after)
    if phase[1] > TURN:
        raise Undecided("the mass leaves the table next to phase 0")
    flown = next_impacts(made.box.side, etas, nus, float(phase[1]) + _LATER, _FARTHEST).times
    if not np.isfinite(flown).all():
        raise Undecided("a flight from the separation is not seen to end")
    f = PlasticMap(made.box, Fraction(_FARTHEST), SEPARATES)
    try:
        time = f.impact(enclosed((phase,), bits_for(phase))).range
    except Unproved as error:
        raise Undecided(str(error)) from None
    name = made.add("separation", {"phase": texts(phase)})
    return name, phase[1], (phase[0] + time[0], phase[1] + time[1])


def _rounded(low: float, high: float) -> Range:
    """Return decimals around phases on the line, with some room, from the turn of the lower one."""
    turns = math.tau * ((low - float(_ROOM)) // math.tau)
    ends = (Fraction(low - turns) - _ROOM, Fraction(high - turns) + _ROOM)
    rounded = round(ends[0], _PLACES), round(ends[1], _PLACES)
    if not 0 <= rounded[0] < rounded[1] <= rounded[0] + _APART or rounded[0] > TURN:
        raise Undecided("an interval of phases is too wide")
    return rounded


# -- cells, and orbits that do not stick -----------------------------------------------------------


def _cell(made: Steps, phases: Range) -> Cell:
    """Add what encloses f' on a cell (rule slopes), f being monotone."""
    map_ = PlasticMap(made.box, Fraction(_FARTHEST))
    try:
        map_.impact(enclosed((phases,), BITS))  # in whose times those at the ends are looked for
        images = [sharp_values(map_, enclosed(((x, x),), BITS))[0].range for x in phases]
    except Unproved as error:
        raise Undecided(str(error)) from None
    function = {"eta": texts(made.box.eta), "nu": texts(made.box.nu)}
    witness = {"function": function, "points": texts(phases), "bits": str(BITS)}
    name = made.add("slopes", witness)
    return Cell({"slopes": name, "domain": texts(phases)}, hull(images))


def stays_stable(box: Place) -> Steps:
    """Return the steps for rule `stable-orbit`."""
    failure = "no stable orbit is seen all over the box"
    for orbit in _orbits(box):
        made = Steps(box)
        try:
            cells = [_cell(made, phases) for phases in orbit]
        except Undecided as error:
            failure = str(error)
            continue
        made.add("stable-orbit", {"cells": [cell.witness for cell in cells]})
        return made
    raise Undecided(failure)


def _orbits(box: Place) -> Iterator[list[Range]]:
    """Yield cells around stable orbits that are seen at the centre and the corners of a box."""
    etas, nus = corners(box)
    for cycle in islice(_cycles(box.side, etas[0], nus[0]), _TRIES):
        phases = np.array([cycle] * len(etas)).T
        for _ in range(_CLOSER):
            impacts = next_impacts(box.side, etas, nus, phases, _FARTHEST)
            before, phases = phases, _next_to(phases, np.roll(impacts.images, 1, axis=0))
            moved = float(np.abs(phases - before).max())
            if not moved > _NEAR:
                break
        steep = np.abs(impacts.slopes)
        if moved <= _NEAR and (steep.prod(axis=0) < 1).all():
            phases = _next_to(phases[:, :1], phases)
            apart = np.abs(_next_to(phases[0], phases[1:]) - phases[0]).max(axis=1)
            period = 1 + int(np.append(np.flatnonzero(apart < 100 * _NEAR), len(apart))[0])
            yield _cells(phases[:period], impacts.slopes[:period])


def _next_to(phases: Floats, others: Floats) -> Floats:
    """Return other phases in the turns that bring them next to these."""
    return np.asarray(others - math.tau * np.round((others - phases) / math.tau))


def _cycles(sign: int, eta: float, nu: float) -> Iterator[list[float]]:
    """Yield cycles of a grid of phases, each sent to the one next to its image, that contract."""
    phases = math.tau * (np.arange(_GRID) + 0.5) / _GRID
    impacts = next_impacts(sign, eta, nu, phases, _FARTHEST)
    none = np.isnan(impacts.images)
    onward = np.where(none, 0, impacts.images % math.tau / math.tau * _GRID).astype(int) % _GRID
    onward = np.append(np.where(none, _GRID, onward), _GRID)
    points = np.arange(_GRID)
    for _ in range(_TRANSIENT):
        points = onward[points]
    seen = {_GRID}
    for start in np.unique(points).tolist():
        cycle, here = [], start
        while here not in seen:
            seen.add(here)
            cycle.append(here)
            here = int(onward[here])
        if cycle and here == start and np.abs(impacts.slopes[cycle]).prod() < 1:
            yield [float(phases[k]) for k in cycle]


def _cells(points: Floats, slopes: Floats) -> list[Range]:
    """Return intervals around the points of orbits, wide enough to be sent into the next."""
    low, high, steep = points.min(axis=1), points.max(axis=1), np.abs(slopes).max(axis=1)
    rising_fixed_point = len(points) == 1 and slopes.min() > 0  # what is lowest stays lowest
    apart = 0 if rising_fixed_point else high - low
    least = 2 * float(_ROOM) + _SHARE * (high - low)
    room = least
    for _ in range(_TRANSIENT):  # f sends what is w + r from an orbit to s (w + r) from the next
        room = np.maximum(room, np.roll(steep * (apart + _LARGER * room), 1) + least)
        if room.max() > 1:
            raise Undecided("a stable orbit moves too much over the box")
    return [_rounded(float(a - r), float(b + r)) for a, b, r in zip(low, high, room, strict=True)]
