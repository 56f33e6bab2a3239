"""Beyond the paper: what can be proved about the motion at any parameters. Rows X1 to X4.

Horseshoes and attractors are found in floating point; what is not proved then is left out.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from fractions import Fraction
from types import MappingProxyType

from intervals import Undecided
from proofs.motion.candidate import next_impact
from proofs.motion.impact import HORIZON
from proofs.motion.system import System
from proofs.search.evidence import FAILED, Evidence, Proof, Tell
from proofs.search.s34_chaos import prove_entropy
from proofs.search.s34_circle import prove_arc
from proofs.search.shifts import full_shifts
from proofs.search.steps import Prover
from proofs.trusted.certificate import texts
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.paper.beyond.attractors import stable_orbit, sticking_motion
from proofs.trusted.paper.beyond.chaos import markov_set
from proofs.trusted.parameters import Parameters
from proofs.trusted.slopes import SlopeRange

_TRIES = 6  # of full shifts
_TURNS, _DEPTH = 150, 1  # of the flights, and of the tower of states, in covering graphs
_STARTS = 24  # phases whose orbits are followed
_IMPACTS = 200
_FARTHEST = 400.0  # the longest flight among them
_LONGEST = 60  # period
_NEAR = 1e-9
_RADIUS = 1e-5  # of the sets around the points of an orbit
_LEAST = 1e-3  # the least |f'| that radii follow
_THINNEST = 1e-12
_PLACES = 14
Part = tuple[str, SlopeRange]


def prove(
    of: Parameters,
    claims: Sequence[str],
    *,
    digits: int = 30,
    tell: Tell = lambda stage: None,
) -> Evidence:
    """Prove what the claims asked for rest on, as far as it goes."""
    prover = Prover(System(of.eta, of.nu), digits, HORIZON)
    found = Evidence(prover.steps, {claim: [] for claim in claims})
    for claim in claims:
        if claim not in _SEARCHES:
            continue
        stage, search = _SEARCHES[claim]
        tell(stage)
        try:
            with prover.undone():
                found.proofs[claim] = search(prover)
        except FAILED as failure:
            found.notes[claim] = str(failure)
    return found


def _cells(parts: Sequence[Part]) -> list[dict[str, object]]:
    return [{"slopes": name, "domain": texts(part.domain)} for name, part in parts]


# -- horseshoes ------------------------------------------------------------------------------------


def _chaos(prover: Prover) -> Proof:
    """Prove a full shift, or else a covering graph of positive entropy."""
    with suppress(*FAILED):
        return _full_shift(prover)
    graph = [x for x in prove_entropy(prover, _TURNS, _DEPTH) if x[1].growth > 1]
    if not graph:
        raise Undecided("no sets are seen that f maps over each other in several ways")
    return [*graph]


def _full_shift(prover: Prover) -> Proof:
    """Prove a full shift (rule markov-set), on the first sets that allow it."""
    failure = "no sets are seen with images across them all"
    for sets, _ in zip(full_shifts(prover.system), range(_TRIES), strict=False):
        try:
            with prover.undone():
                parts = [prover.slopes(list(domain)) for domain in sets]
                found = markov_set([part for _, part in parts])
                return [(prover.add("markov-set", {"cells": _cells(parts)}), found)]
        except FAILED as error:
            failure = str(error)
    raise Undecided(failure)


# -- attractors ------------------------------------------------------------------------------------


def _sticking(prover: Prover) -> Proof:
    """Follow the motion from the separation until it sticks again (rule sticking-motion)."""
    name, arc = prove_arc(prover)
    parts: list[Part] = []
    if not arc.returns:
        points = _orbit(prover.system, float(sum(arc.arrival)) / 2 % math.tau, _LONGEST)
        if points is None:
            raise Undecided(f"{_LONGEST} impacts after the separation the mass has not stuck")
        steep = math.prod(max(2 * abs(slope), 1.0) for _, slope in points)
        parts = _around(prover, points, min(_RADIUS, _LEAST / steep), 2.0)
    found = sticking_motion(arc, [part for _, part in parts])
    witness = {"separation": name, "cells": _cells(parts)}
    return [(prover.add("sticking-motion", witness), found)]


def _orbit(system: System, phase: float, most: int) -> list[tuple[float, float]] | None:
    """Return about the phases and slopes of an orbit that sticks in the end; None if not soon."""
    points: list[tuple[float, float]] = []
    while len(points) < most:
        found = next_impact(system, phase, _FARTHEST)
        if found is None:
            return points
        points.append((phase, found[2]))
        phase = found[1]
    return None


def _around(
    prover: Prover, points: Sequence[tuple[float, float]], radius: float, growth: float
) -> list[Part]:
    """Enclose f' on sets around the points of an orbit, each `growth` times the image before."""
    parts = []
    for phase, slope in points:
        if radius < _THINNEST:
            raise Undecided("the orbit is too steep for sets of the precision of floating point")
        parts.append(prover.slopes([_decimal(phase - radius), _decimal(phase + radius)]))
        radius *= growth * max(abs(slope), _LEAST)
    return parts


def _decimal(value: float) -> Fraction:
    return round(Fraction(value), _PLACES)


def _stable(prover: Prover) -> Proof:
    """Prove the stable orbits that orbits of many phases come to (rule stable-orbit)."""
    proof: list[tuple[str, Conclusion]] = []
    for points in _cycles(prover.system):
        with suppress(*FAILED), prover.undone():
            slope = math.prod(max(abs(slope), _LEAST) for _, slope in points)
            parts = _around(prover, points, _RADIUS, slope ** (-1 / len(points)))
            found = stable_orbit([part for _, part in parts])
            proof.append((prover.add("stable-orbit", {"cells": _cells(parts)}), found))
    if not proof:
        raise Undecided("no orbit is seen to come to a stable one without sticking")
    return proof


def _cycles(system: System) -> Iterator[list[tuple[float, float]]]:
    """Yield about the phases and slopes of stable orbits, each once."""
    seen: list[float] = []
    for k in range(_STARTS):
        phase = math.tau * (k + 0.5) / _STARTS
        for _ in range(_IMPACTS):
            found = next_impact(system, phase, _FARTHEST)
            touches = found is not None and abs(found[2] - 1) < _NEAR  # and so on for ever
            if found is None or touches or any(abs(found[1] - x) < _RADIUS for x in seen):
                break
            phase = found[1]
        else:
            points = _cycle(system, phase)
            if points:
                seen += [phase for phase, _ in points]
                yield points


def _cycle(system: System, phase: float) -> list[tuple[float, float]] | None:
    """Return the points of a stable cycle that a phase is on; None if it is on none."""
    points, start = [], phase
    for _ in range(_LONGEST):
        found = next_impact(system, phase, _FARTHEST)
        if found is None:
            return None
        points.append((phase, found[2]))
        phase = found[1]
        if abs(phase - start) < _NEAR:
            return points if abs(math.prod(slope for _, slope in points)) < 1 else None
    return None


_SEARCHES: Mapping[str, tuple[str, Callable[[Prover], Proof]]] = MappingProxyType(
    {
        "X2": ("horseshoes", _chaos),
        "X3": ("motions that stick", _sticking),
        "X4": ("stable orbits that do not", _stable),
    }
)
