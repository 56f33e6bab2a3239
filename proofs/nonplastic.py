"""Section 3.3: the impact map with restitution on the printed rectangles. Claims N1 to N5.

Candidates by floating point; every impact, rectangle and barred word is proved by interval
arithmetic and recorded for the checker.
"""

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.nonplastic")

from functools import partial

from proofs.shell.runner import run

main = partial(run, "nonplastic", description=__doc__)
