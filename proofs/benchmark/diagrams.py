"""Work-precision diagrams: error on one axis, time on the other, both logarithmic."""

from __future__ import annotations

import io
from dataclasses import dataclass
from math import isfinite
from typing import TYPE_CHECKING

from proofs.benchmark.curves import Curve

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True)
class Diagram:
    """Curves that belong together, the name of their file and their title.

    Errors below `least` are not drawn; if `certified`, neither are curves that prove nothing.
    """

    name: str
    title: str
    curves: list[Curve]
    least: float = 1e-320
    certified: bool = False


def svg(diagram: Diagram) -> str:
    """Return an SVG: medians as marks, least to largest time as bars.

    Curves without errors (checks) are drawn as size against time. Ways to do the same by other
    libraries have the colour of the form and a line style of their own. ImportError without
    matplotlib.
    """
    import matplotlib as mpl

    mpl.use("svg")
    from matplotlib import pyplot as plt

    with mpl.rc_context({"svg.hashsalt": diagram.name, "font.size": 9}):
        figure, axes = plt.subplots(figsize=(6.8, 4.6), layout="constrained")
        curves = [one for one in diagram.curves if one.proved or not diagram.certified]
        _draw(axes, curves, diagram.least)
        sized = not any(curve.measured for curve in curves)
        axes.set(xlabel="kB" if sized else "error", ylabel="time [s]", title=diagram.title)
        if not sized:
            axes.invert_xaxis()
        axes.grid(alpha=0.3)
        file = io.StringIO()
        figure.savefig(file, format="svg", metadata={"Date": None})
        plt.close(figure)
    return file.getvalue()


def _draw(axes: Axes, curves: list[Curve], least: float) -> None:
    forms = list(dict.fromkeys(_form(curve) for curve in curves))
    libraries = list(dict.fromkeys(_library(curve) for curve in curves))
    styles, marks = ("-", "--", ":", "-."), "osD^v*"
    axes.set(xscale="log", yscale="log")
    for curve in curves:
        which, library = forms.index(_form(curve)), libraries.index(_library(curve))
        points = [(abs(p.error or 0.0) or p.size, p) for p in curve.points if p.seconds]
        points = [(x, p) for x, p in points if isfinite(x) and x > least]
        if not points:
            continue
        times = [p.time for _, p in points]
        spread = [
            [time - min(p.seconds) for time, (_, p) in zip(times, points, strict=True)],
            [max(p.seconds) - time for time, (_, p) in zip(times, points, strict=True)],
        ]
        axes.errorbar(
            [x for x, _ in points],
            times,
            yerr=spread,
            label=curve.way,
            color=f"C{which}",
            ls=styles[library % len(styles)],
            marker=marks[library % len(marks)],
            ms=3.5,
            lw=1,
            elinewidth=0.4,
        )
    if axes.has_data():
        axes.legend(fontsize=6.5, loc="center left", bbox_to_anchor=(1.01, 0.5))


def _form(curve: Curve) -> str:
    return curve.way.rpartition(", ")[0] or curve.way


def _library(curve: Curve) -> str:
    return curve.way.rpartition(", ")[2]
