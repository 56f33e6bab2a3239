"""Re-derive every verdict in certificates, from their witnesses alone: the independent checker."""

from __future__ import annotations

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.check")

import argparse
import sys
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import nullcontext
from functools import partial
from itertools import islice
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Any

from proofs.shell.entry import workers
from proofs.shell.screen import Arguments, fitted, say
from proofs.trusted.certificate import (
    LEDGER,
    MANIFEST,
    Malformed,
    digest,
    read,
    read_stream,
    schema_of,
)
from proofs.trusted.kernel.meter import DEFAULT, Exhausted
from proofs.trusted.manifest import Listed, check_ledger, check_manifest
from proofs.trusted.numbers import floor_text
from proofs.trusted.parameters import Parameters
from proofs.trusted.verdicts import Verdict, tally
from proofs.trusted.verify import Rejected, Report, check

if TYPE_CHECKING:
    from concurrent.futures import Executor, Future

PIPED = Path("-")
_CHUNK = 16  # cells that are checked together
STORE = b"SQLite format 3\0"
FOLDERS = {MANIFEST: ("a manifest", check_manifest), LEDGER: ("a ledger", check_ledger)}
EPILOG = """\
exit status: 0 every claim in every file is decided as stated (SIMULATED is no proof)
             1 a claim is undecided, or a file does not prove what it says
             2 a file cannot be read or is no certificate

examples:
  python -m proofs check reports/horseshoe.json
  python -m proofs horseshoe --json - | python -m proofs check -
  python -m proofs check reports/MANIFEST.json    every file listed there, against what is listed
  python -m proofs check runs/atlas/atlas.sqlite --jobs 2     every cell of an atlas
  python -m proofs check --rules                  what may be inferred, and from what
"""


def main(arguments: list[str] | None = None) -> int:
    """Check the files named on the command line; return the exit status."""
    parser = Arguments("proofs check", __doc__, EPILOG)
    files = "a certificate, or MANIFEST.json or ledger.json beside those; - for one piped in"
    parser.add_argument("files", nargs="*", metavar="FILE", type=Path, help=files)
    parser.add_argument("--rules", action="store_true", help="print the rules of inference")
    parser.add_argument("--quiet", action="store_true", help="print nothing but what is wrong")
    help_text = f"how much work a file may take (default {DEFAULT})"
    parser.add_argument("--work", type=_work, default=DEFAULT, metavar="N", help=help_text)
    jobs = "processes that check the cells of an atlas (default 1)"
    parser.add_argument("--jobs", type=_work, default=1, metavar="N", help=jobs)
    options = parser.parse_args(arguments)
    if options.rules:
        from proofs.report.specification import specification

        print(fitted(specification(), sys.stdout), end="")
    elif not options.files:
        parser.error("no file to check")
    checks = (check_file(path, options.work, options.quiet, options.jobs) for path in options.files)
    return max(checks, default=0)


def _work(text: str) -> int:
    """Read an amount of work for argparse."""
    if not text.isascii() or not text.isdigit() or not int(text[:19]) > 0:
        raise argparse.ArgumentTypeError(f"a positive whole number is expected, not {text[:20]!r}")
    return int(text[:19])


def check_file(path: Path, work: int = DEFAULT, is_quiet: bool = False, jobs: int = 1) -> int:
    """Check one file, print a line a claim; return its exit status."""
    name = "standard input" if path == PIPED else str(path)
    if not name.isprintable():
        name = ascii(name)
    try:
        if path != PIPED and _is_store(path):
            said, is_open = _check_store(path, name, work, jobs)
        else:
            source = read_stream(sys.stdin.buffer) if path == PIPED else read(path)
            if (schema := schema_of(source)) in FOLDERS:
                name = f"{name}: {FOLDERS[schema][0]}"
            said, is_open = _check_text(source, schema, path.parent, name, work)
    except Malformed as error:
        return _refused(2, f"{name}: malformed: {error}")
    except OSError as error:
        return _refused(2, f"{name}: cannot be read: {error.strerror or error}")
    except Rejected as error:
        return _refused(1, f"{name}: REJECTED: {error}")
    except Exhausted as error:
        return _refused(1, f"{name}: not decided: {error}")
    if not is_quiet:  # here, where a closed pipe is no fault of the file
        say("\n".join(said))
    return int(is_open)


