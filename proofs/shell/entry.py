"""The way into every command: what signals, closed pipes and full disks do to it.

Standard library alone, so that the checker has it too, and quick to import: a command's own
imports take place inside `launch`, where an interrupt is an interrupt already.
"""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from importlib import import_module
from typing import TYPE_CHECKING, NoReturn

if TYPE_CHECKING:
    from concurrent.futures import ProcessPoolExecutor
    from types import FrameType

USAGE_ERROR, PIPE_CLOSED = 2, 128 + 13
_SIGNALS = {signal.SIGINT: "interrupted", signal.SIGTERM: "terminated"}
_HAS_ALARM = hasattr(signal, "setitimer")  # not on Windows
_MAIN = os.getpid()  # a forked process has this module, and another number


class Stopped(KeyboardInterrupt):
    """The process is asked to end, by the signal of this number."""

    def __init__(self, number: int) -> None:
        super().__init__()
        self.number = number


def launch(module: str) -> NoReturn:
    """End the process with the status that `main` of a module returns, told how it is asked for."""
    prog = f"python -m {module.removesuffix('.__main__')}"
    sys.exit(guarded(prog, lambda: int(import_module(module).main())))


def guarded(prog: str, work: Callable[[], int]) -> int:
    """Return the status of the work, or of what ended it, said in a line that begins with `prog`.

    130 and 143 after SIGINT and SIGTERM, 141 where the reader of standard output has gone, 2 where
    something cannot be written, standard output as well.
    """
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:  # closed by who started this
            setattr(sys, name, os.fdopen(os.open(os.devnull, os.O_WRONLY), "w"))
    try:
        with _listening():
            return _flushed(work)
    except BrokenPipeError:
        return _ended(PIPE_CLOSED)
    except KeyboardInterrupt as stop:
        number = getattr(stop, "number", signal.SIGINT)
        return _ended(128 + number, f"{prog}: {_SIGNALS[number]}")
    except OSError as error:
        where = "" if error.filename is None else f"{error.filename}: "
        return _ended(USAGE_ERROR, f"{prog}: {where}{error.strerror or error}")


def _flushed(work: Callable[[], int]) -> int:
    """Return the status of the work after all that it printed is written."""
    try:
        status = work()
    except SystemExit as leaving:  # as argparse does
        status = leaving.code if isinstance(leaving.code, int) else int(bool(leaving.code))
    sys.stdout.flush()
    sys.stderr.flush()
    return status


def _ended(status: int, line: str = "") -> int:
    """Say why in a line; what is left to be printed is lost, as nobody takes it."""
    with suppress(OSError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    with suppress(OSError):
        if line:
            print(line, file=sys.stderr, flush=True)
    return status


@contextmanager
def _listening() -> Iterator[None]:
    """Have signals raise Stopped; after the first, and afterwards, they end the process at once.

    SIGALRM repeats it: what is raised while an object is finalised is lost, and is not reported
    here. A signal that is ignored, as in a background job, stays ignored.
    """
    report = sys.unraisablehook

    def lose(lost: sys.UnraisableHookArgs) -> None:
        if not isinstance(lost.exc_value, Stopped):
            report(lost)

    def stop(number: int, frame: FrameType | None) -> None:
        if os.getpid() != _MAIN:  # a forked process ends with its parent, and says nothing
            os._exit(128 + number)
        leave_to_system()
        if _HAS_ALARM:
            signal.signal(signal.SIGALRM, lambda again, frame: stop(number, frame))
            signal.setitimer(signal.ITIMER_REAL, 0.2)
        raise Stopped(number)

    sys.unraisablehook = lose
    for number in _SIGNALS:
        if signal.getsignal(number) is not signal.SIG_IGN:
            signal.signal(number, stop)
    try:
        yield
    finally:
        if _HAS_ALARM:
            signal.signal(signal.SIGALRM, signal.SIG_IGN)
        leave_to_system()


def leave_to_system() -> None:
    """Let signals that are not ignored end the process, silently."""
    for number in _SIGNALS:
        if signal.getsignal(number) is not signal.SIG_IGN:
            signal.signal(number, signal.SIG_DFL)


@contextmanager
def workers(count: int) -> Iterator[ProcessPoolExecutor]:
    """Yield a pool of processes; where the work inside is given up, they end at once with it."""
    from concurrent.futures import ProcessPoolExecutor
    from multiprocessing import active_children

    others = active_children()
    with ProcessPoolExecutor(count, initializer=leave_to_system) as pool:
        try:
            yield pool
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            for process in active_children():
                if process not in others:
                    process.terminate()
            raise
