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
k k' u, since k < 100. What is only to be rounded need not be `normal`: |lo| <= 2^-9 |hi| is enough.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from intervals.elementary.binary64.primitives import of, split

EPSILON = 2.0**-20
_TINY = 2.0**-1000
# For |y| >= 2^-960, y + u (1 + 2 u) |y| rounds to the number above y: Rump, Zimmermann, Boldo,
# Melquiond 2009, Computing predecessor and successor in rounding to nearest.
NEXT = 2.0**-53 * (1 + 2.0**-52)

Parts = tuple[Any, Any]


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
    """Return p = fl(a b) and e = a b - p exactly (Dekker)."""
    return _product(a, split(a), b, split(b))


def _product(a: Any, parts_of_a: Parts, b: Any, parts_of_b: Parts) -> Parts:
    (ah, al), (bh, bl) = parts_of_a, parts_of_b
    p = a * b
    return p, ((ah * bh - p) + ah * bl + al * bh) + al * bl


@dataclass(slots=True)
class Pair:
    """Reals Y with |hi + lo - Y| <= k u |Y|; lo may be the number 0 where hi alone is meant."""

    hi: Any
    lo: Any = 0.0
    k: float = 0.0

    def __neg__(self) -> Pair:
        return Pair(-self.hi, -self.lo, self.k)

    def normal(self) -> Pair:
        """Return the same numbers with the nearest hi."""
        return Pair(*fast_two_sum(self.hi, self.lo), self.k)

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
        (hi' + lo'). hi - p is exact (Sterbenz); the numerator is below
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
        functions = of(self.hi)
        y = functions.sqrt(self.hi)
        parts = split(y)
        p, e = _product(y, parts, y, parts)
        rest = ((self.hi - p) - e) + self.lo
        return Pair(y, rest / functions.maximum(2.0 * y, _TINY), 0.5 * self.k + EPSILON)

    def where(self, mask: Any, other: Pair) -> Pair:
        """Return these numbers where the mask holds, those of the other elsewhere."""
        where = of(self.hi).where
        hi, lo = where(mask, self.hi, other.hi), where(mask, self.lo, other.lo)
        return Pair(hi, lo, max(self.k, other.k))

    def with_sign_of(self, x: Any) -> Pair:
        """Return numbers >= 0 with the signs of x."""
        functions = of(x)
        lo = functions.where(x < 0.0, -self.lo, self.lo)
        return Pair(functions.copysign(self.hi, x), lo, self.k)


Bounds = Callable[[Pair], Parts]


def bounds(y: Pair) -> Parts:
    """Return upper bounds of -Y and of Y, near ones: see `ulps`.

    With d = fl((k + 1 + 2^-6) |hi| u), fl(hi + fl(lo + d)) >= Y if |lo| <= 2^-9 |hi|: the last sum
    loses at most u (1 + 2^-8) |hi|, the inner one and d itself 2^-8.9 u |hi|, and k u |Y| is at
    most k (1 + 2^-8) u |hi|, where k < 1; of normal pairs |lo| < 2^-40 |hi|, and k may be larger.
    """
    step = abs(y.hi) * ((y.k + 1.0 + 2.0**-6) * 2.0**-53)
    return (step - y.lo) - y.hi, (y.lo + step) + y.hi


def least_bounds(y: Pair) -> Parts:
    """Return the least upper bounds of -Y and of Y that what is known of Y allows: see `ulps`.

    With d = fl((k + 2^-6) |hi| u), hi + lo + d >= Y; and hi + fl(lo + d) is a number of binary64,
    s, and a rest, of which the sign says whether s or the next number is the bound. |hi| is 0 or
    above 2^-955.
    """
    step = abs(y.hi) * ((y.k + 2.0**-6) * 2.0**-53)
    return _next(*fast_two_sum(-y.hi, step - y.lo)), _next(*fast_two_sum(y.hi, y.lo + step))


def _next(s: Any, rest: Any) -> Any:
    """Return s, and the number above it where there is a rest > 0; see NEXT."""
    return s + abs(s) * NEXT * (rest > 0.0)


def ulps(k: float) -> float:
    """Return how many ulps of the bound, at most, are between one of `bounds` and Y.

    hi + lo errs by k u |Y|, d is (k + 1 + 2^-6) u |hi|, the last rounding half an ulp; and an ulp
    is more than u times the number. Of `least_bounds` they are half an ulp less: d is u |hi| less,
    and the last step at most an ulp.
    """
    return 2.0 * k + 1.5 + 2.0**-5
