"""exp, exp2, exp10, expm1, sinh, cosh, tanh of a dyadic number, tightest: see `tightest`.

For x != 0 the values of exp, expm1, sinh, cosh, tanh are transcendental (Lindemann). 2^x and 10^x
are rational for integers x only: if x = a / 2^k in lowest terms, k > 0, then 2^a or 10^a would be
the 2^k-th power of a rational. 10^x is dyadic for integers x >= 0.
"""

from mpmath.libmp import fone, from_int, from_man_exp, fzero, mpf_abs, mpf_neg, mpf_pos

from intervals.elementary.constants import Constant, log2_fixed, log10_fixed
from intervals.elementary.explog import exp_fixed
from intervals.elementary.ziv import (
    DOWN,
    UP,
    Bounds,
    Enclosure,
    Raw,
    beside,
    magnitude,
    near_one,
    near_or_tight,
    odd,
    settled,
    signed,
    tighten,
)

_LARGEST = 30  # beyond |x| = 2^30 results are of no use, and take more memory than time
VANISHING: Bounds = fzero, from_man_exp(1, -(1 << 30))  # of e^x, 2^x, 10^x for x <= -2^30


def _require_moderate(x: Raw, name: str) -> None:
    if magnitude(x) > _LARGEST:
        raise OverflowError(f"{name} of a number beyond 2^30")


def exp(x: Raw, precision: int) -> Bounds:
    """Return the bounds of exp x; OverflowError beyond 2^30. |exp x - 1| < 2 |x| near 0.

    Below -2^30 they are those of `VANISHING`, which are not the tightest.
    """
    if not x[1]:
        return fone, fone
    sign, man, exponent, size = x
    size += exponent
    if size > _LARGEST:
        if sign:
            return VANISHING
        raise OverflowError("exp of a number beyond 2^30")
    if size < -precision:
        return beside(fone, not sign, precision)
    man, guard = -man if sign else man, 10
    while True:
        y, n, error = exp_fixed(man, exponent, precision + guard)
        bounds = settled(y - error, y + error, precision + guard - n, precision)
        if bounds:
            return bounds
        guard *= 2


def exp2(x: Raw, precision: int) -> Bounds:
    """Return the bounds of 2^x; OverflowError as for exp. |2^x - 1| < |x| for 0 < |x| < 1."""
    if not x[1]:
        return fone, fone
    if x[0] and magnitude(x) > _LARGEST:
        return VANISHING
    _require_moderate(x, "exp2")
    if x[2] >= 0:
        power = from_man_exp(1, int(signed(x)) << x[2])
        return power, power
    return _power(log2_fixed, x, precision, magnitude(x))


def exp10(x: Raw, precision: int) -> Bounds:
    """Return the bounds of 10^x; OverflowError as for exp. |10^x - 1| < 4 |x| if |x| < 1/4.

    10^n = 5^n 2^n, and 5^n has more than 2 n bits: it is no number of `precision` bits if n is
    larger than that.
    """
    if not x[1]:
        return fone, fone
    if x[0] and magnitude(x) > _LARGEST:
        return VANISHING
    _require_moderate(x, "exp10")
    if x[2] >= 0 and not x[0] and x[1] << x[2] <= precision:
        power = from_int(10 ** int(x[1] << x[2]))
        return mpf_pos(power, precision, DOWN), mpf_pos(power, precision, UP)
    return _power(log10_fixed, x, precision, magnitude(x) + 2)


def _power(log_base: Constant, x: Raw, precision: int, distance: int) -> Bounds:
    """Return the bounds of b^x, no number of `precision` bits, where |b^x - 1| < 2^distance."""

    def enclose(bits: int) -> Enclosure:
        y, n, error = exp_fixed(signed(x), x[2], bits, log_base)
        return y - error, y + error, bits - n

    return near_one(distance, not x[0], precision) or tighten(enclose, precision)


def expm1(x: Raw, precision: int) -> Bounds:
    """Return the bounds of e^x - 1; OverflowError beyond x = 2^30.

    0 < e^x - 1 - x < x^2 for 0 < |x| < 1; and 0 < e^x < 2^x <= 2^-precision for x <= -precision.
    """
    if not x[1]:
        return x, x
    if x[0] and _beyond_precision(x, precision):
        return beside(mpf_neg(fone), True, precision)
    _require_moderate(x, "expm1")

    def enclose(bits: int) -> Enclosure:
        y, n, error = exp_fixed(signed(x), x[2], bits)
        scale = bits - n
        if scale < 0:  # 1 is a fraction of a unit
            return y - error - 1, y + error, scale
        one = 1 << scale
        return y - error - one, y + error - one, scale

    return near_or_tight(x, 2, True, enclose, precision)


def _beyond_precision(x: Raw, precision: int) -> bool:
    """Whether |x| >= 2^(bit length of precision) > precision, cheaply."""
    return magnitude(x) > precision.bit_length()


def _exp_both(x: Raw, bits: int) -> tuple[int, int, int, int, int]:
    """Return (a, b, c, d, scale): e^|x| and e^-|x| times 2^scale are in [a, b] and [c, d]."""
    y, n, error = exp_fixed(x[1], x[2], bits)
    low, high, scale = y - error, y + error, bits - n
    if scale <= 0:
        return low, high, 0, 1, scale
    square = 1 << 2 * scale
    return low, high, square // high, square // low + 1, scale


@odd
def sinh(x: Raw, precision: int) -> Bounds:
    """Return the bounds of sinh x; OverflowError beyond |x| = 2^30. 0 < sinh x - x < x^3 on (0, 1).

    sinh x 2^(scale+1) is e^x 2^scale less e^-x 2^scale.
    """
    _require_moderate(x, "sinh")

    def enclose(bits: int) -> Enclosure:
        a, b, c, d, scale = _exp_both(x, bits)
        return a - d, b - c, scale + 1

    return near_or_tight(x, 3, True, enclose, precision)


def cosh(x: Raw, precision: int) -> Bounds:
    """Return the bounds of cosh x; OverflowError as for exp. 0 < cosh x - 1 < x^2 near 0."""
    if not x[1]:
        return fone, fone
    _require_moderate(x, "cosh")

    def enclose(bits: int) -> Enclosure:
        a, b, c, d, scale = _exp_both(mpf_abs(x), bits)
        return a + c, b + d, scale + 1

    return near_one(2 * magnitude(x), True, precision) or tighten(enclose, precision)


@odd
def tanh(x: Raw, precision: int) -> Bounds:
    """Return the bounds of tanh x. 0 < x - tanh x < x^3 for x > 0.

    For x > precision, 1 - tanh x = 2 / (e^2x + 1) < 2 e^-2x < 2^-precision. Else
    tanh x = (1 - q) / (1 + q) with q = e^-2x, which falls as q grows.
    """
    if _beyond_precision(x, precision):
        return beside(fone, False, precision)

    def enclose(bits: int) -> Enclosure:
        y, n, error = exp_fixed(-x[1], x[2] + 1, bits)
        low, high, one = (y - error) >> -n, ((y + error) >> -n) + 1, 1 << bits
        return (
            ((one - high) << bits) // (one + high),
            ((one - low) << bits) // (one + low) + 1,
            bits,
        )

    return near_or_tight(x, 3, False, enclose, precision)
