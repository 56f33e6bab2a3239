"""sin, cos, tan, atan, asin, acos, atan2 of dyadic numbers, tightest: see `tightest`.

sin, cos, tan of x != 0 are transcendental, and so are the angles whose sine, cosine or tangent is
algebraic, 0 excepted (Lindemann): 0 at asin 0, atan 0, acos 1, and atan2 of y = 0, x > 0.
"""

from mpmath.libmp import fone, from_man_exp, fzero, mpf_neg

from intervals.elementary.arctan import angle_fixed
from intervals.elementary.constants import pi_fixed
from intervals.elementary.logarithm import closeness, root_fixed, square_and_one, value_fixed
from intervals.elementary.trig import sincos_fixed
from intervals.elementary.ziv import (
    Bounds,
    Enclosure,
    Raw,
    magnitude,
    near_argument,
    near_one,
    near_or_tight,
    negated,
    odd,
    settled,
    signed,
    tighten,
)


def sincos(x: Raw, precision: int) -> tuple[Bounds, Bounds, int]:
    """Return the bounds of sin x and of cos x, and floor(x / (pi/2)).

    0 < x - sin x < x^3 for x > 0 and 0 < 1 - cos x < x^2 / 2. Settled bounds have one sign, so
    that sin x and cos x exceed their errors, x is farther from the multiples of pi/2 than
    `sincos_fixed` can confuse, and n_low = n_high is the floor.
    """
    if not x[1]:
        return (fzero, fzero), (fone, fone), 0
    size = magnitude(x)
    near_sin = near_argument(x, 3, bool(x[0]), precision)
    near_cos = near_one(2 * size - 1, False, precision)
    if near_sin and near_cos:
        return near_sin, near_cos, -x[0]
    man, exp, guard = signed(x), x[2], 10 + max(0, -size)
    while True:
        bits = precision + guard
        s, c, error, n_low, n_high = sincos_fixed(man, exp, bits)
        sin = settled(s - error, s + error, bits, precision)
        cos = settled(c - error, c + error, bits, precision)
        if sin and cos and n_low == n_high:
            return sin, cos, n_low
        guard *= 2


def tan(x: Raw, precision: int) -> Bounds:
    """Return the bounds of tan x. 0 < tan x - x < x^3 for 0 < x <= 1/2.

    The quotient of sin x by cos x, both known and of one sign each, is least and largest at ends.
    """
    if not x[1]:
        return x, x

    def enclose(bits: int) -> Enclosure:
        s, c, error, _, _ = sincos_fixed(signed(x), x[2], bits)
        if c < 0:
            s, c = -s, -c
        if c <= error:  # too near to a pole for these bits
            return enclose(2 * bits)
        low, high = s - error, s + error
        smallest = (low << bits) // (c + error if low >= 0 else c - error)
        return smallest, -((-high << bits) // (c - error if high >= 0 else c + error)), bits

    return near_or_tight(x, 3, not x[0], enclose, precision)


@odd
def asin(x: Raw, precision: int) -> Bounds:
    """Return the bounds of asin x, |x| <= 1. 0 < asin x - x < x^3 for 0 < x <= 1."""

    def enclose(bits: int) -> Enclosure:
        cosine, sine = _on_unit_circle(x, bits + 2)
        angle, error = angle_fixed(cosine, sine, bits)
        return angle - error - 1, angle + error + 1, bits

    return near_or_tight(x, 3, True, enclose, precision)


def acos(x: Raw, precision: int) -> Bounds:
    """Return the bounds of acos x in [0, pi], |x| <= 1.

    Near 1 it is about sqrt(2 (1 - x)); near 0, |acos x - pi/2| < 2 |x|.
    """
    if x == fone:
        return fzero, fzero

    def enclose(bits: int) -> Enclosure:
        if x[1] and magnitude(x) < -bits:
            half = pi_fixed(bits - 1)
            return half - 1, half + 2, bits
        cosine, sine = _on_unit_circle(x, bits + 2)
        angle, error = angle_fixed(sine, cosine, bits)
        if x[0]:
            angle, error = pi_fixed(bits) - angle, error + 1
        return angle - error - 1, angle + error + 1, bits

    return tighten(enclose, precision, closeness(x) // 2 + 1)


def _on_unit_circle(x: Raw, bits: int) -> tuple[int, int]:
    """Return the floors of |x| and sqrt(1 - x^2) in fixed point, for |x| <= 1.

    The point (|x|, sqrt(1 - x^2)) is moved by less than 1.5 * 2^-bits, so its angle changes by
    less than 2 * 2^-bits: by half a unit at two bits less.
    """
    man, exp = square_and_one(x, -1)
    return value_fixed(x, bits), root_fixed(-man, exp, bits)


def atan(x: Raw, precision: int) -> Bounds:
    """Return the bounds of atan x, the angle of (1, x)."""
    return atan2(x, fone, precision)


def atan2(y: Raw, x: Raw, precision: int) -> Bounds:
    """Return the bounds of the angle in (-pi, pi] of the point (x, y), not the origin.

    If x > 0 and q = y / x is a dyadic number, that is, if the odd mantissa of x divides that of y,
    0 < q - atan q < q^3 may settle it.
    """
    if y[0]:
        return negated(atan2(mpf_neg(y), x, precision))
    if not y[1]:
        if not x[0]:
            return fzero, fzero
        return tighten(lambda bits: (pi_fixed(bits), pi_fixed(bits) + 1, bits), precision)
    if x[1] and not x[0] and y[1] % x[1] == 0:
        quotient = from_man_exp(y[1] // x[1], y[2] - x[2])
        near = near_argument(quotient, 3, False, precision)
        if near:
            return near
    return tighten(lambda bits: _angle(y, x, bits), precision)


def _angle(y: Raw, x: Raw, bits: int) -> Enclosure:
    """Return an enclosure of the angle of (x, y), y > 0, to `bits` bits relative to the result.

    With q = y / |x| < 2^(k+1): if k < -bits - 2, the angle of (|x|, y) is less than a unit, and if
    k > bits + 2, it is less than a unit below pi/2. For small q and x > 0 see `_small_angle`.
    """
    if not x[1]:
        half = pi_fixed(bits)
        return half, half + 1, bits + 1
    k = magnitude(y) - magnitude(x)
    if k < 0 and not x[0]:
        if -2 * k > bits + y[3] + 4:
            return _small_angle(y, x, bits)
        bits -= k
    if abs(k) > bits + 2:
        angle, error = (0 if k < 0 else pi_fixed(bits - 1)), 1
    else:
        shift = y[2] - x[2]
        angle, error = angle_fixed(y[1] << max(shift, 0), x[1] << max(-shift, 0), bits)
    if x[0]:
        angle, error = pi_fixed(bits) - angle, error + 1
    return angle - error, angle + error, bits


def _small_angle(y: Raw, x: Raw, bits: int) -> Enclosure:
    """Return an enclosure of atan q, 0 < q = y / x < 2^(k+1), where -2 k > bits + size of y + 4.

    q 2^scale is in [Q, Q + 1), Q < 2^(bits + 2 + size of y), and q - q^3 < atan q < q; so
    q^3 2^scale < (Q + 1) 4^(k+1) <= 1.
    """
    shift = max(0, bits + x[3] - y[3])
    quotient = (y[1] << shift) // x[1]
    return quotient - 1, quotient + 1, shift + x[2] - y[2]
