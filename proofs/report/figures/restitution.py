"""Transients against the coefficient of restitution: a simulation, beside what is proved."""

from __future__ import annotations

from proofs.motion.simulate import TURNS
from proofs.motion.system import System
from proofs.motion.transients import INITIAL_STATES, transients
from proofs.report.figures import style
from proofs.report.figures.figure import Figure, all_of
from proofs.report.figures.style import Drawing
from proofs.trusted.kernel.context import Context
from proofs.trusted.numbers import show
from proofs.trusted.paper.s34_circle.persistence import SuperstableMotion


def plot(proved: Context) -> Drawing:
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


FIGURE = Figure(
    "restitution",
    "Section 3.4: transients against the coefficient of restitution",
    ("G7", "G8"),
    "persistence",
    f"Points: {INITIAL_STATES} random impacts in floating point; a motion that does not come to "
    f"rest in {TURNS} turns of the table is counted as {TURNS}.",
    plot,
)
