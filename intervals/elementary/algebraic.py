"""sqrt, cbrt and hypot of dyadic numbers, tightest: see `tightest`.

They are algebraic, so that exact values occur; libmp's square root and floors tell them.
"""

from mpmath.libmp import from_man_exp, mpf_add, mpf_mul, mpf_pos, mpf_sqrt

from intervals.elementary.ziv import (
    DOWN,
    UP,
    Bounds,
    Raw,
    beside,
    magnitude,
    odd,
    spacing,
)


def sqrt(x: Raw, precision: int) -> Bounds:
    """Return the bounds of sqrt x, for x >= 0."""
    return mpf_sqrt(x, precision, DOWN), mpf_sqrt(x, precision, UP)


@odd
def cbrt(x: Raw, precision: int) -> Bounds:
    """Return the bounds of the real cube root.

    x = (N + f) 8^e with an integer N of more than 3 * precision bits and 0 <= f < 1. The root lies
    in [r, r + 1) 2^e for r = floor(N^(1/3)), and is r 2^e if and only if f = 0 and r^3 = N. r has
    more than `precision` bits, so r and r + 1 are rounded as the numbers between them are, or are
    such numbers: x^(1/3) / 2^e is rounded as 2 r or 2 r + 1, half as large.
    """
    shift = max(0, 3 * (precision + 1) - x[3])
    shift += (x[2] - shift) % 3
    man = x[1] << shift
    r = integer_cbrt(man)
    twice = from_man_exp(2 * r + (r**3 != man), (x[2] - shift) // 3 - 1)
    return mpf_pos(twice, precision, DOWN), mpf_pos(twice, precision, UP)


def integer_cbrt(n: int) -> int:
    """Return floor(n^(1/3)), n >= 1.

    Newton's iteration for r^3 = n from above decreases as long as r^3 > n, and stays at or above
    the floor (its value (2 r + n / r^2) / 3 is at least the mean of r, r, n / r^2). It is started
    from the root of the leading half of n, one more and as many places; n < 2^6 from 4.
    """
    places = n.bit_length() // 6
    r = (integer_cbrt(n >> 3 * places) + 1) << places if places else 4
    while True:
        smaller = (2 * r + n // (r * r)) // 3
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
