"""The main job as a module, `python -m proofs horseshoe`: see `proofs.commands.groups`."""

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.horseshoe")

from functools import partial

from proofs.commands.groups import GROUPS
from proofs.shell.runner import run

main = partial(run, GROUPS["horseshoe"])
