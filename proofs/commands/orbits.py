"""All periodic points of the plastic impact map that a horseshoe has, one for each word.

A word such as 0010 says in which of I0, I1 the successive impacts lie. First the horseshoe is
proved: f is C^1 and monotone on I0 and I1, |f'| > 1, and both images cover I, which reaches from
the left end of I0 to the right end of I1. For sets that are given, f increases there and the phases
between them leave I; at other eta and nu they are found if they are not given. So each word has
exactly one phase with that itinerary that repeats it for ever, and no other phase is periodic with
its orbit in I0 and I1. Then each phase is enclosed, with its multiplier: the derivative of f^n
there, n the length of the word (for a word such as 0101, of period 2, the square of that of its
orbit).
"""

from __future__ import annotations

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.commands.orbits")

import csv
import io
import sys
from argparse import ArgumentTypeError, Namespace
from dataclasses import replace
from fractions import Fraction
from time import perf_counter
from typing import TYPE_CHECKING

from intervals import IntervalError, Undecided
from proofs.shell.answers import Answer, add_answer, answering, bounds, give, lines
from proofs.shell.cli import Parser, number, whole
from proofs.shell.files import write_target
from proofs.trusted.numbers import show, show_range
from proofs.trusted.parameters import PAPER, Parameters

if TYPE_CHECKING:
    from proofs.methods.orbits import PeriodicPoint

LEFT, RIGHT = (Fraction("1.1"), Fraction("1.15")), PAPER.right
_LONGEST_PERIOD = 16
_LONGEST_WORD = 256
_SHOWN = 16  # rows on the screen
_ENDS = ("lower", "upper")

EPILOG = """\
Numbers are exact: 0.2121 is 2121/10000; 7/5 and 2e-3 are fine too. The table shows the first
rows only; --csv and --json have all of them, in bounds that are rounded outward.

exit status: 0 all points are proved and enclosed, 1 undecided: the horseshoe is not proved,
             2 bad input

examples:
  python -m proofs orbits --period 3
  python -m proofs orbits --word 0010 --digits 50
  python -m proofs orbits --eta 0.103 --nu 0.541 --period 2     the sets are found there
  python -m proofs orbits --period 12 --csv orbits.csv
"""


def main(arguments: list[str] | None = None) -> int:
    """Enclose the periodic points asked for; return the exit status."""
    parser = _parser()
    options = parser.parse_args(arguments)
    try:
        statement = _parameters(options)
    except ValueError as error:
        parser.error(str(error))
    with answering(parser, options, options.csv):
        return _answer(parser, statement, options)


def _answer(parser: Parser, statement: Parameters, options: Namespace) -> int:
    """Print or write the periodic points; return the exit status."""
    from proofs.search.periodic import horseshoe, of_words, own_horseshoe

    began = perf_counter()
    try:
        options.tell("the horseshoe")
        proved = horseshoe(statement) if options.left else own_horseshoe(statement)
        statement = proved.of
        points = of_words(proved, options.word or options.period, options.digits, options.tell)
    except (Undecided, IntervalError, OverflowError) as failure:
        print(f"{parser.prog}: UNDECIDED: {failure}", file=sys.stderr)
        return 1
    seconds = perf_counter() - began
    options.tell("")
    rows = [_row(point, options.digits) for point in points]
    write_target(parser, options.csv, lambda: _csv(rows))
    answer: Answer = {"parameters": _machine_form(statement, options.digits), "orbits": rows}
    give(parser, options, answer, lambda _: _text(statement, rows, seconds))
    return 0


