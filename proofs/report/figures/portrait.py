"""A portrait of any system: proved sets of a horseshoe and orbits, over sampled points; a tube."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from proofs.methods.tubes import Tube
from proofs.report.figures.style import (
    BLUE,
    GREY,
    ORANGE,
    PROVED,
    RED,
    legend_below,
    proved_boxes,
    sheet,
    style,
    svg_of,
)
from proofs.trusted.kernel.arithmetic import Enclosure
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.covers import HSet
from proofs.trusted.kernel.cycle import PeriodicOrbit
from proofs.trusted.kernel.graph import Entropy

_BITS = 64  # of periods
_CORNERS = ((-1, -1), (1, -1), (1, 1), (-1, 1))


def portrait(points: Any, variables: Sequence[str], proved: Sequence[Conclusion]) -> str:
    """Return it as SVG: the first two variables; for one variable the points over their order."""
    with style("portrait"):
        drawing, axes = sheet(3.6)
        flat = len(variables) == 1
        x, y = points[:, 0], (range(len(points)) if flat else points[:, 1])
        look = {"color": GREY, "markersize": 1, "rasterized": True}  # thousands of points
        axes.plot(x, y, ".", label="sampled, not proved", **look)
        label = "proved: sets of a horseshoe"
        for entropy in (each for each in proved if isinstance(each, Entropy)):
            map_ = entropy.graph.covers[0].local.map
            for node in entropy.graph.nodes:
                _draw_set(axes, node, map_.periods(_BITS), flat, label)
                label = ""
        _draw_orbits(axes, [each for each in proved if isinstance(each, PeriodicOrbit)], flat)
        axes.set_xlabel(variables[0])
        axes.set_ylabel("" if flat else variables[1])
        legend_below(drawing, axes, 3)
        return svg_of(drawing, "portrait", f"{', '.join(variables)}: proved, over sampled", 150)


def _draw_set(
    axes: Any, node: HSet, periods: Mapping[int, Enclosure], flat: bool, label: str
) -> None:
    """Fill an h-set, its centre's angles being reduced; on the line its interval."""
    if flat:
        axes.axvspan(*map(float, node.span()), color=ORANGE, alpha=0.5, gid=PROVED, label=label)
        return
    centre = [
        float(c) % float(periods[k].range[0]) if k in periods else float(c)
        for k, c in enumerate(node.centre)
    ]
    corners = [
        [x + float(row[0] * p + row[1] * q) for x, row in zip(centre, node.matrix, strict=True)]
        for p, q in _CORNERS
    ]
    look = {"color": ORANGE, "ec": ORANGE, "lw": 2, "gid": PROVED, "label": label}
    axes.fill(*zip(*corners, strict=True), **look)


def _draw_orbits(axes: Any, orbits: Sequence[PeriodicOrbit], flat: bool) -> None:
    """Mark the first points of orbits, by their stability."""
    for stability, colour, mark in (("attracting", BLUE, "o"), ("a saddle", RED, "x")):
        places = [
            [float(sum(side)) / 2 for side in orbit.box]
            for orbit in orbits
            if orbit.stability == stability
        ]
        if places:
            x, y = zip(*((p[0], 0 if flat else p[1]) for p in places), strict=True)
            label = f"proved: {stability.removeprefix('a ')}"
            axes.plot(x, y, mark, color=colour, markersize=4, label=label, gid=PROVED)


def drawn_tube(tube: Tube) -> str:
    """Return it as SVG."""
    pieces = tube.pieces()
    with style("tube"):
        drawing, grid = sheet(1.6 * len(tube.names), rows=len(tube.names), squeeze=False)
        panels = grid[:, 0]
        for k, (name, axes) in enumerate(zip(tube.names, panels, strict=True)):
            proved_boxes(axes, [(piece.time, piece.box[k]) for piece in pieces], BLUE)
            axes.set_ylabel(name)
        panels[-1].set_xlabel("time")
        return svg_of(drawing, "tube", f"{', '.join(tube.names)} over the time, proved")
