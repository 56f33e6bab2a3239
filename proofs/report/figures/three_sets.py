"""Section 3.4: the horseshoes in [1.1, 1.49], one more than the paper saw."""

from __future__ import annotations

from typing import TYPE_CHECKING

from intervals import Undecided
from proofs.motion.system import System
from proofs.report.figures.figure import Figure, all_of
from proofs.report.figures.impact_map import hulls
from proofs.report.figures.sampled import graph
from proofs.report.figures.style import BLACK, BLUE, GREY, dots, proved_polygons, sheet
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.laps import SlopeRange
from proofs.trusted.kernel.staying import StayingSet
from proofs.trusted.numbers import Range, show_range, within

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Drawing


def plot(proved: Context) -> Drawing:
    """Draw f over the cells of the largest full shift, and the intervals of all of them."""
    shifts = [each for each in all_of(proved, StayingSet) if each.whole]
    shifts.sort(key=lambda each: len(each.cells))
    if not shifts:
        raise Undecided("no full shift is proved")
    largest = shifts[-1]
    drawing, axes = sheet(4.6)
    parts = [part for each in all_of(proved, SlopeRange) for part in _inside(each, largest)]
    shapes = [shape for part in parts for shape in hulls(part)]
    proved_polygons(axes, shapes, BLUE, "graph of f, proved")
    low, high = (float(x) for x in largest.interval)
    dots(axes, graph(System(proved.of.eta, proved.of.nu), low, high, 400), "f, sampled")
    for shift, style in zip(shifts, ("--", "-"), strict=False):
        label = f"{show_range(shift.interval)}: full shift on {len(shift.cells)} symbols, proved"
        _square(axes, shift.interval, style, label)
    for index, (first, last) in enumerate(largest.cells):
        middle = float(first + last) / 2
        axes.plot(
            [float(first), float(last)], [1.06, 1.06], color="0.75", lw=7, solid_capstyle="butt"
        )
        axes.text(middle, 1.06, str(index), ha="center", va="center")
    axes.plot([low, high], [low, high], color=GREY, lw=0.6, label=r"$f(\phi) = \phi$")
    axes.set(xlabel=r"$\phi$ [rad]", ylabel=r"$f(\phi)$ [rad]", ylim=(1.03, 1.56))
    drawing.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=2)
    return drawing


def _inside(slopes: SlopeRange, shift: StayingSet) -> list[SlopeRange]:
    """Return what is known of f' on those cells that lie in a step's phases."""
    cells = [cell for cell in shift.cells if within(cell, slopes.domain)]
    return [part for cell in cells if (part := slopes.over(cell)) is not None]


def _square(axes: Axes, interval: Range, style: str, label: str) -> None:
    low, high = (float(x) for x in interval)
    corners = [low, high, high, low, low], [low, low, high, high, low]
    axes.plot(*corners, style, color=BLACK, lw=0.7, label=label)


FIGURE = Figure(
    "three-sets",
    "Section 3.4: horseshoes in [1.1, 1.49]",
    ("G5",),
    "chaos",
    "Filled: what the values and slopes in the certificate prove of the graph of f over the three "
    "sets 0, 1, 2 marked on the axis. Dots: f in floating point.",
    plot,
)
