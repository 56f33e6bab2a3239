"""Section 3.4: the horseshoes in [1.1, 1.49], one more than the paper saw."""

from __future__ import annotations

from intervals import Undecided
from proofs.motion.system import System
from proofs.report.figures import style
from proofs.report.figures.figure import Figure, all_of
from proofs.report.figures.impact_map import hulls
from proofs.report.figures.sampled import graph
from proofs.report.figures.style import Drawing
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.laps import SlopeRange
from proofs.trusted.kernel.staying import StayingSet
from proofs.trusted.numbers import show_range, within


def plot(proved: Context) -> Drawing:
    """Draw f over the cells of the largest full shift, and the intervals of all of them."""
    shifts = [each for each in all_of(proved, StayingSet) if each.whole]
    shifts.sort(key=lambda each: len(each.cells))
    if not shifts:
        raise Undecided("no full shift is proved")
    largest = shifts[-1]
    drawing, axes = style.sheet(4.6)
    parts = [part for each in all_of(proved, SlopeRange) for part in _inside(each, largest)]
    shapes = [shape for part in parts for shape in hulls(part)]
    style.proved_polygons(axes, shapes, style.BLUE, "graph of f, proved")
    low, high = (float(x) for x in largest.interval)
    style.dots(axes, graph(System(proved.of.eta, proved.of.nu), low, high, 400), "f, sampled")
    for shift, dashes in zip(shifts, ("--", "-"), strict=False):
        label = f"{show_range(shift.interval)}: full shift on {len(shift.cells)} symbols, proved"
        style.outline(axes, shift.interval, shift.interval, label, lw=0.7, ls=dashes)
    style.on_axis(axes, largest.cells, 1.06, "0.75")
    axes.plot([low, high], [low, high], color=style.GREY, lw=0.6, label=r"$f(\phi) = \phi$")
    axes.set(xlabel=r"$\phi$ [rad]", ylabel=r"$f(\phi)$ [rad]", ylim=(1.03, 1.56))
    style.legend_below(drawing, axes, 2)
    return drawing


def _inside(slopes: SlopeRange, shift: StayingSet) -> list[SlopeRange]:
    """Return what is known of f' on those cells that lie in a step's phases."""
    cells = [cell for cell in shift.cells if within(cell, slopes.domain)]
    return [part for cell in cells if (part := slopes.over(cell)) is not None]


FIGURE = Figure(
    "three-sets",
    "Section 3.4: horseshoes in [1.1, 1.49]",
    ("G5",),
    "chaos",
    "Filled: what the values and slopes in the certificate prove of the graph of f over the three "
    "sets 0, 1, 2 marked on the axis. Dots: f in floating point.",
    plot,
)
