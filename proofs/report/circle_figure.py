"""Figure 6 of the paper as a theorem: how many impacts phases need at most to stick."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from proofs.report.markup import drawn
from proofs.trusted.numbers import Range
from proofs.trusted.paper.s34_circle.absorption import Absorption
from proofs.trusted.paper.s34_circle.landing import NeverImpacts, Separation
from proofs.trusted.verify import premises

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Bars = list[tuple[float, float, int]]


def proved(source: str) -> tuple[Bars, list[tuple[float, float]]]:
    """Return from a certificate's text the intervals that stick within n impacts, and those that
    never impact again; phases in [0, 2 pi)."""
    bars: Bars = []
    never: list[tuple[float, float]] = []
    for step in premises(source).known.values():
        if isinstance(step, Absorption):
            for phases, count in step.within:
                bars += [(low, high, count) for low, high in _on_circle(phases)]
        if isinstance(step, NeverImpacts):
            never += _on_circle(step.phases)
        if isinstance(step, Separation):
            arc = _on_circle((step.start[1], step.phase[0]))
            bars += [(low, high, 0) for low, high in arc]
    return sorted(bars), never


def _on_circle(phases: Range) -> list[tuple[float, float]]:
    """Return the parts of an interval in [0, 2 pi)."""
    low, high = map(float, phases)
    if low >= 0:
        return [(low, high)]
    return (
        [(low + math.tau, math.tau), (0.0, high)]
        if high > 0
        else [(low + math.tau, high + math.tau)]
    )


def svg(source: str) -> str:
    """Return an SVG of what a certificate proves: the whole circle, and around [1.1, 1.76]."""
    bars, never = proved(source)

    def draw(both: Sequence[Axes]) -> None:
        for axes, ends in zip(both, ((0.0, math.tau), (1.09, 1.77)), strict=True):
            _draw(axes, bars, never)
            axes.set(xlim=ends, xlabel=r"$\phi$", ylabel="impacts, at most")
        both[0].set_title("Impacts before the mass sticks, proved for every phase of each bar")
        both[1].legend(fontsize=7, loc="upper left")

    return drawn("figure-6", (6.4, 5.2), draw, rows=2)


def _draw(axes: Axes, bars: Bars, never: list[tuple[float, float]]) -> None:
    """Draw a bar for each interval, and where there is no next impact."""
    lows, widths = [low for low, _, _ in bars], [high - low for low, high, _ in bars]
    heights = [count for _, _, count in bars]
    axes.bar(lows, heights, widths, align="edge", color="C0", lw=0, label="proved for each phase")
    for low, high in never:
        axes.axvspan(low, high, color="C3", lw=1, label="no impact ever")
    axes.set_ylim(0, max(heights, default=0) + 2)
