"""Intervals in notebooks: decimals that enclose, as LaTeX and HTML."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

from intervals.exact import decimal_down, decimal_up

if TYPE_CHECKING:
    from intervals.array import IntervalArray
    from intervals.interval import Interval

_DIGITS = 17  # significant digits, enough to tell binary64 numbers apart
_ROWS = 20


def decimals(x: Interval, digits: int = _DIGITS) -> tuple[str, str]:
    """Return decimals of `digits` significant digits below and above the interval."""
    return decimal_down(x.inf, digits), decimal_up(x.sup, digits)


def latex(x: Interval) -> str:
    """Return LaTeX for an interval."""
    low, high = decimals(x, max(3, x.precision * 3 // 10))
    return f"$\\left[{low},\\ {high}\\right]$"


def html(x: IntervalArray) -> str:
    """Return an HTML table of the first intervals of an array, with their indices."""
    import numpy as np

    flat = x.reshape(-1)
    lines = [
        f"<tr><th>{escape(str(index))}</th><td>{low}</td><td>{high}</td></tr>"
        for index, element in zip(np.ndindex(x.shape), flat[:_ROWS], strict=False)
        for low, high in [decimals(element.item())]
    ]
    if x.size > _ROWS:
        lines.append(f"<tr><td colspan='3'>and {x.size - _ROWS} more</td></tr>")
    head = f"<caption>IntervalArray {escape(str(x.shape))}</caption>"
    titles = "<tr><th></th><th>inf</th><th>sup</th></tr>"
    return f"<table>{head}{titles}{''.join(lines)}</table>"
