"""What is measured: rows of a table, seconds of tasks in turn, ratios in pairs."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from importlib.metadata import PackageNotFoundError, version
from statistics import median
from time import perf_counter
from typing import Any

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
    def cells(self) -> tuple[str, ...]:
        """The line of the table."""
        unknown = "not measured" if self.target else "-"
        state = {True: "yes", False: "NO", None: unknown}[self.reached]
        return self.name, self.target or "-", self.measured, state


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
    return [[sample[k] for sample in samples] for k in range(len(tasks))]


def ratio_row(
    name: str, above: Sequence[float], below: Sequence[float], most: float | None = None
) -> Row:
    """Return the row of ratios in pairs, whose median should be at most `most`."""
    ratios = [upper / lower for upper, lower in zip(above, below, strict=False)]
    row = Row(f"{name} (pairs)", spread(ratios), samples={"ratios": ratios})
    if most is not None:
        row.target, row.reached = f"<= {most:g}", median(ratios) <= most
    return row


def version_of(package: str) -> str:
    """Return the version of a package, or that it is absent."""
    try:
        return version(package)
    except PackageNotFoundError:
        return "absent"
