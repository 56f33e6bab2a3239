"""Section 5: every equation of the soft springs derived, and its bifurcations decided."""

from __future__ import annotations

import sys

from proofs.shell.runner import run


def main(arguments: list[str] | None = None) -> int:
    """Run the command; return the exit status."""
    return run("soft", arguments, __doc__)


if __name__ == "__main__":
    sys.exit(main())
