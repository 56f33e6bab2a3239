"""Transients against the coefficient of restitution: a simulation, beside what is proved.

matplotlib is imported here only.
"""

from __future__ import annotations

import io

from proofs.motion.simulate import transients
from proofs.motion.system import System
from proofs.trusted.certificate import parse
from proofs.trusted.parameters import PAPER


def svg(source: str) -> str:
    """Return an SVG: simulated turns until rest against epsilon, the proved range shaded."""
    import matplotlib as mpl

    mpl.use("svg")
    from matplotlib import pyplot as plt

    rows = transients(System(PAPER.eta, PAPER.nu))
    epsilons = [float(row.epsilon) for row in rows]
    with mpl.rc_context({"svg.hashsalt": "transients", "font.size": 9}):
        figure, axes = plt.subplots(figsize=(5.6, 3.6), layout="constrained")
        proved = proved_up_to(source)
        if proved is not None:
            label = f"the stable motion is proved, epsilon <= {proved:g}"
            axes.axvspan(0, proved, color="C2", alpha=0.15, lw=0, label=label)
        axes.plot(epsilons, [row.median_turns for row in rows], "o-", label="median, simulated")
        axes.plot(epsilons, [row.mean_turns for row in rows], "s--", label="mean, simulated")
        axes.set_xlabel("epsilon")
        axes.set_ylabel("turns of the table until rest")
        axes.set_title("Transients (SIMULATED: 500 random impacts, at most 200 turns)", fontsize=9)
        axes.legend(fontsize=8)
        target = io.StringIO()
        figure.savefig(target, format="svg", metadata={"Date": None})
        plt.close(figure)
    return "\n".join(line.rstrip() for line in target.getvalue().splitlines()) + "\n"


def proved_up_to(source: str) -> float | None:
    """Return the largest epsilon that a certificate says the motion persists for, if any."""
    for entry in dict(parse(source).entries())["claims"].items():
        bounds = dict(dict(entry.members())["quantities"].members())
        if "epsilon_max" in bounds:
            return float(bounds["epsilon_max"].decimals()[0])
    return None
