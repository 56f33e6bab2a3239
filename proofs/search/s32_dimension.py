"""Claim 1 read for the map itself: the Hausdorff dimension of the set that stays in I (H13)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import partial
from itertools import islice

from intervals import DomainError, Undecided
from proofs.methods.dimension import dimension, precision
from proofs.motion.covering import cover_by_impacts
from proofs.motion.impact import HORIZON, FirstImpact
from proofs.motion.inverse import InverseBranch, InverseSystem
from proofs.motion.system import System
from proofs.search.evidence import Evidence, Tell
from proofs.search.repair import nearest_sets, short_decimal
from proofs.search.steps import Prover
from proofs.trusted.certificate import texts
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.numbers import Range
from proofs.trusted.paper.s32_sets.dimension import CLAIMS as STATED
from proofs.trusted.paper.s32_sets.dimension import FULL, WITHOUT_000, Repeller
from proofs.trusted.paper.s32_sets.moran import MoranRoot
from proofs.trusted.parameters import Parameters

CLAIMS = tuple(claim.id for claim in STATED)
_MOST_DIGITS = 30  # of the dimension: time grows faster than their square
_TRIES = 100
_SLACK = 20  # bits by which a bracket is wider than rounding

Proof = list[tuple[str, Conclusion]]


@dataclass
class _Run:
    """One run: its prover, the digits of the dimension, and whom to tell of the stages."""

    of: Parameters
    prover: Prover
    digits: int
    tell: Tell
    flights: dict[Range, tuple[str, FirstImpact]] = field(default_factory=dict)

    def attempt(self, make: Callable[[], Proof]) -> Proof:
        """Make a part of the proof; what cannot be proved leaves no step."""
        steps, flights = dict(self.prover.steps), dict(self.flights)
        try:
            return make()
        except (Undecided, DomainError):
            self.prover.steps, self.flights = steps, flights
            return []

    def root(self, ratios: Range) -> tuple[str, MoranRoot]:
        """Bracket the root of r0^s + r1^s = 1."""
        return self.prover.root(ratios)

    def whole(self, sets: Parameters) -> Proof:
        """Enclose the dimension of the full horseshoe on `sets`; roughly by slopes alone too."""
        self.tell("where the gap between the two sets goes")
        gap = min(sets.gap[0], self.of.gap[0]), max(sets.gap[1], self.of.gap[1])
        escape = self.prover.avoids(gap, sets.interval)
        name, found = self.repeller(sets, FULL)
        # slopes in hundredths, outward: the checker's enclosures may be a little wider
        steep = [Fraction(high * 100 // 1 + 2, 100) for _, high in found.slopes]
        flat = [Fraction(low * 100 // 1 - 1, 100) for low, _ in found.slopes]
        crude = [self.root((1 / z[0], 1 / z[1])) for z in (steep, flat) if min(z) > 1]
        return [escape, (name, found), *crude]

    def without_000(self) -> Proof:
        """Enclose the dimension of Lambda(I) where it is a part of a horseshoe, that of no 000."""
        start = self.of.interval[0]
        first = self.prover.point(start)
        second = self.prover.point(short_decimal(start, first[1].image[0]))
        return [first, second, self.repeller(self.of, WITHOUT_000)]

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
        domains, hull = (sets.left, sets.right), sets.interval
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
        return name, Repeller(hull, domains, words, found.slopes, found.bounds)


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
    run_ = _Run(of, Prover(System(of.eta, of.nu), digits, HORIZON), digits, tell)
    proof: Proof = []
    if max(of.moran_ratios) < 1:
        proof.append(run_.root(of.moran_ratios))
    nearest = (
        sets
        for sets in islice(nearest_sets(of), _TRIES)
        if sets.interval[0] <= of.interval[0] and of.interval[1] <= sets.interval[1]
    )
    sets = next(nearest, None)
    if sets is not None:
        proof += run_.attempt(partial(run_.whole, sets))
        if sets.interval != of.interval:
            proof += run_.attempt(run_.without_000)
    return Evidence(run_.prover.steps, {"H13": proof})
