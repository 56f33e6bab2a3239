"""Intervals of floats, not rounded outward: what a proof may look like. Never evidence.

They go where `Enclosure` goes: into the equations and the lemmas on flights. Where a search takes
its decisions by these, the checker's rules say whether they were right.
"""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

from intervals.errors import DomainError

_QUARTER = math.pi / 2


class Sketch:
    """About an interval of reals; as much of `Enclosure` as flights need, in units of 1."""

    __slots__ = ("hi", "lo")
    lo: float
    hi: float
    bits = 0

    def __init__(self, lo: float, hi: float) -> None:
        self.lo, self.hi = lo, hi

    @classmethod
    def of(cls, low: Fraction | float, high: Fraction | float, bits: int = 0) -> Sketch:
        """Return about [low, high]."""
        try:
            lo = float(low)
            return cls(lo, lo if high is low else float(high))
        except OverflowError:
            raise DomainError("larger than a float") from None

    @property
    def range(self) -> tuple[float, float]:
        """The endpoints."""
        return self.lo, self.hi

    def meet(self, other: Sketch) -> Sketch:
        """Return the common part; where rounding parts two that meet, what is between them."""
        low, high = max(self.lo, other.lo), min(self.hi, other.hi)
        return Sketch(min(low, high), max(low, high))

    def __neg__(self) -> Sketch:
        return Sketch(-self.hi, -self.lo)

    def __add__(self, value: Any) -> Sketch:
        other = _sketched(value)
        return Sketch(self.lo + other.lo, self.hi + other.hi)

    __radd__ = __add__

    def __sub__(self, value: Any) -> Sketch:
        other = _sketched(value)
        return Sketch(self.lo - other.hi, self.hi - other.lo)

    def __rsub__(self, value: float | Fraction) -> Sketch:
        return -self + value

    def __mul__(self, value: Any) -> Sketch:
        other = _sketched(value)
        a, b, c, d = self.lo, self.hi, other.lo, other.hi
        if c >= 0:
            return Sketch(a * (c if a >= 0 else d), b * (d if b >= 0 else c))
        if d <= 0:
            return Sketch(b * (c if b >= 0 else d), a * (d if a >= 0 else c))
        return Sketch(min(a * d, b * c), max(a * c, b * d))

    __rmul__ = __mul__

    def __truediv__(self, value: Any) -> Sketch:
        other = _sketched(value)
        if other.lo <= 0 <= other.hi:
            raise DomainError("division by what may be 0")
        return self * Sketch(1 / other.hi, 1 / other.lo)

    def __rtruediv__(self, value: float | Fraction) -> Sketch:
        return _sketched(value) / self

    def __pow__(self, exponent: int) -> Sketch:
        power = self
        for _ in range(exponent - 1):
            power = power * self
        return power

    def sincos(self) -> tuple[Sketch, Sketch]:
        """Return the sine and the cosine: the hull of those of the ends, and extremes between."""
        low, high = self.lo, self.hi
        if not -1e9 < low <= high < 1e9:
            raise DomainError("an angle too large for a float")
        sin, cos = math.sin(low), math.cos(low)
        if low == high:
            return Sketch(sin, sin), Sketch(cos, cos)
        last = math.sin(high), math.cos(high)
        ends = [[min(sin, last[0]), max(sin, last[0])], [min(cos, last[1]), max(cos, last[1])]]
        first = math.floor(low / _QUARTER) + 1
        for turn in range(first, min(math.floor(high / _QUARTER), first + 3) + 1):
            ends[1 - turn % 2][turn % 4 < 2] = 1.0 if turn % 4 < 2 else -1.0
        return Sketch(*ends[0]), Sketch(*ends[1])


def _sketched(value: Any) -> Sketch:
    """Return a number as a Sketch."""
    return value if isinstance(value, Sketch) else Sketch.of(value, value)
