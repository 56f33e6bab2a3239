"""Try to break the arithmetic and the map where they are weakest, judged by another kernel."""

from __future__ import annotations

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.stress.__main__")

import sys
from collections.abc import Callable, Sequence
from time import perf_counter

import proofs.stress
from proofs.benchmark.peers import FLINT, Arithmetic, arithmetic, installed
from proofs.shell.cli import Parser, heard, progress, share, whole
from proofs.shell.files import check_folder, check_targets, refusing, write_target, writing
from proofs.shell.screen import say
from proofs.stress.families import FAMILIES, Family, cases
from proofs.stress.judge import Judgement, Run, judge, machine_form, markdown, text
from proofs.stress.truth import BITS

_CASES = 600

EXAMPLES = """
examples:
  python -m proofs stress
  python -m proofs stress --family grazing tangent --cases 500 --seed 7
  python -m proofs stress --cases 10000 --out reports
  python -m proofs stress --family functions --json - > functions.json

The same seed draws the same cases. With --out the report is written as stress.md and stress.json.
What is true is computed by python-flint (pip install 'impact-proofs[benchmark]').

families:
"""

EXIT = """
exit status: 0 no case excludes the truth, 1 one does, or the library crashed, 2 bad usage
"""


def stress(
    families: Sequence[Family], count: int, seed: int, by: Arithmetic, tell: Callable[[str], None]
) -> Run:
    """Try about `count` cases of some families."""
    began = perf_counter()
    judgements: list[Judgement] = []
    for case in cases(families, count, seed, by):
        tell(f"{len(judgements)} cases, {case.family}")
        judgements.append(judge(case, by))
    return Run(judgements, seed, by.name, perf_counter() - began)


def _parser() -> Parser:
    listed = "".join(f"  {family.name:14} {family.about}\n" for family in FAMILIES)
    parser = Parser("proofs stress", proofs.stress.__doc__, EXAMPLES + listed + EXIT)
    add = parser.add_argument
    names = [family.name for family in FAMILIES]
    add("--family", nargs="+", metavar="NAME", choices=names, help="only these (default: all)")
    many = f"how many, about (default {_CASES})"
    add("--cases", type=whole("cases", 10**7), default=_CASES, metavar="N", help=many)
    draw = whole("a seed", 10**18, 0)
    add("--seed", type=draw, default=1, metavar="N", help="of the draw (default 1)")
    share(parser, "--out", "--json", "--quiet")
    return parser


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the stress test; return the exit status."""
    parser = _parser()
    options = parser.parse_args(arguments)
    check_targets(parser, options.json)
    if options.out is not None:
        check_folder(parser, options.out)
    if not installed("flint"):
        say(f"{parser.prog}: no python-flint: pip install 'impact-proofs[benchmark]'", sys.stderr)
        return 1
    by = arithmetic(FLINT, BITS)
    chosen = [f for f in FAMILIES if options.family is None or f.name in options.family]
    with progress() as tell:
        run = stress(chosen, options.cases, options.seed, by, tell)
    write_target(parser, options.json, lambda: machine_form(run))
    if heard(options):
        say(text(run))
    if options.out is not None:
        with refusing(parser, options.out), writing(options.out) as put:
            put("stress.md", markdown(run, {each.name: each.about for each in FAMILIES}))
            put("stress.json", machine_form(run))
    return int(bool(run.failures))
