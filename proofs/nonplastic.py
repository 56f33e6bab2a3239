"""Section 3.3: the impact map with restitution on the printed rectangles. Claims N1 to N4.

Candidates by floating point; every impact, rectangle and barred word is proved by interval
arithmetic and recorded for the checker.
"""

from __future__ import annotations

import sys

from proofs.shell.runner import run


def main(arguments: list[str] | None = None) -> int:
    """Run the command; return the exit status."""
    return run("nonplastic", arguments, __doc__)


if __name__ == "__main__":
    sys.exit(main())
