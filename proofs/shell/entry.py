"""The way into every command: what signals, closed pipes and full disks do to it.

Standard library alone, so that the checker has it too, and quick to import: a command's own
imports take place inside `launch`, where an interrupt is an interrupt already.
"""

from __future__ import annotations

import gc
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
_SIGNALS: dict[int, str] = {signal.SIGINT: "interrupted", signal.SIGTERM: "terminated"}
_HAS_ALARM = hasattr(signal, "setitimer")  # not on Windows
_SELDOM = 50_000  # new objects: few of those here are in cycles
_MAIN = os.getpid()  # a forked process has this module, and another number


class Stopped(KeyboardInterrupt):
    """The process is asked to end, by a signal."""


def launch(module: str) -> NoReturn:
    """End the process with the status that a command returns, given by its module or package.

    It ends at once: all is written and closed, and to take its objects apart takes a tenth of the
    main job. Who traces or profiles it sees it leave in the ordinary way.
    """
    name = module.removesuffix(".__main__").replace(".commands", "")
    prog = f"python -m {name.replace('.', ' ', 1)}"
    gc.set_threshold(_SELDOM)
    status = guarded(prog, lambda: run_command(module))
    if sys.gettrace() is None and sys.getprofile() is None:
        os._exit(status)
    sys.exit(status)


def run_command(module: str, arguments: list[str] | None = None) -> int:
    """Import a command, and return the status of its `main`; a package's is in its `__main__`."""
    command = import_module(module)
    if hasattr(command, "__path__"):
        command = import_module(f"{module}.__main__")
    return int(command.main(arguments))


def guarded(prog: str, work: Callable[[], int]) -> int:
    """Return the status of the work, or of what ended it, said in a line that begins with `prog`.

    130 and 143 after SIGINT and SIGTERM, which the notes of what they raised follow; 141 where the
    reader of standard output has gone, 2 where something cannot be written, this as well.
    """
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:  # closed by who started this
            setattr(sys, name, os.fdopen(os.open(os.devnull, os.O_WRONLY), "w"))
    received: list[int] = []  # C code turns what a signal raises into errors of its own
    try:
        with _listening(received):
            return _flushed(work)
    except BaseException as error:
        if received or isinstance(error, KeyboardInterrupt):
            number = next(iter(received), int(signal.SIGINT))
            more = "".join(f"; {note}" for note in getattr(error, "__notes__", ()))
            return _ended(128 + number, f"{prog}: {_SIGNALS[number]}{more}")
        if isinstance(error, BrokenPipeError):
            return _ended(PIPE_CLOSED)
        if isinstance(error, OSError):
            where = "" if error.filename is None else f"{error.filename}: "
            return _ended(USAGE_ERROR, f"{prog}: {where}{error.strerror or error}")
        raise


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
def _listening(received: list[int]) -> Iterator[None]:
    """Have a signal raise Stopped, and note its number; a second one ends the process at once.

    SIGALRM repeats it: what is raised while an object is finalised is lost, and is not reported
    here. A signal that is ignored, as in a background job, stays ignored; all are when the work is
    done, so that its status is that of the process.
    """
    report = sys.unraisablehook

    def lose(lost: sys.UnraisableHookArgs) -> None:
        if not isinstance(lost.exc_value, Stopped):
            report(lost)

    def stop(number: int, frame: FrameType | None) -> None:
        if os.getpid() != _MAIN:  # a forked process ends with its parent, and says nothing
            os._exit(128 + number)
        received.append(number)
        leave_to_system()
        if _HAS_ALARM:
            signal.signal(signal.SIGALRM, lambda again, frame: stop(number, frame))
            signal.setitimer(signal.ITIMER_REAL, 0.2)
        raise Stopped

    sys.unraisablehook = lose
    for number in _SIGNALS:
        if signal.getsignal(number) is not signal.SIG_IGN:
            signal.signal(number, stop)
    try:
        yield
    finally:
        if _HAS_ALARM:
            signal.signal(signal.SIGALRM, signal.SIG_IGN)
        for number in _SIGNALS:
            if signal.getsignal(number) is stop:
                signal.signal(number, signal.SIG_IGN)


def leave_to_system() -> None:
    """Let signals that are not ignored end the process, silently."""
    for number in _SIGNALS:
        if signal.getsignal(number) is not signal.SIG_IGN:
            signal.signal(number, signal.SIG_DFL)


@contextmanager
def workers(count: int) -> Iterator[ProcessPoolExecutor]:
    """Yield a pool of processes; where the work inside is given up, they end at once with it."""
    import threading
    from concurrent.futures import ProcessPoolExecutor
    from multiprocessing import active_children

    others = active_children()
    with ProcessPoolExecutor(count, initializer=leave_to_system) as pool:
        try:
            yield pool
        except BaseException:
            threading.excepthook = lambda lost: None  # the pool's own, at pipes that are closed
            for process in active_children():
                if process not in others:
                    process.terminate()
            raise
