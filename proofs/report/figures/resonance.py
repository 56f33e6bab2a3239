"""Figure 8: what there is at resonance in place of double-impact orbits."""

from __future__ import annotations

import math
from itertools import pairwise

from intervals import Undecided
from proofs.report.figures import style
from proofs.report.figures.figure import Figure
from proofs.report.figures.style import Axes, Drawing
from proofs.trusted.kernel.context import Context
from proofs.trusted.paper import find
from proofs.trusted.verdicts import Verdict

_EPSILONS = (0.7, 0.3)
_STARTS = ((1.5, -0.5), (3.0, -0.8), (4.6, -1.1), (6.1, -1.4))  # phase and c of first impacts
_STEPS = 12


def orbit(epsilon: float, phase: float, c: float) -> list[tuple[float, float]]:
    """Return impacts (phase, c) at resonance, by the closed form; phases on the line."""
    points = [(phase, c)]
    for _ in range(_STEPS):
        phase, c = phase + 2 * math.atan(epsilon * c), epsilon * c
        points.append((phase, c))
    return points


def plot(proved: Context) -> Drawing:
    """Draw the grazing orbits, and motions that tend to them."""
    row = find("R13")
    decision = None if row is None else row.decide(proved.of, list(proved.known.values()))
    if decision is None or decision.verdict is not Verdict.REFUTED:
        raise Undecided("that there are no double-impact orbits is not proved")
    drawing, both = style.sheet(2.9, 1, 2, sharey=True)
    for axes, epsilon in zip(both, _EPSILONS, strict=True):
        _motions(axes, epsilon)
        axes.axhline(0, color=style.BLUE, lw=3, gid=style.PROVED, zorder=0, label=_GRAZING)
        axes.set_title(rf"$\varepsilon$ = {epsilon}, $\eta$ = 1, $\nu$ < 0")
        axes.set(xlabel=r"phase $\phi$ [rad]", xlim=(0, math.tau))
    both[0].set_ylabel(r"$c = \gamma + \nu\,\cos\,\phi$ before the impact")
    style.legend_below(drawing, both[0], 1)
    return drawing


_GRAZING = "c = 0: the grazing orbits of period one; there are no other periodic orbits, proved"


def _motions(axes: Axes, epsilon: float) -> None:
    """Draw impacts of some motions, those of one motion joined."""
    label = "impacts of four motions, by the closed form of the map in floating point"
    for colour, (phase, c) in zip(
        (style.ORANGE, style.RED, style.GREY, "#222222"), _STARTS, strict=True
    ):
        points = [(x % math.tau, y) for x, y in orbit(epsilon, phase, c)]
        for first, second in pairwise(points):
            if abs(first[0] - second[0]) < math.pi:
                axes.plot(*zip(first, second, strict=True), color=colour, lw=0.5)
        axes.plot(*zip(*points, strict=True), ".", color=colour, markersize=5, label=label)
        label = "_"


FIGURE = Figure(
    "figure-8",
    "Figure 8: at resonance, in place of double-impact orbits",
    ("R9", "R13"),
    "resonance",
    "Blue: all periodic orbits there are for nu < 0, proved. Dots: motions, by the closed form of "
    "the map in floating point; each tends to a grazing orbit.",
    plot,
)
