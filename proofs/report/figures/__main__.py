"""Draw the figures of the report from the certificates of a folder; nothing is proved again."""

from __future__ import annotations

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.report.figures.__main__")

import sys
from pathlib import Path

from proofs.report.build import INSTALL, missing
from proofs.report.figures import figures, names
from proofs.report.figures.figure import Certificates
from proofs.shell.cli import Parser
from proofs.shell.files import check_folder, writing
from proofs.shell.screen import say


def main(arguments: list[str] | None = None) -> int:
    """Draw the figures asked for; return the exit status."""
    example = "example:\n  python -m proofs.report.figures --only figure-2 --out runs\n"
    parser = Parser("proofs.report.figures", __doc__, example)
    available = names()
    parser.add_argument(
        "--only", nargs="+", choices=available, metavar="NAME", help=", ".join(available)
    )
    parser.add_argument("--out", type=Path, default=Path("reports"), help="default: reports")
    options = parser.parse_args(arguments)
    if "matplotlib" in missing():
        say(f"{parser.prog}: no figures, matplotlib missing: {INSTALL}", sys.stderr)
        return 1
    check_folder(parser, options.out)
    documents = Certificates(options.out)
    with writing(options.out / "figures") as put:
        for figure in figures():
            if not options.only or figure.name in options.only:
                put(f"{figure.name}.svg", figure.svg(documents))
    return 0
