"""Figure 4, rectangles and their images, and transients, with restitution."""

from __future__ import annotations

from collections.abc import Sequence

from intervals import Undecided
from proofs.motion.simulate import TURNS
from proofs.motion.system import System
from proofs.motion.transients import INITIAL_STATES, transients
from proofs.report.figures import style
from proofs.report.figures.figure import Figure, all_of
from proofs.report.figures.style import Axes, Drawing
from proofs.search.s33_rectangles import state_after
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.horseshoe import Horseshoe
from proofs.trusted.kernel.rectangles import Rectangle
from proofs.trusted.numbers import Range, show, show_range
from proofs.trusted.paper.s33_restitution.horseshoes import shoes
from proofs.trusted.paper.s33_restitution.rectangles import Strips
from proofs.trusted.paper.s33_restitution.words import golden_means
from proofs.trusted.paper.s34_circle.persistence import SuperstableMotion
from proofs.trusted.parameters import Place

_EDGE = 40  # samples of a side


def plot_rectangles(proved: Context) -> Drawing:
    """Draw the printed rectangles and the corrected ones, each with their images."""
    horseshoes = all_of(proved, Horseshoe)
    printed = next(iter(golden_means(horseshoes)), None)
    if printed is None:
        raise Undecided("it is not proved which orbits stay in the printed rectangles")
    corrections = shoes(horseshoes)
    corrected = next((x for x in corrections if x.at == printed.at), None)
    if corrected is None:
        raise Undecided("no horseshoe is proved at the printed epsilon")
    drawing, both = style.sheet(3.6, 1, 2, sharey=True)
    for axes, horseshoe, name in ((both[0], printed, "printed"), (both[1], corrected, "corrected")):
        if not isinstance(horseshoe.strips, Strips):
            raise Undecided("the rectangles are not two with the same velocities")
        _strips(axes, proved, horseshoe.at, horseshoe.strips)
        left, right = show_range(horseshoe.strips.left), show_range(horseshoe.strips.right)
        axes.set_title(f"{name}: phases {left} and {right}")
        axes.set_ylim(-0.48, 0.06)
        axes.set_xlabel(r"phase $\phi$ [rad]")
    both[0].set_ylabel(r"velocity $\gamma$ before the impact")
    style.legend_below(drawing, both[0], 2)
    return drawing


def _strips(axes: Axes, proved: Context, at: Place, strips: Strips) -> None:
    """Draw V1 and V2, boxes around their images, and images of their sides in floating point."""
    points = []
    for index, (box, light, dark) in enumerate(
        zip(strips.boxes, ("#A6CDE8", "#F2BE97"), (style.BLUE, style.RED), strict=True), start=1
    ):
        phases, velocities = box
        for each in all_of(proved, Rectangle):
            if (each.place, each.box) != (at, box):
                continue
            images = [(part.values[0], part.values[1]) for part in each.parts]
            edges = [(phase, velocity) for phase, velocity in each.edges]
            style.proved_boxes(axes, images, light, f"image of V{index} lies in here, proved", lw=0)
            label = "those of its left and right sides in here, proved"
            style.proved_boxes(axes, edges, dark, label, lw=0)
        style.outline(axes, phases, velocities, "V1 and V2" if index == 1 else "_", lw=0.8)
        place = float(sum(phases)) / 2, float(velocities[1]) + 0.01
        axes.text(*place, f"V{index}", ha="center", va="bottom")
        points += _boundary(at, phases, velocities)
    style.dots(axes, points, "images of the sides, sampled", 0.9)


def _boundary(at: Place, phases: Range, velocities: Range) -> list[tuple[float, float]]:
    """Return the images of points on the sides of a rectangle, in floating point."""
    (left, right), (low, high) = (tuple(map(float, ends)) for ends in (phases, velocities))
    edges: Sequence[tuple[float, float, float, float]] = (
        (left, low, right, low),
        (left, high, right, high),
        (left, low, left, high),
        (right, low, right, high),
    )
    states = [
        (a + (c - a) * k / _EDGE, b + (d - b) * k / _EDGE)
        for a, b, c, d in edges
        for k in range(_EDGE + 1)
    ]
    eta, nu, epsilon = (float(low) for low, _ in at.sides)
    after = (state_after(eta, nu, epsilon, state) for state in states)
    return [image for image in after if image is not None]


RECTANGLES = Figure(
    "figure-4",
    "Figure 4: the rectangles V1 and V2 and their images under F, printed and corrected",
    ("N1", "N2"),
    "horseshoe",
    "Filled: boxes that are proved to hold the images. Dots: images of points on the sides, in "
    "floating point.",
    plot_rectangles,
)


def plot_transients(proved: Context) -> Drawing:
    """Draw simulated turns until rest against epsilon, the range that is proved shaded."""
    rows = transients(System(proved.of.eta, proved.of.nu))
    epsilons = [float(row.epsilon) for row in rows]
    drawing, axes = style.sheet(3.0)
    motions = (x for x in all_of(proved, SuperstableMotion) if x.epsilons[0] == 0)
    for motion in motions:
        label = rf"the stable motion exists, $\varepsilon \leq$ {show(motion.largest)}, proved"
        largest = float(motion.largest)
        axes.axvspan(0, largest, color="#C6E5F7", lw=0, label=label, gid=style.PROVED)
    medians, means = [row.median_turns for row in rows], [row.mean_turns for row in rows]
    axes.plot(epsilons, medians, "o", color=style.BLACK, markersize=3.5, label="median, simulated")
    axes.plot(epsilons, means, "s", color=style.RED, markersize=3.5, label="mean, simulated")
    axes.set(
        xlabel=r"$\varepsilon$",
        ylabel="turns of the table until rest",
        ylim=(0, None),
        xlim=(-0.01, 0.42),
    )
    style.legend_below(drawing, axes, 3)
    return drawing


TRANSIENTS = Figure(
    "restitution",
    "Section 3.4: transients against the coefficient of restitution",
    ("G7", "G8"),
    "persistence",
    f"Points: {INITIAL_STATES} random impacts in floating point; a motion that does not come to "
    f"rest in {TURNS} turns of the table is counted as {TURNS}.",
    plot_transients,
)
