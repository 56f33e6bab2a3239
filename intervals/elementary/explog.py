"""exp and log of a dyadic number in fixed point, with a proved error."""

from intervals.elementary.constants import Constant, log2_fixed
from intervals.elementary.series import (
    COARSE,
    FINE,
    MASK,
    arc,
    exp_at,
    exp_series,
    halvings_for,
    log_at,
    working_bits,
)


def exp_fixed(
    man: int, exp: int, bits: int, log_base: Constant | None = None
) -> tuple[int, int, int]:
    """Return (Y, n, E): |b^x / 2^n 2^bits - Y| <= E for x = man 2^exp, 1 <= Y / 2^bits < 2.

    The base is b = e, or its logarithm is the given constant, at most log 10.

    Proof. |x| < 2^(size-2), so |x log b| < 0.6 2^size and |n| < 0.9 2^size + 1; v has 12 + 2h bits
    more than `bits`, h the number of halvings; w = v + size. X = floor(x 2^w), multiplied by log b
    it errs by at most 2.4 + |x| + 1 <= 3.4 + 0.25 2^size units. L <= log(2) 2^w <= L + 1, and
    n = floor(X / L), so X - n L, in [0, L), errs as 2^w (x log b - n log 2) by at most
    1.15 2^size + 4.4; the shift divides this by 2^size >= 4, rounds down and costs 3.3 units.
    r = j/2^8 + i/2^16 + s, s < 2^-16; halved h times s is known to 5 units. The series makes of
    this e_0 <= 5.1 + 2 k <= 2 k + 6. A squaring of y <= 1.01 with an error of e <= 2^(v-4) units
    makes of it at most 2.1 e + 1, so h of them at most 4^h (2 k + 7), as 2 k + 7 <= 2^(bits + 8).
    The factor exp(i/2^16) < 1.01 is known to 2 units and leaves at most 1.01 e + 4, exp(j/2^8), at
    most 2.01, leaves at most 2.1 (1.01 e + 4) + 4 <= 3 e + 13.
    1 <= y < 2: each factor is a lower bound of an exponential, and the arguments add up to r < L.
    """
    halvings = halvings_for(bits)
    size = max(0, man.bit_length() + exp) + 2
    v = working_bits(bits + 2 * halvings)
    w = v + size
    x = man << (exp + w) if exp + w >= 0 else man >> -(exp + w)
    if log_base:
        x = x * log_base(w) >> w
    n, r = divmod(x, log2_fixed(w))
    r >>= size
    index = int(r >> (v - FINE))
    y, error = exp_series((r - (index << (v - FINE))) >> halvings, v)
    for _ in range(halvings):
        y = y * y >> v
    coarse, fine = index >> (FINE - COARSE), index & MASK
    if fine:
        y = y * exp_at(fine, FINE, v) >> v
    if coarse:
        y = y * exp_at(coarse, COARSE, v) >> v
    error = 3 * ((error + 7) << 2 * halvings) + 13
    drop = v - bits
    return y >> drop, int(n), (error >> drop) + 2


def log_fixed(man: int, exp: int, bits: int) -> tuple[int, int]:
    """Return (Y, E): |log(x) 2^bits - Y| <= E for x = man 2^exp > 0.

    Proof. x = m 2^n with 2/3 <= m < 4/3. `_toward_one` multiplies m by c/2^8 and the result by
    c'/2^15, exactly, and subtracts their logarithms, each known to 2 units. The product is 1 + d,
    |d| < 2^-14.9, and log(1 + d) = 2 atanh z, z = d / (2 + d). |z| is one floor of an exact
    quotient (1 unit, of which atanh makes 1.01). n log 2 errs by at most |n| units at v bits, of
    which there are 12 to spare and as many as n has.
    """
    size = man.bit_length()
    n = size + exp
    if 3 * man < 1 << (size + 1):  # mantissa in [1/2, 2/3): take [1, 4/3) instead
        n -= 1
    v = working_bits(bits + n.bit_length())
    scale = n - exp  # m = man / 2^scale
    total = n * log2_fixed(v) if n else 0
    for step in (8, 15):
        man, scale, part = _toward_one(man, scale, step, v)
        total -= part
    one = 1 << scale
    d = man - one
    value, error = arc((abs(d) << v) // (man + one), v, 1)
    total += -2 * value if d < 0 else 2 * value
    error = 2 * error + 3 + 4 + abs(n)
    drop = v - bits
    return total >> drop, (error >> drop) + 2


def _toward_one(man: int, scale: int, step: int, bits: int) -> tuple[int, int, int]:
    """Return m c / 2^step near 1, as another man and scale, and log(c / 2^step) at `bits`.

    m = man / 2^scale. With t = floor(m 2^step) and c = floor(4^step / t) the product m c / 2^step
    lies in (1 - t / 4^step, 1 + 1/t). If t is 2^step or one less, m is left alone: it is as near
    to 1 as this, and numbers next to 1 keep their exact distance from it. For 2/3 <= m < 4/3 and
    step = 8 this is (1 - 0.0053, 1 + 0.0059); from there step = 15 leads to 1 +- 2^-14.9.
    """
    t = int(man >> (scale - step) if scale >= step else man << (step - scale))
    if t + 1 >> 1 == 1 << (step - 1):
        return man, scale, 0
    c = (1 << 2 * step) // t
    return man * c, scale + step, log_at(c, step, bits)
