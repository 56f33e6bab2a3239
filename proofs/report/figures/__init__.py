"""The figures of the report: `FIGURES`, each drawn from certificates that are there.

python -m proofs.report.figures --help
"""

from proofs.report.figures import horseshoe, restitution, traces, transients, windows
from proofs.report.figures.figure import Certificates, Documents, Figure

FIGURES: tuple[Figure, ...] = (
    horseshoe.FIGURE,
    transients.FIGURE,
    restitution.FIGURE,
    windows.FIGURE_A,
    windows.FIGURE_B,
    traces.FIGURE,
)

__all__ = ["FIGURES", "Certificates", "Documents", "Figure"]
