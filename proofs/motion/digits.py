"""As many digits as are asked for: precision grows until all bounds have them."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from fractions import Fraction
from typing import TypeVar

from intervals.errors import DomainError, Undecided
from proofs.trusted.flights import lifted, whole_turns
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.numbers import Range

MOST_DIGITS = 1000  # that can be asked for
_ATTEMPTS = 6
_Answer = TypeVar("_Answer")


def bits_for(digits: int, attempt: int = 0) -> int:
    """Return the binary places for so many significant digits, at first or at a later attempt."""
    return digits * 10 // 3 + (20 << 2 * attempt)


def agree(bounds: Range, digits: int) -> bool:
    """Whether two bounds are equal to `digits` significant digits."""
    return bounds[1] - bounds[0] <= min(abs(bounds[0]), abs(bounds[1])) / Fraction(10) ** digits


def around(value: Fraction, bits: int) -> Range:
    """Return multiples of 2^-bits on both sides of a number, 2^(1 - bits) apart."""
    unit = Fraction(1, 2**bits)
    centre = round(value / unit) * unit
    return centre - unit, centre + unit


def middle(x: Enclosure) -> Fraction:
    """Return about the number that is enclosed."""
    return Fraction(x.lo + x.hi, 2 << x.bits)


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


def phase_after(phase: Fraction, time: Range, bits: int) -> Range:
    """Enclose phase + time, less the multiple of 2 pi that puts its lower end in [0, 2 pi).

    The upper end may lie beyond 2 pi.
    """
    total = phase + time[0]
    count = total // whole_turns(1, bits)[0]
    if total < whole_turns(count, bits)[1]:  # the multiple is not decided: take the smaller one
        count -= 1
    return lifted((total, phase + time[1]), -count, bits)
