"""What is measured: samples taken in turn, rows of a table, and sections of a page."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from statistics import median
from time import perf_counter
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from proofs.benchmark.diagrams import Diagram

Tell = Callable[[str], None]


@dataclass
class Row:
    """One line of the table. reached is None where there is no target, or no measurement."""

    name: str
    measured: str
    target: str = ""
    reached: bool | None = None
    samples: dict[str, Any] = field(default_factory=dict)

    @property
    def state(self) -> str:
        """Whether it reached its target, in a word."""
        if self.reached is None:
            return "not measured" if self.target else "-"
        return "yes" if self.reached else "NO"


@dataclass(frozen=True)
class Section:
    """Rows that belong together: a heading, what they are, and their diagrams."""

    title: str
    about: str
    rows: list[Row]
    diagrams: Sequence[Diagram] = ()

    @property
    def asked(self) -> list[Row]:
        """Return the rows with a target, and those that fail without one."""
        return [row for row in self.rows if row.target or row.reached is False]


def spread(samples: Sequence[float]) -> str:
    """Write the median and, in brackets, the least and the largest."""
    return f"{median(samples):.3g} ({min(samples):.3g} .. {max(samples):.3g})"


def seconds_of(task: Callable[[], Any]) -> float:
    """Return the seconds that one call takes."""
    began = perf_counter()
    task()
    return perf_counter() - began


def in_turn(tasks: Sequence[Callable[[], Any]], rounds: int) -> list[list[float]]:
    """Time the tasks A B A B ..., so that a busy machine slows all; return the seconds of each."""
    samples = [[seconds_of(task) for task in tasks] for _ in range(rounds)]
    return [[one[k] for one in samples] for k in range(len(tasks))]


def ratio_row(name: str, above: Sequence[float], below: Sequence[float], target: str = "") -> Row:
    """Return the row of ratios in pairs. target: a bound of their median, as in "<= 2.5"."""
    ratios = [one / other for one, other in zip(above, below, strict=False)]
    row = Row(f"{name} (pairs)", spread(ratios), target, samples={"ratios": ratios})
    if target:
        sign, bound = target.split()
        row.reached = {"<=": median(ratios) <= float(bound), ">=": median(ratios) >= float(bound)}[
            sign
        ]
    return row
