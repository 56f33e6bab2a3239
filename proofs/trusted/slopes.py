"""The plastic impact map f: its slope and image at a phase."""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction

from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.differential import Differential
from proofs.trusted.numbers import Phase, Range, between, show
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
