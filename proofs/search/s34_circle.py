"""Sections 2 and 3.4: where the mass sticks, and how much of the circle ends up sticking.

Claims M6, G1-G4, G6 and G10: the sticking arc and the orbit through it, an interval of phases that
never impact again, and a partition of the circle into cells whose images are followed until they
stick.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from typing import TypeVar

from intervals import Undecided
from proofs.motion.candidate import next_impact
from proofs.motion.impact import HORIZON
from proofs.motion.landing import prove_never, prove_separation
from proofs.motion.system import System
from proofs.search.evidence import FAILED, Evidence
from proofs.search.s34_absorbing import Partition
from proofs.search.steps import Prover
from proofs.trusted.certificate import texts
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.numbers import Range
from proofs.trusted.paper.s34_circle.circle import (
    LONG,
    FixedPoint,
    repelling_fixed_point,
)
from proofs.trusted.paper.s34_circle.landing import NeverImpacts, Separation
from proofs.trusted.parameters import Parameters

_STICKS = {"G1", "G2", "G3", "G4", "G6", "G10"}  # what rests on where the mass sticks
_NEVER = {"M6", "G4", "G6", "G10"}  # what rests on phases that never impact again
_FOLLOWED = {"G4", "G6", "G10"}  # what rests on where all others lead
_REPELLED = _FOLLOWED  # what rests on a fixed point
_NARROW = 12  # decimal places
_Found = TypeVar("_Found", bound=Conclusion)


def prove(
    of: Parameters,
    claims: Sequence[str],
    *,
    digits: int = 30,
    tell: Callable[[str], None] = lambda stage: None,
) -> Evidence:
    """Prove what the claims asked for rest on; what fails is left out."""
    prover = Prover(System(of.eta, of.nu), digits, HORIZON)
    found = _Run(prover, Evidence(prover.steps, {claim: [] for claim in claims}), tell)
    if not -1 < of.nu < 0 < of.eta < 1:
        return found.evidence
    arc = found.attempt("where the mass sticks", _STICKS, partial(prove_arc, prover))
    found.attempt("phases without a next impact", _NEVER, partial(prove_longest, prover))
    if arc is not None:
        found.attempt("where all others lead", _FOLLOWED, Partition(prover, arc).prove)
    found.attempt("a fixed point", _REPELLED, partial(prove_fixed_point, prover))
    return found.evidence


@dataclass
class _Run:
    """The evidence of one run, by the steps of one prover."""

    prover: Prover
    evidence: Evidence
    tell: Callable[[str], None]

    def attempt(
        self, stage: str, rests: set[str], make: Callable[[], tuple[str, _Found]]
    ) -> tuple[str, _Found] | None:
        """Make a step for the claims that rest on it, if any; what fails leaves no step."""
        proofs = [proof for claim, proof in self.evidence.proofs.items() if claim in rests]
        if not proofs:
            return None
        self.tell(stage)
        with suppress(*FAILED), self.prover.undone():
            found = make()
            for proof in proofs:
                proof.append(found)
            return found
        return None


def prove_arc(prover: Prover) -> tuple[str, Separation]:
    """Prove where the mass sticks and where it lands after it separates (rule separation)."""
    found, times = prove_separation(prover.system, prover.bits + 30)
    witness = {"phase": texts(found.phase), "times": texts(times), "time": texts(found.time)}
    return prover.add("separation", witness), found


def prove_longest(prover: Prover) -> tuple[str, NeverImpacts]:
    """Prove an interval around pi/2 without a next impact, to nine places the longest."""
    low, high, centre, unit = 0, 10**9, Fraction(math.pi / 2), Fraction(1, 10**9)

    def around(reach: int) -> tuple[Fraction, Fraction]:
        return round(centre - reach * unit, 9), round(centre + reach * unit, 9)

    while high - low > 1:
        middle = (low + high) // 2
        try:
            prove_never(prover.system, around(middle))
            low = middle
        except FAILED:
            high = middle
    if low == 0:
        raise Undecided("no interval of phases without a next impact")
    phases = around(low)
    return prover.add("never-impacts", {"phases": texts(phases)}), prove_never(
        prover.system, phases
    )


def prove_fixed_point(prover: Prover) -> tuple[str, FixedPoint]:
    """Prove a repelling fixed point where transients are long (rule fixed-point)."""
    candidate = next(fixed_points(prover.system), None)
    if candidate is None:
        raise Undecided("no repelling fixed point is seen")
    (low, high), inner = candidate
    slopes, known = prover.slopes([low, *inner, high])
    return prover.add("fixed-point", {"slopes": slopes}), repelling_fixed_point(known)


def fixed_points(system: System) -> Iterator[tuple[Range, Range]]:
    """Yield wide and narrow intervals around repelling fixed points, in floating point."""
    unit, narrow = Fraction(1, 100), Fraction(1, 10**_NARROW)
    for index in range(int((LONG[1] - LONG[0]) / unit)):
        low = LONG[0] + index * unit
        first, last = (next_impact(system, float(x)) for x in (low, low + unit))
        if first is None or last is None or min(first[2], last[2]) <= 1:
            continue
        if first[1] < low and low + unit < last[1]:
            centre = round(Fraction(_fixed_point(system, float(low), float(low + unit))), _NARROW)
            yield (low, low + unit), (centre - narrow, centre + narrow)


def _fixed_point(system: System, low: float, high: float) -> float:
    """Return about the fixed point between two phases, by bisection."""
    for _ in range(60):
        middle = (low + high) / 2
        found = next_impact(system, middle)
        low, high = (low, middle) if found and found[1] > middle else (middle, high)
    return low
