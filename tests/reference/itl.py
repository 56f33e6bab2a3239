"""Read the test language of ITF1788, the Interval Test Framework for IEEE 1788 (*.itl).

    testcase NAME { OPERATION OPERAND ... = RESULT ... <= RESULT ... signal SIGNAL; ... }

After `=` comes the tightest result, after `<=` an outer bound that is still accurate. `//` and `#`
begin a comment, `/* */` and `#* *#` enclose one. Every statement is returned, a statement that is
not understood with the reason; nothing is skipped.

Values are exact: hexadecimal, decimal and rational numbers are Fractions, infinities and NaN are
floats. A number of a statement stands for the binary64 number nearest to it (`binary64`), as it
does in the programs that the framework generates; in the text operand of a constructor it stands
for itself. Intervals have the literals of IEEE 1788-2015, 9.7 and 12.11.
"""

import re
from fractions import Fraction
from math import inf, nan
from typing import NamedTuple

Number = Fraction | float  # a float is an infinity or NaN


class Box(NamedTuple):
    """An interval: [inf, -inf] is the empty set, [nan, nan] is no interval (NaI)."""

    lower: Number
    upper: Number
    decoration: str = ""

    @property
    def empty(self):
        return self.lower > self.upper

    @property
    def nai(self):
        return self.lower != self.lower

    @property
    def bounded(self):
        return isinstance(self.lower, Fraction) and isinstance(self.upper, Fraction)


class Text(NamedTuple):
    """A text in quotes."""

    value: str


class Name(NamedTuple):
    """A decoration or an overlap state."""

    value: str


Literal = Number | Box | Text | Name | bool | tuple[Number, ...]


class Statement(NamedTuple):
    """One line of a test case; `problem` is why it was not understood, else empty."""

    testcase: str
    line: int
    operation: str
    operands: tuple[Literal, ...] = ()
    tightest: tuple[Literal, ...] = ()
    accurate: tuple[Literal, ...] = ()
    signals: tuple[str, ...] = ()
    problem: str = ""


DECORATIONS = ("ill", "trv", "def", "dac", "com")

_STRING = r'"(?:\\.|[^"\\])*"'
_COMMENT = re.compile(rf"({_STRING})|/\*.*?\*/|#\*.*?\*#|//[^\n]*|#[^\n]*", re.DOTALL)
_PIECE = re.compile(
    r"\s+"
    r"|testcase\s+(?P<testcase>[^\s{]+)\s*\{"
    r"|(?P<end>\})"
    rf'|(?P<statement>(?:{_STRING}|\{{[^{{}};]*\}}|[^;"{{}}])+;)'
    r"|(?P<rest>[^;}]*[;}]?)",
    re.DOTALL,
)
_HEX = r"0x(?P<digits>[0-9a-f]*)(?:\.(?P<places>[0-9a-f]*))?(?:p(?P<power>[+-]?\d+))?"
_DECIMAL = r"(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?"
_NUMBER = re.compile(
    rf"[+-]?\s*(?:{_HEX}|{_DECIMAL}|inf(?:inity)?\b|nan\b)", re.ASCII | re.IGNORECASE
)
_RATIONAL = re.compile(r"\s*([+-]?\d+)\s*/\s*(\d+)\s*", re.ASCII)
_UNCERTAIN = re.compile(
    r"(?P<sign>[+-]?)(?P<whole>\d+)(?:\.(?P<places>\d*))?\?(?P<radius>\?|\d*)(?P<side>[ud]?)"
    r"(?:e(?P<power>[+-]?\d+))?",
    re.ASCII | re.IGNORECASE,
)
_TOKEN = re.compile(
    rf"\s*(?:(?P<text>{_STRING})"
    r"|(?P<interval>\[[^][]*\](?:\s*_\s*\w+)?)"
    r"|\{(?P<list>[^{}]*)\}"
    rf"|(?P<uncertain>{re.sub(r'[?]P<[a-z]+>', '?:', _UNCERTAIN.pattern)}(?:_\w+)?)"
    r"|(?P<rational>[+-]?\d+\s*/\s*\d+)"
    rf"|(?P<number>{re.sub(r'[?]P<[a-z]+>', '?:', _NUMBER.pattern)}(?![\w.]))"
    r"|(?P<name>[a-z]\w*)"
    r"|(?P<mark><=|=))",
    re.ASCII | re.IGNORECASE | re.DOTALL,
)
_OPERATION = re.compile(r"\s*([a-z]\w*(?:-[a-z]\w*)*)", re.ASCII | re.IGNORECASE)
_LARGEST_EXPONENT = 10**5  # beyond it, a number is a typing error or an attack


def read(text):
    """Return the statements of a file, in their order."""
    text = _COMMENT.sub(lambda m: m[1] or " " + "\n" * m[0].count("\n"), text)
    statements, testcase, position, line = [], "", 0, 1
    while position < len(text):
        piece = _PIECE.match(text, position)
        position = max(piece.end(), position + 1)
        if piece["testcase"]:
            testcase = piece["testcase"]
        elif piece["end"]:
            testcase = ""
        elif piece["statement"] or piece["rest"]:
            statements.append(_statement(piece["statement"] or piece["rest"], testcase, line))
        line += piece[0].count("\n")
    return statements


