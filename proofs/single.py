"""Section 4: single-impact orbits. (16)-(18) derived; which solutions are orbits, and stable.

Identities are found with sympy; solutions, first impacts and the ends of the windows of stable
orbits in figures 7a and 7b are enclosed with the package `intervals`.
"""

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.single")

from functools import partial

from proofs.shell.runner import run

main = partial(run, "single", description=__doc__)
