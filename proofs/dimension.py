"""Claim 1 read for the map itself: the Hausdorff dimension of the set that stays in I (H13)."""

import sys
from functools import partial

from proofs.shell.runner import run

main = partial(run, "dimension", description=__doc__)

if __name__ == "__main__":
    sys.exit(main())
