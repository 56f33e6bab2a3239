"""sqrt, cbrt, n-th roots and hypot of dyadic numbers, tightest: see `tightest`.

They are algebraic, so that exact values occur; floors tell them.
"""

from math import isqrt

from mpmath.libmp import from_man_exp, mpf_add, mpf_mul, mpf_neg, mpf_pos

from intervals.elementary.ziv import (
    DOWN,
    UP,
    Bounds,
    Raw,
    beside,
    magnitude,
    negated,
    spacing,
    tighten,
)


def sqrt(x: Raw, precision: int) -> Bounds:
    """Return the bounds of sqrt x, for x >= 0."""
    return root(x, 2, precision)


def cbrt(x: Raw, precision: int) -> Bounds:
    """Return the bounds of the real cube root."""
    return root(x, 3, precision)


def root(x: Raw, n: int, precision: int) -> Bounds:
    """Return the bounds of the n-th root, n >= 1, of x >= 0, and of x < 0 for odd n.

    For x > 0, x = N 2^(n e) with an integer N of more than n * precision bits. The root lies in
    [r, r + 1) 2^e for r = floor(N^(1/n)), and is r 2^e if and only if r^n = N. Else nothing of
    `precision` bits is between r and r + 1, since r has more, and `settled` answers at once.
    """
    if not x[1]:
        return x, x
    if x[0]:
        return negated(root(mpf_neg(x), n, precision))
    shift = max(0, n * (precision + 1) - x[3])
    shift += (x[2] - shift) % n
    man = x[1] << shift
    r, exp = integer_root(man, n), (x[2] - shift) // n
    if r**n == man:
        exact = from_man_exp(r, exp)
        return mpf_pos(exact, precision, DOWN), mpf_pos(exact, precision, UP)
    return tighten(lambda _: (r, r + 1, -exp), precision)


def integer_root(m: int, n: int) -> int:
    """Return floor(m^(1/n)), m >= 1, n >= 1.

    Newton's iteration for r^n = m from above decreases as long as r^n > m, and stays at or above
    the floor (its value is at least the mean of r, ..., r, m / r^(n-1)). It is started from the
    root of the leading half of m, one more and as many places; m < 2^(2 n) from 4.
    """
    if n == 2:
        return isqrt(m)
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
