"""Sections 3.1 and 3.2: is the invariant set what Theorems 2 to 4 and the proof of Claim 1 say?

Claims H7-H10, on the invariant set of the map, rest on a horseshoe around the given interval I and
on the orbits of the ends of I; H12, H14, H15 and H17, on the linear set, on Moran's roots.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from fractions import Fraction
from functools import cache
from itertools import islice

from proofs.motion.simulate import next_impact
from proofs.motion.system import System
from proofs.search.evidence import FAILED, Evidence, Proof
from proofs.search.repair import nearest_sets
from proofs.search.request import Request, proving
from proofs.search.steps import Prover
from proofs.trusted.kernel.itineraries import follow
from proofs.trusted.kernel.laps import SlopeRange
from proofs.trusted.numbers import within
from proofs.trusted.paper.s32_sets.linear import LinearSet
from proofs.trusted.parameters import Parameters

_INVARIANT = ("H7", "H8", "H9", "H10")
_NEARBY = Fraction(1, 10**10)  # how far from an approximate image f is enclosed
LEAST_DIGITS = 12  # to tell in which of I0 and I1 an image is
_TRIES = 6
_FOLLOWED = 10


def prove_staying(statement: Parameters, prover: Prover) -> Proof:
    """Prove a horseshoe around I, and the orbits of the ends of I; nothing where that fails."""
    around = (x for x in nearest_sets(statement) if within(statement.interval, x.interval))
    for sets in islice(around, _TRIES):
        with suppress(*FAILED), prover.undone():
            return _staying_in(sets, statement, prover)
    return []


def _staying_in(sets: Parameters, statement: Parameters, prover: Prover) -> Proof:
    """Prove it on candidate sets; Undecided or Unproved where that fails."""
    starts = [end for end in statement.interval if end not in sets.interval]
    extra = [point for start in starts for point in _nearby(sets, start)]
    slopes: dict[str, SlopeRange] = {}
    for domain in (sets.left, sets.right):
        inside = {point for point in extra if domain[0] < point < domain[1]}
        name, slope_range = prover.slopes(sorted({*domain, *inside}))
        slopes[name] = slope_range
    gap = prover.avoids(sets.gap, sets.interval)
    base, proved = prover.horseshoe(list(slopes.items()), gap, sets)
    proof: Proof = [(base, proved)]
    for start in starts:
        orbit = follow(proved, list(slopes.values()), start)
        witness = {"horseshoe": base, "slopes": list(slopes), "phase": str(start)}
        proof.append((prover.record("itinerary", witness, orbit), orbit))
    return proof


def _nearby(sets: Parameters, start: Fraction) -> Iterator[Fraction]:
    """Yield a phase, and points close to its first images on both sides, by candidates."""
    system, phase, reach = System(sets.eta, sets.nu), start, Fraction(0)
    for _ in range(_FOLLOWED):
        if not any(low < phase < high for low, high in (sets.left, sets.right)):
            return
        yield from {phase - reach, phase + reach}
        impact = next_impact(system, float(phase))
        if impact is None:
            return
        phase = round(Fraction(impact.phase) / _NEARBY) * _NEARBY
        reach = _NEARBY + round(reach * 2 * sets.slopes[1] / _NEARBY) * _NEARBY


@proving
def prove(request: Request) -> Evidence:
    """Prove what the claims asked for rest on, once each."""
    prover = request.prover(least_digits=LEAST_DIGITS)
    evidence = Evidence()
    if request.asks(*_INVARIANT):
        request.tell("a horseshoe around I, and the orbits of the ends of I")
        proof = prove_staying(request.of, prover)
        evidence.proofs |= dict.fromkeys(_INVARIANT, proof) | {"H10": proof[:1]}
    request.tell("roots for the linear set")
    root, statement = cache(prover.root), request.of
    for claim, pairs in (
        ("H12", [statement.reciprocals]),
        ("H14", [statement.reciprocals, statement.moran_ratios]),
    ):
        if request.asks(claim):
            try:
                sets = [LinearSet(ratios, statement.interval) for ratios in dict.fromkeys(pairs)]
                evidence.proofs[claim] = [root(each.ratios) for each in sets]
            except FAILED as failure:
                evidence.notes[claim] = str(failure)
    evidence.steps = prover.steps
    return evidence
