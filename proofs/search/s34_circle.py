"""Sections 2 and 3.4: where the mass sticks, and how much of the circle ends up sticking.

Claims M6, G1-G4, G6, G10, G13 and G14: the sticking arc and the orbit through it, an interval of
phases that never impact again, and a partition of the circle into cells whose images are followed
until they stick, or never impact again.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from contextlib import suppress
from fractions import Fraction
from functools import partial
from typing import TypeVar

from intervals import Undecided
from proofs.methods.derivation import concluded
from proofs.motion.landing import separation
from proofs.search.derivations import Steps
from proofs.search.evidence import FAILED, Evidence
from proofs.search.request import Request, proving
from proofs.search.s34_absorbing import Partition
from proofs.search.s34_staying import prove_shift
from proofs.search.steps import Prover
from proofs.trusted.certificate import texts
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.numbers import hull
from proofs.trusted.paper.s2_foundations import unending
from proofs.trusted.paper.s34_circle.landing import NeverImpacts, Separation
from proofs.trusted.paper.s34_circle.other_sets import PRINTED

_STICKS = {"G1", "G2", "G3", "G4", "G6", "G10", "G13"}  # what rests on where the mass sticks
_NEVER = {"M6", "G4", "G6", "G10", "G13", "G14"}  # what rests on phases that never impact again
_FOLLOWED = {"G4", "G6", "G10", "G13"}  # what rests on where all others lead
_SYMBOLS = 3  # of the full shift around all invariant sets of section 3
_Step = TypeVar("_Step", bound=tuple[str, Conclusion])


@proving
def prove(request: Request) -> Evidence:
    """Prove what the claims asked for rest on; what fails is left out."""
    prover = request.prover()
    evidence = Evidence(prover.steps, {claim: [] for claim in request.claims})
    if not -1 < request.of.nu < 0 < request.of.eta < 1:
        return evidence

    def made(stage: str, rests: set[str], make: Callable[[], _Step]) -> _Step | None:
        """Make a step for the claims that rest on it, if any; what fails leaves no step."""
        claims = rests & evidence.proofs.keys()
        if not claims:
            return None
        request.tell(stage)
        with suppress(*FAILED), prover.undone():
            step = make()
            for claim in claims:
                evidence.proofs[claim].append(step)
            return step
        return None

    arc = made("where the mass sticks", _STICKS, partial(prove_arc, prover))
    never = made("phases without a next impact", _NEVER, partial(prove_longest, prover))
    if request.asks("M6"):
        lemmas = Steps(request.digits, steps=prover.steps)
        evidence.proofs["M6"] += filter(None, map(lemmas.prove, unending.needs))
    if arc is not None:
        made("where all others lead", _FOLLOWED, Partition(prover, arc, never).prove)
    around = hull([request.of.interval, PRINTED])
    made("a full shift", {"G6"}, partial(prove_shift, prover, around, _SYMBOLS))
    return evidence


def prove_arc(prover: Prover) -> tuple[str, Separation]:
    """Prove where the mass sticks and where it lands after it separates (rule separation)."""
    return prover.derive("separation", separation(prover.system, prover.bits + 30))


def prove_longest(prover: Prover) -> tuple[str, NeverImpacts]:
    """Prove an interval around pi/2 without a next impact, to twelve places the longest."""
    low, high, centre, unit = 0, 10**12, Fraction(math.pi / 2), Fraction(1, 10**12)

    def around(reach: int) -> tuple[Fraction, Fraction]:
        return round(centre - reach * unit, 12), round(centre + reach * unit, 12)

    while high - low > 1:
        middle = (low + high) // 2
        try:
            concluded("never-impacts", {"phases": texts(around(middle))}, prover.context)
            low = middle
        except FAILED:
            high = middle
    if low == 0:
        raise Undecided("no interval of phases without a next impact")
    return prover.derive("never-impacts", {"phases": texts(around(low))})
