"""Taylor series over the checker's enclosures, with coefficients that are found when asked for.

A `Series` stands for functions x(h) = c_0 + c_1 h + ... that are analytic near h = 0: it encloses
the Taylor coefficients of them all. Each rule below is the recursion that the coefficients of the
result satisfy (Moore), so it encloses those too. A coefficient needs none of a higher order, so
it is found once, when it is asked for.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from math import isqrt

from proofs.trusted.kernel.arithmetic import Enclosure, Unproved, exp, log, rational
from proofs.trusted.kernel.meter import METER

Coefficient = Callable[[int], Enclosure]


class Series:
    """The series with coefficients rule(0), rule(1), ..., each found once and in this order.

    degree: no coefficient beyond it differs from 0; None where that is not known.
    """

    __slots__ = ("_found", "_rule", "degree")

    def __init__(self, rule: Coefficient, degree: int | None = None) -> None:
        self._rule, self.degree = rule, degree
        self._found: list[Enclosure] = []

    @classmethod
    def polynomial(cls, *coefficients: Enclosure) -> Series:
        """Return c_0 + c_1 h + ... + c_n h^n."""
        return cls(coefficients.__getitem__, len(coefficients) - 1)

    @classmethod
    def constant(cls, value: Enclosure) -> Series:
        """Return a constant function."""
        return cls.polynomial(value)

    def __getitem__(self, k: int) -> Enclosure:
        """Return the coefficient of h^k."""
        return 0 * self[0] if self.degree is not None and k > self.degree else self.up_to(k)[k]

    def up_to(self, k: int) -> list[Enclosure]:
        """Return the coefficients found so far, those up to h^k among them: k <= degree."""
        while len(self._found) <= k:
            self._found.append(self._rule(len(self._found)))
        return self._found

    def _like(self, other: Series | int) -> Series:
        if isinstance(other, Series):
            return other
        return Series.constant(0 * self[0] + other)

    def __neg__(self) -> Series:
        return Series(lambda k: -self[k], self.degree)

    def __add__(self, value: Series | int) -> Series:
        other = self._like(value)
        known = self.degree is not None and other.degree is not None
        degree = max(self.degree or 0, other.degree or 0) if known else None
        return Series(lambda k: self[k] + other[k], degree)

    __radd__ = __add__

    def __sub__(self, value: Series | int) -> Series:
        return self + -self._like(value)

    def __rsub__(self, value: int) -> Series:
        return -self + value

    def __mul__(self, value: Series | int) -> Series:
        if isinstance(value, int):
            return Series(lambda k: self[k] * value, self.degree)
        known = self.degree is not None and value.degree is not None
        degree = (self.degree or 0) + (value.degree or 0) if known else None
        return Series(lambda k: _convolution(self, value, k), degree)

    __rmul__ = __mul__

    def __pow__(self, n: int) -> Series:
        if n < 1:
            raise ValueError("only positive powers are needed")
        result = self
        for _ in range(n - 1):
            result = result * self
        return result

    def __truediv__(self, value: Series) -> Series:
        """Return q = self / value: value_0 q_k = self_k - sum of q_j value_(k-j), j < k."""

        def rule(k: int) -> Enclosure:
            return (self[k] - _convolution(quotient, value, k, last=k - 1)) / value[0]

        quotient = Series(rule, self.degree if value.degree == 0 else None)
        return quotient

    def derivative(self) -> Series:
        """Return the derivative."""
        degree = None if self.degree is None else max(0, self.degree - 1)
        return Series(lambda k: self[k + 1] * (k + 1), degree)

    def sincos(self) -> tuple[Series, Series]:
        """Return (s, c) = (sin, cos): s' = c u', c' = -s u' give k s_k and k c_k."""
        values, slopes = self[0].sincos(), self.derivative()
        sin = Series(lambda k: _convolution(cos, slopes, k - 1) / k if k else values[0])
        cos = Series(lambda k: -_convolution(sin, slopes, k - 1) / k if k else values[1])
        return sin, cos

    def exp(self) -> Series:
        """Return e = exp: e' = e u' gives k e_k."""
        value, slopes = exp(self[0]), self.derivative()
        result = Series(lambda k: _convolution(result, slopes, k - 1) / k if k else value)
        return result

    def log(self) -> Series:
        """Return log u for u > 0: its derivative is u' / u."""
        low, high = self[0].range
        if low <= 0:
            raise Unproved("the logarithm of an enclosure that leaves (0, oo)")
        bits = self[0].bits
        value, slope = log(low, bits).hull(log(high, bits)), self.derivative() / self
        return Series(lambda k: slope[k - 1] / k if k else value)

    def over_power(self, m: int) -> Series:
        """Return (c_m h^m + c_(m+1) h^(m+1) + ...) / h^m."""
        return Series(lambda k: self[k + m])


def polynomial(coefficients: Sequence[Fraction], x: Series) -> Series:
    """Return the polynomial with the given coefficients, lowest first, of a series.

    Blocks of about sqrt(n) terms, Horner's scheme between them, take 2 sqrt(n) products of series
    (Paterson, Stockmeyer 1973).
    """
    constants = [rational(c, x[0].bits) for c in coefficients]
    size = isqrt(len(constants)) + 1
    powers = [x]
    while len(powers) < size:
        powers.append(powers[-1] * x)
    blocks = [
        _combination(constants[first], constants[first + 1 : first + size], powers)
        for first in range(0, len(constants), size)
    ]
    total = blocks.pop()
    for block in reversed(blocks):
        total = total * powers[-1] + block
    return total


def _combination(first: Enclosure, others: list[Enclosure], series: list[Series]) -> Series:
    """Return first + the sum of the others times the series."""

    def rule(k: int) -> Enclosure:
        total = 0 * first if k else first
        for c, one in zip(others, series, strict=False):
            total = total + c * one[k]
        return total

    degrees = [one.degree for one in series[: len(others)]]
    known = [degree for degree in degrees if degree is not None]
    return Series(rule, max(known, default=0) if len(known) == len(degrees) else None)


def _convolution(a: Series, b: Series, k: int, last: int | None = None) -> Enclosure:
    """Enclose the sum of a_j b_(k-j), j = 0, ..., last (k if not given), rounded once.

    A product of enclosures lies between the least and the greatest of the four products of
    their ends; the sums of these are exact integers in units of 2^(-2 bits).
    """
    first = 0 if b.degree is None else max(0, k - b.degree)
    final = k if last is None else last
    if a.degree is not None:
        final = min(final, a.degree)
    low, high, bits = 0, 0, b[0].bits
    if first <= final:
        METER.get().spend((final - first + 1) * (1 + (bits >> 7)))
        left, right = a.up_to(final), b.up_to(k - first)
        for j in range(first, final + 1):
            x, y = left[j], right[k - j]
            ends = (x.lo * y.lo, x.lo * y.hi, x.hi * y.lo, x.hi * y.hi)
            low, high = low + min(ends), high + max(ends)
    return Enclosure(low >> bits, -(-high >> bits), bits)
