"""sin and cos of a dyadic number in fixed point, with a proved error, and the quadrants passed."""

from intervals.elementary.constants import pi_fixed
from intervals.elementary.series import (
    COARSE,
    FINE,
    MASK,
    halvings_for,
    sincos_at,
    sincos_series,
    working_bits,
)


def sincos_fixed(man: int, exp: int, bits: int) -> tuple[int, int, int, int, int]:
    """Return (S, C, E, n_low, n_high) for x = man 2^exp.

    |sin x 2^bits - S| <= E, |cos x 2^bits - C| <= E, and n_low <= x / (pi/2) < n_high + 1:
    both are the floor of x / (pi/2) unless x is too near a multiple of pi/2 for `bits` to tell.

    Proof. |x| < 2^size, size >= 0; v has 12 + 2h bits more than `bits`, h the number of halvings;
    w = v + size. P <= pi 2^w <= P + 1, and X = floor(x 2^w). q = round(2X / P), so that
    |q| <= 0.64 2^size + 0.51, an integer, hence |q| <= 2^size. 2X - q P errs as
    2^(w+1) (x - q pi/2) by at most 2 + |q|; the shift divides this by 2^(size+1), to at most 1.5,
    and rounds down: r = (x - q pi/2) 2^v is known to 2.5 < 3 units, |r| <= pi/4 + 2^-8. Beside
    multiples of 2^-16, which are exact, |r| is s < 2^-16; halved h times it is known to 4 units.
    Neither sin nor 1 - cos enlarges this; let e_0 be these 4 units and the loss in the series.
    One doubling of s = sin and u = 1 - cos, s -> 2 (s - s u), u -> 2 s^2, makes of an error of
    e units, e <= 2^(v-8), at most 4 e + 4: beforehand |s| and u are below 2^-16, so the new
    errors are below 2 (e + 2^-6 e + 1) and 2 (2^-6 e + 1). So e_h <= 4^h (e_0 + 4/3), below
    4^h (e_0 + 2), which is indeed at most 2^(v-8), as e_0 + 2 <= 2^(bits+4).
    A turn by an angle from a table, whose sin and cos are known to 2 units, makes of e at most
    sqrt(2) e + 2 sqrt(2) + 1 + 2^-6 e <= 1.5 e + 4, two turns at most 2.25 e + 10.
    """
    halvings = halvings_for(bits)
    size = max(0, man.bit_length() + exp)
    v = working_bits(bits + 2 * halvings)
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
    """Return sin and cos of r / 2^v, known to 3 units, and their error: see `sincos_fixed`."""
    index = int(r >> (v - FINE))
    sin, u, error = sincos_series((r - (index << (v - FINE))) >> halvings, v)
    for _ in range(halvings):
        sin, u = (sin - (sin * u >> v)) << 1, (sin * sin >> v) << 1
    cos = (1 << v) - u
    for j, scale in ((index & MASK, FINE), (index >> (FINE - COARSE), COARSE)):
        if j:
            s, c = sincos_at(j, scale, v)
            sin, cos = (sin * c + cos * s) >> v, (cos * c - sin * s) >> v
    return sin, cos, (9 * ((error + 4 + 2) << 2 * halvings) >> 2) + 10
