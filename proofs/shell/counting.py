"""What a run evaluates, counted by watching it: the code that proves and checks is unchanged.

`with counted() as counts` asks the interpreter to announce every function that returns
(`sys.setprofile`), and counts those named at the end of this file, wherever they are bound and
whenever they are imported. The work takes some three times as long meanwhile, and not a moment
longer where nothing is counted. Only the present thread is watched.

What is counted: evaluations of the equations, an array's or a jet's once for each of its boxes, by
the numbers they are made on: floats (candidates), intervals and arrays (proofs), the checker's
(by the check, and by provers that let its rules conclude).
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
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from types import CodeType, FrameType
from typing import Any, NamedTuple

from intervals import Interval
from intervals._engine import by_mpmath

GAP, RATES, SLOPE, SECOND, MATRIX = "gap", "gap', gap'', along jets", "f'", "f''", "DF"
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
EQUATIONS = (GAP, RATES, SLOPE, SECOND, MATRIX)
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
_Rule = Callable[[FrameType, Any], Mapping[Kind, int]]  # how a return counts, by its value


@contextmanager
def counted() -> Iterator[Counts]:
    """Count what is evaluated inside the `with`."""
    counts: Counts = Counter()
    before = sys.getprofile()
    sys.setprofile(_observer(counts))
    try:
        with by_mpmath(Interval):  # whose operations are watched here
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
    known: dict[int, tuple[CodeType, _Rule | None, _Rule | None]] = {}  # a code alive keeps its id

    def observe(frame: FrameType, event: str, value: Any) -> None:
        if event != "return":
            return
        code = frame.f_code
        if id(code) not in known:
            name = f"{frame.f_globals.get('__name__')}.{code.co_qualname}"
            known[id(code)] = code, _RESULTS.get(name), _CALLS.get(name)
        _, by_result, by_call = known[id(code)]
        rule = by_call if value is None else by_result or by_call
        if rule is not None:
            counts.update(rule(frame, value))

    return observe


# -- how a return counts ---------------------------------------------------------------------------


def _column(value: Any) -> str | None:
    """Return the column of a result, None for one that is not a number of these four kinds."""
    kind = type(value)
    if kind.__name__ in ("Jet", "Dual"):
        return _column(value.value)
    if kind.__name__ == "Sketch":
        return FLOATS
    if kind.__module__.startswith("proofs.trusted."):
        return CHECKER
    if kind.__module__.startswith("intervals."):
        return ARRAYS if kind.__name__ == "IntervalArray" else INTERVALS
    return FLOATS if kind is float or kind.__module__ == "numpy" else None


def _size(value: Any) -> int:
    """Return how many boxes or points a result is about."""
    if type(value).__name__ in ("Jet", "Dual"):
        return _size(value.value)
    return int(getattr(value, "size", 1))


def _evaluated(what: str, *values: Any) -> Counts:
    """Count results, one for each box or point, in their columns."""
    counts: Counts = Counter()
    for value in values:
        if (column := _column(value)) is not None:
            counts[Kind(what, column)] += _size(value)
    return counts


def _evaluation(plain: str, derived: str) -> _Rule:
    """Count a result as `plain`, a jet's and a time derivative's as `derived`."""

    def rule(frame: FrameType, value: Any) -> Counts:
        is_plain = type(value).__name__ not in _JETS and not frame.f_locals.get("order")
        return _evaluated(plain if is_plain else derived, value)

    return rule


def _formula(frame: FrameType, value: Any) -> Counts:
    """Count each component of what a formula gives, a number where it has one."""
    return _evaluated(FORMULAS, *(value if type(value) in (list, tuple) else (value,)))


def _number(by: str, bits: str) -> _Rule:
    """Count a number by its precision, a local variable."""
    kinds = [{Kind(what, by): 1} for what in NUMBERS]
    return lambda frame, value: kinds[bisect_left(_PRECISIONS, frame.f_locals[bits])]


def _impact(frame: FrameType, value: Any) -> dict[Kind, int]:
    """Count a set of launches whose impact is found to be one, by the precision it took."""
    row = IMPACTS[bisect_left(_PRECISIONS, value.bits)]
    return {Kind(row, CHECKER if value.bits else FLOATS): 1} if value.transversal else {}


def _one(what: str) -> _Rule:
    """Count the calls that return something."""
    return lambda frame, value: {Kind(what): 1}


def _boxes(what: str) -> _Rule:
    """Count the boxes of an array."""
    return lambda frame, value: {Kind(what, ARRAYS): _size(value)}


def _examined(frame: FrameType, value: Any) -> dict[Kind, int]:
    """Count a box of a tree, None where it is a leaf: decided as it is."""
    return {Kind(PARTS if value is None else BISECTIONS): 1}


def _pieces(frame: FrameType, value: Any) -> dict[Kind, int]:
    """Count the pieces of a range, and the bisections that made them of those given."""
    found, given = len(value.pieces), len(frame.f_locals["points"]) - 1
    return {Kind(PARTS): found, Kind(BISECTIONS): found - given}


def _checked(frame: FrameType, value: Any) -> dict[Kind, int]:
    """Count a step of a file: provers ask for rules, too."""
    caller = frame.f_back
    is_check = caller is not None and caller.f_globals.get("__name__") == "proofs.trusted.verify"
    return {Kind(CHECKED): 1} if is_check else {}


def _charged(frame: FrameType, value: Any) -> dict[Kind, int]:
    """Count the work charged to a file, also to one that is rejected, when its meter ends."""
    ended = value is None and "meter" in frame.f_locals
    return {Kind(WORK): round(frame.f_locals["meter"].spent)} if ended else {}


_RESULTS: dict[str, _Rule] = {  # what returns something; None is an exception
    "proofs.trusted.equations.gap": _evaluation(GAP, RATES),
    "proofs.trusted.equations.slope": _evaluation(SLOPE, SECOND),
    "proofs.trusted.equations.return_map_derivative": (
        lambda frame, matrix: _evaluated(MATRIX, matrix[0][0])
    ),
    "proofs.trusted.equations.arrival": _formula,
    "proofs.trusted.paper.s4_single.orbits.defect": _formula,
    "proofs.motion.single_orbits.multiplier": _formula,
    "proofs.trusted.paper.s4_single.orbits.excess": _formula,
    "proofs.trusted.paper.s4_single.orbits.distance": _formula,
    "proofs.trusted.kernel.expression.Tape.evaluate": _formula,
    "proofs.motion.witness.march": _impact,
    "intervals.cover.cover": _one(PARTS),
    "proofs.motion.covering.halves": _one(BISECTIONS),
    "proofs.methods.extremes.extremes": _pieces,
    "intervals.branch.split": lambda frame, found: {Kind(BISECTIONS): int(found[1].sum())},
    "proofs.methods.basin.Mesh.leaning": lambda frame, cuts: {Kind(CELLS): len(cuts.phases)},
    "intervals.array._make": _boxes(NUMBERS[0]),
    "proofs.methods.derive.simplest": _one(ALGEBRA),
    "proofs.trusted.certificate.render": (
        lambda frame, text: {Kind(MADE): len(frame.f_locals["document"].get("steps", ()))}
    ),
    "proofs.trusted.rules.find_rule": _checked,
}
_CALLS: dict[str, _Rule] = {  # what may return None
    "proofs.methods.formulas.subdivide.<locals>.divide": _examined,
    "intervals.interval._make": _number(INTERVALS, "precision"),
    "intervals.interval.Interval.__init__": _number(INTERVALS, "precision"),
    "proofs.trusted.kernel.arithmetic.Enclosure.__init__": _number(CHECKER, "bits"),
    "proofs.trusted.kernel.meter.metered": _charged,
}
