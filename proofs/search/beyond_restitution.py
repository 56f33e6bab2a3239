"""Beyond the paper, with restitution: what can be proved at any parameters. Rows X6 to X9."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from fractions import Fraction
from functools import partial
from types import MappingProxyType

from intervals import Undecided
from proofs.motion.chatter import BITS, Pushing, around
from proofs.motion.system import System
from proofs.search.beyond import too_fast
from proofs.search.budget import EFFORT, Budget
from proofs.search.evidence import FAILED, Evidence, Proof, search_each
from proofs.search.request import Request, proving
from proofs.search.s33_cycles import around_image, stable_cycles
from proofs.search.s33_moving import grown
from proofs.search.s33_rectangles import Sets
from proofs.search.s33_steps import ReboundProver
from proofs.search.s34_border import witness
from proofs.search.s34_circle import prove_arc, prove_longest
from proofs.search.shifts import Symbol, cells, families, pieces, rounded_out, symbols
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.numbers import Range
from proofs.trusted.paper.s34_circle.bounces import landed
from proofs.trusted.parameters import Place

_MOST_IMPACTS = 30
_SPARES = (0.05, 0.02, 0.01, 0.005, 0.002, 0.001)  # by how much edges overshoot, from the most
_AROUND = Fraction(1, 10**6)  # of states around the first impact


@proving
def prove(request: Request, effort: int = EFFORT, seconds: float | Fraction = math.inf) -> Evidence:
    """Prove what the claims asked for rest on, as far as it goes."""
    prover = ReboundProver(request.of, request.digits)
    budget = Budget(request.of.eta, effort, seconds)
    evidence = Evidence(prover.steps, {claim: [] for claim in request.claims})
    if not too_fast(request.of, evidence, _SEARCHES) and request.of.epsilon is not None:
        within = partial(budget.attempt, prover.attempt)
        search_each(
            evidence, request.claims, _SEARCHES, request.tell, prover, budget, within=within
        )
    return evidence


def _chaos(prover: ReboundProver, budget: Budget) -> Proof:
    """Prove a horseshoe on rectangles that are found (rule horseshoe)."""
    system, statement = prover.system, prover.of
    epsilon = statement.epsilon or Fraction(0)
    at = Place.restituting(statement.eta, statement.nu, epsilon)
    seen = symbols(pieces(system, budget.grid, budget.farthest, budget.check))
    failure = "no two rectangles are seen that F maps across both"
    for (sets, velocities), _ in zip(
        _rectangles(system, epsilon, seen), range(budget.tries), strict=False
    ):
        budget.check()
        prover.of = replace(statement, velocities=velocities)
        try:
            name = prover.crossing(at, sets)
        except Unproved as error:
            failure = str(error)
        else:
            return [(name, prover.known[name])]
        finally:
            prover.of = statement
    raise Undecided(failure)


def _rectangles(
    system: System, epsilon: Fraction, seen: Sequence[Symbol]
) -> Iterator[tuple[Sets, Range]]:
    """Yield two sets of phases, and velocities, on which F seems to be a full shift."""
    for family in families(seen, 2):
        for spare in _SPARES:
            sets = cells(family, spare)
            moved = sets and grown(system, float(epsilon), (sets[0], sets[1]), spare)
            if moved:
                low, high = moved.velocities[0]
                unit = 10.0 ** -math.ceil(2 - math.log10(high - low))
                ends = math.floor(low / unit), math.ceil(high / unit)
                left, right = rounded_out(moved.phases, spare)
                first, last = (Fraction(end) * Fraction(str(unit)) for end in ends)
                yield (left, right), (first, last)


def _stable(prover: ReboundProver, budget: Budget) -> Proof:
    """Prove the motion that rests and leaves again, and stable orbits of transversal impacts."""
    epsilon = prover.of.epsilon or Fraction(0)
    proof: Proof = []
    with suppress(*FAILED), prover.attempt():
        proof.append(_chattering(prover, epsilon))
    proof += stable_cycles(prover, epsilon, budget.starts)
    if not proof:
        raise Undecided("no motion is seen to come to a stable one, or none is proved")
    return proof


def _chattering(prover: ReboundProver, epsilon: Fraction) -> tuple[str, Conclusion]:
    """Follow the motion from the separation until bounces end in rest (rule superstable-motion)."""
    system = prover.system
    at = Place.restituting(system.eta, system.nu, epsilon)
    separation, arc = prove_arc(prover)
    pushing, first = Pushing(arc.at, arc.phase[0]), around(arc, _AROUND)
    box, impacts = list(first), list[str]()
    while len(impacts) < _MOST_IMPACTS:
        name, image = prover.state(at, tuple(box))
        impacts.append(name)
        box = around_image(image)
        with suppress(*FAILED):
            state = landed(arc, (image.values[0], image.values[1]), BITS)
            cell, _ = pushing.settle((epsilon, epsilon), *state)
            made = witness(separation, first, [cell], impacts)
            return prover.derive("superstable-motion", made)
    raise Undecided(f"{_MOST_IMPACTS} impacts after the separation the mass has not come to rest")


_SEARCHES: Mapping[str, tuple[str, Callable[[ReboundProver, Budget], Proof]]] = MappingProxyType(
    {
        "X6": ("rectangles", _chaos),
        "X7": ("stable motions", _stable),
        "X9": ("motions that only touch", lambda prover, _: [prove_longest(prover)]),
    }
)
