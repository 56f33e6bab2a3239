"""The catalogue: which module holds the row of a claim, and which file its certificate.

Each module states the rows of a section: the conclusions that proof steps may reach, the theorems
that follow from these, and for each row a function from conclusions to a decision. The checker
reaches conclusions by arithmetic of its own; provers decide by the same functions.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from importlib import import_module
from types import MappingProxyType

from proofs.trusted.verdicts import Row

GROUPS: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "horseshoe": ("H1", "H2", "H3", "H4", "H5", "H6", "H11", "H16"),
        "foundations": ("M1", "M2", "M3", "M4", "M5", "M7", "M8", "M9", "A1", "A2"),
        "nonplastic": ("N1", "N2", "N3", "N4", "N5"),
        "sets": ("H7", "H8", "H9", "H10", "H12", "H14", "H15", "H17"),
        "dimension": ("H13", "G19"),
        "chaos": ("G5", "G20", "G9", "G11"),
        "circle": ("M6", "G1", "G2", "G3", "G4", "G6", "G10", "G13", "G14"),
        "entropy": ("G17", "G18", "H18"),
        "persistence": ("G7", "G8", "G12", "G15", "G16"),
        "single": ("P1", "P2", "P3", "P4", "P5", "P6"),
        "soft": tuple(f"S{number}" for number in range(1, 24)),
        "resonance": (*(f"R{number}" for number in range(1, 14)), "E1"),
    }
)
BEYOND: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "explore": ("X1", "X2", "X3", "X4", "X5", "X10"),
        "rebounding": ("X6", "X7", "X8", "X9"),
        "curves": ("C1", "C2", "C3", "C4"),
    }
)  # asked at any parameters, and not of the paper: no part of the ledger

_MODULES: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "s31_horseshoe": ("H1", "H2", "H3", "H4", "H5", "H6"),
        "s32_sets.invariant": ("H7", "H8", "H9", "H10"),
        "s32_sets.moran": ("H11",),
        "s32_sets.linear": ("H12", "H16"),
        "s32_sets.linear_steps": ("H14", "H15", "H17"),
        "s2_foundations": ("M1", "M2", "M3", "M4", "M5", "M7", "M8", "M9"),
        "s33_restitution.nonplastic": GROUPS["nonplastic"],
        "s32_sets.dimension": ("H13",),
        "s34_circle.other_sets": ("G5", "G20", "G11"),
        "s34_circle.thin": ("G19",),
        "s34_circle.entropy": ("G9",),
        "s34_circle.laps": ("G17",),
        "s34_circle.roots": ("H18",),
        "s34_circle.cycles": ("G18",),
        "s34_circle.circle": GROUPS["circle"][:-1],
        "s34_circle.touching": ("G14",),
        "s34_circle.persistence": ("G7", "G8", "G12"),
        "s34_circle.border": ("G15",),
        "s34_circle.attractors": ("G16",),
        "s4_single.single": GROUPS["single"],
        "s5_soft.soft": GROUPS["soft"][:10],
        "s5_soft.stability": GROUPS["soft"][10:],
        "s6_resonance.resonance": GROUPS["resonance"],
        "s7_appendix": ("A1", "A2"),
        "beyond.attractors": ("X1", "X2", "X3", "X4"),
        "beyond.flights": ("X5", "X10"),
        "beyond.restitution": BEYOND["rebounding"],
        "beyond.curves": BEYOND["curves"],
    }
)


def find(claim: str) -> Row | None:
    """Return the row of a claim by its id; only its own module is imported."""
    for name, claims in _MODULES.items():
        if claim in claims:
            rows: Sequence[Row] = import_module(f"{__name__}.{name}").ROWS
            return next(row for row in rows if row.id == claim)
    return None
