"""Exact numbers, ranges of them, phases; and how they are printed."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from itertools import count, pairwise
from typing import Self

from proofs.trusted.kernel.arithmetic import Unproved

Range = tuple[Fraction, Fraction]

TURN = Fraction("6.283185307")  # a little less than 2 pi
COVER_BITS, MAX_BITS = 64, 4000  # precisions, from that of a cover
_LONGEST = 12_000  # bits of a number that is written
_MOST_PLACES = 40  # of a decimal, where nobody asked for more


class _Pair(tuple[Fraction, Fraction]):
    __slots__ = ()

    def __new__(cls, low: Fraction, high: Fraction) -> Self:
        """Raise Unproved unless the ends are as the class says."""
        cls._require(low, high)
        return super().__new__(cls, (low, high))

    def __getnewargs__(self) -> tuple[Fraction, Fraction]:  # to be copied, and sent to processes
        return self[0], self[1]

    @staticmethod
    def _require(low: Fraction, high: Fraction) -> None:
        raise NotImplementedError


class Phases(_Pair):
    """A closed interval of phases in [0, 2 pi), of positive width: it has an order."""

    __slots__ = ()

    @staticmethod
    def _require(low: Fraction, high: Fraction) -> None:
        if not 0 <= low < high <= TURN:
            raise Unproved(f"[{show(low)}, {show(high)}] is no interval of phases in [0, 2 pi)")


class Phase(_Pair):
    """An enclosure of one phase in [0, 2 pi): it does not straddle 2 pi, so it can be compared."""

    __slots__ = ()

    @staticmethod
    def _require(low: Fraction, high: Fraction) -> None:
        if not 0 <= low <= high <= TURN:
            raise Unproved("an enclosure of a phase straddles 2 pi")


def show(value: Fraction) -> str:
    """Write an exact rational as a plain decimal where it is one, else as p/q.

    Raises Unproved where it has more digits than anybody reads.
    """
    if max(abs(value.numerator), value.denominator).bit_length() > _LONGEST:
        raise Unproved("a number with too many digits to be written")
    if 10**_MOST_PLACES % value.denominator:
        return str(value)
    return _decimal(value, next(n for n in count() if 10**n % value.denominator == 0))


def _decimal(value: Fraction, places: int) -> str:
    digits = str(abs(value.numerator) * (10**places // value.denominator)).rjust(places + 1, "0")
    sign = "-" if value < 0 else ""
    return sign + (f"{digits[:-places]}.{digits[-places:]}" if places else digits)


def show_range(values: Range) -> str:
    """Write a closed interval of exact rationals."""
    return f"[{show(values[0])}, {show(values[1])}]"


def floor_text(value: Fraction, places: int = 6) -> str:
    """Write a decimal of so many places that is <= value."""
    floor = Fraction(value * 10**places // 1, 10**places)
    return show(floor) if places <= _MOST_PLACES else _decimal(floor, places)


def ceil_text(value: Fraction, places: int = 6) -> str:
    """Write a decimal of so many places that is >= value."""
    return floor_text(Fraction(-(-value * 10**places // 1), 10**places), places)


def between(bounds: Range, places: int = 6) -> str:
    """Write an enclosure, rounded outward: a number where that is one."""
    low, high = floor_text(bounds[0], places), ceil_text(bounds[1], places)
    return low if low == high else f"[{low}, {high}]"


def decimals(bounds: Range) -> tuple[str, str]:
    """Write different bounds, rounded outward, to two places more than they decide."""
    places = len(str(int(1 / (bounds[1] - bounds[0])))) + 1
    return floor_text(bounds[0], places), ceil_text(bounds[1], places)


def within(inner: Range, outer: Range) -> bool:
    """Whether one range contains another."""
    return outer[0] <= inner[0] and inner[1] <= outer[1]


def increasing(values: Sequence[Fraction | int]) -> bool:
    """Whether numbers increase strictly."""
    return all(low < high for low, high in pairwise(values))


def covered(whole: Range, parts: Iterable[Range]) -> bool:
    """Whether an interval is covered by others, in the order of their lower ends."""
    reached = whole[0]
    for low, high in parts:
        if low <= reached:
            reached = max(reached, high)
    return whole[1] <= reached


def mean_values(first: Range, last: Range, derivative: Range, width: Fraction) -> Range:
    """Enclose a function on an interval, from its ends and the range of its derivative."""
    down, up = min(derivative[0], Fraction(0)) * width, max(derivative[1], Fraction(0)) * width
    return max(first[0] + down, last[0] - up), min(first[1] + up, last[1] - down)


def hull(ranges: Sequence[Range]) -> Range:
    """Return the smallest range that contains all."""
    return min(low for low, _ in ranges), max(high for _, high in ranges)


def common(one: Range, two: Range) -> Range:
    """Return what two enclosures of the same have in common; Unproved if that is nothing."""
    low, high = max(one[0], two[0]), min(one[1], two[1])
    if low > high:
        raise Unproved("two enclosures exclude each other")
    return low, high


def bits_for(time: Range) -> int:
    """Return the precision that a bracket of this width deserves."""
    width = time[1] - time[0]
    if width == 0:
        raise Unproved("an empty bracket")
    return rounded_bits(max(COVER_BITS, (1 / width).__ceil__().bit_length() + 40))


def rounded_bits(bits: int) -> int:
    """Return a precision that many share, so that the sines of their times are known."""
    return min(MAX_BITS, -(-bits // 16) * 16)
