"""Formulas as people type them, and as the checker reads them: one grammar for all of a user's own.

Numbers are decimals or integers and exact; ^ and ** are powers; y' and y'' are derivatives by the
time; sin, cos, exp, log, sqrt, atan, and tan, sinh, cosh, tanh, abs in terms of these: abs(x) is
sqrt(x^2), continuous, and with a derivative where x is proved not to be 0. The checker's variables
begin with a small letter, so that none is taken for a function: K is k_ there, Omega is omega_, and
so is lambda lambda_, a word of Python. Every failure is a GrammarError that says where, and what
would be accepted.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from fractions import Fraction
from keyword import iskeyword

from intervals import fraction
from proofs.trusted.kernel.expression import FUNCTIONS
from proofs.trusted.kernel.trees import formula
from proofs.trusted.numbers import show

_TOKEN = re.compile(
    r"\s*(?:(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)"
    r"|(?P<name>[A-Za-z_]\w*)(?P<primes>'*)|(?P<op>\*\*|[-+*/^(),=]))",
    re.ASCII,
)
_DIGITS = 190  # of a numerator or denominator: certificates take 400 characters a number
_DERIVED = {
    "abs": "sqrt(({0})**2)",
    "tan": "sin({0})/cos({0})",
    "sinh": "(exp({0}) - exp(-({0})))/2",
    "cosh": "(exp({0}) + exp(-({0})))/2",
    "tanh": "1 - 2/(exp(2*({0})) + 1)",
}
_CIRCLE = "of a variable on a circle give the period: --period, or `periods`"
_PIECES = "a map in pieces is no formula, but for abs: max(x, 0) is (x + abs(x))/2"
_OTHERS = {
    "ln": "write log",
    "arctan": "write atan",
    **dict.fromkeys(("mod", "floor", "frac"), _CIRCLE),
    **dict.fromkeys(("max", "min", "sign", "sgn", "heaviside"), _PIECES),
}
_SIGNS = {
    "-": "\u2212\u2013\u2014",
    "*": "\u00d7\u00b7\u22c5\u2217",
    "/": "\u00f7\u2215",
    "pi": "\u03c0",
    "sqrt(...)": "\u221a",
    "^2": "\u00b2",
    "^3": "\u00b3",
    "y', with a straight quote": "\u2019\u2032",
    "y'', with straight quotes": "\u201d\u2033",
}
_NUMBERS = {"pi": ": what has pi in it is written in the formulas", ",": ": write a decimal point"}
_ASCII = {"%": f": {_CIRCLE}", "|": ": write abs(...)"}
_KNOWN = (*FUNCTIONS, *_DERIVED)
_NAME = re.compile(r"[A-Za-z](?:[a-z0-9_]{0,9}[a-z0-9])?")


class GrammarError(ValueError):
    """A text is no formula; the message is one sentence."""


def exact(value: int | Fraction | str) -> Fraction:
    """Return an exact number of up to 190 digits; a float raises with the hint to write a text."""
    if isinstance(value, float):
        plain = float(value)  # numpy's shows its type
        raise TypeError(f'{plain} is a float, and not that decimal: write it as "{plain}"')
    try:
        number = fraction(value)
    except ValueError as error:
        hints = (hint for sign, hint in _NUMBERS.items() if sign in str(value))
        raise GrammarError(f"{error}{next(hints, '')}") from None
    if max(abs(number.numerator), number.denominator) >= 10**_DIGITS:
        raise GrammarError(f"a number of more than {_DIGITS} digits: {str(value)[:20]}...")
    return number


def canonical(text: str, time: str = "") -> str:
    """Return a formula as the checker reads it; time: what y' is the derivative by."""
    if not isinstance(text, str):
        plain = f'; write it as a text, "{text}"' if isinstance(text, float) else ""
        raise GrammarError(f"a formula is a text, not {text!r}{plain}")
    python = " ".join(_python(text, time))
    try:
        tree = _parsed(python)
    except SyntaxError:
        raise GrammarError(f"not a formula: {_short(text)}") from None
    if isinstance(tree, ast.Tuple):
        raise GrammarError(
            f"several formulas are several texts, not one with commas: {_short(text)}"
        )
    try:
        return str(formula(ast.unparse(_rewritten(tree, text))))
    except ValueError as error:
        raise GrammarError(f"{str(error).removeprefix('$: ')}, in {_short(text)}") from None


def name(text: str) -> str:
    """Return a variable's name as the checker reads it; GrammarError where it is none.

    Different names stay different, since none that is typed ends with _.
    """
    if not _NAME.fullmatch(text) or text.lower() in (*_KNOWN, *_OTHERS, "pi", "at"):
        raise GrammarError(
            f"{text[:30]!r} is no name for a variable: a letter, then small letters, digits and _, "
            "11 at the most, with no _ at the end, and no name of a function"
        )
    return _spelled(text)


def _spelled(word: str) -> str:
    small = word.lower()
    return small + "_" * ((small != word) + iskeyword(small))


def typed(name: str) -> str:
    """Return what a name of the checker's was typed as."""
    small = name.rstrip("_")
    return small if _spelled(small) == name else small.capitalize()


def as_typed(text: str) -> str:
    """Return a message with names and derivatives as they were typed: x' for D(x, t)."""
    plain = re.sub(r"D\((\w+)((?:, \w+)+)\)", lambda m: m[1] + "'" * m[2].count(","), text)
    return re.sub(r"\b[a-z]\w*_\b", lambda m: typed(m[0]), plain)


