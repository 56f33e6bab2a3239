"""Numbers as unevaluated sums of two binary64 numbers, with a bound on their relative error.

A `Pair` (hi, lo, k) stands for arrays of reals Y that nobody knows exactly:

    |hi + lo - Y| <= k u |Y|,    u = 2^-53,    k one number for the whole array.

k depends only on the formula, never on the data, so composing pairs composes proofs. The rules
below hold if the processor rounds to nearest, nothing overflows, and every nonzero hi is at least
2^-900 in absolute value, so that nothing that matters underflows (the callers see to that).
fl is one rounded operation, with a relative error of at most u.

Convention. |lo| <= c u |hi|, where c = 1 after `fast_two_sum` and each rule makes at most
c_1 + c_2 + 3 of the operands' c_1, c_2: below 2^8 in formulas of the size found here. So lo lo'
is below 2^16 u^2 |hi hi'|, a rounding of a lo below 2^9 u^2 |hi|, and a few of either below
EPSILON u |hi|, EPSILON = 2^-20, for which each rule has room. The same EPSILON covers the products
k k' u, since k < 100.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from intervals.rounding import Rows, constant, joined

EPSILON = 2.0**-20
_TINY = constant(2.0**-1000)
_HEAD = np.array(-(1 << 27))  # clears the last 27 bits of the mantissa

Parts = tuple[Any, Any]


def split(x: Any) -> Parts:
    """Return (h, l) with x = h + l exactly: h has 26 bits, l has 27 and is below 2^-25 |x|."""
    head = (x.view(np.int64) & _HEAD).view(np.float64)
    return head, x - head


def two_sum(a: Any, b: Any) -> Parts:
    """Return s = fl(a + b) and e = a + b - s exactly (Knuth)."""
    s = a + b
    t = s - a
    return s, (a - (s - t)) + (b - t)


def fast_two_sum(a: Any, b: Any) -> Parts:
    """Do `two_sum` for |a| >= |b|, or a = 0 (Dekker)."""
    s = a + b
    return s, b - (s - a)


def two_product(a: Any, b: Any) -> Parts:
    """Return p = fl(a b) and e with |a b - (p + e)| <= 2^-22 u |a b|.

    Proof. With the parts of `split` each partial product but the last is exact, having at most 53
    bits. ah bh differs from a b, and a b from p, by less than 2^-23 |a b|, so ah bh - p is exact
    (Sterbenz). What is rounded is at most 2^-24 |a b| for ah bl + al bh, and for the rest at most
    2^-50 |a b| three times: together less than 2^-23 u |a b|.
    """
    return _product(a, split(a), b, split(b))


def _product(a: Any, parts_of_a: Parts, b: Any, parts_of_b: Parts) -> Parts:
    (ah, al), (bh, bl) = parts_of_a, parts_of_b
    p = a * b
    return p, ((ah * bh - p) + (ah * bl + al * bh)) + al * bl


@dataclass(slots=True)
class Pair:
    """Reals Y with |hi + lo - Y| <= k u |Y|; lo may be the number 0 where hi alone is meant."""

    hi: Any
    lo: Any = 0.0
    k: float = 0.0

    def __neg__(self) -> Pair:
        return Pair(-self.hi, -self.lo, self.k)

    def __getitem__(self, index: Any) -> Pair:
        return Pair(self.hi[index], self.lo[index], self.k)

    def scaled(self, power: Any) -> Pair:
        """Return the product with powers of two, exactly."""
        return Pair(self.hi * power, self.lo * power, self.k)

    def __add__(self, other: Pair) -> Pair:
        """Return the sum of numbers of one sign; k = max(k_1, k_2).

        The sum of the hi is exact, the sums of the lo are among the roundings of a lo, and
        k_1 u |Y_1| + k_2 u |Y_2| <= max(k_1, k_2) u |Y_1 + Y_2|.
        """
        s, e = two_sum(self.hi, other.hi)
        return Pair(s, e + (self.lo + other.lo), max(self.k, other.k) + EPSILON)

    def __mul__(self, other: Pair) -> Pair:
        """Return the product; k = k_1 + k_2. (1 + a)(1 + b) - 1 <= a + b + a b."""
        p, e = two_product(self.hi, other.hi)
        lo = e + (self.hi * other.lo + self.lo * other.hi)
        return Pair(p, lo, self.k + other.k + EPSILON)

    def __truediv__(self, other: Pair) -> Pair:
        """Return the quotient; k = k_1 + k_2.

        With q = fl(hi / hi') and q hi' = p + e, the quotient is q + (hi - p - e + lo - q lo') /
        (hi' + lo'). hi - p is exact (Sterbenz); e is known to 2^-22 u |hi|; the numerator is below
        2^9 u |hi|, so that leaving lo' out of the divisor costs less than 2^17 u^2 |q|.
        """
        q = self.hi / other.hi
        p, e = two_product(q, other.hi)
        rest = ((self.hi - p) - e) + (self.lo - q * other.lo)
        return Pair(q, rest / other.hi, self.k + other.k + EPSILON)

    def sqrt(self) -> Pair:
        """Return the square root of numbers >= 0; k = k_1 / 2.

        With y = fl(sqrt hi), r = hi + lo - y^2: sqrt(hi + lo) = y + r / (2 y) - d, where
        0 <= d <= r^2 / (8 y^3) < 2^18 u^2 y; sqrt(1 + a) errs from 1 by at most |a| / 2 + a^2.
        sqrt 0 = 0, since there r = 0.
        """
        y = np.sqrt(self.hi)
        parts = split(y)
        p, e = _product(y, parts, y, parts)
        rest = ((self.hi - p) - e) + self.lo
        return Pair(y, rest / np.maximum(2.0 * y, _TINY), 0.5 * self.k + EPSILON)

    def where(self, mask: Any, other: Pair) -> Pair:
        """Return these numbers where the mask holds, those of the other elsewhere."""
        hi, lo = np.where(mask, self.hi, other.hi), np.where(mask, self.lo, other.lo)
        return Pair(hi, lo, max(self.k, other.k))

    def with_sign_of(self, x: Rows) -> Pair:
        """Return numbers >= 0 with the signs of x."""
        return Pair(np.copysign(self.hi, x), np.where(x < 0.0, -self.lo, self.lo), self.k)

    def rows(self, lower: Any = ..., upper: Any = ...) -> Rows:
        """Return rows (-lower, upper) of the numbers, or from one index to another."""
        step = self._step()
        below, above = (step - self.lo) - self.hi, (self.lo + step) + self.hi
        return joined(below[lower], above[upper])

    def upper(self) -> Rows:
        """Return upper bounds."""
        result: Rows = (self.lo + self._step()) + self.hi
        return result

    def _step(self) -> Rows:
        """Return d so that fl(hi + fl(lo + d)) >= Y; this bound is near, too: see `ulps`.

        d = fl((k + 1 + 2^-8) |hi| u). The last sum loses at most u (1 + (k + 2^9) u) |hi|, the
        inner one and d itself below 2^-20 u |hi|, and |Y| <= (1 + 2^-30) |hi|.
        """
        step: Rows = np.abs(self.hi)
        step *= (self.k + 1.0 + 2.0**-8) * 2.0**-53
        return step


def ulps(k: float) -> float:
    """Return how many ulps of the bound, at most, separate the bound from Y: 2 k + 1.5 + 2^-7.

    hi + lo errs by k u |Y|, d is (k + 1 + 2^-8) u |hi|, the last rounding half an ulp; and an ulp
    is more than u times the number.
    """
    return 2.0 * k + 1.5 + 2.0**-7
