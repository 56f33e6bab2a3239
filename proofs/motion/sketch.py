"""Intervals of floats, not rounded outward: what a proof may look like. Never evidence.

Where a search takes its decisions by these, the checker's rules say whether they were right.
"""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

from intervals.errors import DomainError

_QUARTER = math.pi / 2


class Sketch:
    """About an interval of reals; as much of `Interval` as equations of motion need."""

    __slots__ = ("inf", "sup")
    inf: float
    sup: float
    precision = 53

    def __init__(
        self, lower: float | Fraction, upper: float | Fraction | None = None, *, precision: int = 53
    ) -> None:
        try:
            self.inf = float(lower)
            self.sup = self.inf if upper is None or upper is lower else float(upper)
        except OverflowError:
            raise DomainError("larger than a float") from None

    @property
    def wid(self) -> float:
        """The width."""
        return self.sup - self.inf

    @property
    def mid(self) -> float:
        """The middle."""
        return (self.inf + self.sup) / 2

    @property
    def mig(self) -> float:
        """The least absolute value."""
        return max(self.inf, -self.sup, 0.0)

    def certainly_positive(self) -> bool:
        """Whether all of it seems to be > 0."""
        return self.inf > 0

    def certainly_negative(self) -> bool:
        """Whether all of it seems to be < 0."""
        return self.sup < 0

    def contains_zero(self) -> bool:
        """Whether 0 seems to be in it."""
        return self.inf <= 0 <= self.sup

    def intersection(self, other: Sketch) -> Sketch:
        """Return the common part; where rounding parts two that meet, what is between them."""
        low, high = max(self.inf, other.inf), min(self.sup, other.sup)
        return _made(min(low, high), max(low, high))

    def __neg__(self) -> Sketch:
        return _made(-self.sup, -self.inf)

    def __add__(self, value: Any) -> Sketch:
        other = _sketched(value)
        if other is None:
            return NotImplemented
        return _made(self.inf + other.inf, self.sup + other.sup)

    __radd__ = __add__

    def __sub__(self, value: Any) -> Sketch:
        other = _sketched(value)
        if other is None:
            return NotImplemented
        return _made(self.inf - other.sup, self.sup - other.inf)

    def __rsub__(self, value: float | Fraction) -> Sketch:
        return -self + value

    def __mul__(self, value: Any) -> Sketch:
        other = _sketched(value)
        if other is None:
            return NotImplemented
        a, b, c, d = self.inf, self.sup, other.inf, other.sup
        if c >= 0:
            return _made(a * (c if a >= 0 else d), b * (d if b >= 0 else c))
        if d <= 0:
            return _made(b * (c if b >= 0 else d), a * (d if a >= 0 else c))
        return _made(min(a * d, b * c), max(a * c, b * d))

    __rmul__ = __mul__

    def __truediv__(self, value: Any) -> Sketch:
        other = _sketched(value)
        if other is None:
            return NotImplemented
        if other.contains_zero():
            raise DomainError("division by what may be 0")
        return self * _made(1 / other.sup, 1 / other.inf)

    def __rtruediv__(self, value: float | Fraction) -> Sketch:
        return Sketch(value) / self

    def __pow__(self, exponent: int) -> Sketch:
        power = self
        for _ in range(exponent - 1):
            power = power * self
        return power

    def sincos(self) -> tuple[Sketch, Sketch]:
        """Return the sine and the cosine: the hull of those of the ends, and extremes between."""
        low, high = self.inf, self.sup
        if not -1e9 < low <= high < 1e9:
            raise DomainError("an angle too large for a float")
        sin, cos = math.sin(low), math.cos(low)
        if low == high:
            return _made(sin, sin), _made(cos, cos)
        last = math.sin(high), math.cos(high)
        ends = [[min(sin, last[0]), max(sin, last[0])], [min(cos, last[1]), max(cos, last[1])]]
        first = math.floor(low / _QUARTER) + 1
        for turn in range(first, min(math.floor(high / _QUARTER), first + 3) + 1):
            ends[1 - turn % 2][turn % 4 < 2] = 1.0 if turn % 4 < 2 else -1.0
        return _made(*ends[0]), _made(*ends[1])


def _made(low: float, high: float) -> Sketch:
    """Return a Sketch of floats, without more ado."""
    found = object.__new__(Sketch)
    found.inf, found.sup = low, high
    return found


def _sketched(value: Any) -> Sketch | None:
    """Return a number as a Sketch; None where it is none."""
    if isinstance(value, Sketch):
        return value
    if isinstance(value, int):
        return _made(value, value)
    return Sketch(value) if isinstance(value, (int, float, Fraction)) else None
