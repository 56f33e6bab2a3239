"""Sections 3.1-3.2: is the plastic impact map a horseshoe on the printed sets?

Claims H1-H6, H11 and H16: candidates by floating point, proof by interval arithmetic, a
certificate of witnesses, and a repair where the printed numbers fail.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import partial
from itertools import islice
from time import perf_counter
from typing import Any, TypeVar

from intervals import DomainError, Undecided
from proofs.motion.candidate import next_impact
from proofs.motion.impact import HORIZON
from proofs.motion.system import System
from proofs.search.repair import grid, nearest_sets, places, rounded_slopes, short_decimal
from proofs.search.steps import Prover
from proofs.shell.groups import Row, certificate, printed
from proofs.trusted.certificate import parameters_to_json, texts
from proofs.trusted.facts import Facts, Parameters, PointFact, Range, SlopeRange
from proofs.trusted.statements import (
    HORSESHOE,
    STATEMENTS,
    Verdict,
    decide,
    image_arcs,
    quantities,
    theorem,
)

CLAIMS = tuple(STATEMENTS)
_Proved = TypeVar("_Proved")
_STAGES = {
    "slopes": "first impacts and slopes on I0 and I1",
    "gap": "where the gap between I0 and I1 goes",
    "witness": "a witness against a claim",
}
_NEEDS_SLOPES = {"H1", "H2", "H3", "H5", "H6"}
_NEEDS_GAP = {"H4", "H5"}


@dataclass
class Outcome:
    """What a run proved: rows for people, a certificate for the checker."""

    parameters: Parameters
    rows: list[Row]
    corrected: Parameters | None
    certificate: dict[str, Any]


@dataclass
class _Run:
    """The facts of one run, about the printed sets and about corrected ones, and their steps."""

    prover: Prover
    of: Parameters
    tell: Callable[[str], None]
    slope_steps: dict[str, SlopeRange] = field(default_factory=dict)
    gap_steps: dict[str, tuple[Range, Range]] = field(default_factory=dict)
    failures: dict[str, str] = field(default_factory=dict)

    def attempt(self, part: str, make: Callable[[], _Proved]) -> _Proved | None:
        """Make one part of the proof; what cannot be proved leaves a reason and no step."""
        self.tell(_STAGES[part])
        before = dict(self.prover.steps)
        try:
            return make()
        except (Undecided, DomainError) as failure:
            self.prover.steps = before
            self.failures[part] = str(failure)
            return None

    def prove_slopes(self, *sets: Parameters) -> bool:
        """Enclose f' on I0 and on I1, each the hull of those of the sets given."""
        for domains in ([one.left for one in sets], [one.right for one in sets]):
            points = sorted({end for domain in domains for end in domain})
            if not any(set(points) <= set(known.points) for known in self.slope_steps.values()):
                proved = self.attempt("slopes", partial(self.prover.slopes, points))
                if proved is None:
                    return False
                self.slope_steps[proved[0]] = proved[1]
        return True

    def prove_gap(self, *sets: Parameters) -> bool:
        """Prove that the gap, the hull of those of the sets given, avoids the hull of the Is."""
        phases = (min(one.gap[0] for one in sets), max(one.gap[1] for one in sets))
        target = (min(one.interval[0] for one in sets), max(one.interval[1] for one in sets))
        name = self.attempt("gap", partial(self.prover.avoids, phases, target))
        if name is not None:
            self.gap_steps[name] = (phases, target)
        return name is not None

    def facts(self, of: Parameters) -> tuple[Facts, list[str], list[str]]:
        """Return what the steps so far prove about `of`, and the names of those that do."""
        facts, slopes, gaps = Facts(), [], []
        for name, found in self.slope_steps.items():
            known = len(facts.slope_min)
            facts.add_slopes(of, found)
            slopes += [name] * (len(facts.slope_min) > known)
        for name, (phases, target) in self.gap_steps.items():
            if not facts.avoided:
                facts.add_avoided(of, phases, target)
                gaps += [name] * facts.avoided
        return facts, slopes, gaps

    # -- claims --------------------------------------------------------------------------------

    def claim(self, claim: str) -> tuple[Row, dict[str, Any]]:
        """Decide one claim at the printed sets; return its row and its certificate entry."""
        began = perf_counter()
        facts, proof = self.evidence(claim)
        witness: dict[str, Any] | None = None
        if facts.missed is not None:
            witness = {"interval": texts(facts.missed)}
        verdict, why = decide(claim, self.of, facts)
        point = self.witness(claim) if verdict is Verdict.UNDECIDED else None
        if point is not None:
            name, fact = point
            facts.points.append(fact)
            proof, witness = [name, *proof], {"point": name, "phase": str(fact.phase)}
            verdict, why = decide(claim, self.of, facts)
        if verdict is Verdict.UNDECIDED:
            parts = ["slopes"] * (claim in _NEEDS_SLOPES) + ["gap"] * (claim in _NEEDS_GAP)
            why = "; ".join([why] + [self.failures[x] for x in parts if x in self.failures])
        says, seconds = STATEMENTS[claim].says(self.of), perf_counter() - began
        row = Row(claim, verdict, says, why, quantities(claim, facts), seconds)
        return row, {
            "id": claim,
            "statement": row.statement,
            "verdict": verdict.value,
            "proof": proof,
            "witness": witness if verdict is Verdict.REFUTED else None,
            "corrected": None,
            "quantities": {
                name: printed(bounds, self.prover.digits) for name, bounds in row.quantities.items()
            },
        }

    def evidence(self, claim: str) -> tuple[Facts, list[str]]:
        """Return the facts that a claim rests on, and the names of the steps that prove them."""
        facts, slopes, gaps = self.facts(self.of)
        proof = slopes if claim in _NEEDS_SLOPES else []
        if claim == "H5":
            facts.missed = missed_interval(self.of, facts)
        if claim in _NEEDS_GAP and facts.missed is None:
            proof = proof + gaps
        if claim == "H11" and max(*self.of.moran_ratios, *self.of.reciprocals) < 1:
            for ratios in dict.fromkeys((self.of.moran_ratios, self.of.reciprocals)):
                name, bracket = self.prover.root(ratios)
                facts.add_root(self.of, ratios, bracket)
                proof = [*proof, name]
        return facts, proof

    def witness(self, claim: str) -> tuple[str, PointFact] | None:
        """Look for one phase that refutes a claim, by candidates, and prove it."""
        for phase in islice(self.suspects(claim), 3):
            proved = self.attempt("witness", partial(self.prover.point, phase))
            if proved is not None:
                return proved
        return None

    def suspects(self, claim: str, finest: int = 64, stride: int = 1) -> Iterator[Fraction]:
        """Yield phases that refute a claim in floating point, of a `grid` on its domains."""
        of = self.of
        domains = (of.gap,) if claim == "H4" else (of.left, of.right)
        for phase in (phase for domain in domains for phase in grid(domain, finest, stride)):
            candidate = next_impact(self.prover.system, float(phase))
            if candidate is None:
                continue
            _, image, slope = (Fraction(value) for value in candidate)
            guess = Facts(points=[PointFact(phase, (slope, slope), (image, image))])
            if decide(claim, of, guess)[0] is Verdict.REFUTED:
                yield phase

    # -- the repair ----------------------------------------------------------------------------

    def correction(self) -> tuple[Parameters, dict[str, Any]] | None:
        """Prove H1-H6 on the nearest sets on which that succeeds, slopes rounded outward."""
        for sets in islice(nearest_sets(self.of), 3):
            facts, _, _ = self.facts(sets)
            if not facts.slopes_known:
                self.prove_slopes(sets)
            if not facts.avoided:
                self.prove_gap(sets)
            facts, slopes, gaps = self.facts(sets)
            if not facts.slopes_known:
                continue
            bounds = (
                min(low for low, _ in facts.slope_min.values()),
                max(high for _, high in facts.slope_max.values()),
            )
            found = replace(
                sets,
                slopes=rounded_slopes(bounds, max(2, places(self.of.slopes))),
                ratios=None,
                printed_s0=None,
                epsilon=None,
                velocities=None,
                reach=None,
            )
            if found.slopes[0] > 1 and all(
                decide(claim, found, facts)[0] is Verdict.VERIFIED for claim in HORSESHOE
            ):
                return found, {
                    "parameters": parameters_to_json(found),
                    "theorem": theorem(found),
                    "proof": slopes + gaps,
                }
        return None


