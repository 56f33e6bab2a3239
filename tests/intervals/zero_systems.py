"""Systems that others publish as tests of solvers: their zeros, beside the number that is known.

The systems are `zero_systems.txt`; the page is made by

    python -m tests.intervals.zero_systems > reports/benchmark/zeros.md
"""

import re
from collections import Counter
from fractions import Fraction
from pathlib import Path
from time import process_time
from typing import Any, NamedTuple

from intervals import Interval, zeros
from intervals.systems import Roots

FILE = Path(__file__).with_suffix(".txt")
SMALLEST = 2.0**-52  # sub-boxes, in proportion to the given box
FUNCTIONS = ["sqr", "exp", "sin", "cos", "tan", "log", "sinh", "cosh", "atan", "acos", "asin"]


def applied(name):
    """A function by its name, of an exact number too."""
    return lambda x: getattr(Interval(x) if isinstance(x, Fraction) else x, name)()


NAMES = {name: applied(name) for name in FUNCTIONS}
NAMES |= {"q": Fraction, "pi": Interval.pi(), "e": Interval.e()}
ABOUT = """\
Each zero counted is proved to exist and to be the only one in its box; where the system is decided,
no other zero is in the given box. "known" is the number that is commonly given for the system, or
one that follows from its definition; those of IBEX, MGH, PHC and Floudas were not read again at
their sources. "not decided" are boxes that may hold zeros: double ones, or what was left after a
number of sub-boxes. What each system is, and its source: `tests/intervals/zero_systems.txt`.

Henon's cycles are counted once each, from their least point, and both fixed points with them: so
366 are 364 cycles of prime period 19 and 2. The page of COPRIN has 16 and 32 zeros of Brent's
system in 5 and 6 variables; that many are proved here for 4 and 5. Seconds are of the processor, of
one thread."""


class System(NamedTuple):
    """f = 0 in a box; the number of zeros, if it is known; those that count have where >= 0."""

    name: str
    source: str
    known: int | None
    boxes: int
    sides: str
    box: list[Interval]
    f: Any
    where: Any


class Solved(NamedTuple):
    """How many zeros are proved, how many boxes are left, the processor's seconds."""

    system: System
    proved: int
    left: int
    seconds: float

    @property
    def contradicts(self):
        """Whether the number that is known cannot be true, or ours."""
        known = self.system.known
        too_few = not self.left and known is not None and self.proved < known
        return too_few or (known is not None and self.proved > known)

    @property
    def cells(self):
        name, source, known, _, sides, box, *_ = self.system
        remark = f"{self.left} not decided" if self.left else "CONTRADICTION" * self.contradicts
        counts = "-" if known is None else str(known), str(self.proved)
        return name, source, str(len(box)), sides, *counts, f"{self.seconds:.2f}", remark


def function(lines, relation):
    """What gives the right sides of the lines with this relation, after the definitions."""
    left = [line.partition(" = ") for line in lines if line.startswith("t")]
    wanted = [line.partition(relation)[2] for line in lines if line.startswith(relation)]
    steps = [(name, code(text)) for name, _, text in left]
    values = [code(text) for text in wanted]

    def f(*x):
        known = NAMES | {f"x{i}": each for i, each in enumerate(x, 1)}
        for name, step in steps:
            known[name] = eval(step, known)
        return [eval(value, known) for value in values]

    return f if wanted else None


def code(text):
    """A formula with exact numbers; exponents stay integers."""
    exact = re.sub(r"(?<!\*\*)(?<![\w.])\d+(?:\.\d+)?(?:e[+-]?\d+)?", r'q("\g<0>")', text)
    return compile(exact, text, "eval")


def side(low, high):
    """An interval with binary64 ends, which the decimals are."""
    return Interval(*(Fraction(float(end)) for end in (low, high)))


def systems():
    """All of them, by name."""
    found = {}
    for block in FILE.read_text(encoding="utf-8").split("\n\n"):
        lines = [line for line in block.splitlines() if not line.startswith("#")]
        if lines:
            name, source, known, boxes = lines[0].split(" | ")
            parts = re.findall(r"\[(\S+), (\S+)\](?:\^(\d+))?", lines[1])
            box = [side(*ends) for *ends, count in parts for _ in range(int(count or 1))]
            count = None if known == "?" else int(known)
            f, where = function(lines[2:], "0 = "), function(lines[2:], "0 <= ")
            found[name] = System(name, source, count, int(boxes), lines[1], box, f, where)
    return found


def solved(system, boxes=None):
    """Find the zeros of a system, examining about so many sub-boxes, its own number if None."""
    began = process_time()
    found = zeros(
        system.f,
        system.box,
        where=system.where,
        tolerance=SMALLEST,
        limit=boxes or system.boxes,
    )
    outcomes = Counter(result.outcome for result in found)
    unique = outcomes.pop(Roots.UNIQUE, 0)
    return Solved(system, unique, outcomes.total(), process_time() - began)


def page(rows):
    """The page, with what it was measured on."""
    from proofs.benchmark.page import environment
    from proofs.report.page import markdown_table

    machine = ", ".join(f"{name} {value}" for name, value in environment().items())
    decided = [row for row in rows if not row.left]
    summary = (
        f"{len(rows)} systems: {len(decided)} decided, {sum(x.seconds <= 10 for x in decided)} of "
        f"them in 10 s each; {sum(row.proved for row in rows)} zeros proved; "
        f"{sum(row.contradicts for row in rows)} known counts contradicted."
    )
    header = "system", "source", "n", "box", "known", "proved", "seconds", ""
    table = "\n".join(markdown_table([header, *(row.cells for row in rows)], 4))
    return f"# The zeros of others\n\n{summary}\n\n{ABOUT}\n\nMeasured on: {machine}.\n\n{table}"


if __name__ == "__main__":
    print(page([solved(system) for system in systems().values()]))
