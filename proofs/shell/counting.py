"""What a run evaluates, counted by watching it: the code that proves and checks is unchanged.

`with counted() as counts` asks the interpreter to announce every function that returns
(`sys.setprofile`), and counts those named in `_RULES`, wherever they are bound and whenever they
are imported. The work takes some three times as long meanwhile, and not a moment longer where
nothing is counted. Only the present thread is watched.

What is counted: evaluations of the equations, an array's or a jet's once for each of its boxes, by
the numbers they are made on: floats (candidates), intervals and arrays (proofs), the checker's.
f' evaluates gap' and gap'', which are counted as well; a jet's evaluation counts as one of a
derivative. Other formulas: those given as text, position and velocity of the mass (15), those of
orbits with one impact (16) to (18); one for each component. A first impact is that of a set of
launches, a box of an array too, at the precision that proved it. A number is a result of interval
arithmetic, of one operation and one box.
"""

from __future__ import annotations

import sys
from bisect import bisect_left
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from types import CodeType, FrameType
from typing import Any, NamedTuple

GAP, RATES, SLOPE, SECOND, MATRIX = "gap", "gap', gap'', along jets", "f'", "f''", "DF"
GRID = "gap and gap'', phases x times"
FORMULAS = "other formulas"
PARTS, BISECTIONS, CELLS = "parts of covers", "bisections", "cells of partitions"
ALGEBRA = "questions to sympy"
MADE, CHECKED, WORK = "proof steps written", "proof steps checked", "work charged"
FLOATS, INTERVALS, ARRAYS, CHECKER = COLUMNS = ("floats", "intervals", "arrays", "checker")
_PRECISIONS = (64, 128, 256, 512, 1024)
IMPACTS, NUMBERS = (
    (*(f"{what}, to {bits} bits" for bits in _PRECISIONS), f"{what}, more bits")
    for what in ("first impacts", "numbers")
)
EQUATIONS = (GAP, RATES, SLOPE, SECOND, MATRIX, GRID)
ROWS = (
    *(*EQUATIONS, FORMULAS, *IMPACTS, PARTS, BISECTIONS, CELLS, *NUMBERS, ALGEBRA),
    *(MADE, CHECKED, WORK),
)
_JETS = ("Jet", "Dual", "Series")


class Kind(NamedTuple):
    """What is counted: a row of the table and a column, "" where the row has one number."""

    what: str
    by: str = ""


Counts = Counter[Kind]
_Rule = Callable[[Counts, FrameType, Any], None]


@contextmanager
def counted() -> Iterator[Counts]:
    """Count what is evaluated inside the `with`."""
    counts: Counts = Counter()
    before = sys.getprofile()
    sys.setprofile(_observer(counts))
    try:
        yield counts
    finally:
        sys.setprofile(before)


def table(counts: Counts, asked: Iterable[str]) -> str:
    """Return what was asked and what was evaluated for it; what is not there is 0."""
    width = max(map(len, ROWS)) + 1
    lines = [f"asked: {' '.join(asked)}"]
    lines += ["evaluated".ljust(width) + "".join(f"{column:>12}" for column in COLUMNS)]
    for what in ROWS:
        numbers = [counts[Kind(what, by)] for by in COLUMNS]
        single = counts[Kind(what)]
        if single or not any(numbers):
            numbers = [single] if single else []
        if numbers:
            lines.append(what.ljust(width) + "".join(f"{n:12,}".replace(",", " ") for n in numbers))
    return "\n".join(lines if +counts else [*lines, "nothing"])


def show(counts: Counts, asked: Iterable[str], quiet: bool) -> None:
    """Print the table, on standard error where standard output is for machines."""
    print(f"\n{table(counts, asked)}", file=sys.stderr if quiet else sys.stdout)


def evaluations(counts: Counts, *columns: str) -> int:
    """Return how often the equations were evaluated, on numbers of some of the columns."""
    return sum(counts[Kind(what, by)] for what in EQUATIONS for by in columns or COLUMNS)


def _observer(counts: Counts) -> Callable[[FrameType, str, Any], None]:
    """Return what the interpreter is to call with every event."""
    known: dict[int, tuple[CodeType, _Rule | None]] = {}  # the code stays alive, so does its id

    def observe(frame: FrameType, event: str, value: Any) -> None:
        if event != "return":
            return
        code = frame.f_code
        found = known.get(id(code))
        if found is None:
            name = f"{frame.f_globals.get('__name__')}.{code.co_qualname}"
            found = known[id(code)] = code, _RULES.get(name)
        if found[1] is not None:
            found[1](counts, frame, value)

    return observe


# -- how a return counts, by its value: None where an exception is raised --------------------------


def _column(value: Any) -> str | None:
    """Return the column of a result, None for one that is not a number of these four kinds."""
    kind = type(value)
    if kind.__name__ == "Jet":
        return _column(value.value)
    if kind.__module__.startswith("proofs.trusted."):
        return CHECKER
    if kind.__module__.startswith("intervals."):
        return ARRAYS if kind.__name__ == "IntervalArray" else INTERVALS
    return FLOATS if kind is float or kind.__module__ == "numpy" else None


def _size(value: Any) -> int:
    """Return how many boxes or points a result is about."""
    if type(value).__name__ == "Jet":
        return _size(value.value)
    return int(getattr(value, "size", 1))


def _evaluation(plain: str, derived: str) -> _Rule:
    """Count a result as `plain`, a jet's and a time derivative's as `derived`."""

    def rule(counts: Counts, frame: FrameType, value: Any) -> None:
        column = _column(value)
        if column is not None:
            is_plain = type(value).__name__ not in _JETS and not frame.f_locals.get("order")
            counts[Kind(plain if is_plain else derived, column)] += _size(value)

    return rule


