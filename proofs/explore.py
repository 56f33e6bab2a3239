"""What can be proved about the motion at parameters of one's own: chaos, attractors, rest.

Asks at any eta > 0 and nu: does the mass come to rest on the table for ever (X1)? Is there a
compact invariant set on which the impact map has positive entropy (X2)? A stable periodic motion on
which the mass sticks and leaves again (X3)? A stable periodic orbit without sticking (X4)? Sets and
orbits are found by themselves, then proved.
"""

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.explore")

from functools import partial

from proofs.shell.runner import run

EXAMPLES = """
  python -m proofs.explore --eta 0.25 --nu -0.3
  python -m proofs.explore --eta 0.103 --nu 0.541 --only X2
"""

main = partial(run, "explore", description=__doc__, examples=EXAMPLES)
