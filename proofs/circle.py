"""Sections 2 and 3.4: where the mass sticks, and how much of the circle ends up sticking.

Claims M6, G1-G4 and G6: the sticking arc and the orbit through it, an interval of phases that never
impact again, and a partition of the circle into cells whose images are followed until they stick.
"""

from __future__ import annotations

import sys

from proofs.shell.runner import run


def main(arguments: list[str] | None = None) -> int:
    """Run the command; return the exit status."""
    return run("circle", arguments, __doc__, figure=True)


if __name__ == "__main__":
    sys.exit(main())
