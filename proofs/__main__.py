"""`python -m proofs`: every claim decided so far, with one exit status."""

import sys

from proofs.shell.ledger import main

if __name__ == "__main__":
    sys.exit(main())
