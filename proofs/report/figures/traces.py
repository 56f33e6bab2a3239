"""Figure 10 simulated: the mass at resonance, early and late, at a low and a high amplitude."""

from __future__ import annotations

from proofs.report.figures import style
from proofs.report.figures.figure import Figure
from proofs.report.figures.style import Drawing
from proofs.report.subharmonics import EPSILON, NUS, SAMPLES, WINDOW, WINDOWS, displacement
from proofs.trusted.kernel.context import Context


def plot(proved: Context) -> Drawing:
    """Draw the displacement at the lowest and the highest amplitude, early and late: simulated."""
    del proved
    drawing, all_axes = style.sheet(3.8, 2, 2, sharey="row", sharex="col")
    for row, nu in zip(all_axes, (NUS[0], NUS[-1]), strict=True):
        samples = displacement(nu, WINDOWS[-1] + WINDOW)
        for axes, first in zip(row, WINDOWS, strict=True):
            part = samples[first * SAMPLES : (first + WINDOW) * SAMPLES]
            axes.plot(
                [first + k / SAMPLES for k in range(len(part))], part, color=style.BLUE, lw=0.7
            )
            axes.set_title(rf"$\nu$ = {float(nu)}, $\varepsilon$ = {EPSILON}, simulated")
        row[0].set_ylabel("x / |p|")
    for axes in all_axes[1]:
        axes.set_xlabel("turns of the table")
    return drawing


FIGURE = Figure(
    "figure-10",
    "Figure 10: the mass at resonance",
    ("E1",),
    "resonance",
    f"A simulation in floating point at eta = 1, epsilon = {EPSILON}: the first turns of the table "
    f"and those from {WINDOWS[-1]} on, at the lowest and the highest amplitude of those tried.",
    plot,
)
