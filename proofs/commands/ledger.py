"""Every claim of the paper: proved, or only checked where its certificate is there already."""

from __future__ import annotations

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.commands.ledger")

import json
import os
import sys
from argparse import Namespace
from collections.abc import Iterable, Mapping, Sequence
from concurrent.futures import as_completed
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from time import perf_counter
from typing import Any

from proofs.report import current
from proofs.report.accepted import Accepted, accepted
from proofs.shell import runner
from proofs.shell.cli import Parser, heard, progress
from proofs.shell.entry import workers
from proofs.shell.files import refusing, write_files, write_target, writing
from proofs.shell.groups import FILES, MANIFEST_NAME, Made, entered, produce, row_of, wanted
from proofs.shell.screen import Decided, say, show_verdicts
from proofs.trusted.certificate import LEDGER, Malformed
from proofs.trusted.files import read, render
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
_LONGEST = (
    "circle",
    "entropy",
    "soft",
    "chaos",
    "persistence",
    "nonplastic",
    "resonance",
    "dimension",
)  # begun before the others, in this order
_DRAWING = ("matplotlib.pyplot", "proofs.report.html")
EPILOG = """\
Decides the paper's claims at its own numbers, group by group, and writes DIR/ledger.json, for each
group a certificate, which the checker re-derives, and the report of it all, DIR/index.html and
DIR/ledger.md. A certificate that is there already, accepted and complete, is checked and not proved
again, unless --fresh or --digits ask for it; which prover wrote it does not matter. DIR is
`reports` where all claims are asked for, else `runs`, to which what is complete in `reports` is
copied. Where nothing has changed since the last time, neither a certificate nor a page nor this
program (your cache has the digests, DIR has not), what was found then is printed, and nothing is
checked again; `python -m proofs check DIR/MANIFEST.json` always checks.

exit status: 0 every claim asked for is decided, 1 something is undecided,
             2 bad input (nothing is written), 3 the checker disagrees (a bug)

examples:
  python -m proofs ledger
  python -m proofs ledger --only G2 H13 --fresh
  python -m proofs ledger --json - --quiet > ledger.json
"""


@dataclass(frozen=True)
class Job:
    """A file of claims to settle in a folder.

    fresh: prove it whatever is there.
    """

    name: str
    claims: tuple[str, ...]
    folder: Path
    digits: int
    fresh: bool


@dataclass(frozen=True)
class Settled:
    """A file of claims: its certificate and page, what the checker found in it.

    folder: the one that it was in already.
    """

    job: Job
    made: Made
    report: Report
    folder: Path | None
    seconds: float

    @property
    def is_new(self) -> bool:
        """Whether it was proved just now."""
        return self.folder is None

    def rows(self, in_coq: Mapping[str, Accepted]) -> list[dict[str, Any]]:
        """Return the entries asked for, for the ledger, with the theorems that Coq has."""
        return [
            {
                **{name: value for name, value in entry.items() if name != "proof"},
                "file": f"{self.job.name}.json",
                "coq": [*in_coq[entry["id"]].theorems] if entry["id"] in in_coq else [],
            }
            for entry in json.loads(self.made.certificate)["claims"]
            if entry["id"] in self.job.claims
        ]


def jobs(claims: Iterable[str], folder: Path, places: int, fresh: bool) -> list[Job]:
    """Return the files to settle: those that have a claim which no file before them has."""
    asked, chosen_jobs = set(claims), []
    left = set(asked)
    for name, parts in FILES.items():
        members = [claim for ids in parts.values() for claim in ids]
        if left.intersection(members):
            chosen = tuple(claim for claim in members if claim in asked)
            chosen_jobs.append(Job(name, chosen, folder, places, fresh))
            left.difference_update(members)
    return chosen_jobs


def settle(job: Job) -> Settled:
    """Have a file of claims proved, if need be, and checked; all its claims, if all were there.

    Raises Rejected or Malformed where the checker does not accept what was just proved: a bug.
    """
    began = perf_counter()
    places = [job.folder, *([runner.REPORTS] if job.folder == runner.RUNS else [])]
    for folder in () if job.fresh else places:
        there = _there(job, folder)
        if there is not None:
            page = folder / f"{job.name}.md"
            text = page.read_text(encoding="utf-8") if page.is_file() else ""
            made = Made([], there[0], text)
            return Settled(job, made, there[1], folder, perf_counter() - began)
    is_whole = runner.is_whole(job.folder, job.name)
    claims = runner.claims_of(job.name) if is_whole else job.claims
    made = produce(wanted(job.name, PAPER, claims), PAPER, digits=job.digits)
    report = check(made.certificate)
    return Settled(job, made, report, None, perf_counter() - began)


def _there(job: Job, folder: Path) -> tuple[str, Report] | None:
    """Return the certificate that is in a folder, if it decides every claim of the job."""
    try:
        text = read(folder / f"{job.name}.json")
        report = check(text)
    except (Malformed, Rejected, OSError):
        return None
    verdicts = {claim.id: claim.verdict for claim in report.claims}
    open_ones = {None, Verdict.UNDECIDED} & {verdicts.get(claim) for claim in job.claims}
    return None if open_ones or not report.is_paper else (text, report)


