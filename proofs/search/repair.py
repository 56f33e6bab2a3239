"""Search for the nearest sets, in the printed precision, on which a horseshoe may be proved.

Candidates only: floating point finds them, `proofs.horseshoe` proves or discards them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import cache
from itertools import product

from proofs.motion.simulate import next_impact
from proofs.motion.system import System
from proofs.trusted.numbers import Range
from proofs.trusted.parameters import Parameters

REACH = 6  # units in the last printed place, in all


def places(values: tuple[Fraction, ...]) -> int:
    """Return the decimal places that write all values exactly (at most 6)."""
    for count in range(7):
        if all((value * 10**count).denominator == 1 for value in values):
            return count
    return 6


def moves(total: int) -> list[tuple[int, ...]]:
    """Return all displacements of four ends by `total` units in sum."""
    span = range(-total, total + 1)
    return [move for move in product(span, repeat=4) if sum(map(abs, move)) == total]


def moved_ends(ends: tuple[Fraction, ...]) -> Iterator[tuple[Fraction, ...]]:
    """Yield four ends in order, nearest to the given ones first, which come before all.

    First in units of the last printed place, then in units ten times smaller.
    """
    for count in (places(ends), places(ends) + 1):
        unit = Fraction(1, 10**count)
        for total in range(REACH + 1):
            for move in moves(total):
                moved = tuple(end + unit * step for end, step in zip(ends, move, strict=True))
                if sorted(set(moved)) == list(moved) and moved[0] >= 0:
                    yield moved


def nearest_sets(numbers: Parameters) -> Iterator[Parameters]:
    """Yield sets on which each image seems to cover I, nearest first; the slopes are kept."""
    system = System(numbers.eta, numbers.nu)
    signs = [sign for sign in numbers.signs for _ in range(2)]

    @cache
    def image(end: Fraction) -> tuple[float, float] | None:
        impact = next_impact(system, float(end))
        return None if impact is None else (impact.phase, impact.slope)

    for moved in moved_ends((*numbers.left, *numbers.right)):
        if _covers(moved, signs, image):
            left, right = (moved[0], moved[1]), (moved[2], moved[3])
            yield replace(numbers, left=left, right=right, interval=(moved[0], moved[3]))


def _covers(
    ends: tuple[Fraction, ...],
    signs: Sequence[int],
    image: Callable[[Fraction], tuple[float, float] | None],
) -> bool:
    """Whether, in floating point, f expands with these signs at the ends, and covers I."""
    for index, (end, sign) in enumerate(zip(ends, signs, strict=True)):
        sent = image(end)
        if sent is None or sign * sent[1] <= 1:
            return False
        is_lower = (index % 2 == 0) == (sign > 0)
        if (sent[0] > ends[0]) if is_lower else (sent[0] < ends[3]):
            return False
    return True


def rounded_slopes(bounds: Range, digits: int) -> Range:
    """Round slope bounds outward to a number of decimal places."""
    scale = 10**digits
    low, high = bounds
    return Fraction(low * scale // 1, scale), Fraction(-(-high * scale // 1), scale)


def grid(domain: Range, finest: int = 64, stride: int = 1) -> Iterator[Fraction]:
    """Yield interior points of an interval: halves, quarters, ..., then ever closer to its ends.

    The distances to the ends fall by factors 2^stride, down to 2^-30 of the width.
    """
    low, high = domain
    parts = 2
    while parts <= finest:
        for index in range(1, parts, 2):
            yield low + (high - low) * index / parts
        parts *= 2
    for exponent in range(finest.bit_length(), 30, stride):
        yield low + (high - low) / 2**exponent
        yield high - (high - low) / 2**exponent


def short_decimal(low: Fraction, high: Fraction) -> Fraction:
    """Return the shortest decimal strictly between two numbers."""
    count = 0
    while True:
        unit = Fraction(1, 10**count)
        candidate = (low // unit + 1) * unit
        if candidate < high:
            return candidate
        count += 1
