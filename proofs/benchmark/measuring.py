"""Timing in turns, and the table: what was measured, what was asked, whether it was reached."""

from __future__ import annotations

import os
import platform
import statistics
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import partial
from importlib.metadata import PackageNotFoundError, version
from time import perf_counter
from typing import Any

_PACKAGES = ("numpy", "mpmath", "gmpy2", "python-flint", "scipy", "matplotlib")


@dataclass
class Row:
    """One line of the table. reached is None where there is no target, or no measurement."""

    name: str
    measured: str
    target: str = ""
    reached: bool | None = None
    samples: dict[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Effort:
    """How often each thing is done.

    rounds: samples of each operation, large_rounds at a million elements and of new processes; of
    `enough` seconds each at least, so that the caches that the others emptied matter little.
    costly_length: the longest arrays for operations that are not cheap.
    """

    process_pairs: int
    kernel_pairs: int
    repeats: int
    rounds: int
    large_rounds: int
    enough: float
    costly_length: int


EFFORTS = {
    "quick": Effort(7, 21, 5, 5, 3, 3e-3, 10_000),
    "full": Effort(31, 101, 15, 31, 7, 1e-2, 1_000_000),
    "smallest": Effort(1, 1, 1, 1, 1, 0.0, 10_000),
}


def spread(samples: Sequence[float]) -> str:
    """Write the median and, in brackets, the least and the largest."""
    return f"{statistics.median(samples):.3g} ({min(samples):.3g} .. {max(samples):.3g})"


def figures(x: float) -> str:
    """Write three figures, or all before the point."""
    return f"{x:.3g}" if x < 999.5 else f"{x:,.0f}"


def timed(task: Callable[[], Any]) -> float:
    """Return the seconds that one call takes."""
    began = perf_counter()
    task()
    return perf_counter() - began


def in_turn(samplers: Sequence[Callable[[], float]], rounds: int) -> list[list[float]]:
    """Take samples from each in turn; return the samples of each."""
    found = [[sample() for sample in samplers] for _ in range(rounds)]
    return [list(column) for column in zip(*found, strict=True)]


def in_pairs(tasks: Sequence[Callable[[], Any]], pairs: int) -> list[list[float]]:
    """Time the tasks in turn, after one call of each that does not count."""
    for task in tasks:
        task()
    return in_turn([partial(timed, task) for task in tasks], pairs)


def word(row: Row) -> str:
    """Say whether a row reached its target."""
    if row.reached is None:
        return "not measured" if row.target else "-"
    return "yes" if row.reached else "NO"


def table(rows: Sequence[Row]) -> str:
    """Return the rows as plain aligned text."""
    cells = [("what", "target", "measured", "reached")]
    cells += [(row.name, row.target or "-", row.measured, word(row)) for row in rows]
    widths = [max(len(line[i]) for line in cells) for i in range(4)]
    lines = (
        "  ".join(cell.ljust(w) for cell, w in zip(line, widths, strict=True)) for line in cells
    )
    return "\n".join(line.rstrip() for line in lines)


def environment() -> dict[str, str | int | None]:
    """Return what the measurements ran on; None stands for a package that is absent."""
    return {
        "python": platform.python_version(),
        **{name: version_of(name) for name in _PACKAGES},
        "machine": platform.machine(),
        "processors": os.cpu_count(),
    }


def version_of(package: str) -> str | None:
    """Return the version of a package; None if it is absent."""
    try:
        return version(package)
    except PackageNotFoundError:
        return None
