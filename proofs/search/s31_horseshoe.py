"""Section 3.1-3.2: is the plastic impact map a horseshoe on the printed sets? H1-H6, H11, H16.

Witnesses by floating point, by interval arithmetic where that is not enough, conclusions by the
checker's rules, a certificate, and a repair where the printed numbers fail.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from fractions import Fraction
from functools import partial
from itertools import islice
from typing import TypeVar

from proofs.motion.simulate import next_impact
from proofs.motion.system import System
from proofs.motion.witness import HORIZON
from proofs.search.evidence import FAILED, Evidence, Proof, Tell
from proofs.search.repair import grid, nearest_sets
from proofs.search.steps import Prover
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.differential import Avoids, Differential
from proofs.trusted.kernel.laps import SlopeRange
from proofs.trusted.kernel.staying import StayingSet
from proofs.trusted.numbers import Phase
from proofs.trusted.paper import GROUPS
from proofs.trusted.paper.s31_horseshoe import ROWS
from proofs.trusted.parameters import Parameters
from proofs.trusted.slopes import Impact
from proofs.trusted.verdicts import Verdict

_Proved = TypeVar("_Proved")
_STAGES = {
    "slopes": "first impacts and slopes on I0 and I1",
    "gap": "where the gap between I0 and I1 goes",
    "witness": "a witness against a claim",
}
_NEEDS_SLOPES = {"H1", "H2", "H3", "H5", "H6"}
_NEEDS_GAP = {"H4", "H5"}
_DECIDE = {row.id: row.decide for row in ROWS}
_TRIES = 3


@dataclass
class _Run:
    """What one run proved, about the printed sets and about corrected ones."""

    prover: Prover
    of: Parameters
    tell: Tell
    slopes: list[tuple[str, SlopeRange]] = field(default_factory=list)
    gaps: list[tuple[str, Avoids]] = field(default_factory=list)
    failures: dict[str, str] = field(default_factory=dict)

    def attempt(self, part: str, make: Callable[[], _Proved]) -> _Proved | None:
        """Make one part of the proof; what cannot be proved leaves a reason and no step."""
        self.tell(_STAGES[part])
        try:
            with self.prover.undone():
                return make()
        except FAILED as failure:
            self.failures[part] = str(failure)
            return None

    def prove_slopes(self, *sets: Parameters) -> bool:
        """Enclose f' on I0 and on I1, each the hull of those of the sets given."""
        for domains in ([each.left for each in sets], [each.right for each in sets]):
            points = sorted({end for domain in domains for end in domain})
            if not any(set(points) <= set(enclosed.points) for _, enclosed in self.slopes):
                proved = self.attempt("slopes", partial(self.prover.slopes, points))
                if proved is None:
                    return False
                self.slopes.append(proved)
        return True

    def prove_gap(self, *sets: Parameters) -> bool:
        """Prove that the gap, the hull of those of the sets given, avoids the hull of the Is."""
        phases = (min(each.gap[0] for each in sets), max(each.gap[1] for each in sets))
        target = (min(each.interval[0] for each in sets), max(each.interval[1] for each in sets))
        proved = self.attempt("gap", partial(self.prover.avoids, phases, target))
        self.gaps += [] if proved is None else [proved]
        return proved is not None

    def evidence(self, claim: str) -> Proof:
        """Return the steps that a claim rests on: enough to decide it, if they are."""
        proof: Proof = []
        if claim in _NEEDS_SLOPES:
            proof += [step for step in self.slopes if self._is_about(step[1])]
        if claim in _NEEDS_GAP and self._verdict(claim, proof) is Verdict.UNDECIDED:
            proof += self.gaps[:1]
        if self._verdict(claim, proof) is Verdict.UNDECIDED:
            refutation = self.witness(claim)
            proof = proof if refutation is None else [refutation]
        return proof

    def _is_about(self, slopes: SlopeRange) -> bool:
        return any(slopes.over(domain) is not None for domain in (self.of.left, self.of.right))

    def _verdict(self, claim: str, proof: Sequence[tuple[str, Conclusion]]) -> Verdict:
        return _DECIDE[claim](self.of, [conclusion for _, conclusion in proof]).verdict

    def witness(self, claim: str) -> tuple[str, Differential] | None:
        """Look for one phase that refutes a claim, by candidates, and prove it."""
        for phase in islice(self.suspects(claim), _TRIES):
            proved = self.attempt("witness", partial(self.prover.point, phase))
            if proved is not None:
                return proved
        return None

    def suspects(self, claim: str, finest: int = 64, stride: int = 1) -> Iterator[Fraction]:
        """Yield phases that refute a claim in floating point, of a `grid` on its domains."""
        numbers = self.of
        domains = (numbers.gap,) if claim == "H4" else (numbers.left, numbers.right)
        for phase in (phase for domain in domains for phase in grid(domain, finest, stride)):
            candidate = next_impact(self.prover.system, float(phase))
            if candidate is None:
                continue
            image, slope = Fraction(candidate.phase), Fraction(candidate.slope)
            try:
                guess = Impact(numbers.place, phase, (slope, slope), Phase(image, image))
            except Unproved:  # next to phase 0
                continue
            if _DECIDE[claim](numbers, [guess]).verdict is Verdict.REFUTED:
                yield phase

    def correction(self) -> tuple[str, StayingSet] | None:
        """Prove a horseshoe on the nearest sets on which that succeeds."""
        for sets in islice(nearest_sets(self.of), _TRIES):
            if self._proved(sets) is None and not (
                self.prove_slopes(sets) and self.prove_gap(sets)
            ):
                continue
            proved = self._proved(sets)
            if proved is not None:
                return proved
        return None

    def _proved(self, sets: Parameters) -> tuple[str, StayingSet] | None:
        """Return a horseshoe on these sets by the steps that there are."""
        covering = [
            next((step for step in self.slopes if step[1].over(domain)), None)
            for domain in (sets.left, sets.right)
        ]
        slopes = [each for each in covering if each is not None]
        for gap in self.gaps if len(slopes) == len(covering) else ():
            with suppress(Unproved), self.prover.undone():
                return self.prover.horseshoe(slopes, gap, sets)
        return None


