"""Work-precision curves: time and error at growing sizes, their orders, and rows of the table."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import partial
from statistics import linear_regression, median
from time import perf_counter
from typing import NamedTuple

from intervals import DomainError, Undecided
from proofs.benchmark.measure import Row, in_turn, ratio_row, seconds_of
from proofs.benchmark.peers import PEERS

_FITTED = 4  # an order is that of so many of the last points
_LONG = 1.0  # seconds, beside which caches matter little
_MUCH = 5
_ABOVE_FLOOR = 1000.0  # errors below this times the rounding say nothing of the order


class Point(NamedTuple):
    """One size: boxes, digits, step, ... The error is None where nothing was proved or found."""

    size: float
    error: float | None
    seconds: list[float]
    note: str = ""


@dataclass
class Curve:
    """One way to do a work, at growing cost: `run` does it at a size and returns the error.

    against: "error", "time" or "", what is fitted. The error goes with size^-order (or with
    step^order), down to `floor`, that of the arithmetic. proved: the errors are those of what
    claims to enclose. least: about the order in theory.
    """

    work: str
    way: str
    unit: str
    sizes: Sequence[float] = ()
    run: Callable[[float], float] | None = None
    against: str = "time"
    floor: float = 0.0
    proved: bool = True
    least: float | None = None
    points: list[Point] = field(default_factory=list)

    @property
    def measured(self) -> list[Point]:
        """The points with an error."""
        return [point for point in self.points if point.error is not None]

    def order(self) -> float | None:
        """Return the exponent of a least-squares fit to the last points; None below three."""
        pairs = [(p.size, median(p.seconds)) for p in self.measured]
        if self.against == "error":
            least = _ABOVE_FLOOR * self.floor
            pairs = [(p.size, p.error) for p in self.measured if p.error and p.error > least]
        logarithms = [(math.log(x), math.log(y)) for x, y in pairs[-_FITTED:]]
        if len(logarithms) < 3 or not self.against:
            return None
        return linear_regression(*zip(*logarithms, strict=True)).slope

    def row(self) -> Row:
        """Return the row: both ends, the order, and the worst if nothing is proved."""
        order, shown = self.order(), self.measured[:1] + self.measured[1:][-1:]
        samples = {"order": order, "points": [point._asdict() for point in self.points]}
        row = Row(f"{self.work}, {self.way}", "", samples=samples)
        if not shown:
            row.measured = self.points[0].note if self.points else "not measured"
            return row
        worst = max(self.measured, key=lambda point: point.error or 0.0)
        if not self.proved and worst not in shown:
            shown.insert(1, worst)
        parts = [f"{self.unit} {p.size:g}: {p.error:.1e} in {_ms(p)} ms" for p in shown]
        if order is not None:
            parts.append(f"{self.against} ~ {self.unit}^{order:.2f}")
            if self.least is not None:
                row.target, row.reached = f"order >= {self.least:g}", abs(order) >= self.least
        if self.proved and any(point.error < 0 for point in self.measured if point.error):
            row.target, row.reached = "contains the truth", False
            parts.append("NOT AN ENCLOSURE")
        row.measured = "; ".join(parts)
        return row

    def goes_on(self, limit: float) -> bool:
        """Whether the last size was fast, or not much slower than the one before."""
        times = [min(point.seconds) for point in self.measured[-2:]]
        return not times or times[-1] <= limit or times[-1] <= min(_MUCH * limit, 2 * times[0])


def _ms(point: Point) -> str:
    return f"{1e3 * median(point.seconds):.3g}"


class Budget(NamedTuple):
    """How often each is repeated, and beyond how many seconds it should not grow."""

    rounds: int
    limit: float


def sweep(curves: Sequence[Curve], budget: Budget) -> Sequence[Curve]:
    """Measure some ways to do one work at their growing sizes, all of a size in turn.

    The first call of each task gives its error and fills caches; its time counts if it is long.
    What is slower than the limit goes no further if its time grows; what is much slower goes no
    further and is not repeated. What is Undecided is recorded as such.
    """
    for size in dict.fromkeys(size for curve in curves for size in curve.sizes):
        repeated: list[tuple[Point, Callable[[], float]]] = []
        for curve in curves:
            if curve.run and size in curve.sizes and curve.goes_on(budget.limit):
                task, began = partial(curve.run, size), perf_counter()
                try:
                    point = Point(size, task(), [perf_counter() - began])
                except (Undecided, DomainError) as failure:
                    point = Point(size, None, [], str(failure))
                curve.points.append(point)
                if point.seconds and point.seconds[0] < _LONG:
                    point.seconds[:] = [seconds_of(task)]
                if point.seconds and point.seconds[0] <= _MUCH * budget.limit:
                    repeated.append((point, task))
        columns = in_turn([task for _, task in repeated], budget.rounds)
        for (point, _), column in zip(repeated, columns, strict=True):
            point.seconds.extend(column)
    return curves


def beside(curves: Sequence[Curve]) -> list[Row]:
    """Return how many times as long peers take as the first way of the same work and form.

    That first way is ours. At the largest common size, in pairs.
    """
    rows, first = [], dict[tuple[str, str], Curve]()
    for theirs in curves:
        own = first.setdefault((theirs.work, theirs.way.rpartition(", ")[0]), theirs)
        known = {point.size: point.seconds for point in own.measured}
        common = [point for point in theirs.measured if point.size in known]
        if own is not theirs and theirs.way.endswith(PEERS) and common:
            size, _, seconds, _ = common[-1]
            name = f"{own.work}: {theirs.way} / {own.way}, {own.unit} {size:g}"
            rows.append(ratio_row(name, seconds, known[size]))
    return rows
