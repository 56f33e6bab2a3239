"""The figures of the report: `FIGURES`, each drawn from a certificate that is there.

python -m proofs.report.figures --help
"""

from proofs.report.figures import (
    cantor,
    circle,
    curves,
    dossier,
    impact_map,
    model,
    rectangles,
    resonance,
    restitution,
    soft,
    three_sets,
    traces,
    transients,
    windows,
)
from proofs.report.figures.figure import Certificates, Documents, Figure

FIGURES: tuple[Figure, ...] = (
    model.FIGURE,
    impact_map.FIGURE,
    cantor.FIGURE,
    rectangles.FIGURE,
    circle.FIGURE,
    transients.FIGURE,
    three_sets.FIGURE,
    restitution.FIGURE,
    windows.FIGURE_A,
    windows.FIGURE_B,
    soft.FIGURE,
    resonance.FIGURE,
    traces.FIGURE,
)
OWN: tuple[Figure, ...] = (curves.FIGURE, dossier.FIGURE)  # of what is no part of the report

__all__ = ["FIGURES", "OWN", "Certificates", "Documents", "Figure"]
