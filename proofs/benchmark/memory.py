"""The temporary memory of operations on large arrays: all that is held beside the result."""

from __future__ import annotations

import tracemalloc
from collections.abc import Callable
from typing import Any

import numpy as np

from intervals import IntervalArray
from proofs.benchmark.measuring import Row

ALLOWED = 64
_RESULT = 16  # bytes of an interval: two binary64 numbers
_LENGTH = 1_000_000


def measure() -> list[Row]:
    """Measure the most that each arithmetic operation holds, on a million intervals."""
    cuts = np.linspace(1.0, 3.0, _LENGTH + 1)
    x = IntervalArray.from_floats(cuts[:-1], cuts[1:])
    y = IntervalArray.from_floats(cuts[1:], cuts[1:] + 1.0)
    operations: dict[str, Callable[[], Any]] = {
        "X + Y": lambda: x + y,
        "X - Y": lambda: x - y,
        "X * Y": lambda: x * y,
        "X / Y": lambda: x / y,
        "X.sqr()": x.sqr,
        "X.sqrt()": x.sqrt,
    }
    return [_row(name, operation) for name, operation in operations.items()]


def _row(name: str, operation: Callable[[], Any]) -> Row:
    found = peak_bytes(operation) / _LENGTH - _RESULT
    return Row(
        f"temporary memory, {name} [bytes/element]",
        f"{found:8.3g}",
        f"<= {ALLOWED}",
        found <= ALLOWED,
        {"bytes an element": found},
    )


def peak_bytes(task: Callable[[], Any]) -> int:
    """Return the most bytes that a call holds at one time, its result included."""
    tracemalloc.start()
    try:
        before, _ = tracemalloc.get_traced_memory()
        task()
        return tracemalloc.get_traced_memory()[1] - before
    finally:
        tracemalloc.stop()
