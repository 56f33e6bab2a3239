"""Section 3.4 with restitution: the stable orbit persists, with infinitely many impacts a period.

Claims G7, G8, and G12, G15 and G16 (our own). The flight from phi_s does not depend on epsilon;
after it, for ever larger epsilon, bounces are enclosed until they are proved to end before that
phase.
"""

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.persistence")

from functools import partial

from proofs.shell.runner import run

main = partial(run, "persistence", description=__doc__)
