"""pi and log 2 in fixed point, from Machin's and Gauss's formulas on integers.

Conventions of this folder: a real x in fixed point at `bits` is an integer X with an error
bound E, |x 2^bits - X| <= E. Right shifts and // round down, so each costs at most one unit.
"""

from functools import lru_cache


def _arc(inverse: int, bits: int, sign: int) -> tuple[int, int]:
    """Return (A, E): atan(1/n) for sign = -1, atanh(1/n) for sign = +1, in fixed point.

    The series sum_k sign^k / ((2k+1) n^(2k+1)), n >= 2. Each power is the floor of the exact
    one divided once more (nested floors of positive integers are one floor), each term is a
    further floor: one unit a term at most. The loop ends when the power is below one unit;
    the tail is then below 1 / (1 - 1/n^2) < 2 units.
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
    guard = 20 + bits.bit_length()
    a, a_error = _arc(5, bits + guard, -1)
    b, b_error = _arc(239, bits + guard, -1)
    return _settle(16 * a - 4 * b, 16 * a_error + 4 * b_error, guard)


@lru_cache(maxsize=64)
def log2_fixed(bits: int) -> int:
    """Return L with L <= log(2) 2^bits <= L + 1.

    log 2 = 18 atanh 1/26 - 2 atanh 1/4801 + 8 atanh 1/8749.
    """
    guard = 20 + bits.bit_length()
    values = [_arc(n, bits + guard, 1) for n in (26, 4801, 8749)]
    total = sum(weight * value for weight, (value, _) in zip((18, -2, 8), values, strict=True))
    error = sum(weight * e for weight, (_, e) in zip((18, 2, 8), values, strict=True))
    return _settle(total, error, guard)


def _settle(value: int, error: int, guard: int) -> int:
    """Return the floor of the true value / 2^guard, which [value - error, value + error] decides.

    The guard bits make an undecided floor an event of odds 2^-guard * error; it raises.
    """
    low, high = (value - error) >> guard, (value + error) >> guard
    if low != high:
        raise ArithmeticError("the guard bits do not decide the last digit of a constant")
    return low
