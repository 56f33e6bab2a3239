"""exp and log of a dyadic number in fixed point, with a proved error."""

from intervals.elementary.constants import log2_fixed


def exp_fixed(man: int, exp: int, bits: int) -> tuple[int, int, int]:
    """Return (Y, n, E): |exp(x) / 2^n 2^bits - Y| <= E for x = man 2^exp, 1/2 <= Y / 2^bits < 2.

    Proof. |x| < 2^(size-1), size >= 1; v = bits + 12 + 2h, h >= 2 the number of halvings;
    w = v + size. L <= log(2) 2^w <= L + 1, X = floor(x 2^w), n = round(X / L), so that
    |n| <= 0.73 2^size + 0.51. X - n L errs as 2^w (x - n log 2) by at most 1 + |n|; the shift
    divides this by 2^(size+h) and rounds down: r = (x - n log 2) 2^(v-h) / 2^v is known to 2 units,
    |r| <= 0.3467 / 4 < 0.09, and exp makes less than 3 of them.
    Taylor: from a term with error e the next one has error at most (0.09 e + 1) / 2 + 1 < 2 units.
    The last one computed is 0 or -1, the true one at most 3 units, the tail below one. So
    e_0 <= 3 + 2 k + 1 <= 4 k + 10. A squaring of y <= 1.2 with an error of e <= 2^v units makes of
    it at most 2.4 e + e + 1 <= 4 e + 1: e_h <= 4^h (e_0 + 1/3) < 4^h (4 k + 11), which is at most
    2^v because 4 k + 11 <= 2^(bits + 12): every term has three bits less than the one before.
    """
    halvings = max(2, int(bits**0.5) // 2)
    size = max(0, man.bit_length() + exp) + 1
    v = bits + 12 + 2 * halvings
    w = v + size
    x = man << (exp + w) if exp + w >= 0 else man >> -(exp + w)
    log2 = log2_fixed(w)
    n = (2 * x + log2) // (2 * log2)
    r = (x - n * log2) >> (size + halvings)
    one = 1 << v
    y, term, k = one + r, r, 1
    while term not in (0, -1):
        k += 1
        term = (term * r >> v) // k
        y += term
    for _ in range(halvings):
        y = y * y >> v
    error = (10 + 4 * k + 1) << 2 * halvings
    drop = v - bits
    return y >> drop, n, (error >> drop) + 2


def log_fixed(man: int, exp: int, bits: int) -> tuple[int, int]:
    """Return (Y, E): |log(x) 2^bits - Y| <= E for x = man 2^exp > 0.

    Proof. x = m 2^n with 2/3 <= m < 4/3; log m = 2 atanh z, z = (m - 1) / (m + 1), |z| <= 1/5.
    z is one floor of an exact quotient (1 unit), which atanh and the factor 2 make at most 3.
    From a power with error e the next one has error at most 0.04 e + |z| + 1 <= 1.25 units, and
    the quotient by k = 3, 5, ... at most 0.42 + 1 < 2. Doubled 4 units a term, and there are
    (k - 1) / 2 of them: 2 k in all. The last power computed is 0 or -1, the true one at most 2.25
    units; the tail, less than 1/24 of it, is below one unit doubled. n log 2 errs by at most |n|
    units at v bits, of which as many as n has are spare.
    """
    size = man.bit_length()
    n = size + exp
    if 3 * man < 1 << (size + 1):  # mantissa in [1/2, 2/3): take [1, 4/3) instead
        n -= 1
    v = bits + 12 + n.bit_length()
    scale = n - exp  # m = man / 2^scale
    z = ((man - (1 << scale)) << v) // (man + (1 << scale))
    square = z * z >> v
    total, power, k = z, z, 1
    while power not in (0, -1):
        k += 2
        power = power * square >> v
        total += power // k
    value = 2 * total + n * log2_fixed(v)
    error = 4 + 2 * k + 4 + abs(n)
    drop = v - bits
    return value >> drop, (error >> drop) + 2
