"""Transients against the coefficient of restitution: a simulation, beside what is proved."""

from __future__ import annotations

from typing import TYPE_CHECKING

from proofs.motion.simulate import INITIAL_STATES, TURNS, transients
from proofs.motion.system import System
from proofs.report.markup import drawn
from proofs.trusted.paper.s34_circle.persistence import SuperstableMotion
from proofs.trusted.verify import premises

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def svg(source: str) -> str:
    """Return an SVG of a certificate: simulated turns until rest against epsilon, at its eta and
    nu, the range of epsilon that it proves shaded.
    """
    proof = premises(source)
    rows = transients(System(proof.of.eta, proof.of.nu))
    epsilons = [float(row.epsilon) for row in rows]

    def draw(axes: Axes) -> None:
        for motion in (x for x in proof.known.values() if isinstance(x, SuperstableMotion)):
            proved = float(motion.largest)
            label = f"the stable motion is proved, epsilon <= {proved:g}"
            axes.axvspan(0, proved, color="C2", alpha=0.15, lw=0, label=label)
        axes.plot(epsilons, [row.median_turns for row in rows], "o-", label="median, simulated")
        axes.plot(epsilons, [row.mean_turns for row in rows], "s--", label="mean, simulated")
        axes.set_xlabel("epsilon")
        axes.set_ylabel("turns of the table until rest")
        title = f"SIMULATED: {INITIAL_STATES} random impacts; not at rest: counted as {TURNS} turns"
        axes.set_title(f"{title}\n{proof.of.place}", fontsize=9)
        axes.legend(fontsize=8)

    return drawn("transients", (5.6, 3.6), draw)
