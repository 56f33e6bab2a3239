"""Sums, products and quotients of a few intervals, by Python's floats: the bits of `rows`, sooner.

Where the numbers are short the results are exact, here one by one.
"""

from collections.abc import Callable
from math import frexp

import numpy as np

from intervals.errors import DomainError
from intervals.rounding import ETA, MAX, ULP, Rows

ZERO_INSIDE = "division by an interval that contains 0"
MOST = 10  # intervals: they are done sooner without numpy
LOW, HIGH, HALF = 2.0**-400, 2.0**400, 2.0**26

Ends = Callable[[float, float, float, float], tuple[float, float]]


def one_by_one(ends: Ends, a: Rows, b: Rows) -> Rows:
    """Return the rows of an operation that is given by the ends; OverflowError where it is."""
    x, y = a.ravel().tolist(), b.ravel().tolist()
    if len(x) == 2:
        return np.array(ends(*x, *y)).reshape(a.shape)
    n = len(x) // 2
    columns = map(ends, x[:n], x[n:], y[:n], y[n:])
    return np.array([*zip(*columns, strict=True)]).reshape(a.shape)


def is_half(x: float) -> bool:
    """Return whether x has at most 26 bits."""
    return frexp(x)[0] * HALF % 1.0 == 0.0


def _is_fit(x: float) -> bool:
    return is_half(x) and (x == 0.0 or LOW < abs(x) < HIGH)


def total(a: float, b: float, c: float, d: float) -> tuple[float, float]:
    """Return the row of [-a, b] + [-c, d]."""
    x, y = a + c, b + d
    if not (x - a == c and x - c == a):
        x += abs(x) * ULP
    if not (y - b == d and y - d == b):
        y += abs(y) * ULP
    return _finite(x, y)


def product(a: float, b: float, c: float, d: float) -> tuple[float, float]:
    """Return the row of [-a, b] [-c, d]."""
    p, q, r, s = a * c, b * d, a * d, b * c
    if all(map(_is_fit, (a, b, c, d))):
        return max(r, s, -p, -q), max(p, q, -r, -s)
    return _outermost(p, q, r, s)


def quotient(a: float, b: float, c: float, d: float) -> tuple[float, float]:
    """Return the row of [-a, b] / [-c, d]; DomainError if 0 is in the divisor."""
    if not (c < 0.0 or d < 0.0):
        raise DomainError(ZERO_INSIDE)
    p, q, r, s = a / c, b / d, a / d, b / c
    products = ((p, c, a), (q, d, b), (r, d, a), (s, c, b))
    if all(_is_fit(x) and _is_fit(y) and x * y == z for x, y, z in products):
        return max(r, s, -p, -q), max(p, q, -r, -s)
    return _outermost(p, q, r, s)


def _outermost(p: float, q: float, r: float, s: float) -> tuple[float, float]:
    """Do `outward` for `_hull_of_four`, of numbers."""
    x, y = max(r, s, -p, -q), max(p, q, -r, -s)
    x += abs(x) * ULP + ETA
    y += abs(y) * ULP + ETA
    return _finite(x, y)


def _finite(x: float, y: float) -> tuple[float, float]:
    if not (x < MAX and y < MAX):  # nor NaN: infinities are done by arrays
        raise OverflowError
    return x, y