def _matrix(counts: Counts, frame: FrameType, value: Any) -> None:
    column = None if value is None else _column(value[0][0])
    if column is not None:
        counts[Kind(MATRIX, column)] += 1


def _formula(counts: Counts, frame: FrameType, value: Any) -> None:
    """Count each component of what a formula gives, a number where it has one."""
    for each in value if type(value) in (list, tuple) else (value,):
        column = _column(each)
        if column is not None:
            counts[Kind(FORMULAS, column)] += _size(each)


def _number(by: str, bits: str) -> _Rule:
    """Count a number by its precision, a local variable."""
    kinds = [Kind(what, by) for what in NUMBERS]

    def rule(counts: Counts, frame: FrameType, value: Any) -> None:
        counts[kinds[bisect_left(_PRECISIONS, frame.f_locals[bits])]] += 1

    return rule


def _numbers(counts: Counts, frame: FrameType, value: Any) -> None:
    counts[Kind(NUMBERS[0], ARRAYS)] += 0 if value is None else _size(value)


def _impact(counts: Counts, frame: FrameType, value: Any) -> None:
    """Count a set of launches whose impact is proved to be one, by the precision it took."""
    if value is not None and value.transversal:
        row = IMPACTS[bisect_left(_PRECISIONS, value.flight.precision)]
        counts[Kind(row, INTERVALS)] += 1


def _boxes(counts: Counts, frame: FrameType, value: Any) -> None:
    counts[Kind(IMPACTS[0], ARRAYS)] += 0 if value is None else len(value.boxes)


def _grid(counts: Counts, frame: FrameType, value: Any) -> None:
    counts[Kind(GRID, ARRAYS)] += 0 if value is None else _size(value)


def _one(what: str) -> _Rule:
    """Count the calls that return something."""

    def rule(counts: Counts, frame: FrameType, value: Any) -> None:
        counts[Kind(what)] += value is not None

    return rule


def _examined(counts: Counts, frame: FrameType, value: Any) -> None:
    """Count a box of a tree, None where it is a leaf: decided as it is."""
    counts[Kind(PARTS if value is None else BISECTIONS)] += 1


def _steps(name: str, each: int) -> _Rule:
    """Count bisections: `each` for every step of a loop whose length is a local variable."""

    def rule(counts: Counts, frame: FrameType, value: Any) -> None:
        counts[Kind(BISECTIONS)] += 0 if value is None else each * frame.f_locals[name]

    return rule


def _pieces(counts: Counts, frame: FrameType, value: Any) -> None:
    """Count the pieces of a range, and the bisections that made them of those given."""
    if value is not None:
        found, given = len(value.pieces), len(frame.f_locals["points"]) - 1
        counts[Kind(PARTS)] += found
        counts[Kind(BISECTIONS)] += found - given


def _split(counts: Counts, frame: FrameType, value: Any) -> None:
    counts[Kind(BISECTIONS)] += 0 if value is None else int(value[1].sum())


def _cells(counts: Counts, frame: FrameType, value: Any) -> None:
    counts[Kind(CELLS)] += 0 if value is None else len(value)


def _made(counts: Counts, frame: FrameType, value: Any) -> None:
    """Count the steps of a certificate that is written; the ledger has none."""
    counts[Kind(MADE)] += len(frame.f_locals["document"].get("steps", ()))


def _checked(counts: Counts, frame: FrameType, value: Any) -> None:
    """Count the work charged to a file, also to one that is rejected, when its meter ends."""
    if value is None and "meter" in frame.f_locals:
        counts[Kind(WORK)] += round(frame.f_locals["meter"].spent)


_RULES = {
    "proofs.trusted.equations.gap": _evaluation(GAP, RATES),
    "proofs.trusted.equations.slope": _evaluation(SLOPE, SECOND),
    "proofs.trusted.equations.return_map_derivative": _matrix,
    "proofs.trusted.equations.arrival": _formula,
    "proofs.trusted.paper.s4_single.single_facts.defect": _formula,
    "proofs.trusted.paper.s4_single.single_facts.multiplier": _formula,
    "proofs.trusted.paper.s4_single.single_facts.excess": _formula,
    "proofs.trusted.paper.s4_single.single_facts.distance": _formula,
    "proofs.trusted.kernel.expression.Tape.evaluate": _formula,
    "proofs.motion.impact.march": _impact,
    "proofs.motion.slope_cover._in_binary64": _boxes,
    "intervals.bilinear.bilinear": _grid,
    "intervals.cover.cover": _one(PARTS),
    "proofs.motion.covering.halves": _one(BISECTIONS),
    "proofs.motion.impact.bisected": _steps("steps", 2),
    "proofs.methods.extremes.extremes": _pieces,
    "proofs.methods.formulas.subdivide.<locals>.divide": _examined,
    "intervals.branch.split": _split,
    "proofs.motion.landing.prove_cells": _cells,
    "intervals.interval._make": _number(INTERVALS, "precision"),
    "intervals.interval.Interval.__init__": _number(INTERVALS, "precision"),
    "proofs.trusted.kernel.arithmetic.Enclosure.__init__": _number(CHECKER, "bits"),
    "intervals.array._make": _numbers,
    "proofs.methods.derive.equal": _one(ALGEBRA),
    "proofs.methods.derive.begins": _one(ALGEBRA),
    "proofs.trusted.certificate.render": _made,
    "proofs.trusted.rules.find_rule": _one(CHECKED),
    "proofs.trusted.kernel.meter.metered": _checked,
}
