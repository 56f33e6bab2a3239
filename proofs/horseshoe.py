"""Is the impact map a horseshoe on the printed sets? Claims H1-H6, H11, H16, N1 and N2.

The main job: proves or refutes each claim at exact parameters, repairs the sets where the
printed numbers fail, writes certificate and report, and has the checker re-derive them.
"""

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.horseshoe")

from functools import partial

from proofs.shell.cli import horizon
from proofs.shell.runner import More, run

EXAMPLES = """
  python -m proofs.horseshoe --eta 0.22 --nu -0.2      I0, I1 and the slopes are found there
  python -m proofs.horseshoe --eta 0.103 --nu 0.541    f decreases on the sets that are found
  python -m proofs.horseshoe --eta 0.212 --nu -0.2 --left 1.1 1.15 --right 1.27 1.32
  python -m proofs.horseshoe --only N1 N2 --epsilon 0.02
"""

MORE = More({"horizon": {"type": horizon, "help": "longest flight looked at (default 1000)"}})

main = partial(run, "horseshoe", description=__doc__, examples=EXAMPLES, more=MORE)
