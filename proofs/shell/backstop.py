"""The operating system's limits behind the checker's meter, for what that does not see."""

from __future__ import annotations

import math
import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from time import process_time
from typing import Any, NoReturn

from proofs.trusted.kernel.meter import DEFAULT

SECONDS, BYTES = 3e-6, 60  # for a unit of work: three times what it takes at most


class Overrun(BaseException):
    """The time is used up. No Exception, so that nobody's `except Exception` takes it."""


@contextmanager
def within(seconds: float, clock: str = "REAL") -> Iterator[None]:
    """End what is done inside by Overrun after so many seconds, where the system has such an alarm.

    clock: REAL, or VIRTUAL for seconds of work. It is raised again each second: what is raised
    while an object is finalised is lost.
    """
    if not hasattr(signal, "setitimer") or threading.current_thread() != threading.main_thread():
        yield
        return
    timer = getattr(signal, f"ITIMER_{clock}")
    sent = {"REAL": signal.SIGALRM, "VIRTUAL": signal.SIGVTALRM}[clock]
    before = signal.signal(sent, _overrun)
    try:
        signal.setitimer(timer, max(seconds, 1e-6), 1.0)
        yield
    finally:
        with suppress(Overrun):  # one that comes just now
            signal.setitimer(timer, 0)
        signal.setitimer(timer, 0)
        signal.signal(sent, before)


@contextmanager
def limited(work: float) -> Iterator[None]:
    """End what is done inside by Overrun or MemoryError where it takes far more than its work.

    It is the soft limits of this process that are set, and set back; workers inherit them. Where
    the platform has none, and in a thread, there is the meter alone.
    """
    try:
        import resource
    except ImportError:
        yield
        return
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    time, memory = resource.RLIMIT_CPU, resource.RLIMIT_AS
    work = max(work, DEFAULT)
    wanted = {time: math.ceil(process_time() + SECONDS * work)}
    with suppress(OSError):  # where it is told: on Linux
        pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0])
        wanted[memory] = pages * resource.getpagesize() + int(BYTES * work)
    before = {kind: resource.getrlimit(kind) for kind in wanted}
    handler = signal.signal(signal.SIGXCPU, _overrun)
    try:
        for kind, (soft, hard) in before.items():
            ends = [x for x in (soft, hard) if x != resource.RLIM_INFINITY]
            resource.setrlimit(kind, (min(wanted[kind], 2**62, *ends), hard))
        yield
    finally:
        for kind, own in before.items():
            resource.setrlimit(kind, own)
        signal.signal(signal.SIGXCPU, handler)


def _overrun(number: int, frame: Any) -> NoReturn:
    """Raise Overrun; the system says it again each second."""
    raise Overrun
