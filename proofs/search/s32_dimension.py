"""Claim 1 read for the map itself: the Hausdorff dimension of the set that stays in I (H13)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import partial

from intervals import Undecided
from proofs.methods.dimension import dimension, precision
from proofs.motion.covering import cover_by_impacts
from proofs.motion.impact import HORIZON, FirstImpact
from proofs.motion.inverse import InverseBranch, InverseSystem
from proofs.motion.system import System
from proofs.search.evidence import FAILED, Evidence, Proof, Tell
from proofs.search.s32_sets import LEAST_DIGITS, prove_staying
from proofs.search.steps import Prover
from proofs.trusted.certificate import texts
from proofs.trusted.numbers import Phases, Range
from proofs.trusted.paper.s32_sets.dimension import FULL, WITHOUT_000
from proofs.trusted.paper.s32_sets.invariant import staying as invariant_set
from proofs.trusted.paper.s32_sets.repeller import Repeller
from proofs.trusted.parameters import Parameters
from proofs.trusted.verdicts import Found

_MOST_DIGITS = 30  # of the dimension: time grows faster than their square
_SLACK = 20  # bits by which a bracket is wider than rounding


@dataclass
class _Run:
    """One run: its prover, the digits of the dimension, and whom to tell of the stages."""

    of: Parameters
    prover: Prover
    digits: int
    tell: Tell
    flights: dict[Range, tuple[str, FirstImpact]] = field(default_factory=dict)

    def attempt(self, make: Callable[[], tuple[str, Repeller]]) -> Proof:
        """Make a part of the proof; what cannot be proved leaves no step."""
        flights = dict(self.flights)
        with suppress(*FAILED), self.prover.undone():
            return [make()]
        self.flights = flights
        return []

    def impact(self, domain: Range) -> tuple[str, FirstImpact]:
        """Prove the first impact transversal on all of a domain, once."""
        if domain not in self.flights:
            found, *others = cover_by_impacts(self.prover.system, domain)
            if others:
                raise Undecided("the first impact is not proved transversal in one piece")
            self.flights[domain] = self.prover.add_impact(found), found
        return self.flights[domain]

    def repeller(self, sets: Parameters, words: tuple[str, ...]) -> tuple[str, Repeller]:
        """Enclose the dimension of the set of all sequences of these words (rule dimension)."""
        domains, hull = (Phases(*sets.left), Phases(*sets.right)), Phases(*sets.interval)
        radius = Fraction(1, 2 ** (precision(self.digits) - _SLACK))
        branches, flights = [], []
        for domain in domains:
            flight, impact = self.impact(domain)
            branches.append(InverseBranch(impact, domain, radius))
            flights.append(flight)
        if not all(branch.passes_once(hull) for branch in branches):
            raise Undecided("f is not proved to increase and to pass I once")
        bits = precision(self.digits)
        system = InverseSystem((branches[0], branches[1]), hull, words, radius, bits)
        if not system.images_are_disjoint():
            raise Undecided("the inverse images of I are not proved disjoint, and in I")
        found = dimension(system, hull, self.digits, self.tell)
        steps = 2 * found.pieces
        points = [hull[0] + (hull[1] - hull[0]) * j / steps for j in range(steps + 1)]
        centres = system.centres(points)
        name = self.prover.add(
            "dimension",
            {
                "flights": flights,
                "turns": [str(branch.turns) for branch in branches],
                "hull": texts(hull),
                "domains": [texts(domain) for domain in domains],
                "words": list(words),
                "inverse": [texts(centres[suffix]) for suffix in sorted(centres)],
                "radius": str(radius),
                "pieces": str(found.pieces),
                "order": str(found.order),
                "test": texts(found.trial.coefficients),
                "dimension": texts(found.bounds),
            },
        )
        return name, Repeller(self.prover.at, hull, domains, words, found.slopes, found.bounds)


def prove(
    of: Parameters,
    claims: Sequence[str],
    *,
    digits: int = 30,
    tell: Tell = lambda stage: None,
) -> Evidence:
    """Prove what H13 rests on: s_0, and the dimension to so many digits, 30 at most."""
    if "H13" not in claims:
        return Evidence()
    digits = min(digits, _MOST_DIGITS)
    run = _Run(of, Prover(System(of.eta, of.nu), max(digits, LEAST_DIGITS), HORIZON), digits, tell)
    proof: Proof = []
    if max(of.moran_ratios) < 1:
        proof.append(run.prover.root(of.moran_ratios))
    tell("a horseshoe around I, and the orbits of the ends of I")
    around = prove_staying(of, run.prover)
    proof += around
    if around:
        staying = invariant_set(of.interval, Found(of, [each for _, each in around]))
        base = staying.base
        whole = replace(of, left=base.left, right=base.right, interval=base.interval)
        proof += run.attempt(partial(run.repeller, whole, FULL))
        if staying.shift.factors == "000":
            proof += run.attempt(partial(run.repeller, of, WITHOUT_000))
    return Evidence(run.prover.steps, {"H13": proof})
