"""Work-precision diagrams: error or digits on one axis, time on the other, logarithmic.

A library has the same colour and mark in all of them: ours are shades of blue.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import cycle
from math import ceil, log10
from statistics import median
from typing import TYPE_CHECKING, Literal

from proofs.benchmark.curves import Curve, Point
from proofs.benchmark.peers import CODAC, FLINT, IV
from proofs.report.figures.style import Axes, style, svg_of

if TYPE_CHECKING:
    from matplotlib.artist import Artist

_OURS = ("#08519c", "o"), ("#6baed6", "<"), ("#4292c6", ">")  # colour, mark
_OTHERS = {  # by the end of their names
    FLINT: ("#e6550d", "s"),
    IV: ("#31a354", "^"),
    CODAC: ("#de2d26", "D"),
    "algorithm A.1": ("#8c6d31", "v"),
    "RK45": ("#756bb1", "P"),
    "DOP853": ("#c51b8a", "X"),
}


@dataclass(frozen=True)
class Diagram:
    """Curves that belong together, the name of their file, their title, and what is across.

    `against` says which that is: the error, or its digits, -log10 of it. Errors up to `least` are
    not drawn; if `certified`, neither are curves that prove nothing.
    panels: each form, the first part of the name of a way, has a panel of its own.
    """

    name: str
    title: str
    across: str = "error"
    against: Literal["error", "digits"] = "error"
    curves: list[Curve] = field(default_factory=list)
    least: float = 0.0
    certified: bool = False
    panels: bool = False

    def place(self, point: Point) -> float:
        """Return the place of a point on the horizontal axis; 0 is none."""
        error = abs(point.error or 0.0)
        if error <= self.least:
            return 0.0
        return error if self.against == "error" else -log10(error)


def svg(diagram: Diagram) -> str:
    """Return an SVG: medians as marks, least to largest time as bars.

    ImportError without matplotlib.
    """
    panels: dict[str, list[Curve]] = {}
    for curve in diagram.curves:
        form = curve.way.partition(", ")[0] if diagram.panels else ""
        if curve.proved or not diagram.certified:
            panels.setdefault(form, []).append(curve)
    columns, rows = min(len(panels), 3), ceil(len(panels) / 3)
    size = (9.5, 2.7 * rows + 1.0) if diagram.panels else (7.5, 5.0)
    with style(diagram.name):
        from matplotlib import pyplot as plt

        figure = plt.figure(figsize=size)
        grid = figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False).flat
        artists: dict[str, Artist] = {}
        for axes, (form, curves) in zip(grid, panels.items(), strict=False):
            axes.set(xscale="log", yscale="log", title=form)
            axes.grid(alpha=0.3)
            artists |= _draw(axes, diagram, curves)
        for axes in grid[len(panels) :]:
            axes.set_visible(False)
        if diagram.against == "error":
            grid[0].invert_xaxis()  # smaller errors to the right; the panels share their axes
        figure.suptitle(diagram.title)
        below = min(columns * (rows - 1) + columns // 2, len(panels) - 1)
        grid[below].set_xlabel(diagram.across)
        figure.supylabel("time [s]", fontsize=9)
        names = list(artists)
        if len(names) > 1:
            wide = 4 if max(map(len, names)) <= 20 else 2
            figure.legend(artists.values(), names, loc="outside lower center", ncols=wide)
        return svg_of(figure, diagram.name, diagram.title)


def _draw(axes: Axes, diagram: Diagram, curves: list[Curve]) -> dict[str, Artist]:
    """Draw curves into a panel; return what is drawn by name."""
    artists: dict[str, Artist] = {}
    own = cycle(_OURS)
    for curve in curves:
        colour, mark = of_peer(curve.way) or next(own)
        points = [(x, p) for p in curve.points if (x := diagram.place(p)) > 0]
        if points:
            name = curve.way.rpartition(", ")[2] if diagram.panels else curve.way
            places, times = zip(*((x, median(p.seconds)) for x, p in points), strict=True)
            line = "-" if curve.against else "none"  # what has no order is not joined
            (artists[name],) = axes.plot(places, times, mark, color=colour, ls=line, ms=4.5, lw=1)
        for x, p in points:
            axes.plot([x, x], [min(p.seconds), max(p.seconds)], color=colour, lw=0.6)
    return artists


def of_peer(way: str) -> tuple[str, str] | None:
    """Return colour and mark of another library; None if the way is ours."""
    return next((marked for end, marked in _OTHERS.items() if way.endswith(end)), None)
