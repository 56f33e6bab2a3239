"""The four operations on intervals next to cancellation, zero, overflow and underflow."""

from __future__ import annotations

import operator
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from random import Random
from typing import Any

from intervals import Interval, IntervalArray
from proofs.stress.cases import Answer, Truth
from proofs.stress.functions import ValueCase, rounded_down, value_of
from proofs.stress.kernels import Kernel, Range

_OPERATIONS: dict[str, Any] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
}
_PRECISIONS = (53, 53, 24, 64, 200)


@dataclass(frozen=True)
class OperationCase(ValueCase):
    """[low, high] operation [left, right], their ends of at most `precision` bits.

    In a binary64 array where `precision` is 53 and `array` is.
    """

    operation: str
    low: Fraction
    high: Fraction
    left: Fraction
    right: Fraction
    precision: int
    array: bool

    @property
    def rounding(self) -> tuple[int, bool]:
        """The precision, and whether it is of an array."""
        return self.precision, self.array

    def answer(self) -> Answer:
        """Return the enclosure."""
        x: Any = self.low, self.high
        y: Any = self.left, self.right
        if self.array:
            easy = Fraction(3, 4)
            x, y = IntervalArray([easy, x, easy]), IntervalArray([easy, y, easy])
        else:
            x, y = (Interval(*ends, precision=self.precision) for ends in (x, y))
        return value_of(_OPERATIONS[self.operation](x, y))

    def truths(self, kernel: Kernel) -> Sequence[Truth | None]:
        """Return the two ends of the range, exact: they are values at ends."""
        if self.operation == "/" and self.left <= 0 <= self.right:
            return [Truth({}, "a quotient by 0")]
        apply = _OPERATIONS[self.operation]
        values = [apply(a, b) for a in (self.low, self.high) for b in (self.left, self.right)]
        return [Truth({"value": (end, end)}) for end in (min(values), max(values))]


def draw(generator: Random) -> OperationCase:
    """Return a random operation on random hard operands."""
    array = generator.random() < 0.5
    precision = 53 if array else generator.choice(_PRECISIONS)
    low, high = _operand(generator, precision)
    left, right = _operand(generator, precision)
    if generator.random() < 0.3:  # next to cancellation
        left, right = (low, high) if generator.random() < 0.5 else (-high, -low)
        right += abs(right) / 2 ** (precision - 2)
        right = -rounded_down(-right, precision)
    return OperationCase(
        "operations", generator.choice("+-*/"), low, high, left, right, precision, array
    )


def _operand(generator: Random, bits: int) -> Range:
    """Return an interval of tiny, large or plain numbers, or one around 0."""
    scale = generator.choice((0, 0, 0, 1, -1)) * generator.randrange(1, 1000)
    low = generator.choice((-1, 1)) * Fraction(generator.getrandbits(bits), 1 << bits)
    width = abs(low) / (1 << generator.choice((bits - 1, bits // 2, 1)))
    width = generator.choice((0, 1, 1)) * width + generator.choice((0, 0, 0, 1)) * abs(low)
    ends = (low * Fraction(2) ** scale, (low + width) * Fraction(2) ** scale)
    down = rounded_down(ends[0], bits)
    return down, max(down, -rounded_down(-ends[1], bits))
