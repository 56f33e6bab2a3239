"""x^y of dyadic numbers, tightest: see `tightest`.

Theorem. Let x > 0, x != 1 and y = c / 2^j != 0, c odd if j > 0. x^y is a dyadic number if and only
if x is the 2^j-th power of a dyadic number r, and c > 0 or r is a power of 2.

Proof. If x^y is rational, x^c is the 2^j-th power of a rational; so every prime has in x^c, hence
in x, as c is odd (or j = 0), an exponent that 2^j divides. Then x = r^(2^j), and r is dyadic, as x
is. x^y = r^c; for c < 0 the odd part of r would be left in the denominator.
"""

from math import isqrt

from mpmath.libmp import fone, from_man_exp, fzero, mpf_neg, mpf_pos, mpf_sub

from intervals.elementary.explog import exp_fixed, log_fixed
from intervals.elementary.exponential import VANISHING
from intervals.elementary.ziv import (
    DOWN,
    UP,
    Bounds,
    Enclosure,
    Raw,
    magnitude,
    near_one,
    negated,
    signed,
    tighten,
)

_LARGEST = 34


def power(x: Raw, y: Raw, precision: int) -> Bounds:
    """Return the bounds of x^y, for x > 0 or x = 0 < y.

    With t = y log x: OverflowError for t >= 2^34, and possibly from 2^30 on; `VANISHING` for
    t <= -2^34, and possibly from -2^30 on. 0 < |e^t - 1| < 2 |t| for 0 < |t| < 1.
    """
    if not x[1]:
        return fzero, fzero
    if not y[1] or x == fone:
        return fone, fone
    size = magnitude(y) + _log_size(x)
    growing = (magnitude(x) > 0) != bool(y[0])  # t > 0
    if size > _LARGEST:
        if not growing:
            return VANISHING
        raise OverflowError("a power with an exponent beyond 2^30")
    return (
        near_one(size + 1, growing, precision)
        or _dyadic(x, y, precision)
        or tighten(lambda bits: _enclose(x, y, bits), precision)
    )


def _dyadic(x: Raw, y: Raw, precision: int) -> Bounds | None:
    """Return the bounds of x^y if it is dyadic and may have `precision` bits."""
    root = _dyadic_root(x, max(0, -y[2]))
    if root is None:
        return None
    n = int(y[1]) << max(0, y[2])
    if root[1] == 1:
        result = from_man_exp(1, (-n if y[0] else n) * root[2])
        return result, result
    if y[0] or not _short(root, n, precision):
        return None
    return _short_power(root, n, precision)


def integer_power(x: Raw, n: int, precision: int) -> Bounds:
    """Return the bounds of x^n, for n >= 1; OverflowError as for `power`, where x^n is long."""
    if x[0]:
        bounds = integer_power(mpf_neg(x), n, precision)
        return negated(bounds) if n & 1 else bounds
    if _short(x, n, precision):
        return _short_power(x, n, precision)
    return power(x, from_man_exp(n, 0), precision)


def _short(x: Raw, n: int, precision: int) -> bool:
    """Whether x^n is better computed exactly; if not, it is no number of `precision` bits.

    The odd mantissa of x^n has more than n (size of that of x - 1) bits.
    """
    return n * (x[3] - 1) <= 32 * precision + 256


def _short_power(x: Raw, n: int, precision: int) -> Bounds:
    exact = from_man_exp(x[1] ** n, x[2] * n)
    return mpf_pos(exact, precision, DOWN), mpf_pos(exact, precision, UP)


def _log_size(x: Raw) -> int:
    """Return k with 2^(k-3) < |log x| < 2^k, for 0 < x != 1.

    With 2^(m-1) <= x < 2^m: if 1/2 <= x < 2, then |x - 1| / 2 <= |log x| < 2 |x - 1|. Else
    0.69 (|m| - 1 + (m < 0)) <= |log x| < 0.7 (|m| + 1).
    """
    m = magnitude(x)
    if 0 <= m <= 1:
        return magnitude(mpf_sub(x, fone)) + 1
    return (abs(m) + 1).bit_length()


def _dyadic_root(x: Raw, j: int) -> Raw | None:
    """Return r with r^(2^j) = x, if it is dyadic; an odd mantissa > 1 is soon no square."""
    _, man, exp, _ = x
    while j and man > 1:
        root = isqrt(man)
        if exp & 1 or root * root != man:
            return None
        man, exp, j = root, exp >> 1, j - 1
    if exp & ((1 << j) - 1):
        return None
    result: Raw = from_man_exp(man, exp >> j)
    return result


def _enclose(x: Raw, y: Raw, bits: int) -> Enclosure:
    """Return an enclosure of x^y = e^t, |t| < 2^34, to about `bits` bits.

    log x is known to e units of b = bits + 4 + size of y bits, so t to e units of bits + 4, which
    makes at most 2.2 e / 16 < e units of `bits` of e^t < 2.
    """
    b = bits + 4 + max(0, magnitude(y))
    log, units = log_fixed(x[1], x[2], b)
    value, n, error = exp_fixed(signed(y) * log, y[2] - b, bits)
    error += units
    return value - error, value + error, bits - n
