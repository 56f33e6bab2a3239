"""The test vectors of ITF1788, the Interval Test Framework for IEEE 1788: itf1788/*.itl, a reader.

    OPERATION OPERAND ... = RESULT ... signal SIGNAL;

A statement has a line of its own. A number stands for the binary64 number nearest to it, as in the
programs that the framework generates; a result is the tightest in binary64.
"""

import re
from functools import cache
from math import inf, nan
from pathlib import Path
from typing import Any, NamedTuple

FOLDER = Path(__file__).parent / "itf1788"
_COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.DOTALL)
_TOKEN = re.compile(r'"[^"]*"|\[[^]]*\](?:_\w+)?|\{[^}]*\}|[^\s=]+')
_SETS = {"empty": (inf, -inf), "": (inf, -inf), "entire": (-inf, inf), "nai": (nan, nan)}


class Box(NamedTuple):
    """An interval: [inf, -inf] is the empty set, [nan, nan] is no interval (NaI)."""

    lower: float
    upper: float
    decoration: str = ""

    @property
    def empty(self):
        return self.lower > self.upper

    @property
    def nai(self):
        return self.lower != self.lower

    @property
    def bounded(self):
        return -inf < self.lower <= self.upper < inf


class Statement(NamedTuple):
    """A line of a file; operands and results are boxes, floats, tuples of them, bools and texts."""

    place: str
    operation: str
    operands: tuple[Any, ...]
    results: tuple[Any, ...]
    signal: str


@cache
def statements():
    """All statements, in the order of the files."""
    found = []
    for path in sorted(FOLDER.glob("*.itl")):
        text = path.read_text(encoding="utf-8")
        text = _COMMENT.sub(lambda comment: "\n" * comment[0].count("\n"), text)
        for number, line in enumerate(text.splitlines(), 1):
            if ";" in line:
                found.append(statement(line, f"{path.name}, line {number}"))
    return found


def statement(line, place=""):
    """The statement in a line."""
    operation, line = line.strip().removesuffix(";").split(maxsplit=1)
    sides, _, signal = line.partition(" signal ")
    operands, results = (tuple(map(literal, _TOKEN.findall(x))) for x in sides.rsplit("=", 1))
    return Statement(place, operation, operands, results, signal)


def literal(token):
    """The value of a token."""
    if token[0] == "[":
        body, _, decoration = token.lower().partition("]")
        ends = _SETS.get(body[1:].strip()) or map(number, body[1:].split(","))
        return Box(*ends, decoration.removeprefix("_"))
    if token[0] == "{":
        return tuple(map(number, token[1:-1].split(",")))
    if token in ("true", "false"):
        return token == "true"
    return number(token) if token[0] in "+-.0123456789" or token in _NUMBERS else token.strip('"')


_NUMBERS = ("infinity", "NaN")


def number(text):
    """The binary64 number nearest to a literal."""
    return float.fromhex(text.strip()) if "0x" in text.lower() else float(text)
