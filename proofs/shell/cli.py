"""What the command lines share: exact numbers, one-line errors, files, counts, colour.

A command is a module `proofs.<name>`, or a package with a `__main__`, whose docstring begins with
the line that the list of commands shows, and which has `main(arguments=None)` that returns the
exit status. It begins, before its imports, with

    if __name__ == "__main__":
        from proofs.shell.entry import launch

        launch("proofs.<name>")

and needs nothing more: `launch` imports it and calls `main` where Ctrl-C, SIGTERM, a closed pipe
and a full disk end the process with a line and the status that is due, no traceback. So an OSError
need not be caught, nor KeyboardInterrupt. Processes of its own it takes from `entry.workers`, which
end with it.
"""

from __future__ import annotations

import argparse
import os
import re
import sys
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from fractions import Fraction
from pathlib import Path
from time import monotonic
from typing import TYPE_CHECKING, Any, NoReturn

from intervals import fraction
from proofs.trusted.verdicts import Verdict

if TYPE_CHECKING:
    from proofs.shell.counting import Counts

USAGE_ERROR = 2
_DIGITS = 190  # numerator and denominator: certificates take 400 characters a number
_LARGEST = 10**_DIGITS
_LONGEST_FLIGHT = 10**6  # the checker looks no further


class Parser(argparse.ArgumentParser):
    """An argument parser whose errors are one line, and that takes -1/5 and -2e-3 for numbers."""

    def __init__(self, prog: str, description: str | None, epilog: str) -> None:
        super().__init__(
            prog=f"python -m {prog}",
            description=description,
            epilog=epilog,
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )
        self._negative_number_matcher = re.compile(r"^-[0-9.]")

    def _print_message(self, message: str, file: Any = None) -> None:
        """Print help and versions; argparse would keep quiet about a full disk or a closed pipe."""
        (file or sys.stderr).write(message)

    def error(self, message: str) -> NoReturn:
        """Print one line and leave with status 2."""
        self.exit(USAGE_ERROR, f"{self.prog}: {message}\n")


def number(text: str) -> Fraction:
    """Read an exact number for argparse."""
    try:
        value = fraction(text)
    except ValueError as error:
        raise argparse.ArgumentTypeError(str(error)) from None
    if max(abs(value.numerator), value.denominator) >= _LARGEST:
        raise argparse.ArgumentTypeError(f"more than {_DIGITS} digits: {text[:20]}...")
    return value


def whole(what: str, most: int) -> Callable[[str], int]:
    """Return what reads a whole number from 1 on for argparse."""

    def read(text: str) -> int:
        if not text.isascii() or not text.isdigit() or not 1 <= int(text[:19]) <= most:
            raise argparse.ArgumentTypeError(
                f"{what} is a whole number from 1 to {most}, not {text[:20]!r}"
            )
        return int(text)

    return read


digits = whole("digits", 1000)


def horizon(text: str) -> Fraction:
    """Read the longest flight looked at, for argparse."""
    value = number(text)
    if not 0 < value <= _LONGEST_FLIGHT:
        raise argparse.ArgumentTypeError(
            f"a horizon is a positive number up to {_LONGEST_FLIGHT}, not {text!r}"
        )
    return value


def check_targets(parser: Parser, *targets: str | None) -> None:
    """Leave with one line if files cannot be written or two are one, before any work is done.

    targets: names, "-" for the screen, None for no file.
    """
    wanted = [target for target in targets if target is not None]
    if len({_path(target) for target in wanted}) < len(wanted):
        parser.error(f"two outputs to {wanted[0]} exclude each other")
    for target in wanted:
        try:
            if target != "-":
                _try(_path(target))
        except OSError as error:
            parser.error(_unwritten(target, error))


def _try(path: Path) -> None:
    """Raise OSError if a file cannot be written; its folder is made."""
    if path.exists() and not path.is_file():  # a rename would replace a device
        raise OSError("not a regular file")
    _try_folder(path.parent)


def writable(parser: Parser, folder: Path) -> None:
    """Leave with one line if nothing can be written to the folder, before any work is done."""
    try:
        _try_folder(folder)
    except OSError as error:
        parser.error(f"cannot write to {folder}: {error.strerror or error}")


def _try_folder(folder: Path) -> None:
    """Raise OSError if nothing can be written to a folder, which is made."""
    folder.mkdir(parents=True, exist_ok=True)
    trial = folder / f".trial.{os.getpid()}"
    trial.touch(exist_ok=False)
    trial.unlink()


def write_target(parser: Parser, target: str | None, content: Callable[[], str]) -> None:
    """Write what `content` returns to the file or the screen; leave with one line on failure."""
    if target == "-":
        print(content(), end="")
    elif target is not None:
        from proofs.trusted.certificate import write_atomically

        try:
            write_atomically(_path(target), content())
        except OSError as error:
            parser.error(_unwritten(target, error))


def _unwritten(target: str, error: OSError) -> str:
    return f"cannot write {target!r}: {error.strerror or error}"


def _path(target: str) -> Path:
    """Return the file itself: what a link leads to is replaced, not the link."""
    return Path(os.path.realpath(target))


def add_stats(parser: argparse.ArgumentParser) -> None:
    """Add the option to count what is evaluated."""
    help_text = "count what is evaluated (takes three times as long)"
    parser.add_argument("--stats", action="store_true", help=help_text)


def counting(wanted: bool) -> AbstractContextManager[Counts]:
    """Return what counts evaluations inside a `with` if that is wanted, else what does nothing."""
    if not wanted:
        return nullcontext(Counter())
    from proofs.shell.counting import counted

    return counted()


@contextmanager
def progress(after: float = 1.0) -> Iterator[Callable[[str], None]]:
    """Yield a function that shows a stage on a terminal once the work takes over `after` seconds.

    The line is on standard error, is overwritten by the next stage and wiped at the end.
    """
    began, shown = monotonic(), False

    def tell(stage: str) -> None:
        nonlocal shown
        if sys.stderr.isatty() and monotonic() - began > after:
            print(f"\r\x1b[K{monotonic() - began:.0f} s: {stage} ...", end="", file=sys.stderr)
            sys.stderr.flush()
            shown = True

    try:
        yield tell
    finally:
        if shown:
            print("\r\x1b[K", end="", file=sys.stderr)


_COLOURS = {
    Verdict.VERIFIED: "32",
    Verdict.REFUTED: "31",
    Verdict.CONDITIONAL: "36",
    Verdict.UNDECIDED: "33",
    Verdict.SIMULATED: "35",
}


def coloured(verdict: Verdict) -> str:
    """Return the verdict padded, in colour on a terminal (and not where NO_COLOR is set)."""
    word = f"{verdict.value:11}"
    if sys.stdout.isatty() and "NO_COLOR" not in os.environ:
        return f"\x1b[{_COLOURS[verdict]}m{word}\x1b[0m"
    return word
