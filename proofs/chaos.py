"""Section 3.4: is there another invariant set, and how much chaos is there in all?

Claims G5, G11: which orbits stay in [1.32, 1.48], and the full shifts around it. G9: a lower
bound on the topological entropy, from all branches of f near the phase pi/2.
"""

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.chaos")

from functools import partial

from proofs.shell.runner import run

main = partial(run, "chaos", description=__doc__)
