"""`python -m proofs`: every claim decided so far, with one exit status.

Today that is the main job, `python -m proofs.horseshoe`, whose options it takes.
"""

import sys

from proofs.horseshoe import main

if __name__ == "__main__":
    sys.exit(main())
