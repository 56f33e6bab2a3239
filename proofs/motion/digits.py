"""As many digits as are asked for: precision grows until all bounds have them."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from fractions import Fraction
from typing import TypeVar

from intervals.errors import DomainError, Undecided
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.numbers import Range, agree

MOST_DIGITS = 1000  # that can be asked for
_ATTEMPTS = 6
_Answer = TypeVar("_Answer")


def bits_for(digits: int, attempt: int = 0) -> int:
    """Return the binary places for so many significant digits, at first or at a later attempt."""
    return digits * 10 // 3 + (20 << 2 * attempt)


def around(value: Fraction, bits: int) -> Range:
    """Return multiples of 2^-bits on both sides of a number, 2^(1 - bits) apart."""
    unit = Fraction(1, 2**bits)
    centre = round(value / unit) * unit
    return centre - unit, centre + unit


def to_digits(
    digits: int,
    make: Callable[[int], _Answer],
    bounds: Callable[[_Answer], Iterable[Range]],
    final: tuple[type[Undecided], ...] = (),
) -> _Answer:
    """Return what `make` finds with as many bits as it takes for its bounds to agree.

    Each with its partner to `digits` significant digits; Undecided if they do not. final: the
    failures that more bits do not mend.
    """
    reason = ""
    for attempt in range(_ATTEMPTS):
        try:
            answer = make(bits_for(digits, attempt))
        except final:
            raise
        except (Undecided, DomainError, Unproved) as failure:  # a slow impact asks for more bits
            reason = str(failure)
            continue
        if all(agree(each, digits + 1) for each in bounds(answer)):
            return answer
    reason = reason or "the result is too close to 0 or to grazing"
    raise Undecided(f"{digits} digits are not reached: {reason}")
