"""Formulas as LaTeX, and LaTeX as MathML.

A formula is a text in Python's notation, see `proofs.trusted.kernel.formulas`; it is printed as it
stands, nothing is simplified or put in another order.
"""

from __future__ import annotations

import ast
import re
from functools import cache
from html import unescape

from proofs.report.typeset import GREEK
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.solutions import Expressions
from proofs.trusted.kernel.values import Equal, Series, Value
from proofs.trusted.numbers import show

_NAME = re.compile(r"([A-Za-z]+?)_?([0-9]+|_[A-Za-z0-9_]+)?")
_SPELT = {"epsilon": r"\varepsilon", "lam": r"\lambda"}
_SIGNED_NUMBER = re.compile(r"(<m\w+[^>]*>[(\[=,∈≤]</m\w+>(?:<mrow>)?)<mo>−</mo>")  # no difference
_SUM, _SIGNED, _PRODUCT, _POWER, _ATOM = range(5)  # how tightly a formula is bound
_FUNCTIONS = (r"\sin", r"\cos", r"\log", r"\exp", r"\sqrt", r"\partial")


def lines(conclusion: Conclusion) -> list[str]:
    """Return a conclusion as formulas in LaTeX, which may stand below each other."""
    if isinstance(conclusion, Equal):
        return [latex(conclusion.left), f"= {latex(conclusion.right)}"]
    if isinstance(conclusion, Series):
        return [latex(conclusion.function), *_series(conclusion)]
    if isinstance(conclusion, Value):
        return [latex(conclusion.function), *_bounds(conclusion)]
    if isinstance(conclusion, Expressions):
        return [f"{latex(name)} = {latex(text)}" for name, text in conclusion.expressions]
    return conclusion.latex.split(r",\quad ") if conclusion.latex else []


def _bounds(value: Value) -> list[str]:
    low, high = map(show, value.bounds)
    box = r",\ ".join(f"{latex(name)} {_within(*map(show, ends))}" for name, ends in value.box)
    return [_within(low, high), *([rf"\text{{for }} {box}"] if box else [])]


def _within(low: str, high: str) -> str:
    return f"= {low}" if low == high else rf"\in [{low}, {high}]"


def _series(series: Series) -> list[str]:
    name, parts = latex(series.variable), []
    for power, coefficient in enumerate(series.coefficients):
        if coefficient != "0":
            term, bound = _printed(ast.parse(coefficient, mode="eval").body)
            term = _bracketed(term, bound, _PRODUCT) if power else term
            parts.append(term + (f" {name}^{power}" if power > 1 else f" {name}" * power))
    parts.append(f"O({name}^{_short(str(len(series.coefficients)))})")
    total = " + ".join(parts).replace("+ -", "- ")
    where = r",\ ".join(rf"{latex(each)} \ne 0" for each in series.nonzero)
    limit = rf"\text{{as }} {name} \to 0" + (rf",\ \text{{where }} {where}" if where else "")
    return [f"= {total}", limit]


def latex(formula: str) -> str:
    """Return a formula in LaTeX."""
    return _printed(ast.parse(formula, mode="eval").body)[0]


def _printed(node: ast.expr) -> tuple[str, int]:
    """Return a part of a formula, and how tightly it is bound."""
    match node:
        case ast.Constant():
            return str(node.value), _ATOM
        case ast.Name():
            return _symbol(node.id), _ATOM
        case ast.UnaryOp():
            return f"-{_inside(node.operand, _PRODUCT)}", _SIGNED
        case ast.BinOp():
            return _operation(node)
        case ast.Call(func=ast.Name(id=name)):
            return _application(name, node)
    raise ValueError(f"not a formula: {ast.unparse(node)}")


def _operation(node: ast.BinOp) -> tuple[str, int]:
    match node.op:
        case ast.Mult():
            return _product(node)
        case ast.Div():
            return _quotient(node), _PRODUCT
        case ast.Pow():
            return _power(node.left, _printed(node.right)[0]), _POWER
    minus = isinstance(node.op, ast.Sub)
    right = _inside(node.right, _PRODUCT if minus else _SUM)
    right = f"({right})" if right.startswith("-") else right
    return f"{_inside(node.left, _SUM)} {'-' if minus else '+'} {right}", _SUM


def _product(node: ast.BinOp) -> tuple[str, int]:
    left, bound = _printed(node.left)
    left, bound = _bracketed(left, bound, _SIGNED), _SIGNED if bound == _SIGNED else _PRODUCT
    right = _inside(node.right, _PRODUCT)
    if right[0].isdigit() or right.startswith(r"\frac"):
        dot = r" \cdot "
    else:
        dot = r"\," if left.endswith(")") or right.startswith(_FUNCTIONS) else " "
    return f"{left}{dot}{right}", bound


def _quotient(node: ast.BinOp) -> str:
    """Write a/b/c as a/(b c)."""
    divisors = [node.right]
    above = node.left
    while isinstance(above, ast.BinOp) and isinstance(above.op, ast.Div):
        divisors.insert(0, above.right)
        above = above.left
    one = len(divisors) == 1
    below = " ".join(_printed(each)[0] if one else _inside(each, _PRODUCT) for each in divisors)
    return rf"\frac{{{_printed(above)[0]}}}{{{below}}}"


def _inside(node: ast.expr, least: int) -> str:
    text, bound = _printed(node)
    return _bracketed(text, bound, least)


def _bracketed(text: str, bound: int, least: int) -> str:
    return text if bound >= least else _fenced(text)


def _fenced(text: str, fence: str = "()") -> str:
    """Put brackets around, as high as what is inside."""
    if any(tall in text for tall in (r"\frac", r"\sqrt", "]_")):
        return rf"\left{fence[0]}{text}\right{fence[1]}"
    return f"{fence[0]}{text}{fence[1]}"


def _power(base: ast.expr, exponent: str) -> str:
    if isinstance(base, ast.Call) and isinstance(base.func, ast.Name):
        name = base.func.id
        if name in ("sin", "cos", "log"):
            return rf"\{name}^{{{exponent}}}{_fenced(_printed(base.args[0])[0])}"
    return f"{_inside(base, _ATOM)}^{_short(exponent)}"


def _short(script: str) -> str:
    return script if len(script) == 1 else f"{{{script}}}"


def _application(name: str, call: ast.Call) -> tuple[str, int]:
    first = call.args[0]
    if name == "D":
        by = "".join(_printed(each)[0] for each in call.args[1:])
        return rf"\partial_{{{by}}}{_fenced(_printed(first)[0])}", _POWER
    if name == "at":
        places = r",\,".join(
            f"{_symbol(each.arg or '')} = {_printed(each.value)[0]}" for each in call.keywords
        )
        inner = _fenced(_printed(first)[0], "[]")
        return f"{{{inner}}}_{{{places}}}", _POWER
    if name == "sqrt":
        return rf"\sqrt{{{_printed(first)[0]}}}", _ATOM
    return rf"\{name}{_fenced(_printed(first)[0])}", _POWER


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
    return _SIGNED_NUMBER.sub(r'\1<mo form="prefix">−</mo>', text)
