"""Sections 3.1 and 3.2: is the invariant set what Theorems 2 to 4 and the proof of Claim 1 say?

Claims H7-H10, on the invariant set of the map, rest on a horseshoe around the given interval I and
on the orbits of the ends of I; H12, H14, H15 and H17, on the linear set, on powers of rationals.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import islice

from intervals import Interval, exp, log
from proofs.motion.candidate import next_impact
from proofs.motion.impact import HORIZON
from proofs.motion.system import System
from proofs.search.evidence import FAILED, Evidence, Proof
from proofs.search.repair import nearest_sets, places
from proofs.search.steps import Prover
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.numbers import Range, within
from proofs.trusted.paper.s32_sets.invariant import follow
from proofs.trusted.paper.s32_sets.linear import (
    LEVELS,
    Excess,
    LinearDimension,
    LinearSet,
    linear_sets,
)
from proofs.trusted.paper.s32_sets.moran import MoranRoot
from proofs.trusted.parameters import Parameters
from proofs.trusted.slopes import SlopeRange

_INVARIANT = ("H7", "H8", "H9", "H10")
_NEARBY = Fraction(1, 10**10)  # how far from an approximate image f is enclosed
LEAST_DIGITS = 12  # to tell in which of I0 and I1 an image is
_TRIES = 6
_FOLLOWED = 10


def prove_staying(of: Parameters, prover: Prover) -> Proof:
    """Prove a horseshoe around I, and the orbits of the ends of I; nothing where that fails."""
    around = (x for x in nearest_sets(of) if within(of.interval, x.interval))
    for sets in islice(around, _TRIES):
        with suppress(*FAILED), prover.undone():
            return _staying_in(sets, of, prover)
    return []


def _staying_in(sets: Parameters, of: Parameters, prover: Prover) -> Proof:
    """Prove it on candidate sets; Undecided or Unproved where that fails."""
    starts = [end for end in of.interval if end not in sets.interval]
    extra = [point for start in starts for point in _nearby(sets, start)]
    slopes: dict[str, SlopeRange] = {}
    for domain in (sets.left, sets.right):
        inside = {point for point in extra if domain[0] < point < domain[1]}
        name, found = prover.slopes(sorted({*domain, *inside}))
        slopes[name] = found
    left, right = slopes.items()
    gap = prover.avoids(sets.gap, sets.interval)
    base, proved = prover.horseshoe(left, right, gap, sets, max(2, places(of.slopes)))
    proof: Proof = [(base, proved)]
    for start in starts:
        orbit = follow(proved, list(slopes.values()), start)
        witness = {"horseshoe": base, "slopes": list(slopes), "phase": str(start)}
        proof.append((prover.add("itinerary", witness), orbit))
    return proof


def _nearby(sets: Parameters, start: Fraction) -> Iterator[Fraction]:
    """Yield a phase, and points close to its first images on both sides, by candidates."""
    system, phase, reach = System(sets.eta, sets.nu), start, Fraction(0)
    for _ in range(_FOLLOWED):
        if not any(low < phase < high for low, high in (sets.left, sets.right)):
            return
        yield from {phase - reach, phase + reach}
        found = next_impact(system, float(phase))
        if found is None:
            return
        phase = round(Fraction(found[1]) / _NEARBY) * _NEARBY
        reach = _NEARBY + round(reach * 2 * sets.slopes[1] / _NEARBY) * _NEARBY


@dataclass
class _Linear:
    """The proofs about the linear set, and the roots that they bracketed."""

    of: Parameters
    prover: Prover
    roots: dict[Range, tuple[str, MoranRoot]] = field(default_factory=dict)

    def root(self, ratios: Range) -> tuple[str, MoranRoot]:
        """Bracket the root for a pair of ratios, once."""
        if ratios not in self.roots:
            self.roots[ratios] = self.prover.root(ratios)
        return self.roots[ratios]

    def dimension(self) -> Proof:
        """Enclose s and |I|^s for the ratios 1 / slopes."""
        given = LinearSet(self.of.reciprocals, self.of.interval)
        name, root = self.root(given.ratios)
        measure = self._power(given.interval[1] - given.interval[0], root.root)
        found = LinearDimension(given.ratios, given.interval, root.root, (measure.inf, measure.sup))
        return [(self.prover.add("linear-set", {"root": name}), found)]

    def excesses(self) -> Proof:
        """Find the least n from which on (11) fails for every epsilon."""
        proof: Proof = []
        for given in linear_sets(self.of):
            name, root = self.root(given.ratios)
            for level in range(1, LEVELS):
                with suppress(Unproved):
                    found = Excess(given.ratios, given.interval, root.root, level)
                    witness = {"root": name, "level": str(level)}
                    proof.append((self.prover.add("excess", witness), found))
                    break
        return proof

    def _power(self, base: Fraction, exponent: Range) -> Interval:
        """Enclose base^s for all s in an interval."""
        bits = self.prover.bits + 40
        return exp(log(Interval(base, precision=bits)) * Interval(*exponent, precision=bits))


def prove(
    of: Parameters,
    claims: Sequence[str],
    *,
    digits: int = 30,
    tell: Callable[[str], None] = lambda stage: None,
) -> Evidence:
    """Prove what the claims asked for rest on, once each."""
    prover = Prover(System(of.eta, of.nu), max(digits, LEAST_DIGITS), HORIZON)
    evidence = Evidence()
    if set(claims).intersection(_INVARIANT):
        tell("a horseshoe around I, and the orbits of the ends of I")
        proof = prove_staying(of, prover)
        evidence.proofs |= dict.fromkeys(_INVARIANT, proof) | {"H10": proof[:1]}
    run = _Linear(of, prover)
    tell("powers for the linear set")
    for claim, make in (("H12", run.dimension), ("H14", run.excesses)):
        if claim in claims:
            try:
                evidence.proofs[claim] = make()
            except FAILED as failure:
                evidence.notes[claim] = str(failure)
    evidence.steps = prover.steps
    return evidence
