"""Sections 2 and 3.4: where the mass sticks, and how much of the circle ends up sticking.

Claims M6, G1-G4, G6, and G10, G13, G14 of our own: the sticking arc and the orbit through it, an
interval of phases that never impact again, and a partition of the circle into cells whose images
are followed until they stick, or never impact again.
"""

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.circle")

from functools import partial

from proofs.shell.runner import run

main = partial(run, "circle", description=__doc__)
