"""Attractors at any parameters: motions that stick, and stable orbits that do not. Rows X3, X4.

Found in floating point; what is not proved then is left out.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction
from itertools import takewhile
from typing import TypeVar

from intervals import DomainError, Undecided
from proofs.motion.single_orbits import last_period, solutions
from proofs.motion.system import System
from proofs.search.budget import Budget
from proofs.search.evidence import FAILED, Proof
from proofs.search.orbits import (
    FALLS,
    RISES,
    STICKS,
    Seen,
    follow,
    multiplier,
    stable_cycle,
)
from proofs.search.s34_circle import prove_arc, prove_longest
from proofs.search.steps import Prover
from proofs.trusted.certificate import texts
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.laps import SlopeRange
from proofs.trusted.kernel.loops import StableOrbit
from proofs.trusted.numbers import Range
from proofs.trusted.paper.beyond.attractors import AllStick
from proofs.trusted.paper.s34_circle.landing import Separation

_LONGEST = 200  # motion from the separation
_DOUBLINGS = 20  # of sets along it, beside the slopes
_RADIUS = 1e-5  # of the sets around the points of an orbit
_WIDE = 0.03, 0.01, 1e-3, 1e-4  # and of those around a stable one that others are to come to
_MOST_PERIODS, _BITS = 30, 60  # of orbits with one impact, that are looked for in closed form
_LEAST = 1e-3  # the least |f'| that radii follow
_THINNEST = 1e-12
_PLACES = 14
Part = tuple[str, SlopeRange]
_Made = TypeVar("_Made", bound=Conclusion)


@dataclass(frozen=True)
class Run:
    """One run: its prover and its budget."""

    prover: Prover
    budget: Budget

    @property
    def system(self) -> System:
        """The oscillator."""
        return self.prover.system

    @property
    def arc(self) -> tuple[str, Separation]:
        """Where the mass sticks, proved once."""
        return next(iter(self.made(Separation)), None) or prove_arc(self.prover)

    def made(self, kind: type[_Made]) -> list[tuple[str, _Made]]:
        """Return the steps so far with a conclusion of a kind."""
        return [(name, x) for name, x in self.prover.known.items() if isinstance(x, kind)]


def cells(parts: Sequence[Part]) -> list[dict[str, object]]:
    """Return sets of slopes as witnesses name them."""
    return [{"slopes": name, "domain": texts(part.domain)} for name, part in parts]


def settled(run: Run) -> Proof:
    """Prove where the mass separates, if from there on it sticks at each impact."""
    with suppress(*FAILED), run.prover.undone():
        step = run.arc
        AllStick(step[1])
        return [step]
    return []


def sticking(run: Run) -> Proof:
    """Follow the motion from the separation until it sticks again, or comes to what never does."""
    prover, budget = run.prover, run.budget
    name, arc = run.arc
    landing, reach = None, _LEAST
    orbit: list[Seen] = []
    if not arc.returns:
        start = float(sum(arc.arrival)) / 2 % math.tau
        orbit = [*follow(run.system, start, budget.farthest, budget.impacts)]
        if orbit[-1].kind != STICKS:
            landing, sets = _captured(run, orbit)
            reach = min(float(high - low) for low, high in sets) / 8
            orbit = [*takewhile(lambda seen: not _is_deep(seen.phase, sets), orbit)]
        orbit = [seen for seen in orbit if seen.goes_on]
    if len(orbit) > _LONGEST:
        raise Undecided(f"{_LONGEST} impacts after the separation no end of the motion is reached")
    growth = 2 ** min(1, _DOUBLINGS / max(len(orbit), 1))
    steep = math.prod(max(growth * abs(seen.slope), 1.0) for seen in orbit)
    parts = _around(prover, orbit, min(_RADIUS, reach / steep), growth)
    witness = {"separation": name, "cells": cells(parts), "beyond": None, "landing": landing}
    return [prover.derive("sticking-motion", witness)]


def _captured(run: Run, orbit: Sequence[Seen]) -> tuple[str, Sequence[Range]]:
    """Prove what an orbit comes to where the mass never sticks; return the step, and its phases."""
    last = orbit[-1]
    if not last.goes_on:
        name, never = prove_longest(run.prover)
        return name, [never.phases]
    cycle = stable_cycle(run.system, last.image % math.tau, run.budget.farthest)
    if not cycle:
        raise Undecided(f"{len(orbit)} impacts after the separation no end of the motion is seen")
    for radius in _WIDE:
        with suppress(*FAILED), run.prover.undone():
            name, stable_orbit = _orbit(run.prover, cycle, radius)
            return name, stable_orbit.cells
    name, stable_orbit = _orbit(run.prover, cycle, _radius(cycle))
    return name, stable_orbit.cells


def _is_deep(phase: float, sets: Iterable[Range]) -> bool:
    """Whether a phase is in the middle half of a set."""
    middles = ((float(low + high) / 2, float(high - low) / 4) for low, high in sets)
    return any(abs(math.remainder(phase - middle, math.tau)) < half for middle, half in middles)


def _around(prover: Prover, orbit: Sequence[Seen], radius: float, growth: float) -> list[Part]:
    """Enclose f' on sets around the points of an orbit, each `growth` times the image before."""
    parts = []
    for seen in orbit:
        if radius < _THINNEST:
            raise Undecided("the orbit is too steep for sets of the precision of floating point")
        parts.append(prover.slopes([_decimal(seen.phase - radius), _decimal(seen.phase + radius)]))
        radius *= growth * max(abs(seen.slope), _LEAST)
    return parts


