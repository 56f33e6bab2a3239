"""Figure 4: rectangles and their images under F, printed and corrected."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from intervals import Undecided
from proofs.motion.simulate import next_impact
from proofs.motion.system import System
from proofs.report.figures.figure import Figure, all_of, the
from proofs.report.figures.style import BLACK, BLUE, RED, dots, proved_boxes, sheet
from proofs.trusted.equations import arrival, clock, closing, launch, launch_with_restitution
from proofs.trusted.kernel.context import Context
from proofs.trusted.numbers import Range, show_range
from proofs.trusted.paper.s33_restitution.horseshoes import RectangleHorseshoe, Strips
from proofs.trusted.paper.s33_restitution.rebounds import Rebound, RectangleMap
from proofs.trusted.paper.s33_restitution.words import GoldenMean
from proofs.trusted.parameters import Place

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Drawing

_EDGE = 40  # samples of a side


def plot(proved: Context) -> Drawing:
    """Draw the printed rectangles and the corrected ones, each with their images."""
    printed = the(proved, GoldenMean)
    corrected = next((x for x in all_of(proved, RectangleHorseshoe) if x.at == printed.at), None)
    if corrected is None:
        raise Undecided("no horseshoe is proved at the printed epsilon")
    drawing, both = sheet(3.6, 1, 2, sharey=True)
    for axes, found, name in ((both[0], printed, "printed"), (both[1], corrected, "corrected")):
        _strips(axes, proved, found.at, found.strips)
        left, right = show_range(found.strips.left), show_range(found.strips.right)
        axes.set_title(f"{name}: phases {left} and {right}")
        axes.set_ylim(-0.48, 0.06)
        axes.set_xlabel(r"phase $\phi$ [rad]")
    both[0].set_ylabel(r"velocity $\gamma$ before the impact")
    handles, labels = both[0].get_legend_handles_labels()
    drawing.legend(handles, labels, loc="outside lower center", ncols=2)
    return drawing


def images(proved: Context, at: Place, phases: Range, velocities: Range) -> list[Rebound]:
    """Return the parts of a rectangle whose images are enclosed, those of the edges included."""
    return [
        part
        for part in all_of(proved, Rebound)
        if not isinstance(part, RectangleMap)
        and (part.at, part.velocities) == (at, velocities)
        and phases[0] <= part.phases[0]
        and part.phases[1] <= phases[1]
    ]


def _strips(axes: Axes, proved: Context, at: Place, strips: Strips) -> None:
    """Draw V1 and V2, boxes around their images, and images of their sides in floating point."""
    system, epsilon = System(at.eta[0], at.nu[0]), float((at.epsilon or (0, 0))[0])
    points = []
    for index, (phases, light, dark) in enumerate(
        ((strips.left, "#A6CDE8", BLUE), (strips.right, "#F2BE97", RED)), start=1
    ):
        parts = images(proved, at, phases, strips.velocities)
        whole: list[tuple[Range, Range]] = []
        sides: list[tuple[Range, Range]] = []
        for part in parts:
            boxes = sides if part.phases[0] in phases and part.phases[1] in phases else whole
            boxes.append((part.phase, part.velocity))
        proved_boxes(axes, whole, light, f"image of V{index} lies in here, proved", lw=0)
        label = "those of its left and right sides in here, proved"
        proved_boxes(axes, sides, dark, label, lw=0)
        _outline(axes, phases, strips.velocities, f"V{index}")
        points += _boundary(system, epsilon, phases, strips.velocities)
    dots(axes, points, "images of the sides, sampled", 0.9)


def _outline(axes: Axes, phases: Range, velocities: Range, name: str) -> None:
    (left, right), (low, high) = (tuple(map(float, ends)) for ends in (phases, velocities))
    label = "V1 and V2" if name == "V1" else "_"
    corners = [left, right, right, left, left], [low, low, high, high, low]
    axes.plot(*corners, color=BLACK, lw=0.8, label=label)
    axes.text((left + right) / 2, high + 0.01, name, ha="center", va="bottom")


def _boundary(
    system: System, epsilon: float, phases: Range, velocities: Range
) -> list[tuple[float, float]]:
    """Return the images of points on the sides of a rectangle, in floating point."""
    (left, right), (low, high) = (tuple(map(float, ends)) for ends in (phases, velocities))
    sides: Sequence[tuple[float, float, float, float]] = (
        (left, low, right, low),
        (left, high, right, high),
        (left, low, left, high),
        (right, low, right, high),
    )
    return [
        _image(system, epsilon, a + (c - a) * k / _EDGE, b + (d - b) * k / _EDGE)
        for a, b, c, d in sides
        for k in range(_EDGE + 1)
    ]


def _image(system: System, epsilon: float, phase: float, gamma: float) -> tuple[float, float]:
    eta, nu = float(system.eta), float(system.nu)
    plastic = launch(system.side, eta, nu, phase)
    kick = epsilon * system.side * closing(plastic, gamma)
    found = next_impact(system, phase, kick, 1000.0)
    if found is None:
        raise Undecided("a sampled state has no next impact")
    start = launch_with_restitution(system.side, eta, nu, phase, epsilon=epsilon, gamma=gamma)
    return (phase + found[0]) % math.tau, arrival(start, clock(eta, found[0]))[1]


FIGURE = Figure(
    "figure-4",
    "Figure 4: the rectangles V1 and V2 and their images under F, printed and corrected",
    ("N1", "N2"),
    "horseshoe",
    "Filled: boxes that are proved to hold the images. Dots: images of points on the sides, in "
    "floating point.",
    plot,
)