def _check_text(
    source: str, schema: str, folder: Path, name: str, work: int
) -> tuple[list[str], bool]:
    """Check a certificate, or a list of some; return what to say, and if anything is undecided."""
    if schema in FOLDERS:
        listed = FOLDERS[schema][1](source, folder, work)
        said = f"{name} of {_counted(listed)}, all as the certificates beside it prove"
        return [said], Verdict.UNDECIDED in {each.verdict for each in listed}
    report = check(source, work)
    is_open = Verdict.UNDECIDED in {claim.verdict for claim in report.claims}
    return report_lines(name, report, digest(source)), is_open


def _is_store(path: Path) -> bool:
    """Whether a file is of SQLite's format, as an atlas is."""
    with path.open("rb") as file:
        return file.read(len(STORE)) == STORE


def _check_store(path: Path, name: str, work: int, jobs: int) -> tuple[list[str], bool]:
    """Check an atlas, in several processes; return what to say, and if anything is undecided."""
    from proofs.trusted.atlas import check_store  # with sqlite3, which nothing else needs

    began = perf_counter()
    with nullcontext() if jobs == 1 else workers(jobs) as pool:
        found = check_store(path, work, partial(_mapped, pool, jobs) if pool else map)
    each = ", ".join(f"{count} {verdict}" for verdict, count in sorted(found.cells.items()))
    share = floor_text(found.areas[Verdict.UNDECIDED.value] / found.whole)
    rate = sum(found.cells.values()) / (perf_counter() - began)
    said = (
        f"{name}: an atlas of {each} cells, all as their certificates prove; undecided "
        f"{share} of the area, not looked at {floor_text(found.missing / found.whole)}; "
        f"{rate:.0f} cells a second"
    )
    return [said], found.cells[Verdict.UNDECIDED.value] > 0 or found.missing > 0


def _mapped(
    pool: Executor, jobs: int, work: Callable[[Any], Any], rows: Iterable[Any]
) -> Iterator[Any]:
    """Do as `map`, in a pool, reading few rows ahead: a store may be larger than the memory."""
    left = iter(rows)
    ahead: deque[Future[list[Any]]] = deque()
    while chunk := list(islice(left, _CHUNK)):
        ahead.append(pool.submit(_each, work, chunk))
        if len(ahead) > 4 * jobs:
            yield from ahead.popleft().result()
    while ahead:
        yield from ahead.popleft().result()


def _each(work: Callable[[Any], Any], rows: list[Any]) -> list[Any]:
    return [work(row) for row in rows]


def _refused(status: int, line: str) -> int:
    say(line, sys.stderr)
    return status


def _counted(listed: list[Listed]) -> str:
    claims = {(each.id, each.is_paper): each for each in listed}.values()  # in two files, as N1
    named = tally((each.verdict, each.is_own) for each in claims)
    other = sum(not each.is_paper for each in claims)
    where = f", {other} of them at other parameters" if other else " at the paper's parameters"
    return f"{len(claims)} claims{where}: {named}"


def report_lines(name: str, report: Report, digest_of: str) -> list[str]:
    """Return what a certificate was found to prove."""
    whose = "the paper's parameters" if report.is_paper else "not the paper's parameters"
    if not isinstance(report.parameters, Parameters):
        whose = "about formulas" if report.parameters is None else "about a box of parameters"
    said = [f"{name}: accepted, {whose}, {digest_of}"]
    for claim in report.claims:
        said.append(f"  {claim.id:4} {claim.verdict.value:11} {claim.statement} [{claim.why}]")
        if claim.corrected is not None:
            said.append(f"       corrected, VERIFIED: {claim.corrected}")
    return said + [f"  {sentence}" for sentence in report.sentences]
