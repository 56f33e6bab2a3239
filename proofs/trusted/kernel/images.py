"""Images of intervals, on which a map of the line, or of a circle, has a known slope."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import AboutMap, Subject, given, named
from proofs.trusted.kernel.laps import SlopeRange, point_of, shifted, turn_of
from proofs.trusted.numbers import Range, between, mean_values, show_range


def is_long(function: Subject, length: Fraction) -> bool:
    """Whether an arc may reach around the circle."""
    turn = turn_of(function)
    return turn is not None and length >= turn


def inside(function: Subject, values: Range, target: Range) -> bool:
    """Whether an interval is inside another one, modulo the period."""
    moved = (shifted(function, values, turns) for turns in (-1, 0, 1))
    return any(target[0] < low and high < target[1] for low, high in moved)


@dataclass(frozen=True)
class ImageArc(AboutMap):
    """f is C^1 and monotone on `domain` and maps it onto the arc from `low` up to `high`.

    The arc is shorter than the circle; where `low` is below `high`, it is an interval.
    """

    function: Subject
    domain: Range
    low: Range
    high: Range

    @property
    def is_interval(self) -> bool:
        """Whether the arc does not pass the point 0 of a circle."""
        return self.low[1] < self.high[0]

    @property
    def passes_zero(self) -> bool:
        """Whether the arc is all points of a circle from `low` on and all up to `high`."""
        return self.high[1] < self.low[0]

    def covers(self, target: Range) -> bool:
        """Whether the image is proved to contain an interval."""
        after, before = self.low[1] <= target[0], target[1] <= self.high[0]
        return after or before if self.passes_zero else after and before

    def misses(self, target: Range) -> bool:
        """Whether the image is proved to miss an interval."""
        before, after = target[1] < self.low[0], self.high[1] < target[0]
        return before and after if self.passes_zero else self.is_interval and (before or after)

    @property
    def sentence(self) -> str:
        phase = "point" if self.place is None else "phase"
        return (
            f"{given(self.function)}{named(self.function)} maps {show_range(self.domain)} "
            f"monotonically onto the arc from a {phase} in {between(self.low, 12)} up to one in "
            f"{between(self.high, 12)}."
        )


def image_arc(slopes: SlopeRange) -> ImageArc:
    """Theorem. If f' has one sign on an interval, and sup |f'| times its length is below the
    period, f maps it onto the arc between the images of its ends, in the order of that sign.

    Raises Unproved where a hypothesis is not.
    """
    low, high = slopes.domain
    if is_long(slopes.function, slopes.steepest * (high - low)):
        raise Unproved("an image may be longer than the circle")
    first, last = (point_of(slopes.function, slopes.images[place]) for place in (0, -1))
    if slopes.minimum[0] > 0:
        return ImageArc(slopes.function, slopes.domain, first, last)
    if slopes.maximum[1] < 0:
        return ImageArc(slopes.function, slopes.domain, last, first)
    raise Unproved("f is not proved monotone")


def image_range(slopes: SlopeRange) -> Range:
    """Enclose the image of an interval, on the line: from the images of its ends, and f' between.

    Of the numbers that are the image of the last one mod the period, only one is as far from that
    of the first as f' allows. Raises Unproved where that is not seen, or an image may be too long.
    """
    width, change = slopes.ends[1] - slopes.ends[0], (slopes.minimum[0], slopes.maximum[1])
    first = slopes.images[0]
    if is_long(slopes.function, slopes.steepest * width):
        raise Unproved("an image may be longer than the circle")
    moved = {shifted(slopes.function, slopes.images[-1], turns) for turns in range(-2, 3)}
    near = [  # both images may pass a period: two turns apart
        end
        for end in moved
        if end[0] - first[1] <= change[1] * width and change[0] * width <= end[1] - first[0]
    ]
    if len(near) != 1:
        raise Unproved("an image is not told from what is a turn away")
    return mean_values(first, near[0], change, width)
