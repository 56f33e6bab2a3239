"""The impact map on the circle at parameters of one's own, with all that is proved there."""

from __future__ import annotations

import math
from itertools import pairwise

from intervals import Undecided
from proofs.motion.system import System
from proofs.report.figures import style
from proofs.report.figures.circle import on_circle
from proofs.report.figures.figure import Figure, all_of
from proofs.report.figures.impact_map import graph
from proofs.report.figures.style import Drawing
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.coverings import EntropyBound
from proofs.trusted.kernel.loops import StableOrbit
from proofs.trusted.kernel.staying import StayingSet
from proofs.trusted.numbers import Range
from proofs.trusted.paper.beyond.returning import StickingMotion
from proofs.trusted.paper.s34_circle.landing import NeverImpacts, Separation

_SAMPLES = 1200
_BELOW = (-0.12, 0.0)  # where sets of phases are marked


def crossings(shift: StayingSet) -> list[tuple[Range, Range]]:
    """Return a box for each arrow: f crosses it from its lower to its upper edge, or down."""
    return [(shift.cells[i], shift.cells[j]) for i, after in enumerate(shift.onward) for j in after]


def steps(cells: tuple[Range, ...]) -> list[tuple[Range, Range]]:
    """Return boxes that hold f on each of these sets, which is mapped into the next."""
    return list(pairwise(cells))


def plot(proved: Context) -> Drawing:
    """Draw f, and the sets of all conclusions."""
    statement = proved.of
    kinds = (StayingSet, EntropyBound, StableOrbit, StickingMotion, NeverImpacts)
    if not any(all_of(proved, kind) for kind in kinds):
        raise Undecided("the certificate proves nothing about sets of phases")
    drawing, axes = style.sheet(5.2)
    for arc in all_of(proved, Separation):
        sticking = [(part, _BELOW) for part in on_circle((arc.start[1], arc.phase[0]))]
        style.proved_boxes(axes, sticking, style.ORANGE, "the mass sticks, proved")
    for none in all_of(proved, NeverImpacts):
        label = "no impact ever, proved"
        style.proved_boxes(axes, [(none.phases, (0, math.tau))], style.RED, label, lw=0.8)
    for shift in all_of(proved, StayingSet):
        style.proved_boxes(axes, crossings(shift), "#C6E5F7", "crossed by f, proved", lw=0.3)
    for graph_found in all_of(proved, EntropyBound):
        branches = [(branch.source, _BELOW) for branch in graph_found.branches]
        style.proved_boxes(axes, branches, style.BLUE, "branches of a covering graph, proved")
    for orbit in all_of(proved, StableOrbit):
        boxes = steps((*orbit.cells, orbit.cells[0]))
        style.proved_boxes(axes, boxes, style.BLUE, "a stable orbit, proved", lw=4)
    for motion in all_of(proved, StickingMotion):
        style.proved_boxes(axes, steps(motion.cells), style.ORANGE, "its impacts, proved", lw=4)
    style.dots(
        axes, graph(System(statement.eta, statement.nu), 0.0, math.tau, _SAMPLES), "f, sampled"
    )
    axes.plot([0, math.tau], [0, math.tau], color=style.GREY, lw=0.6, label=r"$f(\phi) = \phi$")
    axes.set(xlabel=r"$\phi$ [rad]", ylabel=r"$f(\phi)$ [rad]")
    axes.set(xlim=(0, math.tau), ylim=(_BELOW[0], math.tau))
    style.legend_below(drawing, axes, 2)
    return drawing


FIGURE = Figure(
    "dossier",
    "The impact map on the circle",
    ("X2", "X3", "X4", "X5"),
    "explore",
    "Here a sticking mass is mapped to the phase at which it leaves. Filled: proved. Dots: f in "
    "floating point.",
    plot,
)
