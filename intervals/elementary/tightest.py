"""The elementary functions of dyadic numbers, rounded to the next numbers of `precision` bits.

Theorem. For a dyadic x in the domain, each function returns (y_down, y_up): the largest number of
`precision` bits that is <= f(x), and the smallest that is >= f(x). They are equal if and only if
f(x) is such a number.

Proof. The kernels `exp_fixed`, `log_fixed`, `sincos_fixed`, `angle_fixed` enclose f(x) as closely
as asked; `ziv.tighten` asks for more until the bounds are settled, which happens unless f(x) is a
number of `precision` bits. Where that occurs is known, from Lindemann's theorem for transcendental
functions and from unique factorization for roots, powers and the bases 2 and 10; these values are
computed exactly. Arguments so near to 0, 1, infinity that many bits would be needed are settled by
the inequalities that each function names.

floor, ceil, trunc, the two roundings and the sign of a libmp number, exactly.
"""

from collections.abc import Callable

from mpmath.libmp import from_int, fzero

from intervals.elementary import algebraic, circular, exponential, logarithm
from intervals.elementary.algebraic import hypot, root
from intervals.elementary.circular import atan2, sincos
from intervals.elementary.exponential import exp
from intervals.elementary.logarithm import log
from intervals.elementary.power import integer_power, power
from intervals.elementary.ziv import DOWN, UP, Bounds, Raw
from intervals.functions import TABLE

__all__ = [
    "DOWN",
    "FUNCTIONS",
    "UP",
    "Bounds",
    "Raw",
    "atan2",
    "exp",
    "hypot",
    "integer_power",
    "log",
    "power",
    "root",
    "sincos",
]

FUNCTIONS: dict[str, Callable[[Raw, int], Bounds]] = {
    name: getattr(module, name)
    for module in (algebraic, circular, exponential, logarithm)
    for name in TABLE
    if hasattr(module, name)
}


def _whole(rule: Callable[[int, int], int]) -> Callable[[Raw, int], Bounds]:
    """Return the step function floor((m + rule(m, s)) / 2^s) of x = m 2^-s, s > 0.

    A number with s <= 0 is an integer, which every one of these functions leaves alone. One with
    |x| < 1/2, whatever its size, is replaced by +-1/4, which has the same images.
    """

    def function(x: Raw, _precision: int) -> Bounds:
        sign, man, exp, size = x
        if exp >= 0 or not man:
            return x, x
        if exp + size < 0:
            man, exp = 1, -2
        signed = -int(man) if sign else int(man)
        value: Raw = from_int((signed + rule(signed, -exp)) >> -exp)
        return value, value

    return function


def _ties_to_even(man: int, shift: int) -> int:
    """Return 1/2, and a unit less where the floor of x is even, so that a tie falls back to it."""
    return (1 << (shift - 1)) - (not man >> shift & 1)


def _ties_to_away(man: int, shift: int) -> int:
    """Return 1/2, and a unit less below 0, so that a tie falls away from 0."""
    return (1 << (shift - 1)) - (man < 0)


def _sign(x: Raw, _precision: int) -> Bounds:
    value: Raw = from_int(-1 if x[0] else 1) if x[1] else fzero
    return value, value


STEPS: dict[str, Callable[[Raw, int], Bounds]] = {
    "floor": _whole(lambda man, shift: 0),
    "ceil": _whole(lambda man, shift: (1 << shift) - 1),
    "trunc": _whole(lambda man, shift: (1 << shift) - 1 if man < 0 else 0),
    "round_ties_to_even": _whole(_ties_to_even),
    "round_ties_to_away": _whole(_ties_to_away),
    "sign": _sign,
}
