"""The command line: what to measure, how often, and where the samples go."""

from __future__ import annotations

import argparse
import shutil
import sys
from collections.abc import Sequence
from pathlib import Path
from time import perf_counter

import proofs.benchmark
from proofs.benchmark.measuring import EFFORTS, Row, machine_form, table
from proofs.cli import USAGE_ERROR, Parser, progress

EXAMPLES = """
examples:
  python -m proofs.benchmark
  python -m proofs.benchmark intervals --codac-python ~/codac/bin/python
  python -m proofs.benchmark claims --smallest
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

exit status: 0 every target was reached, 1 one was missed or could not be measured, 2 bad usage
"""


def measure(options: argparse.Namespace) -> list[Row]:
    """Measure the subject."""
    effort = EFFORTS[options.mode]
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


def _parser() -> Parser:
    parser = Parser("proofs.benchmark", proofs.benchmark.__doc__, EXAMPLES)
    parser.add_argument(
        "subject",
        nargs="?",
        choices=("horseshoe", "claims", "intervals"),
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
