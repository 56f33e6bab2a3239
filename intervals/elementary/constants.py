"""pi, log 2, log 10 in fixed point, from Machin's and Gauss's formulas on integers.

Conventions of this folder: a real x in fixed point at `bits` is an integer X with an error
bound E, |x 2^bits - X| <= E. Right shifts and // round down, so each costs at most one unit.
"""

from collections.abc import Callable
from functools import lru_cache
from typing import TypeAlias

Constant: TypeAlias = Callable[[int], int]  # bits -> the floor in fixed point


def arc_of_ratio(numerator: int, denominator: int, bits: int, sign: int) -> tuple[int, int]:
    """Return (A, E): atan z for sign = -1, atanh z for sign = +1, z = numerator / denominator.

    Hypothesis: 0 < z <= 1/2. The series is sum_k sign^k z^(2k+1) / (2k+1). Each power is the floor
    of the one before times z^2 <= 1/4: from an error of e units the next one has at most
    e / 4 + 1 <= 4/3, and the floor of its quotient by 3, 5, ... at most 4/9 + 1 < 2 (the first
    term errs by one unit). So k terms err by less than 2 k units. The loop ends when the power is
    below one unit, the true one is then below 7/3, and the tail below 7/3 / 3 / (1 - 1/4) < 2.
    """
    over, under = numerator * numerator, denominator * denominator
    power = (numerator << bits) // denominator
    total, k, alternating = 0, 0, 1
    while power:
        total += alternating * (power // (2 * k + 1))
        power = power * over // under
        alternating *= sign
        k += 1
    return total, 2 * k + 2


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


@lru_cache(maxsize=64)
def log10_fixed(bits: int) -> int:
    """Return L with L <= log(10) 2^bits <= L + 1.

    log 10 = 46 atanh 1/31 + 34 atanh 1/49 + 20 atanh 1/161: as 2 atanh 1/n = log((n+1) / (n-1)),
    this is 10 = (16/15)^23 (25/24)^17 (81/80)^10.
    """
    return _settle(((46, 31), (34, 49), (20, 161)), 1, bits)


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
            value, units = arc_of_ratio(1, inverse, bits + guard, sign)
            total += weight * value
            error += abs(weight) * units
        low, high = (total - error) >> guard, (total + error) >> guard
        if low == high:
            from mpmath.libmp import MPZ  # which others of this folder need anyway

            floor: int = MPZ(low)
            return floor
        guard *= 2
