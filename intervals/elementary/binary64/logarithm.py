"""log, log2, log10, log1p of binary64 numbers, as pairs with a proved error.

Theorem. For a normal v > 0, u = 2^-53, `_log` returns log v with k = 2^-5, and, where it is sharp,
with k = 2^-12; and log(v + e + d) with k = 2^-5 if v + e is a binary64 number and one more,
exactly, |e| <= u v, |d| <= 2^9 u |v + e - 1|.

Proof. v = m 2^k, 0.708 <= m < 1.416, in one of 256 cells, each with a multiple R of 2^-9 next to
the inverse of its centre. m R - 1 is exact in two parts, r + r', since R has 10 bits: it is below
2^-25 where the first is no larger than the second. |r| <= 0.0029; on the cell of 1, from 1 - 2^-10
to 1 + 2^-9, R = 1, r' = 0 and |r| < 2^-9. What e and d are beside v, times m R, is added to r + r'.
log v = k log 2 - log R + r - r^2 / 2 + (r' - r r') + r^3 q, q = 1/3 - r/4 + ... + r^4/7, up to
r^8 / 8, below 2^-70.5, and r'^2; -r r' <= 2^-70 is left out where r' is below u r.
k log 2 = k L1 + k L2 up to 2^-85 and -log R = H + H' up to 2^-95, L1 and H multiples of 2^-42, so
that k L1 + H is exact. It is 0 or larger than |r|, and its sum with r is exact in two parts.
Errors in units of u: 2^-18 from fl(r^2) / 2; 2^-23.6 from six relative errors of r^3 q, at most
2^-26.2; three sums below 2^-17, 2^-16.4; 2^-17 from r r' and 2^-17.5 from the tail: 2^-15.1. Where
R != 1 or k != 0, |log v| >= 2^-10.1: 2^-5. Else k L1 + H = 0, and there are only those of r^2 / 2,
of sums with it and of d, 4 of them, beside |r|, and the tail, r^7 / 8: 4 |r| + 2^-13. There r + e
is x, exactly, if v + e = 1 + x.
Sharp: q goes up to r^6/9, r^2 is exact in two parts, r r' is there, and r^2 / 2 is subtracted in
two parts, so that the sums are below 2^-26: 2^-24 u. With the 2^-23.6 this is 2^-12.7 beside
2^-10.1; on the cell of 1 it is 8 r^2 / 3, below 2^-16. Measured on a million points: 0.0015 u.
"""

from fractions import Fraction
from functools import lru_cache
from math import frexp
from typing import Any

import numpy as np

from intervals.elementary.binary64.exponential import LN_2, LN_10
from intervals.elementary.binary64.pair import Pair, fast_two_sum, two_product, two_sum
from intervals.elementary.binary64.primitives import BITS, Table, horner, split, tables
from intervals.elementary.constants import arc_of_ratio

LOG_2 = float.fromhex("0x1.62e42fefa3800p-1"), float.fromhex("0x1.ef35793c76730p-45")
_LEAST_BITS = (1023 << 52) - (299 << 43)  # of 1 - 149.5 / 512
_LEAST_MANTISSA = 1.0 - 149.5 / 512
_CELL = (1 << 8) - 1
_SERIES = tuple((-1) ** (k + 1) / k for k in range(9, 2, -1))
_PER_LN_2, _PER_LN_10 = Pair(1.0) / LN_2, Pair(1.0) / LN_10


def log(x: Pair) -> Pair:
    """Return log x for normal x > 0, x.lo = 0."""
    return _log(x.hi)


def sharp_log(x: Pair) -> Pair:
    """Return log x for normal x > 0, x.lo = 0, more closely."""
    return _log(x.hi, sharp=True).normal()


def log2(x: Pair) -> Pair:
    """Return log2 x for normal x > 0, x.lo = 0."""
    return _log(x.hi).normal() * _PER_LN_2


def log10(x: Pair) -> Pair:
    """Return log10 x for normal x > 0, x.lo = 0."""
    return _log(x.hi).normal() * _PER_LN_10


def log1p(x: Pair) -> Pair:
    """Return log(1 + x) for -1 < x <= 2^410, with 2^-400 <= |x| or x = 0; x.lo = 0 where x < 0.

    1 + x.hi = v + e exactly. The relative error of x > 0 enters unenlarged, since
    x / (1 + x) <= log(1 + x).
    """
    v, e = two_sum(1.0, x.hi)
    y = _log(v, e, x.lo).normal()
    return Pair(y.hi, y.lo, y.k + x.k)


def mantissa(x: Any) -> tuple[Any, Any, Any]:
    """Return k, m and the number of its cell, x = m 2^k exactly, 0.708 <= m < 1.416, x normal."""
    if type(x) is float:
        m, k = frexp(x)
        if m < _LEAST_MANTISSA:
            m, k = 2.0 * m, k - 1
        return k, m, int(149.5 + (m - 1.0) * (256.0 if m > 1.0 else 512.0))
    bits = x.view(np.int64)
    above = bits - _LEAST_BITS
    k = above >> 52
    above >>= 44
    above &= _CELL
    return k * 1.0, (bits - (k << 52)).view(np.float64), above


def _log(v: Any, *rest: Any, sharp: bool = False) -> Pair:
    """Return log(v + e), see the theorem."""
    k, m, cell = mantissa(v)
    inverses, high, high_rest = _cells()
    inverse = inverses[cell]
    head, tail = split(m)
    head *= inverse
    tail *= inverse
    head -= 1.0
    r, low = fast_two_sum(head, tail)
    if rest:
        scale = m / v * inverse
        r, lost = fast_two_sum(r, rest[0] * scale)
        low += lost
        low += rest[1] * scale
        low -= r * low
    square, error = two_product(r, r) if sharp else (r * r, 0.0)
    cubic = horner(r, _SERIES if sharp else _SERIES[2:])
    cubic *= square * r
    square *= 0.5
    total = k * LOG_2[0]
    total += high[cell]
    if sharp:
        low -= r * low + 0.5 * error
    total, lost = fast_two_sum(total, r)
    low += lost
    low += k * LOG_2[1] + high_rest[cell]
    if sharp:
        total, lost = fast_two_sum(total, -square)
        low += lost
    else:
        cubic -= square
    low += cubic
    return Pair(total, low, 2.0 ** (-12 if sharp else -5))


@lru_cache(maxsize=1)
def _cells() -> tuple[Table, Table, Table]:
    """Return R of each cell, and -log R = 2 atanh((1 - R) / (1 + R)) in two parts."""
    sizes = [Fraction(1, 512 if cell < 149.5 else 256) for cell in range(256)]
    centres = [1 + (cell - 149) * size for cell, size in enumerate(sizes)]
    inverses = [round(512 / c) for c in centres]  # times 2^9
    arcs = (arc_of_ratio(abs(512 - r), 512 + r, BITS, 1)[0] for r in inverses)
    logs = [2 * arc if r < 512 else -2 * arc for arc, r in zip(arcs, inverses, strict=True)]
    return Table(r / 512 for r in inverses), *tables(logs, 42)
