"""sin and cos of a dyadic number in fixed point, with a proved error, and the quadrants passed."""

from intervals.elementary.constants import pi_fixed


def sincos_fixed(man: int, exp: int, bits: int) -> tuple[int, int, int, int, int]:
    """Return (S, C, E, n_low, n_high) for x = man 2^exp.

    |sin x 2^bits - S| <= E, |cos x 2^bits - C| <= E, and n_low <= x / (pi/2) < n_high + 1:
    both are the floor of x / (pi/2) unless x is too near a multiple of pi/2 for `bits` to tell.

    Proof. |x| < 2^size, size >= 0; v = bits + 8 + 2k, k the number of halvings; w = v + size.
    P <= pi 2^w <= P + 1, and X = floor(x 2^w). q = round(2X / P), so |q| <= 0.64 2^size + 0.51,
    an integer, hence |q| <= 2^size. 2X - q P errs as 2^(w+1) (x - q pi/2) by at most 2 + |q|;
    the shift divides this by 2^(size+1), to at most 1.5, and rounds down: r = (x - q pi/2) 2^v is
    known to 2.5 < 3 units, |r| <= pi/4 + 2^-8. Halved k times it is known to 4 units. Neither sin
    nor 1 - cos enlarges this; let e_0 be these 4 units and the loss in Taylor's series.
    One doubling of s = sin and u = 1 - cos, s -> 2 (s - s u), u -> 2 s^2, makes of an error of
    e units, e <= 2^(v-8), at most 4 e + 4: beforehand |s| <= 0.71 and 0 <= u <= 0.3, so the new
    errors are 2 (e + 0.71 e + 2^-8 e + 1) and 2 (1.42 e + 2^-8 e + 1). So e_k <= 4^k (e_0 + 4/3),
    below 4^k (e_0 + 2), which is indeed at most 2^(v-8): that is e_0 + 2 <= 2^bits, and bits > 256
    where anything is halved at all.
    """
    halvings = _halvings(bits)
    size = max(0, man.bit_length() + exp)
    v = bits + 8 + 2 * halvings
    w = v + size
    x = man << (exp + w) if exp + w >= 0 else man >> -(exp + w)
    pi = pi_fixed(w)
    quarter = (2 * x + (pi >> 1)) // pi
    r = (2 * x - quarter * pi) >> (1 + size)
    s, u, error = _taylor(r >> halvings, v)
    error += 4
    for _ in range(halvings):
        s, u = (s - (s * u >> v)) << 1, (s * s >> v) << 1
    error = (error + 2) << 2 * halvings
    one = 1 << v
    sin, cos = ((s, one - u), (one - u, -s), (-s, u - one), (u - one, s))[quarter & 3]
    drop = v - bits
    # floor(x / (pi/2)) is quarter if r >= 0, else quarter - 1, for the true r, 3 units from this
    n_low = quarter - (r <= 3)
    n_high = quarter - (r < -3)
    return sin >> drop, cos >> drop, (error >> drop) + 2, n_low, n_high


def _halvings(bits: int) -> int:
    """How often to halve before the series: none up to 256 bits, then about sqrt(bits) / 2."""
    return 0 if bits <= 256 else int(bits**0.5) // 2


def _taylor(r: int, bits: int) -> tuple[int, int, int]:
    """Return sin r, 1 - cos r in fixed point and a bound on the units lost, for |r| < 0.8.

    From a term with error e the next one of sin has error at most (0.64 e + 0.8 + 1) / 6 + 1, so
    1.5 units a term suffice; those of 1 - cos start from (1 + 1) / 2 and are divided by 12 or
    more. The true terms alternate and decrease; the last one computed is 0 or -1, so the true one
    is at most 2.5 units, and the tail, below the next one, is at most 2.5 * 0.64 / 12 < 1 (or
    r^3 / 6, r^4 / 24, for r^2 below two units). In all 0.75 k + 2.5 <= 2 k + 2.
    """
    square = r * r >> bits
    s, term, k = r, r, 1
    while term not in (0, -1):
        k += 2
        term = -(term * square >> bits) // ((k - 1) * k)
        s += term
    u, term, j = square >> 1, square >> 1, 2
    while term not in (0, -1):
        j += 2
        term = -(term * square >> bits) // ((j - 1) * j)
        u += term
    return s, u, 2 * max(k, j) + 2
