"""Figure 3: the construction of the invariant set, for the printed and for the corrected sets."""

from __future__ import annotations

from itertools import product

from proofs.motion.system import System
from proofs.report.figures import style
from proofs.report.figures.figure import Figure, all_of, the
from proofs.report.figures.impact_map import image, preimage
from proofs.report.figures.style import Axes, Drawing
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.staying import StayingSet
from proofs.trusted.numbers import Range, between, show_range
from proofs.trusted.paper.s32_sets.repeller import Repeller

_LEVELS = 5
Interval = tuple[float, float]


def cylinders(system: System, left: Range, right: Range, levels: int) -> dict[str, Interval]:
    """Return by word w_1 ... w_n the phases of [left, right] with f^(k-1) in I_(w_k), as far as
    there are any, in floating point."""
    sets = {str(k): (float(low), float(high)) for k, (low, high) in enumerate((left, right))}
    ranges = {name: tuple(image(system, x) or 0.0 for x in ends) for name, ends in sets.items()}
    phases: dict[str, Interval] = dict(sets)
    for length in range(2, levels + 1):
        for letters in product("01", repeat=length):
            first, rest = letters[0], "".join(letters[1:])
            if rest not in phases:
                continue
            low = max(phases[rest][0], ranges[first][0])
            high = min(phases[rest][1], ranges[first][1])
            if low < high:
                ends = (preimage(system, y, *sets[first]) for y in (low, high))
                phases[first + rest] = tuple(ends)  # type: ignore[assignment]
    return phases


def plot(proved: Context) -> Drawing:
    """Draw both constructions, level by level."""
    statement, corrected = proved.of, the(proved, StayingSet)
    drawing, both = style.sheet(4.2, 2, 1, sharex=True)
    for axes, (left, right), name in (
        (both[0], (statement.left, statement.right), "printed"),
        (both[1], corrected.cells, "corrected"),
    ):
        interval = left[0], right[1]
        _levels(
            axes,
            interval,
            (left, right),
            cylinders(System(statement.eta, statement.nu), left, right, _LEVELS),
        )
        repeller = next(x for x in all_of(proved, Repeller) if x.hull == interval)
        dimension = between(repeller.dimension, 8)
        axes.set_title(f"{name}: I = {show_range(interval)}, dimension in {dimension}, proved")
    both[1].set_xlabel(r"$\phi$ [rad]")
    style.legend_below(drawing, both[1], 3)
    return drawing


def _levels(
    axes: Axes, hull: Range, sets: tuple[Range, Range], cylinders: dict[str, Interval]
) -> None:
    """Draw a row of intervals for each length of words, and name the first words."""
    style.proved_boxes(axes, [(hull, (-0.3, 0.3))], style.GREY, "I, exact")
    style.proved_boxes(
        axes, [(ends, (-1.3, -0.7)) for ends in sets], style.BLUE, "I0 and I1, exact"
    )
    for length in range(2, _LEVELS + 1):
        spans = {word: ends for word, ends in cylinders.items() if len(word) == length}
        bars = [(low, high - low) for low, high in spans.values()]
        label = "deeper, located in floating point" if length == 2 else "_"
        axes.broken_barh(bars, (-length - 0.3, 0.6), color=style.ORANGE, lw=0.4, label=label)
        for word, (low, high) in spans.items() if length == 2 else ():
            axes.text((low + high) / 2, 0.33 - length, word, ha="center", va="bottom", fontsize=6)
        if length == 3 and "000" not in spans:
            axes.text(1.1035, -length, "no 000", ha="center", va="center", fontsize=7)
        axes.text(1.21, -length, f"{len(spans)} words", ha="center", va="center", fontsize=7)
    axes.set_yticks([-n for n in range(_LEVELS + 1)], [str(n) for n in range(_LEVELS + 1)])
    axes.set(ylabel="letters", ylim=(-_LEVELS - 0.6, 0.6))


FIGURE = Figure(
    "figure-3",
    "Figure 3: the construction of the invariant set",
    ("H13", "H9"),
    "dimension",
    "The phases whose first n images stay in I, by the word of 0 and 1 that says in which of I0 "
    "and I1. Grey and blue: exact. Orange: located in floating point.",
    plot,
)
