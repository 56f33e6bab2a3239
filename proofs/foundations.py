"""Section 2 and the appendix: the model's equations derived, sticking, marching, and measures.

Claims M1 to M5, M7 to M9, A1 and A2. They are about all values of the parameters, or about exact
witnesses; A1 also names phases of the parameters given that never impact again.
"""

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.foundations")

from functools import partial

from proofs.shell.runner import run

main = partial(run, "foundations", description=__doc__)
