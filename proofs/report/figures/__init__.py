"""The figures of the report, each drawn from a certificate that is there."""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module
from types import MappingProxyType
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from proofs.report.figures.figure import Figure

_PLACES: Mapping[str, tuple[str, str]] = MappingProxyType(
    {
        "figure-1": ("foundations", "model.FIGURE"),
        "figure-2": ("horseshoe", "impact_map.PRINTED"),
        "figure-3": ("dimension", "cantor.FIGURE"),
        "figure-4": ("horseshoe", "restitution.RECTANGLES"),
        "figure-5": ("circle", "circle.CIRCLE"),
        "figure-6": ("circle", "circle.TRANSIENTS"),
        "three-sets": ("chaos", "impact_map.THREE_SETS"),
        "restitution": ("persistence", "restitution.TRANSIENTS"),
        "figure-7a": ("single", "windows.FIGURE_A"),
        "figure-7b": ("single", "windows.FIGURE_B"),
        "section-5": ("soft", "soft.FIGURE"),
        "figure-8": ("resonance", "resonance.IMPACTS"),
        "figure-10": ("resonance", "resonance.TRACES"),
    }
)  # of each its certificate and where it is
_OWN: Mapping[str, tuple[str, str]] = MappingProxyType(
    {"curves": ("curves", "curves.FIGURE"), "dossier": ("explore", "dossier.FIGURE")}
)  # of what is no part of the report


def names(certificate: str = "") -> list[str]:
    """Return the names of the report's figures, or of all that one certificate alone gives."""
    places = {**_PLACES, **_OWN} if certificate else _PLACES
    return [name for name, (file, _) in places.items() if certificate in ("", file)]


def figures(certificate: str = "") -> list[Figure]:
    """Return the report's figures, or all that one certificate alone gives."""
    result = []
    for name in names(certificate):
        module, _, attribute = {**_PLACES, **_OWN}[name][1].partition(".")
        result.append(getattr(import_module(f"{__name__}.{module}"), attribute))
    return result
