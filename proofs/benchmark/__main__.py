"""The command line: what to measure, how often, and where the samples go."""

from __future__ import annotations

import argparse
import shutil
import sys
from collections.abc import Sequence
from importlib.util import find_spec
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING

import proofs.benchmark
from proofs.benchmark.measuring import EFFORTS, Row, machine_form, table
from proofs.certificate import write_atomically
from proofs.cli import USAGE_ERROR, Parser, progress
from proofs.runner import writable

if TYPE_CHECKING:
    from proofs.benchmark.diagrams import Diagram

EXAMPLES = """
examples:
  python -m proofs.benchmark
  python -m proofs.benchmark intervals --codac-python ~/codac/bin/python
  python -m proofs.benchmark claims --smallest
  python -m proofs.benchmark precision --figures diagrams --json precision.json
  python -m proofs.benchmark limit
  python -m proofs.benchmark --full --json benchmark.json
  python -m proofs.benchmark --quick --json - > benchmark.json

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
periodic points, checks. Peers do the same work; fitted orders; diagrams with --figures.

limit: the whole process of the main job, stage by stage: interpreter, imports, search, proof,
certificate, report, check.

exit status: 0 every target was reached, 1 one was missed or could not be measured, 2 bad usage
"""


def measure(options: argparse.Namespace) -> list[Row]:
    """Measure the subject; draw its diagrams, if there are any and they are wanted."""
    effort = EFFORTS[options.mode]
    if options.subject == "precision":
        from proofs.benchmark import precision

        with progress() as tell:
            python = options.codac_python
            rows, diagrams = precision.measure(options.mode, python, options.reports, tell)
        if options.figures is not None:
            draw(diagrams, options.figures)
        return rows
    if options.subject == "limit":
        from proofs.benchmark import limit

        return limit.measure(effort)
    if options.subject == "horseshoe":
        from proofs.benchmark import horseshoe

        return horseshoe.measure(effort)
    if options.subject == "claims":
        from proofs.benchmark import groups

        with progress() as tell:
            return groups.measure(effort, tell)
    from proofs.benchmark import arrays, first_calls, memory, scalars

    with progress() as tell:
        return [
            *arrays.measure(effort, options.codac_python, tell),
            *memory.measure(),
            *scalars.measure(effort, tell),
            *first_calls.measure(effort, tell),
        ]


def draw(diagrams: Sequence[Diagram], folder: Path) -> None:
    """Write the diagrams that have something to show."""
    from proofs.benchmark.diagrams import svg

    for diagram in diagrams:
        write_atomically(folder / f"{diagram.name}.svg", svg(diagram))


def _parser() -> Parser:
    parser = Parser("proofs.benchmark", proofs.benchmark.__doc__, EXAMPLES)
    parser.add_argument(
        "subject",
        nargs="?",
        choices=("horseshoe", "claims", "intervals", "precision", "limit"),
        default="horseshoe",
        help="what is measured (default: horseshoe)",
    )
    modes = parser.add_mutually_exclusive_group()
    modes.add_argument("--quick", dest="mode", action="store_const", const="quick", help="default")
    modes.add_argument("--full", dest="mode", action="store_const", const="full", help="more runs")
    modes.add_argument(
        "--smallest", dest="mode", action="store_const", const="smallest", help="each once"
    )
    parser.add_argument("--json", metavar="FILE", help="write all samples; - for standard output")
    parser.add_argument(
        "--figures", metavar="DIR", type=Path, help="draw SVG diagrams (precision, with matplotlib)"
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
    target = None if options.json in (None, "-") else Path(options.json)
    if target is not None and not target.parent.is_dir():
        print(f"{parser.prog}: no such directory: {target.parent}", file=sys.stderr)
        return USAGE_ERROR
    if shutil.which(options.codac_python) is None:
        print(f"{parser.prog}: no such interpreter: {options.codac_python}", file=sys.stderr)
        return USAGE_ERROR
    if options.figures is not None:
        if options.subject != "precision" or find_spec("matplotlib") is None:
            parser.error("--figures takes the subject precision, and matplotlib")
        writable(parser, options.figures)
    began = perf_counter()
    rows = measure(options)
    text = machine_form(rows, options.subject, options.mode)
    if options.json == "-":
        print(text)
    else:
        print(table(rows))
        print(f"\nmedian (least .. largest); {perf_counter() - began:.0f} s in all")
    if target is not None:
        temporary = target.with_name(target.name + ".part")
        temporary.write_text(text, encoding="utf-8")
        temporary.replace(target)
    return 0 if all(row.reached for row in rows if row.target) else 1


if __name__ == "__main__":
    sys.exit(main())
