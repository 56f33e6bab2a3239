"""Section 3.4 with restitution: the stable orbit persists, with infinitely many impacts a period.

Claims G7 and G8. The flight from the separation phase does not depend on epsilon; after it, for
ever larger epsilon, the bounces are enclosed until they are proved to end before that phase.
"""

from __future__ import annotations

import sys

from proofs.shell.runner import run


def main(arguments: list[str] | None = None) -> int:
    """Run the command; return the exit status."""
    return run("persistence", arguments, __doc__, figure=True)


if __name__ == "__main__":
    sys.exit(main())
