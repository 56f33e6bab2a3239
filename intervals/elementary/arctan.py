"""The angle of a point in the first quadrant in fixed point, with a proved error: atan, atan2."""

from intervals.elementary.constants import pi_fixed
from intervals.elementary.series import COARSE, FINE, arc, atan_at, working_bits


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
