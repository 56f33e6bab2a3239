"""Transients against the coefficient of restitution: a simulation, beside what is proved.

matplotlib is imported here only.
"""

from __future__ import annotations

import io

from proofs.motion.simulate import transients
from proofs.motion.system import System
from proofs.trusted.paper.s34_circle.persistence import SuperstableMotion
from proofs.trusted.verify import premises


def svg(source: str) -> str:
    """Return an SVG of a certificate: simulated turns until rest against epsilon, at its eta and
    nu, the range of epsilon that it proves shaded.
    """
    import matplotlib as mpl

    mpl.use("svg")
    from matplotlib import pyplot as plt

    proof = premises(source)
    rows = transients(System(proof.of.eta, proof.of.nu))
    epsilons = [float(row.epsilon) for row in rows]
    with mpl.rc_context({"svg.hashsalt": "transients", "font.size": 9}):
        figure, axes = plt.subplots(figsize=(5.6, 3.6), layout="constrained")
        for motion in (x for x in proof.known.values() if isinstance(x, SuperstableMotion)):
            proved = float(motion.largest)
            label = f"the stable motion is proved, epsilon <= {proved:g}"
            axes.axvspan(0, proved, color="C2", alpha=0.15, lw=0, label=label)
        axes.plot(epsilons, [row.median_turns for row in rows], "o-", label="median, simulated")
        axes.plot(epsilons, [row.mean_turns for row in rows], "s--", label="mean, simulated")
        axes.set_xlabel("epsilon")
        axes.set_ylabel("turns of the table until rest")
        title = "Transients (SIMULATED: 500 random impacts, at most 200 turns)"
        axes.set_title(f"{title}\n{proof.of.place}", fontsize=9)
        axes.legend(fontsize=8)
        target = io.StringIO()
        figure.savefig(target, format="svg", metadata={"Date": None})
        plt.close(figure)
    return "\n".join(line.rstrip() for line in target.getvalue().splitlines()) + "\n"
