"""Is the impact map a horseshoe on the printed sets? Claims H1-H6, H11, H16, N1 and N2.

The main job: proves or refutes each claim at exact parameters, repairs the sets where the
printed numbers fail, writes certificate and report, and has the checker re-derive them.
"""

from __future__ import annotations

import sys

from proofs.shell.runner import run

EXAMPLES = """
  python -m proofs.horseshoe --eta 0.212 --nu -0.2 --left 1.1 1.15 --right 1.27 1.32
  python -m proofs.horseshoe --only N1 N2 --epsilon 0.02
"""


def main(arguments: list[str] | None = None) -> int:
    """Run the main job; return the exit status."""
    return run("horseshoe", arguments, __doc__, figure=True, examples=EXAMPLES)


if __name__ == "__main__":
    sys.exit(main())
