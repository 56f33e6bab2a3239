"""What limits an atlas on many workers: measured here and now, from the rows of a finished one.

Its cells are computed again in this process, in two others, and by Dask; its rows are written again
as the head of a run writes them; and as much is sent through a Dask scheduler, without the work.
"""

from __future__ import annotations

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.plane.scaling")

import os
import pickle
import tempfile
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, Future, wait
from importlib.util import find_spec
from pathlib import Path
from time import perf_counter, process_time
from typing import Any, NamedTuple

from proofs.plane.head import Here, executor, run
from proofs.plane.store import NAME, Held, opened
from proofs.shell.cli import Parser, progress, whole
from proofs.shell.screen import say
from proofs.trusted.atlas import Cell, Region
from proofs.trusted.certificate import Malformed

_CHUNK, _TASKS = 16, 1000
_WAYS = {"in this process": (1, "here"), "two processes": (2, "here"), "Dask, two": (2, "dask:")}
EPILOG = """\
DIR has a finished atlas, best of some hundred to some thousand cells; it is only read. Overhead is
what is no work on cells, of head and workers together; start of processes and imports is left out.
CPU seconds hardly depend on who else uses the machine; seconds do. The line with Dask needs pip
install 'impact-proofs[cluster]'.

examples:
  python -m proofs atlas --eta 0.21 0.215 --nu -0.205 -0.195 --ask horseshoe
  python -m proofs.plane.scaling runs/atlas --pairs 3
"""


class Spent(NamedTuple):
    """Of a run: cells, their CPU seconds, those of workers and of the head, seconds; and the share
    of the seconds in which workers have work.
    """

    cells: int
    work: float
    workers: float
    head: float
    seconds: float
    busy: float

    @property
    def line(self) -> str:
        """The run in a line."""
        overhead = (self.head + self.workers) / self.work - 1
        return (
            f"{self.cells} cells, {self.work:.2f} CPU s on them; workers {self.workers:.2f}, head "
            f"{self.head:.2f} CPU s: overhead {100 * overhead:.1f} %; {self.seconds:.2f} s, "
            f"workers have work for {100 * self.busy:.0f} % of it"
        )


class Metered(Executor):
    """Another executor, with the CPU time of each of its processes, and how long it has work."""

    def __init__(self, inner: Executor) -> None:
        self._inner, self._ends = inner, dict[int, tuple[float, float]]()
        self.seconds = 0.0

    def submit(self, work: Callable[..., Any], /, *data: Any, **more: Any) -> Future[Any]:
        """Return what the work gives, and note what its process had used before and after."""
        result: Future[Any] = Future()

        def done(timed: Future[Any]) -> None:
            if (error := timed.exception()) is not None:
                result.set_exception(error)
                return
            process, began, ended, seconds, given = timed.result()
            self.seconds += seconds
            first, last = self._ends.get(process, (began, ended))
            self._ends[process] = min(first, began), max(last, ended)
            result.set_result(given)

        self._inner.submit(_timed, work, *data).add_done_callback(done)
        return result

    @property
    def workers(self) -> float:
        """The CPU seconds of other processes, from the first work to the last."""
        others = (ends for process, ends in self._ends.items() if process != os.getpid())
        return sum(last - first for first, last in others)


def _timed(work: Callable[..., Any], *data: Any) -> tuple[int, float, float, float, Any]:
    clock, began = perf_counter(), process_time()
    given = work(*data)
    return os.getpid(), began, process_time(), perf_counter() - clock, given


class Replay(Here):
    """Returns rows that are known, without work."""

    def __init__(self, rows: dict[str, Cell]) -> None:
        self._rows = rows

    def submit(self, work: Callable[..., Any], /, *data: Any, **more: Any) -> Future[Any]:
        """Return the rows of the cells that are asked for."""
        return super().submit(lambda: [self._rows[key] for key, _ in data[-1]])


