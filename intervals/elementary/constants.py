"""pi and log 2 in fixed point, from Machin's and Gauss's formulas on integers.

Conventions of this folder: a real x in fixed point at `bits` is an integer X with an error
bound E, |x 2^bits - X| <= E. Right shifts and // round down, so each costs at most one unit.
"""

from functools import lru_cache


def _arc(inverse: int, bits: int, sign: int) -> tuple[int, int]:
    """Return (A, E): atan(1/n) for sign = -1, atanh(1/n) for sign = +1, in fixed point.

    The series sum_k sign^k / ((2k+1) n^(2k+1)), n >= 2. Each power is the floor of the exact
    one divided once more (nested floors of positive integers are one floor), each term is a
    further floor: one unit a term at most, k units. The loop ends when the power is below one
    unit; the tail is then below 1 / (1 - 1/n^2) < 2 units.
    """
    power, square = (1 << bits) // inverse, inverse * inverse
    total, k, alternating = 0, 0, 1
    while power:
        total += alternating * (power // (2 * k + 1))
        power //= square
        alternating *= sign
        k += 1
    return total, k + 2


@lru_cache(maxsize=64)
def pi_fixed(bits: int) -> int:
    """Return P with P <= pi 2^bits <= P + 1 (Machin: pi/4 = 4 atan 1/5 - atan 1/239)."""
    return _settle(((16, 5), (-4, 239)), -1, bits)


@lru_cache(maxsize=64)
def log2_fixed(bits: int) -> int:
    """Return L with L <= log(2) 2^bits <= L + 1.

    log 2 = 18 atanh 1/26 - 2 atanh 1/4801 + 8 atanh 1/8749.
    """
    return _settle(((18, 26), (-2, 4801), (8, 8749)), 1, bits)


def _settle(terms: tuple[tuple[int, int], ...], sign: int, bits: int) -> int:
    """Return floor(c 2^bits), where c is the sum of weight * atan(1/n), or atanh if sign = +1.

    With g guard bits c 2^(bits + g) lies in [total - error, total + error]. If the floors of both
    over 2^g are equal, they are the floor wanted. If not (the odds are error 2^-g), g is doubled;
    this ends, since c is irrational.
    """
    guard = 20 + bits.bit_length()
    while True:
        total = error = 0
        for weight, inverse in terms:
            value, units = _arc(inverse, bits + guard, sign)
            total += weight * value
            error += abs(weight) * units
        low, high = (total - error) >> guard, (total + error) >> guard
        if low == high:
            return low
        guard *= 2
