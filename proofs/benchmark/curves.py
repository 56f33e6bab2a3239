"""Work-precision curves: time and error at growing sizes, their orders, and rows of the table."""

from __future__ import annotations

import math
import statistics
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from functools import partial
from time import perf_counter

from intervals import DomainError, Undecided
from proofs.benchmark.measuring import Row, in_turn, spread, timed

Task = Callable[[], float]  # does the work, returns the error, < 0 if the truth is excluded
Maker = Callable[[float], Task]  # from a size

_FITTED = 4  # an order is that of so many of the last points
_LONG = 1.0  # seconds, beside which caches matter little
_MUCH = 5
_ABOVE_FLOOR = 1000.0  # errors below this times the rounding say nothing of the order


@dataclass
class Point:
    """One size: boxes, digits, step, ... The error is None where nothing was proved or found."""

    size: float
    error: float | None
    seconds: list[float]
    note: str = ""

    @property
    def time(self) -> float:
        """The median time in seconds."""
        return statistics.median(self.seconds)


@dataclass
class Curve:
    """One way to do a work, at growing cost. `against`: "error", "time" or "": what is fitted.

    The error goes with size^-order (or with step^order), down to `floor`, that of the arithmetic.
    proved: the errors are those of what claims to enclose. least: about the order in theory.
    """

    work: str
    way: str
    unit: str
    points: list[Point] = field(default_factory=list)
    against: str = "error"
    floor: float = 0.0
    proved: bool = True
    least: float | None = None

    @property
    def measured(self) -> list[Point]:
        """The points with an error."""
        return [point for point in self.points if point.error is not None]

    def fit(self) -> tuple[float, int] | None:
        """Return the fitted exponent and the number of points it rests on; None below three."""
        if not self.against:
            return None
        if self.against == "time":
            pairs = [(point.size, point.time) for point in self.measured]
        else:
            least = _ABOVE_FLOOR * self.floor
            pairs = [(p.size, p.error) for p in self.measured if p.error and p.error > least]
        pairs = pairs[-_FITTED:]
        if len(pairs) < 3:
            return None
        return exponent(*zip(*pairs, strict=True)), len(pairs)

    @property
    def excludes_truth(self) -> bool:
        """Whether an enclosure was none."""
        return self.proved and any(p.error < 0 for p in self.points if p.error is not None)


def exponent(sizes: Sequence[float], values: Sequence[float]) -> float:
    """Return p of the least-squares fit log(value) = p log(size) + c."""
    xs, ys = [math.log(x) for x in sizes], [math.log(y) for y in values]
    return statistics.linear_regression(xs, ys).slope


@dataclass(frozen=True)
class Budget:
    """How often each is repeated, and beyond how many seconds it should not grow."""

    rounds: int
    limit: float


def sweep(
    makers: Mapping[str, tuple[Curve, Maker]],
    sizes: Sequence[float],
    budget: Budget,
) -> list[Curve]:
    """Measure some ways to do one work at growing sizes, all of a size in turn.

    The first call of each task gives its error and fills caches; its time counts if it is long.
    What is slower than the limit goes no further if its time grows; what is much slower goes no
    further and is not repeated. What is Undecided is recorded as such.
    """
    active = dict(makers)
    for size in sizes:
        repeated: list[tuple[Point, Task]] = []
        for curve, make in active.values():
            try:
                task = make(size)
                began = perf_counter()
                error = task()
                seconds = perf_counter() - began
                point = Point(size, error, [seconds if seconds > _LONG else timed(task)])
            except (Undecided, DomainError) as failure:
                curve.points.append(Point(size, None, [], str(failure)))
                continue
            curve.points.append(point)
            if point.seconds[0] <= _MUCH * budget.limit:
                repeated.append((point, task))
        columns = in_turn([partial(timed, task) for _, task in repeated], budget.rounds)
        for (point, _), column in zip(repeated, columns, strict=False):
            point.seconds += column
        active = {name: one for name, one in active.items() if _goes_on(one[0], budget.limit)}
    return [curve for curve, _ in makers.values()]


def _goes_on(curve: Curve, limit: float) -> bool:
    """Whether the last size was fast, or not much slower than the one before."""
    times = [min(point.seconds) for point in curve.measured[-2:]]
    if not times or times[-1] <= limit:
        return True
    return times[-1] <= _MUCH * limit and times[-1] <= 2 * times[0]


# -- the table -------------------------------------------------------------------------------------


def row(curve: Curve) -> Row:
    """Return the row of a curve: its ends, its order, and its worst if nothing is proved."""
    name = f"{curve.work}, {curve.way}"
    samples = {"curve": {**asdict(curve), "order": curve.fit()}}
    if not curve.measured:
        why = next((point.note for point in curve.points if point.note), "not measured")
        return Row(name, why, samples=samples)
    first, last = curve.measured[0], curve.measured[-1]
    text = _shown(first, curve.unit)
    if last is not first:
        text += f"; {_shown(last, curve.unit)}"
    worst = max(curve.measured, key=lambda point: point.error or 0.0)
    if not curve.proved and worst not in (first, last):
        text += f"; worst, {_shown(worst, curve.unit)}"
    fit = curve.fit()
    if fit is not None:
        what = "error" if curve.against == "error" else "time"
        text += f"; {what} ~ {curve.unit}^{fit[0]:.2f}"
    if curve.excludes_truth:
        return Row(name, text + "; NOT AN ENCLOSURE", "contains the truth", False, samples)
    if curve.least is None:
        return Row(name, text, samples=samples)
    if fit is None:
        return Row(name, f"{text}; too few sizes for an order", samples=samples)
    return Row(name, text, f"order >= {curve.least:g}", abs(fit[0]) >= curve.least, samples)


def _shown(point: Point, unit: str) -> str:
    return f"{unit} {point.size:g}: {point.error:.1e} in {_milliseconds(point.time)}"


def _milliseconds(seconds: float) -> str:
    return f"{1e3 * seconds:.3g} ms"


def ratios(own: Curve, theirs: Curve) -> Row | None:
    """Return how many times as long theirs takes at the largest common size, in pairs."""
    known = {point.size: point.seconds for point in own.measured}
    common = [point for point in theirs.measured if point.size in known]
    if not common:
        return None
    last = common[-1]
    pairs = zip(last.seconds, known[last.size], strict=False)  # one was slower: the first only
    found = [other / mine for other, mine in pairs]
    name = f"{own.work}: {theirs.way} / {own.way}, {own.unit} {last.size:g}"
    return Row(name, spread(found), samples={"ratios": found})
