"""Sections 3.1 and 3.2: is the invariant set what Theorems 2 to 4 and the proof of Claim 1 say?

Claims H7-H10, on the invariant set of the map, rest on a horseshoe around the given interval I and
on the orbits of the ends of I; H12, H14, H15 and H17, on the linear set, on powers of rationals.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import islice

from intervals import Interval, exp, log
from proofs.motion.candidate import next_impact
from proofs.motion.impact import HORIZON
from proofs.motion.system import System
from proofs.search.evidence import FAILED, Evidence
from proofs.search.repair import nearest_sets, places
from proofs.search.steps import Prover
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.numbers import Range, decimal_between
from proofs.trusted.paper.s31_horseshoe import Horseshoe
from proofs.trusted.paper.s32_sets.cantor import (
    Excess,
    LinearSet,
    cylinder,
    length,
    ratio_pairs,
)
from proofs.trusted.paper.s32_sets.itinerary import (
    Itinerary,
    follow,
)
from proofs.trusted.paper.s32_sets.moran import MoranRoot
from proofs.trusted.paper.s32_sets.sets import CLAIMS as STATED
from proofs.trusted.paper.s32_sets.subshift import words
from proofs.trusted.parameters import Parameters
from proofs.trusted.slopes import SlopeRange

CLAIMS = tuple(claim.id for claim in STATED)
_INVARIANT = ("H7", "H8", "H9", "H10")
_NEARBY = Fraction(1, 10**10)  # how far from an approximate image f is enclosed
_COARSE = 1e-5
_TRIES = 6
_FOLLOWED = 10

Proof = list[tuple[str, Conclusion]]
Orbits = list[tuple[str, Itinerary]]


@dataclass
class _Run:
    """One run: the prover, and the roots that it bracketed.

    looks_closer: whether to look for an interval I_wa that is not much shorter than I_w.
    """

    of: Parameters
    prover: Prover
    looks_closer: bool
    roots: dict[Range, tuple[str, MoranRoot]] = field(default_factory=dict)

    # -- the invariant set of the map --------------------------------------------------------------

    def horseshoe(self) -> tuple[Proof, Orbits]:
        """Prove a horseshoe around I; return it, and the orbits in it that claims rest on.

        Both are empty where no proof succeeds.
        """
        of = self.of
        for sets in islice(filter(self._around, nearest_sets(of)), _TRIES):
            before = dict(self.prover.steps)
            try:
                return self._prove_on(sets)
            except FAILED:
                self.prover.steps = before
        return [], []

    def _around(self, sets: Parameters) -> bool:
        low, high = self.of.interval
        return sets.interval[0] <= low and high <= sets.interval[1]

    def _prove_on(self, sets: Parameters) -> tuple[Proof, Orbits]:
        """Prove a horseshoe on candidate sets; Undecided where that fails."""
        starts = [end for end in self.of.interval if end not in sets.interval]
        starts += slow_cylinder(self.of, self.prover.system) if self.looks_closer else []
        starts = list(dict.fromkeys(starts))
        extra = [point for start in starts for point in self._nearby(sets, start)]
        slopes: dict[str, SlopeRange] = {}
        for domain in (sets.left, sets.right):
            inside = {point for point in extra if domain[0] < point < domain[1]}
            name, found = self.prover.slopes(sorted({*domain, *inside}))
            slopes[name] = found
        left, right = slopes.items()
        gap = self.prover.avoids(sets.gap, sets.interval)
        digits = max(2, places(self.of.slopes))
        base, proved = self.prover.horseshoe(left, right, gap, sets, digits)
        orbits = [orbit for x in starts for orbit in self._itinerary(base, proved, slopes, x)]
        return [(base, proved)], orbits

    def _nearby(self, sets: Parameters, start: Fraction) -> Iterator[Fraction]:
        """Yield a phase, and points close to its first images on both sides, by candidates."""
        phase, reach = start, Fraction(0)
        for _ in range(_FOLLOWED):
            if not any(low < phase < high for low, high in (sets.left, sets.right)):
                return
            yield from {phase - reach, phase + reach}
            found = next_impact(self.prover.system, float(phase))
            if found is None:
                return
            phase = round(Fraction(found[1]) / _NEARBY) * _NEARBY
            reach = _NEARBY + round(reach * 2 * self.of.slopes[1] / _NEARBY) * _NEARBY

    def _itinerary(
        self, horseshoe: str, sets: Horseshoe, slopes: dict[str, SlopeRange], start: Fraction
    ) -> Iterator[tuple[str, Itinerary]]:
        found = follow(sets, list(slopes.values()), start)
        if found is not None:
            witness = {"horseshoe": horseshoe, "slopes": list(slopes), "phase": str(start)}
            yield self.prover.add("itinerary", witness), found

    # -- the linear set ----------------------------------------------------------------------------

    def root(self, ratios: Range) -> tuple[str, MoranRoot]:
        """Bracket the root for a pair of ratios, once."""
        if ratios not in self.roots:
            self.roots[ratios] = self.prover.root(ratios)
        return self.roots[ratios]

    def linear_sets(self) -> Proof:
        """Enclose s and |I|^s for each pair of ratios."""
        proof: Proof = []
        for ratios in self._pairs():
            name, root = self.root(ratios)
            measure = _power(length(self.of.interval), root.root, self.prover.bits)
            step = self.prover.add("linear-set", {"root": name})
            proof.append((step, LinearSet(ratios, root.root, (measure.inf, measure.sup))))
        return proof

    def excesses(self) -> Proof:
        """Compare |L'|^s with |L|^s + epsilon / 4 at n = 1, L = I_11 and a large epsilon."""
        proof: Proof = []
        for ratios in self._pairs():
            name, root = self.root(ratios)
            most = ratios[1] - ratios[1] ** 2
            epsilon, word = decimal_between(most * Fraction(9, 10), most), "11"
            inside = length(cylinder(ratios, self.of.interval, word))
            bits, delta = self.prover.bits, epsilon / 4
            found = (
                _power(inside + delta, root.root, bits) - _power(inside, root.root, bits) - delta
            )
            witness = {"root": name, "epsilon": str(epsilon), "word": word}
            step = self.prover.add("excess", witness)
            proof.append((step, Excess(ratios, epsilon, word, (found.inf, found.sup))))
        return proof

    def _pairs(self) -> list[Range]:
        return [ratios for ratios in ratio_pairs(self.of) if sum(ratios) < 1]


