"""floor, ceil, trunc, the two roundings and the sign of a libmp number, exactly."""

from collections.abc import Callable

from mpmath.libmp import from_int, fzero

from intervals.elementary.tightest import Bounds, Raw


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
