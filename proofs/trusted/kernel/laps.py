"""A map of the line, or of a circle, on intervals: slopes, images, what it avoids.

On a circle points are on the line, and images modulo the period; what is compared with points lies
in [0, P), P being the lower end of its enclosure.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import AboutMap, Conclusion, Subject, given, named
from proofs.trusted.numbers import Range, ceil_text, floor_text, increasing, show_range

_BITS = 64


# -- the circle ------------------------------------------------------------------------------------


def turn_of(function: Subject) -> Fraction | None:
    """Return a lower bound on the period; None for a map of the line."""
    period = function.periods(_BITS).get(0)
    return None if period is None else period.range[0]


def shifted(function: Subject, values: Range, turns: int, bits: int = _BITS) -> Range:
    """Enclose values + so many periods."""
    period = function.periods(bits).get(0)
    if period is None:
        return values
    low, high = (period * turns).range
    return values[0] + low, values[1] + high


def point_of(function: Subject, values: Range) -> Range:
    """Return an enclosure of one point, if it can be compared with others; else Unproved.

    A whole turn is 0 once more, at the other end.
    """
    turn = turn_of(function)
    if turn is not None and not 0 <= values[0] <= values[1] < turn:
        raise Unproved("an enclosure of a phase straddles a period")
    return values


def interval_of(function: Subject, ends: Range) -> Range:
    """Return a closed interval of positive width whose points can be compared; else Unproved."""
    point_of(function, ends)
    if ends[0] >= ends[1]:
        raise Unproved(f"{show_range(ends)} is no interval")
    return ends


def subject_of(conclusions: Sequence[AboutMap]) -> Subject:
    """Return the one map that conclusions are about."""
    if not conclusions or any(x.function != conclusions[0].function for x in conclusions):
        raise Unproved("the hypotheses are about different maps, or about none")
    return conclusions[0].function


def meets(function: Subject, values: Range, target: Range) -> bool:
    """Return False only if values, less any number of periods, are proved to miss a target."""
    if (turn := turn_of(function)) is None:
        return values[0] <= target[1] and target[0] <= values[1]
    count = int(values[0] // turn) - 1  # for fewer, the target lies before
    while True:
        low, high = shifted(function, target, count)
        if values[1] < low:
            return False
        if values[0] <= high:
            return True
        count += 1


# -- intervals -------------------------------------------------------------------------------------


class Lap(Conclusion):
    """What says that a map is C^1 on an interval."""

    @property
    def subject(self) -> Subject:
        """The map."""
        raise NotImplementedError

    @property
    def source(self) -> Range:
        """The interval."""
        raise NotImplementedError

    def read_image(self, point: Fraction, entry: Reader) -> Range:
        """Enclose the image of a point of the interval, on the line, by what an entry has."""
        raise NotImplementedError


# -- slopes ----------------------------------------------------------------------------------------


def signed(slope: Range, sign: int) -> Range:
    """Return bounds on f' times a sign."""
    low, high = slope
    return (low, high) if sign > 0 else (-high, -low)


@dataclass(frozen=True)
class SlopeRange(AboutMap, Lap):
    """f is C^1 on [points[0], points[-1]]; f' and f at the points, f' over each piece between."""

    function: Subject
    points: tuple[Fraction, ...]
    slopes: tuple[Range, ...]
    images: tuple[Range, ...]
    pieces: tuple[Range, ...]

    def __post_init__(self) -> None:
        if len(self.points) < 2 or not increasing(self.points):
            raise Unproved("two points, or more, are expected in order")
        turn, (first, last) = turn_of(self.function), self.ends
        if turn is not None and not (0 <= first <= turn and last - first < turn):
            raise Unproved("points of one turn are expected")

    def over(self, domain: Range) -> SlopeRange | None:
        """Return the part between two of the points; None if an end is not one of them."""
        if not set(domain) <= set(self.points):
            return None
        first, last = (self.points.index(end) for end in domain)
        return SlopeRange(
            self.function,
            self.points[first : last + 1],
            self.slopes[first : last + 1],
            self.images[first : last + 1],
            self.pieces[first:last],
        )

    @property
    def ends(self) -> Range:
        """The points that it is about, on the line."""
        return self.points[0], self.points[-1]

    @property
    def subject(self) -> Subject:
        """The map."""
        return self.function

    @property
    def source(self) -> Range:
        """Its ends."""
        return self.ends

    def read_image(self, point: Fraction, entry: Reader) -> Range:
        """Return the image of one of the points, {phase}, of a map of the line."""
        (phase_of,) = entry.fields("phase")
        if turn_of(self.function) is not None:
            raise Unproved("a map of the line is expected")
        if point not in self.points:
            raise phase_of.fail("not a point of the step")
        return self.images[self.points.index(point)]

    @property
    def domain(self) -> Range:
        """The same, where they do not pass a period; else Unproved."""
        return interval_of(self.function, self.ends)

    @property
    def minimum(self) -> Range:
        """The least f': at least the least bound of a piece, at most the least at a point."""
        return min(low for low, _ in self.pieces), min(high for _, high in self.slopes)

    @property
    def maximum(self) -> Range:
        """The greatest f'."""
        return max(low for low, _ in self.slopes), max(high for _, high in self.pieces)

    def bounds(self, sign: int = 1) -> Range:
        """Return bounds on f' times a sign."""
        return signed((self.minimum[0], self.maximum[1]), sign)

    @property
    def sign(self) -> int:
        """1 where f' > 0 is proved, -1 where f' < 0 is, or else 0."""
        return int(self.minimum[0] > 0) - int(self.maximum[1] < 0)

    @property
    def steepest(self) -> Fraction:
        """A bound on |f'|."""
        return max(-self.minimum[0], self.maximum[1])

    @property
    def expands(self) -> bool:
        """Whether |f'| > 1."""
        return self.minimum[0] > 1 or self.maximum[1] < -1

    @property
    def sentence(self) -> str:
        name = named(self.function)
        return f"{given(self.function)}{name} is continuously differentiable, with {self.brief}."

    @property
    def brief(self) -> str:
        low, high = floor_text(self.minimum[0]), ceil_text(self.maximum[1])
        return f"{low} <= {named(self.function)}' <= {high} on {show_range(self.ends)}"

    @property
    def latex(self) -> str:
        if self.place is None:
            return ""
        low, high = floor_text(self.minimum[0]), ceil_text(self.maximum[1])
        return rf"{low} \le f'(\varphi) \le {high},\ \varphi \in {show_range(self.ends)}"
