"""The catalogue: which module holds the row of a claim, and which file its certificate.

Each module states the rows of a section: the conclusions that proof steps may reach, the theorems
that follow from these, and for each row a function from conclusions to a decision. Prover and
checker reach conclusions by arithmetic of their own and decide by the same functions.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from importlib import import_module
from types import MappingProxyType

from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.numbers import Range
from proofs.trusted.parameters import Parameters
from proofs.trusted.verdicts import Row, Verdict

GROUPS: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "horseshoe": ("H1", "H2", "H3", "H4", "H5", "H6", "H11", "H16"),
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

_MODULES: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "s31_horseshoe": ("H1", "H2", "H3", "H4", "H5", "H6"),
        "s32_sets.invariant": ("H7", "H8", "H9", "H10"),
        "s32_sets.moran": ("H11",),
        "s32_sets.linear": ("H12", "H14", "H15", "H16", "H17"),
        "s2_foundations.relations": GROUPS["foundations"],
        "s33_restitution.nonplastic": GROUPS["nonplastic"],
        "s32_sets.dimension": GROUPS["dimension"],
        "s34_circle.chaos": GROUPS["chaos"],
        "s34_circle.circle": GROUPS["circle"],
        "s34_circle.persistence": GROUPS["persistence"],
        "s4_single.single": GROUPS["single"],
        "s5_soft.soft": GROUPS["soft"],
        "s6_resonance.resonance": GROUPS["resonance"],
    }
)


@dataclass(frozen=True)
class Decision:
    """What conclusions prove about a claim: of the sections that are not yet rows."""

    verdict: Verdict
    why: str
    witness: str | None = None
    corrected: str | None = None
    quantities: Mapping[str, Range] = field(default_factory=dict)

    @property
    def theorem(self) -> str | None:
        """The strongest true statement nearby."""
        return self.corrected


def undecided(missing: str) -> Decision:
    """Return that nothing is decided, and what is missing."""
    return Decision(Verdict.UNDECIDED, missing)


@dataclass(frozen=True)
class Claim:
    """A claim of the sections that are not yet rows."""

    id: str
    text: str
    decide: Callable[[Parameters, Sequence[Conclusion]], Decision]

    def says(self, of: Parameters) -> str:
        """Return the claim in words at the given numbers."""
        return of.fill(self.text)


def group_of(claim: str) -> str | None:
    """Return the group that a claim belongs to, None for an unknown id."""
    return next((group for group, claims in GROUPS.items() if claim in claims), None)


def find(claim: str) -> Row | Claim | None:
    """Return the row of a claim by its id; only its own module is imported."""
    for name, claims in _MODULES.items():
        if claim in claims:
            module = import_module(f"{__name__}.{name}")
            rows: Sequence[Row | Claim] = getattr(module, "ROWS", None) or module.CLAIMS
            return next(row for row in rows if row.id == claim)
    return None
