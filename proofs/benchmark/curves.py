"""Work-precision curves: time and error at growing sizes, their orders, and rows of the table."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import partial
from itertools import cycle
from math import ceil, log10
from statistics import linear_regression, median
from time import perf_counter
from typing import TYPE_CHECKING, Literal, NamedTuple

from intervals import DomainError, Undecided
from proofs.benchmark.measure import Row, in_turn, ratio_row, seconds_of
from proofs.benchmark.peers import FLINT, IV, PEERS
from proofs.report.figures.style import Axes, style, svg_of

if TYPE_CHECKING:
    from matplotlib.artist import Artist

_OURS = ("#08519c", "o"), ("#6baed6", "<"), ("#4292c6", ">")  # colour, mark
_OTHERS = {  # by the end of their names
    FLINT: ("#e6550d", "s"),
    IV: ("#31a354", "^"),
    "algorithm A.1": ("#8c6d31", "v"),
    "RK45": ("#756bb1", "P"),
    "DOP853": ("#c51b8a", "X"),
}


@dataclass(frozen=True)
class Diagram:
    """Curves that belong together, the name of their file, their title, and what is across.

    `against` says which that is: the error, or its digits, -log10 of it. Errors up to `least` are
    not drawn; if `certified`, neither are curves that prove nothing.
    panels: each form, the first part of the name of a way, has a panel of its own.
    """

    name: str
    title: str
    across: str = "error"
    against: Literal["error", "digits"] = "error"
    curves: list[Curve] = field(default_factory=list)
    least: float = 0.0
    certified: bool = False
    panels: bool = False

    def place(self, point: Point) -> float:
        """Return the place of a point on the horizontal axis; 0 is none."""
        error = abs(point.error or 0.0)
        if error <= self.least:
            return 0.0
        return error if self.against == "error" else -log10(error)


def svg(diagram: Diagram) -> str:
    """Return an SVG: medians as marks, least to largest time as bars.

    ImportError without matplotlib.
    """
    panels: dict[str, list[Curve]] = {}
    for curve in diagram.curves:
        form = curve.way.partition(", ")[0] if diagram.panels else ""
        if curve.proved or not diagram.certified:
            panels.setdefault(form, []).append(curve)
    columns, rows = min(len(panels), 3), ceil(len(panels) / 3)
    size = (9.5, 2.7 * rows + 1.0) if diagram.panels else (7.5, 5.0)
    with style(diagram.name):
        from matplotlib import pyplot as plt

        figure = plt.figure(figsize=size)
        grid = figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False).flat
        artists: dict[str, Artist] = {}
        for axes, (form, curves) in zip(grid, panels.items(), strict=False):
            axes.set(xscale="log", yscale="log", title=form)
            axes.grid(alpha=0.3)
            artists |= _draw(axes, diagram, curves)
        for axes in grid[len(panels) :]:
            axes.set_visible(False)
        if diagram.against == "error":
            grid[0].invert_xaxis()  # smaller errors to the right; the panels share their axes
        figure.suptitle(diagram.title)
        below = min(columns * (rows - 1) + columns // 2, len(panels) - 1)
        grid[below].set_xlabel(diagram.across)
        figure.supylabel("time [s]", fontsize=9)
        names = list(artists)
        if len(names) > 1:
            wide = 4 if max(map(len, names)) <= 20 else 2
            figure.legend(artists.values(), names, loc="outside lower center", ncols=wide)
        return svg_of(figure, diagram.name, diagram.title)


def _draw(axes: Axes, diagram: Diagram, curves: list[Curve]) -> dict[str, Artist]:
    """Draw curves into a panel; return what is drawn by name."""
    artists: dict[str, Artist] = {}
    own = cycle(_OURS)
    for curve in curves:
        colour, mark = of_peer(curve.way) or next(own)
        points = [(x, p) for p in curve.points if (x := diagram.place(p)) > 0]
        if points:
            name = curve.way.rpartition(", ")[2] if diagram.panels else curve.way
            places, times = zip(*((x, median(p.seconds)) for x, p in points), strict=True)
            line = "-" if curve.against else "none"  # what has no order is not joined
            (artists[name],) = axes.plot(places, times, mark, color=colour, ls=line, ms=4.5, lw=1)
        for x, p in points:
            axes.plot([x, x], [min(p.seconds), max(p.seconds)], color=colour, lw=0.6)
    return artists


def of_peer(way: str) -> tuple[str, str] | None:
    """Return colour and mark of another library; None if the way is ours."""
    return next((marked for end, marked in _OTHERS.items() if way.endswith(end)), None)


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
        ours = {point.size: point.seconds for point in own.measured}
        common = [point for point in theirs.measured if point.size in ours]
        if own is not theirs and theirs.way.endswith(PEERS) and common:
            size, _, seconds, _ = common[-1]
            name = f"{own.work}: {theirs.way} / {own.way}, {own.unit} {size:g}"
            rows.append(ratio_row(name, seconds, ours[size]))
    return rows
