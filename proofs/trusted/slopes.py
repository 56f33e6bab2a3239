"""The plastic impact map f on intervals of phases: slopes, images, what it avoids."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from proofs.trusted.certificate import Reader
from proofs.trusted.flights import (
    COVER_BITS,
    FirstImpact,
    bracketed,
    lifted,
    phase_after,
    read_phases,
    transversal_step,
    whole_turns,
)
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.numbers import (
    TURN,
    Phase,
    Phases,
    Range,
    between,
    ceil_text,
    floor_text,
    increasing,
    mean_values,
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
        slope, image = between(self.slope, 12), between(self.image, 12)
        return f"f'({show(self.phase)}) is in {slope}, f({show(self.phase)}) in {image}."


def signed(slope: Range, sign: int) -> Range:
    """Return bounds on f' times a sign."""
    low, high = slope
    return (low, high) if sign > 0 else (-high, -low)


@dataclass(frozen=True)
class SlopeRange(Conclusion):
    """f is C^1 on [points[0], points[-1]]; f' and f at the points, f' over each piece between.

    Phases are on the line: points may pass 2 pi; images are f, mod 2 pi, and may pass 2 pi as well.
    """

    at: Place
    points: tuple[Fraction, ...]
    slopes: tuple[Range, ...]
    images: tuple[Range, ...]
    pieces: tuple[Range, ...]

    def __post_init__(self) -> None:
        if len(self.points) < 2 or not increasing(self.points):
            raise Unproved("two points, or more, are expected in order")
        if not 0 <= self.points[0] <= TURN or self.points[-1] - self.points[0] >= TURN:
            raise Unproved("points of one turn are expected")

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
    def ends(self) -> Range:
        """The phases that it is about, on the line."""
        return self.points[0], self.points[-1]

    @property
    def domain(self) -> Phases:
        """The phases that it is about, where they do not pass 2 pi."""
        return Phases(*self.ends)

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
        return f"f is continuously differentiable, with {self.brief}."

    @property
    def brief(self) -> str:
        low, high = floor_text(self.minimum[0]), ceil_text(self.maximum[1])
        return f"{low} <= f' <= {high} on {show_range(self.ends)}"

    @property
    def latex(self) -> str:
        low, high = floor_text(self.minimum[0]), ceil_text(self.maximum[1])
        return rf"{low} \le f'(\varphi) \le {high},\ \varphi \in {show_range(self.ends)}"


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

    @property
    def passes_zero(self) -> bool:
        """Whether the arc is all phases from `low` on and all up to `high`."""
        return self.high[1] < self.low[0]

    def covers(self, target: Range) -> bool:
        """Whether the image is proved to contain an interval of phases."""
        after, before = self.low[1] <= target[0], target[1] <= self.high[0]
        return after or before if self.passes_zero else after and before

    def misses(self, target: Range) -> bool:
        """Whether the image is proved to miss an interval of phases."""
        before, after = target[1] < self.low[0], self.high[1] < target[0]
        return before and after if self.passes_zero else self.is_interval and (before or after)

    @property
    def sentence(self) -> str:
        return (
            f"f maps {show_range(self.domain)} monotonically onto the arc from a phase in "
            f"{between(self.low, 12)} up to one in {between(self.high, 12)}."
        )


def image_arc(slopes: SlopeRange) -> ImageArc:
    """Theorem. If f' has one sign on an interval, and sup |f'| times its length is below 2 pi, f
    maps it onto the arc between the images of its ends, in the order of that sign.

    Raises Unproved where a hypothesis is not.
    """
    low, high = slopes.domain
    if slopes.steepest * (high - low) >= TURN:
        raise Unproved("an image may be longer than the circle")
    first, last = Phase(*slopes.images[0]), Phase(*slopes.images[-1])
    if slopes.minimum[0] > 0:
        return ImageArc(slopes.at, slopes.domain, first, last)
    if slopes.maximum[1] < 0:
        return ImageArc(slopes.at, slopes.domain, last, first)
    raise Unproved("f is not proved monotone")


def image_range(slopes: SlopeRange) -> Range:
    """Enclose the image of an interval, on the line: from the images of its ends, and f' between.

    Of the numbers that are the image of the last one mod 2 pi, only one is as far from that of the
    first as f' allows. Raises Unproved where that is not seen, or an image may be too long.
    """
    width, change = slopes.ends[1] - slopes.ends[0], (slopes.minimum[0], slopes.maximum[1])
    if slopes.steepest * width >= TURN:
        raise Unproved("an image may be longer than the circle")
    first, last = slopes.images[0], slopes.images[-1]  # which may both pass 2 pi: two turns apart
    moved = [lifted(last, turns, COVER_BITS) for turns in range(-2, 3)]
    near = [
        end
        for end in moved
        if end[0] - first[1] <= change[1] * width and change[0] * width <= end[1] - first[0]
    ]
    if len(near) != 1:
        raise Unproved("an image is not told from what is a turn away")
    return mean_values(first, near[0], change, width)


