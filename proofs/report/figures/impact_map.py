"""Figure 2 and section 3.4: the graph of f over horseshoes, in the shapes that its slopes prove.

Dots are the map in floating point, which proves nothing.
"""

from __future__ import annotations

import math
from fractions import Fraction
from itertools import pairwise

from intervals import Undecided
from proofs.motion.simulate import next_impact, separation_phase
from proofs.motion.system import System
from proofs.report.figures import style
from proofs.report.figures.figure import Figure, all_of, the
from proofs.report.figures.style import Axes, Drawing
from proofs.trusted.equations import launch, launch_acceleration
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.differential import Avoids
from proofs.trusted.kernel.laps import SlopeRange
from proofs.trusted.kernel.staying import StayingSet
from proofs.trusted.numbers import between, show, show_range, within

_HORIZON = 7000.0
_STEPS = 8


def image(system: System, phase: float) -> float | None:
    """Return f(phase), the separation phase where the mass sticks; None if there is no impact."""
    start = launch(system.side, float(system.eta), float(system.nu), phase)
    if launch_acceleration(start) < 0:
        return separation_phase(system) % math.tau
    impact = next_impact(system, phase, _HORIZON)
    return None if impact is None else impact.phase


def graph(system: System, first: float, last: float, count: int) -> list[tuple[float, float]]:
    """Return phases, evenly spaced, with their images, where there are some."""
    phases = [first + (last - first) * (k + 0.5) / count for k in range(count)]
    return [(phase, y) for phase in phases if (y := image(system, phase)) is not None]


def preimage(system: System, target: float, first: float, last: float) -> float:
    """Return the phase in [first, last], where f is steep, that f takes to the target: by Newton's
    method, from the middle.
    """
    phase = (first + last) / 2
    for _ in range(_STEPS):
        impact = next_impact(system, phase)
        if impact is None:
            break
        phase = min(max(phase - (impact.phase - target) / impact.slope, first), last)
    return phase


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


def plot_printed(proved: Context) -> Drawing:
    """Draw the graph, the printed and the corrected I, and where f is proved not to go."""
    statement, corrected = proved.of, the(proved, StayingSet)
    drawing, axes = style.sheet(5.0)
    low, high = (float(x) for x in corrected.interval)
    _gap(axes, the(proved, Avoids))
    for colour, slopes in zip((style.BLUE, style.RED), all_of(proved, SlopeRange), strict=False):
        label = f"graph of f on {show_range(slopes.domain)}, proved"
        style.proved_polygons(axes, hulls(slopes), colour, label)
    style.dots(axes, graph(System(statement.eta, statement.nu), low, high, 240), "f, sampled")
    axes.plot([low, high], [low, high], color=style.GREY, lw=0.6, label=r"$f(\phi) = \phi$")
    for name, interval, dashes in (
        ("printed", statement.interval, (0, (2, 2))),
        ("corrected", corrected.interval, "-"),
    ):
        label = f"{name} $I \\times I$, I = {show_range(interval)}"
        style.outline(axes, interval, interval, label, lw=0.7, ls=dashes)
    for name, sets, height, colour in (
        ("printed", (statement.left, statement.right), 1.063, style.ORANGE),
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


PRINTED = Figure(
    "figure-2",
    "Figure 2: the impact map on I0 and I1, printed and corrected",
    ("H1", "H2", "H3", "H4", "H5", "H6"),
    "horseshoe",
    "Filled: what the values and slopes in the certificate prove of the graph of f, and where f is "
    "proved to have no value. Dots: f in floating point.",
    plot_printed,
)


def plot_three_sets(proved: Context) -> Drawing:
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


THREE_SETS = Figure(
    "three-sets",
    "Section 3.4: horseshoes in [1.1, 1.49]",
    ("G5",),
    "chaos",
    "Filled: what the values and slopes in the certificate prove of the graph of f over the three "
    "sets 0, 1, 2 marked on the axis. Dots: f in floating point.",
    plot_three_sets,
)
