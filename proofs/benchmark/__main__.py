"""Speed and accuracy, measured here and now beside what others would use."""

from __future__ import annotations

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.benchmark.__main__")

import sys
from argparse import Namespace
from collections.abc import Iterator, Sequence
from time import perf_counter

import proofs.benchmark
from proofs.benchmark import page
from proofs.benchmark.measure import Tell
from proofs.benchmark.page import Run, Section
from proofs.shell.cli import Parser, heard, progress, share
from proofs.shell.files import check_folder, check_targets, refusing, write_target
from proofs.shell.screen import say

SUBJECTS = ("all", "horseshoe", "limit", "precision", "operations", "arrays", "ledger")
EXAMPLES = """
examples:
  python -m proofs benchmark
  python -m proofs benchmark --full --out reports/benchmark
  python -m proofs benchmark precision --out diagrams --json precision.json

all: horseshoe, operations, arrays, ledger and precision.
horseshoe: the main job beside bare imports and a script in python-flint; its bounds of f' beside
python-flint. limit: the first of these alone.
precision: time against error: bounds of f' by natural, mean-value and Taylor forms and by
monotonicity, flight times beside algorithm A.1 and an ODE solver. Peers do the same work; fitted
orders; diagrams with --out.
operations: single ones of Interval and of short IntervalArrays beside python-flint and mpmath.iv.
arrays: operations of 200,000 intervals by IntervalArray and TightArray, and widths.
ledger: all claims, made anew and with nothing changed; 30 digits of two dimensions.

With --out the report is written as benchmark.md, benchmark.json and, where matplotlib is installed,
benchmark-*.svg. A busy machine slows everything alike: trust the ratios.

exit status: 0 every target was reached, 1 one was missed or could not be measured, 2 bad usage
"""


def measure(options: Namespace, tell: Tell) -> Iterator[Section]:
    """Measure the subject."""
    from proofs.benchmark import horseshoe, operations, precision

    subject, mode = options.subject, options.mode
    if subject in ("all", "horseshoe", "limit"):
        yield horseshoe.limits(mode, tell)
    if subject in ("all", "operations"):
        yield operations.measure(mode, tell)
    if subject in ("all", "arrays"):
        yield operations.measure_arrays(mode, tell)
    if subject in ("all", "ledger"):
        yield horseshoe.ledger(mode, tell)
    if subject == "horseshoe":
        yield precision.of_main_job(mode, tell)
    if subject in ("all", "precision"):
        yield from precision.measure(mode, tell)


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
    return parser


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the benchmark; return the exit status."""
    parser = _parser()
    options = parser.parse_args(arguments)
    check_targets(parser, options.json)
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
