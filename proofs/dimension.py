"""Claim 1 read for the map itself: the Hausdorff dimension of the set that stays in I (H13)."""

from __future__ import annotations

import sys

from proofs.shell.runner import run


def main(arguments: list[str] | None = None) -> int:
    """Run the command; return the exit status."""
    return run("dimension", arguments, __doc__)


if __name__ == "__main__":
    sys.exit(main())
