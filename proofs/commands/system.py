"""Theorems about an impacting system, or a map, of your own, each with a certificate.

The system is a file of some ten lines (docs/own-system.md), or a published one by --example; a map
is given by its formulas. What is proved stands first, then what floating point sees beside it.
"""

from __future__ import annotations

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.commands.system")

import json
import re
from argparse import ArgumentTypeError, Namespace
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from fractions import Fraction
from functools import partial
from time import monotonic
from types import MappingProxyType
from typing import Any, NamedTuple, TypeVar

from intervals import Undecided
from proofs.map import EFFORT, Map
from proofs.methods.ends import Ends
from proofs.methods.grammar import as_typed
from proofs.shell.backstop import Overrun, within
from proofs.shell.cli import Parser, heard, number, progress, share, whole
from proofs.shell.files import write_files, write_target
from proofs.shell.screen import say
from proofs.system import System
from proofs.theorem import Theorem
from proofs.trusted.files import render
from proofs.trusted.numbers import show
from proofs.trusted.verdicts import Verdict

SCHEMA = "impact-proofs.system/1"
_SECONDS, _MOST_EFFORT = Fraction(120), 6
_MOST = 12  # theorems of an answer on the screen
_ASKED = ("orbits:1", "orbits:2", "stable", "horseshoe")
T = TypeVar("T")
_NAME = r"[A-Za-z]\w*"


_QUESTIONS = {  # how each is asked, and its statement, of the number N where it has one
    example.partition(":")[0]: (example, statement)
    for example, _, statement in (
        line.partition(" ")
        for line in """\
orbits:2 periodic orbits of the least period N exist
all:2 the periodic orbits in the region of a formula whose period divides N, and no others
stable:2 an attracting periodic orbit exists
horseshoe:2 one of the first N iterates of the map has a full shift on two symbols
image:X=A,Y=B:C where the map takes these states
trapping:X=A:B,Y=C:D the map takes this box into its interior: there is an attractor in it
flow:T=10,X=A,Y=B:C where the solutions are at a time
impact:X=A,Y=B:C it is known what comes after these states: an impact, none ever, or no flight
graze:X=A,Y=B:C a value of the variable with a range is followed by a graze
touching:X=A,Y=B:C,P=D:E curves of launches that are followed by a graze, over the second range
rest:X=A:B in contact with the wall no flight begins, at these states
branches:P=A:B branches of fixed points over this range of a parameter
folds:P=A:B,Q=C:D curves of fixed points with the multiplier 1, over the second range
flips:P=A:B,Q=C:D curves of fixed points with the multiplier -1, over the second range
grazing:P=A:B,Q=C:D curves of motions that graze a wall periodically, over the second range
""".splitlines()
    )
}
_USUAL = {"orbits": "1", "stable": "", "horseshoe": "2"}  # the number N, where none is given
_METHODS = {"all": "periodic_orbits"}  # of other names than the questions
_ASKABLE = ", ".join(example for example, _ in _QUESTIONS.values())
EPILOG = """\
exit status: 0 all that is asked is proved; 1 something is undecided; 2 no system, or no file

examples:
  python -m proofs system --example bouncing-ball
  python -m proofs system mine.toml --ask orbits:3 horseshoe --out runs/mine --figure
  python -m proofs system --map "1 - 1.4*x^2 + y" "0.3*x" --ask orbits:2
  python -m proofs system --map "r*x*(1 - x)" --set r=3.9 --box x=0:1 --json -
  python -m proofs system --example bouncing-ball --set e=0.499:0.501 --ask orbits:1
  python -m proofs system --example bouncing-ball --ask folds:g=0.6:1,e=0.45:0.5
  python -m proofs system --example wall --ask impact:a=0.3,v=-1 graze:a=0.3,v=-3:-0.1
  python -m proofs system --example wall --ask grazing:d=0.1:0.2,w=2.5:3
"""


class Answer(NamedTuple):
    """What is decided about one question; without a theorem the reason why nothing is."""

    id: str
    theorem: Theorem | None
    why: str

    @property
    def verdict(self) -> Verdict:
        """VERIFIED, or UNDECIDED: a search that fails refutes nothing."""
        return Verdict.UNDECIDED if self.theorem is None else Verdict.VERIFIED

    @property
    def statement(self) -> str:
        """The question as a sentence."""
        kind, _, number = self.id.partition(":")
        least = f", of the least period {number}" if kind == "stable" and number else ""
        return re.sub(r"\bN\b", number or _USUAL.get(kind, ""), _QUESTIONS[kind][1]) + least

    @property
    def file(self) -> str:
        """The name of its certificate."""
        return f"{re.sub('[^a-z0-9]+', '-', self.id)}.json"


