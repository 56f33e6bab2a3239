"""When impacts come: brackets of their times, as the lemma `brackets` takes them."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from proofs.motion.digits import around
from proofs.motion.witness import MOST_BITS, FlightBox
from proofs.trusted.kernel.arithmetic import Enclosure
from proofs.trusted.kernel.gaps import Gap
from proofs.trusted.numbers import COVER_BITS, Range

_ROOM = 40  # bits of precision beyond those of a bracket
_STEPS, _COARSE = 200, 40  # of Newton's method, and the bits that its first steps find


def impact_time(flights: FlightBox, window: Range, bits: int) -> Range:
    """Bracket the impact of (nearly) one launch in 2^(1 - bits), by Newton's method: gap falls."""
    middle = sum(window, Fraction(0)) / 2
    time = _zero(flights.gap_of(COVER_BITS), window, middle, min(bits, _COARSE))
    precision = bits + _ROOM + _loss(flights, time)
    low, high = around(_zero(flights.gap_of(precision), window, time, bits + 8), bits)
    return max(low, window[0]), min(high, window[1])


def _loss(flights: FlightBox, time: Fraction) -> int:
    """Return the bits that a slow impact costs: time is known to rounding / |gap'|."""
    for bits in range(COVER_BITS, MOST_BITS, COVER_BITS):
        fall = -flights.gap_of(bits)((time, time), 1).hi
        if fall > 0:
            return max(0, bits - fall.bit_length())
    return MOST_BITS


def _zero(gap_of: Gap, window: Range, time: Fraction, bits: int) -> Fraction:
    """Return about where a gap that falls is 0, to 2^-bits."""
    (low, high), unit = window, 2 ** (bits + 8)
    for _ in range(_STEPS):
        height, rate = (sum(gap_of((time, time), order).range) for order in (0, 1))
        low, high = (time, high) if height > 0 else (low, time)
        ahead = low - 1
        if rate < 0:
            ahead = Fraction(round((time - Fraction(height) / Fraction(rate)) * unit), unit)
        if not low <= ahead <= high:
            ahead = (low + high) / 2
        time, step = ahead, ahead - time
        if abs(step) * 2**bits < 1:
            break
    return time


def impact_times(gap_of: Gap, window: Range, halvings: int) -> Range:
    """Bracket the impacts of all launches of a set, as the signs of their gaps allow.

    To multiples of 2^-halvings of the window: where the gap is > 0 for all launches no zero lies
    before, where it is < 0 none lies after.
    """
    (low, high), count = window, 2**halvings
    unit = (high - low) / count

    def after(k: int) -> float:
        return float(gap_of((low + k * unit,) * 2, 0).range[0])

    def before(k: int) -> float:
        return float(-gap_of((high - k * unit,) * 2, 0).range[1])

    return low + last_positive(after, count) * unit, high - last_positive(before, count) * unit


def middle(x: Enclosure) -> Fraction:
    """Return about the number that is enclosed."""
    return Fraction(x.lo + x.hi, 2 << x.bits)


def last_positive(function: Callable[[int], float], most: int) -> int:
    """Return the last whole number below `most` at which a decreasing function is > 0; else 0.

    By the regula falsi, the value at an end that stays being halved (Illinois).
    """
    left, right = 0, most
    above, below, moved = function(left), function(right), 0
    while right - left > 1 and above > 0:
        share = above / (above - below) if below < 0 else 0.5
        k = min(max(left + round((right - left) * Fraction(share)), left + 1), right - 1)
        value = function(k)
        if value > 0:
            left, above, below = k, value, below / (1 + (moved > 0))
        else:
            right, below, above = k, value, above / (1 + (moved < 0))
        moved = 1 if value > 0 else -1
    return left
