"""Figure 6: how many impacts phases need at most until the mass sticks."""

from __future__ import annotations

import math

from proofs.report.figures import style
from proofs.report.figures.circle import on_circle
from proofs.report.figures.figure import Figure, all_of, the
from proofs.report.figures.style import Axes, Drawing
from proofs.trusted.kernel.context import Context
from proofs.trusted.paper.s34_circle.absorption import Absorption
from proofs.trusted.paper.s34_circle.landing import NeverImpacts

_UNDER = -0.6  # where what is not counted is marked


def plot(proved: Context) -> Drawing:
    """Draw what is proved: on the whole circle, and around [1.1, 1.76]."""
    drawing, both = style.sheet(4.6, 2, 1)
    for axes, ends in zip(both, ((0.0, math.tau), (1.06, 1.78)), strict=True):
        _draw(axes, proved)
        axes.set(xlim=ends, ylim=(_UNDER, 12.5), ylabel="impacts, at most", yticks=range(0, 13, 2))
    both[1].set_xlabel(r"$\phi$ [rad]")
    style.legend_below(drawing, both[0], 4)
    return drawing


def _draw(axes: Axes, proved: Context) -> None:
    """Draw a bar for each interval; below grey nothing is decided."""
    absorption = the(proved, Absorption)
    axes.axhspan(_UNDER, 0, color="0.8", lw=0, zorder=0, label="not proved")
    arc, under = absorption.arc, (_UNDER, 0)
    sticks = (arc.start[1], arc.phase[0])
    style.proved_boxes(axes, [(sticks, under)], style.ORANGE, "sticks at once, proved", lw=0)
    style.proved_boxes(axes, bars(absorption), style.BLUE, "within n impacts, proved", lw=0)
    never = [(step.phases, (_UNDER, 12)) for step in all_of(proved, NeverImpacts)]
    style.proved_boxes(axes, never, style.RED, "no impact ever, proved", lw=0.6)


def bars(absorption: Absorption) -> list[tuple[tuple[float, float], tuple[float, int]]]:
    """Return the bars: phases in [0, 2 pi), and up to how many impacts."""
    return [
        (part, (_UNDER, count)) for phases, count in absorption.within for part in on_circle(phases)
    ]


FIGURE = Figure(
    "figure-6",
    "Figure 6: impacts before the mass sticks",
    ("G4", "G6"),
    "circle",
    "A bar is as high as the number of impacts within which every phase under it is proved to "
    "stick; nothing is sampled.",
    plot,
)
