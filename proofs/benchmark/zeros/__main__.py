"""Find all zeros of systems that others publish as tests of solvers; count them beside theirs."""

from __future__ import annotations

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.benchmark.zeros.__main__")

import json
from collections import Counter
from collections.abc import Sequence
from itertools import groupby
from time import process_time
from typing import NamedTuple

from intervals.newton import Roots
from intervals.zero_finder import zeros
from proofs.benchmark.page import environment
from proofs.benchmark.zeros.systems import System, systems
from proofs.report.markup import markdown_table
from proofs.shell.cli import Parser, heard, progress, share, whole
from proofs.shell.files import check_folder, check_targets, refusing, write_target, writing
from proofs.shell.screen import say

SCHEMA = "impact-proofs.zeros/1"
_SMALLEST = 2.0**-52  # sub-boxes, in proportion to the given box
_ABOUT = """\
Each zero counted is proved to exist and to be the only one in its box; where the system is decided,
no other zero is in the given box. "known" is the number that is commonly given for the system, or
one that follows from its definition; those of IBEX, MGH, PHC and Floudas were not read again at
their sources. "not decided" are boxes that may hold zeros: double ones, or what was left after a
number of sub-boxes (100 to 100,000, see `systems.py`; `--boxes`).

Henon's cycles are counted once each, from their least point, and both fixed points with them: so
366 are 364 cycles of prime period 19 and 2. The page of COPRIN has 16 and 32 zeros of Brent's
system in 5 and 6 variables; that many are proved here for 4 and 5. Seconds are of the processor, of
one thread. What each system is: `proofs/benchmark/zeros/`.

MGH: More, Garbow, Hillstrom 1981. IBEX: its benchmarks, and those of COPRIN (ALIAS). PHC:
Verschelde's collection. Floudas: Handbook of test problems, 1999. Galias: 2001."""
EXAMPLES = """
examples:
  python -m proofs.benchmark.zeros --only "Bratu 10" Kin1 Bellido
  python -m proofs.benchmark.zeros --out reports/benchmark
  python -m proofs.benchmark.zeros --boxes 200000 --only I5 --json i5.json

With --out the table is written as zeros.md and zeros.json.

exit status: 0 all are decided, 1 some are not, 2 bad usage, 3 a count is not the known one
"""


class Solved(NamedTuple):
    """A system, how many zeros are proved, how many boxes are left, the processor's seconds."""

    system: System
    proved: int
    left: int
    seconds: float

    @property
    def contradicts(self) -> bool:
        """Whether the number that is known cannot be true, or ours."""
        known = self.system.known
        return known is not None and (
            self.proved > known or (self.proved < known and not self.left)
        )

    @property
    def cells(self) -> tuple[str, ...]:
        """The line of the table."""
        known, box = self.system.known, _box(self.system)
        remark = f"{self.left} not decided" if self.left else "CONTRADICTION" * self.contradicts
        count = "-" if known is None else str(known)
        line = (self.system.name, self.system.source, str(len(self.system.box)), box)
        return (*line, count, str(self.proved), f"{self.seconds:.2f}", remark)


def solved(system: System, boxes: int | None = None) -> Solved:
    """Find the zeros of a system, examining about so many sub-boxes, its own number if None."""
    began = process_time()
    found = zeros(
        system.f, system.box, where=system.where, tolerance=_SMALLEST, limit=boxes or system.boxes
    )
    outcomes = Counter(result.outcome for result in found)
    unique = outcomes.pop(Roots.UNIQUE, 0)
    return Solved(system, unique, outcomes.total(), process_time() - began)


def _box(system: System) -> str:
    """Return the box, equal sides in one."""
    parts = []
    for (low, high), equal in groupby((float(x.inf), float(x.sup)) for x in system.box):
        count = len(list(equal))
        parts.append(f"[{low:.5g}, {high:.5g}]" + f"^{count}" * (count > 1))
    return " x ".join(parts)


def table(rows: Sequence[Solved]) -> str:
    """Return the table."""
    header = "system", "source", "n", "box", "known", "proved", "seconds", ""
    return "\n".join(markdown_table([header, *(row.cells for row in rows)], 4))


def summary(rows: Sequence[Solved]) -> str:
    """Return the line under the table."""
    decided = [row for row in rows if not row.left]
    quick = sum(row.seconds <= 10 for row in decided)
    against = sum(row.contradicts for row in rows)
    return (
        f"{len(rows)} systems: {len(decided)} decided, {quick} of them in 10 s each; "
        f"{sum(row.proved for row in rows)} zeros proved; {against} known counts contradicted"
    )


def _machine_form(rows: Sequence[Solved], boxes: int | None) -> str:
    lines = [
        {"name": row.system.name, "source": row.system.source, "n": len(row.system.box)}
        | {"known": row.system.known, "proved": row.proved, "left": row.left}
        | {"seconds": round(row.seconds, 3)}
        for row in rows
    ]
    form = {"schema": SCHEMA, "boxes": boxes, **environment(), "systems": lines}
    return json.dumps(form, indent=1) + "\n"


def _page(rows: Sequence[Solved]) -> str:
    machine = ", ".join(f"{name} {one}" for name, one in environment().items())
    about = f"{summary(rows)}.\n\n{_ABOUT}\n\nMeasured on: {machine}."
    return f"# The zeros of others\n\n{about}\n\n{table(rows)}\n"


def _parser(names: Sequence[str]) -> Parser:
    parser = Parser("proofs.benchmark.zeros", __doc__, EXAMPLES)
    add = parser.add_argument
    add("--only", nargs="+", metavar="NAME", choices=names, help="only these (default: all)")
    many = "sub-boxes after which a system is left undecided (default: its own number)"
    add("--boxes", type=whole("boxes", 10**9), metavar="N", help=many)
    share(parser, "--out", "--json", "--quiet")
    return parser


def main(arguments: Sequence[str] | None = None) -> int:
    """Solve the systems; return the exit status."""
    every = list(systems())
    parser = _parser([one.name for one in every])
    options = parser.parse_args(arguments)
    check_targets(parser, options.json)
    if options.out is not None:
        check_folder(parser, options.out)
    rows = []
    with progress() as tell:
        for one in every:
            if options.only is None or one.name in options.only:
                tell(one.name)
                rows.append(solved(one, options.boxes))
    if heard(options):
        say(f"{table(rows)}\n\n{summary(rows)}")
    write_target(parser, options.json, lambda: _machine_form(rows, options.boxes))
    if options.out is not None:
        with refusing(parser, options.out), writing(options.out) as put:
            put("zeros.md", _page(rows))
            put("zeros.json", _machine_form(rows, options.boxes))
    if any(row.contradicts for row in rows):
        return 3
    return int(any(row.left for row in rows))