def names(text: str) -> list[str]:
    """Return the names in a formula as the checker reads it."""
    return sorted(formula(text).free)


def _short(text: str) -> str:
    return repr(text if len(text) <= 60 else text[:57] + "...")


def _python(text: str, time: str) -> Iterator[str]:
    """Yield the tokens as Python has them; decimals become quotients in brackets."""
    place, before = 0, ""
    text = text.rstrip()
    while place < len(text):
        match = _TOKEN.match(text, place)
        if match is None:
            hint = _hint(text[place:].lstrip()[0])
            raise GrammarError(f"{_at(text, place)}: this is in no formula{hint}")
        number, word, primes, op = match.group("number", "name", "primes", "op")
        if before in ("number", "name", ")") and (number or word or op == "("):
            power = re.search(r"([a-z]+) *(?:\^|\*\*) *(\d+) *$", text[:place])
            hint = "write * for a product"
            if op == "(" and power and power[1] in _KNOWN:
                hint = f"write {power[1]}(...)^{power[2]}"
            hint = _OTHERS.get(word or "", hint)
            raise GrammarError(f"{_at(text, place)}: {hint}")
        if number:
            yield f"({show(exact(number))})"
        elif not word:
            if op == "=":
                raise GrammarError(f"{_at(text, place)}: a formula, no equation, is expected")
            yield "**" if op == "^" else op
        is_call = bool(word) and text[match.end() :].lstrip().startswith("(")
        if is_call and word not in _KNOWN:
            usual = f"write * for a product; functions are {', '.join(_KNOWN)}"
            raise GrammarError(f"{_at(text, place)}: {_OTHERS.get(word, usual)}")
        if word:
            spelled = word if word in (*_KNOWN, "pi") else name(word)
            yield _derivative(spelled, len(primes), time) if primes else spelled
        before = "" if is_call else "number" if number else "name" if word else op
        place = match.end()
    if not before:
        raise GrammarError("an empty formula")


def _hint(letter: str) -> str:
    """Say what to write in the place of a character that is in no formula."""
    if letter.isascii():
        return _ASCII.get(letter, "")
    for usual, others in _SIGNS.items():
        if letter in others:
            return f": write {usual}"
    return ": names and numbers have the letters a to z and the digits alone, as in lambda"


def _derivative(word: str, order: int, time: str) -> str:
    if not time:
        raise GrammarError(f"{word}{chr(39) * order} has no meaning here: there is no time")
    return f"D({', '.join([word] + [time] * order)})"


def _at(text: str, place: int) -> str:
    rest = text[place:].lstrip()
    return f"character {len(text) - len(rest) + 1} of {_short(text)}, {_short(rest[:12])}"


def _rewritten(tree: ast.expr, text: str) -> ast.expr:
    """Put what the checker knows in the place of other functions and of exponents."""

    class Rewriting(ast.NodeTransformer):
        def visit_Call(self, node: ast.Call) -> ast.AST:
            self.generic_visit(node)
            if isinstance(node.func, ast.Name) and node.func.id in _DERIVED:
                if len(node.args) != 1:
                    raise GrammarError(f"{node.func.id} takes one number")
                return _parsed(_DERIVED[node.func.id].format(ast.unparse(node.args[0])))
            return node

        def visit_BinOp(self, node: ast.BinOp) -> ast.AST:
            self.generic_visit(node)
            return _power(node, text) if isinstance(node.op, ast.Pow) else node

        def visit_UnaryOp(self, node: ast.UnaryOp) -> ast.AST:
            self.generic_visit(node)
            return node.operand if isinstance(node.op, ast.UAdd) else node

    rewritten: ast.expr = Rewriting().visit(tree)
    return rewritten


def _power(node: ast.BinOp, text: str) -> ast.expr:
    """Return a power with an integer exponent other than 0, or with roots."""
    value = _number(node.right)
    if value is None:
        raise GrammarError("an exponent is a number; write a^b as exp(b*log(a))")
    base = ast.unparse(node.left)
    if value.denominator > 2:
        raise GrammarError("an exponent is a multiple of 1/2")
    if value == 0:
        return _parsed("1")
    exponent = int(value - Fraction(1, 2)) if value.denominator == 2 else int(value)
    root = f"sqrt({base})" if value.denominator == 2 else ""
    factors = [f"({base})**{exponent}" if exponent != 1 else f"({base})"] if exponent else []
    return _parsed("*".join([*factors, *([root] if root else [])]))


def _number(node: ast.expr) -> Fraction | None:
    """Return what a formula of numbers alone is."""
    match node:
        case ast.Name(id=number) if number[0].isdigit():
            return Fraction(number)
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            value = _number(operand)
            return None if value is None else -value
        case ast.BinOp(left=left, right=right, op=ast.Div()):
            x, y = _number(left), _number(right)
            return x / y if x is not None and y else None
    return None


def _parsed(text: str) -> ast.expr:
    """Return the tree, where a number is a name that is its text: Python's would be a float."""

    class Spelling(ast.NodeTransformer):
        def visit_Constant(self, node: ast.Constant) -> ast.AST:
            return ast.Name(text[node.col_offset : node.end_col_offset])

    tree: ast.expr = Spelling().visit(ast.parse(text, mode="eval").body)
    return tree
