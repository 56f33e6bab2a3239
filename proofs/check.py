"""Re-derive every verdict in certificates, from their witnesses alone: the independent checker."""

from __future__ import annotations

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.check")

import argparse
import os
import re
import sys
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import nullcontext
from fractions import Fraction
from functools import partial
from itertools import islice
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Any, BinaryIO

from proofs.shell.backstop import Overrun, limited
from proofs.shell.entry import workers
from proofs.shell.screen import Arguments, Decided, fitted, in_a_line, say
from proofs.trusted.certificate import LEDGER, MANIFEST, MAX_BYTES, Malformed
from proofs.trusted.files import decoded, digest, opened, schema_of
from proofs.trusted.kernel.meter import DEFAULT, METER, Exhausted, metered
from proofs.trusted.manifest import Listed, check_ledger, check_manifest
from proofs.trusted.numbers import ceil_text
from proofs.trusted.parameters import Parameters
from proofs.trusted.verdicts import Verdict, tally
from proofs.trusted.verify import Rejected, Report, check

if TYPE_CHECKING:
    from concurrent.futures import Executor, Future

PIPED = Path("-")
_CHUNK = 16  # cells that are checked together
_WIDTH = 98  # of a claim, beside what it is indented by
_STORE = b"SQLite format 3\0"
_OPEN = Verdict.UNDECIDED.value
_ATLAS = re.compile(rb'\s*\{\s*"schema"\s*:\s*"impact-proofs\.atlas/')
FOLDERS = {MANIFEST: ("a manifest", check_manifest), LEDGER: ("a ledger", check_ledger)}
EPILOG = """\
exit status: 0 every claim in every file is decided as stated (SIMULATED is no proof)
             1 a claim is undecided, or a file does not prove what it says
             2 a file cannot be read or is no certificate

examples:
  python -m proofs check reports/horseshoe.json
  python -m proofs horseshoe --json - | python -m proofs check -
  python -m proofs check reports/MANIFEST.json    every file listed there, against what is listed
  python -m proofs check runs/atlas/atlas.jsonl --jobs 2     every cell of an atlas
  python -m proofs check reports/horseshoe.json --trust
  python -m proofs check --rules                  what may be inferred, and from what
"""


def main(arguments: list[str] | None = None) -> int:
    """Check the files named on the command line; return the exit status."""
    parser = Arguments("proofs check", __doc__, EPILOG)
    files = "a certificate, or MANIFEST.json or ledger.json beside those; - for one piped in"
    parser.add_argument("files", nargs="*", metavar="FILE", type=Path, help=files)
    parser.add_argument("--rules", action="store_true", help="print the rules of inference")
    parser.add_argument("--quiet", action="store_true", help="print nothing but what is wrong")
    help_text = "say why a claim is decided so, and what is true instead"
    parser.add_argument("--verbose", action="store_true", help=help_text)
    help_text = f"how much work a file may take, all of a list twice that (default {DEFAULT})"
    parser.add_argument("--work", type=_work, default=DEFAULT, metavar="N", help=help_text)
    help_text = "for each claim the files of the checker that it rests on, and their lines"
    parser.add_argument("--trust", action="store_true", help=help_text)
    jobs = "processes that check the cells of an atlas (default 1)"
    parser.add_argument("--jobs", type=_work, default=1, metavar="N", help=jobs)
    options = parser.parse_args(arguments)
    if options.rules:
        from proofs.report.specification import specification

        print(fitted(specification(), sys.stdout), end="")
    elif not options.files:
        parser.error("no file to check")
    if options.trust:
        return max((_trust(path, options.work) for path in options.files), default=0)
    how = options.work, options.quiet, options.jobs, options.verbose
    return max((check_file(path, *how) for path in options.files), default=0)


def _trust(path: Path, work: int) -> int:
    """Say what each claim of a certificate rests on, if all is accepted; return the status."""
    from proofs.shell.trust import trusted_for

    status = check_file(path, work, is_quiet=True)
    if status < 2:
        with opened(path) as file:
            source = decoded(file.read(MAX_BYTES + 1))
        if schema_of(source) in FOLDERS:
            return _refused(2, f"{printable(path)}: --trust is about a certificate, not a list")
        for each in trusted_for(source, work):
            say(each.told)
    return status


def _work(text: str) -> int:
    """Read an amount of work for argparse."""
    if not text.isascii() or not text.isdigit() or not int(text[:19]) > 0:
        raise argparse.ArgumentTypeError(f"a positive whole number is expected, not {text[:20]!r}")
    return int(text[:19])


def printable(path: Path) -> str:
    """Return the name of a file as a terminal may show it."""
    name = "standard input" if path == PIPED else str(path)
    return name if name.isprintable() else ascii(name)


def check_file(
    path: Path,
    work: int = DEFAULT,
    is_quiet: bool = False,
    jobs: int = 1,
    is_verbose: bool = False,
) -> int:
    """Check one file, print a line a claim, or all of it; return its exit status."""
    name = printable(path)
    try:
        with (
            limited(work),
            nullcontext(sys.stdin.buffer) if path == PIPED else opened(path) as file,
        ):
            said, is_open = _check_open(file, path, work, jobs, is_verbose)
    except Malformed as error:
        return _refused(2, f"{name}: malformed: {error}")
    except OSError as error:
        return _refused(2, f"{name}: cannot be read: {error.strerror or error}")
    except Rejected as error:
        return _refused(1, f"{name}: REJECTED: {error}")
    except Exhausted as error:
        return _refused(1, f"{name}: not decided: {error}")
    except (Overrun, MemoryError):
        return _refused(1, f"{name}: not decided: it needs more time or memory: --work {2 * work}")
    if not is_quiet:  # here, where a closed pipe is no fault of the file
        say("\n".join(said))
    return int(is_open)


