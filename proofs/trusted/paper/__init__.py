"""The claims beyond H1-H6, H11 and H16: what they say, and what decides them. Trusted, and shared.

Each module states the claims of a group: the conclusions that proof steps may reach, as frozen
dataclasses, and for each claim a function from conclusions to a `Decision`. Prover and checker
reach the conclusions by arithmetic of their own and decide by the same function.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from importlib import import_module
from types import MappingProxyType
from typing import Any

from proofs.trusted.facts import Parameters, Range
from proofs.trusted.statements import Verdict, fill

GROUPS: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "foundations": ("M1", "M2", "M3", "M4", "M5", "M7", "M8", "M9", "A1", "A2"),
        "nonplastic": ("N1", "N2", "N3", "N4"),
        "sets": ("H7", "H8", "H9", "H10", "H12", "H14", "H15", "H17"),
        "dimension": ("H13",),
        "chaos": ("G5", "G9"),
        "circle": ("M6", "G1", "G2", "G3", "G4", "G6"),
        "persistence": ("G7", "G8"),
        "single": ("P1", "P2", "P3", "P4", "P5", "P6"),
        "soft": tuple(f"S{number}" for number in range(1, 24)),
        "resonance": (*(f"R{number}" for number in range(1, 14)), "E1"),
    }
)

_SECTIONS: Mapping[str, tuple[str, str | None]] = MappingProxyType(
    {
        "foundations": ("s2_foundations.relations", "s7_appendix.rules"),
        "nonplastic": ("s33_restitution.nonplastic", "s33_restitution.rules"),
        "sets": ("s32_sets.sets", "s32_sets.rules"),
        "dimension": ("s32_sets.dimension", "s32_sets.dimension_rules"),
        "chaos": ("s34_circle.chaos", "s34_circle.chaos_rules"),
        "circle": ("s34_circle.circle", "s34_circle.circle_rules"),
        "persistence": ("s34_circle.persistence", "s34_circle.persistence_rules"),
        "single": ("s4_single.single", "s4_single.rules"),
        "soft": ("s5_soft.soft", None),
        "resonance": ("s6_resonance.resonance", None),
    }
)


def rules_of(group: str) -> Mapping[str, Callable[..., Any]]:
    """Return the rules that a group of claims has, beside those about the impact map."""
    own = _SECTIONS[group][1]
    module = "proofs.trusted.kernel.derivation" if own is None else f"{__name__}.{own}"
    found: Mapping[str, Callable[..., Any]] = import_module(module).RULES
    return found


@dataclass(frozen=True)
class Decision:
    """What conclusions prove about a claim.

    why: a line with the numbers. witness: what refutes it, or the conditions it needs, exact.
    corrected: the strongest true statement nearby, complete. quantities: enclosures by name.
    """

    verdict: Verdict
    why: str
    witness: str | None = None
    corrected: str | None = None
    quantities: Mapping[str, Range] = field(default_factory=dict)


def undecided(missing: str) -> Decision:
    """Return that nothing is decided, and what is missing."""
    return Decision(Verdict.UNDECIDED, missing)


@dataclass(frozen=True)
class Claim:
    """A claim: its id in the catalogue, its text, the rule that decides it from conclusions."""

    id: str
    text: str
    decide: Callable[[Parameters, Sequence[object]], Decision]

    def says(self, of: Parameters) -> str:
        """Return the claim in words at the given numbers."""
        return fill(self.text, of)


def group_of(claim: str) -> str | None:
    """Return the group that a claim belongs to, None for an unknown id."""
    return next((group for group, claims in GROUPS.items() if claim in claims), None)


def find(claim: str) -> Claim | None:
    """Return a claim by its id; only its own group's module is imported."""
    group = group_of(claim)
    if group is None:
        return None
    claims: tuple[Claim, ...] = import_module(f"{__name__}.{_SECTIONS[group][0]}").CLAIMS
    return next(one for one in claims if one.id == claim)
