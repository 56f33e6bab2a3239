"""The plastic impact map f: its slope and image at a phase, what it avoids."""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction

from proofs.trusted.certificate import Reader
from proofs.trusted.flights import FirstImpact, read_phases
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.differential import Differential
from proofs.trusted.kernel.laps import Gap, meets
from proofs.trusted.numbers import Phase, Phases, Range, between, show, show_range, within
from proofs.trusted.oscillator import PlasticMap
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


def impact(point: Differential) -> Impact:
    """Theorem. What the rule `differential` concludes of f at one phase is `Impact`; else Unproved.

    Proof. f is continuously differentiable near the phase, and f less some turns is in [0, 2 pi).
    """
    (phase, last), *others = point.box
    if not isinstance(point.function, PlasticMap) or others or phase != last:
        raise Unproved("one phase is expected")
    return Impact(point.function.at, phase, point.matrix[0][0], Phase(*point.values[0]))


def impacts(found: Iterable[Conclusion]) -> list[Impact]:
    """Return what conclusions say of f at single phases."""
    known = []
    for each in found:
        with suppress(Unproved):
            if isinstance(each, Impact | Differential):
                known.append(impact(each) if isinstance(each, Differential) else each)
    return known


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