def _orbit(prover: Prover, cycle: Sequence[Seen], radius: float) -> tuple[str, StableOrbit]:
    """Prove that a stable orbit is near a cycle (rule stable-orbit)."""
    slope = math.prod(max(abs(seen.slope), _LEAST) for seen in cycle)
    parts = _around(prover, cycle, radius, slope ** (-1 / len(cycle)))
    return prover.derive("stable-orbit", {"cells": cells(parts)})


def _radius(cycle: Sequence[Seen]) -> float:
    """Return how wide sets may be that a cycle contracts: less where its multiplier is near 1."""
    return min(_RADIUS, _LEAST * (1 - abs(multiplier(cycle))))


def _decimal(value: float) -> Fraction:
    return round(Fraction(value), _PLACES)


def stable(run: Run) -> Proof:
    """Prove the stable orbits that orbits of many phases come to (rule stable-orbit)."""
    proof: list[tuple[str, Conclusion]] = [*settled(run)]
    if proof:
        return proof
    failure = "no orbit is seen to come to a stable one without sticking"
    for cycle in _cycles(run):
        try:
            with run.prover.undone():
                proof.append(_orbit(run.prover, cycle, _radius(cycle)))
        except FAILED as error:
            failure = (
                f"an orbit of period {len(cycle)} is seen near {cycle[0].phase:.9f}, with the "
                f"multiplier {multiplier(cycle):.9f}, {1 - abs(multiplier(cycle)):.2g} from losing "
                f"its stability, and not proved: {error}"
            )
    if not proof:
        raise Undecided(failure)
    return proof


def _cycles(run: Run) -> Iterator[list[Seen]]:
    """Yield stable orbits, about, each once: first those of (16)."""
    phases: list[float] = []

    def is_new(seen: Seen) -> bool:
        away = (math.remainder(seen.phase - phase, math.tau) for phase in phases)
        return not any(abs(x) < _RADIUS for x in away)

    for point in _single_impacts(run):
        phases.append(point.phase)
        yield [point]
    for k in range(run.budget.starts):
        start = math.tau * (k + 0.5) / run.budget.starts
        for seen in follow(run.system, start, run.budget.farthest, run.budget.impacts):
            run.budget.check()
            if not (seen.goes_on and is_new(seen)):
                break
        else:
            cycle = stable_cycle(run.system, seen.image % math.tau, run.budget.farthest)
            if all(map(is_new, cycle)):
                phases += [each.phase for each in cycle]
                yield from filter(None, [cycle])


def _single_impacts(run: Run) -> Iterator[Seen]:
    """Yield the stable orbits with one impact in a few table periods."""
    last = last_period(run.system) or _MOST_PERIODS
    for n in range(1, min(last, _MOST_PERIODS) + 1):
        run.budget.check()
        if n * run.system.eta % 1 == 0:
            continue
        with suppress(Undecided, DomainError):
            for each in solutions(run.system, n, _BITS):
                if each.stable and each.multiplier is not None:
                    phase, slope = float(sum(each.phase)) / 2, float(each.multiplier[0])
                    yield Seen(phase, RISES if slope > 0 else FALLS, phase, slope)
