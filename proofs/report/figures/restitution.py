"""Transients against the coefficient of restitution: a simulation, beside what is proved."""

from __future__ import annotations

from typing import TYPE_CHECKING

from proofs.motion.simulate import transients
from proofs.motion.system import System
from proofs.report.figures.figure import Documents, Figure
from proofs.trusted.paper.s34_circle.persistence import SuperstableMotion
from proofs.trusted.verdicts import told

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Drawing


def plot(documents: Documents) -> Drawing:
    """Draw simulated turns until rest against epsilon, the range that is proved shaded."""
    from matplotlib import pyplot as plt

    of = documents["persistence"].of
    rows = transients(System(of.eta, of.nu))
    epsilons = [float(row.epsilon) for row in rows]
    drawing, axes = plt.subplots(figsize=(5.6, 3.6))
    for motion in _motions(documents):
        proved = float(motion.largest)
        label = f"the stable motion is proved, epsilon <= {proved:g}"
        axes.axvspan(0, proved, color="C2", alpha=0.15, lw=0, label=label)
    axes.plot(epsilons, [row.median_turns for row in rows], "o-", label="median, simulated")
    axes.plot(epsilons, [row.mean_turns for row in rows], "s--", label="mean, simulated")
    axes.set_xlabel(r"$\varepsilon$")
    axes.set_ylabel("turns of the table until rest")
    axes.legend()
    return drawing


def caption(documents: Documents) -> str:
    """Return what is proved of the stable motion."""
    return told(_motions(documents))


def _motions(documents: Documents) -> list[SuperstableMotion]:
    known = documents["persistence"].known.values()
    return [each for each in known if isinstance(each, SuperstableMotion)]


FIGURE = Figure(
    "restitution",
    "Transients against the coefficient of restitution",
    ("G7", "G8"),
    ("persistence",),
    caption,
    plot,
)
