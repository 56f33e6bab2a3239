"""Every claim that is decided so far: `python -m proofs`.

Proves what is asked for and not already there: a certificate in the folder that is about the same
numbers, that the checker accepts and that leaves nothing open is not proved again. Which prover
wrote it does not matter, as the checker re-derives all of it from today's equations and statements.
"""

from __future__ import annotations

import json
import os
import sys
from collections import Counter
from collections.abc import Iterable, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import dataclass, field, replace
from pathlib import Path
from time import perf_counter
from typing import Any

from proofs.report import page
from proofs.shell import runner
from proofs.shell.cli import Parser, coloured, counting, progress, writable
from proofs.shell.counting import Counts, show
from proofs.shell.groups import FILES, Made, produce, row_of, wanted
from proofs.trusted.certificate import LEDGER, Malformed, read, render, write_atomically
from proofs.trusted.paper import GROUPS
from proofs.trusted.parameters import PAPER
from proofs.trusted.verdicts import Verdict, tally
from proofs.trusted.verify import Rejected, Report, check

CLAIMS = tuple(
    sorted(
        {claim for claims in GROUPS.values() for claim in claims},
        key=lambda claim: ("MHNGPSREA".index(claim[0]), int(claim[1:])),
    )
)
EPILOG = """\
Decides the paper's claims at its own numbers, group by group, and writes DIR/ledger.json,
DIR/ledger.md and for each group a certificate, which the checker re-derives. A certificate that is
there already, accepted and complete, is checked and not proved again.

exit status: 0 every claim asked for is decided, 1 something is undecided,
             2 bad input (nothing is written), 3 the checker disagrees (a bug)

examples:
  python -m proofs
  python -m proofs --only G2 H13 --fresh
  python -m proofs --json - > ledger.json
"""


@dataclass(frozen=True)
class Job:
    """A file of claims to settle in a folder.

    fresh: prove it whatever is there. stats: count what is evaluated.
    """

    name: str
    claims: tuple[str, ...]
    folder: Path
    digits: int
    fresh: bool
    stats: bool = False


@dataclass(frozen=True)
class Settled:
    """A file of claims: its certificate and page, what the checker found in it."""

    job: Job
    made: Made
    report: Report
    is_new: bool
    seconds: float
    counts: Counts = field(default_factory=Counter)

    def rows(self) -> list[dict[str, Any]]:
        """Return the entries asked for, for the ledger."""
        return [
            {
                **{name: value for name, value in entry.items() if name != "proof"},
                "file": f"{self.job.name}.json",
            }
            for entry in json.loads(self.made.certificate)["claims"]
            if entry["id"] in self.job.claims
        ]


def jobs(
    claims: Iterable[str], folder: Path, places: int, fresh: bool, stats: bool = False
) -> list[Job]:
    """Return the files to settle: those that have a claim which no file before them has."""
    asked, found = set(claims), []
    left = set(asked)
    for name, parts in FILES.items():
        members = [claim for ids in parts.values() for claim in ids]
        if left.intersection(members):
            chosen = tuple(claim for claim in members if claim in asked)
            found.append(Job(name, chosen, folder, places, fresh, stats))
            left.difference_update(members)
    return found


def settle(job: Job) -> Settled:
    """Have a file of claims proved, if need be, and checked.

    Raises Rejected or Malformed where the checker does not accept what was just proved: a bug.
    """
    began = perf_counter()
    there = None if job.fresh else _there(job)
    if there is not None:
        return Settled(job, Made([], there[0], ""), there[1], False, perf_counter() - began)
    made = produce(wanted(job.name, PAPER, job.claims), PAPER, digits=job.digits)
    return Settled(job, made, check(made.certificate), True, perf_counter() - began)


def settle_counting(job: Job) -> Settled:
    """Do `settle`, and count what it evaluates, if that is wanted."""
    with counting(job.stats) as counts:
        return replace(settle(job), counts=counts)


def _there(job: Job) -> tuple[str, Report] | None:
    """Return the certificate that is there, if it decides every claim of the job."""
    try:
        text = read(job.folder / f"{job.name}.json")
        report = check(text)
    except (Malformed, Rejected, OSError):
        return None
    verdicts = {claim.id: claim.verdict for claim in report.claims}
    open_ones = {None, Verdict.UNDECIDED} & {verdicts.get(claim) for claim in job.claims}
    return None if open_ones or not report.is_paper else (text, report)


def main(arguments: list[str] | None = None) -> int:
    """Settle the claims asked for; return the exit status."""
    parser = Parser("proofs", __doc__, EPILOG)
    runner.add_outputs(parser, CLAIMS)
    parser.add_argument("--fresh", action="store_true", help="prove again what is there already")
    options = parser.parse_args(arguments)
    writable(parser, options.out)
    asked = options.only or CLAIMS
    todo = jobs(asked, options.out, options.digits, options.fresh, options.stats)
    began = perf_counter()
    try:
        settled = _settle_all(todo)
    except (Malformed, Rejected) as error:
        print(f"THE CHECKER DISAGREES WITH THE PROVER, a bug: {error}", file=sys.stderr)
        return 3
    rows = _in_order([row for one in settled for row in one.rows()])
    text = render({"schema": LEDGER, "claims": rows})
    try:
        for one in settled:
            if one.is_new:
                runner.write(options.out, one.job.name, one.made)
        write_atomically(options.out / "ledger.json", text)
        write_atomically(options.out / "ledger.md", _page(rows))
    except OSError as error:
        parser.error(f"cannot write to {options.out}: {error.strerror or error}")
    if options.json:
        print(text, end="")
    else:
        _print(rows, settled, perf_counter() - began)
    for one in settled if options.stats else ():
        show(one.counts, one.job.claims, quiet=bool(options.json))
    return int(any(row["verdict"] == Verdict.UNDECIDED.value for row in rows))


def _in_order(rows: Sequence[dict[str, Any]]) -> list[dict[str, Any]]:
    """Return for each claim the first of its rows, in the order of the catalogue."""
    first = {row["id"]: row for row in reversed(rows)}
    return [first[claim] for claim in CLAIMS if claim in first]


def _settle_all(wanted: Sequence[Job]) -> list[Settled]:
    """Settle the files in processes of their own, as many at a time as there are processors."""
    with progress() as tell, ProcessPoolExecutor(min(len(wanted), os.cpu_count() or 1)) as pool:
        futures = {pool.submit(settle_counting, job): job for job in wanted}
        found = {}
        for future in as_completed(futures):
            found[futures[future]] = future.result()
            tell(f"{len(found)} of {len(wanted)} groups of claims")
    return [found[job] for job in wanted]


def _print(rows: Sequence[dict[str, Any]], settled: Sequence[Settled], seconds: float) -> None:
    for row in rows:
        print(f"{row['id']:4} {coloured(Verdict(row['verdict']))} {row['statement']}")
        print(f"     {row['why']}")
    for one in settled:
        what = "proved and checked" if one.is_new else "checked again"
        print(f"{one.job.name}: {what} in {one.seconds:.1f} s")
    counted = tally((Verdict(row["verdict"]), row_of(row["id"]).own) for row in rows)
    print(f"{counted} in {seconds:.1f} s")


def _page(rows: Sequence[dict[str, Any]]) -> str:
    return page.ledger(rows, {row["id"]: row_of(row["id"]).words for row in rows})


if __name__ == "__main__":
    sys.exit(main())
