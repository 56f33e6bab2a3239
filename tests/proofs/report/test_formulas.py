"""Formulas set as LaTeX have the value of the text that they are made of."""

import math
import re
from fractions import Fraction
from types import SimpleNamespace
from xml.etree import ElementTree

import pytest
from hypothesis import given
from hypothesis import strategies as st

from proofs.report.formulas import latex as latex_of
from proofs.report.formulas import lines, mathml
from proofs.trusted.kernel.trees import Variable, formula
from proofs.trusted.kernel.values import Equal, Series, Value

# -- an independent reading of LaTeX: no D, no at -----------------------------------------------

TOKEN = re.compile(r"\\left|\\right|\\,|\\cdot|\\[A-Za-z]+|\d+(?:\.\d+)?|[A-Za-z]|\S")
FUNCTIONS = {"\\sin": math.sin, "\\cos": math.cos, "\\exp": math.exp, "\\log": math.log}
SKIPPED = {"\\left", "\\right", "\\,"}


class Reader:
    """The value of a formula, by recursive descent."""

    def __init__(self, latex, values):
        self.tokens = [token for token in TOKEN.findall(latex) if token not in SKIPPED]
        self.values = values
        self.place = 0

    def peek(self):
        return self.tokens[self.place] if self.place < len(self.tokens) else ""

    def take(self, expected=None):
        token = self.peek()
        assert expected in (None, token), (expected, token, self.tokens)
        self.place += 1
        return token

    def whole(self):
        value = self.sum()
        assert not self.peek()
        return value

    def sum(self):
        value = 0.0
        sign = -1 if self.peek() == "-" and self.take() else 1
        while True:
            value += sign * self.product()
            if self.peek() not in ("+", "-"):
                return value
            sign = {"+": 1, "-": -1}[self.take()]

    def product(self):
        value = self.power()
        while self.peek() and self.peek() not in "+-)]}":
            if self.peek() == "\\cdot":
                self.take()
            value *= self.power()
        return value

    def power(self):
        token = self.take()
        if token in FUNCTIONS:
            exponent = self.script() if self.peek() == "^" else 1
            return FUNCTIONS[token](self.group("(", ")")) ** exponent
        if token == "(":
            value = self.sum()
            self.take(")")
        elif token == "\\frac":
            value = self.group("{", "}") / self.group("{", "}")
        elif token == "\\sqrt":
            value = math.sqrt(self.group("{", "}"))
        elif token[0].isdigit():
            value = float(token)
        else:
            value = self.symbol(token)
        return value ** self.script() if self.peek() == "^" else value

    def symbol(self, token):
        name = {"\\varepsilon": "epsilon"}.get(token, token.removeprefix("\\"))
        if self.peek() == "_":
            self.take()
            name += "_"
            if self.peek() == "{":
                self.take()
                while self.peek() != "}":
                    name += self.take()
                self.take()
            else:
                name += self.take()
        return math.pi if name == "pi" else self.values[name]

    def group(self, start, end):
        self.take(start)
        value = self.sum()
        self.take(end)
        return value

    def script(self):
        self.take("^")
        return self.group("{", "}") if self.peek() == "{" else float(self.take())


# -- what is set as LaTeX -------------------------------------------------------------------------

NAMES = {"x": 0.7, "omega_n": 1.3, "epsilon": 0.21, "phi1": 2.1, "t0": -0.4, "beta": 3.7}
VALUES = {re.sub(r"(?<=[a-z])(\d)", r"_\1", name): value for name, value in NAMES.items()}
SAFE = {"sin": math.sin, "cos": math.cos, "exp": math.exp, "pi": math.pi, "sqrt": math.sqrt}


def latex(text):
    return latex_of(formula(text))


@st.composite
def formulas(draw, depth=4):
    if depth == 0 or draw(st.integers(0, 5)) == 0:
        return draw(st.sampled_from([*NAMES, "2", "10", "pi"]))
    one, two = draw(formulas(depth=depth - 1)), draw(formulas(depth=depth - 1))
    forms = [f"({one}) + {two}", f"{one} - ({two})", f"({one})*({two})", f"({one})/({two})"]
    forms += [f"-({one})", f"({one})**2", f"sin({one})**2", f"cos({one})", f"exp({one})"]
    forms += [f"sqrt(({one})**2)", f"{one}*-({two})", f"{one}/({two})/3", f"-({one})*({two})"]
    return draw(st.sampled_from(forms))


@pytest.mark.slow
@given(formulas())
def test_the_value_is_that_of_the_text(text):
    try:
        expected = eval(text, {**SAFE, **NAMES})
        if not abs(expected) < 1e100:
            return
    except (ArithmeticError, ValueError):
        return
    found = Reader(latex(text), VALUES).whole()
    assert math.isclose(found, expected, rel_tol=1e-6, abs_tol=1e-9), latex(text)


@pytest.mark.parametrize(
    "text, expected",
    [
        ("-x**2", "-x^2"),
        ("a/b*c", r"\frac{a}{b} c"),
        ("a/b/c", r"\frac{a}{b c}"),
        ("a - (b - c)", "a - (b - c)"),
        ("x*2", r"x \cdot 2"),
        ("D(f, x, x)", r"\partial_{xx}(f)"),
        ("at(x*y, x=0, y=t)", r"{[u_1 u_2]}_{u_1 = 0,\,u_2 = t}"),
        ("omega_n*x0", r"\omega_n x_0"),
        ("lam*big", r"\lambda \mathrm{big}"),
    ],
)
def test_cases(text, expected):
    assert latex(text) == expected


def test_conclusions_say_all_that_they_hold():
    half, third = Fraction(1, 2), Fraction(1, 4)
    value = Value(
        formula("x*y"),
        ((Variable("x"), (half, half)), (Variable("y"), (third, half))),
        (-half, half),
    )
    text = " ".join(lines(value))
    assert text == r"x y \in [-0.5, 0.5] \text{for } x = 0.5,\ y \in [0.25, 0.5]"
    series = Series.read("sin(x)", "x", ("0", "1 + a", "0", "-1"), ("a",))
    text = " ".join(lines(series))
    assert (
        text == r"\sin(x) = (1 + a)\,x + (-1 x^3) + O(x^4) \text{as } x \to 0,\ "
        r"\text{where } a \ne 0"
    )
    assert lines(Equal.read("a", "b")) == ["a", "= b"]


@pytest.mark.slow
@given(formulas())
def test_mathml_is_well_formed_and_names_every_symbol(text):
    tree = ElementTree.fromstring(mathml(latex(text)))
    assert tree.tag == "math"
    shown = "".join(tree.itertext())
    for digits in re.findall(r"(?<![a-z\d])\d+", text):
        assert digits in shown


@pytest.mark.parametrize(
    ("low", "high", "expected"),
    [
        ("0.12345678901234567811", "0.12345678901234567923", "0.1234567890123456[78, 80]"),
        ("-0.12345678901234567823", "-0.12345678901234567811", "-0.12345678901234567[9, 8]"),
    ],
)
def test_long_decimals_are_shared_digits_rounded_outward(low, high, expected):
    shown = SimpleNamespace(latex=rf"{low} \le \dim A \le {high}")
    assert lines(shown) == [rf"\dim A = {expected}"]
    short = rf"{low[:6]} \le x \le {high[:6]}"
    assert lines(SimpleNamespace(latex=short)) == [short]
