"""Intervals as text, in decimals that enclose: for people, for notebooks, and to be read back."""

from __future__ import annotations

import re
from collections.abc import Iterable
from decimal import ROUND_CEILING, ROUND_FLOOR, Context, Decimal
from fractions import Fraction
from html import escape
from typing import Any

from intervals.exact import decimal_down, decimal_places, decimal_up

_DIGITS = 17  # significant digits, enough to tell binary64 numbers apart
_ROWS = 20
_DOWN, _UP = (Context(prec=_DIGITS, rounding=mode) for mode in (ROUND_FLOOR, ROUND_CEILING))


def text(low: Fraction, high: Fraction, digits: int) -> str:
    """Return [low, high] in decimals of so many significant digits, rounded outward."""
    return f"[{decimal_down(low, digits)}, {decimal_up(high, digits)}]"


def formatted(low: Fraction, high: Fraction, spec: str) -> str:
    """Return [low, high] by a format specification, each end rounded outward.

    "20" and ".20g" ask for 20 significant digits, ".20f" for as many after the point, ".20e" for a
    power of ten behind 21 significant digits; other specifications raise ValueError.
    """
    asked = re.fullmatch(r"(\d+)|\.(\d+)([efg])", spec)
    if asked is None:
        raise ValueError(f"not a number of digits, nor .digits and e, f or g: {spec!r}")
    digits, kind = int(asked[1] or asked[2]), asked[3]
    if kind == "f":
        return f"[{decimal_places(low, digits)}, {decimal_places(high, digits, up=True)}]"
    if kind == "e":
        first, last = map(Decimal, (decimal_down(low, digits + 1), decimal_up(high, digits + 1)))
        return f"[{first or 0.0:.{digits}e}, {last or 0.0:.{digits}e}]"
    return text(low, high, digits)


def latex(low: Fraction, high: Fraction, digits: int) -> str:
    """Return the same as LaTeX."""
    return f"$\\left[{decimal_down(low, digits)},\\ {decimal_up(high, digits)}\\right]$"


def _binary64(low: float, high: float) -> tuple[str, str]:
    """Return decimals of at most 17 digits, one not above and one not below."""
    return _short(_DOWN.create_decimal(Decimal(low))), _short(_UP.create_decimal(Decimal(high)))


def _short(value: Decimal) -> str:
    value = value.normalize(_DOWN)  # which drops zeros at the end, and has room for the digits
    return f"{value:f}" if -5 < value.adjusted() < _DIGITS else str(value)


def array_text(lower: Any, upper: Any) -> str:
    """Return nested lists of [low, high], which the constructor reads back as supersets."""
    import numpy as np

    texts = np.empty(lower.shape, dtype=object)
    for index in np.ndindex(lower.shape):
        texts[index] = "[{}, {}]".format(*_binary64(float(lower[index]), float(upper[index])))
    return np.array2string(texts, formatter={"all": str}, separator=", ", threshold=20)


def html(shape: tuple[int, ...], elements: Iterable[tuple[float, float]], size: int) -> str:
    """Return an HTML table of the first intervals of an array, with their indices."""
    import numpy as np

    lines = [
        f"<tr><th>{escape(str(index))}</th><td>{low}</td><td>{high}</td></tr>"
        for _, index, bounds in zip(range(_ROWS), np.ndindex(shape), elements, strict=False)
        for low, high in [_binary64(*bounds)]
    ]
    if size > _ROWS:
        lines.append(f"<tr><td colspan='3'>and {size - _ROWS} more</td></tr>")
    head = f"<caption>IntervalArray {escape(str(shape))}</caption>"
    titles = "<tr><th></th><th>inf</th><th>sup</th></tr>"
    return f"<table>{head}{titles}{''.join(lines)}</table>"
