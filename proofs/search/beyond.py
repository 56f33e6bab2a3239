"""Beyond the paper: what can be proved about the motion at any parameters. Rows X1 to X5, X10.

Horseshoes and attractors are found in floating point; what is not proved then is left out.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from types import MappingProxyType

from intervals import DomainError, Undecided
from proofs.motion.candidate import next_impact
from proofs.motion.single_orbits import last_period, solutions
from proofs.motion.system import System
from proofs.motion.witness import HORIZON
from proofs.search.budget import EFFORT, FASTEST, Budget
from proofs.search.evidence import FAILED, Evidence, Proof, Tell, search_each
from proofs.search.loops import loops
from proofs.search.s34_absorbing import Partition
from proofs.search.s34_chaos import prove_entropy
from proofs.search.s34_circle import prove_arc, prove_longest
from proofs.search.shifts import full_shifts, pieces
from proofs.search.steps import Prover
from proofs.trusted.certificate import texts
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.laps import SlopeRange
from proofs.trusted.numbers import Range
from proofs.trusted.paper.beyond.returning import StickingMotion
from proofs.trusted.parameters import Parameters

_TURNS, _DEPTH = 150, 1  # of the flights, and of the tower of states, in covering graphs
_LONGEST = 60  # period
_NEAR = 1e-9
_RADIUS = 1e-5  # of the sets around the points of an orbit
_MOST_PERIODS, _BITS = 30, 60  # of orbits with one impact, that are looked for in closed form
_LEAST = 1e-3  # the least |f'| that radii follow
_THINNEST = 1e-12
_PLACES = 14
_GAIN, _SPARE, _PIECES, _LONGEST_FLIGHT = 2e-3, 1e-2, 150, 200  # see `Partition`
Part = tuple[str, SlopeRange]


@dataclass(frozen=True)
class Run:
    """One run: its prover and its budget."""

    prover: Prover
    budget: Budget

    @property
    def system(self) -> System:
        """The oscillator."""
        return self.prover.system


def prove(
    of: Parameters,
    claims: Sequence[str],
    *,
    digits: int = 30,
    tell: Tell = lambda stage: None,
    effort: int = EFFORT,
    seconds: float | Fraction = math.inf,
) -> Evidence:
    """Prove what the claims asked for rest on, as far as it goes: see `Budget`."""
    prover = Prover(System(of.eta, of.nu), digits, HORIZON)
    run = Run(prover, Budget(of.eta, effort, seconds))
    found = Evidence(prover.steps, {claim: [] for claim in claims})
    if too_fast(of, found, _SEARCHES):
        return found
    within = partial(run.budget.attempt, prover.undone)
    return search_each(found, claims, _SEARCHES, tell, run, within=within)


def too_fast(of: Parameters, found: Evidence, searches: Iterable[str]) -> bool:
    """Whether eta is too large for any search, which is noted at each claim that asks for one."""
    if of.eta <= FASTEST:
        return False
    note = f"for eta > {FASTEST} flights are not followed"
    found.notes |= dict.fromkeys(found.proofs.keys() & set(searches), note)
    return True


def _cells(parts: Sequence[Part]) -> list[dict[str, object]]:
    return [{"slopes": name, "domain": texts(part.domain)} for name, part in parts]


# -- horseshoes ------------------------------------------------------------------------------------


def _chaos(run: Run) -> Proof:
    """Prove a full shift, or else a covering graph of positive entropy, or two loops."""
    budget = run.budget
    seen = pieces(run.system, budget.grid, budget.farthest, budget.check)
    with suppress(*FAILED):
        return _markov(run, full_shifts(seen))
    graph = [x for x in prove_entropy(run.prover, _TURNS, _DEPTH) if x[1].growth > 1]
    if graph:
        return [*graph]
    try:
        return _markov(run, loops(run.system, seen, run.budget.check))
    except Undecided as failure:
        looked = f"looked at: {len(seen)} pieces of branches of f with |f'| > 1, flights up to time"
        raise Undecided(f"{failure}; {looked} {run.budget.farthest:g}") from None


def _markov(run: Run, candidates: Iterator[list[Range]]) -> Proof:
    """Prove a subshift (rule staying-set), on the first sets that allow it."""
    failure, prover = "no sets are seen that f maps over each other in several ways", run.prover
    for sets, _ in zip(candidates, range(run.budget.tries), strict=False):
        run.budget.check()
        try:
            with prover.undone():
                parts = [prover.slopes(list(domain)) for domain in sets]
                cells = [part.domain for _, part in parts]
                kept = prover.stays(cells, list(zip(parts, cells, strict=True)))
                if kept[1].orbit:
                    raise Undecided("one orbit alone stays in the sets")
                return [kept]
        except FAILED as error:
            failure = str(error)
    raise Undecided(failure)


# -- attractors ------------------------------------------------------------------------------------


def _sticking(run: Run) -> Proof:
    """Follow the motion from the separation until it sticks again (rule sticking-motion)."""
    prover = run.prover
    name, arc = prove_arc(prover)
    parts: list[Part] = []
    if not arc.returns:
        points = [*_followed(run, float(sum(arc.arrival)) / 2 % math.tau)]
        if len(points) == _LONGEST:
            raise Undecided(f"{_LONGEST} impacts after the separation the mass has not stuck")
        steep = math.prod(max(2 * abs(slope), 1.0) for _, slope in points)
        parts = _around(prover, points, min(_RADIUS, _LEAST / steep), 2.0)
    witness = {"separation": name, "cells": _cells(parts), "beyond": None, "landing": None}
    return [prover.derive("sticking-motion", witness)]


def _followed(run: Run, phase: float) -> Iterator[tuple[float, float]]:
    """Yield about the phases and slopes of an orbit, until it sticks or there are many."""
    for _ in range(_LONGEST):
        found = next_impact(run.system, phase, run.budget.farthest)
        if found is None:
            return
        yield phase, found[2]
        phase = found[1]


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


def _stable(run: Run) -> Proof:
    """Prove the stable orbits that orbits of many phases come to (rule stable-orbit)."""
    proof: list[tuple[str, Conclusion]] = []
    prover = run.prover
    for points in _cycles(run):
        with suppress(*FAILED), prover.undone():
            slope = math.prod(max(abs(slope), _LEAST) for _, slope in points)
            parts = _around(prover, points, _RADIUS, slope ** (-1 / len(points)))
            proof.append(prover.derive("stable-orbit", {"cells": _cells(parts)}))
    if not proof:
        raise Undecided("no orbit is seen to come to a stable one without sticking")
    return proof


def _cycles(run: Run) -> Iterator[list[tuple[float, float]]]:
    """Yield about the phases and slopes of stable orbits, each once: first those of (16)."""
    seen: list[float] = []
    for point in _single_impacts(run):
        seen.append(point[0])
        yield [point]
    for k in range(run.budget.starts):
        phase = math.tau * (k + 0.5) / run.budget.starts
        for _ in range(run.budget.impacts):
            run.budget.check()
            found = next_impact(run.system, phase, run.budget.farthest)
            touches = found is not None and abs(found[2] - 1) < _NEAR  # and so on for ever
            if found is None or touches or any(abs(found[1] - x) < _RADIUS for x in seen):
                break
            phase = found[1]
        else:
            points = _cycle(run, phase)
            if points:
                seen += [phase for phase, _ in points]
                yield points


def _single_impacts(run: Run) -> Iterator[tuple[float, float]]:
    """Yield the phase and slope of the stable orbits with one impact in a few table periods."""
    last = last_period(run.system) or _MOST_PERIODS
    for n in range(1, min(last, _MOST_PERIODS) + 1):
        run.budget.check()
        if n * run.system.eta % 1 == 0:
            continue
        with suppress(Undecided, DomainError):
            for each in solutions(run.system, n, _BITS):
                if each.stable and each.multiplier is not None:
                    yield float(sum(each.phase)) / 2, float(each.multiplier[0])


def _cycle(run: Run, start: float) -> list[tuple[float, float]] | None:
    """Return the points of a stable cycle that a phase is on; None if it is on none."""
    points = [*_followed(run, start)]
    back = (k for k, (phase, _) in enumerate(points) if k and abs(phase - start) < _NEAR)
    cycle = points[: next(back, 0)]
    return cycle if cycle and abs(math.prod(slope for _, slope in cycle)) < 1 else None


def _shares(run: Run) -> Proof:
    """Prove how much of the circle comes to the sticking arc, or never impacts again.

    Not where the one motion that sticks has more than one impact a period.
    """
    run.budget.check()
    with suppress(*FAILED), run.prover.undone():
        sticking = _sticking(run)
        if any(isinstance(x, StickingMotion) and x.cells for _, x in sticking):
            return sticking
    arc, never = prove_arc(run.prover), None
    with suppress(*FAILED):
        never = prove_longest(run.prover)
    cells, impacts = run.budget.grid // 2, run.budget.impacts // 8
    known = Partition(
        run.prover,
        arc,
        never,
        _GAIN,
        most=cells,
        turns=_LONGEST_FLIGHT,
        impacts=impacts,
        spare=_SPARE,
        pieces=_PIECES,
    )
    return [arc, known.prove(), *([] if never is None else [never])]


_SEARCHES: Mapping[str, tuple[str, Callable[[Run], Proof]]] = MappingProxyType(
    {
        "X2": ("horseshoes", _chaos),
        "X3": ("motions that stick", _sticking),
        "X4": ("stable orbits that do not", _stable),
        "X5": ("flights without an end", lambda run: [prove_longest(run.prover)]),
        "X10": ("where all phases lead", _shares),
    }
)