def main(arguments: list[str] | None = None) -> int:
    """Prove what is asked, print and write it; return the exit status."""
    options = _options(arguments)
    until = monotonic() + float(options.seconds)
    late = f"stopped after {show(options.seconds)} seconds, as asked"
    with progress() as tell:
        system = _within(until, lambda: subject(options))
        if system is None:
            parser: Parser = options.parser
            parser.error(f"{late}, before the motion was solved: give its `form`")
        if options.out:
            options.out.mkdir(parents=True, exist_ok=True)
        system.effort, answers = options.effort, []
        for asked in options.ask or _ASKED:
            tell(asked)
            answer = _within(until, partial(_answer, system, asked))
            answers.append(answer or Answer(asked, None, late))
        tell("floating point")
        seen = _within(until, system.seen) if heard(options) else None
    if options.out:
        _write(options, system, answers)
    write_target(options.parser, options.json, lambda: render(_machine(system, answers)))
    if heard(options):
        for line in (*system.respelled(), *_told(answers, seen or [late])):
            say(line)
    return int(any(each.theorem is None for each in answers))


def _within(until: float, work: Callable[[], T]) -> T | None:
    """Return what work returns; None where it is not done in time."""
    with suppress(Overrun), within(until - monotonic()):
        return work()
    return None


def _options(arguments: list[str] | None) -> Namespace:
    parser = Parser("proofs system", __doc__, EPILOG)
    add_subject(parser)
    help_text = f"what to prove: {_ASKABLE} (default {' '.join(_ASKED)})"
    parser.add_argument("--ask", nargs="+", type=_question, metavar="WHAT", help=help_text)
    help_text = f"stop after that, all in all (default {_SECONDS})"
    parser.add_argument("--seconds", type=number, default=_SECONDS, metavar="S", help=help_text)
    help_text = f"how much is looked at; each more is twice as much (default {EFFORT})"
    reader = whole("effort", _MOST_EFFORT)
    parser.add_argument("--effort", type=reader, default=EFFORT, metavar="N", help=help_text)
    parser.add_argument("--figure", action="store_true", help="draw it as DIR/figure.svg, too")
    share(parser, "--out", "--json", "--quiet")
    options = parser.parse_args(arguments)
    options.parser, options.questions = parser, options.ask or ()
    if options.seconds <= 0:
        parser.error(f"some seconds are expected, not {show(options.seconds)}")
    if options.figure and not options.out:
        parser.error("--figure goes to the folder of --out")
    return options


def add_subject(parser: Parser) -> None:
    """Add the options by which a system or a map is given."""
    parser.add_argument("file", nargs="?", type=_file, metavar="FILE", help="a system's file")
    names = ", ".join(System.examples())
    parser.add_argument("--example", metavar="NAME", help=f"a published system: {names}")
    help_text = "the formulas of a map, for its variables from a to z"
    parser.add_argument("--map", nargs="+", metavar="FORMULA", help=help_text)
    help_text = "the period of a variable of --map that is an angle"
    parser.add_argument("--period", nargs="+", type=_pair, metavar="NAME=P", help=help_text)
    help_text = "parameters; a range, LOW:HIGH, means all of its values"
    parser.add_argument("--set", nargs="+", type=_pair, metavar="NAME=VALUE", help=help_text)
    help_text = "where orbits are looked for"
    parser.add_argument("--box", nargs="+", type=_pair, metavar="NAME=LOW:HIGH", help=help_text)
    help_text = "the walls that are hit in turn, of a system with several (default: as in the file)"
    parser.add_argument("--walls", nargs="+", metavar="WALL", help=help_text)


def _file(text: str) -> str:
    if text.startswith("-"):  # which begins formulas, too
        raise ArgumentTypeError(f"there is no option {text[:40]!r}")
    return text


def _pair(text: str) -> tuple[str, str]:
    name, equals, value = text.partition("=")
    if not (name and equals and value):
        raise ArgumentTypeError(f"NAME=VALUE or NAME=LOW:HIGH is expected, not {text[:40]!r}")
    if "=" in value:
        raise ArgumentTypeError(f"several are written with spaces between, not {text[:40]!r}")
    return name, value


def _question(text: str) -> str:
    kind, _, more = text.partition(":")
    if kind not in _QUESTIONS:
        raise ArgumentTypeError(f"{_ASKABLE} can be asked, not {text[:40]!r}")
    example, _ = _QUESTIONS[kind]
    pair = rf"{_NAME}=[^:,]+:[^:,]+"
    if kind == "rest" or re.search(r"=\w+(,|$)", example):  # numbers are taken, too
        pair += "|" + rf"{_NAME}=[^:,]+"
    number = "[1-9]" if kind == "horseshoe" else r"[1-9]\d?"
    form = rf"({pair})(,({pair}))*" if "=" in example else number
    if not (re.fullmatch(form, more, re.ASCII) or (kind in _USUAL and not more)):
        raise ArgumentTypeError(f"{text[:40]!r} is no question: ask as in {example}")
    return "orbits:1" if text in ("orbits", "orbits:") else text.rstrip(":")