def prove(
    numbers: Parameters,
    claims: Sequence[str] = GROUPS["horseshoe"],
    *,
    digits: int = 30,
    horizon: Fraction = HORIZON,
    tell: Tell = lambda stage: None,
) -> Evidence:
    """Prove what the claims asked for rest on, and repair the sets where the printed ones fail.

    Work is done for what is asked only: slopes for H1-H3, H5, H6, the gap for H4 and H5, roots for
    H11; a repair where one of H1-H6 asked for is refuted. If floating point expects a repair, the
    steps are made on the hulls of the given and the corrected sets at once.
    """
    run = _Run(Prover(System(numbers.eta, numbers.nu), digits, horizon), numbers, tell)
    needs_slopes, needs_gap = _NEEDS_SLOPES.intersection(claims), _NEEDS_GAP.intersection(claims)
    sets = (numbers, *islice(nearest_sets(numbers), 1)) if needs_slopes or needs_gap else (numbers,)
    if needs_slopes and not run.prove_slopes(*sets):
        run.prove_slopes(numbers)
    escapes = needs_gap and next(run.suspects("H4", finest=8, stride=6), None) is None
    if escapes and not run.prove_gap(*sets):
        run.prove_gap(numbers)
    evidence = Evidence(run.prover.steps)
    for claim in claims:
        if claim in _DECIDE:
            evidence.proofs[claim] = run.evidence(claim)
            parts = ["slopes"] * (claim in needs_slopes) + ["gap"] * (claim in needs_gap)
            evidence.notes[claim] = "; ".join(run.failures[x] for x in parts if x in run.failures)
    if "H11" in claims and max(*numbers.moran_ratios, *numbers.reciprocals) < 1:
        ratios = dict.fromkeys((numbers.moran_ratios, numbers.reciprocals))
        with suppress(*FAILED):
            evidence.proofs["H11"] = [run.prover.root(each) for each in ratios]
    refuted = [
        claim
        for claim, proof in evidence.proofs.items()
        if claim in _DECIDE and run._verdict(claim, proof) is Verdict.REFUTED
    ]
    correction = run.correction() if refuted else None
    if correction is not None:
        for claim in refuted:
            evidence.proofs[claim].append(correction)
    return evidence
