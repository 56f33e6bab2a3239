"""The plastic impact map f on intervals of phases: slopes, images, what it avoids."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from proofs.trusted.certificate import Reader
from proofs.trusted.flights import (
    FirstImpact,
    PlasticMap,
    bracketed,
    phase_after,
    read_phases,
    transversal_step,
)
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.laps import Gap, SlopeRange, meets
from proofs.trusted.numbers import (
    Phase,
    Phases,
    Range,
    between,
    mean_values,
    show,
    show_range,
    within,
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


@dataclass(frozen=True)
class Avoids(Gap):
    """No phase in `phases` has its first impact at a phase in `target`."""

    function: PlasticMap
    phases: Phases
    target: Phases

    @property
    def source(self) -> Range:
        """The interval."""
        return self.phases

    def misses(self, target: Range) -> bool:
        """Whether no phase has its first impact in an interval."""
        return within(target, self.target)

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
    return SlopeRange(PlasticMap(context.place), phases, slopes, images, tuple(pieces))


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
            if comes_to(step.at, step.motion.phases, window, target):
                raise Unproved(f"a window of {name.string()} is not proved to miss the target")
    phases = Phases(steps[0].motion.phases[0], steps[-1].motion.phases[1])
    return Avoids(PlasticMap(steps[0].at), phases, Phases(*target))


def comes_to(at: Place, phases: Range, time: Range, target: Range) -> bool:
    """Return False only if phases + time is proved to miss target + 2 pi k for every k."""
    return meets(PlasticMap(at), (phases[0] + time[0], phases[1] + time[1]), target)
