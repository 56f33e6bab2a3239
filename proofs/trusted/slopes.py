"""What is proved about the plastic impact map on intervals of phases."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.numbers import (
    TURN,
    Phase,
    Phases,
    Range,
    ceil_text,
    floor_text,
    show,
    show_range,
)
from proofs.trusted.parameters import Place


@dataclass(frozen=True)
class Impact(Conclusion):
    """A phase has a transversal first impact: f is C^1 near it, with this slope and image."""

    at: Place
    phase: Fraction
    slope: Range
    image: Phase

    @property
    def sentence(self) -> str:
        """Return the statement."""
        slope, image = (
            f"[{floor_text(low, 12)}, {ceil_text(high, 12)}]"
            for low, high in (self.slope, self.image)
        )
        return f"f'({show(self.phase)}) is in {slope}, f({show(self.phase)}) in {image}."

    @property
    def brief(self) -> str:
        """Return the numbers."""
        return (
            f"{floor_text(self.slope[0])} <= f'({show(self.phase)}) <= {ceil_text(self.slope[1])}, "
            f"{floor_text(self.image[0])} <= f({show(self.phase)}) <= {ceil_text(self.image[1])}"
        )


@dataclass(frozen=True)
class SlopeRange(Conclusion):
    """f is C^1 on [points[0], points[-1]]; f' and f at the points, f' over each piece between."""

    at: Place
    points: tuple[Fraction, ...]
    slopes: tuple[Range, ...]
    images: tuple[Phase, ...]
    pieces: tuple[Range, ...]

    def __post_init__(self) -> None:
        """Raise Unproved unless the points are phases in order."""
        Phases(self.points[0], self.points[-1])
        if any(low >= high for low, high in pairwise(self.points)):
            raise Unproved("points must be in order")

    def over(self, domain: Range) -> SlopeRange | None:
        """Return the part between two of the points; None if an end is not one of them."""
        if not set(domain) <= set(self.points):
            return None
        first, last = (self.points.index(end) for end in domain)
        return SlopeRange(
            self.at,
            self.points[first : last + 1],
            self.slopes[first : last + 1],
            self.images[first : last + 1],
            self.pieces[first:last],
        )

    @property
    def domain(self) -> Phases:
        """The phases that it is about."""
        return Phases(self.points[0], self.points[-1])

    @property
    def minimum(self) -> Range:
        """The least f': at least the least bound of a piece, at most the least at a point."""
        return min(low for low, _ in self.pieces), min(high for _, high in self.slopes)

    @property
    def maximum(self) -> Range:
        """The greatest f'."""
        return max(low for low, _ in self.slopes), max(high for _, high in self.pieces)

    @property
    def expands(self) -> bool:
        """Whether |f'| > 1."""
        return self.minimum[0] > 1 or self.maximum[1] < -1

    @property
    def sentence(self) -> str:
        """Return the statement."""
        return (
            f"f is continuously differentiable on {show_range(self.domain)}, with "
            f"{floor_text(self.minimum[0])} <= f' <= {ceil_text(self.maximum[1])}."
        )

    @property
    def brief(self) -> str:
        """Return the bounds."""
        low, high = floor_text(self.minimum[0]), ceil_text(self.maximum[1])
        return f"{low} <= f' <= {high} on {show_range(self.domain)}"

    @property
    def latex(self) -> str:
        """Return the bounds."""
        low, high = floor_text(self.minimum[0]), ceil_text(self.maximum[1])
        return rf"{low} \le f'(\varphi) \le {high},\ \varphi \in {show_range(self.domain)}"


@dataclass(frozen=True)
class ImageArc(Conclusion):
    """f is C^1 and monotone on `domain` and maps it onto the arc from `low` up to `high`.

    The arc is shorter than the circle; where `low` is below `high`, it is an interval of phases.
    """

    at: Place
    domain: Phases
    low: Phase
    high: Phase

    @property
    def is_interval(self) -> bool:
        """Whether the arc does not pass phase 0."""
        return self.low[1] < self.high[0]

    def covers(self, target: Range) -> bool:
        """Whether the image is proved to contain an interval of phases."""
        return self.low[1] <= target[0] and target[1] <= self.high[0]

    @property
    def sentence(self) -> str:
        """Return the statement."""
        ends = [f"[{floor_text(x[0], 12)}, {ceil_text(x[1], 12)}]" for x in (self.low, self.high)]
        return (
            f"f maps {show_range(self.domain)} monotonically onto the arc from a phase in "
            f"{ends[0]} up to one in {ends[1]}."
        )

    @property
    def brief(self) -> str:
        """Return where the image ends."""
        return (
            f"f({show_range(self.domain)}) reaches from {floor_text(self.low[0])}.. to "
            f"{ceil_text(self.high[1])}"
        )


def image_arc(slopes: SlopeRange) -> ImageArc:
    """Theorem. If f' has one sign on an interval, and sup |f'| times its length is below 2 pi, f
    maps it onto the arc between the images of its ends, in the order of that sign.

    Raises Unproved where a hypothesis is not.
    """
    low, high = slopes.domain
    steepest = max(-slopes.minimum[0], slopes.maximum[1])
    if steepest * (high - low) >= TURN:
        raise Unproved("an image may be longer than the circle")
    first, last = slopes.images[0], slopes.images[-1]
    if slopes.minimum[0] > 0:
        return ImageArc(slopes.at, slopes.domain, first, last)
    if slopes.maximum[1] < 0:
        return ImageArc(slopes.at, slopes.domain, last, first)
    raise Unproved("f is not proved monotone")


@dataclass(frozen=True)
class Avoids(Conclusion):
    """No phase in `phases` has its first impact at a phase in `target`."""

    at: Place
    phases: Phases
    target: Phases

    @property
    def sentence(self) -> str:
        """Return the statement."""
        phases, target = show_range(self.phases), show_range(self.target)
        return f"no phase of {phases} has its first impact in {target}."
