"""What commands that answer a question share: digits, bounds in words, the machine form.

In the machine form exact numbers and bounds are strings, bounds rounded outward; counts are
integers, and what does not exist is null.
"""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from intervals import decimal_bounds
from proofs.shell.cli import Parser, heard, progress, share
from proofs.shell.files import check_targets, write_target
from proofs.shell.screen import say
from proofs.trusted.files import render
from proofs.trusted.numbers import Range

Answer = dict[str, Any]  # the JSON object


def add_answer(parser: Parser, places: int = 30) -> None:
    """Add the options for the form of an answer."""
    share(parser, "--digits", "--json", "--quiet", places=places)


def bounds(values: Range, places: int) -> dict[str, str]:
    """Write an enclosure with so many significant digits, rounded outward."""
    lower, upper = decimal_bounds(*values, places)
    return {"lower": lower, "upper": upper}


def lines(label: str, ends: dict[str, str], width: int = 18) -> list[str]:
    """Return written bounds below each other, for the screen."""
    return [f"  {label:{width}} [{ends['lower']},", f"  {'':{width}}  {ends['upper']}]"]


@contextmanager
def answering(
    parser: Parser, options: Namespace, *more: str | None
) -> Iterator[Callable[[str], None]]:
    """Try the files before the work inside the `with`: that of --json, and more.

    Yields what tells the stage of the work, which is shown once it takes over a second.
    """
    check_targets(parser, options.json, *more)
    with progress() as options.tell:
        yield options.tell


def machine_text(parser: Parser, answer: Answer) -> str:
    """Return the machine form, with the schema of the command's answers."""
    schema = f"impact-proofs.{parser.prog.rpartition(' ')[2]}/1"
    return render({"schema": schema, **answer})


def give(parser: Parser, options: Namespace, answer: Answer, text: Callable[[Answer], str]) -> None:
    """Write the machine form where it is asked for, and print the answer in words."""
    options.tell("")
    write_target(parser, options.json, lambda: machine_text(parser, answer))
    if heard(options):
        say(text(answer))
