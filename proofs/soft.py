"""Section 5: every equation of the soft springs derived, and its bifurcations decided."""

import sys
from functools import partial

from proofs.shell.runner import run

main = partial(run, "soft", description=__doc__)

if __name__ == "__main__":
    sys.exit(main())