def inside(values: Range, target: Range) -> bool:
    """Whether an interval is inside another one, modulo 2 pi."""
    moved = (lifted(values, turns, COVER_BITS) for turns in (-1, 0, 1))
    return any(target[0] < low and high < target[1] for low, high in moved)


@dataclass(frozen=True)
class Avoids(Conclusion):
    """No phase in `phases` has its first impact at a phase in `target`."""

    at: Place
    phases: Phases
    target: Phases

    @property
    def sentence(self) -> str:
        phases, target = show_range(self.phases), show_range(self.target)
        return f"no phase of {phases} has its first impact in {target}."


# -- the rules ------------------------------------------------------------------------------------


def point(context: Context, reader: Reader) -> Impact:
    """Rule `point`: {flight, phase, time}: a bracket of one launch's transversal first impact.

    Conclusion: f'(phase) and f(phase), from the slope formula and phase + time.

    Proof. The gap has opposite signs at the ends of the bracket, and falls: the impact is in it.
    gap(phase, t) = 0 gives dt/dphase = -(dgap/dphase)/gap', and f' = 1 + dt/dphase is `slope`.
    """
    phase, slope, image = _launched(context, reader)
    return Impact(context.place, phase, slope, Phase(*image))


def _launched(context: Context, reader: Reader) -> tuple[Fraction, Range, Range]:
    """Return the phase of a {flight, phase, time}, f' there, and f as `phase_after` has it."""
    flight, phase_of, time_of = reader.fields("flight", "phase", "time")
    phase, time = phase_of.number(), time_of.range()
    step = transversal_step(context, flight, (phase, phase))
    motion = bracketed(step, (phase, phase), time)
    return phase, motion.slope(time).range, phase_after(phase, time, motion.bits)


def slope_range(context: Context, reader: Reader) -> SlopeRange:
    """Rule `slope-range`: {points: [{flight, phase, time}], pieces: [{flight, time}]}.

    Hypotheses: phases x_0 < ... < x_n with brackets; for every piece [x_i, x_(i+1)] a transversal
    first-impact step that contains it, and a bracket for all its launches. Conclusion: f is C^1
    on [x_0, x_n], and with f'' enclosed over a piece of width w, f' lies in both f'(x_i) + f'' [0,
    w] and f'(x_(i+1)) - f'' [0, w]. Proof. Transversal impacts are smooth in the phase, and at a
    shared end the first impact is the same. The bounds are the mean value theorem, for f'.
    """
    points_of, pieces_of = reader.fields("points", "pieces")
    phases, slopes, images = zip(
        *(_launched(context, entry) for entry in points_of.items(least=2)), strict=True
    )
    pieces, count = [], len(phases) - 1
    for index, entry in enumerate(pieces_of.items(count, count)):
        flight, time_of = entry.fields("flight", "time")
        piece = phases[index], phases[index + 1]
        if piece[0] >= piece[1]:
            raise points_of.fail("phases must increase")
        time = time_of.range()
        motion = bracketed(transversal_step(context, flight, piece), piece, time)
        bend, width = motion.curvature(time).range, piece[1] - piece[0]
        pieces.append(mean_values(slopes[index], slopes[index + 1], bend, width))
    return SlopeRange(context.place, phases, slopes, images, tuple(pieces))


def avoids(context: Context, reader: Reader) -> Avoids:
    """Rule `avoids`: {flights, target}: first-impact steps whose phases follow one another.

    Hypothesis: for each step and each of its windows, phases + window misses target + 2 pi k
    for every k. Conclusion: no phase of the union has its first impact in the target. Proof. Each
    has it in a window of its step, so f in phases + window.
    """
    flights_of, target_of = reader.fields("flights", "target")
    target = read_phases(target_of)
    steps: list[FirstImpact] = []
    for name in flights_of.items(least=1):
        step = context.step(name, FirstImpact)
        if steps and step.motion.phases[0] != steps[-1].motion.phases[1]:
            raise name.fail("its phases do not continue those of the step before")
        steps.append(step)
        for window in step.windows:
            if meets(step.motion.phases, window, target):
                raise Unproved(f"a window of {name.string()} is not proved to miss the target")
    phases = Phases(steps[0].motion.phases[0], steps[-1].motion.phases[1])
    return Avoids(steps[0].at, phases, Phases(*target))


def meets(phases: Range, time: Range, target: Range) -> bool:
    """Return False only if phases + time is proved to miss target + 2 pi k for every k."""
    early, late = phases[0] + time[0], phases[1] + time[1]
    count = early // whole_turns(1, COVER_BITS)[0] - 1  # for lower k, target + 2 pi k lies before
    while True:
        low, high = lifted(target, count, COVER_BITS)
        if late < low:
            return False
        if early <= high:
            return True
        count += 1
