"""Section 3.4 with restitution: the stable orbit persists, with infinitely many impacts a period.

Claims G7, G8, G12 and G15. The flight from the separation phase does not depend on epsilon; after
it, for ever larger epsilon, bounces are enclosed until they are proved to end before that phase.
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Sequence
from contextlib import suppress
from fractions import Fraction

from intervals import DomainError, Undecided
from proofs.motion.chatter import Pushing, Settled
from proofs.motion.covering import halves
from proofs.motion.impact import HORIZON
from proofs.motion.simulate import INITIAL_STATES, TURNS, Summary, late_state, transients
from proofs.motion.system import System
from proofs.search.evidence import FAILED, Evidence, Proof
from proofs.search.s33_steps import ReboundProver
from proofs.search.s34_border import border
from proofs.search.s34_circle import prove_arc
from proofs.search.steps import Prover
from proofs.trusted.certificate import texts
from proofs.trusted.numbers import TURN, Range
from proofs.trusted.paper.s33_restitution.rebounds import Rebound, size
from proofs.trusted.paper.s34_circle.landing import Separation
from proofs.trusted.paper.s34_circle.persistence import StablePair, SuperstableMotion, stable_pair
from proofs.trusted.parameters import Parameters, Place

_SPREAD = Fraction(1, 100_000)  # of phases and speeds around the impact
_STEPS = Fraction(1, 10), Fraction(1, 100), Fraction(1, 1000)  # of epsilon, tried in turn
_HALVINGS = 9  # of a step of epsilon
_OTHER = Fraction(29, 100)  # an epsilon at which simulated motions find another stable orbit
_TRIES, _IMPACTS = 20, 200  # simulated motions, and impacts until they are near an orbit
_SAME = 1e-9  # the distance of states that are one
_HALF = 1e-6  # half a side, in phase, of a box around a state
_EDGE = 1e-3  # phases so close to 0 are left alone
_GRID = 10**12  # states and half sides are multiples of 1 / _GRID
State = tuple[Fraction, Fraction]
_Cell = tuple[Fraction, Settled]  # up to which epsilon, and how the bounces end


def prove(
    of: Parameters,
    claims: Sequence[str],
    *,
    digits: int = 30,
    tell: Callable[[str], None] = lambda stage: None,
) -> Evidence:
    """Prove what the claims asked for rest on; G8 is an observation: it is simulated."""
    prover, found = Prover(System(of.eta, of.nu), digits, HORIZON), Evidence()
    if {"G7", "G12", "G15"}.intersection(claims):
        with suppress(*FAILED):  # what is not proved the claims do not say
            tell("the flight from the separation phase, and bounces for ever larger epsilon")
            motion = superstable_motion(prover)
            proof: Proof = [motion]
            found.proofs = dict.fromkeys({"G7", "G12"}.intersection(claims), proof)
            if "G15" in claims:
                tell("where bounces do not come to an end any more")
                found.proofs["G15"] = [*proof, *border(prover, motion)]
            if found.proofs.keys() & {"G7", "G12"}:
                tell("another stable orbit")
                proof += another_orbit(of, prover)
    if "G8" in claims:
        tell("simulated motions")
        found.notes["G8"] = observed(transients(prover.system))
    found.steps = prover.steps
    return found


def observed(rows: Sequence[Summary]) -> str:
    """Say what simulated motions do."""
    medians, means, others = (
        ", ".join(f"{value:.1f}" for value in values)
        for values in (
            [row.median_turns for row in rows],
            [row.mean_turns for row in rows],
            [100 * (1 - row.rested) for row in rows],
        )
    )
    return (
        f"simulated {INITIAL_STATES} random initial conditions, for epsilon = "
        f"{', '.join(row.epsilon for row in rows)}: not at rest within {TURNS} turns of the table "
        f"(they are counted as {TURNS} turns) {others} percent; median turns until rest {medians}; "
        f"mean turns {means}"
    )


def superstable_motion(prover: Prover) -> tuple[str, SuperstableMotion]:
    """Prove that the motion from phi_s comes to rest, for as many epsilon as can be."""
    separation, arc = prove_arc(prover)
    cells = _cells(Pushing(prover.system, arc.phase[0]), arc)
    witness = {
        "separation": separation,
        "spread": str(_SPREAD),
        "cells": [
            {
                "epsilon": str(end),
                "bounces": [texts(bounce) for bounce in settled.bounces],
                "ratio": str(settled.ratio),
                "rest": str(settled.rest),
            }
            for end, settled in cells
        ],
    }
    rest = max(settled.rest for _, settled in cells)
    motion = SuperstableMotion(arc, cells[-1][0], _SPREAD, rest)
    return prover.add("superstable-motion", witness), motion


def _cells(pushing: Pushing, arc: Separation) -> list[_Cell]:
    """Prove that bounces after impacts nearby end, for epsilon from 0 up to as much as can be.

    By steps of epsilon and ever smaller ones, until the proof fails.
    """
    phases, speeds = ((low - _SPREAD, high + _SPREAD) for low, high in (arc.arrival, arc.speed))
    if not (speeds[0] > 0 and arc.start[1] < phases[0] and phases[1] < arc.phase[0]):
        raise Undecided("the impact after the separation phase is too slow, or not on the arc")
    cells: list[_Cell] = []
    done = Fraction(0)
    for step in _STEPS:
        while done + step < 1:
            try:
                pushing.settle((done + step, done + step), phases, speeds)  # hopeless otherwise
                cells += _halved(pushing, (done, done + step), phases, speeds, _HALVINGS)
            except (Undecided, DomainError):
                break
            done += step
    if not cells:
        raise Undecided("no epsilon > 0 is proved to let the mass come to rest")
    return cells


def _halved(
    pushing: Pushing, epsilon: Range, phases: Range, speeds: Range, halvings: int
) -> list[_Cell]:
    """Prove that bounces end for all epsilon of a range, in as many parts as it takes."""
    try:
        return [(epsilon[1], pushing.settle(epsilon, phases, speeds))]
    except (Undecided, DomainError):
        if halvings == 0:
            raise Undecided(f"epsilon near {float(epsilon[0]):.6g}") from None
    return [
        cell
        for half in halves(epsilon)
        for cell in _halved(pushing, half, phases, speeds, halvings - 1)
    ]


def another_orbit(of: Parameters, prover: Prover) -> list[tuple[str, StablePair]]:
    """Prove that F has a stable 2-periodic orbit at epsilon = _OTHER; [] if none is found.

    The half sides r of the first box are the Perron vector of |DF| |DF|, which F^2 shrinks most
    evenly; those of the second are |DF| r, and a third of what there is to spare.
    """
    at = Place((of.eta, of.eta), (of.nu, of.nu), (_OTHER, _OTHER))
    states, rebounds = _candidate(prover.system), ReboundProver(of, prover)
    if states is None:
        return []

    def around(state: State, half: State) -> tuple[str, Rebound]:
        phases, velocities = ((x - r, x + r) for x, r in zip(state, half, strict=True))
        return rebounds.rebound(at, phases, velocities)

    centres = [around(state, (Fraction(0), Fraction(0))) for state in states]
    (p, q, r, s), (t, u, v, w) = (
        [float(size(entry)) for row in step.derivative for entry in row] for _, step in centres
    )
    a, b, c, d = t * p + u * r, t * q + u * s, v * p + w * r, v * q + w * s
    root = (a + d + math.hypot(a - d, 2 * math.sqrt(b * c))) / 2
    if root >= 1 or b == 0:
        return []
    x, y = _HALF, _HALF * (root - a) / b
    more = (2 + 1 / root) / 3
    halves_of = (x, y), (more * (p * x + q * y), more * (r * x + s * y))
    boxes = [
        around(state, (_rounded(half[0]), _rounded(half[1])))
        for state, half in zip(states, halves_of, strict=True)
    ]
    names = ("first", "at_first", "second", "at_second")
    steps = dict(zip(names, (boxes[0], centres[0], boxes[1], centres[1]), strict=True))
    pair = stable_pair(**{name: rebound for name, (_, rebound) in steps.items()})
    return [(prover.add("stable-pair", {name: step for name, (step, _) in steps.items()}), pair)]


def _candidate(system: System) -> tuple[State, State] | None:
    """Return about the two states of a 2-periodic orbit that simulated motions tend to."""
    generator = random.Random(1)
    for _ in range(_TRIES):
        start = generator.uniform(0, math.tau), generator.uniform(0, 0.4)
        states = [late_state(system, float(_OTHER), *start, _IMPACTS)]
        for _ in range(2):
            if states[-1] is not None:
                states.append(late_state(system, float(_OTHER), *states[-1], 1))
        first, second, third = (*states, None, None)[:3]
        if first is None or second is None or third is None:
            continue
        inside = all(_EDGE < phase < float(TURN) - _EDGE for phase, _ in (first, second))
        if inside and math.dist(first, third) < _SAME < math.dist(first, second):
            return _state(system, *first), _state(system, *second)
    return None


def _state(system: System, phase: float, speed: float) -> State:
    """Return the phase and the velocity gamma before an impact with this relative speed."""
    rate = float(system.nu) * math.cos(phase)
    gamma = (system.side * speed - rate) / float(system.eta)
    return _rounded(phase), _rounded(gamma)


def _rounded(value: float) -> Fraction:
    return Fraction(round(value * _GRID), _GRID)
