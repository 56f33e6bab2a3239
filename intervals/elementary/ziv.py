"""From an enclosure to the next numbers of `precision` bits: Ziv's strategy, and its exceptions.

Theorem. Let y be a real that is no number of `precision` bits, and `enclose(bits)` integers and a
scale with low <= y 2^scale <= high, for bits >= 8. What `tighten` returns is (the largest number
of `precision` bits <= y, the smallest >= y). It returns if (high - low) / 2^scale tends to 0.

Proof. The numbers of `precision` bits next to y span an open interval that contains y; `settled`
answers if low and high lie in its closure. The enclosures shrink to y, so this happens.

Where y is a number of `precision` bits the bounds of `settled` still enclose it, but are one
number apart; such y are rational, and every function names the arguments where they occur. Where y
is extremely near to such a number `beside` answers at once.
"""

from collections.abc import Callable
from typing import TypeAlias

from mpmath.libmp import MPZ, fone, from_man_exp, mpf_add, mpf_neg, mpf_pos

Raw: TypeAlias = tuple[int, int, int, int]  # libmp's number: (sign, man, exp, bit length of man)
Bounds: TypeAlias = tuple[Raw, Raw]
Enclosure: TypeAlias = tuple[int, int, int]  # low, high, scale

DOWN, UP = "f", "c"
_GUARD = 10  # bits beyond the precision to begin with: they suffice about 99 times in 100


def settled(low: int, high: int, scale: int, precision: int) -> Bounds | None:
    """Return the numbers of `precision` bits around [low, high] / 2^scale, if nothing is between.

    For low > 0 and high - 1 of b >= precision bits these are the multiples of 2^(b - precision),
    from 2^(b-1) to 2^b: d = floor(low / 2^(b - precision)) of them, and the next one, if
    high <= (d + 1) 2^(b - precision). If low < 2^(b-1), then d < 2^(precision-1) fails this.
    """
    if low <= 0:
        if high >= 0:
            return None
        bounds = settled(-high, -low, scale, precision)
        return bounds and negated(bounds)
    most = high - 1
    shift = most.bit_length() - precision
    if shift < 0:
        return None
    down = low >> shift
    if most >> shift != down:
        return None
    return _number(down, shift - scale), _number(down + 1, shift - scale)


def _number(man: int, exp: int) -> Raw:
    """Return man 2^exp, man > 0, sooner than libmp does."""
    if not man & 1:
        zeros = (man & -man).bit_length() - 1
        man >>= zeros
        exp += zeros
    return 0, MPZ(man), exp, man.bit_length()


def tighten(enclose: Callable[[int], Enclosure], precision: int, extra: int = 0) -> Bounds:
    """Return the bounds of y, see above; `extra` more bits to begin with are a guess."""
    guard = _GUARD
    while True:
        low, high, scale = enclose(precision + extra + guard)
        bounds = settled(low, high, scale, precision)
        if bounds:
            return bounds
        guard *= 2


def beside(x: Raw, upward: bool, precision: int) -> Bounds:
    """Return the bounds of y, where x < y < x + g or x - g < y < x, g = 2^`spacing(x, precision)`.

    x and the numbers of `precision` bits between x / 2 and 2 x are multiples of g, so that none of
    the latter lies between x and x +- g, and y is rounded as x +- g/2.
    """
    near = mpf_add(x, from_man_exp(1 if upward else -1, spacing(x, precision) - 1))
    low, high = (x, near) if upward else (near, x)
    return mpf_pos(low, precision, DOWN), mpf_pos(high, precision, UP)


def spacing(x: Raw, precision: int) -> int:
    """Return e such that x != 0 and the numbers of `precision` bits near it are multiples of 2^e.

    Those of size |x| / 2 and more are multiples of 2^(magnitude - 1 - precision).
    """
    return min(x[2], magnitude(x) - 1 - precision)


def magnitude(x: Raw) -> int:
    """Return m with 2^(m-1) <= |x| < 2^m, for x != 0."""
    return x[2] + x[3]


def near_argument(x: Raw, order: int, growing: bool, precision: int) -> Bounds | None:
    """Return the bounds of f(x) if |x| is so small that x decides them, else None.

    Hypothesis: 0 < |f(x) - x| < |x|^order for 0 < |x| <= 1/2, order >= 2, and f(x) > x if
    `growing`, else f(x) < x. What is asked is |x|^order <= 2^spacing(x); it includes |x| < 1/2.
    """
    if order * magnitude(x) <= spacing(x, precision):
        return beside(x, growing, precision)
    return None


def near_or_tight(
    x: Raw, order: int, growing: bool, enclose: Callable[[int], Enclosure], precision: int
) -> Bounds:
    """Return the bounds of f(x), about as small as x: by `near_argument`, else by `tighten`."""
    near = near_argument(x, order, growing, precision)
    return near or tighten(enclose, precision, max(0, -magnitude(x)))


def near_one(distance: int, upward: bool, precision: int) -> Bounds | None:
    """Return the bounds of y, 0 < |y - 1| < 2^distance, if 1 decides them, else None."""
    return beside(fone, upward, precision) if distance <= -precision else None


def negated(bounds: Bounds) -> Bounds:
    """Return the bounds of -y."""
    return mpf_neg(bounds[1]), mpf_neg(bounds[0])


def signed(x: Raw) -> int:
    """Return the mantissa of x with its sign."""
    return -x[1] if x[0] else x[1]


def odd(function: Callable[[Raw, int], Bounds]) -> Callable[[Raw, int], Bounds]:
    """Return the odd function with these bounds for x > 0: f(0) = 0 and f(-x) = -f(x)."""

    def extended(x: Raw, precision: int) -> Bounds:
        if not x[1]:
            return x, x
        if x[0]:
            return negated(function(mpf_neg(x), precision))
        return function(x, precision)

    return extended
