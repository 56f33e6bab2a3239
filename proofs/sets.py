"""Sections 3.1 and 3.2: is the invariant set what Theorems 2 to 4 and the proof of Claim 1 say?

Claims H7-H10, on the invariant set of the map, rest on a horseshoe around the given interval I and
on the orbits of the ends of I; H12, H14, H15 and H17, on the linear set, on powers of rationals.
"""

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.sets")

from functools import partial

from proofs.shell.runner import run

main = partial(run, "sets", description=__doc__)
