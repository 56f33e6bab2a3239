"""One page on all claims, its Markdown and figures, from the certificates that are there."""

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.report.__main__")

import os
import sys
from contextlib import nullcontext
from pathlib import Path

from proofs.report.build import INSTALL, built, missing
from proofs.report.checker import NoPyodide, runtime
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

exit status: 0 written, 1 a package of the extra `report`, or pyodide, is missing,
             2 bad input (nothing is written), 3 the ledger says what its certificates do not prove

examples:
  python -m proofs report
  python -m proofs report --out runs
  python -m proofs report --with-checker
"""


def main(arguments: list[str] | None = None) -> int:
    """Write the pages of a folder; return the exit status."""
    parser = Parser("proofs report", __doc__, EPILOG)
    parser.add_argument("--out", type=Path, default=Path("reports"), help="default: reports")
    help_text = "write DIR/checker.html, too: the page with Python and the checker in it"
    parser.add_argument("--with-checker", action="store_true", help=help_text)
    help_text = "npm's package pyodide, unpacked (default: npm fetches it)"
    parser.add_argument("--pyodide", type=Path, metavar="DIR", help=help_text)
    parser.add_argument("--quiet", action="store_true", help="print nothing")
    options = parser.parse_args(arguments)
    if not (options.out / "ledger.json").is_file():
        parser.error(f"no {options.out}/ledger.json: python -m proofs ledger writes it")
    check_folder(parser, options.out)
    packages = missing()
    wanted = options.with_checker or options.pyodide is not None
    try:
        with (
            progress() as tell,
            runtime(options.pyodide) if wanted else nullcontext() as pyodide,
            workers(os.cpu_count() or 1) as pool,
        ):
            files = built(options.out, tell, bool(packages), pyodide, each=pool.map)
    except NoPyodide as error:
        say(f"{parser.prog}: no page with a checker: {error}", sys.stderr)
        return 1
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
