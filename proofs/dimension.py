"""Hausdorff dimensions of the sets that stay in I and in the intervals of G5. Claims H13, G19."""

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.dimension")

from functools import partial

from proofs.shell.runner import run

main = partial(run, "dimension", description=__doc__)