def main(arguments: list[str] | None = None) -> int:
    """Settle the claims asked for; return the exit status."""
    parser = Parser("proofs ledger", "Every claim that is decided so far.", EPILOG)
    runner.add_outputs(parser, CLAIMS)
    parser.add_argument("--fresh", action="store_true", help="prove again what is there already")
    options = parser.parse_args(arguments)
    asked = options.only or CLAIMS
    runner.choose_folder(parser, options, not set(asked).issuperset(CLAIMS))
    fresh, places = options.fresh or options.digits is not None, options.digits or runner.PLACES
    options.began = perf_counter()
    if not fresh and (unchanged := _unchanged(options.out, asked)) is not None:
        return _told(parser, options, *unchanged)
    try:
        settled = _settle_all(parser, jobs(asked, options.out, places, fresh))
    except (Malformed, Rejected) as error:
        say(f"THE CHECKER DISAGREES WITH THE PROVER, a bug: {error}", sys.stderr)
        return 3
    certificates = {f"{each.job.name}.json": each.made.certificate for each in settled}
    in_coq = accepted(certificates.values())
    rows = _in_order([row for each in settled for row in each.rows(in_coq)])
    text = render({"schema": LEDGER, "claims": rows})
    with refusing(parser, options.out):
        with writing(options.out) as put:
            put("ledger.json", text)
            put(MANIFEST_NAME, entered(options.out, certificates))
        pages = _pages(options.out, settled, fresh)
    shown = [
        f"{each.job.name}: {how} in {each.seconds:.1f} s"
        for each in settled
        for how in ["proved and checked" if each.is_new else f"in {each.folder}, checked again"]
    ]
    return _told(parser, options, text, pages, shown)


def _unchanged(folder: Path, asked: Iterable[str]) -> tuple[str, set[str], list[str]] | None:
    """Return a folder's ledger, its pages and a line that says that nothing has changed there.

    None where something has since all of it was checked and the pages were made, where the ledger
    is about other claims, and where one is undecided: that is tried again.
    """
    pages = current.pages(folder, current.inputs(folder))
    if pages is None:
        return None
    try:
        text = (folder / "ledger.json").read_text(encoding="utf-8")
        rows = json.loads(text)["claims"]
        if {row["id"] for row in rows} != {*asked} or _open(rows):
            return None
    except (OSError, ValueError, KeyError, TypeError):
        return None
    again = f"python -m proofs check {folder}/{MANIFEST_NAME} checks it again"
    return text, pages, [f"{folder}: nothing has changed since it was checked; {again}"]


def _open(rows: Sequence[dict[str, Any]]) -> bool:
    return any(row["verdict"] == Verdict.UNDECIDED.value for row in rows)


def _told(
    parser: Parser, options: Namespace, text: str, pages: set[str], shown: Sequence[str]
) -> int:
    """Give the ledger, how it was settled, and where the pages are; return the exit status."""
    write_target(parser, options.json, lambda: text)
    rows = json.loads(text)["claims"]
    if heard(options):
        claims = [Decided(x["id"], Verdict(x["verdict"]), x["statement"], x["why"]) for x in rows]
        show_verdicts(claims, verbose=options.verbose)
        for line in shown:
            say(line)
        verdicts = tally((Verdict(row["verdict"]), row_of(row["id"]).own) for row in rows)
        say(f"{verdicts} in {perf_counter() - options.began:.1f} s")
        say(f"all of it: {options.out}/{_first(pages)}")
    return int(_open(rows))


def _first(pages: set[str]) -> str:
    """Return the page to read, and how there is a better one."""
    if "index.html" in pages:
        return "index.html"
    from proofs.report.build import INSTALL

    return f"ledger.md; for a page with formulas: {INSTALL}"


def _pages(folder: Path, settled: Sequence[Settled], fresh: bool) -> set[str]:
    """Have the pages of a folder made, if they are not there already, and return their names."""
    made_from = current.inputs(folder)
    there = None if fresh else current.pages(folder, made_from)
    if there is not None:
        return there
    from proofs.report.build import built, missing

    derived = {each.job.name: each.report.context for each in settled}
    with progress() as tell, workers(os.cpu_count() or 1) as pool:
        made = built(folder, tell, bool(missing()), derived=derived, each=pool.map)
    write_files(folder, made)
    current.record(folder, made_from, made)
    return set(made)


def _in_order(rows: Sequence[dict[str, Any]]) -> list[dict[str, Any]]:
    """Return for each claim the first of its rows, in the order of the catalogue."""
    first = {row["id"]: row for row in reversed(rows)}
    return [first[claim] for claim in CLAIMS if claim in first]


def _load_drawing() -> None:
    """Import what draws while others prove; the processes that draw will be copies of this one."""
    from proofs.report.build import missing

    for name in () if missing() else _DRAWING:
        import_module(name)


def _settle_all(parser: Parser, todo: Sequence[Job]) -> list[Settled]:
    """Settle the files in processes of their own, as many at a time as there are processors.

    Each is written as soon as it is settled, so that an interrupt loses nothing that is.
    """
    settled = {}
    in_turn = sorted(todo, key=lambda job: (*_LONGEST, job.name).index(job.name))
    with workers(min(len(todo), os.cpu_count() or 1)) as pool:
        futures = {pool.submit(settle, job): job for job in in_turn}
        with progress() as tell:
            tell(f"0 of {len(todo)} groups of claims")
            _load_drawing()
            for future in as_completed(futures):
                job, result = futures[future], future.result()
                if result.folder != job.folder:
                    with refusing(parser, job.folder):
                        runner.write(job.folder, job.name, result.made)
                settled[job] = result
                tell(f"{len(settled)} of {len(todo)} groups of claims")
    return [settled[job] for job in todo]
