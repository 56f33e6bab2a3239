"""An independent reading of LaTeX formulas: their value, by recursive descent. No D, no at."""

import math
import re

TOKEN = re.compile(r"\\left|\\right|\\,|\\cdot|\\[A-Za-z]+|\d+(?:\.\d+)?|[A-Za-z]|\S")
FUNCTIONS = {"\\sin": math.sin, "\\cos": math.cos, "\\exp": math.exp, "\\log": math.log}
SKIPPED = {"\\left", "\\right", "\\,"}


class Reader:
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
