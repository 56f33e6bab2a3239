"""The command line: what to measure, how often, and where tables, page and samples go."""

from __future__ import annotations

import shutil
import sys
from argparse import Namespace
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from time import perf_counter

import proofs.benchmark
from proofs.benchmark import page
from proofs.benchmark.measuring import EFFORTS, Effort
from proofs.benchmark.page import Run, Section
from proofs.shell.cli import USAGE_ERROR, Parser, check_targets, progress, writable, write_target

EXAMPLES = """
examples:
  python -m proofs.benchmark
  python -m proofs.benchmark --full --out reports
  python -m proofs.benchmark intervals --codac-python ~/codac/bin/python
  python -m proofs.benchmark claims --smallest
  python -m proofs.benchmark precision --out diagrams --json precision.json
  python -m proofs.benchmark --quick --json - > benchmark.json

With --out the report is written as benchmark.md, benchmark.json and, where matplotlib is installed,
benchmark-*.svg. A busy machine slows everything alike: trust the ratios.

all: horseshoe, limit and precision.

horseshoe: the main job, its accuracy and its kernel. One evaluation of the gap: an enclosure of the
gap at one time of the grid, or of gap'' on one piece between two, over one box of phases. Times
include sine and cosine and the comparisons.

intervals: each operation of IntervalArray and Interval, on wide intervals or on points, beside
python-flint, mpmath.iv and codac in list comprehensions, and temporary memory. Ratios are times as
long as ours. Tables of constants are filled before, but for the first calls, in new processes.
mpmath.iv works on 100 elements at most, codac in a process of its own. At 1,000,000 elements only
--full measures every function.

claims: the command of each group of claims, a whole process with its check, the check alone, and
time against digits (dimension) and period (orbits).

precision: time against error: bounds of f' by natural, mean-value and Taylor forms and by
monotonicity, flight times beside algorithm A.1 and an ODE solver, s_0, images of edges, dimensions,
periodic points, checks. Peers do the same work; fitted orders; diagrams with --out.

limit: the whole process of the main job, stage by stage: interpreter, imports, search, proof,
certificate, report, check.

exit status: 0 every target was reached, 1 one was missed or could not be measured, 2 bad usage
"""

Tell = Callable[[str], None]


def measure(options: Namespace) -> list[Section]:
    """Measure the subject."""
    chosen = _ALL if options.subject == "all" else (options.subject,)
    effort = EFFORTS[options.mode]
    with progress() as tell:
        return [one for name in chosen for one in SUBJECTS[name](options, effort, tell)]


def _horseshoe(_: Namespace, effort: Effort, tell: Tell) -> Iterator[Section]:
    from proofs.benchmark import horseshoe

    tell("the main job")
    about = (
        "Whole processes of `python -m proofs.horseshoe` beside bare imports, the loss of its "
        "slope bounds, and the rate of its kernel. python-flint (balls of any precision, in C) "
        "computes the true extremes to 600 bits and does the kernel's work beside."
    )
    yield Section("The main job", about, horseshoe.measure(effort))


def _limit(_: Namespace, effort: Effort, tell: Tell) -> Iterator[Section]:
    from proofs.benchmark import limit

    tell("where the time of the main job goes")
    about = (
        "The whole process of the main job, stage by stage, from the start of the interpreter to "
        "its end. The plastic claims are those that the target is about, and a plain script with "
        "python-flint decides them beside; the default job proves the rectangles of section 4 too."
    )
    yield Section("Where the time of the main job goes", about, limit.measure(effort))


def _precision(options: Namespace, _: Effort, tell: Tell) -> Iterator[Section]:
    from proofs.benchmark import precision

    return precision.measure(options.mode, options.codac_python, options.reports, tell)


def _claims(_: Namespace, effort: Effort, tell: Tell) -> Iterator[Section]:
    from proofs.benchmark import groups

    about = (
        "The command of each group of claims, a whole process with its check, and the check alone. "
        "Then time against digits of the dimensions and against the period of the orbits."
    )
    yield Section("The groups of claims", about, groups.measure(effort, tell))


def _intervals(options: Namespace, effort: Effort, tell: Tell) -> Iterator[Section]:
    from proofs.benchmark import arrays, first_calls, memory, scalars

    about = (
        "Each operation of IntervalArray and Interval beside python-flint (balls, in C), mpmath.iv "
        "(in Python, not proved sound) and codac (binary64, in C++). Ratios are times as long as "
        "ours; after the operations, temporary memory and first calls."
    )
    rows = [
        *arrays.measure(effort, options.codac_python, tell),
        *memory.measure(),
        *scalars.measure(effort, tell),
        *first_calls.measure(effort, tell),
    ]
    yield Section("The interval arithmetic", about, rows)


_ALL = ("horseshoe", "limit", "precision")
SUBJECTS: dict[str, Callable[[Namespace, Effort, Tell], Iterator[Section]]] = {
    "horseshoe": _horseshoe,
    "limit": _limit,
    "precision": _precision,
    "claims": _claims,
    "intervals": _intervals,
}


def _parser() -> Parser:
    parser = Parser("proofs.benchmark", proofs.benchmark.__doc__, EXAMPLES)
    parser.add_argument(
        "subject",
        nargs="?",
        choices=("all", *SUBJECTS),
        default="all",
        help="what is measured (default: all)",
    )
    modes = parser.add_mutually_exclusive_group()
    modes.add_argument("--quick", dest="mode", action="store_const", const="quick", help="default")
    modes.add_argument("--full", dest="mode", action="store_const", const="full", help="more runs")
    modes.add_argument(
        "--smallest", dest="mode", action="store_const", const="smallest", help="each once"
    )
    parser.add_argument("--json", metavar="FILE", help="write all samples; - for standard output")
    parser.add_argument(
        "--out", metavar="DIR", type=Path, help="write the report there (default: print only)"
    )
    parser.add_argument(
        "--reports",
        metavar="DIR",
        type=Path,
        default=Path("reports"),
        help="where the certificates are whose check is measured (default: reports)",
    )
    parser.add_argument(
        "--codac-python",
        metavar="PATH",
        default=sys.executable,
        help="the interpreter that has codac (default: this one)",
    )
    parser.set_defaults(mode="quick")
    return parser


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the benchmark; return the exit status."""
    parser = _parser()
    options = parser.parse_args(arguments)
    check_targets(parser, options.json)
    if shutil.which(options.codac_python) is None:
        print(f"{parser.prog}: no such interpreter: {options.codac_python}", file=sys.stderr)
        return USAGE_ERROR
    if options.out is not None:
        writable(parser, options.out)
    began = perf_counter()
    sections = measure(options)
    run = Run(options.subject, options.mode, sections, perf_counter() - began)
    if options.json != "-":
        print(page.text(run))
    write_target(parser, options.json, lambda: page.machine_form(run))
    try:
        if options.out is not None and not page.write(options.out, run):
            print("no pictures: matplotlib is not installed", file=sys.stderr)
    except OSError as error:
        parser.error(f"cannot write to {options.out}: {error.strerror or error}")
    return 0 if run.reached else 1


if __name__ == "__main__":
    sys.exit(main())
