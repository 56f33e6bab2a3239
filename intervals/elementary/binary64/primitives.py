"""What the kernels do beside + - * /, of floats and of arrays of binary64 alike, to the same bits.

A kernel is written once, of numbers x that are floats or arrays: `of(x)` has the functions of its
kind under numpy's names. Python's floats are done sooner where there are few of them.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

import numpy as np

SHIFT = 1.5 * 2.0**52
SHIFT_BITS = int(np.array(SHIFT).view(np.int64))
_SPLIT = 2.0**27 + 1
BITS = 160  # of the integers that tables are made from


class _Floats:
    """numpy's functions, of floats."""

    abs, sqrt, copysign = abs, math.sqrt, math.copysign
    maximum, minimum = max, min

    @staticmethod
    def where(mask: bool, x: float, y: float) -> float:
        return x if mask else y

    @staticmethod
    def cbrt(x: float) -> Any:
        return np.cbrt(x).item()


def of(x: Any) -> Any:
    """Return the functions of numbers of this kind."""
    return _Floats if type(x) is float else np


class Table:
    """Numbers by an index, which is an int or an array of ints."""

    def __init__(self, values: Iterable[float]) -> None:
        self.numbers = [*values]
        self._array = np.array(self.numbers)

    def __getitem__(self, index: Any) -> Any:
        if type(index) is int:
            return self.numbers[index]
        return self._array.take(index, mode="clip")


def tables(values: Iterable[int], places: int) -> tuple[Table, Table]:
    """Return the multiples of 2^-places that are next to x / 2^BITS, and the rests."""
    unit, numbers = 1 << (BITS - places), [*values]
    heads = [(x + (unit >> 1)) // unit for x in numbers]
    rests = [(x - head * unit) / (1 << BITS) for x, head in zip(numbers, heads, strict=True)]
    return Table(math.ldexp(head, -places) for head in heads), Table(rests)


def horner(z: Any, coefficients: tuple[float, ...]) -> Any:
    """Return the polynomial in z, highest coefficient first: a rounding for each * and +."""
    total = z * coefficients[0]
    for coefficient in coefficients[1:-1]:
        total += coefficient
        total *= z
    total += coefficients[-1]
    return total


def nearest_integers(x: Any) -> tuple[Any, Any]:
    """Return the integers n nearest to x, |x| < 2^51, as floats and as ints; x is used up.

    fl(x + 1.5 2^52) has the spacing 1, so it is n + 1.5 2^52, and n is what its bits count.
    """
    x += SHIFT
    if type(x) is float:
        return x - SHIFT, int(x - SHIFT)
    integers = x.view(np.int64) - SHIFT_BITS
    x -= SHIFT
    return x, integers


def power_of_two(n: Any) -> Any:
    """Return 2^n for -1022 <= n <= 1023, of an array from its bits."""
    return math.ldexp(1.0, n) if type(n) is int else ((n + 1023) << 52).view(np.float64)


def split(x: Any) -> tuple[Any, Any]:
    """Return h and l, of 26 bits, with x = h + l exactly, |x| < 2^996 (Veltkamp)."""
    scaled = x * _SPLIT
    head = scaled - (scaled - x)
    return head, x - head
