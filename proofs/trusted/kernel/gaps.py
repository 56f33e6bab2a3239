"""A gap and its first zero: how it stays positive, where it falls; for any flight.

`gap_of(interval of times, order)` encloses a derivative of the gaps of some flights.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from itertools import pairwise

from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.numbers import Range, mean_values

_HALVINGS = 4  # of a window, to prove that the gap falls
_ZERO = Fraction(0)
Gap = Callable[[Range, int], Enclosure]


def stays_up(
    gap_of: Gap, time: Range, least: Fraction | int, bend: Enclosure | None = None
) -> bool:
    """Whether gap > 0 on an interval of times, at whose ends it is `least` or more.

    It is above its chord less w^2/8 max(0, sup gap''), w the width of the interval. `least` is in
    the units of the enclosures of gap''. bend: one on a longer interval, if it is known.
    """
    if least <= 0:
        return False
    width = time[1] - time[0]
    parts = width.numerator, width.denominator
    known = bend is not None and clears(least, bend.hi, *parts)
    return known or clears(least, gap_of(time, 2).hi, *parts)


def clears(least: Fraction | int, bend: Fraction | int, width: int, unit: int) -> bool:
    """Whether least > w^2/8 bend, w = width / unit."""
    return 8 * least * unit**2 > bend * width**2


def brackets(gap_of: Gap, time: Range) -> bool:
    """Whether gap > 0 at the lower end of an interval of times, gap < 0 at the upper one."""
    low, high = (gap_of((end, end), 0) for end in time)
    return low.lo > 0 > high.hi


def fall(gap_of: Gap, time: Range, halvings: int = 0) -> Enclosure:
    """Enclose gap' on an interval of times: directly, and by the mean value theorem.

    halvings: of the interval, again and again, where gap' < 0 is not proved, until it is.
    """
    direct = gap_of(time, 1)
    first, last = (gap_of((end, end), 1).range for end in time)
    low, high = mean_values(first, last, gap_of(time, 2).range, time[1] - time[0])
    slope = direct.meet(type(direct).of(low, high, direct.bits))
    if slope.hi < 0 or not halvings:
        return slope
    middle, ends = (time[0] + time[1]) / 2, []
    for half in ((time[0], middle), (middle, time[1])):
        part = fall(gap_of, half, halvings - 1)
        if part.hi >= 0:  # more is not worth looking at
            return slope
        ends += [part.lo, part.hi]
    return type(direct)(min(ends), max(ends), direct.bits)


def falls(gap_of: Gap, time: Range, halvings: int = 0) -> bool:
    """Whether gap' < 0 on an interval of times, which may be halved again and again."""
    return fall(gap_of, time, halvings).hi < 0


def open_windows(gap_of: Gap, times: Sequence[Fraction]) -> list[Range]:
    """Return the runs of pieces [t_j, t_(j+1)] that do not stay up; gap < 0 must hold at t_n."""
    windows: list[Range] = []
    value, bend = gap_of((times[0], times[0]), 0), gap_of((times[0], times[-1]), 2)
    for before, now in pairwise(times):
        following = gap_of((now, now), 0)
        if not stays_up(gap_of, (before, now), min(value.lo, following.lo), bend):
            begin = windows.pop()[0] if windows and windows[-1][1] == before else before
            windows.append((begin, now))
        value = following
    if value.hi >= 0:
        raise Unproved("the gap is not proved negative at the last time")
    return windows


def first_windows(
    gap_of: Gap, times: Sequence[Fraction], *orders: int
) -> tuple[tuple[Range, ...], bool]:
    """Return the windows of the first impact, and whether it is transversal.

    For an order k of `orders`: gap^(k) > 0 on [0, t_1], lower derivatives are >= 0 at launch, so
    that gap > 0 on (0, t_1]. A piece [t_j, t_(j+1)] that does not stay up belongs to a window. The
    impact is transversal (unique, smooth in the launch) if there is one window, which ends at t_n,
    and gap' < 0 on it.
    """
    if all(gap_of((_ZERO, times[0]), order).lo <= 0 for order in orders):
        raise Unproved("the launches are not proved to leave the table")
    windows = open_windows(gap_of, times)
    single = len(windows) == 1 and windows[0][1] == times[-1]
    return tuple(windows), single and falls(gap_of, windows[0], _HALVINGS)
