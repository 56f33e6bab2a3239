"""Interval beside mpmath.iv: the first calls in a process, which fill tables of constants."""

from __future__ import annotations

import subprocess
import sys
from functools import partial
from timeit import Timer

from proofs.benchmark.comparison import Comparison, Tell, heading
from proofs.benchmark.measuring import Effort, Row, in_turn
from proofs.benchmark.operations import OPERATIONS, SCALAR
from proofs.benchmark.peers import IV, at_precision
from proofs.benchmark.scalars import library

COUNT = 100  # different wide intervals, each once
_BITS = 333
_NAMES = ("exp", "log", "sin")


def measure(effort: Effort, tell: Tell) -> list[Row]:
    """Measure some functions, each sample in a process of its own."""
    rows = [heading(f"Interval, {_BITS} bits, the first {COUNT} calls", (IV,))]
    for name in _NAMES:
        tell(f"the first calls of {name}")
        samplers = [partial(_in_new_process, name, which) for which in (SCALAR, IV)]
        own, theirs = in_turn(samplers, effort.large_rounds)
        found = Comparison({SCALAR: own, IV: theirs})
        rows.append(found.row(f"{name}, {_BITS} bits, first {COUNT}", SCALAR, (IV,), "", 0))
    return rows


def _in_new_process(name: str, which: str) -> float:
    command = [sys.executable, "-m", "proofs.benchmark.first_calls", name, which]
    return float(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def seconds(name: str, which: str) -> float:
    """Return the seconds a call of function `name` takes, of the first calls of a library."""
    (operation,) = (one for one in OPERATIONS if one.name == name)
    job = operation.job(which, wide=True, count=COUNT)
    if job is None:
        raise ValueError(f"{which} has no {name}")
    with at_precision(_BITS) as peers:
        statement, names = {SCALAR: library(_BITS), **peers}[which].prepare(job)
        return Timer(statement, globals=names).timeit(1) / COUNT


if __name__ == "__main__":
    print(seconds(*sys.argv[1:]))
