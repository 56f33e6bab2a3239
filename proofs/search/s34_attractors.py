"""Section 3.4 with restitution: a stable orbit is continued in epsilon, claim G16.

From an epsilon at which it is known, both ways, in steps as long as a proof goes through.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

from proofs.search.evidence import FAILED, Proof
from proofs.search.s33_cycles import State, prove_cycle, seen_from
from proofs.search.s33_steps import ReboundProver
from proofs.trusted.kernel.conclusion import place_of
from proofs.trusted.kernel.stable import StableCycle
from proofs.trusted.numbers import Range

_UNIT = Fraction(1, 10**6)  # epsilons are multiples
_FIRST, _LEAST = 250, 20  # units: the first step, and the last one
_MOST = 100  # tries each way


def branch(prover: ReboundProver, stable: StableCycle, tries: int = _MOST) -> Proof:
    """Prove a stable orbit for epsilon around one at which it is known, as far as it goes."""
    start = place_of(stable).sides[2][0]
    at = replace(place_of(stable), epsilon=(start, start))
    state = min(
        ((_mean(box[0]), _mean(box[1])) for box in stable.boxes),
        key=lambda state: seen_from(at, state, len(stable.boxes))[1],
    )
    return [
        cycle for way in (-1, 1) for cycle in _continued(prover, stable, (start, state), way, tries)
    ]


def _continued(
    prover: ReboundProver,
    stable: StableCycle,
    start: tuple[Fraction, State],
    way: int,
    tries: int,
) -> Proof:
    """Prove stable orbits on intervals of epsilon, one after the other, upwards or downwards."""
    (epsilon, state), size, proof = start, _FIRST, Proof()
    period = len(stable.boxes)
    for _ in range(tries):
        onward = epsilon + way * size * _UNIT
        ends = min(epsilon, onward), max(epsilon, onward)
        middle = (epsilon + onward) / 2
        try:
            with prover.attempt():
                at = replace(place_of(stable), epsilon=(middle, middle))
                near = seen_from(at, state, period)[0]
                cycle = prove_cycle(prover, replace(place_of(stable), epsilon=ends), near, period)
        except FAILED:
            size = size * 3 // 4
            if size < _LEAST:
                break
        else:
            proof.append(cycle)
            epsilon, state, size = onward, near, size * 9 // 8
    return proof


def _mean(values: Range) -> Fraction:
    return (values[0] + values[1]) / 2
