"""sin and cos of a dyadic number in fixed point, with a proved error, and the quadrants passed."""

from intervals.elementary.constants import pi_fixed


def sincos_fixed(man: int, exp: int, bits: int) -> tuple[int, int, int, int, int]:
    """Return (S, C, E, n_low, n_high) for x = man 2^exp.

    |sin x 2^bits - S| <= E, |cos x 2^bits - C| <= E, and n_low <= x / (pi/2) < n_high + 1:
    both are the floor of x / (pi/2) unless x is too near a multiple of pi/2 for `bits` to tell.

    Proof. With P <= pi 2^w <= P + 1 at w = bits + 8 + size + k fractional bits, size being the
    bit length of the integer part of |x|, x 2^w is an integer X or rounded down to one (one
    unit). q = round(2X / P), r = X - q P / 2 has error at most 1 + |q|/2 + 1 units, and
    |q| <= 2^(size+1), so after dropping `size` bits r is known to 3 units at v = bits + 8 + k.
    |r| <= pi/4 + 2^-8. The argument halved k times is known to 4 units; let e_0 be that and the
    loss in Taylor's series of s = sin and u = 1 - cos. One doubling, s -> 2(s - su), u -> 2 s^2,
    makes of an error e <= 2^-8 at most 4 e + 4 units, because |s| <= 0.71 and 0 <= u <= 0.3
    beforehand. So e_k <= 4^k (e_0 + 4/3) <= 4^k (e_0 + 2).
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
    # floor(x / (pi/2)) is quarter where r > 0 and quarter - 1 where r < 0; r is known to 3 units
    n_low = quarter - (r <= 3)
    n_high = quarter - (r < -3)
    return sin >> drop, cos >> drop, (error >> drop) + 2, n_low, n_high


def _halvings(bits: int) -> int:
    """How often to halve before the series: none up to 256 bits, then about sqrt(bits) / 2."""
    return 0 if bits <= 256 else int(bits**0.5) // 2


def _taylor(r: int, bits: int) -> tuple[int, int, int]:
    """Return sin r, 1 - cos r in fixed point and a bound on the units lost, for |r| < 0.8.

    From a term with error e the next one has error at most (0.64 e + 0.8 + 1) / 6 + 1, so 1.5
    units a term suffice. The terms alternate and decrease; the last one added is at most one
    unit as computed, so the tail is below one unit. In all 0.75 k + 2.5 <= 2 k + 2.
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