def _statement(source, testcase, line):
    """Read a statement, and return one with its problem where that fails."""
    found = _OPERATION.match(source)
    operation = found[1] if found else ""
    parts = {"operands": [], "=": [], "<=": [], "signal": []}
    try:
        if not found or not source.endswith(";"):
            raise ValueError("no operation" if source.endswith(";") else "no semicolon at the end")
        part = "operands"
        for kind, token in _tokens(source[found.end() : -1]):
            if kind == "mark" or token == "signal":
                part = token
            else:
                parts[part].append(token if part == "signal" else _literal(kind, token))
        if not (parts["="] or parts["<="]):
            raise ValueError("no result")
    except ValueError as error:
        return Statement(testcase, line, operation, problem=str(error))
    return Statement(testcase, line, operation, *map(tuple, parts.values()))


def _tokens(source):
    """Return the tokens as pairs (kind, text)."""
    tokens, position, end = [], 0, len(source.rstrip())
    while position < end:
        token = _TOKEN.match(source, position)
        if token is None:
            raise ValueError(f"not a literal: {source[position:end].strip()[:40]!r}")
        tokens.append((token.lastgroup, token[token.lastgroup]))
        position = token.end()
    return tokens


def _literal(kind, token):
    if kind == "text":
        return Text(re.sub(r"\\(.)", r"\1", token[1:-1], flags=re.DOTALL))
    if kind in ("interval", "uncertain"):
        return interval(token)
    if kind == "list":
        return tuple(number(item) for item in token.split(",")) if token.strip() else ()
    if kind == "name":
        return token.lower() == "true" if token.lower() in ("true", "false") else Name(token)
    return number(token)


def number(text):
    """Return the exact number that a literal denotes; ValueError if it denotes none."""
    rational = _RATIONAL.fullmatch(text)
    if rational:
        if int(rational[2]) == 0:
            raise ValueError(f"a division by 0: {text!r}")
        return Fraction(int(rational[1]), int(rational[2]))
    found = _NUMBER.fullmatch(text.strip())
    if found is None:
        raise ValueError(f"not a number: {text.strip()[:40]!r}")
    plain = re.sub(r"\s", "", found[0]).lower()
    sign, plain = -1 if plain.startswith("-") else 1, plain.lstrip("+-")
    if plain.startswith("inf"):
        return sign * inf
    if plain == "nan":
        return nan
    if not plain.startswith("0x"):
        _reasonable(plain.partition("e")[2])
        return sign * Fraction(plain)
    digits, places = found["digits"], found["places"] or ""
    if not digits + places:
        raise ValueError(f"a number without digits: {text!r}")
    power = _reasonable(found["power"]) - 4 * len(places)
    return sign * int(digits + places, 16) * Fraction(2) ** power


def _reasonable(exponent):
    """Return the exponent as an int, 0 for none."""
    value = int(exponent or 0)
    if abs(value) > _LARGEST_EXPONENT:
        raise ValueError(f"a number of unreasonable size: exponent {exponent}")
    return value


def interval(text):
    """Return the exact Box that an interval literal of IEEE 1788 denotes; ValueError if none."""
    body, _, decoration = (part.strip().lower() for part in text.strip().rpartition("_"))
    if "_" not in text:
        body, decoration = decoration, ""
    elif decoration not in DECORATIONS:
        raise ValueError(f"not a decoration: {decoration!r}")
    if not body.startswith("["):
        return _uncertain(body)._replace(decoration=decoration)
    if not body.endswith("]"):
        raise ValueError(f"no bracket at the end: {text!r}")
    inside = body[1:-1].strip()
    if inside == "nai" and not decoration:
        return Box(nan, nan)
    if inside in ("", "empty"):
        if decoration not in ("", "trv"):
            raise ValueError(f"the empty set is not {decoration}")
        return Box(inf, -inf, decoration)
    if inside == "entire":
        inside = ","
    lower, comma, upper = inside.partition(",")
    low = number(lower) if lower.strip() else -inf
    high = low if not comma else number(upper) if upper.strip() else inf
    if not low <= high or low == inf or high == -inf:
        raise ValueError(f"not an interval: {text!r}")
    box = Box(low, high, decoration)
    if decoration == "ill" or (decoration == "com" and not box.bounded):
        raise ValueError(f"not an interval with the decoration {decoration}: {text!r}")
    return box


def _uncertain(text):
    """Return the Box of m?ru E: m with a radius r, default 1/2, in units of its last place."""
    parts = _UNCERTAIN.fullmatch(text)
    if parts is None:
        raise ValueError(f"not an interval: {text[:40]!r}")
    places = parts["places"] or ""
    unit = Fraction(10) ** (_reasonable(parts["power"]) - len(places))
    middle = int(parts["sign"] + parts["whole"] + places) * unit
    radius = inf
    if parts["radius"] != "?":
        radius = (int(parts["radius"]) if parts["radius"] else Fraction(1, 2)) * unit
    low = middle if parts["side"] == "u" else middle - radius
    high = middle if parts["side"] == "d" else middle + radius
    return Box(low, high)


def binary64(value):
    """Return the binary64 number nearest to a number, exactly, or the infinity beyond its range."""
    if isinstance(value, float):
        return value
    try:
        return Fraction(float(value))
    except OverflowError:
        return inf if value > 0 else -inf
