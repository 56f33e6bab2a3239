"""What people read: words never broken, verdicts in colour, the gist of a theorem.

Importing this takes the standard library alone.
"""

from __future__ import annotations

import os
import re
import sys
from argparse import ArgumentParser, RawDescriptionHelpFormatter, _StoreAction
from collections.abc import Iterator, Sequence
from contextlib import suppress
from typing import IO, Any, NamedTuple, NoReturn

from proofs.shell.entry import USAGE_ERROR
from proofs.trusted.verdicts import Verdict
from proofs.version import VERSION

_LINE = 100  # of a claim
_WIDTH = 80  # where there is no terminal
_SENTENCE = re.compile(r"(?<=[^.]\.) ")
_OSCILLATOR = re.compile(
    r"^At \(eta, nu[a-z, ]*\) = \([^)]*\)(, for plastic impacts|, epsilon = [^:]*)?: "
)
_COLOURS = {  # of the terminal, by ECMA-48
    Verdict.VERIFIED: 32,
    Verdict.REFUTED: 31,
    Verdict.CONDITIONAL: 36,
    Verdict.UNDECIDED: 33,
    Verdict.SIMULATED: 35,
}


class Arguments(ArgumentParser):
    """A parser of a command's arguments whose errors are one line."""

    def __init__(self, prog: str, description: str | None, epilog: str) -> None:
        super().__init__(
            f"python -m {prog}", description=description, epilog=epilog, formatter_class=_Help
        )
        self.add_argument("--version", action="version", version=f"impact-proofs {VERSION}")

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> Any:
        """Refuse an option that is given twice: argparse would take the last one, and say nothing.

        What may be given several times appends.
        """
        given = [str(x).partition("=")[0] for x in (sys.argv[1:] if args is None else args)]
        for action in self._actions:
            names = [name for name in given if name in action.option_strings]
            if isinstance(action, _StoreAction) and len(names) > 1:
                self.error(f"{names[-1]} is given {len(names)} times")
        return super().parse_known_args(args, namespace)

    def _print_message(self, message: str, file: Any = None) -> None:
        """Print help and versions; argparse would keep quiet about a full disk or a closed pipe."""
        (file or sys.stderr).write(message)

    def error(self, message: str) -> NoReturn:
        """Print one line and leave with status 2."""
        self.exit(USAGE_ERROR, fitted(f"{self.prog}: {message}", sys.stderr) + "\n")


class _Help(RawDescriptionHelpFormatter):
    """Keeps the lines of descriptions and examples, unless the terminal is narrower."""

    def __init__(self, prog: str) -> None:
        super().__init__(prog, width=columns() - 2)

    def _fill_text(self, text: str, width: int, indent: str) -> str:
        return flowing(text)

    def _format_usage(self, *arguments: Any) -> str:
        usage = super()._format_usage(*arguments)
        fits = max(map(len, usage.split("\n"))) <= self._width + 2
        return usage if fits else f"usage: {self._prog} [OPTION ...]\n\n"


class Decided(NamedTuple):
    """A claim as the screen shows it."""

    id: str
    verdict: Verdict
    statement: str
    why: str


def columns() -> int:
    """Return the width of the terminal, as shutil does, which takes longer to import than this."""
    with suppress(ValueError):
        if (wanted := int(os.environ.get("COLUMNS", "0"))) > 0:
            return wanted
    with suppress(AttributeError, ValueError, OSError):  # closed, or no terminal
        return os.get_terminal_size(sys.__stdout__.fileno()).columns or _WIDTH  # type: ignore[union-attr]
    return _WIDTH


def fitted(text: str, stream: IO[str], hanging: int = 2) -> str:
    """Return a text whose lines fit a terminal, broken between words; elsewhere it stays.

    hanging: by how much the rest of a broken line is indented more than its beginning.
    """
    if not stream.isatty():
        return text
    from textwrap import wrap

    width, lines = columns(), []
    for line in _unfolded(text.split("\n"), width):
        indent = " " * (len(line) - len(line.lstrip()) + hanging)
        lines += wrap(
            line,
            width,
            subsequent_indent=indent,
            break_long_words=False,
            break_on_hyphens=False,
        ) or [""]
    return "\n".join(lines)


def flowing(text: str) -> str:
    """Return prose fitted to standard output, its lines joined to paragraphs if they are too long.

    Indented lines stay lines.
    """
    if sys.stdout.isatty() and max(map(len, text.split("\n"))) > columns():
        text = re.sub(r"(?<=[^\n])\n(?=[^\s])", " ", text)
    return fitted(text, sys.stdout)


def _unfolded(lines: Sequence[str], width: int) -> Iterator[str]:
    """Yield lines; the rows of a table that is too wide with the names of their columns."""
    names: list[str] = []
    for line in lines:
        cells = [cell.strip() for cell in line.strip("| ").split(" | ")]
        if not line.startswith("|") or len(line) <= width:
            names = []
            yield line
        elif not names:
            names = cells
        elif not set(line) <= set("|-"):
            values = zip(names[1:], cells[1:], strict=False)
            yield f"{cells[0]}: " + ", ".join(f"{name} {value}" for name, value in values)


def say(text: str, stream: IO[str] | None = None, hanging: int = 2) -> None:
    """Print a text to standard output, or another stream, fitted to the terminal."""
    stream = stream or sys.stdout
    print(fitted(text, stream, hanging), file=stream)


def show_verdicts(rows: Sequence[Decided], *, verbose: bool = True) -> None:
    """Print each claim in two lines, broken where a terminal has less room; there in colour.

    Not verbose: a line of at most 100 characters, and why only where nothing is decided.
    """
    colours = sys.stdout.isatty() and os.environ.get("TERM") != "dumb"
    for row in rows:
        word = row.verdict.value
        line = f"{row.id:4} {word:11} {row.statement}" if verbose else in_a_line(row)
        text = fitted(line, sys.stdout, hanging=5)
        if colours and not os.environ.get("NO_COLOR"):
            text = text.replace(word, f"\x1b[{_COLOURS[row.verdict]}m{word}\x1b[0m", 1)
        print(text)
        if verbose or row.verdict is Verdict.UNDECIDED:
            say(f"     {row.why}", hanging=0)


def in_a_line(row: Decided, width: int = _LINE) -> str:
    """Return a claim in a line, without the oscillator if that stands at its beginning."""
    said = _OSCILLATOR.sub("", row.statement)
    line = f"{row.id:4} {row.verdict.value:11} {said}"
    return line if len(line) <= width else f"{line[: width - 4].rsplit(' ', 1)[0]} ..."


def gist(theorem: str) -> str:
    """Return the first two assertions of a theorem, with the definitions before them.

    What is left out only asserts more: a hypothesis stands before what it is needed for.
    """
    kept: list[str] = []
    left = _SENTENCE.split(theorem)
    while left and sum(not sentence.startswith("Let ") for sentence in kept) < 2:
        kept.append(left.pop(0))
    return " ".join([*kept, "..."] if left else kept)
