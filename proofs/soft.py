"""Section 5: every equation of the soft springs derived, and its bifurcations decided."""

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.soft")

from functools import partial

from proofs.shell.runner import run

main = partial(run, "soft", description=__doc__)
