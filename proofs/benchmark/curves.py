"""Work-precision curves: time and error at growing sizes, their orders, and rows of the table."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from statistics import linear_regression, median
from typing import Any

from intervals import DomainError, Undecided
from proofs.benchmark.rows import Row, in_turn, ratio_row, seconds_of

Task = Callable[[], float]  # does the work, returns the error, < 0 if the truth is excluded

_FITTED = 4  # an order is that of so many of the last points
_LONG = 1.0  # seconds, beside which caches matter little
_MUCH = 5
_ABOVE_FLOOR = 1000.0  # errors below this times the rounding say nothing of the order


@dataclass(frozen=True)
class Point:
    """One size: boxes, digits, step, ... The error is None where nothing was proved or found."""

    size: float
    error: float | None
    seconds: list[float]
    note: str = ""

    @property
    def time(self) -> float:
        """The median time in seconds."""
        return median(self.seconds)


@dataclass
class Curve:
    """One way to do a work, at growing cost: `make` returns the task of a size.

    against: "error", "time" or "", what is fitted. The error goes with size^-order (or with
    step^order), down to `floor`, that of the arithmetic. proved: the errors are those of what
    claims to enclose. least: about the order in theory.
    """

    work: str
    way: str
    unit: str
    sizes: Sequence[float] = ()
    make: Callable[[float], Task] | None = None
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
        if self.against == "time":
            pairs = [(point.size, point.time) for point in self.measured]
        else:
            least = _ABOVE_FLOOR * self.floor
            pairs = [(p.size, p.error) for p in self.measured if p.error and p.error > least]
        logarithms = [(math.log(x), math.log(y)) for x, y in pairs[-_FITTED:]]
        if len(logarithms) < 3 or not self.against:
            return None
        return linear_regression(*zip(*logarithms, strict=True)).slope

    def row(self) -> Row:
        """Return the row: both ends, the order, and the worst if nothing is proved."""
        name = f"{self.work}, {self.way}"
        samples = {"curve": self._samples()}
        if not self.measured:
            why = next((point.note for point in self.points if point.note), "not measured")
            return Row(name, why, samples=samples)
        first, last = self.measured[0], self.measured[-1]
        text = self._shown(first) if first is last else f"{self._shown(first)}; {self._shown(last)}"
        worst = max(self.measured, key=lambda point: point.error or 0.0)
        if not self.proved and worst not in (first, last):
            text += f"; worst, {self._shown(worst)}"
        order = self.order()
        if order is not None:
            text += f"; {self.against} ~ {self.unit}^{order:.2f}"
        if self.proved and any(
            point.error is not None and point.error < 0 for point in self.points
        ):
            return Row(name, text + "; NOT AN ENCLOSURE", "contains the truth", False, samples)
        if self.least is None:
            return Row(name, text, samples=samples)
        if order is None:
            return Row(name, f"{text}; too few sizes for an order", samples=samples)
        return Row(name, text, f"order >= {self.least:g}", abs(order) >= self.least, samples)

    def _samples(self) -> dict[str, Any]:
        named = {name: value for name, value in vars(self).items() if name not in ("make", "sizes")}
        return {**named, "points": [vars(point) for point in self.points], "order": self.order()}

    def _shown(self, point: Point) -> str:
        return f"{self.unit} {point.size:g}: {point.error:.1e} in {1e3 * point.time:.3g} ms"

    def goes_on(self, limit: float) -> bool:
        """Whether the last size was fast, or not much slower than the one before."""
        times = [min(point.seconds) for point in self.measured[-2:]]
        if not times or times[-1] <= limit:
            return True
        return times[-1] <= _MUCH * limit and times[-1] <= 2 * times[0]


@dataclass(frozen=True)
class Budget:
    """How often each is repeated, and beyond how many seconds it should not grow."""

    rounds: int
    limit: float


def sweep(curves: Sequence[Curve], budget: Budget) -> list[Curve]:
    """Measure some ways to do one work at their growing sizes, all of a size in turn.

    The first call of each task gives its error and fills caches; its time counts if it is long.
    What is slower than the limit goes no further if its time grows; what is much slower goes no
    further and is not repeated. What is Undecided is recorded as such.
    """
    active = list(curves)
    for size in dict.fromkeys(size for curve in curves for size in curve.sizes):
        repeated: list[tuple[Point, Task]] = []
        for curve in active:
            if curve.make is None or size not in curve.sizes:
                continue
            point, task = _first(curve.make, size)
            curve.points.append(point)
            if task is not None and point.seconds[0] <= _MUCH * budget.limit:
                repeated.append((point, task))
        columns = in_turn([task for _, task in repeated], budget.rounds)
        for (point, _), column in zip(repeated, columns, strict=True):
            point.seconds.extend(column)
        active = [curve for curve in active if curve.goes_on(budget.limit)]
    return list(curves)


def _first(make: Callable[[float], Task], size: float) -> tuple[Point, Task | None]:
    """Return the point of the first call, or of the second if that was short."""
    errors: list[float] = []
    try:
        task = make(size)
        seconds = seconds_of(lambda: errors.append(task()))
        return Point(size, errors[0], [seconds if seconds > _LONG else seconds_of(task)]), task
    except (Undecided, DomainError) as failure:
        return Point(size, None, [], str(failure)), None


def beside(curves: Sequence[Curve], peers: Sequence[str]) -> list[Row]:
    """Return how many times as long peers take as the first way of the same work and form.

    That first way is ours. At the largest common size, in pairs.
    """
    rows, first = [], dict[tuple[str, str, str], Curve]()
    for theirs in curves:
        own = first.setdefault((theirs.work, theirs.way.rpartition(", ")[0], theirs.unit), theirs)
        known = {point.size: point.seconds for point in own.measured}
        common = [point for point in theirs.measured if point.size in known]
        if own is not theirs and theirs.way.endswith(tuple(peers)) and common:
            last = common[-1]
            name = f"{own.work}: {theirs.way} / {own.way}, {own.unit} {last.size:g}"
            rows.append(ratio_row(name, last.seconds, known[last.size]))
    return rows
