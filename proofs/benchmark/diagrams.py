"""Work-precision diagrams: error, digits or size on one axis, time on the other, logarithmic.

A library has the same colour and mark in all of them: ours are shades of blue.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import cycle
from math import ceil, isfinite, log10
from typing import TYPE_CHECKING, Literal

from proofs.benchmark.peers import CODAC, FLINT, IV
from proofs.benchmark.curves import Curve, Point
from proofs.report.markup import svg_text

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes

_OURS = ("#08519c", "o"), ("#6baed6", "<"), ("#4292c6", ">")  # colour, mark
_OTHERS = {  # by the end of their names
    FLINT: ("#e6550d", "s"),
    IV: ("#31a354", "^"),
    CODAC: ("#de2d26", "D"),
    "algorithm A.1": ("#8c6d31", "v"),
    "steps that pass no zero": ("#636363", "*"),
    "RK45": ("#756bb1", "P"),
    "DOP853": ("#c51b8a", "X"),
}
_COLUMNS = 3
_SHORT = 20  # letters: four such names fit side by side


@dataclass(frozen=True)
class Diagram:
    """Curves that belong together, the name of their file, their title, and what is across.

    `against` says which that is: the error; its digits, -log10 of it; or the size of the work.
    Errors up to `least` are not drawn; if `certified`, neither are curves that prove nothing.
    panels: each form, the first part of the name of a way, has a panel of its own. Notes name
    points; what has no order is not joined.
    """

    name: str
    title: str
    curves: Sequence[Curve]
    across: str = "error"
    against: Literal["error", "digits", "size"] = "error"
    least: float = 0.0
    certified: bool = False
    panels: bool = False

    def place(self, point: Point) -> float:
        """Return the place of a point on the horizontal axis; 0 is none."""
        error = abs(point.error or 0.0)
        if self.against == "size":
            return point.size
        if error <= self.least or not isfinite(error):
            return 0.0
        return error if self.against == "error" else -log10(error)


def svg(diagram: Diagram) -> str:
    """Return an SVG: medians as marks, least to largest time as bars.

    ImportError without matplotlib.
    """
    import matplotlib as mpl

    mpl.use("svg")
    from matplotlib import pyplot as plt

    panels: dict[str, list[Curve]] = {} if diagram.panels else {"": []}
    for curve in diagram.curves:
        if curve.proved or not diagram.certified:
            form = curve.way.rpartition(", ")[0] or curve.way
            panels.setdefault(form if diagram.panels else "", []).append(curve)
    columns = min(len(panels), _COLUMNS)
    rows = ceil(len(panels) / columns)
    size = (7.5, 5.0) if columns == 1 else (9.5, 2.7 * rows + 1.0)
    with mpl.rc_context({"svg.hashsalt": diagram.name, "font.size": 9, "legend.fontsize": 8}):
        figure = plt.figure(figsize=size, layout="constrained")
        grid = figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False).flat
        known: dict[str, Artist] = {}
        for axes, (form, curves) in zip(grid, panels.items(), strict=False):
            axes.set(xscale="log", yscale="log", title=form)
            axes.grid(alpha=0.3)
            known |= _draw(axes, diagram, curves)
        for axes in grid[len(panels) :]:
            axes.set_visible(False)
        _scale(grid[0], diagram.against)
        figure.suptitle(diagram.title)
        figure.supxlabel(diagram.across, fontsize=9)
        figure.supylabel("time [s]", fontsize=9)
        if len(known) > 1:
            names = 4 if max(map(len, known)) <= _SHORT else 2
            figure.legend(known.values(), known, loc="outside lower center", ncols=names)
        return svg_text(figure)


def _draw(axes: Axes, diagram: Diagram, curves: Sequence[Curve]) -> dict[str, Artist]:
    """Draw curves into a panel; return what is drawn by name, each name once."""
    known: dict[str, Artist] = {}
    own = cycle(_OURS)
    for curve in curves:
        colour, mark = style(curve.way) or next(own)
        points = [(diagram.place(p), p) for p in curve.points if p.seconds]
        points = [(x, p) for x, p in points if x > 0]
        if not points:
            continue
        name = curve.way.rpartition(", ")[2] if diagram.panels else curve.way
        line = "-" if curve.against else "none"
        places, times = zip(*((x, p.time) for x, p in points), strict=True)
        (known[name],) = axes.plot(places, times, color=colour, marker=mark, ls=line, ms=4.5, lw=1)
        for x, p in points:
            axes.plot([x, x], [min(p.seconds), max(p.seconds)], color=colour, lw=0.6)
            axes.annotate(p.note, (x, p.time), (4, 4), textcoords="offset points", size=7)
    return known


def style(way: str) -> tuple[str, str] | None:
    """Return colour and mark of others; None if the way is ours."""
    return next((one for end, one in _OTHERS.items() if way.endswith(end)), None)


def _scale(axes: Axes, against: str) -> None:
    """Show a decade at least, smaller errors to the right, and digits and sizes as plain numbers.

    The panels share their axes: one stands for all.
    """
    from matplotlib.ticker import LogFormatter

    for axis in (axes.xaxis, axes.yaxis):
        low, high = axis.get_view_interval()
        widen = max(1.0, (10 * low / high) ** 0.5)
        axis.set_view_interval(low / widen, high * widen, ignore=True)
    if against == "error":
        axes.invert_xaxis()
    else:
        axes.xaxis.set_major_formatter(LogFormatter(labelOnlyBase=False))
        plain = LogFormatter(labelOnlyBase=False, minor_thresholds=(2, 0.5))
        axes.xaxis.set_minor_formatter(plain)
