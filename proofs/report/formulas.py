"""Formulas as LaTeX, and LaTeX as MathML.

A formula is printed as it stands, nothing is simplified or put in another order.
"""

from __future__ import annotations

import re
from fractions import Fraction
from functools import cache
from html import unescape

from proofs.report.layout import enclosure
from proofs.report.typeset import GREEK
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.solutions import Expressions
from proofs.trusted.kernel.trees import (
    POWER,
    PRODUCT,
    SUM,
    At,
    Derivative,
    Number,
    Operation,
    Pi,
    Power,
    Printer,
    Tree,
    Variable,
)
from proofs.trusted.kernel.values import Equal, Series, Value
from proofs.trusted.numbers import ceil_text, floor_text, show

_NAME = re.compile(r"([A-Za-z]+?)_?([0-9]+|_[A-Za-z0-9_]+)?")
_BETWEEN = re.compile(r"(-?\d+\.\d+) \\le (.+?) \\le (-?\d+\.\d+)")
_PLACES = 18  # of decimals in a formula, that it fits a narrow screen
_SPELT = {"epsilon": r"\varepsilon", "lam": r"\lambda"}
_ROW_OF_ONE = re.compile(r"<mrow>(<(m[ion]|mtext)[^<>]*>[^<]*</\2>)</mrow>")
_SIGNED_NUMBER = re.compile(r"(<m\w+[^>]*>[(\[=,∈≤]</m\w+>(?:<mrow>)?)<mo>−</mo>")  # no difference
_FUNCTIONS = (r"\sin", r"\cos", r"\log", r"\exp", r"\sqrt", r"\arctan", r"\partial")


def lines(conclusion: Conclusion) -> list[str]:
    """Return a conclusion as formulas in LaTeX, which may stand below each other."""
    if isinstance(conclusion, Equal):
        return [latex(conclusion.left), f"= {latex(conclusion.right)}"]
    if isinstance(conclusion, Series):
        return [latex(conclusion.function), *_series(conclusion)]
    if isinstance(conclusion, Value):
        return [latex(conclusion.function), *_bounds(conclusion)]
    if isinstance(conclusion, Expressions):
        return [f"{_symbol(name)} = {latex(value)}" for name, value in conclusion.expressions]
    return [*map(_shared, conclusion.latex.split(r",\quad "))] if conclusion.latex else []


def _shared(line: str) -> str:
    """Write a number between long decimals by the digits that they share, rounded outward."""
    match = _BETWEEN.fullmatch(line)
    if match is None or max(len(match[1]), len(match[3])) < _PLACES:
        return line
    low, high = Fraction(match[1]), Fraction(match[3])
    digits = enclosure(floor_text(low, _PLACES), ceil_text(high, _PLACES))
    shared, _, rest = digits.partition("[")
    return rf"{match[2]} = {shared}[{rest}" if shared else line


def latex(tree: Tree) -> str:
    """Return a formula in LaTeX."""
    return _Latex().text(tree)


def _bounds(value: Value) -> list[str]:
    low, high = map(show, value.bounds)
    box = r",\ ".join(f"{latex(name)} {_within(*map(show, ends))}" for name, ends in value.box)
    return [_within(low, high), *([rf"\text{{for }} {box}"] if box else [])]


def _within(low: str, high: str) -> str:
    return f"= {low}" if low == high else rf"\in [{low}, {high}]"


def _series(series: Series) -> list[str]:
    name = latex(series.variable)
    rest = f"O({latex(Power(len(series.coefficients), (series.variable,)))})"
    where = r",\ ".join(rf"{latex(each)} \ne 0" for each in series.nonzero)
    limit = rf"\text{{as }} {name} \to 0" + (rf",\ \text{{where }} {where}" if where else "")
    return [f"= {latex(series.polynomial)} + {rest}", limit]


class _Latex(Printer):
    """LaTeX: fractions, roots, powers of functions; products without a mark."""

    def operation(self, op: str, left: Tree, right: Tree) -> tuple[str, int]:
        if op != "/":
            return super().operation(op, left, right)
        divisors = [right]
        while isinstance(left, Operation) and left.op == "/":  # a/b/c is a/(b c)
            left, other = left.parts
            divisors.insert(0, other)
        least = SUM if len(divisors) == 1 else PRODUCT
        below = " ".join(self.inside(each, least) for each in divisors)
        return rf"\frac{{{self.text(left)}}}{{{below}}}", POWER

    def product(self, left: str, right: str, op: str) -> str:
        if right[0].isdigit() or right.startswith(r"\frac"):
            return rf"{left} \cdot {right}"
        thin = left.endswith(")") or right.startswith(_FUNCTIONS)
        return rf"{left}\,{right}" if thin else f"{left} {right}"

    def brackets(self, text: str, fence: str = "()") -> str:
        """Put brackets around, as high as what is inside."""
        if any(tall in text for tall in (r"\frac", r"\sqrt", "]_")):
            return rf"\left{fence[0]}{text}\right{fence[1]}"
        return f"{fence[0]}{text}{fence[1]}"

    def symbol(self, name: str) -> str:
        return _symbol(name if name[0] != "_" else f"u{name}")

    def power(self, base: Tree, n: int) -> str:
        if isinstance(base, Operation) and base.op in ("sin", "cos", "log"):
            return rf"\{base.op}^{{{n}}}{self.brackets(self.text(base.parts[0]))}"
        plain = isinstance(base, Number | Pi | Variable)
        text = self.text(base)
        return f"{text if plain else self.brackets(text)}^{_short(str(n))}"

    def call(self, tree: Tree, first: str, *others: str) -> str:
        inside = self.brackets(first)
        match tree:
            case Operation(op="sqrt"):
                return rf"\sqrt{{{first}}}"
            case Operation(op="atan"):
                return rf"\arctan{inside}"
            case Operation(op=name):
                return rf"\{name}{inside}"
            case Derivative(by=by):
                return rf"\partial_{{{''.join(map(self.symbol, by))}}}{inside}"
            case At(names=names):
                pairs = zip(map(self.symbol, names), others, strict=True)
                put = r",\,".join(f"{name} = {value}" for name, value in pairs)
                return f"{{{self.brackets(first, '[]')}}}_{{{put}}}"
        raise TypeError(f"not a formula: {tree!r}")


def _short(script: str) -> str:
    return script if len(script) == 1 else f"{{{script}}}"


def _symbol(name: str) -> str:
    match = _NAME.fullmatch(name)
    letters, index = (match[1], match[2]) if match else (name, None)
    written = f"\\{letters}" if letters in GREEK else letters
    if letters in _SPELT:
        written = _SPELT[letters]
    elif len(letters) > 1 and letters not in GREEK:
        written = rf"\mathrm{{{letters}}}"
    return f"{written}_{_short(index.strip('_'))}" if index else written


@cache
def mathml(formula: str, display: str = "inline") -> str:
    """Return LaTeX as MathML; what is written is its text alternative, too."""
    from latex2mathml.converter import convert

    text = unescape(convert(formula, display=display))
    for spare in (' xmlns="http://www.w3.org/1998/Math/MathML"', ' display="inline"'):
        text = text.replace(spare, "")
    text = text.replace(' fence="true"', "").replace(' stretchy="true"', "")
    text = re.sub(r'<mo stretchy="false">([()\[\]])</mo>', r"<mtext>\1</mtext>", text)
    text = _SIGNED_NUMBER.sub(r'\1<mo form="prefix">−</mo>', text)
    return _ROW_OF_ONE.sub(r"\1", text)
