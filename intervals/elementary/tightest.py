"""sin, cos, exp, log of a dyadic number, rounded to the next numbers of `precision` bits.

Theorem. For a dyadic x in the domain, each function returns (y_down, y_up): the largest number of
`precision` bits that is <= f(x), and the smallest that is >= f(x).

Proof. The kernels give an integer Y with |f(x) 2^bits - Y| <= E. If the ends Y - E and Y + E round
down to the same number, and up to the same number, then so does f(x). Else `bits` grows, and this
ends: except for the exact values sin 0, cos 0, exp 0 and log 1, no f(x) is rational (Lindemann),
so none has `precision` bits and lies on a rounding boundary. Arguments so near to 0 that many bits
would be needed are settled by the inequalities beside them.
"""

from typing import TypeAlias

from mpmath.libmp import (
    fone,
    from_man_exp,
    fzero,
    mpf_add,
    mpf_mul,
    mpf_pos,
    mpf_shift,
    mpf_sub,
)

from intervals.elementary.explog import exp_fixed, log_fixed
from intervals.elementary.trig import sincos_fixed

Raw: TypeAlias = tuple[int, int, int, int]  # libmp's number: (sign, man, exp, bit length of man)
Bounds: TypeAlias = tuple[Raw, Raw]

DOWN, UP = "f", "c"
_GUARD = 10  # bits beyond the precision to begin with: they suffice about 99 times in 100


def _settled(value: int, error: int, bits: int, precision: int) -> Bounds | None:
    """Return how every y with |y 2^bits - value| <= error is rounded; None if not all alike."""
    low, high = value - error, value + error
    down = from_man_exp(low, -bits, precision, DOWN)
    up = from_man_exp(high, -bits, precision, UP)
    if down != from_man_exp(high, -bits, precision, DOWN):
        return None
    return (down, up) if up == from_man_exp(low, -bits, precision, UP) else None


def sincos(x: Raw, precision: int) -> tuple[Bounds, Bounds, int]:
    """Return the bounds of sin x and of cos x, and floor(x / (pi/2)).

    Settled bounds have one sign, so that sin x and cos x exceed their errors, x is farther from
    the multiples of pi/2 than `sincos_fixed` can confuse, and n_low = n_high is the floor.
    """
    sign, man, exp, size = x
    if not man:
        return (fzero, fzero), (fone, fone), 0
    if exp + size <= -precision:
        return _sincos_tiny(x, precision)
    guard, signed = _GUARD, -man if sign else man
    while True:
        bits = precision + guard + max(0, -exp - size)
        s, c, error, n_low, n_high = sincos_fixed(signed, exp, bits)
        sin, cos = _settled(s, error, bits, precision), _settled(c, error, bits, precision)
        if sin and cos and n_low == n_high:
            return sin, cos, n_low
        guard *= 2


def _sincos_tiny(x: Raw, precision: int) -> tuple[Bounds, Bounds, int]:
    """Do `sincos` for 0 < |x| < 2^-precision.

    |x| - |x|^3 < |sin x| < |x| and 1 - x^2 < cos x < 1; the rounding makes |x|^3, less than a
    unit in the last place of x, and x^2 a step to the next number.
    """
    square = mpf_mul(x, x)
    inner, negative = mpf_sub(x, mpf_mul(x, square)), x[0]
    low, high = (x, inner) if negative else (inner, x)
    sin = mpf_pos(low, precision, DOWN), mpf_pos(high, precision, UP)
    return sin, (mpf_sub(fone, square, precision, DOWN), fone), -1 if negative else 0


def exp(x: Raw, precision: int) -> Bounds:
    """Return the bounds of exp x; OverflowError beyond |x| = 2^30.

    For 0 < |x| < 2^-precision they follow from 1 + x < exp x < 1 + 2 x, the latter for x > 0, and
    exp x < 1 for x < 0.
    """
    sign, man, exponent, size = x
    if not man:
        return fone, fone
    if exponent + size > 30:
        raise OverflowError("exp of a number beyond 2^30")
    if exponent + size <= -precision:
        if sign:
            return mpf_add(fone, x, precision, DOWN), fone
        return fone, mpf_add(fone, mpf_shift(x, 1), precision, UP)
    guard, signed = _GUARD, -man if sign else man
    while True:
        bits = precision + guard
        y, n, error = exp_fixed(signed, exponent, bits)
        bounds = _settled(y, error, bits - n, precision)
        if bounds:
            return bounds
        guard *= 2


def log(x: Raw, precision: int) -> Bounds:
    """Return the bounds of log x, for x > 0."""
    _, man, exponent, _ = x
    if x == fone:
        return fzero, fzero
    guard = _GUARD
    while True:
        bits = precision + guard
        y, error = log_fixed(man, exponent, bits)
        bounds = _settled(y, error, bits, precision)
        if bounds:
            return bounds
        guard *= 2
