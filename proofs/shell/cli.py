"""What the command lines share: options, exact numbers, one-line errors, progress.

A command is a row of `proofs.commands.groups`; or a module `proofs.<name>`, or a package with a
`__main__`, whose docstring begins with the line that the list of commands shows, and which has
`main(arguments=None)` that returns the exit status. It begins, before its imports, with

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
import re
import sys
from argparse import Namespace
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from time import monotonic
from typing import Any

from intervals import Undecided, fraction
from proofs.motion.digits import MOST_DIGITS
from proofs.shell.screen import Arguments, columns
from proofs.trusted.numbers import show
from proofs.trusted.parameters import PAPER, Parameters

_DIGITS = 190  # numerator and denominator: certificates take 400 characters a number
_LARGEST = 10**_DIGITS
_TELLING: ContextVar[Callable[[str], None] | None] = ContextVar("telling", default=None)
_LONGEST_FLIGHT = 10**6  # the checker looks no further


class Parser(Arguments):
    """A parser of arguments that takes -1/5 for a number, and -x for a formula."""

    def __init__(self, prog: str, description: str | None, epilog: str) -> None:
        super().__init__(prog, description, epilog)
        self._negative_number_matcher = re.compile(r"^-[^-]")


def number(text: str) -> Fraction:
    """Read an exact number for argparse."""
    try:
        value = fraction(text)
    except ValueError as error:
        raise argparse.ArgumentTypeError(str(error)) from None
    if max(abs(value.numerator), value.denominator) >= _LARGEST:
        raise argparse.ArgumentTypeError(f"more than {_DIGITS} digits: {text[:20]}...")
    return value


def whole(what: str, most: int, least: int = 1) -> Callable[[str], int]:
    """Return what reads a whole number for argparse."""

    def read(text: str) -> int:
        short = text.isascii() and text.isdigit() and len(text) < 20  # before it is read
        if not (short and least <= int(text) <= most):
            raise argparse.ArgumentTypeError(
                f"{what} is a whole number from {least} to {most}, not {text[:20]!r}"
            )
        return int(text)

    return read


digits = whole("digits", MOST_DIGITS)


def horizon(text: str) -> Fraction:
    """Read the longest flight looked at, for argparse."""
    value = number(text)
    if not 0 < value <= _LONGEST_FLIGHT:
        raise argparse.ArgumentTypeError(
            f"a horizon is a positive number up to {_LONGEST_FLIGHT}, not {text!r}"
        )
    return value


def share(parser: Parser, *names: str, places: int = 30, claims: Sequence[str] = ()) -> None:
    """Add options that mean the same in every command that has them.

    places: the digits where none are asked for. claims: of which --only is a choice.
    """
    options: dict[str, dict[str, Any]] = {
        "--only": {"nargs": "+", "choices": claims, "metavar": "ID"}
        | {"help": f"claims, of {' '.join(claims)}"},
        "--digits": {"type": digits, "default": places, "metavar": "N"}
        | {"help": f"significant digits (default {places})"},
        "--out": {"type": Path, "metavar": "DIR", "help": "the folder that results go to"},
        "--json": {"metavar": "FILE", "help": "write the machine form to a file, - for the screen"},
        "--quiet": {"action": "store_true", "help": "print nothing but errors"},
    }
    for name in names:
        parser.add_argument(name, **options[name])


def heard(options: Namespace) -> bool:
    """Whether words are printed: not if the screen is for machines, or for nothing."""
    return not options.quiet and "-" not in (options.json, getattr(options, "csv", None))


@contextmanager
def progress(after: float = 1.0) -> Iterator[Callable[[str], None]]:
    """Yield a function that tells the stage of the work inside the `with`; "" wipes the line.

    On a terminal the last stage is shown on standard error, with the seconds, once the work takes
    longer than `after`, and then every second; the line is wiped at the end. Inside another one
    the line is the other's.
    """
    outer = _TELLING.get()
    if outer is not None or not sys.stderr.isatty():
        yield outer or (lambda stage: None)
        return
    from textwrap import shorten
    from threading import Event, Lock, Thread

    began, stage, drawn, over, drawing = monotonic(), "at work", "", Event(), Lock()

    def draw(line: str) -> None:
        nonlocal drawn
        if line != drawn:
            print(f"\r\x1b[K{line}", end="", file=sys.stderr, flush=True)
            drawn = line

    def tell(what: str) -> None:
        nonlocal stage
        with drawing:
            stage = what
            if not stage:
                draw("")

    def show() -> None:
        while not over.wait(after):
            with drawing:
                line = f"{monotonic() - began:.0f} s: {stage}" if stage else ""
                draw(shorten(line, columns() - 1, placeholder=" ..."))

    thread = Thread(target=show, daemon=True)
    thread.start()
    token = _TELLING.set(tell)
    try:
        yield tell
    finally:
        _TELLING.reset(token)
        over.set()
        thread.join()
        tell("")


Box = tuple[Fraction, Fraction, Fraction]
_MEANING = {
    "eta": "frequency ratio",
    "nu": "amplitude -beta/p",
    "left": "I0",
    "right": "I1",
    "interval": "I (default: from the left end of I0 to the right end of I1)",
    "slopes": "bounds of f'",
    "epsilon": "of restitution",
    "velocities": "range of velocities gamma",
    "reach": "box around eta, nu, epsilon, less if need be to stay in the model",
}


def add_parameters(parser: Parser, heeded: Iterable[str], *, beyond: bool) -> None:
    """Add the options for those numbers of a statement that are heeded, by default the paper's.

    beyond: whether the statement is not the paper's: then impacts are plastic if not said.
    """
    for name in heeded:
        value, meaning = getattr(PAPER, name), _MEANING[name]
        several: dict[str, Any] = {}
        if isinstance(value, tuple):
            several = {"nargs": len(value), "metavar": ("A", "B", "C")[: len(value)]}
        if name == "epsilon" and beyond:
            meaning += " (default: plastic impacts)"
        elif name != "interval":
            numbers = value if several else (value,)
            meaning += f" (default {' '.join(map(show, numbers))})"
        parser.add_argument(f"--{name}", type=number, help=meaning, **several)


def refusal(unknown: Sequence[str], heeded: Sequence[str]) -> str:
    """Say why options are not taken: at times as nothing here depends on them."""
    names = [option.partition("=")[0] for option in unknown]
    if not any(name.removeprefix("--") in _MEANING for name in names):
        return f"unrecognized arguments: {' '.join(unknown)}"
    taken = ", ".join(f"--{name}" for name in heeded) or "no numbers"
    return f"{names[0]} would change nothing here: what is proved depends on {taken}"


def parameters(options: Namespace, heeded: Iterable[str], *, beyond: bool) -> Parameters:
    """Return the statement's numbers; those printed for s_0 go with the printed slopes only.

    At another oscillator than the paper's, I0, I1 and the slopes that are not given are found, if
    there is a horseshoe: `own_sets`.
    """
    given = {name: value for name in heeded if (value := getattr(options, name)) is not None}
    given = {name: tuple(x) if isinstance(x, list) else x for name, x in given.items()}
    reach = given.pop("reach", None)
    left, right = given.get("left", PAPER.left), given.get("right", PAPER.right)
    interval = given.get("interval", (left[0], right[1]))
    plain = replace(PAPER, **{**given, "interval": interval}, reach=None)
    if beyond:
        return replace(plain, epsilon=given.get("epsilon"), velocities=None)
    numbers = _with_sets(plain, given, "slopes" in heeded)
    if numbers.slopes != PAPER.slopes:
        numbers = replace(numbers, ratios=None, printed_s0=None)
    return replace(numbers, reach=_reach(numbers, reach, "reach" in heeded))


def _with_sets(numbers: Parameters, given: Mapping[str, Any], is_found: bool) -> Parameters:
    """Return the numbers, at another oscillator with sets that are found unless some are given.

    Undecided where none are found: the paper's are not meant there.
    """
    elsewhere = (numbers.eta, numbers.nu) != (PAPER.eta, PAPER.nu)
    if is_found and elsewhere and not {"left", "right", "interval"} & {*given}:
        from proofs.search.shifts import own_sets

        sets = own_sets(numbers)
        if sets is None:
            raise Undecided(
                f"no sets with a horseshoe are seen at {numbers.place}: give --left and --right, "
                "or see python -m proofs explore"
            )
        return replace(sets, slopes=given.get("slopes", sets.slopes))
    return numbers


def _reach(numbers: Parameters, given: Box | None, is_heeded: bool) -> Box | None:
    """Return the box asked for, else the paper's, narrowed where the numbers leave less room.

    Where it is not heeded, there is none rather than a narrower one.
    """
    epsilon = numbers.epsilon or Fraction(0)
    if given is None:
        room = numbers.eta / 2, abs(numbers.nu) / 2, min(epsilon, (1 - epsilon) / 2)
        first, second, third = map(min, PAPER.reach or room, room)
        narrowed = first, second, third
        return narrowed if is_heeded or narrowed == PAPER.reach else None
    if given[2] > epsilon:
        raise ValueError("reach: epsilon must stay in [0, 1)")
    return given
