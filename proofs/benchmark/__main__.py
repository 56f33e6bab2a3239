"""Speed and accuracy, measured here and now beside what others would use."""

from __future__ import annotations

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.benchmark.__main__")

import shutil
import sys
from argparse import Namespace
from collections.abc import Iterator, Sequence
from pathlib import Path
from time import perf_counter

import proofs.benchmark
from proofs.benchmark import page
from proofs.benchmark.measure import Tell
from proofs.benchmark.page import Run, Section
from proofs.benchmark.peers import FLINT, IV, OURS
from proofs.shell.cli import Parser, heard, progress, share
from proofs.shell.entry import USAGE_ERROR, run_process
from proofs.shell.files import check_folder, check_targets, refusing, write_target
from proofs.shell.screen import say

SUBJECTS = ("all", "horseshoe", "limit", "precision", "ledger", "claims", "library", "intervals")
EXAMPLES = """
examples:
  python -m proofs benchmark
  python -m proofs benchmark --full --out reports
  python -m proofs benchmark intervals --codac-python ~/codac/bin/python
  python -m proofs benchmark claims --smallest
  python -m proofs benchmark precision --out diagrams --json precision.json

all: horseshoe, library, ledger and precision.
horseshoe: the main job beside bare imports and a script in python-flint; its bounds of f', and its
kernel beside python-flint. limit: the first of these alone.
precision: time against error: bounds of f' by natural, mean-value and Taylor forms and by
monotonicity, flight times beside algorithm A.1 and an ODE solver, dimensions, periodic points,
checks. Peers do the same work; fitted orders; diagrams with --out.
ledger: all claims, made anew and with nothing changed; 30 digits of two dimensions.
claims: the command of each group of claims, a whole process with its check, the check alone, and
time against digits (dimension) and period (orbits).
library: a few operations of Interval and of short IntervalArrays beside python-flint and mpmath.iv.
intervals: each operation of IntervalArray and Interval beside python-flint, mpmath.iv and codac, by
pyperf, which prints them: python -m proofs.benchmark.operations, in binary64 and at 333 bits. It
writes no report; --codac-python is then the interpreter of all.

With --out the report is written as benchmark.md, benchmark.json and, where matplotlib is installed,
benchmark-*.svg. A busy machine slows everything alike: trust the ratios.

exit status: 0 every target was reached, 1 one was missed or could not be measured, 2 bad usage
"""


def measure(options: Namespace, tell: Tell) -> Iterator[Section]:
    """Measure the subject."""
    from proofs.benchmark import horseshoe, library, precision

    subject, mode = options.subject, options.mode
    if subject in ("all", "horseshoe", "limit"):
        yield horseshoe.limits(mode, tell)
    if subject in ("all", "library"):
        yield library.measure(mode, tell)
    if subject in ("all", "ledger"):
        yield horseshoe.ledger(mode, tell)
    if subject == "horseshoe":
        yield from precision.of_main_job(mode, tell)
    if subject in ("all", "precision"):
        yield from precision.measure(mode, options.codac_python, options.reports, tell)
    if subject == "claims":
        yield horseshoe.claims(mode, tell)


def _parser() -> Parser:
    parser = Parser("proofs benchmark", proofs.benchmark.__doc__, EXAMPLES)
    add = parser.add_argument
    parser.usage = "%(prog)s [SUBJECT] [OPTION ...]"
    what = f"one of {', '.join(SUBJECTS)} (default: all)"
    add("subject", nargs="?", choices=SUBJECTS, default="all", metavar="SUBJECT", help=what)
    modes = parser.add_mutually_exclusive_group()
    for mode, text in {"quick": "default", "full": "more runs", "smallest": "each once"}.items():
        modes.add_argument(f"--{mode}", dest="mode", action="store_const", const=mode, help=text)
    parser.set_defaults(mode="quick")
    share(parser, "--out", "--json", "--quiet")
    where = "where the certificates are whose check is measured (default: reports)"
    add("--reports", metavar="DIR", type=Path, default=Path("reports"), help=where)
    python = "the interpreter that has codac (default: this one)"
    add("--codac-python", metavar="PATH", default=sys.executable, help=python)
    return parser


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the benchmark; return the exit status."""
    parser = _parser()
    options = parser.parse_args(arguments)
    check_targets(parser, options.json)
    if shutil.which(options.codac_python) is None:
        say(f"{parser.prog}: no such interpreter: {options.codac_python}", sys.stderr)
        return USAGE_ERROR
    if options.subject == "intervals":
        return _intervals(options.mode, options.codac_python)
    if options.out is not None:
        check_folder(parser, options.out)
    began = perf_counter()
    try:
        with progress() as tell:
            sections = list(measure(options, tell))
    except (ChildProcessError, ModuleNotFoundError) as failure:
        say(f"{parser.prog}: {failure}", sys.stderr)
        return 1
    run = Run(options.subject, options.mode, sections, perf_counter() - began)
    if heard(options):
        say(page.text(run))
    write_target(parser, options.json, lambda: page.machine_form(run))
    if options.out is not None:
        with refusing(parser, options.out):
            if not page.write(options.out, run):
                say("no pictures: matplotlib is not installed", sys.stderr)
    return int(any(not row.reached for row in run.asked))


def _intervals(mode: str, python: str) -> int:
    """Run pyperf on all operations; return its exit status."""
    effort = {"smallest": ["--debug-single-value"], "full": ["--processes=10"]}
    few = ["--processes=2", "--min-time=0.01"]
    wide = [python, "-m", "proofs.benchmark.operations", "--quiet", *effort.get(mode, few)]
    long = [*wide, "--bits=333", "--length=100", "--libraries", OURS, FLINT, IV]
    return int(any(run_process(command).returncode for command in (wide, long)))