def _ends(text: str) -> str | tuple[str, str]:
    low, colon, high = text.partition(":")
    return (low, high) if colon else low


def subject(options: Namespace, ranges: Mapping[str, Ends] = MappingProxyType({})) -> Map:
    """Return the system or the map; what is wrong with it is one line, status 2.

    ranges: of parameters, beside those of --set.
    """
    if sum(map(bool, (options.file, options.example, options.map))) != 1:
        options.parser.error("one of FILE, --example and --map is expected")
    try:
        values: dict[str, Any] = {**_values(options.set or ()), **ranges}
        if options.map:
            made = Map(*options.map, periods=dict(options.period or ()), **values)
        elif options.example:
            made = System.example(options.example, **values)
        else:
            made = System.read(options.file, **values)
        if options.walls:
            if not isinstance(made, System):
                raise ValueError("walls are those of a system, not of a map")
            made = made.around(*options.walls)
        made.box |= {name: _side(ends) for name, ends in _values(options.box or ()).items()}
        made.region()
        if isinstance(made, System):
            made.require_launches()
        for asked in getattr(options, "questions", ()):
            kind, _, more = asked.partition(":")
            made.require(_METHODS.get(kind, kind), _sides(more) if "=" in more else {})
    except (ValueError, TypeError) as error:
        options.parser.error(str(error))
    return made


def _values(pairs: Iterable[tuple[str, str]]) -> dict[str, str | tuple[str, str]]:
    """Return numbers, or both ends, by their names; each name is given once."""
    values: dict[str, str | tuple[str, str]] = {}
    for name, text in pairs:
        if name in values:
            raise ValueError(f"{name} is given twice: a range is {name}=LOW:HIGH")
        values[name] = _ends(text)
    return values


def _side(ends: str | tuple[str, str]) -> tuple[str, str]:
    if isinstance(ends, str):
        raise ValueError(f"LOW:HIGH is expected, not {ends[:40]!r}")
    return ends


def _answer(system: Map, asked: str) -> Answer:
    try:
        return Answer(asked, _ask(system, asked), "")
    except Undecided as error:
        why = as_typed(str(error))
    except ValueError as error:
        return Answer(asked, None, str(error))
    part = system.narrower(lambda other: _ask(other, asked)) if system.ranges else ""
    return Answer(asked, None, why + f"; narrower ranges do: {part}" * bool(part))


def _ask(system: Map, asked: str) -> Theorem:
    kind, _, more = asked.partition(":")
    method: Callable[..., Theorem] = getattr(system, _METHODS.get(kind, kind))
    if kind == "all":
        return method(int(more), system.box)
    if kind == "horseshoe":
        return method(longest=int(more or _USUAL[kind]))
    if kind == "stable":
        return method(int(more), shortest=int(more)) if more else method()
    return method(**_sides(more)) if "=" in more else method(int(more))


def _sides(more: str) -> dict[str, str | tuple[str, str]]:
    return _values(map(_pair, more.split(",")))


def _told(answers: Sequence[Answer], seen: Sequence[str]) -> Iterator[str]:
    for answer in answers:
        if answer.theorem is not None:
            yield f"{answer.id}  Theorem, VERIFIED:"
            yield from (f"  {line}" for line in answer.theorem.text(_MOST).split("\n"))
            yield ""
    for answer in answers:
        why = f": {answer.why}" if answer.why else ""
        yield f"{answer.id:12} {answer.verdict.value:10} {answer.statement}{why}"
    yield ""
    yield "Seen in floating point, not proved:"
    yield from (f"  {as_typed(line)}" for line in seen)


def _machine(system: Map, answers: Sequence[Answer]) -> dict[str, Any]:
    return {
        "schema": SCHEMA,
        "system": repr(system),
        "claims": [
            {
                "id": answer.id,
                "verdict": answer.verdict.value,
                "statement": answer.statement,
                "why": answer.why,
                "theorems": [each.sentence for each in answer.theorem or ()],
                "certificate": answer.theorem and json.loads(answer.theorem.certificate),
            }
            for answer in answers
        ],
    }


def _write(options: Namespace, system: Map, answers: Sequence[Answer]) -> None:
    for answer in answers:
        if answer.theorem is not None:
            answer.theorem.save(options.out / answer.file)
    if options.figure:
        try:
            from proofs.report.figures.portrait import portrait
        except ImportError:
            options.parser.error("--figure needs matplotlib: pip install 'impact-proofs[report]'")
        proved = [each for answer in answers for each in answer.theorem or ()]
        write_files(
            options.out, {"figure.svg": portrait(system.sample(), system.variables, proved)}
        )
