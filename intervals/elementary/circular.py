"""sin, cos, tan, atan, asin, acos, atan2 of dyadic numbers, tightest: see `tightest`.

sin, cos, tan of x != 0 are transcendental, and so are the angles whose sine, cosine or tangent is
algebraic, 0 excepted (Lindemann): 0 at asin 0, atan 0, acos 1, and atan2 of y = 0, x > 0.

The angle of a point in the first quadrant in fixed point, with a proved error: atan, atan2.

sin and cos of a dyadic number in fixed point, with a proved error, and the quadrants passed.
"""

from math import isqrt

from mpmath.libmp import fone, from_man_exp, fzero, mpf_neg

from intervals.elementary.constants import pi_fixed
from intervals.elementary.logarithm import closeness, root_fixed, square_and_one, value_fixed
from intervals.elementary.series import (
    COARSE,
    FINE,
    MASK,
    arc,
    atan_at,
    halvings_for,
    sincos_at,
    versine_series,
    working_bits,
)
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


def angle_fixed(y: int, x: int, bits: int) -> tuple[int, int]:
    """Return (A, E): |atan(y / x) 2^bits - A| <= E for ints x, y >= 0, not both 0; pi/2 at x = 0.

    Proof. If y > x, the angle is pi/2 minus that of (y, x). Else (x, y) is turned back, and
    stretched, by the angle atan(j / 2^8), j = floor(2^8 y / x) <= 2^8, which makes it
    (2^8 x + j y, 2^8 y - j x), exactly; the new y is less than the new x / 2^8. Another turn by
    atan(i / 2^16) leaves y / x < 2^-16, of which z is the floor: atan z is known to one unit and
    to those of `arc`, the angles of the table to 2 each and pi/2 to one.
    """
    v = working_bits(bits)
    if steep := y > x:
        x, y = y, x
    total = 0
    for scale in (COARSE, FINE):
        j = int((y << scale) // x)
        if j:
            x, y = (x << scale) + j * y, (y << scale) - j * x
            total += atan_at(j, scale, v)
    value, error = arc((y << v) // x, v, -1)
    total += value
    if steep:
        total = pi_fixed(v - 1) - total
    drop = v - bits
    return total >> drop, (error + 6 >> drop) + 2


def sincos_fixed(man: int, exp: int, bits: int) -> tuple[int, int, int, int, int]:
    """Return (S, C, E, n_low, n_high) for x = man 2^exp.

    |sin x 2^bits - S| <= E, |cos x 2^bits - C| <= E, and n_low <= x / (pi/2) < n_high + 1:
    both are the floor of x / (pi/2) unless x is too near a multiple of pi/2 for `bits` to tell.

    Proof. |x| < 2^size, size >= 0; v has 30 + 2h bits more than b = max(bits, 20), h the number of
    halvings; w = v + size. P <= pi 2^w <= P + 1, and X = floor(x 2^w). q = round(2X / P), so that
    |q| <= 0.64 2^size + 0.51, an integer, hence |q| <= 2^size. 2X - q P errs as
    2^(w+1) (x - q pi/2) by at most 2 + |q|; the shift divides this by 2^(size+1), to at most 1.5,
    and rounds down: r = (x - q pi/2) 2^v is known to 2.5 < 3 units, |r| <= pi/4 + 2^-8.
    `_first_octant` has the rest.
    """
    halvings = halvings_for(bits)
    size = max(0, man.bit_length() + exp)
    v = working_bits(max(bits, 20) + 18 + 2 * halvings)
    w = v + size
    x = man << (exp + w) if exp + w >= 0 else man >> -(exp + w)
    pi = pi_fixed(w)
    quarter = (2 * x + (pi >> 1)) // pi
    r = (2 * x - quarter * pi) >> (1 + size)
    sin, cos, error = _first_octant(abs(r), halvings, v)
    if r < 0:
        sin = -sin
    if quarter & 1:
        sin, cos = cos, -sin
    if quarter & 2:
        sin, cos = -sin, -cos
    drop = v - bits
    # floor(x / (pi/2)) is quarter if r >= 0, else quarter - 1, for the true r, 3 units from this
    n_low = int(quarter) - (r <= 3)
    n_high = int(quarter) - (r < -3)
    return sin >> drop, cos >> drop, (error >> drop) + 2, n_low, n_high


def _first_octant(r: int, halvings: int, v: int) -> tuple[int, int, int]:
    """Return sin and cos of r / 2^v, known to 3 units, and their error: see `sincos_fixed`.

    Proof. A multiple c of 2^-16 exceeds |r| by d, 2^-16 < d <= 2^-15; halved h times d is known to
    4 units, so that its 1 - cos, u, is known to e_0 units, those of the series and one. A doubling,
    u -> 4 u - 2 u^2, makes of an error of e units one of at most 4 e + 1: e_h <= 4^h (e_0 + 1),
    which is below 2^(v-38), as e_0 + 1 < 2^(b-8). sin^2 d = u (2 - u) errs by at most 2 e_h, so
    that sin d, and the root of what was computed, are above 0.98 2^-16, and S, the floor of this,
    errs by at most 2 e_h / (2 0.98 2^-16) + 1 < 2^17 e_h units. Then r = c - d: a turn by an angle
    from a table, whose sin and cos are known to 2 units, makes of an error of e units at most
    sqrt(2) e + 2 sqrt(2) + 1 + 2^-6 e <= 1.5 e + 4, two turns at most 2.25 e + 10.
    """
    index = int(r >> (v - FINE)) + 2
    u, error = versine_series(((index << (v - FINE)) - r) >> halvings, v)
    for _ in range(halvings):
        u = (u << 2) - (u * u >> (v - 1))
    one = 1 << v
    sin, cos = -isqrt(u * (2 * one - u)), one - u
    for j, scale in ((index & MASK, FINE), (index >> (FINE - COARSE), COARSE)):
        if j:
            s, c = sincos_at(j, scale, v)
            sin, cos = (sin * c + cos * s) >> v, (cos * c - sin * s) >> v
    return sin, cos, (9 * ((error + 2) << 2 * halvings + 17) >> 2) + 10


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
