"""Figure 6 of the paper as a theorem: how many impacts phases need at most to stick."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from proofs.report.figures.figure import Documents, Figure
from proofs.trusted.numbers import Range
from proofs.trusted.paper.s34_circle.absorption import Absorption
from proofs.trusted.paper.s34_circle.landing import NeverImpacts, Separation
from proofs.trusted.verdicts import told

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Drawing

Bars = list[tuple[float, float, int]]


def proved(documents: Documents) -> tuple[Bars, list[tuple[float, float]]]:
    """Return the intervals that stick within n impacts, and those that
    never impact again; phases in [0, 2 pi)."""
    bars: Bars = []
    never: list[tuple[float, float]] = []
    for step in documents["circle"].known.values():
        if isinstance(step, Absorption):
            for phases, count in step.within:
                bars += [(low, high, count) for low, high in _on_circle(phases)]
        if isinstance(step, NeverImpacts):
            never += _on_circle(step.phases)
        if isinstance(step, Separation):
            arc = _on_circle((step.start[1], step.phase[0]))
            bars += [(low, high, 0) for low, high in arc]
    return sorted(bars), never


def _on_circle(phases: Range) -> list[tuple[float, float]]:
    """Return the parts of an interval in [0, 2 pi)."""
    low, high = map(float, phases)
    if low >= 0:
        return [(low, high)]
    return (
        [(low + math.tau, math.tau), (0.0, high)]
        if high > 0
        else [(low + math.tau, high + math.tau)]
    )


def plot(documents: Documents) -> Drawing:
    """Draw what is proved: on the whole circle, and around [1.1, 1.76]."""
    from matplotlib import pyplot as plt

    bars, never = proved(documents)
    drawing, both = plt.subplots(2, 1, figsize=(6.4, 5.2))
    for axes, ends in zip(both, ((0.0, math.tau), (1.09, 1.77)), strict=True):
        _draw(axes, bars, never)
        axes.set(xlim=ends, xlabel=r"$\phi$ [rad]", ylabel="impacts, at most")
    both[1].legend(fontsize=7, loc="upper left")
    return drawing


def caption(documents: Documents) -> str:
    """Return what is proved of the circle."""
    kinds = Absorption, NeverImpacts, Separation
    return told(x for x in documents["circle"].known.values() if isinstance(x, kinds))


def _draw(axes: Axes, bars: Bars, never: list[tuple[float, float]]) -> None:
    """Draw a bar for each interval, and where there is no next impact."""
    lows, widths = [low for low, _, _ in bars], [high - low for low, high, _ in bars]
    heights = [count for _, _, count in bars]
    axes.bar(lows, heights, widths, align="edge", color="C0", lw=0, label="proved for each phase")
    for low, high in never:
        axes.axvspan(low, high, color="C3", lw=1, label="no impact ever")
    axes.set_ylim(0, max(heights, default=0) + 2)


FIGURE = Figure(
    "figure-6",
    "Figure 6: impacts before the mass sticks",
    ("G4", "G6"),
    ("circle",),
    caption,
    plot,
)
