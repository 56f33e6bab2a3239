"""Flows by extrapolation: Gragg's midpoint rule, made exact by Bulirsch and Stoer.

In long doubles, many solutions at once, or in mpmath's numbers. A reader of its own: texts by
Python's `eval`. nan where the section is not reached. It shares nothing with the Taylor series of
the checker.
"""

import re
from fractions import Fraction
from typing import Any, NamedTuple

import mpmath
import numpy as np

LATEST, FAR = 64, 1e9
FUNCTIONS = ("sin", "cos", "exp", "log", "sqrt")


class Numbers(NamedTuple):
    """The numbers of an integrator: steps, rows of its table, differences for derivatives."""

    dtype: Any
    real: Any
    functions: dict[str, Any]
    step: float
    row: tuple[int, ...]
    difference: float


LONG = Numbers(
    np.longdouble,
    np.longdouble,
    {name: getattr(np, name) for name in FUNCTIONS}
    | {"atan": np.arctan, "pi": np.longdouble("3.14159265358979323846264338327950288")},
    1 / 16,
    (2, 4, 6, 8, 12, 16, 20, 24),
    1e-5,
)
MANY = Numbers(
    object,
    mpmath.mpf,
    {name: np.frompyfunc(getattr(mpmath, name), 1, 1) for name in (*FUNCTIONS, "atan")}
    | {"pi": mpmath.pi},
    1 / 16,
    tuple(range(2, 34, 2)),
    1e-10,
)


class Solver:
    """The map of a flow in a file; parameters: a part of the way between their ends."""

    def __init__(self, data, numbers=LONG, part=Fraction(1, 3)):
        self.data, self.numbers = data, numbers
        sides = data.get("parameters", {}).items()
        self.parameters = {
            name: self._number(Fraction(a) + part * (Fraction(b) - Fraction(a)))
            for name, (a, b) in sides
        }
        end, time = data["end"], data["time"]
        gaps = end.get("gaps", [end.get("section", "")])
        gap = f"({end['time']}) - {time}" if "time" in end else gaps[0]
        self.count = int(end.get("count", "1"))
        self.sign = -1 if end.get("direction") == "+" else 1
        self.field, self.start, self.values, self.gap = map(
            self._function, (data["field"], data["start"], data["values"], [gap])
        )

    def _number(self, value):
        return self.numbers.real(Fraction(value).numerator) / Fraction(value).denominator

    def _function(self, texts):
        """A function of an environment: the values of some texts, a row each."""
        numbers = {**self.numbers.functions, "L": self.numbers.real}
        written = (re.sub(r"(?<!\*\*)\b(\d+)\b", r"L(\1)", text) for text in texts)
        code = compile("".join(f"({text}), " for text in written), "", "eval")
        return lambda env: np.array(
            [x + 0 * next(iter(env.values())) for x in eval(code, numbers, env)]
        )

    def _env(self, w, x, t):
        names = dict(zip(self.data["variables"], w, strict=True))
        names |= {name: value + 0 * w[0] for name, value in self.parameters.items()}
        states = dict(zip(self.data["state"], x, strict=True))
        return {**names, **states, self.data["time"]: t + 0 * w[0]}

    def _step(self, w, x, t, h):
        """The states after a time h, which may be an array."""
        table = []
        for n in self.numbers.row:
            s = h / n
            before, now = x, x + s * self.field(self._env(w, x, t))
            for k in range(1, n):
                rate = self.field(self._env(w, now, t + k * s))
                before, now = now, before + 2 * s * rate
            last = (now + before + s * self.field(self._env(w, now, t + h))) / 2
            line = [last]
            for j, other in enumerate(table[-1] if table else [], 1):
                ratio = self._number(Fraction(n, self.numbers.row[len(table) - j]))
                line.append(line[-1] + (line[-1] - other) / (ratio**2 - 1))
            table.append(line)
        return table[-1][-1]

    def _gap(self, w, x, t):
        return self.sign * self.gap(self._env(w, x, t))[0]

    def __call__(self, w):
        """The values, a row each, for variables w, a row each."""
        w, step = np.asarray(w, self.numbers.dtype), self.numbers.real(self.numbers.step)
        x = self.start(self._env(w, [0 * w[0]] * len(self.data["state"]), step * 0))
        result = np.full((len(self.data["values"]), w.shape[1]), np.nan, self.numbers.dtype)
        seen, here, steps = np.zeros(w.shape[1], int), np.arange(w.shape[1]), 0
        with np.errstate(all="ignore"):
            while here.size and steps * self.numbers.step < LATEST:
                own, t = w[:, here], steps * step
                after = self._step(own, x, t, step)
                above = self._gap(own, x, t) > (1e-15 if steps == 0 else 0)
                fell = above & (self._gap(own, after, t + step) <= 0)
                seen[here] += fell
                done = (seen[here] == self.count) & fell
                if done.any():
                    result[:, here[done]] = self._landed(own[:, done], x[:, done], t, step)
                going = ~done & (abs(after) < FAR).all(axis=0)
                x, here, steps = after[:, going], here[going], steps + 1
        return result

    def _landed(self, w, x, t, step):
        """The values where the gap is 0, by the rule of Anderson and Bjorck."""
        low, high = 0 * w[0], step + 0 * w[0]
        g_low, g_high = self._gap(w, x, t), self._gap(w, self._step(w, x, t, high), t + high)
        for _ in range(30):
            flat = g_low == g_high
            h = low + g_low * (high - low) / np.where(flat, 1, g_low - g_high)
            g = self._gap(w, self._step(w, x, t, h), t + h)
            left = g > 0
            base = np.where(left, g_low, g_high)
            ratio = 1 - g / np.where(base == 0, 1, base)
            ratio = np.where(ratio > 0, ratio, self._number("1/2"))
            g_low, g_high = np.where(left, g, g_low * ratio), np.where(left, g_high * ratio, g)
            low, high = np.where(left, h, low), np.where(left, high, h)
            if not np.any(g):
                break
        return self.values(self._env(w, self._step(w, x, t, h), t + h))

    def both(self, w):
        """The values, and the derivatives by differences, of the shape (values, variables, points).

        In one call, since a call costs more than its points.
        """
        w, h = np.asarray(w, self.numbers.dtype), self.numbers.real(self.numbers.difference)
        moves = [h * sign * unit[:, None] for unit in np.eye(len(w), dtype=int) for sign in (1, -1)]
        value, *others = np.split(self(np.hstack([w, *(w + x for x in moves)])), 1 + len(moves), 1)
        columns = [(a - b) / (2 * h) for a, b in zip(others[::2], others[1::2], strict=True)]
        return value, np.array(columns).swapaxes(0, 1)
