"""One page on all claims, its Markdown and figures, from the certificates that are there."""

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.report.__main__")

import os
from pathlib import Path

from proofs.report.build import INSTALL, built, missing
from proofs.shell.cli import Parser, progress
from proofs.shell.entry import workers
from proofs.shell.files import check_folder, refusing, write_files
from proofs.shell.screen import say
from proofs.trusted.certificate import Malformed
from proofs.trusted.verify import Rejected

EPILOG = """\
Reads DIR/ledger.json and the certificates beside it, and writes DIR/index.html, a page that needs
nothing else and opens from the disk; DIR/ledger.md, the same as Markdown; DIR/theorem.md, what is
proved of the motion at the paper's parameters; DIR/figures/*.svg. What the certificates conclude is
derived again; nothing is proved anew.

exit status: 0 written, 1 a package of the extra `report` is missing,
             2 bad input (nothing is written), 3 the ledger says what its certificates do not prove

examples:
  python -m proofs report
  python -m proofs report --out runs
"""


def main(arguments: list[str] | None = None) -> int:
    """Write the pages of a folder; return the exit status."""
    parser = Parser("proofs report", __doc__, EPILOG)
    parser.add_argument("--out", type=Path, default=Path("reports"), help="default: reports")
    parser.add_argument("--quiet", action="store_true", help="print nothing")
    options = parser.parse_args(arguments)
    if not (options.out / "ledger.json").is_file():
        parser.error(f"no {options.out}/ledger.json: python -m proofs ledger writes it")
    check_folder(parser, options.out)
    packages = missing()
    try:
        with progress() as tell, workers(os.cpu_count() or 1) as pool:
            files = built(options.out, tell, bool(packages), each=pool.map)
    except Malformed as error:
        parser.error(f"the ledger in {options.out} or a certificate of it is malformed: {error}")
    except OSError as error:
        parser.error(f"cannot read {error.filename}: {error.strerror}")
    except Rejected as error:
        say(f"{parser.prog}: the ledger is not what its certificates prove: {error}")
        return 3
    with refusing(parser, options.out):
        write_files(options.out, files)
    if packages:
        say(f"{parser.prog}: no index.html, {', '.join(packages)} missing: {INSTALL}")
    elif not options.quiet:
        say(f"{options.out}/index.html and {len(files) - 1} more files")
    return int(bool(packages))
