"""What can be proved about the motion at parameters of one's own: chaos, attractors, rest.

Asks four questions at any eta > 0 and nu: does the mass come to rest on the table for ever (X1)?
Is there an invariant Cantor set on which the impact map is chaotic (X2)? Do phases of positive
measure lead to an impact at which the mass sticks (X3)? Are there stable orbits with one impact in
n periods of the table (X4)? Sets and orbits are found by themselves, then proved.
"""

import sys
from functools import partial

from proofs.shell.runner import run

EXAMPLES = """
  python -m proofs.explore --eta 0.25 --nu -0.3 --out runs
  python -m proofs.explore --eta 0.103 --nu 0.541 --only X2 --out runs
"""

main = partial(run, "explore", description=__doc__, examples=EXAMPLES)

if __name__ == "__main__":
    sys.exit(main())
