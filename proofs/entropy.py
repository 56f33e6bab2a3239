"""Section 3.4: the chaos of the plastic map as a whole.

G17: its topological entropy from both sides. H18: phases at which it jumps, after which the mass
grazes the table, and the coefficients of its square roots there.
"""

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.entropy")

from functools import partial

from proofs.shell.runner import run

main = partial(run, "entropy", description=__doc__)
