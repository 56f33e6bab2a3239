"""A gap and its first zero: how it stays positive, where it falls; for any flight.

`gap_of(interval of times, order)` encloses a derivative of the gaps of some flights.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from proofs.trusted.kernel.arithmetic import Enclosure
from proofs.trusted.numbers import Range, mean_values

Gap = Callable[[Range, int], Enclosure]


def stays_up(gap_of: Gap, time: Range, least: Fraction | int) -> bool:
    """Whether gap > 0 on an interval of times, at whose ends it is `least` or more.

    It is above its chord less w^2/8 max(0, sup gap''), w the width of the interval. `least` is in
    the units of the enclosures of gap''.
    """
    if least <= 0:
        return False
    width = time[1] - time[0]
    return clears(least, gap_of(time, 2).hi, width.numerator, width.denominator)


def clears(least: Fraction | int, bend: Fraction | int, width: int, unit: int) -> bool:
    """Whether least > w^2/8 bend, w = width / unit."""
    return 8 * least * unit**2 > bend * width**2


def brackets(gap_of: Gap, time: Range) -> bool:
    """Whether gap > 0 at the lower end of an interval of times, gap < 0 at the upper one."""
    low, high = (gap_of((end, end), 0) for end in time)
    return low.lo > 0 > high.hi


def fall(gap_of: Gap, time: Range, halvings: int = 0) -> Enclosure:
    """Enclose gap' on an interval of times: directly, and by the mean value theorem.

    halvings: of the interval, again and again, where gap' < 0 is not proved.
    """
    direct = gap_of(time, 1)
    first, last = (gap_of((end, end), 1).range for end in time)
    low, high = mean_values(first, last, gap_of(time, 2).range, time[1] - time[0])
    found = direct.meet(type(direct).of(low, high, direct.bits))
    if found.hi < 0 or not halvings:
        return found
    middle = (time[0] + time[1]) / 2
    one, two = (fall(gap_of, half, halvings - 1) for half in ((time[0], middle), (middle, time[1])))
    return type(direct)(min(one.lo, two.lo), max(one.hi, two.hi), direct.bits)


def falls(gap_of: Gap, time: Range, halvings: int = 0) -> bool:
    """Whether gap' < 0 on an interval of times, which may be halved again and again."""
    if fall(gap_of, time).hi < 0:
        return True
    middle = (time[0] + time[1]) / 2
    halves = (time[0], middle), (middle, time[1])
    return halvings > 0 and all(falls(gap_of, half, halvings - 1) for half in halves)
