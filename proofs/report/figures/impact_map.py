"""Figure 2: the graph of f over I0 and I1, in the boxes that its slopes prove."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise

from proofs.motion.system import System
from proofs.report.figures import style
from proofs.report.figures.figure import Figure, all_of, the
from proofs.report.figures.sampled import graph
from proofs.report.figures.style import Axes, Drawing
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.differential import Avoids
from proofs.trusted.kernel.laps import SlopeRange
from proofs.trusted.kernel.staying import StayingSet
from proofs.trusted.numbers import between, show, show_range

Corners = list[tuple[Fraction, Fraction]]


def hulls(slopes: SlopeRange) -> list[Corners]:
    """Return for each piece the parallelogram that holds the graph, by its ends and its slopes.

    With f(a) in [p, q], f(b) in [r, s] and l <= f' <= u on [a, b], f(x) is at most q + u (x - a)
    and s - l (b - x), and at least p + l (x - a) and r - u (b - x).
    """
    shapes = []
    ends = zip(slopes.points, slopes.images, strict=True)
    for ((a, (p, q)), (b, (r, s))), (low, up) in zip(pairwise(ends), slopes.pieces, strict=True):
        top = (s - low * b - q + up * a) / (up - low)
        bottom = (p - low * a - r + up * b) / (up - low)
        upper = [(a, q), (top, q + up * (top - a)), (b, s)]
        lower = [(b, r), (bottom, p + low * (bottom - a)), (a, p)]
        shapes.append([*upper, *lower])
    return shapes


def plot(proved: Context) -> Drawing:
    """Draw the graph, the printed and the corrected I, and where f is proved not to go."""
    of, corrected = proved.of, the(proved, StayingSet)
    drawing, axes = style.sheet(5.0)
    low, high = (float(x) for x in corrected.interval)
    _gap(axes, the(proved, Avoids))
    for colour, slopes in zip((style.BLUE, style.RED), all_of(proved, SlopeRange), strict=False):
        label = f"graph of f on {show_range(slopes.domain)}, proved"
        style.proved_polygons(axes, hulls(slopes), colour, label)
    style.dots(axes, graph(System(of.eta, of.nu), low, high, 240), "f, sampled")
    axes.plot([low, high], [low, high], color=style.GREY, lw=0.6, label=r"$f(\phi) = \phi$")
    for name, interval, dashes in (
        ("printed", of.interval, (0, (2, 2))),
        ("corrected", corrected.interval, "-"),
    ):
        label = f"{name} $I \\times I$, I = {show_range(interval)}"
        style.outline(axes, interval, interval, label, lw=0.7, ls=dashes)
    for name, sets, height, colour in (
        ("printed", (of.left, of.right), 1.063, style.ORANGE),
        ("corrected", corrected.cells, 1.048, "0.75"),
    ):
        style.on_axis(axes, sets, height, colour, "$I_{}$", fontsize=7)
        axes.text(1.21, height, name, ha="center", va="center", fontsize=7)
    _shortfall(axes, proved)
    axes.set(xlabel=r"$\phi$ [rad]", ylabel=r"$f(\phi)$ [rad]", xlim=(1.085, 1.335))
    axes.set_ylim(1.04, 1.42)
    axes.legend(loc="upper center", bbox_to_anchor=(0.6, 1.0))
    return drawing


def _shortfall(axes: Axes, proved: Context) -> None:
    """Point at the image of the left end of the printed I0, above that end."""
    end = proved.of.left[0]
    for slopes in all_of(proved, SlopeRange):
        if end in slopes.points:
            low, high = slopes.images[slopes.points.index(end)]
            text = f"f({show(end)}) is in {between((low, high), 6)}, proved"
            arrow = {"arrowstyle": "->", "lw": 0.6, "shrinkB": 2}
            place = float(end), float(low)
            axes.annotate(text, place, (1.115, 1.08), fontsize=7, va="center", arrowprops=arrow)


def _gap(axes: Axes, avoids: Avoids) -> None:
    """Fill what f is proved to miss."""
    label = f"f has no value in here, for $\\phi$ in {show_range(avoids.source)}, proved"
    style.proved_boxes(axes, [(avoids.source, avoids.target)], "0.9", label)


FIGURE = Figure(
    "figure-2",
    "Figure 2: the impact map on I0 and I1, printed and corrected",
    ("H1", "H2", "H3", "H4", "H5", "H6"),
    "horseshoe",
    "Filled: what the values and slopes in the certificate prove of the graph of f, and where f is "
    "proved to have no value. Dots: f in floating point.",
    plot,
)