def _check_open(
    file: BinaryIO, path: Path, work: int, jobs: int, is_verbose: bool
) -> tuple[list[str], bool]:
    """Check what a file holds; return what to say, and if anything is undecided."""
    name, first = printable(path), file.readline(MAX_BYTES + 1)
    if first.startswith(_STORE):
        making = f"python -m proofs atlas --out {printable(path.parent)} --lines"
        raise Malformed(f"a store; what is checked are its lines, which {making} makes")
    if _ATLAS.match(first):
        return _check_lines(file, first, name, work, jobs)
    source = decoded(first + file.read(MAX_BYTES + 1 - len(first)))
    if (schema := schema_of(source)) in FOLDERS:
        what, examine = FOLDERS[schema]
        listed = examine(source, path.parent, work)
        said = f"{name}: {what} of {_counted(listed)}, all as the certificates beside it prove"
        return [said], Verdict.UNDECIDED in {each.verdict for each in listed}
    report = check(source, work)
    is_open = Verdict.UNDECIDED in {claim.verdict for claim in report.claims}
    return report_lines(name, report, digest(source), is_verbose), is_open


def _check_lines(
    file: BinaryIO, first: bytes, name: str, work: int, jobs: int
) -> tuple[list[str], bool]:
    """Check an atlas, in several processes; return what to say, and if anything is undecided."""
    from proofs.trusted.atlas import LEFT_OUT, NOT_YET, check_atlas  # with all questions

    began = perf_counter()
    try:
        with nullcontext() if jobs == 1 else workers(jobs) as pool:
            mapped = partial(_mapped, pool, jobs, work) if pool else map
            cells, shares = check_atlas(_lines(first, file), work, mapped)
    except Exhausted:
        size = os.fstat(file.fileno()).st_size  # of a pipe 0
        enough = max(2 * work, int(1.5 * work * size / max(file.tell(), 1) if size else 0))
        raise Exhausted(f"it needs more work, --work {enough}") from None
    each = ", ".join(f"{count} {verdict}" for verdict, count in sorted(cells.items()))
    rate = cells.total() / (perf_counter() - began)
    left = {what: shares.get(what, Fraction(0)) for what in (_OPEN, NOT_YET, LEFT_OUT)}
    told = ", ".join(f"{what.lower()} {ceil_text(share)}" for what, share in left.items())
    said = (
        f"{name}: an atlas of {each} cells, all as their certificates prove; of the area {told}; "
        f"{rate:.0f} cells a second"
    )
    return [said], bool(left[_OPEN] or left[NOT_YET])


def _lines(first: bytes, file: BinaryIO) -> Iterator[str]:
    """Yield the lines of a file whose first one is read already."""
    content = first
    while content:
        yield decoded(content)
        content = file.readline(MAX_BYTES + 1)


def _mapped(
    pool: Executor, jobs: int, work: int, check_one: Callable[[Any], Any], unread: Iterable[Any]
) -> Iterator[Any]:
    """Do as `map`, in a pool, reading few lines ahead: an atlas may be larger than the memory."""
    left = iter(unread)
    ahead: deque[Future[tuple[list[Any], int]]] = deque()
    while (chunk := list(islice(left, _CHUNK))) or ahead:
        if chunk:
            ahead.append(pool.submit(_each, work, check_one, chunk))
        if not chunk or len(ahead) > 4 * jobs:
            done, spent = ahead.popleft().result()
            METER.get().spend(spent)
            yield from done


def _each(work: int, check_one: Callable[[Any], Any], chunk: list[Any]) -> tuple[list[Any], int]:
    """Return what is found of some lines, and the work that it took."""
    with metered(work) as meter:
        return [check_one(each) for each in chunk], meter.spent


def _refused(status: int, line: str) -> int:
    say(line, sys.stderr)
    return status


def _counted(listed: list[Listed]) -> str:
    claims = {(each.id, each.is_paper): each for each in listed}.values()  # in two files, as N1
    named = tally((each.verdict, each.is_own) for each in claims)
    other = sum(not each.is_paper for each in claims)
    where = f", {other} of them at other parameters" if other else " at the paper's parameters"
    return f"{len(claims)} claims{where}: {named}"


def report_lines(name: str, report: Report, digest_of: str, is_verbose: bool) -> list[str]:
    """Return what a certificate was found to prove, in a line a claim unless verbose."""
    whose = "the paper's parameters" if report.is_paper else "not the paper's parameters"
    if not isinstance(report.parameters, Parameters):
        whose = "about formulas" if report.parameters is None else "about a box of parameters"
    said = [f"{name}: accepted, {whose}, {digest_of}"]
    for claim in report.claims:
        if not is_verbose:
            row = Decided(claim.id, claim.verdict, claim.statement, claim.why)
            said.append(f"  {in_a_line(row, _WIDTH)}")
            continue
        said.append(f"  {claim.id:4} {claim.verdict.value:11} {claim.statement} [{claim.why}]")
        if claim.corrected is not None:
            said.append(f"       corrected, VERIFIED: {claim.corrected}")
    return said + [f"  {sentence}" for sentence in report.sentences]