def missed_interval(of: Parameters, facts: Facts) -> Range | None:
    """Return a closed interval in I0 or I1 that seems to have no preimage in I0 or in I1."""
    low, high = of.interval
    for arc in image_arcs(of, facts):
        if arc is None:
            continue
        if arc[0][0] > low:
            return low, short_decimal(low, min(arc[0][0], of.left[1]))
        if arc[1][1] < high:
            return short_decimal(max(arc[1][1], of.right[0]), high), high
    return None


def prove(
    of: Parameters,
    claims: Iterable[str] = CLAIMS,
    *,
    digits: int = 30,
    horizon: Fraction = HORIZON,
    tell: Callable[[str], None] = lambda stage: None,
) -> Outcome:
    """Decide the claims asked for, and repair the sets where the printed ones fail.

    Work is done for what is asked only: slopes for H1-H3, H5, H6, the gap for H4 and H5, the
    root for H11; a repair where one of H1-H6 asked for is refuted. If floating point expects a
    repair, the steps are made on the hulls of the given and the corrected sets at once. `tell`
    hears of each part of the proof before it is made.
    """
    wanted = [claim for claim in CLAIMS if claim in set(claims)]
    run = _Run(Prover(System(of.eta, of.nu), digits, horizon), of, tell)
    needs_slopes, needs_gap = _NEEDS_SLOPES.intersection(wanted), _NEEDS_GAP.intersection(wanted)
    sets = (of, *islice(nearest_sets(of), 1)) if needs_slopes or needs_gap else (of,)
    if needs_slopes and not run.prove_slopes(*sets):
        run.prove_slopes(of)
    escapes = needs_gap and next(run.suspects("H4", finest=8, stride=6), None) is None
    if escapes and not run.prove_gap(*sets):
        run.prove_gap(of)
    decided = [run.claim(claim) for claim in wanted]
    refuted = [entry for row, entry in decided if is_repairable(row)]
    correction = run.correction() if refuted else None
    for entry in refuted:
        entry["corrected"] = correction and correction[1]["theorem"]
    entries = [entry for _, entry in decided]
    proved = certificate(of, run.prover.steps, entries, correction and correction[1])
    return Outcome(of, [row for row, _ in decided], correction and correction[0], proved)


def is_repairable(row: Row) -> bool:
    """Whether other sets or slopes could make the claim true."""
    return row.id in HORSESHOE and row.verdict is Verdict.REFUTED
