"""Claim 1 read for the map itself: the Hausdorff dimension of the set that stays in I (H13)."""

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.dimension")

from functools import partial

from proofs.shell.runner import run

main = partial(run, "dimension", description=__doc__)