def main(arguments: list[str] | None = None) -> int:
    """Measure, and print; return the exit status."""
    parser = Parser("proofs.plane.scaling", __doc__, EPILOG)
    parser.add_argument("folder", type=Path, metavar="DIR")
    pairs = "how often each is measured (default 1)"
    parser.add_argument("--pairs", type=whole("--pairs", 100), default=1, metavar="N", help=pairs)
    chunk = f"cells that go out together (default {_CHUNK})"
    parser.add_argument(
        "--chunk", type=whole("--chunk", 10_000), default=_CHUNK, metavar="N", help=chunk
    )
    options = parser.parse_args(arguments)
    try:
        with opened(options.folder, None) as store:
            region, rows = store.region, {row.key: row for row in store.rows()}
    except (Held, Malformed, OSError) as failure:
        parser.error(str(failure))
    if not rows:
        parser.error(f"{options.folder / NAME} has no cells")
    with progress() as tell:
        for line in _lines(region, rows, options.pairs, options.chunk, tell):
            say(line)
    return 0


def _lines(
    region: Region, rows: dict[str, Cell], pairs: int, chunk: int, tell: Callable[[str], None]
) -> Iterator[str]:
    size = sum(len(pickle.dumps(row)) for row in rows.values()) / len(rows)
    for name, (jobs, where) in pairs * [*_WAYS.items()]:
        if where == "here" or find_spec("distributed") is not None:
            tell(name)
            yield f"{name}: {_again(region, rows, chunk, jobs, where).line}"
    tell("the head")
    spent, stored = _replayed(region, rows)
    yield f"the head alone: {spent / len(rows) * 1e6:.0f} CPU microseconds a row"
    yield f"a row: {size:.0f} bytes on the way, {stored / len(rows):.0f} in the store"
    if find_spec("distributed") is not None:
        tell("the scheduler")
        spent, seconds = _scheduled(int(chunk * size))
        yield (
            f"Dask's scheduler: {_TASKS} chunks of {chunk} rows without work, "
            f"{spent / _TASKS * 1e3:.2f} CPU milliseconds each, {_TASKS / seconds:.0f} a second"
        )


def _again(region: Region, rows: dict[str, Cell], chunk: int, jobs: int, where: str) -> Spent:
    """Compute all cells again, in a store of their own."""
    depth = max(len(key.partition("/")[2]) for key in rows)
    with (
        tempfile.TemporaryDirectory() as folder,
        opened(Path(folder), region) as store,
        executor(jobs, where) as (pool, count),
    ):
        wait([pool.submit(_warm) for _ in range(4 * count)])
        metered = Metered(pool)
        clock, head = perf_counter(), process_time()
        cells = run(store, depth, (metered, count), chunk)
        head, seconds = process_time() - head, perf_counter() - clock
        busy = metered.seconds / (count * seconds)
        return Spent(cells, store.seconds(), metered.workers, head, seconds, busy)


def _warm() -> None:
    """Import what cells need."""
    from proofs.plane import cells  # noqa: F401


def _replayed(region: Region, rows: dict[str, Cell]) -> tuple[float, int]:
    """Return the head's CPU seconds for rows that come at once, and the bytes of the store."""
    depth = max(len(key.partition("/")[2]) for key in rows)
    with tempfile.TemporaryDirectory() as folder:
        with opened(Path(folder), region) as store:
            head = process_time()
            run(store, depth, (Replay(rows), 1), _CHUNK)
            head = process_time() - head
        return head, (Path(folder) / NAME).stat().st_size


def _scheduled(size: int) -> tuple[float, float]:
    """Return CPU seconds of client and scheduler, and seconds, for tasks without work."""
    with executor(2, "dask:") as (pool, _):
        wait([pool.submit(os.urandom, size) for _ in range(8)])
        clock, spent = perf_counter(), process_time()
        for future in [pool.submit(os.urandom, size) for _ in range(_TASKS)]:
            future.result()
        return process_time() - spent, perf_counter() - clock
