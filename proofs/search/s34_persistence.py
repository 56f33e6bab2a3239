"""Section 3.4 with restitution: the stable orbit persists, with infinitely many impacts a period.

Claims G7, G8, G12, G15 and G16. The flight from the separation phase does not depend on epsilon;
after it, for ever larger epsilon, bounces are enclosed until they are proved to end before that
phase.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from fractions import Fraction
from itertools import islice

from intervals import Undecided
from intervals.cover import cover, halves
from proofs.motion.chatter import BITS, Pushing, around
from proofs.motion.simulate import TURNS
from proofs.motion.transients import INITIAL_STATES, Summary, transients
from proofs.search.evidence import FAILED, Evidence, Proof
from proofs.search.request import Request, proving
from proofs.search.s33_cycles import stable_cycles
from proofs.search.s33_steps import ReboundProver
from proofs.search.s34_attractors import branch
from proofs.search.s34_border import border, witness
from proofs.search.s34_circle import prove_arc
from proofs.search.steps import Prover
from proofs.trusted.numbers import Range
from proofs.trusted.paper.s34_circle.bounces import Box, landed
from proofs.trusted.paper.s34_circle.landing import Separation
from proofs.trusted.paper.s34_circle.persistence import Cell, SuperstableMotion

_SPREAD = Fraction(1, 100_000)  # of phases and speeds around the impact
_STEPS = Fraction(1, 10), Fraction(1, 100), Fraction(1, 1000)  # of epsilon, tried in turn
_HALVINGS = 9  # of a step of epsilon
_OTHER = Fraction(29, 100)  # an epsilon at which simulated motions find another stable orbit
_TRIES = 20  # simulated motions


@proving
def prove(request: Request) -> Evidence:
    """Prove what the claims asked for rest on; G8 is an observation: it is simulated."""
    prover, evidence = ReboundProver(request.of, request.digits), Evidence()
    if request.asks("G7", "G12", "G15", "G16"):
        with suppress(*FAILED):  # what is not proved the claims do not say
            request.tell(
                "the flight from the separation phase, and bounces for ever larger epsilon"
            )
            motion = superstable_motion(prover)
            proof: Proof = [motion]
            evidence.proofs = dict.fromkeys({"G7", "G12"}.intersection(request.claims), proof)
            if request.asks("G15"):
                request.tell("where bounces do not come to an end any more")
                evidence.proofs["G15"] = [*proof, *border(prover, motion)]
            if request.asks("G7", "G12", "G16"):
                request.tell("another stable orbit")
                others = list(islice(stable_cycles(prover, _OTHER, _TRIES, 2), 1))
                if request.asks("G16"):
                    request.tell("the same orbit for other epsilon")
                    cycles = [each for _, other in others for each in branch(prover, other)]
                    evidence.proofs["G16"] = [*proof, *cycles]
                proof += others
    if request.asks("G8"):
        request.tell("simulated motions")
        evidence.notes["G8"] = observed(transients(prover.system))
    evidence.steps = prover.steps
    return evidence


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


def superstable_motion(
    prover: Prover, enough: Fraction = Fraction(1)
) -> tuple[str, SuperstableMotion]:
    """Prove that the motion from phi_s comes to rest, for as many epsilon as can be, or enough."""
    separation, arc = prove_arc(prover)
    box = around(arc, _SPREAD)
    cells = _cells(Pushing(arc.at, arc.phase[0]), arc, box, enough)
    return prover.derive("superstable-motion", witness(separation, box, cells))


def _cells(pushing: Pushing, arc: Separation, box: Box, enough: Fraction) -> list[Cell]:
    """Prove that bounces after impacts nearby end, for epsilon from 0 up to as much as can be.

    By steps of epsilon and ever smaller ones, until the proof fails.
    """
    states, done = landed(arc, box, BITS), Fraction(0)
    cells: list[Cell] = []
    for step in _STEPS:

        def settled(epsilon: Range, least: Fraction = step / 2**_HALVINGS) -> Cell | None:
            try:
                return pushing.settle(epsilon, *states)[0]
            except Undecided:
                if epsilon[1] - epsilon[0] <= least:
                    raise
                return None

        while done < enough and done + step < 1:
            try:
                pushing.settle((done + step, done + step), *states)  # hopeless otherwise
                cells += [cell for _, cell in cover([(done, done + step)], settled, halves)]
            except Undecided:
                break
            done += step
    if not cells:
        raise Undecided("no epsilon > 0 is proved to let the mass come to rest")
    return cells
