"""Section 4: single-impact orbits. (16)-(18) derived; which solutions are orbits, and stable.

Identities are found with sympy; solutions, first impacts and the ends of the windows of stable
orbits in figures 7a and 7b are enclosed with the package `intervals`.
"""

from __future__ import annotations

import sys

from proofs.shell.runner import run


def main(arguments: list[str] | None = None) -> int:
    """Run the command; return the exit status."""
    return run("single", arguments, __doc__, figure=True)


if __name__ == "__main__":
    sys.exit(main())
