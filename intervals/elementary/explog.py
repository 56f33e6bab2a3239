"""exp and log of a dyadic number in fixed point, with a proved error."""

from intervals.elementary.constants import log2_fixed


def exp_fixed(man: int, exp: int, bits: int) -> tuple[int, int, int]:
    """Return (Y, n, E): |exp(x) / 2^n 2^bits - Y| <= E for x = man 2^exp, and 1/2 < Y/2^bits < 2.

    Proof. With L <= log(2) 2^w <= L + 1 and w = v + size, size the bit length of the integer
    part of |x|: n = round(x / log 2) and r = x - n log 2, |r| < 0.35, known to
    (1 + |n|) / 2^size + 1 <= 4 units at v bits. Halved k times: 5 units of argument, which
    exp multiplies by less than 2. Taylor's series loses 2 units a term (each term has error
    at most (0.35 e + 1) / 1 + 1 < 4, the sum of the geometric tail one unit). A squaring of
    y <= 1.5 with error e makes at most 3 e + e^2 + 1 <= 4 e + 1 units.
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

    Proof. x = m 2^n with 2/3 < m < 4/3 (2^-0.58, 2^0.42); log m = 2 atanh z,
    z = (m - 1) / (m + 1), |z| <= 1/5. z is one floor of an exact quotient (1 unit), which
    atanh and the factor 2 make at most 3. Each term z^(2k+1) / (2k+1) errs by at most two
    units (the power by (e |z|^2 + 2 |z|^2 + 1) <= 1.2, the quotient by 1), doubled 4 units a
    term; the tail is below the last power, one unit, times 1/24. n log 2 errs by |n| units at
    the working precision, which has size(n) guard bits.
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
