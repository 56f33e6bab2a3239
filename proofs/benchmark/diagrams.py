"""Work-precision diagrams: error, digits or size on one axis, time on the other, logarithmic.

A library has the same colour and mark in all of them: ours are shades of blue.
"""

from __future__ import annotations

import io
from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, isfinite, log10, sqrt
from typing import TYPE_CHECKING, Literal

from proofs.benchmark.curves import Curve, Point
from proofs.benchmark.peers import CODAC, FLINT, IV

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Style = tuple[str, str]  # colour, mark

_OURS: Sequence[Style] = (("#08519c", "o"), ("#6baed6", "<"), ("#4292c6", ">"))
_OTHERS: dict[str, Style] = {  # by the end of their names
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
    curves: list[Curve]
    across: str = "error"
    against: Literal["error", "digits", "size"] = "error"
    least: float = 0.0
    certified: bool = False
    panels: bool = False


def svg(diagram: Diagram) -> str:
    """Return an SVG: medians as marks, least to largest time as bars.

    ImportError without matplotlib.
    """
    import matplotlib as mpl

    mpl.use("svg")
    from matplotlib import pyplot as plt

    curves = [one for one in diagram.curves if one.proved or not diagram.certified]
    forms = list(dict.fromkeys(map(_form, curves))) if diagram.panels else [""]
    columns = min(len(forms), _COLUMNS)
    rows = ceil(len(forms) / columns)
    size = (7.5, 5.0) if columns == 1 else (9.5, 2.7 * rows + 1.0)
    with mpl.rc_context({"svg.hashsalt": diagram.name, "font.size": 9, "legend.fontsize": 8}):
        figure, grid = plt.subplots(
            rows, columns, figsize=size, layout="constrained", sharex=True, sharey=True,
            squeeze=False,
        )  # fmt: skip
        for axes, form in zip(grid.flat, forms, strict=False):
            _draw(axes, diagram, [one for one in curves if form in ("", _form(one))])
            axes.set_title(form, fontsize=9)
        for k in range(len(forms), rows * columns):
            grid.flat[k].set_visible(False)
            grid.flat[k - columns].tick_params(labelbottom=True)
        _scale(grid[0, 0], diagram)
        figure.suptitle(diagram.title)
        grid[-1, columns // 2].set_xlabel(diagram.across)
        for axes in grid[:, 0]:
            axes.set_ylabel("time [s]")
        _legend(figure, list(grid.flat))
        file = io.StringIO()
        figure.savefig(file, format="svg", metadata={"Date": None})
        plt.close(figure)
    return "\n".join(line.rstrip() for line in file.getvalue().splitlines()) + "\n"


def _scale(axes: Axes, diagram: Diagram) -> None:
    """Show a decade at least, smaller errors to the right, and digits and sizes as plain numbers.

    The panels share their axes: one stands for all.
    """
    from matplotlib.ticker import LogFormatter

    for axis in (axes.xaxis, axes.yaxis):
        low, high = axis.get_view_interval()
        if high < 10 * low:
            middle = sqrt(low * high)
            axis.set_view_interval(middle / sqrt(10), middle * sqrt(10), ignore=True)
    if diagram.against == "error":
        axes.invert_xaxis()
        return
    axes.xaxis.set_major_formatter(LogFormatter(labelOnlyBase=False))
    axes.xaxis.set_minor_formatter(LogFormatter(labelOnlyBase=False, minor_thresholds=(2, 0.5)))


def _legend(figure: Figure, panels: Sequence[Axes]) -> None:
    """Explain each name once, below the panels."""
    known: dict[str, Artist] = {}
    for axes in panels:
        handles, labels = axes.get_legend_handles_labels()
        known.update(zip(labels, handles, strict=True))
    columns = 4 if max(map(len, known), default=0) <= _SHORT else 2
    if len(known) > 1:
        figure.legend(known.values(), list(known), loc="outside lower center", ncols=columns)


def _draw(axes: Axes, diagram: Diagram, curves: Sequence[Curve]) -> None:
    """Draw curves into a panel."""
    axes.set(xscale="log", yscale="log")
    axes.margins(0.1)
    axes.grid(alpha=0.3)
    own = 0
    for curve in curves:
        style = _style(curve.way)
        if style is None:
            style, own = _OURS[own % len(_OURS)], own + 1
        points = [(_across(p, diagram), p) for p in curve.points if p.seconds]
        points = [(x, p) for x, p in points if isfinite(x) and x > 0]
        if not points:
            continue
        axes.plot(
            [x for x, _ in points],
            [p.time for _, p in points],
            label=_library(curve) if diagram.panels else curve.way,
            color=style[0],
            marker=style[1],
            ls="-" if curve.against else "none",
            ms=4.5,
            lw=1,
        )
        for x, p in points:
            axes.plot([x, x], [min(p.seconds), max(p.seconds)], color=style[0], lw=0.6)
            axes.annotate(
                p.note, (x, p.time), (4, 4), textcoords="offset points", size=7, in_layout=False
            )


def _across(point: Point, diagram: Diagram) -> float:
    """Return the place on the horizontal axis; 0 is none."""
    if diagram.against == "size":
        return point.size
    error = abs(point.error or 0.0)
    if error <= diagram.least:
        return 0.0
    return error if diagram.against == "error" else -log10(error)


def _style(way: str) -> Style | None:
    """Return colour and mark of others; None if the way is ours."""
    return next((style for end, style in _OTHERS.items() if way.endswith(end)), None)


def _form(curve: Curve) -> str:
    return curve.way.rpartition(", ")[0] or curve.way


def _library(curve: Curve) -> str:
    return curve.way.rpartition(", ")[2]
