"""sin and cos of a dyadic number in fixed point, with a proved error, and the quadrants passed."""

from math import isqrt

from intervals.elementary.constants import pi_fixed
from intervals.elementary.series import (
    COARSE,
    FINE,
    MASK,
    halvings_for,
    sincos_at,
    versine_series,
    working_bits,
)


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
