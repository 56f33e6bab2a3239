"""The figures of the report: `FIGURES`, each drawn from a certificate that is there.

python -m proofs.report.figures --help
"""

from proofs.report.figures import (
    cantor,
    circle,
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

OWN_FIGURES = (dossier.FIGURE,)  # of certificates at parameters of one's own

__all__ = ["FIGURES", "OWN_FIGURES", "Certificates", "Documents", "Figure"]
