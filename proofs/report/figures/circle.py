"""Figures 5 and 6: the impact map on the whole circle, and how soon the mass sticks."""

from __future__ import annotations

import math

from proofs.motion.system import System
from proofs.report.figures import style
from proofs.report.figures.figure import Figure, all_of, the
from proofs.report.figures.impact_map import graph
from proofs.report.figures.style import Axes, Drawing
from proofs.trusted.kernel.context import Context
from proofs.trusted.numbers import Range
from proofs.trusted.paper.s34_circle.absorption import Absorption
from proofs.trusted.paper.s34_circle.landing import Lands, NeverImpacts, Separation


def on_circle(phases: Range) -> list[tuple[float, float]]:
    """Return the parts of an interval in [0, 2 pi)."""
    low, high = map(float, phases)
    if low >= 0:
        return [(low, high)]
    if high <= 0:
        return [(low + math.tau, high + math.tau)]
    return [(low + math.tau, math.tau), (0.0, high)]


def plot_circle(proved: Context) -> Drawing:
    """Draw f, the sticking arc, what lands on it at once, and the orbit."""
    arc = the(proved, Separation)
    drawing, axes = style.sheet(5.2)
    start, leaves, lands = (sum(map(float, x)) / 2 for x in (arc.start, arc.phase, arc.arrival))
    landing = [part for step in all_of(proved, Lands) for part in on_circle(step.phases)]
    label = "these phases land on the sticking arc at once, proved"
    style.proved_boxes(axes, [(part, (start, leaves)) for part in landing], "#C6E5F7", label, lw=0)
    label = "the mass sticks, and leaves at $\\phi_s$, proved"
    style.proved_boxes(axes, [((start, leaves), arc.phase)], style.ORANGE, label, lw=2.5)
    style.proved_boxes(axes, [((start, leaves), (-0.12, 0.0))], style.ORANGE)
    for step in all_of(proved, NeverImpacts):
        label = "no impact ever, proved"
        style.proved_boxes(axes, [(step.phases, (0, math.tau))], style.RED, label, lw=0.8)
    system = System(arc.at.eta[0], arc.at.nu[0])
    style.dots(axes, graph(system, 0.0, math.tau, 1200), "f, sampled")
    axes.plot([0, math.tau], [0, math.tau], color=style.GREY, lw=0.6, label=r"$f(\phi) = \phi$")
    _orbit(axes, lands, leaves)
    ticks = {0: "0", start: r"$\phi_a$", lands: r"$\phi_1$", leaves: r"$\phi_s$"}
    ticks |= {1: "1", 2: "2"}
    axes.set_xticks(list(ticks), list(ticks.values()))
    axes.set_yticks([0, 1, 2, 3, lands, leaves], ["0", "1", "2", "3", r"$\phi_1$", r"$\phi_s$"])
    axes.set(xlabel=r"$\phi$ [rad]", ylabel=r"$f(\phi)$ [rad]")
    axes.set(xlim=(0, math.tau), ylim=(-0.12, math.tau))
    style.legend_below(drawing, axes, 2)
    return drawing


def _orbit(axes: Axes, lands: float, leaves: float) -> None:
    """Draw the periodic orbit between the graph and the diagonal."""
    corners = [lands, lands, leaves, leaves, lands], [lands, leaves, leaves, lands, lands]
    axes.plot(*corners, "--", color=style.BLUE, lw=0.9)
    label = r"the orbit $\phi_1 \to \phi_s \to \phi_1$, proved"
    axes.plot([lands, leaves], [leaves, lands], "o", color=style.BLUE, markersize=5, label=label)


CIRCLE = Figure(
    "figure-5",
    "Figure 5: the impact map on the circle",
    ("G1", "G2", "G3", "G4"),
    "circle",
    "Here a sticking mass is mapped to the phase at which it leaves, as the paper's orbit is "
    "counted. Filled and blue: proved. Dots: f in floating point.",
    plot_circle,
)


_UNDER = -0.6  # where what is not counted is marked


def plot_transients(proved: Context) -> Drawing:
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


TRANSIENTS = Figure(
    "figure-6",
    "Figure 6: impacts before the mass sticks",
    ("G4", "G6"),
    "circle",
    "A bar is as high as the number of impacts within which every phase under it is proved to "
    "stick; nothing is sampled.",
    plot_transients,
)
