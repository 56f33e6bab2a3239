"""Libraries of intervals at work on the same intervals: the standard library alone.

Also what a process of its own needs to measure a library that this one must not import.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import cycle, islice
from math import ceil, isqrt
from operator import pos
from random import Random
from timeit import Timer
from typing import Any, Protocol

Sampler = Callable[[], float]  # returns seconds an element, from one measurement

RANGES = {"signed": (-10, 10), "positive": (1, 4), "unit": (-1, 1)}  # within (-16, 16)
POOL = 10_000  # different intervals; longer lists repeat them
_WIDTH = 6  # wide intervals are narrower than 2^-6


@dataclass(frozen=True)
class Job:
    """An expression over `count` intervals of a library.

    It is about the elements x (and y) of lists; if `whole`, about all of them, xs and ys, or the
    square matrices a and b. x and y name the RANGES that the intervals are in; if not `wide`, they
    are points.
    """

    expression: str
    x: str
    y: str | None
    whole: bool
    matrices: bool
    wide: bool
    count: int

    @property
    def steps(self) -> int:
        """What the time is divided by: elements; multiplications of a product of matrices."""
        return isqrt(self.count) ** 3 if self.matrices else self.count


class Measurable(Protocol):
    """What can measure a job: a library here, or one in a process of its own."""

    def sampler(self, job: Job, enough: float) -> Sampler:
        """Return a measurement, each of `enough` seconds at least."""
        ...


@lru_cache(maxsize=16)
def endpoints(role: str, inside: str, wide: bool, bits: int, count: int) -> list[tuple[int, int]]:
    """Return intervals [m, n] / 2^(bits - 4), m and n of `bits` bits, the same in each process."""
    random = Random(f"{role} {inside} {bits}")
    scale = bits - 4
    widest = 1 << (scale - _WIDTH)
    low, high = (end << scale for end in RANGES[inside])
    lower = [random.randrange(low, high - widest) for _ in range(count)]
    return [(m, m + random.randrange(1, widest) if wide else m) for m in lower]


class Library:
    """A library: how it makes many intervals, and the names that its expressions use.

    collect: from pairs (m, n) and a number `count` to that many intervals [m, n] / 2^(bits - 4),
    repeating the pairs. matrix: from these to a square matrix of `side` rows.
    """

    def __init__(
        self,
        collect: Callable[[Sequence[tuple[int, int]], int], Any],
        bits: int,
        names: Mapping[str, Any],
        matrix: Callable[[Any, int], Any] | None = None,
    ) -> None:
        self._collect, self._bits, self._names, self._matrix = collect, bits, names, matrix
        self._made: dict[tuple[str, str, bool, int], Any] = {}

    def prepare(self, job: Job) -> tuple[str, dict[str, Any]]:
        """Return the statement that does the job, and the names in it."""
        names = {**self._names, "xs": self._operand("x", job.x, job)}
        if job.y:
            names["ys"] = self._operand("y", job.y, job)
        if job.matrices and self._matrix:
            side = isqrt(job.count)
            names |= {"a": self._matrix(names["xs"], side), "b": self._matrix(names["ys"], side)}
        return _statement(job), names

    def sampler(self, job: Job, enough: float) -> Sampler:
        """Return a measurement of the job; tables and caches have been filled before."""
        statement, names = self.prepare(job)
        timer = Timer(statement, globals=names)
        if (once := timer.timeit(1)) < enough:
            once = timer.timeit(1)
        number = max(1, ceil(enough / max(once, 1e-9)))
        return lambda: timer.timeit(number) / number / job.steps

    def _operand(self, role: str, inside: str, job: Job) -> Any:
        """Return intervals; those of one length are kept for the next job."""
        key = (role, inside, job.wide, job.count)
        if key not in self._made:
            self._made = {k: v for k, v in self._made.items() if k[-1] == job.count}
            ends = endpoints(role, inside, job.wide, self._bits, min(job.count, POOL))
            self._made[key] = self._collect(ends, job.count)
        return self._made[key]


def _statement(job: Job) -> str:
    if job.whole:
        return job.expression
    if job.y:
        return f"[{job.expression} for x, y in zip(xs, ys)]"
    return f"[{job.expression} for x in xs]"


def one_by_one(
    interval: Callable[[int, int], Any], copy: Callable[[Any], Any] = pos
) -> Callable[[Sequence[tuple[int, int]], int], list[Any]]:
    """Return `collect` for a library whose intervals are objects: a list of them.

    What is repeated is copied, so that a long list has as many objects.
    """

    def collect(ends: Sequence[tuple[int, int]], count: int) -> list[Any]:
        return list(map(copy, islice(cycle([interval(m, n) for m, n in ends]), count)))

    return collect


def in_rows(items: Sequence[Any], side: int) -> list[list[Any]]:
    """Cut a list into `side` rows."""
    return [list(items[i * side : (i + 1) * side]) for i in range(side)]
