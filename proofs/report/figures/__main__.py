"""Draw the figures of the report from the certificates of a folder; nothing is proved again."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from proofs.report.figures import figures, names
from proofs.report.figures.figure import Certificates
from proofs.shell.files import writing


def main(arguments: list[str] | None = None) -> int:
    """Draw the figures asked for; return the exit status."""
    parser = argparse.ArgumentParser("proofs.report.figures", description=__doc__)
    known = names()
    parser.add_argument("--only", nargs="+", choices=known, metavar="NAME", help=", ".join(known))
    parser.add_argument("--out", type=Path, default=Path("reports"), help="default: reports")
    options = parser.parse_args(arguments)
    documents = Certificates(options.out)
    with writing(options.out / "figures") as put:
        for figure in figures():
            if not options.only or figure.name in options.only:
                put(f"{figure.name}.svg", figure.svg(documents))
    return 0


if __name__ == "__main__":
    sys.exit(main())
