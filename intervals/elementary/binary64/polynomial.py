"""Horner's rule, and rounding to integers, on arrays."""

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from intervals.rounding import Rows, constant

SHIFT = constant(1.5 * 2.0**52)
SHIFT_BITS = SHIFT.view(np.int64)


def polynomial(coefficients: Iterable[float]) -> tuple[Rows, ...]:
    """Return the coefficients, highest first, as `horner` takes them."""
    return tuple(map(constant, coefficients))


def horner(z: Rows, coefficients: tuple[Rows, ...]) -> Rows:
    """Return the polynomial in z, highest coefficient first: a rounding for each * and +."""
    total = z * coefficients[0]
    for coefficient in coefficients[1:-1]:
        total += coefficient
        total *= z
    total += coefficients[-1]
    return total


def nearest_integers(x: Rows) -> tuple[Rows, NDArray[np.int64]]:
    """Return the integers n nearest to x, |x| < 2^51, as floats and as ints; x is used up.

    fl(x + 1.5 2^52) has the spacing 1, so it is n + 1.5 2^52, and n is what its bits count.
    """
    x += SHIFT
    integers = x.view(np.int64) - SHIFT_BITS
    x -= SHIFT
    return x, integers