def _power(base: Fraction, exponent: Range, bits: int) -> Interval:
    """Enclose base^s for all s in an interval."""
    precision = bits + 40
    return exp(log(Interval(base, precision=precision)) * Interval(*exponent, precision=precision))


def slow_cylinder(of: Parameters, system: System) -> list[Fraction]:
    """Return phases u, v in an I_wa, and one on either side of I_w, with v - u > |I_w| / lo.

    Candidates, in floating point: I_w is the interval of phases that follow the word w through I0
    and I1, which need not be onto. None if no I_wa of at most three letters is long enough.
    """
    sets = [(float(low), float(high)) for low, high in (of.left, of.right)]
    parts: dict[str, tuple[float, float]] = dict(zip("01", sets, strict=True))
    for word in words(2) + words(3):
        if word[1:] not in parts or word[:-1] not in parts:
            continue
        low, high = (_crossing(system, sets[int(word[0])], value) for value in parts[word[1:]])
        if high - low < 2 * _COARSE:
            continue
        parts[word], (begin, end) = (low, high), parts[word[:-1]]
        spare = (high - low) / 16
        if (high - low - 2 * spare) * float(of.slopes[0]) > end - begin + 2 * spare:
            beside = (low, low + spare), (high - spare, high), (begin - spare, begin)
            pairs = *beside, (end, end + spare)
            return [decimal_between(Fraction(x), Fraction(y)) for x, y in pairs]
    return []


def _crossing(system: System, domain: tuple[float, float], value: float) -> float:
    """Return about the phase at which f, increasing on an interval, reaches a value."""
    low, high = domain
    while high - low > _COARSE:
        middle = (low + high) / 2
        found = next_impact(system, middle)
        low, high = (low, middle) if found is None or found[1] > value else (middle, high)
    return low


def prove(
    of: Parameters,
    claims: Sequence[str],
    *,
    digits: int = 30,
    tell: Callable[[str], None] = lambda stage: None,
) -> Evidence:
    """Prove what the claims asked for rest on, once each."""
    run_ = _Run(of, Prover(System(of.eta, of.nu), digits, HORIZON), "H7" in claims)
    evidence = Evidence()
    if set(claims).intersection(_INVARIANT):
        tell("a horseshoe around I, and the orbits of the ends of I")
        base, orbits = run_.horseshoe()
        ends = [(name, x) for name, x in orbits if x.phase in of.interval]
        for claim, rest in zip(_INVARIANT, (orbits, ends, ends, []), strict=True):
            evidence.proofs[claim] = [*base, *rest]
    tell("powers for the linear set")
    if "H12" in claims:
        evidence.proofs["H12"] = run_.linear_sets()
    if "H14" in claims:
        evidence.proofs["H14"] = run_.excesses()
    evidence.steps = run_.prover.steps
    return evidence
