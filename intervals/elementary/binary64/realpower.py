"""x^y for x > 0 over arrays of boxes, in binary64.

Theorem. For normal x > 0, `_log` returns a pair for log x with k = 2^-11.

Proof. x = m 2^e, 0.7071 <= m <= 1.4143. j = round(128 m), R = round(2^15 / j) / 2^8, so that
r = m R - 1 has |r| <= 2^-8 R + |R j / 128 - 1| <= 0.0083; it is exact in two parts, since R has 9
bits. log x = e log 2 - log R + r - r^2 / 2 + r^3 q, q = 1/3 - r/4 + ... - r^7/10, up to |r|^11/10,
below 2^-78 and 2^-55 |r|^3. The first parts of e log 2, -log R, r and r^2 / 2 are summed exactly in
two parts each. The rest is rounded: r^3 q with 6 relative errors, ten roundings of sums no larger.
|r^3 q| < 2^-22.2, and < 2^-23.3 where |log m| < 0.1: R is between 0.9 and 1.11, |r| < 0.0065 there.
So the sum errs by 2^-18 u at most beside |log x| >= 0.1, and by 2^-19.3 u beside 0.0038 <= |log x|.
For less than this e = 0, R = 1, |r| < 0.004, and it is 16 |r|^2 / 3 u at most beside 0.99 |r|.
The tables and e log 2 are known to 2^-85.
"""

from fractions import Fraction
from functools import lru_cache

import numpy as np

from intervals.elementary.binary64 import fallback
from intervals.elementary.binary64.blocks import Mask, in_blocks, lower_upper, moderate
from intervals.elementary.binary64.exponential import LOG_2, exp
from intervals.elementary.binary64.fallback import Ends
from intervals.elementary.binary64.logarithm import mantissa
from intervals.elementary.binary64.pair import Pair, fast_two_sum, split, two_product, two_sum
from intervals.elementary.binary64.polynomial import horner, polynomial
from intervals.rounding import MAX, Rows
from intervals.rows import aligned, is_thin, nonnegative

_LEAST_NORMAL = 2.0**-1022
_FIRST, _LAST = 90, 182
_SERIES = polynomial((-1) ** (k + 1) / k for k in range(10, 2, -1))


def power(x: Rows, y: Rows) -> Rows:
    """Return rows of x^y, x in X, y in Y, where X > 0, or X >= 0 and Y > 0.

    x^y is monotone in x and in y, so its extremes are at corners.
    """

    def exactly(a: Ends, b: Ends) -> Ends:
        return fallback.at_corners("power", a, b)

    return in_blocks(_power, exactly, *aligned(x, y))


def _power(x: Rows, y: Rows) -> tuple[Rows, Mask]:
    bases, exponents = _ends(x), _ends(y)
    products = Pair(exponents[np.newaxis]) * _log(bases)[:, np.newaxis]
    size = np.max(np.abs(products.hi), axis=(0, 1))
    proved = (
        ((bases >= _LEAST_NORMAL) & (bases <= MAX)).all(axis=0)
        & np.all(moderate(exponents), axis=0)
        & (size <= 640.0)
    )
    powers = exp(products)
    rows = np.stack([np.max(v.upper(), axis=(0, 1)) for v in (-powers, powers)])
    return nonnegative(rows), proved


def _ends(rows: Rows) -> Rows:
    """Return the lower and upper ends, or the points once: shape (2 or 1, n)."""
    return rows[1:] if is_thin(rows) else lower_upper(rows)


def _log(x: Rows) -> Pair:
    """Return log x, see the theorem."""
    exponent, m = mantissa(x)
    index = np.rint(128.0 * m).astype(np.int64)
    index -= _FIRST
    inverses, high, low = _tables()
    inverse = inverses.take(index, mode="clip")
    head, tail = split(m)
    r, rest = two_sum(head * inverse - 1.0, tail * inverse)
    square, e = two_product(r, r)
    cubic = horner(r, _SERIES)
    cubic *= square * r
    e *= -0.5
    cubic += e - r * rest
    n = exponent.astype(np.float64)
    total, error = two_sum(n * LOG_2[0], high.take(index, mode="clip"))
    rest += error + (n * LOG_2[1] + low.take(index, mode="clip"))
    for term in (r, -0.5 * square):
        total, error = two_sum(total, term)
        rest += error
    rest += cubic
    return Pair(*fast_two_sum(total, rest), 2.0**-11)


@lru_cache(maxsize=1)
def _tables() -> tuple[Rows, Rows, Rows]:
    """Return R for j = 90, ..., 182, and -log R in two parts."""
    from intervals.interval import Interval

    inverses = [Fraction(round(Fraction(2**15, j)), 2**8) for j in range(_FIRST, _LAST + 1)]
    exact = [-Interval(x, precision=160).log().inf for x in inverses]
    high = [float(x) for x in exact]
    low = [float(x - Fraction(h)) for x, h in zip(exact, high, strict=True)]
    return np.array([float(x) for x in inverses]), np.array(high), np.array(low)
