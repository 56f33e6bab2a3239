"""The head of a run: chunks of cells go out to an executor, rows come back into the store."""

from __future__ import annotations

import signal
from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_COMPLETED, Executor, Future, wait
from contextlib import contextmanager
from logging import CRITICAL
from typing import Any

from proofs.plane.cells import decide
from proofs.plane.store import SPLIT, Row, Store, quarters
from proofs.shell.entry import workers

_AHEAD = 2  # chunks for each worker
_PATIENCE = 5  # seconds, with a scheduler that does not answer


class Here(Executor):
    """Does work at once, in this process."""

    def submit(self, work: Callable[..., Any], /, *data: Any, **more: Any) -> Future[Any]:
        """Return what is done already; what the work raises is raised here."""
        done: Future[Any] = Future()
        done.set_result(work(*data, **more))
        return done


@contextmanager
def executor(jobs: int, where: str) -> Iterator[tuple[Executor, int]]:
    """Yield what does the work, and how many workers it has.

    where: "here", for this machine, jobs processes; "dask:ADDRESS", for a Dask scheduler, "dask:"
    for one of its own with so many processes.
    """
    if where == "here" and jobs == 1:
        yield Here(), 1
    elif where == "here":
        with workers(jobs) as pool:
            yield pool, jobs
    else:
        from distributed import Client

        address = where.removeprefix("dask:")
        own = {"n_workers": jobs, "threads_per_worker": 1, "dashboard_address": None}
        own |= {"silence_logs": CRITICAL}
        with _uninterrupted():  # workers end with their head, and have nothing to say
            client = Client(address, timeout=_PATIENCE) if address else Client(**own)
        try:
            count = sum(client.nthreads().values()) or 1
            yield client.get_executor(pure=False), count
        finally:
            with _uninterrupted():
                client.close()


@contextmanager
def _uninterrupted() -> Iterator[None]:
    """Take no SIGINT, nor its repetition by an alarm; nor do processes that begin in here."""
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    if hasattr(signal, "setitimer"):  # not on Windows
        signal.setitimer(signal.ITIMER_REAL, 0)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


def run(
    store: Store,
    depth: int,
    doing: tuple[Executor, int],
    chunk: int,
    tell: Callable[[str], None] = lambda stage: None,
) -> int:
    """Look at all cells that are left, down to a depth; return how many were looked at.

    The last cells come first, so that few wait at a time, however many there are.
    """
    store.reopen(depth)
    waiting = store.left()[::-1]
    pool, count = doing
    out: set[Future[list[Row]]] = set()
    done = 0
    while waiting or out:
        while waiting and len(out) < _AHEAD * count:
            size = min(chunk, -(-len(waiting) // count))  # few cells are for all workers
            todo = [waiting.pop() for _ in range(size)]
            out.add(pool.submit(decide, store.region, depth, todo))
        ready, out = wait(out, return_when=FIRST_COMPLETED)
        for future in ready:
            rows = future.result()
            store.put(rows)
            done += len(rows)
            split = [row for row in rows if row.verdict == SPLIT]
            waiting += [(key, row.sets) for row in split[::-1] for key in quarters(row.key)[::-1]]
        tell(f"{done} cells, {len(waiting)} waiting")
    return done
