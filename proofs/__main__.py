"""All commands, and the way to each: `impact-proofs COMMAND`, or `python -m proofs COMMAND`.

A command is a group of claims of `proofs.commands.groups`; or what has a line with `__main__` in
this folder, or in a `__main__.py` below it. The first paragraph of its text says what it does.
"""

from __future__ import annotations

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.__main__")

import ast
import sys
from difflib import get_close_matches
from pathlib import Path

from proofs import __version__
from proofs.shell.entry import USAGE_ERROR, launch, run_command
from proofs.shell.screen import flowing, say

_ROOT = Path(__file__).parent
_USAGE = """\
usage: impact-proofs COMMAND [OPTION ...]     or: python -m proofs COMMAND [OPTION ...]

Verdicts on a paper about chaos in an impact oscillator, each with a certificate. `COMMAND --help`
has its options and examples; options without a command go to `ledger`.
"""


def _files() -> dict[str, Path]:
    """Return the file of each command that is a module of its own."""
    files = [*_ROOT.glob("*.py"), *_ROOT.glob("*/__main__.py"), *_ROOT.glob("commands/*.py")]
    return {
        file.parent.name if file.stem == "__main__" else file.stem: file
        for file in sorted(files)
        if file != Path(__file__) and 'if __name__ == "__main__":' in file.read_text("utf-8")
    }


def modules() -> dict[str, str]:
    """Return what each of them says of itself."""
    trees = {name: ast.parse(file.read_text("utf-8")) for name, file in _files().items()}
    return {name: ast.get_docstring(tree) or "" for name, tree in trees.items()}


def commands() -> dict[str, str]:
    """Return for each command its line in the list."""
    from proofs.commands.groups import GROUPS

    texts = modules() | {name: group.about for name, group in GROUPS.items()}
    return {
        name: " ".join(text.partition("\n\n")[0].split()) for name, text in sorted(texts.items())
    }


def main(arguments: list[str] | None = None) -> int:
    """List the commands, or run the one that is named; return the exit status."""
    first, *rest = (sys.argv[1:] if arguments is None else arguments) or ["--help"]
    if first in ("-h", "--help"):
        print(flowing(_USAGE))
        for name, line in commands().items():
            say(f"  {name:16} {line}", hanging=17)
        return 0
    if first == "--version":
        say(f"impact-proofs {__version__}")
        return 0
    if first.startswith("-"):
        first, rest = "ledger", [first, *rest]
    if file := _files().get(first):  # before the table: the checker needs nothing but Python
        inner = file.parent.name == "commands"
        return run_command(f"proofs.commands.{first}" if inner else f"proofs.{first}", rest)
    from proofs.commands.groups import GROUPS
    from proofs.shell.runner import run

    if first in GROUPS:
        return run(GROUPS[first], rest)
    near = get_close_matches(first, commands(), 1)
    hint = f"; is it {near[0]}?" if near else ", see --help"
    say(f"python -m proofs: there is no command {first[:40]!r}{hint}", sys.stderr)
    return USAGE_ERROR


def script() -> None:
    """Run the console script."""
    launch("proofs.__main__")
