"""Figure 2 of the paper as a theorem: the graph of f over I0 and I1 lies in the boxes drawn."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from proofs.motion.system import System
from proofs.report.figures.figure import Documents, Figure
from proofs.trusted.numbers import Range, show_range
from proofs.trusted.paper.s31_horseshoe import Horseshoe
from proofs.trusted.verdicts import told

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Drawing

_BOXES = 150


def plot(documents: Documents) -> Drawing:
    """Draw proved boxes around the graph of f on I0 and I1, printed and corrected."""
    from matplotlib import pyplot as plt

    proved = documents["horseshoe"]
    of, corrected = proved.of, _corrected(documents)
    drawing, axes = plt.subplots(figsize=(5.6, 5.2))
    left, right = (corrected or of).left, (corrected or of).right
    for domain, colour, name in ((left, "C0", "I0"), (right, "C3", "I1")):
        label = f"f on {name} = {show_range(domain)}"
        _graph(axes, System(of.eta, of.nu), domain, colour, label)
    _square(axes, of.interval, ":", f"I printed, {show_range(of.interval)}")
    if corrected is not None:
        _square(axes, corrected.interval, "-", f"I corrected, {show_range(corrected.interval)}")
    low, high = float(left[0]), float(right[1])
    axes.plot([low, high], [low, high], color="0.7", lw=0.8, label="the diagonal")
    axes.set(xlabel=r"$\phi$ [rad]", ylabel=r"$f(\phi)$ [rad]")
    axes.legend(fontsize=7, loc="center", bbox_to_anchor=(0.5, 0.75))
    return drawing


def caption(documents: Documents) -> str:
    """Return the corrected theorem, if it is proved."""
    corrected = _corrected(documents)
    return "" if corrected is None else told([corrected])


def _corrected(documents: Documents) -> Horseshoe | None:
    known = documents["horseshoe"].known.values()
    return next((x for x in known if isinstance(x, Horseshoe)), None)


def _graph(axes: Axes, system: System, domain: Range, colour: str, label: str) -> None:
    """Draw the boxes of one branch, images reduced by the multiple of 2 pi of the first one."""
    from matplotlib.collections import PatchCollection
    from matplotlib.patches import Rectangle

    from proofs.motion.slope_cover import slope_cover

    cover = slope_cover(system, domain, _BOXES)
    arrivals = cover.boxes + cover.times
    shift = math.tau * (arrivals.inf[0] // math.tau)
    patches = [
        Rectangle((x, y - shift), width, height)
        for x, y, width, height in zip(
            cover.boxes.inf, arrivals.inf, cover.boxes.wid, arrivals.wid, strict=True
        )
    ]
    axes.add_collection(PatchCollection(patches, facecolor=colour, edgecolor=colour, lw=0.8))
    axes.plot([], [], color=colour, label=label)
    axes.autoscale_view()


def _square(axes: Axes, interval: Range, style: str, label: str) -> None:
    """Draw the boundary of I x I."""
    low, high = (float(x) for x in interval)
    corners = [low, high, high, low, low], [low, low, high, high, low]
    axes.plot(*corners, style, color="0.3", lw=0.8, label=label)


FIGURE = Figure(
    "figure-2",
    "Figure 2: the impact map on I0 and I1",
    ("H1", "H2", "H3", "H4", "H5", "H6"),
    ("horseshoe",),
    caption,
    plot,
)
