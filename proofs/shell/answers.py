"""What commands that answer a question share: digits, bounds in words, the machine form."""

from __future__ import annotations

import json
from argparse import Namespace
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from intervals import decimal_bounds
from proofs.shell.cli import Parser, add_stats, check_targets, counting, digits, write_target
from proofs.trusted.numbers import Range

Answer = dict[str, Any]  # the JSON object: decimal strings, rounded outward


def add_answer(parser: Parser, places: int = 30) -> None:
    """Add the options for the form of an answer, and for what is evaluated for it."""
    add, default = parser.add_argument, f"significant digits (default {places})"
    add("--digits", type=digits, default=places, help=default)
    add("--json", metavar="FILE", help="write the machine form to a file, or - for the screen")
    add_stats(parser)


def bounds(values: Range, places: int) -> dict[str, str]:
    """Write an enclosure with so many significant digits, rounded outward."""
    lower, upper = decimal_bounds(*values, places)
    return {"lower": lower, "upper": upper}


def lines(label: str, ends: dict[str, str], width: int = 18) -> list[str]:
    """Return written bounds below each other, for the screen."""
    return [f"  {label:{width}} [{ends['lower']},", f"  {'':{width}}  {ends['upper']}]"]


@contextmanager
def answering(parser: Parser, options: Namespace, asked: str, *more: str | None) -> Iterator[None]:
    """Try the files before the work inside the `with`; afterwards print what it evaluated.

    asked: in words. more: other files than that of --json. An exception, SystemExit for bad input
    as well, goes through, and no counts are printed.
    """
    targets = options.json, *more
    check_targets(parser, *targets)
    with counting(options.stats) as counts:
        yield
    if options.stats:
        from proofs.shell.counting import show

        show(counts, [asked], quiet="-" in targets)


def machine_text(answer: Answer) -> str:
    """Return the machine form."""
    return json.dumps(answer, indent=1) + "\n"


def give(parser: Parser, options: Namespace, answer: Answer, text: Callable[[Answer], str]) -> None:
    """Write the machine form where it is asked for, and print the answer in words."""
    write_target(parser, options.json, lambda: machine_text(answer))
    if options.json != "-":
        print(text(answer))
