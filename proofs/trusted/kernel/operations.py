"""The operations of formulas on enclosures, and the functions that a checker's numbers lack."""

from __future__ import annotations

import operator
from collections.abc import Callable
from fractions import Fraction
from math import isqrt
from typing import Any

from proofs.trusted.kernel import arithmetic, elementary
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved, rational
from proofs.trusted.kernel.enclose import size
from proofs.trusted.kernel.meter import METER

LARGEST = 256  # results beyond 2^256 are not followed
_NO_DATUM = Fraction(0)

ARITHMETIC: dict[str, Callable[..., Any]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
    "negative": operator.neg,
}


class Enclosures:
    """The operations on enclosures of one precision; a result beyond 2^256 raises Unproved."""

    def __init__(self, bits: int) -> None:
        self.bits = bits
        self._limit = 1 << (bits + LARGEST)

    def apply(self, op: str, arguments: list[Enclosure], datum: Fraction) -> Enclosure:
        """Enclose op(arguments)."""
        arithmetic = ARITHMETIC.get(op)
        result: Enclosure = (
            arithmetic(*arguments) if arithmetic else self._other(op, arguments, datum)
        )
        if result.hi >= self._limit or -result.lo >= self._limit:
            raise Unproved("a value beyond 2^256")
        return result

    def _other(self, op: str, arguments: list[Enclosure], datum: Fraction) -> Enclosure:
        if op == "number":
            METER.get().spend(size(datum) >> 8)
            return rational(datum, self.bits)
        if op == "pi":
            return arithmetic.pi(self.bits)
        return self._power(arguments[0], int(datum)) if op == "^" else _FUNCTIONS[op](arguments[0])

    def _power(self, x: Enclosure, n: int) -> Enclosure:
        """Enclose X^n: even powers grow with |x|, odd ones with x, negative ones are 1 / x^-n."""
        if n < 0:
            return rational(Fraction(1), self.bits) / self._power(x, -n)
        if n % 2 == 0 and x.lo < 0:
            least = 0 if x.hi >= 0 else -x.hi
            x = Enclosure(least, max(-x.lo, x.hi), self.bits)
        low, high = self._power_of_point(x.lo, n)[0], self._power_of_point(x.hi, n)[1]
        return Enclosure(low, high, self.bits)

    def _power_of_point(self, x: int, n: int) -> tuple[int, int]:
        """Return bounds of x^n, rounded at each product."""
        if x < 0:  # n is odd
            low, high = self._power_of_point(-x, n)
            return -high, -low
        low = high = x
        for bit in bin(n)[3:]:
            for a, b in ((low, high), (x, x))[: 1 + int(bit)]:
                low, high = low * a >> self.bits, -(-high * b >> self.bits)
                METER.get().spend(1 + (self.bits >> 7))
                if high >= self._limit:
                    raise Unproved("a value beyond 2^256")
        return low, high


def sqrt(x: Enclosure) -> Enclosure:
    """Enclose the square root: sqrt(n 2^-b) = sqrt(n 2^b) 2^-b, isqrt rounds down."""
    if x.lo < 0:
        raise Unproved("the square root of a number that may be negative")
    above = isqrt(x.hi << x.bits)
    return Enclosure(isqrt(x.lo << x.bits), above + (above**2 < x.hi << x.bits), x.bits)


def _exp(x: Enclosure) -> Enclosure:
    """Enclose exp, which increases: from the two ends."""
    low = elementary.exp(Enclosure(x.lo, x.lo, x.bits))
    return low.hull(elementary.exp(Enclosure(x.hi, x.hi, x.bits)))


def _log(x: Enclosure) -> Enclosure:
    """Enclose log, which increases: from the two ends."""
    if x.lo <= 0:
        raise Unproved("the logarithm of a number that may not be positive")
    low, high = (elementary.log(end, x.bits) for end in x.range)
    return low.hull(high)


_ATAN_HALVINGS = 3
_ATAN_GUARD = 16  # bits


def atan(x: Enclosure) -> Enclosure:
    """Enclose atan, which increases: from the two ends."""
    low, high = (_atan_of_point(Enclosure(end, end, x.bits)) for end in (x.lo, x.hi))
    return low.hull(high)


def _atan_of_point(x: Enclosure) -> Enclosure:
    """Enclose atan of a point.

    Proof. atan is odd; atan(y) = pi/2 - atan(1/y) for y > 0; atan(y) = 2 atan(y / (1 + sqrt(1 +
    y^2))) (half angles). After 3 halvings of y <= 1 it is tan(pi/32) < 1/8 at most, and the terms
    of y - y^3/3 + y^5/5 - ... alternate and fall: what is left out is smaller than the first
    term left out, which is below one unit of 2^-bits.
    """
    if x.lo < 0:
        return -_atan_of_point(-x)
    bits, guard = x.bits + _ATAN_GUARD, _ATAN_GUARD
    y = Enclosure(x.lo << guard, x.hi << guard, bits)
    if is_steep := x.lo > 1 << x.bits:
        y = rational(Fraction(1), bits) / y
    for _ in range(_ATAN_HALVINGS):
        y = y / (sqrt(y * y + 1) + 1)
    total, power, square, n = y, y, y * y, 1
    while power.hi > 1:
        power, n = power * square, n + 2
        total = total - power / n if n % 4 == 3 else total + power / n
    total = Enclosure(total.lo - 1, total.hi + 1, bits)
    total = total * 2**_ATAN_HALVINGS
    if is_steep:
        total = arithmetic.pi(bits) / 2 - total
    return Enclosure(total.lo >> guard, -(-total.hi >> guard), x.bits)


_FUNCTIONS: dict[str, Callable[[Enclosure], Enclosure]] = {
    "sqrt": sqrt,
    "exp": _exp,
    "log": _log,
    "sin": lambda x: x.sincos()[0],
    "cos": lambda x: x.sincos()[1],
    "atan": atan,
}
