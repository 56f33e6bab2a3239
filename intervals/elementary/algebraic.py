"""sqrt, cbrt, n-th roots and hypot of dyadic numbers, tightest: see `tightest`.

They are algebraic, so that exact values occur; libmp's square root and floors tell them.
"""

from mpmath.libmp import from_man_exp, mpf_add, mpf_mul, mpf_neg, mpf_pos, mpf_sqrt

from intervals.elementary.ziv import (
    DOWN,
    UP,
    Bounds,
    Raw,
    beside,
    magnitude,
    negated,
    spacing,
)


def sqrt(x: Raw, precision: int) -> Bounds:
    """Return the bounds of sqrt x, for x >= 0."""
    return mpf_sqrt(x, precision, DOWN), mpf_sqrt(x, precision, UP)


def cbrt(x: Raw, precision: int) -> Bounds:
    """Return the bounds of the real cube root."""
    return root(x, 3, precision)


def root(x: Raw, n: int, precision: int) -> Bounds:
    """Return the bounds of the n-th root, n >= 1, of x >= 0, and of x < 0 for odd n.

    For x > 0, x = (N + f) 2^(n e) with an integer N of more than n * precision bits, 0 <= f < 1.
    The root lies in [r, r + 1) 2^e for r = floor(N^(1/n)), and is r 2^e if and only if f = 0 and
    r^n = N. r has more than `precision` bits, so r and r + 1 are rounded as the numbers between
    them are, or are such numbers: x^(1/n) / 2^e is rounded as 2 r or 2 r + 1, half as large.
    """
    if not x[1]:
        return x, x
    if x[0]:
        return negated(root(mpf_neg(x), n, precision))
    shift = max(0, n * (precision + 1) - x[3])
    shift += (x[2] - shift) % n
    man = x[1] << shift
    r = integer_root(man, n)
    twice = from_man_exp(2 * r + (r**n != man), (x[2] - shift) // n - 1)
    return mpf_pos(twice, precision, DOWN), mpf_pos(twice, precision, UP)


def integer_root(m: int, n: int) -> int:
    """Return floor(m^(1/n)), m >= 1, n >= 1.

    Newton's iteration for r^n = m from above decreases as long as r^n > m, and stays at or above
    the floor (its value is at least the mean of r, ..., r, m / r^(n-1)). It is started from the
    root of the leading half of m, one more and as many places; m < 2^(2 n) from 4.
    """
    places = m.bit_length() // (2 * n)
    r = (integer_root(m >> n * places, n) + 1) << places if places else 4
    while True:
        smaller = ((n - 1) * r + m // r ** (n - 1)) // n
        if smaller >= r:
            return r
        r = smaller


def hypot(x: Raw, y: Raw, precision: int) -> Bounds:
    """Return the bounds of sqrt(x^2 + y^2).

    The sum is exact, but where 0 < sqrt(x^2 + y^2) - |x| < y^2 / (2 |x|) settles the bounds.
    """
    if not x[1] or (y[1] and magnitude(x) < magnitude(y)):
        x, y = y, x
    x = (0, *x[1:])
    if y[1] and 2 * magnitude(y) - magnitude(x) <= spacing(x, precision):
        return beside(x, True, precision)
    return sqrt(mpf_add(mpf_mul(x, x), mpf_mul(y, y)), precision)