def _parser() -> Parser:
    parser = Parser("proofs orbits", __doc__, EPILOG)
    which = parser.add_mutually_exclusive_group(required=True)
    add, period = which.add_argument, whole("a period", _LONGEST_PERIOD)
    add("--period", type=period, metavar="N", help=f"all words of length N, 1 to {_LONGEST_PERIOD}")
    add("--word", type=_word, metavar="W", help="one word of 0 and 1, with its rotations")
    add = parser.add_argument
    add("--eta", type=number, default=PAPER.eta, help="frequency ratio (default 0.2121)")
    add("--nu", type=number, default=PAPER.nu, help="amplitude -beta/p (default -0.2)")
    for name, default in (("left", LEFT), ("right", RIGHT)):
        help_text = f"default {show(default[0])} {show(default[1])}; found at other eta, nu"
        add(f"--{name}", type=number, nargs=2, metavar=("A", "B"), help=help_text)
    add("--csv", metavar="FILE", help="write all rows to a file, or - for the screen")
    add_answer(parser, 25)
    return parser


def _word(text: str) -> str:
    if not 1 <= len(text) <= _LONGEST_WORD or set(text) - {"0", "1"}:
        raise ArgumentTypeError(
            f"a word is made of 1 to {_LONGEST_WORD} letters 0 and 1, not {text[:40]!r}"
        )
    return text


def _parameters(options: Namespace) -> Parameters:
    """Return the horseshoe's numbers; f' >= 1 is what is asked of the slopes.

    At another oscillator than the paper's, I0 and I1 are given both, or found.
    """
    elsewhere = (options.eta, options.nu) != (PAPER.eta, PAPER.nu)
    if elsewhere and (options.left is None) != (options.right is None):
        raise ValueError(
            "--left and --right go together at this oscillator; without, both are found"
        )
    left, right = tuple(options.left or LEFT), tuple(options.right or RIGHT)
    options.left = options.left or (None if elsewhere else LEFT)
    return replace(
        PAPER,
        eta=options.eta,
        nu=options.nu,
        left=left,
        right=right,
        interval=(left[0], right[1]),
        slopes=(Fraction(1), Fraction(1)),
        ratios=None,
        printed_s0=None,
        epsilon=None,
        velocities=None,
        reach=None,
    )


def _row(point: PeriodicPoint, places: int) -> Answer:
    """Return the JSON object of a point."""
    ends = {"phase": bounds(point.point, places), "multiplier": bounds(point.multiplier, places)}
    return {"word": point.word, "period": point.period, **ends}


def _machine_form(statement: Parameters, places: int) -> Answer:
    """Return the JSON object of what was asked."""
    sets = {"left": statement.left, "right": statement.right, "interval": statement.interval}
    return {
        "eta": show(statement.eta),
        "nu": show(statement.nu),
        **{name: [show(x) for x in ends] for name, ends in sets.items()},
        "digits": places,
    }


def _csv(rows: list[Answer]) -> str:
    target = io.StringIO()
    table = csv.writer(target, lineterminator="\n")
    names = ("phase", "multiplier")
    table.writerow(["word", "period", *(f"{name}_{end}" for name in names for end in _ENDS)])
    for row in rows:
        bounds = (row[name][end] for name in names for end in _ENDS)
        table.writerow([row["word"], row["period"], *bounds])
    return target.getvalue()


def _text(statement: Parameters, rows: list[Answer], seconds: float) -> str:
    said = []
    for row in rows[:_SHOWN]:
        said.append(f"{row['word']}  period {row['period']}")
        said += [*lines("phase", row["phase"], 10), *lines("multiplier", row["multiplier"], 10)]
    if len(rows) > _SHOWN:
        said.append(f"... and {len(rows) - _SHOWN} more: --csv and --json have all of them")
    sets = f"in I0 = {show_range(statement.left)}, I1 = {show_range(statement.right)}"
    orbits = sum(Fraction(1, row["period"]) for row in rows)
    said.append(
        f"\n{len(rows)} words of length {len(rows[0]['word'])}: one periodic phase each, proved "
        f"to exist and to be the only one of its word {sets}; orbits: {orbits}, in {seconds:.2f} s"
    )
    return "\n".join(said)
