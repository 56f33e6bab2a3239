"""A limit on the processor time that one case may take."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager


class TookTooLong(BaseException):
    """The time is over. No Exception, so that nobody's `except Exception` takes it."""


@contextmanager
def limited(seconds: float) -> Iterator[None]:
    """Raise TookTooLong after so many seconds of work, where the system has such an alarm.

    It is raised again each second: what is raised while an object is finalised is lost.
    """
    if not hasattr(signal, "SIGVTALRM") or threading.current_thread() != threading.main_thread():
        yield
        return

    def stop(number: int, frame: object) -> None:
        raise TookTooLong

    before = signal.signal(signal.SIGVTALRM, stop)
    signal.setitimer(signal.ITIMER_VIRTUAL, seconds, 1.0)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
        signal.signal(signal.SIGVTALRM, before)
